#include "core/image/inspect.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/io/sensors_csv.h"
#include "core/scene/builders.h"
#include "tests/image/measuring.h"

// What is said of a point that is looked at agrees with what else is known of it.

namespace fluxwalk {
namespace {

using base::Vec3d;

rays::Ray lookAlong(const Vec3d& from, const Vec3d& direction) {
    return {base::Vec3(from), 0.0f, base::Vec3(direction), std::numeric_limits<float>::max()};
}

/// Rays from the middle of a scene into all directions.
std::vector<rays::Ray> raysFromTheMiddle(const scene::Scene& scene, int count) {
    std::vector<rays::Ray> rays;
    base::RandomStream random(11);
    const Vec3d middle = scene.bounds().center();
    for (int i = 0; i < count; ++i) {
        const double y = 2.0 * random.next() - 1.0;
        const double angle = 2.0 * base::kPi * random.next();
        const double r = std::sqrt(1.0 - y * y);
        rays.push_back(lookAlong(middle, {r * std::cos(angle), y, r * std::sin(angle)}));
    }
    return rays;
}

TEST(Inspect, isWhatMeasureGivesAtThePrintedPoint) {
    for (const char* name : {"cornell-box", "lamp-box"}) {
        const auto solver = test::solveScene(*scene::buildScene(name), 0.1);
        const auto file = std::filesystem::temp_directory_path() / (std::string("inspect-") + name + ".csv");
        std::vector<image::Inspection> inspections;
        std::ofstream table(file);
        table << "x,y,z,nx,ny,nz\n";
        for (const rays::Ray& ray : raysFromTheMiddle(*solver->problem().scene, 40)) {
            if (auto inspection = image::inspectAlong(solver->problem(), ray)) {
                const Vec3d& p = inspection->point.position;
                const Vec3d& n = inspection->point.normal;
                std::array<char, 160> row{};
                std::snprintf(row.data(), row.size(), "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", p.x, p.y, p.z, n.x,
                              n.y, n.z);
                table << row.data();
                inspections.push_back(std::move(*inspection));
            }
        }
        table.close();
        ASSERT_GT(inspections.size(), 20u) << name;
        const auto measured = image::measure(*solver, io::readSensors(file));
        ASSERT_EQ(measured.size(), inspections.size());
        for (std::size_t i = 0; i < measured.size(); ++i) {
            EXPECT_EQ(measured[i], inspections[i].irradiance) << name << ' ' << i;
        }
        std::filesystem::remove(file);
    }
}

TEST(Inspect, contributorsAndLuminanceAddUp) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), 0.1);
    const solve::Problem& problem = solver->problem();
    int inspected = 0;
    for (const rays::Ray& ray : raysFromTheMiddle(*problem.scene, 30)) {
        const auto i = image::inspectAlong(problem, ray);
        if (!i) {
            continue;
        }
        ++inspected;
        Vec3d sum(0.0);
        float last = std::numeric_limits<float>::max();
        for (const image::Contributor& c : i->contributors) {
            sum += Vec3d(c.irradiance);
            EXPECT_LE(base::luminance(c.irradiance), last);
            last = base::luminance(c.irradiance);
            ASSERT_LT(c.index, problem.scene->objects.size());
        }
        EXPECT_NEAR(sum.g, static_cast<double>(i->irradiance.g), 1e-5 * sum.g);
        const scene::Material& material =
            problem.scene->materials[problem.scene->objects[i->object].material];
        const base::Rgb exitance =
            material.reflectance * i->irradiance + (i->back ? base::Rgb(0.0f) : material.emission);
        EXPECT_NEAR(static_cast<double>(i->luminance.g) * base::kPi, static_cast<double>(exitance.g),
                    1e-4 * static_cast<double>(exitance.g) + 1e-6);
    }
    EXPECT_GT(inspected, 20);
}

TEST(Inspect, connectionsAreTheLinksOfTheElementAndAllAboveIt) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), 0.1);
    const solve::Problem& problem = solver->problem();
    const auto i =
        image::inspectAlong(problem, lookAlong(problem.scene->bounds().center(), {0.1, -1.0, 0.2}));
    ASSERT_TRUE(i);
    const auto leaf =
        solve::findLeaf(problem, i->object, i->patch, i->back,
                        problem.scene->objects[i->object].surface->locate(i->patch, i->point.position));
    ASSERT_TRUE(leaf);
    std::size_t count = 0;
    for (base::NodeId id = *leaf; id != base::NodeId::none; id = problem.hierarchy.parent(id)) {
        count += problem.links.endingAt(id).size();
    }
    EXPECT_EQ(i->connections.size(), count);
    EXPECT_GT(count, 5u);
    // The element's own irradiance is nearly the sum of what its links bring, which are means over the nodes
    // that they end at.
    double sum = 0.0;
    for (const image::Connection& connection : i->connections) {
        sum += static_cast<double>(base::luminance(connection.irradiance));
    }
    EXPECT_NEAR(sum, static_cast<double>(base::luminance(i->irradiance)), 0.3 * sum);
    EXPECT_NEAR(i->area, static_cast<double>(problem.hierarchy.shape(*leaf).area), 1e-9);
    // The outline goes round the point.
    base::Box box;
    for (const base::Vec3& p : i->outline) {
        box.extend(Vec3d(p));
    }
    EXPECT_LE(box.lower.x, i->point.position.x + 1e-5);
    EXPECT_GE(box.upper.x, i->point.position.x - 1e-5);
}

TEST(Inspect, looksThroughSidesWithoutLight) {
    // From outside, the walls of the lamp box are not lit: what is shown, and met, lies behind them.
    const auto solver = test::solveScene(*scene::buildScene("lamp-box"), 0.3);
    const base::Box bounds = solver->problem().scene->bounds();
    const Vec3d from = bounds.center() + Vec3d(0.03, 2.0 * bounds.diagonal(), 0.02);
    const auto i = image::inspectAlong(solver->problem(), lookAlong(from, {0.0, -1.0, 0.0}));
    ASSERT_TRUE(i);
    EXPECT_GT(base::luminance(i->irradiance), 0.0f);
    EXPECT_FALSE(image::inspectAlong(solver->problem(), lookAlong(from, {0.0, 1.0, 0.0})));
}

}  // namespace
}  // namespace fluxwalk
