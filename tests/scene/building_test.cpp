#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/rays/ray_scene.h"
#include "core/reference/path_tracer.h"
#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"
#include "core/surface/region.h"

namespace fluxwalk {
namespace {

using base::Vec3;
using base::Vec3d;
using scene::Scene;

std::size_t patchesOf(const Scene& scene) {
    std::size_t sum = 0;
    for (const scene::Object& object : scene.objects) {
        sum += object.surface->patchCount();
    }
    return sum;
}

std::size_t countNamed(const Scene& scene, std::string_view name) {
    return static_cast<std::size_t>(
        std::count_if(scene.objects.begin(), scene.objects.end(),
                      [name](const scene::Object& object) { return object.name == name; }));
}

TEST(Building, hasAboutAsManyPolygonsAsAskedFor) {
    for (const auto& [name, polygons] : {std::pair{"building:10000", 1e4},
                                         {"building:33333", 33333.0},
                                         {"building:90000", 9e4},
                                         {"building:300000", 3e5},
                                         {"building:10000:1", 1e4},
                                         {"building:10000:5", 1e4},
                                         {"building:10000:8", 1e4},
                                         {"building:100000:20", 1e5},
                                         {"building:300000:20", 3e5},
                                         {"building:300000:240", 3e5}}) {
        EXPECT_NEAR(static_cast<double>(patchesOf(scene::buildBuilding(name))), polygons, 0.1 * polygons)
            << name;
    }
}

TEST(Building, growsByRoomsOrByFinerFurniture) {
    const Scene small = scene::buildBuilding("building:20000");
    const Scene large = scene::buildBuilding("building:80000");
    EXPECT_GT(countNamed(large, "door"), 3 * countNamed(small, "door"));
    const std::string rooms = std::to_string(countNamed(small, "door"));
    const Scene same = scene::buildBuilding("building:20000:" + rooms);
    const Scene fine = scene::buildBuilding("building:80000:" + rooms);
    EXPECT_EQ(countNamed(same, "door"), countNamed(small, "door"));
    EXPECT_EQ(countNamed(fine, "door"), countNamed(small, "door"));
    EXPECT_EQ(fine.bounds().upper, same.bounds().upper);
    // Books and leaves have become more; walls are what they were.
    EXPECT_GT(countNamed(fine, "books"), countNamed(same, "books"));
    EXPECT_EQ(countNamed(fine, "wall"), countNamed(same, "wall"));
    for (std::size_t i = 0, j = 0; i < same.objects.size(); ++i) {
        if (same.objects[i].name == "wall") {
            while (fine.objects[j].name != "wall") {
                ++j;
            }
            ASSERT_EQ(fine.objects[j++].surface->patchCount(), same.objects[i].surface->patchCount());
        }
    }
}

// Each edge of a mesh has two faces that run along it in opposite directions. A lamp's panel is one face that
// closes the housing before it.
TEST(Building, everyMeshIsClosed) {
    for (const std::string_view name : {"building:10000", "building:60000:3"}) {
        const Scene building = scene::buildBuilding(name);
        const auto less = [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::set<std::string> open;
        std::set<std::string> inverted;
        for (std::size_t i = 0; i < building.objects.size(); ++i) {
            const bool hasPanel = i + 1 < building.objects.size() && building.objects[i + 1].name == "panel";
            std::map<Vec3, int, decltype(less)> points(less);
            std::map<std::pair<int, int>, int> edges;
            double volume = 0.0;
            for (std::size_t part = i; part <= i + (hasPanel ? 1 : 0); ++part) {
                const surface::TriangleView mesh = building.objects[part].surface->triangles();
                for (const auto& triangle : mesh.triangles) {
                    std::array<int, 3> c{};
                    for (std::size_t k = 0; k < 3; ++k) {
                        c[k] = points.try_emplace(mesh.positions[triangle[k]], points.size()).first->second;
                    }
                    for (std::size_t k = 0; k < 3; ++k) {
                        ++edges[{c[k], c[(k + 1) % 3]}];
                    }
                    volume += glm::dot(
                        Vec3d(mesh.positions[triangle[0]]),
                        glm::cross(Vec3d(mesh.positions[triangle[1]]), Vec3d(mesh.positions[triangle[2]])));
                }
            }
            for (const auto& [edge, count] : edges) {
                if (count != 1 || !edges.contains({edge.second, edge.first})) {
                    open.insert(building.objects[i].name);
                }
            }
            if (!edges.empty() && volume <= 0.0) {
                inverted.insert(building.objects[i].name);
            }
            i += hasPanel ? 1 : 0;
        }
        EXPECT_EQ(open, std::set<std::string>()) << name;
        EXPECT_EQ(inverted, std::set<std::string>()) << name;
    }
}

TEST(Building, noRayLeavesIt) {
    const Scene building = scene::buildBuilding("building:10000");
    const base::Executor executor(2);
    const rays::RayScene rays(building, executor);
    std::vector<std::uint32_t> lamps;
    for (std::uint32_t i = 0; i < building.objects.size(); ++i) {
        if (building.materials[building.objects[i].material].isEmissive()) {
            lamps.push_back(i);
        }
    }
    constexpr std::size_t kPaths = 1'000'000;
    constexpr unsigned kBounces = 5;
    std::vector<std::uint32_t> escaped((kPaths + 4095) / 4096, 0);
    executor.forRange(escaped.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            for (std::size_t path = block * 4096; path < std::min(kPaths, (block + 1) * 4096); ++path) {
                base::RandomStream random(base::combine(11, path));
                const surface::Surface& lamp = *building.objects[lamps[path % lamps.size()]].surface;
                const auto patch = static_cast<std::uint32_t>(random.next() * lamp.patchCount());
                surface::SurfacePoint at = lamp.evaluate(
                    patch, mapToRegion(surface::wholePatch(lamp.domain(patch)), random.next2()).uv);
                for (unsigned bounce = 0; bounce < kBounces; ++bounce) {
                    const double y = 1.0 - 2.0 * random.next();
                    const double turn = 2.0 * base::kPi * random.next();
                    const double flat = std::sqrt(std::max(0.0, 1.0 - y * y));
                    // Lambert's law: a point of the unit sphere about the tip of the normal.
                    const Vec3d direction =
                        at.normal + 0.999 * Vec3d(flat * std::cos(turn), y, flat * std::sin(turn));
                    const auto hit = rays.closest(rays.halfLine(at.position, at.normal, direction));
                    if (!hit) {
                        ++escaped[block];
                        break;
                    }
                    const surface::Surface& met = *building.objects[base::index(hit->object)].surface;
                    const Vec3d place = at.position + static_cast<double>(hit->t) * direction;
                    at = met.evaluate(hit->patch, met.locate(hit->patch, place));
                    at.normal = hit->back ? -at.normal : at.normal;
                }
            }
        }
    });
    std::uint32_t sum = 0;
    for (const std::uint32_t count : escaped) {
        sum += count;
    }
    EXPECT_EQ(sum, 0u);
}

// Flux and shares as published with the scene: at least 30 % of the light at sensors is indirect, and at
// least 10 % of those that get light get no direct light.
TEST(Building, isLitIndirectlyForAGoodPart) {
    const Scene building = scene::buildBuilding("building:10000");
    Scene black = building;
    for (scene::Material& material : black.materials) {
        material.reflectance = base::Rgb(0.0f);
    }
    const base::Executor executor(2);
    const rays::RayScene rays(building, executor);
    const rays::RayScene blackRays(black, executor);
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < building.objects.size(); ++i) {
        sides.push_back({i, false});
    }
    // Half of the area is hidden between solids: more sensors than the 1,000 that light reaches.
    const auto sensors = reference::randomSensors(building, sides, 3200, reference::kBenchmarkSeed);
    const auto all = reference::traceIrradiance(building, rays, executor, sensors, {3, 512});
    const auto direct = reference::traceIrradiance(black, blackRays, executor, sensors, {4, 512});
    double sum = 0.0;
    double directSum = 0.0;
    std::size_t lit = 0;
    std::size_t unlitDirectly = 0;
    for (std::size_t i = 0; i < sensors.size() && lit < reference::kBenchmarkSensors; ++i) {
        const double e = base::luminance(all.irradiance[i].mean);
        ASSERT_TRUE(std::isfinite(e));
        if (e <= 0.0) {
            continue;
        }
        ++lit;
        sum += e;
        const double d = base::luminance(direct.irradiance[i].mean);
        directSum += d;
        unlitDirectly += d == 0.0 ? 1 : 0;
    }
    ASSERT_EQ(lit, reference::kBenchmarkSensors);
    RecordProperty("indirect", std::to_string(1.0 - directSum / sum));
    RecordProperty("withoutDirect", std::to_string(unlitDirectly));
    EXPECT_GE(1.0 - directSum / sum, 0.3);
    EXPECT_GE(unlitDirectly, 100u);
    // A room is as bright as rooms are.
    EXPECT_GT(sum / static_cast<double>(lit), 30.0);
    EXPECT_LT(sum / static_cast<double>(lit), 1000.0);
}

TEST(Building, isTheSameEveryTime) {
    const Scene once = scene::buildBuilding("building:12000");
    const Scene again = scene::buildBuilding("building:12000");
    ASSERT_EQ(once.objects.size(), again.objects.size());
    for (std::size_t i = 0; i < once.objects.size(); ++i) {
        ASSERT_EQ(once.objects[i].name, again.objects[i].name);
        ASSERT_EQ(once.objects[i].material, again.objects[i].material);
        const auto a = once.objects[i].surface->triangles();
        const auto b = again.objects[i].surface->triangles();
        ASSERT_TRUE(
            std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end()));
    }
}

TEST(Building, refusesSizesByName) {
    const auto messageOf = [](std::string_view name) -> std::string {
        try {
            scene::buildScene(name);
        } catch (const base::UsageError& error) {
            return error.what();
        }
        return "";
    };
    for (const std::string_view name :
         {"building:", "building:9999", "building:2000001", "building:many", "building:-1", "building:1e5",
          "building:99999999999999", "building::3"}) {
        EXPECT_NE(messageOf(name).find("from 10000 to 2000000"), std::string::npos) << name;
    }
    for (const std::string_view name : {"building:10000:", "building:10000:0", "building:10000:9",
                                        "building:10000:x", "building:10000:1:1"}) {
        EXPECT_NE(messageOf(name).find("from 1 to 8"), std::string::npos) << name;
    }
    EXPECT_TRUE(scene::isBuiltInScene("building:90000"));
    EXPECT_FALSE(scene::isBuiltInScene("building"));
}

}  // namespace
}  // namespace fluxwalk
