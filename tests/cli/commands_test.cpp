#include <array>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_fixture.h"

// The commands as they are typed, down to files and exit codes.
namespace fluxwalk::cli {
namespace {

class Commands : public CommandTest {};

TEST_F(Commands, SolveWritesALitMeshAndAReport) {
    const Result result = run({"solve", "squares-parallel", "-o", path("lit.glb"), "--error", "10%",
                               "--report", path("report.json"), "--threads", "2", "--seed", "3"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("lit.glb"), std::string::npos);
    EXPECT_EQ(read("lit.glb").substr(0, 4), "glTF");
    const nlohmann::json report = nlohmann::json::parse(read("report.json"));
    EXPECT_EQ(report.at("command"), "solve");
    EXPECT_EQ(report.at("outcome"), "reachedError");
    EXPECT_EQ(report.at("options").at("seed"), 3);
    EXPECT_GT(report.at("counters").at("links"), 0);
    EXPECT_GT(report.at("seconds").at("total"), 0.0);
    EXPECT_LE(report.at("estimatedError"), 0.1);
    EXPECT_EQ(fileCount(), 2u) << "nothing is left beside";
}

TEST_F(Commands, LitMeshIsASceneAgain) {
    ASSERT_EQ(run({"solve", "squares-parallel", "-o", path("lit.glb"), "--error", "20%", "--quiet"}).code, 0);
    const Result info = run({"info", path("lit.glb"), "--json"});
    EXPECT_EQ(info.code, 0) << info.err;
    const nlohmann::json lit = nlohmann::json::parse(info.out);
    const nlohmann::json original = nlohmann::json::parse(run({"info", "squares-parallel", "--json"}).out);
    EXPECT_EQ(lit.at("objects"), original.at("objects"));
    ASSERT_EQ(lit.at("emitters").size(), original.at("emitters").size());
    EXPECT_NEAR(lit.at("emitters").at(0).at("lumens"), original.at("emitters").at(0).at("lumens"), 1e-3);
    EXPECT_NE(lit.at("warnings").dump().find("a lit file"), std::string::npos);
}

TEST_F(Commands, JsonGoesToStandardOutputAlone) {
    const Result result =
        run({"solve", "squares-parallel", "-o", path("lit.glb"), "--error", "20%", "--json", "--quiet"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out).at("outputs").at(0), path("lit.glb"));
    EXPECT_EQ(result.err, "");
}

TEST_F(Commands, QuietSaysNothing) {
    const Result result =
        run({"solve", "squares-parallel", "-o", path("lit.glb"), "--error", "20%", "--quiet"});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Commands, TimeLimitKeepsWhatIsSolved) {
    const Result result = run({"solve", "cornell-box", "-o", path("lit.glb"), "--error", "0.01%",
                               "--time-limit", "0.3", "--json", "--quiet"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out).at("outcome"), "reachedTimeLimit");
    EXPECT_GT(std::filesystem::file_size(path("lit.glb")), 1000u);
}

// Values at sensors are right long before the mesh is.
TEST_F(Commands, MeasureStopsAtTheErrorOfItsSensors) {
    const std::string sensors = write("in.csv", "x,y,z,nx,ny,nz\n1,1,1,0,1,0\n");
    const auto linksOf = [](const Result& result) {
        return nlohmann::json::parse(result.out).at("counters").at("links").get<double>();
    };
    const double measured = linksOf(run(
        {"measure", "cornell-box", "--sensors", sensors, "-o", path("o.csv"), "--error", "3%", "--json"}));
    const double solved =
        linksOf(run({"solve", "cornell-box", "-o", path("o.glb"), "--error", "3%", "--json"}));
    EXPECT_LT(2.0 * measured, solved);
}

TEST_F(Commands, MeasureGivesTheClosedFormBetweenSquares) {
    // At the middle of a unit square 1 m from a parallel one, each quarter of which gives (1/pi) s atan s
    // with s = x / sqrt(1 + x^2), x = 1/2 (Howell's catalogue, B-4). Area and exitance: 1 m2 holds all the
    // lumens.
    const double side = 0.5 / std::sqrt(1.25);
    const double factor = 4.0 / 3.14159265358979323846 * side * std::atan(side);
    const nlohmann::json scene = nlohmann::json::parse(run({"info", "squares-parallel", "--json"}).out);
    const double lumens = scene.at("lumens");
    const double height = scene.at("bounds").at("upper").at(1);
    const nlohmann::json lower = scene.at("bounds").at("lower");
    ASSERT_NEAR(height - lower.at(1).get<double>(), 1.0, 1e-6);
    const double x = lower.at(0).get<double>() + 0.5;
    const double z = lower.at(2).get<double>() + 0.5;
    std::ostringstream rows;
    rows << "x,y,z,nx,ny,nz\n"
         << x << ',' << lower.at(1).get<double>() << ',' << z << ",0,1,0\n"
         << x << ',' << height << ',' << z << ",0,-1,0\n";
    const Result result = run({"measure", "squares-parallel", "--sensors", write("in.csv", rows.str()), "-o",
                               path("out.csv"), "--error", "0.5%", "--quiet"});
    ASSERT_EQ(result.code, 0) << result.err;
    std::istringstream out(read("out.csv"));
    std::string line;
    std::getline(out, line);
    EXPECT_EQ(line, "x,y,z,nx,ny,nz,E_r,E_g,E_b,lux,low,high,solid");
    std::array<double, 3> brightest{};  // lux, low and high
    while (std::getline(out, line)) {
        std::istringstream cells(line);
        std::array<double, 13> row{};
        for (double& value : row) {
            std::string cell;
            std::getline(cells, cell, ',');
            value = std::stod(cell);
        }
        EXPECT_EQ(row[12], 0.0);
        if (row[9] > brightest[0]) {
            brightest = {row[9], row[10], row[11]};
        }
    }
    EXPECT_NEAR(brightest[0] / (factor * lumens), 1.0, 0.01);
    EXPECT_LE(brightest[1], factor * lumens);
    EXPECT_GE(brightest[2], factor * lumens);
    EXPECT_LE(brightest[2] - brightest[1], 0.1 * factor * lumens);
}

TEST_F(Commands, InfoListsAndDescribes) {
    const Result list = run({"info", "--list"});
    EXPECT_EQ(list.code, 0);
    EXPECT_NE(list.out.find("cornell-box"), std::string::npos);
    const nlohmann::json names = nlohmann::json::parse(run({"info", "--list", "--json"}).out);
    EXPECT_GE(names.size(), 8u);
    for (const nlohmann::json& entry : names) {
        const Result info = run({"info", entry.at("name")});
        EXPECT_EQ(info.code, 0) << entry << info.err;
        EXPECT_NE(info.out.find(entry.at("name").get<std::string>()), std::string::npos);
    }
    EXPECT_EQ(run({"info"}).code, 2);
}

TEST_F(Commands, BadScenesAreNamed) {
    expectFailure({"info", path("missing.glb")}, ExitCode::badInput, "missing.glb");
    expectFailure({"info", write("cut.glb", "glTF")}, ExitCode::badInput, "cut.glb");
    expectFailure({"info", write("text.gltf", "{\"asset\": ")}, ExitCode::badInput, "text.gltf");
    expectFailure({"info", write("empty.gltf", R"({"asset": {"version": "2.0"}})")}, ExitCode::badInput,
                  "empty.gltf");
    expectFailure({"solve", path("missing.glb"), "-o", path("out.glb")}, ExitCode::badInput, "missing.glb");
    EXPECT_FALSE(std::filesystem::exists(path("out.glb")));
    expectFailure({"info", "cornel-box"}, ExitCode::usage, "did you mean 'cornell-box'?");
}

TEST_F(Commands, BadSensorsNameTheirLine) {
    const std::string sensors = write("in.csv", "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n0,0,zero,0,1,0\n");
    expectFailure({"measure", "squares-parallel", "--sensors", sensors, "-o", path("out.csv")},
                  ExitCode::badInput, "in.csv: line 3: ");
    EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
    expectFailure({"measure", "squares-parallel", "--sensors", path("none.csv"), "-o", path("out.csv")},
                  ExitCode::badInput, "none.csv");
}

TEST_F(Commands, OutputsThatCannotBeWrittenAreSaidBeforeTheWork) {
    const std::string nowhere = path("missing") + "/out";
    expectFailure({"solve", "cornell-box", "--error", "0.01%", "-o", nowhere + ".glb"}, ExitCode::cannotWrite,
                  "out.glb: cannot be written");
    expectFailure({"solve", "cornell-box", "--error", "0.01%", "-o", path("a.glb"), "--report", nowhere},
                  ExitCode::cannotWrite, "cannot be written");
    expectFailure({"solve", "cornell-box", "-o", path("a.obj")}, ExitCode::usage, "does not end in .glb");
    expectFailure({"measure", "cornell-box", "--sensors", path("in.csv"), "-o", folder_.string()},
                  ExitCode::cannotWrite, "is a folder");
    EXPECT_EQ(fileCount(), 0u) << "nothing half-written";
}

TEST_F(Commands, MissingAndUnknownOptionsAreNamed) {
    expectFailure({"solve", "cornell-box"}, ExitCode::usage, "--output");
    expectFailure({"measure", "cornell-box", "-o", path("o.csv")}, ExitCode::usage, "--sensors");
    expectFailure({"solve", "cornell-box", "--ouput", "a.glb"}, ExitCode::usage, "did you mean '--output'?");
    expectFailure({"measure", "cornell-box", "--sensor", "a.csv"}, ExitCode::usage,
                  "did you mean '--sensors'?");
}

}  // namespace
}  // namespace fluxwalk::cli
