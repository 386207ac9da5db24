#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/io/file.h"
#include "core/scene/builders.h"
#include "tests/bench/mesh_lookup.h"
#include "tests/bench/sensor_errors.h"
#include "tests/support/curved_room.h"

namespace fluxwalk::bench {
namespace {

std::filesystem::path temporaryFile(const std::string& name) {
    return std::filesystem::temp_directory_path() / (name + std::to_string(getpid()));
}

TEST(SensorErrors, figuresOfKnownDifferences) {
    // E* is 1, 2 and 3 in the channels of 99 sensors and a tenth of that in one, which is dark; E is 10 %
    // more throughout.
    std::vector<ReferencePoint> reference(100, {{}, Vec3d(1, 2, 3), Vec3d(0.0)});
    reference[7].irradiance *= 0.03;
    std::vector<Rgb> values;
    for (const ReferencePoint& point : reference) {
        values.emplace_back(1.1 * point.irradiance);
    }
    values[7] = Rgb(0.5f);
    const ErrorFigures e = compare(values, reference);
    const double mean = (99.0 + 0.03) * 2.0 / 100.0;
    const Vec3d dark = Vec3d(0.5) - reference[7].irradiance;
    const double squares = 99.0 * 0.01 * 14.0 + glm::dot(dark, dark);
    EXPECT_NEAR(e.rms, std::sqrt(squares / 300.0) / mean, 1e-7);
    EXPECT_NEAR(e.p95, 0.1, 1e-6);
    EXPECT_NEAR(e.bias, (99.0 * 0.6 + dark.x + dark.y + dark.z) / 300.0 / mean, 1e-7);
}

TEST(SensorErrors, noiseOfTheReferenceIsTakenOff) {
    // The truth is 10; the reference is off by normal noise of deviation 0.1, the values by half of that.
    constexpr double kPi = 3.14159265358979;
    base::RandomStream random(1);
    const auto normal = [&] {
        return std::sqrt(-2.0 * std::log(1.0 - random.next())) * std::cos(2.0 * kPi * random.next());
    };
    std::vector<ReferencePoint> reference;
    std::vector<Rgb> exact;
    std::vector<Rgb> values;
    for (int i = 0; i < 20000; ++i) {
        reference.push_back({{}, Vec3d(10.0) + 0.1 * Vec3d(normal(), normal(), normal()), Vec3d(0.1)});
        exact.emplace_back(10.0f);
        values.emplace_back(Vec3d(10.0) + 0.05 * Vec3d(normal(), normal(), normal()));
    }
    EXPECT_NEAR(compare(values, reference).rms, 0.005, 0.0002);
    const NoiseFigures noise = noiseOf(reference);
    EXPECT_NEAR(noise.rms, 0.01, 0.0001);
    // The truth's own error against this reference is nothing but noise, here 1.96 %.
    EXPECT_NEAR(noise.p95, 0.0196, 0.0002);
    EXPECT_NEAR(compare(exact, reference).p95, noise.p95, 0.02 * noise.p95);
    EXPECT_LT(std::abs(compare(exact, reference).bias), 4.0 * noise.bias);
}

TEST(MeshLookup, isLinearOnTrianglesAndNothingBesideThem) {
    scene::LitMesh mesh;
    for (const base::Vec3 p : {base::Vec3(0, 0, 0), base::Vec3(0, 0, 1), base::Vec3(1, 0, 1),
                               base::Vec3(1, 0, 0), base::Vec3(1, 1, 1), base::Vec3(1, 1, 0)}) {
        mesh.positions.push_back(p);
        mesh.irradiance.push_back(2.0f * p + base::Vec3(1.0f));
    }
    mesh.triangles = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};  // a floor and a wall
    const base::Executor executor(1);
    const MeshLookup lookup(mesh, 1e-6, executor);
    base::RandomStream random(2);
    for (int i = 0; i < 1000; ++i) {
        const base::Vec2d st = random.next2();
        for (const bool isFloor : {true, false}) {
            const Vec3d p = isFloor ? Vec3d(st.x, 0, st.y) : Vec3d(1, st.x, st.y);
            const auto found = lookup.irradiance(p, isFloor ? Vec3d(0, 1, 0) : Vec3d(-1, 0, 0));
            ASSERT_TRUE(found);
            EXPECT_LT(glm::distance(Vec3d(*found), 2.0 * p + Vec3d(1.0)), 1e-5);
        }
    }
    EXPECT_FALSE(lookup.irradiance(Vec3d(0.5, 0.1, 0.5), Vec3d(0, 1, 0)));
    EXPECT_FALSE(lookup.irradiance(Vec3d(0.5, 0, 0.5), Vec3d(0, -1, 0)));
}

TEST(Reference, isReadAsItWasWritten) {
    const scene::Scene scene = *scene::buildScene("cornell-box");
    const Reference made = traceReference(scene, 16, 2);
    // The blocks stand on 0.055 m2 of the 2.2 m2 of reached sides: 25 of 1,000, with a deviation of 5.
    EXPECT_NEAR(static_cast<double>(made.hiddenCount), 25.0, 15.0);
    const std::filesystem::path file = temporaryFile("reference");
    writeReference(file, made);
    const Reference read = readReference(file);
    std::filesystem::remove(file);
    EXPECT_EQ(read.hiddenCount, made.hiddenCount);
    ASSERT_EQ(read.points.size(), made.points.size());
    for (std::size_t i = 0; i < read.points.size(); ++i) {
        const ReferencePoint& a = made.points[i];
        const ReferencePoint& b = read.points[i];
        EXPECT_LT(glm::distance(a.sensor.position, b.sensor.position), 1e-8);
        EXPECT_LT(glm::distance(a.sensor.normal, b.sensor.normal), 1e-8);
        EXPECT_LE(glm::distance(a.irradiance, b.irradiance), 1e-6 * glm::length(a.irradiance));
        EXPECT_LE(glm::distance(a.standardError, b.standardError), 1e-2 * glm::length(a.standardError));
    }
}

TEST(Reference, refusesTablesWithoutErrors) {
    const std::filesystem::path file = temporaryFile("sensors");
    io::writeFile(file, "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n");
    EXPECT_THROW(readReference(file), base::FileError);
    std::filesystem::remove(file);
}

// With no more links than BF the bounded oracle leaves at most half its error, in a room of curved objects
// that a lamp lights from one side.
TEST(CurvedRoom, boundedOracleHalvesTheErrorOfBf) {
    const Reference reference =
        readReference(std::filesystem::path(FLUXWALK_SOURCE_DIR) / "tests/bench/reference/curved-room.csv");
    const auto scene = std::make_shared<const scene::Scene>(test::buildCurvedRoom());
    struct Result {
        std::uint64_t links = 0;
        double gathered = 0.0;
        double displayed = 0.0;
    };
    const auto solve = [&](solve::OracleKind oracle, double threshold) {
        solve::Options options;
        options.oracle = oracle;
        options.threshold = threshold;
        solve::Solver solver(scene, options, 2);
        solver.solve({});
        const SensorErrors errors(solver.problem(), reference.points);
        return Result{solver.statistics().counters.links, errors.ofGathered(solver).rms,
                      errors.ofMeshes(solver.litMeshes(), solver.problem().executor).rms};
    };
    const Result bounded = solve(solve::OracleKind::bounded, 0.002);
    const Result bf = solve(solve::OracleKind::bf, 3.3);
    EXPECT_LE(bounded.links, bf.links);
    EXPECT_LT(2.0 * bounded.gathered, bf.gathered);
    EXPECT_LT(2.0 * bounded.displayed, bf.displayed);
}

}  // namespace
}  // namespace fluxwalk::bench
