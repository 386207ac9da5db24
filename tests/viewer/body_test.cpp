#include "viewer/ui/body.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/scene/builders.h"
#include "tests/viewer/test_room.h"
#include "viewer/app/first_view.h"
#include "viewer/app/floor.h"
#include "viewer/render/camera.h"
#include "viewer/ui/walker.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

constexpr double kFrame = 1.0 / 60.0;

/// A scene with somebody in it.
struct Visit {
    explicit Visit(scene::Scene shapes)
        : solid(std::make_shared<const scene::Scene>(std::move(shapes))),
          walls{solid.scene.get(), &solid.rays},
          walker(scene::Camera{}, solid.scene->bounds()) {}

    void enter(const Vec3d& eye, const Vec3d& target) {
        walker.jumpTo(render::lookAt(eye, target, 60.0));
        walker.movement = Movement::walk;
    }
    void go(double ahead, double right, double seconds, double frame = kFrame) {
        WalkInput input;
        input.ahead = ahead;
        input.right = right;
        for (double t = 0.0; t < seconds; t += frame) {
            walker.update(input, frame, &walls);
        }
    }
    void stand(double seconds) { go(0.0, 0.0, seconds); }
    Vec3d eye() const { return walker.camera().position; }

    app::Solid solid;
    Walls walls;
    Walker walker;
};

scene::Scene makePlates(std::initializer_list<std::array<base::Vec3, 4>> corners) {
    scene::LitMeshes meshes;
    for (const auto& c : corners) {
        meshes.push_back(
            std::make_shared<const scene::LitMesh>(testing::makeQuad(c[0], c[1], c[2], c[3], 1)));
    }
    return app::sceneOfMeshes(meshes);
}

/// Level plate of 20 m by 20 m at a height, from z on.
std::array<base::Vec3, 4> makeFloor(float y, float z) {
    return {{{-10, y, z + 20}, {10, y, z + 20}, {10, y, z}, {-10, y, z}}};
}

TEST(Body, StopsAtAWallAndSlidesAlongIt) {
    Visit gallery(scene::buildGallery());
    gallery.enter({2.0, 1.6, 4.5}, {2.0, 1.6, 0.0});
    gallery.go(1.0, 0.0, 20.0);
    const Vec3d stopped = gallery.eye();
    gallery.go(1.0, 0.0, 2.0);
    EXPECT_NEAR(glm::length(gallery.eye() - stopped), 0.0, 1e-6);
    EXPECT_LT(stopped.z, 3.5);
    // A body's width away, and not farther.
    const auto ahead = gallery.solid.rays.closest({base::Vec3(stopped), 0.0f, {0.0f, 0.0f, -1.0f}, 100.0f});
    ASSERT_TRUE(ahead);
    EXPECT_GT(ahead->t, 0.2f);
}

TEST(Body, AThinWallHoldsAtAnySpeedAndFrameRate) {
    // A floor, and a wall without thickness across it at z = 0.
    Visit visit(
        makePlates({makeFloor(0.0f, -10.0f), {{{-999, 0, 0}, {999, 0, 0}, {999, 3, 0}, {-999, 3, 0}}}}));
    for (const double frame : {1.0 / 240.0, kFrame, 0.1, 1.0, 5.0}) {
        for (const double speed : {0.1, 1.5, 100.0}) {
            visit.enter({0.0, 1.6, 2.0}, {0.3, 1.6, 0.0});
            visit.walker.speed = speed;
            visit.go(1.0, 0.0, 10.0, frame);
            EXPECT_GT(visit.eye().z, 0.2) << frame << ' ' << speed;
            EXPECT_NEAR(visit.eye().y, 1.6, 1e-3);
        }
    }
    // Along the wall the visitor goes on, at the speed that is left.
    visit.enter({0.0, 1.6, 0.5}, {1.0, 1.6, -0.5});
    visit.walker.speed = 1.5;
    visit.go(1.0, 0.0, 3.0);
    EXPECT_GT(visit.eye().x, 2.5);
    EXPECT_NEAR(visit.eye().z, 0.25, 0.02);
}

TEST(Body, IsTheSameEachTime) {
    Visit a(scene::buildGallery());
    Visit b(scene::buildGallery());
    for (Visit* visit : {&a, &b}) {
        visit->enter({2.0, 1.6, 4.5}, {9.0, 1.6, 1.0});
        visit->go(1.0, 0.3, 6.0);
    }
    EXPECT_EQ(a.eye(), b.eye());
}

TEST(Body, FallsSoftlyAndLands) {
    // A terrace 3 m above the ground ends at z = 0.
    Visit visit(makePlates({makeFloor(3.0f, 0.0f), makeFloor(0.0f, -20.0f)}));
    visit.enter({0.0, 4.6, 1.0}, {0.0, 4.6, 0.0});
    visit.walker.speed = 1.5;
    visit.go(1.0, 0.0, 0.5);
    EXPECT_NEAR(visit.eye().y, 4.6, 1e-3);
    visit.go(1.0, 0.0, 0.4);
    double lowest = visit.eye().y;
    double fastest = 0.0;
    for (int i = 0; i < 180; ++i) {
        const double before = visit.eye().y;
        visit.go(1.0, 0.0, kFrame);
        fastest = std::max(fastest, (before - visit.eye().y) / kFrame);
        lowest = std::min(lowest, visit.eye().y);
    }
    EXPECT_NEAR(visit.eye().y, 1.6, 1e-3);
    EXPECT_GT(lowest, 1.59);
    EXPECT_LT(fastest, 8.0);
    EXPECT_GT(fastest, 3.0);
}

TEST(Body, StaysWhereThereIsNoGroundAtAll) {
    Visit visit(makePlates({makeFloor(0.0f, 0.0f)}));
    visit.enter({0.0, 1.6, 1.0}, {0.0, 1.6, 0.0});
    visit.go(1.0, 0.0, 4.0);
    EXPECT_LT(visit.eye().z, -2.0);
    EXPECT_NEAR(visit.eye().y, 1.6, 1e-3);
}

TEST(Body, BendsBelowALowCeilingButDoesNotPassAHandrail) {
    Visit low(makePlates(
        {makeFloor(0.0f, -10.0f), {{{-10, 1.3f, -10}, {10, 1.3f, -10}, {10, 1.3f, 10}, {-10, 1.3f, 10}}}}));
    low.enter({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0});
    low.walker.eyeHeight = 1.6;
    low.stand(2.0);
    EXPECT_LT(low.eye().y, 1.29);
    EXPECT_GT(low.eye().y, 1.1);
    low.go(1.0, 0.0, 2.0);
    EXPECT_LT(low.eye().z, -0.8);
    // A rail 7 cm wide at .9 m between two level rays.
    Visit rail(
        makePlates({makeFloor(0.0f, -10.0f),
                    {{{-10, 0.9f, 0.07f}, {10, 0.9f, 0.07f}, {10, 0.9f, 0}, {-10, 0.9f, 0}}},
                    {{{-10, 0.95f, 0.07f}, {10, 0.95f, 0.07f}, {10, 0.95f, 0}, {-10, 0.95f, 0}}},
                    {{{-10, 0.9f, 0.07f}, {10, 0.9f, 0.07f}, {10, 0.95f, 0.07f}, {-10, 0.95f, 0.07f}}}}));
    rail.enter({0.0, 1.6, 2.0}, {0.2, 1.6, 0.0});
    rail.go(1.0, 0.0, 5.0);
    EXPECT_GT(rail.eye().z, 0.2);
    EXPECT_NEAR(rail.eye().y, 1.6, 1e-3);
}

TEST(Body, IsSmallInASmallModel) {
    Visit visit(scene::buildScene("cornell-box").value());
    const scene::Camera& front = visit.solid.scene->cameras.front();
    visit.enter({0.28, 0.25, 0.05}, {0.28, 0.25, 1.0});
    visit.go(1.0, 0.0, 30.0);
    const Vec3d eye = visit.eye();
    EXPECT_GT(glm::dot(front.forward, Vec3d(0.0, 0.0, 1.0)), 0.9);
    EXPECT_GT(eye.z, 0.1);
    EXPECT_LT(eye.z, 0.559 - 0.03);
    EXPECT_NEAR(eye.y, visit.walker.eyeHeight, 1e-3);
    EXPECT_LT(eye.y, 0.3);
}

class Building : public ::testing::Test {
  protected:
    Building() : visit_(scene::buildBuilding("building:10000")) {}

    Vec3d camera(const std::string& name) const {
        const auto& cameras = visit_.solid.scene->cameras;
        return std::find_if(cameras.begin(), cameras.end(), [&](const auto& c) { return c.name == name; })
            ->position;
    }

    Visit visit_;
};

TEST_F(Building, StairsAreClimbedAndDescended) {
    // The first flight begins 1 m ahead of this camera and 1.3 m to its side; it rises by half a storey.
    const Vec3d start = camera("stair well") + Vec3d(1.3, 0.0, 0.0);
    visit_.enter(start, start + Vec3d(0.0, 0.0, -1.0));
    visit_.stand(0.5);
    const double ground = visit_.eye().y;
    double highest = ground;
    for (int i = 0; i < 240; ++i) {
        const double before = visit_.eye().y;
        visit_.go(1.0, 0.0, kFrame);
        EXPECT_LT(std::abs(visit_.eye().y - before), 0.06);  // no jumps for the eyes
        highest = std::max(highest, visit_.eye().y);
    }
    EXPECT_NEAR(visit_.eye().y - ground, 1.5625, 0.01);
    EXPECT_NEAR(highest, visit_.eye().y, 0.02);
    visit_.go(-1.0, 0.0, 3.5);
    EXPECT_NEAR(visit_.eye().y, ground, 0.01);
    // The same at a run and five frames a second.
    visit_.walker.speed = 4.5;
    visit_.go(1.0, 0.0, 2.0, 0.2);
    visit_.stand(1.0);
    EXPECT_NEAR(visit_.eye().y - ground, 1.5625, 0.01);
}

TEST_F(Building, OpenDoorsArePassedAndClosedOnesAreNot) {
    int open = 0;
    int closed = 0;
    const auto& objects = visit_.solid.scene->objects;
    for (std::size_t i = 1; i < objects.size(); ++i) {
        const base::Box leaf = objects[i].surface->bounds();
        const bool isOpen = leaf.size().x < 0.4;
        const bool isClosed = leaf.size().z < 0.1;
        if (objects[i].name != "door" || !(isOpen || isClosed)) {
            continue;
        }
        (isOpen ? open : closed) += 1;
        // The leaf turns about the opening's lower end in x on the far side of the corridor, else about the
        // upper; from the middle of what it leaves, towards the room.
        const base::Box frame = objects[i - 1].surface->bounds();
        const double inwards = frame.lower.z > 1.0 ? 1.0 : -1.0;
        double from = frame.lower.x + 0.05;
        double to = frame.upper.x - 0.05;
        if (isOpen) {
            from = inwards > 0.0 ? std::max(from, leaf.upper.x) : from;
            to = inwards < 0.0 ? std::min(to, leaf.lower.x) : to;
        }
        const double threshold = inwards > 0.0 ? frame.upper.z : frame.lower.z;
        const Vec3d start(0.5 * (from + to), frame.lower.y + 1.6, threshold - inwards);
        visit_.walker.speed = 1.5;
        visit_.enter(start, start + Vec3d(0.0, 0.0, inwards));
        visit_.go(1.0, 0.0, 1.2);
        const double beyond = (visit_.eye().z - threshold) * inwards;
        if (isOpen) {
            EXPECT_GT(beyond, 0.3) << start.x;
        } else {
            EXPECT_LT(beyond, -0.2) << start.x;
        }
    }
    EXPECT_EQ(open, 2);
    EXPECT_EQ(closed, 3);
}

TEST_F(Building, NobodyEverLeavesItOrIsStuck) {
    const base::Box bounds = visit_.solid.scene->bounds();
    for (const scene::Camera& camera : visit_.solid.scene->cameras) {
        visit_.enter(camera.position, camera.position + camera.forward);
        base::RandomStream random(7);
        double farthest = 0.0;
        Vec3d from = visit_.eye();
        for (int i = 0; i < 60; ++i) {
            WalkInput input;
            input.turn = 2.0 * base::kPi * random.next();
            visit_.walker.update(input, kFrame, &visit_.walls);
            visit_.go(1.0, random.next() - 0.5, 0.8, 0.1);
            farthest = std::max(farthest, glm::length(visit_.eye() - from));
            from = visit_.eye();
            ASSERT_TRUE(glm::all(glm::greaterThan(from, bounds.lower)) &&
                        glm::all(glm::lessThan(from, bounds.upper)))
                << from.x << ' ' << from.y << ' ' << from.z;
        }
        EXPECT_GT(farthest, 0.5);
        // The last place has a way out too.
        double best = 0.0;
        for (int i = 0; i < 16; ++i) {
            const double angle = base::kPi * i / 8.0;
            visit_.enter(from, from + Vec3d(std::cos(angle), 0.0, std::sin(angle)));
            visit_.go(1.0, 0.0, 0.5);
            best = std::max(best, glm::length(visit_.eye() - from));
        }
        EXPECT_GT(best, 0.3);
    }
}

}  // namespace
}  // namespace fluxwalk::ui
