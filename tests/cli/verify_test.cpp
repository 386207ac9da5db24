#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/sensors_csv.h"
#include "tests/cli/command_fixture.h"

// measure and verify as they are typed, down to files and exit codes.
namespace fluxwalk::cli {
namespace {

class Verify : public CommandTest {};

TEST_F(Verify, WritesReferencesWithStandardErrors) {
    const Result result =
        run({"verify", "cornell-box", "--points", "20", "--paths", "256", "-o", path("r.csv")});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("256 paths at each of 20 sensors"), std::string::npos) << result.out;
    const io::SensorTable table = io::readSensorTable(path("r.csv"));
    ASSERT_EQ(table.sensors.size(), 20u);
    const auto lux = table.find("lux");
    const auto error = table.find("se_lux");
    ASSERT_TRUE(lux && error && table.find("E_g") && table.find("se_b"));
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_GT((*error)[i], 0.0);
        EXPECT_LT((*error)[i], (*lux)[i]);
    }
    const Result again = run({"verify", "cornell-box", "--points", "20", "--paths", "256", "--threads", "1",
                              "--quiet", "-o", path("again.csv")});
    ASSERT_EQ(again.code, 0);
    EXPECT_EQ(again.out + again.err, "");
    EXPECT_EQ(read("again.csv"), read("r.csv")) << "not a matter of threads";
}

TEST_F(Verify, ComparesWhatWasMeasured) {
    ASSERT_EQ(run({"measure", "cornell-box", "--grid", "floor,0.1", "-o", path("m.csv"), "--quiet"}).code, 0);
    const Result result = run({"verify", "cornell-box", "--compare", path("m.csv"), "--precision", "2%",
                               "--json", "-o", path("r.json")});
    ASSERT_EQ(result.code, 0) << result.err;
    const nlohmann::json report = nlohmann::json::parse(result.out);
    const nlohmann::json agreement = report.at("agreement");
    EXPECT_LE(report.at("reference").at("standardError"), 0.02);
    EXPECT_LT(agreement.at("rms"), 0.03);
    EXPECT_GE(agreement.at("held").get<double>(), 0.95 * agreement.at("sensors").get<double>());
    EXPECT_EQ(agreement.at("worst").size(), 5u);
    EXPECT_EQ(agreement.at("worst").at(0).at("place"), "on floor");
    const nlohmann::json traced = nlohmann::json::parse(read("r.json"));
    EXPECT_EQ(traced.at("sensors").size(), agreement.at("sensors").get<std::size_t>());
    EXPECT_GT(traced.at("sensors").at(0).at("luxStandardError"), 0.0);
}

TEST_F(Verify, SolvesWhereNothingWasMeasured) {
    const Result result =
        run({"verify", "squares-parallel", "--points", "30", "--paths", "4096", "--compare"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("the solution against the reference at 30 sensors"), std::string::npos)
        << result.out;
    const std::string sensors = write("in.csv", "x,y,z,nx,ny,nz\n0.1,0,0.1,0,1,0\n0.1,0.2,0.1,0,1,0\n");
    const Result named = run({"verify", "cornell-box", "--sensors", sensors, "--paths", "512", "--compare"});
    ASSERT_EQ(named.code, 0) << named.err;
    EXPECT_NE(named.out.find("the reference at 2 sensors"), std::string::npos) << named.out;
}

// A wrong table is told from a right one.
TEST_F(Verify, FindsWhatDoesNotAgree) {
    ASSERT_EQ(run({"measure", "cornell-box", "--grid", "floor,0.15", "-o", path("m.csv"), "--quiet"}).code,
              0);
    io::SensorTable table = io::readSensorTable(path("m.csv"));
    for (io::SensorColumn& column : table.columns) {
        for (double& value : column.values) {
            value *= column.name == "solid" ? 1.0 : 1.3;
        }
    }
    io::writeSensorTable(path("wrong.csv"), table);
    const Result result =
        run({"verify", "cornell-box", "--compare", path("wrong.csv"), "--precision", "1%", "--json"});
    const nlohmann::json agreement = nlohmann::json::parse(result.out).at("agreement");
    EXPECT_NEAR(agreement.at("bias"), 0.3, 0.03);
    EXPECT_LE(agreement.at("held").get<double>(), 0.2 * agreement.at("sensors").get<double>());
}

TEST_F(Verify, DrawsDifferences) {
    const Result result =
        run({"verify", "squares-parallel", "--eye", "0.5,0.5,3", "--target", "0.5,0.5,0.5", "--size", "40x30",
             "--paths", "64", "-o", path("d.png"), "--report", path("d.json")});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(read("d.png").substr(1, 3), "PNG");
    EXPECT_LT(nlohmann::json::parse(read("d.json")).at("agreement").at("rms"), 0.5);
    const Result still =
        run({"verify", "cornell-box", "--camera", "front", "--size", "24x24", "--still", "--blur", "1",
             "--error", "10%", "--paths", "1024", "-o", path("s.png"), "--report", path("s.json")});
    ASSERT_EQ(still.code, 0) << still.err;
    EXPECT_EQ(read("s.png").substr(1, 3), "PNG");
    EXPECT_LT(nlohmann::json::parse(read("s.json")).at("agreement").at("rms"), 0.03);
    // From above, outside of the box, its dark outer side alone is seen.
    expectFailure({"verify", "cornell-box", "--eye", "0.3,3,0.3", "--target", "0.3,0,0.3", "--size", "8x8",
                   "--error", "30%", "--quiet", "-o", path("dark.png")},
                  ExitCode::usage, "sees nothing that light reaches");
}

TEST_F(Verify, MeasuresGridsWithStatisticsAndPlan) {
    const Result result = run({"measure", "two-rooms", "--grid", "plane:y=0.8,0.4", "--plan", path("p.png"),
                               "-o", path("m.json"), "--error", "5%"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("U0"), std::string::npos);
    EXPECT_NE(result.out.find("lie in solids"), std::string::npos);
    EXPECT_EQ(read("p.png").substr(1, 3), "PNG");
    const nlohmann::json json = nlohmann::json::parse(read("m.json"));
    const nlohmann::json statistics = json.at("statistics");
    double sum = 0.0;
    double least = 1e9;
    std::size_t count = 0;
    for (const nlohmann::json& sensor : json.at("sensors")) {
        if (sensor.at("place") != "solid") {
            ++count;
            sum += sensor.at("lux").get<double>();
            least = std::min(least, sensor.at("lux").get<double>());
            EXPECT_LE(sensor.at("interval").at(0), sensor.at("lux"));
            EXPECT_GE(sensor.at("interval").at(1), sensor.at("lux"));
        }
    }
    EXPECT_EQ(statistics.at("count"), count);
    EXPECT_NEAR(statistics.at("mean"), sum / static_cast<double>(count), 1e-6);
    EXPECT_NEAR(statistics.at("uniformity"), least / (sum / static_cast<double>(count)), 1e-9);
    EXPECT_EQ(json.at("sensors").size(), count + statistics.at("inSolids").get<std::size_t>());
}

TEST_F(Verify, SensorsInSolidsAreMeasuredAndFlagged) {
    const std::string sensors = write("in.csv", "x,y,z,nx,ny,nz\n0.1,0.2,0.1,0,1,0\n0.37,0.2,0.35,0,1,0\n");
    const Result result = run({"measure", "cornell-box", "--sensors", sensors, "-o", path("m.csv")});
    ASSERT_EQ(result.code, 0) << result.err;
    const io::SensorTable table = io::readSensorTable(path("m.csv"));
    EXPECT_EQ((*table.find("solid"))[0], 0.0);
    EXPECT_EQ((*table.find("solid"))[1], 1.0);
    EXPECT_GT((*table.find("lux"))[0], 100.0);
    EXPECT_NE(result.out.find("1 more lie in solids"), std::string::npos);
}

TEST_F(Verify, InterruptKeepsWhatIsDone) {
    std::thread interrupter([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        kill(getpid(), SIGINT);
    });
    const Result result =
        run({"verify", "cornell-box", "--points", "10", "--paths", "1000000000", "-o", path("r.csv")});
    interrupter.join();
    EXPECT_EQ(result.code, static_cast<int>(ExitCode::interrupted)) << result.err;
    EXPECT_EQ(io::readSensorTable(path("r.csv")).sensors.size(), 10u);
}

TEST_F(Verify, BadInputGetsOneClearError) {
    const std::string empty = write("empty.csv", "x,y,z,nx,ny,nz\n");
    const std::string zero = write("zero.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,0\n");
    const std::string plain = write("plain.csv", "x,y,z,nx,ny,nz\n0.1,0,0.1,0,1,0\n");
    const std::string shortRow = write("short.csv", "x,y,z,nx,ny,nz,lux\n0.1,0,0.1,0,1,0\n");
    expectFailure({"verify", "cornell-box", "--sensors", empty}, ExitCode::badInput, "holds no sensors");
    expectFailure({"verify", "cornell-box", "--sensors", zero}, ExitCode::badInput,
                  "line 2: the normal is zero");
    expectFailure({"verify", "cornell-box", "--compare", plain, "--sensors", plain}, ExitCode::usage,
                  "brings its own sensors");
    expectFailure({"verify", "cornell-box", "--compare", plain}, ExitCode::badInput, "has no column lux");
    expectFailure({"verify", "cornell-box", "--compare", shortRow}, ExitCode::badInput,
                  "line 2: has no value for lux");
    expectFailure({"verify", "cornell-box", "--grid", "flor,0.1"}, ExitCode::usage, "did you mean 'floor'?");
    expectFailure({"measure", "cornell-box", "--grid", "flor,0.1", "-o", path("o.csv")}, ExitCode::usage,
                  "did you mean 'floor'?");
    expectFailure({"measure", "cornell-box", "--grid", "plane:y=0.3,0.001", "-o", path("o.csv"), "--plan",
                   path("missing") + "/p.png"},
                  ExitCode::cannotWrite, "p.png");
    expectFailure({"measure", "building:10000", "--grid", "plane:y=0.8,0.001", "-o", path("o.csv")},
                  ExitCode::usage, "at most 1000000 are possible");
    expectFailure(
        {"measure", "cornell-box", "--grid", "floor,0.1", "--plan", path("p.png"), "-o", path("o.csv")},
        ExitCode::usage, "--plan: only a grid over a plane");
    expectFailure({"measure", "cornell-box", "-o", path("o.csv")}, ExitCode::usage, "--sensors");
    expectFailure({"verify", "cornell-box", "--camera", "door", "-o", path("d.png")}, ExitCode::usage,
                  "has no camera 'door'");
    expectFailure({"verify", "cornell-box", "-o", path("d.png")}, ExitCode::usage, "needs --camera");
    expectFailure({"verify", "cornell-box", "--still", "-o", path("d.csv")}, ExitCode::usage,
                  "only with a camera");
    expectFailure({"verify", "cornell-box", "--camera", "front", "--blur", "-1", "-o", path("d.png")},
                  ExitCode::usage, "--blur");
    expectFailure({"verify", "cornell-box", "--eye", "0,0,0", "--target", "1,1,1", "--size", "4000x4000",
                   "-o", path("d.png")},
                  ExitCode::usage, "more than 2000000 pixels");
    expectFailure({"verify", "cornell-box", "--precision", "0"}, ExitCode::usage, "--precision");
    expectFailure({"verify", "cornell-box", "--paths", "1"}, ExitCode::usage, "--paths");
    expectFailure({"verify", "cornell-box", "-o", path("missing") + "/r.csv"}, ExitCode::cannotWrite,
                  "r.csv");
}

TEST_F(Verify, AFullDiskLeavesNothingBehind) {
    if (access("/dev/full", W_OK) != 0) {
        GTEST_SKIP() << "no /dev/full";
    }
    const Result result =
        run({"verify", "cornell-box", "--points", "5", "--paths", "64", "--quiet", "-o", "/dev/full"});
    EXPECT_EQ(result.code, static_cast<int>(ExitCode::cannotWrite)) << result.err;
}

}  // namespace
}  // namespace fluxwalk::cli
