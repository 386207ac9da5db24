#include "core/cli/report.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/cli/output.h"

namespace fluxwalk::cli {
namespace {

Report makeReport() {
    Report report;
    report.command = "solve";
    report.scene.name = "room";
    report.scene.objects = 3;
    report.scene.emitters.push_back({.object = "lamp", .area = 0.5, .flux = {1.0, 2.0, 3.0}, .lumens = 2.5});
    report.scene.bounds.extend(base::Vec3d(0.0));
    report.scene.bounds.extend(base::Vec3d(1.0, 2.0, 3.0));
    report.scene.warnings = {"a warning"};
    report.arguments.options.error = 0.05;
    report.arguments.options.oracle = solve::OracleKind::bfa;
    report.arguments.threads = 2;
    report.outcome = solve::Outcome::reachedError;
    solve::Statistics& s = report.statistics;
    s.counters.nodes = 10;
    s.counters.links = 100;
    s.counters.rays = 1ULL << 40;
    s.counters.bytesNodes = 1500;
    s.counters.bytesLinks = 1600;
    s.times.total = 1.5;
    s.audit.emitted = base::Vec3d(10.0);
    s.audit.absorbed = base::Vec3d(9.0);
    s.audit.escaped = base::Vec3d(1.0);
    s.estimatedError = 0.04;
    s.meanIrradiance = 123.0;
    s.history.push_back({.seconds = 0.5, .threshold = 2.0, .residual = 0.1, .error = -1.0, .links = 50});
    report.outputs = {"out.glb"};
    return report;
}

TEST(Report, HoldsWhatWasAskedAndAchieved) {
    const nlohmann::ordered_json json = toJson(makeReport());
    EXPECT_EQ(json.at("command"), "solve");
    EXPECT_EQ(json.at("outcome"), "reachedError");
    EXPECT_EQ(json.at("options").at("error"), 0.05);
    EXPECT_EQ(json.at("options").at("oracle"), "bfa");
    EXPECT_EQ(json.at("options").at("row-scaling"), false);
    EXPECT_EQ(json.at("options").at("seed"), 1);
    EXPECT_EQ(json.at("options").at("threads"), 2);
    EXPECT_EQ(json.at("estimatedError"), 0.04);
    EXPECT_EQ(json.at("meanIrradiance"), 123.0);
    EXPECT_EQ(json.at("outputs").at(0), "out.glb");
    EXPECT_EQ(json.at("seconds").at("total"), 1.5);
}

TEST(Report, CountersAreWholeAndSizesArePerPiece) {
    const nlohmann::ordered_json counters = toJson(makeReport()).at("counters");
    EXPECT_EQ(counters.at("rays"), 1ULL << 40);
    EXPECT_TRUE(counters.at("rays").is_number_unsigned());
    EXPECT_EQ(counters.at("bytesPerNode"), 150.0);
    EXPECT_EQ(counters.at("bytesPerLink"), 16.0);
}

TEST(Report, AuditBalances) {
    const nlohmann::ordered_json audit = toJson(makeReport()).at("audit");
    EXPECT_EQ(audit.at("emitted").at(1), 10.0);
    EXPECT_NEAR(audit.at("relativeDefect").get<double>(), 0.0, 1e-12);
}

TEST(Report, UnknownNumbersAreNull) {
    Report report = makeReport();
    report.statistics.estimatedError = -1.0;
    report.statistics.counters.links = 0;
    const nlohmann::ordered_json json = toJson(report);
    EXPECT_TRUE(json.at("estimatedError").is_null());
    EXPECT_TRUE(json.at("counters").at("bytesPerLink").is_null());
    EXPECT_TRUE(json.at("history").at(0).at("error").is_null());
    EXPECT_EQ(json.at("history").at(0).at("links"), 50);
}

TEST(Report, DescribesTheScene) {
    const nlohmann::ordered_json scene = toJson(makeReport()).at("scene");
    EXPECT_EQ(scene.at("name"), "room");
    EXPECT_EQ(scene.at("emitters").at(0).at("lumens"), 2.5);
    EXPECT_EQ(scene.at("bounds").at("upper"), nlohmann::ordered_json({1.0, 2.0, 3.0}));
    EXPECT_EQ(scene.at("warnings").at(0), "a warning");
}

TEST(Report, TextSurvivesBytesThatAreNoUtf8) {
    Report report = makeReport();
    report.scene.name = "caf\xe9";
    const std::string text = toText(toJson(report));
    EXPECT_TRUE(text.ends_with("}\n"));
    EXPECT_EQ(nlohmann::json::parse(text).at("command"), "solve");
}

TEST(Report, SummaryIsForPeople) {
    const std::string summary = formatSummary(makeReport());
    EXPECT_NE(summary.find("4 % of the mean, 5 % requested\n"), std::string::npos) << summary;
    EXPECT_NE(summary.find("123 lux"), std::string::npos) << summary;
    Report stopped = makeReport();
    stopped.outcome = solve::Outcome::stopped;
    stopped.statistics.estimatedError = -1.0;
    EXPECT_NE(formatSummary(stopped).find("not estimated of the mean, 5 % requested (stopped before)"),
              std::string::npos)
        << formatSummary(stopped);
}

TEST(Report, DescriptionListsAFewAndCountsTheRest) {
    scene::SceneDescription scene = makeReport().scene;
    for (int i = 0; i < 40; ++i) {
        scene.emitters.push_back({.object = "lamp " + std::to_string(i)});
    }
    const std::string text = formatDescription(scene);
    EXPECT_NE(text.find("lamp 5:"), std::string::npos);
    EXPECT_EQ(text.find("lamp 30:"), std::string::npos);
    EXPECT_NE(text.find("and 29 more"), std::string::npos) << text;
    EXPECT_NE(text.find("a warning"), std::string::npos);
    EXPECT_EQ(toJson(scene).at("emitters").size(), 41u) << "JSON holds all";
}

TEST(Report, IsDeliveredAsAsked) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("fluxwalk_report_" + std::to_string(getpid()) + ".json");
    testing::internal::CaptureStdout();
    deliver(makeReport(), {.report = file, .json = true, .quiet = true});
    const std::string printed = testing::internal::GetCapturedStdout();
    std::ifstream stream(file);
    const nlohmann::ordered_json written = nlohmann::ordered_json::parse(stream);
    EXPECT_EQ(written, nlohmann::ordered_json::parse(printed));
    EXPECT_EQ(written, toJson(makeReport()));
    std::filesystem::remove(file);

    testing::internal::CaptureStdout();
    deliver(makeReport(), {.report = {}, .json = false, .quiet = true});
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_THROW(deliver(makeReport(), {.report = "/no/such/folder/r.json", .json = false, .quiet = true}),
                 WriteError);
}

}  // namespace
}  // namespace fluxwalk::cli
