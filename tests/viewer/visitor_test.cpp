#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "viewer/app/picture_sequence.h"
#include "viewer/app/recorder.h"
#include "viewer/app/state_folder.h"
#include "viewer/app/visitor_book.h"
#include "viewer/ui/keys.h"

namespace fluxwalk::app {
namespace {

class Book : public ::testing::Test {
  protected:
    Book() { std::filesystem::remove_all(folder_); }
    ~Book() override { std::filesystem::remove_all(folder_); }

    static std::string textOf(const std::filesystem::path& file) {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("fluxwalk-book-" + std::to_string(getpid()));
};

TEST_F(Book, BookmarksBelongToTheirScene) {
    scene::Camera camera;
    camera.position = {1, 2, 3};
    VisitorBook book(folder_);
    book.openScene(7);
    EXPECT_EQ(book.keep(camera), "View 1");
    EXPECT_EQ(book.keep(camera), "View 2");
    book.forget(0);
    EXPECT_EQ(book.keep(camera), "View 1");
    VisitorBook again(folder_);
    again.openScene(7);
    ASSERT_EQ(again.bookmarks().size(), 2u);
    EXPECT_EQ(again.bookmarks()[0].name, "View 2");
    EXPECT_EQ(again.bookmarks()[1].position, camera.position);
    again.openScene(8);
    EXPECT_TRUE(again.bookmarks().empty());
}

TEST_F(Book, WhatCannotBeReadIsNamedAndLeftUntouched) {
    {
        VisitorBook book(folder_);
        book.openScene(0xabc);
        book.keep(scene::Camera{});
        book.readRecentFiles();
        book.remember("/a.glb");
    }
    const auto bookmarks = folder_ / "bookmarks" / "0000000000000abc.json";
    const auto recent = folder_ / "recent.json";
    for (const auto& file : {bookmarks, recent}) {
        ASSERT_TRUE(std::filesystem::exists(file)) << file;
        std::ofstream(file) << "{ \"mine\": 1 }";
    }
    VisitorBook book(folder_);
    try {
        book.openScene(0xabc);
        ADD_FAILURE();
    } catch (const base::FileError& error) {
        EXPECT_EQ(error.file(), bookmarks.string());
    }
    EXPECT_THROW(book.keep(scene::Camera{}), base::FileError);
    EXPECT_THROW(book.readRecentFiles(), base::FileError);
    EXPECT_THROW(book.remember("/b.glb"), base::FileError);
    EXPECT_EQ(textOf(bookmarks), "{ \"mine\": 1 }");
    EXPECT_EQ(textOf(recent), "{ \"mine\": 1 }");
}

TEST_F(Book, RemembersTheLastTenFiles) {
    VisitorBook book(folder_);
    book.readRecentFiles();
    for (int i = 0; i < 12; ++i) {
        book.remember("/scenes/" + std::to_string(i) + ".glb");
    }
    book.remember("/scenes/x/../5.glb");
    VisitorBook again(folder_);
    again.readRecentFiles();
    ASSERT_EQ(again.recentFiles().size(), VisitorBook::kMostRecent);
    EXPECT_EQ(again.recentFiles()[0], "/scenes/5.glb");
    EXPECT_EQ(again.recentFiles()[1], "/scenes/11.glb");
    EXPECT_EQ(std::count(again.recentFiles().begin(), again.recentFiles().end(), "/scenes/5.glb"), 1);
}

TEST_F(Book, PathsGetNamesOfTheirOwn) {
    const VisitorBook book(folder_);
    const scene::CameraPath path{{0.0, {}}};
    EXPECT_NE(book.savePath(path), book.savePath(path));
    const VisitorBook nowhere(std::nullopt);
    EXPECT_THROW(nowhere.savePath(path), base::UsageError);
    std::ofstream(folder_ / "file") << "x";
    EXPECT_THROW(VisitorBook(folder_ / "file").savePath(path), base::FileError);
}

TEST(StateFolder, FollowsTheEnvironment) {
    const char* home = std::getenv("HOME");
    const std::string before = home != nullptr ? home : "/";
    setenv("XDG_STATE_HOME", "/state", 1);
    setenv("HOME", "/home/me", 1);
    EXPECT_EQ(findStateFolder(), "/state/fluxwalk");
    setenv("XDG_STATE_HOME", "relative", 1);
    EXPECT_EQ(findStateFolder(), "/home/me/.local/state/fluxwalk");
    unsetenv("XDG_STATE_HOME");
    unsetenv("HOME");
    EXPECT_FALSE(findStateFolder());
    setenv("HOME", before.c_str(), 1);
}

TEST(Recorder, NotesMovementsAndRests) {
    Recorder recorder;
    scene::Camera camera;
    recorder.begin(camera, 100.0);
    for (int i = 1; i <= 400; ++i) {
        const double t = i / 100.0;
        // Moves for a second, rests for two, moves for one.
        camera.position.x = t < 1.0 ? t : t < 3.0 ? 1.0 : t - 2.0;
        recorder.follow(camera, 100.0 + t);
    }
    const scene::CameraPath path = recorder.end(camera, 104.0);
    EXPECT_FALSE(recorder.isRecording());
    EXPECT_NEAR(scene::durationOf(path), 4.0, 1e-9);
    EXPECT_LT(path.size(), 18u);
    EXPECT_NEAR(scene::cameraAt(path, 0.5).position.x, 0.5, 0.02);
    EXPECT_NEAR(scene::cameraAt(path, 2.0).position.x, 1.0, 1e-12);
    EXPECT_NEAR(scene::cameraAt(path, 3.5).position.x, 1.5, 0.02);
    Playback playback;
    playback.begin(path, 10.0);
    EXPECT_NEAR(playback.follow(11.5).position.x, 1.0, 1e-12);
    EXPECT_TRUE(playback.isPlaying());
    EXPECT_NEAR(playback.follow(20.0).position.x, 2.0, 1e-9);
    EXPECT_FALSE(playback.isPlaying());
}

TEST(PictureSequence, NumbersItsFiles) {
    EXPECT_EQ(PictureSequence("a/walk_%04d.png").file(7), "a/walk_0007.png");
    EXPECT_EQ(PictureSequence("%d%%.png").file(12), "12%.png");
    EXPECT_EQ(PictureSequence("%02d.png").file(1234), "1234.png");
    for (const char* bad :
         {"walk.png", "%s.png", "%d_%d.png", "%", "%4d.png", "%099d.png", "%04", "100%.png"}) {
        EXPECT_THROW(PictureSequence{bad}, base::UsageError) << bad;
    }
    EXPECT_EQ(countPictures(0.0, 25.0), 1u);
    EXPECT_EQ(countPictures(2.0, 25.0), 51u);
    EXPECT_EQ(countPictures(0.3, 10.0), 4u);
}

TEST(Keys, AreInTheReadme) {
    std::ifstream stream(std::filesystem::path(FLUXWALK_SOURCE_DIR) / "README.md");
    const std::string readme{std::istreambuf_iterator<char>(stream), {}};
    int lines = 0;
    for (const ui::KeyGroup& group : ui::keyGroups()) {
        for (const ui::KeyLine& line : group.lines) {
            const std::string row = "| " + std::string(line.keys) + " | " + std::string(line.meaning) + " |";
            EXPECT_NE(readme.find(row), std::string::npos) << row;
            EXPECT_NE(ui::describeKeys().find(line.meaning), std::string::npos);
            ++lines;
        }
    }
    EXPECT_GT(lines, 15);
}

}  // namespace
}  // namespace fluxwalk::app
