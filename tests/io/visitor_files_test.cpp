#include "core/io/visitor_files.h"

#include <functional>

#include <gtest/gtest.h>

#include "core/io/file.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

const std::string kCamera = R"("position":[1,2,3],"forward":[0,0,-1],"up":[0,1,0],"fov":50)";

std::string pathOf(const std::string& keys) {
    return "{\"fluxwalk\":\"camera path\",\n\"version\":1,\n\"keys\":[" + keys + "]}";
}

class VisitorFiles : public testing::Test {
  protected:
    std::string errorFor(const std::string& text, const std::function<void()>& read) {
        test::writeBytes(file_, test::bytesOf(text));
        try {
            read();
        } catch (const base::FileError& e) {
            EXPECT_EQ(e.file(), file_.string());
            return e.place() + ": " + e.what();
        }
        return "no error";
    }
    std::string pathError(const std::string& text) {
        return errorFor(text, [this] { io::readCameraPath(file_); });
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "kept.json";
};

TEST_F(VisitorFiles, PathsComeBackAsTheyWere) {
    scene::CameraPath path(3);
    for (std::size_t i = 0; i < path.size(); ++i) {
        path[i].seconds = 0.1 + 0.7 * static_cast<double>(i);
        path[i].camera.position = {1.0 / 3.0, 1e-7, -static_cast<double>(i)};
        path[i].camera.verticalFov = 0.3 + 0.1 * static_cast<double>(i);
    }
    io::writeCameraPath(file_, path);
    const scene::CameraPath read = io::readCameraPath(file_);
    ASSERT_EQ(read.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(read[i].seconds, path[i].seconds);
        EXPECT_EQ(read[i].camera.position, path[i].camera.position);
        EXPECT_NEAR(read[i].camera.verticalFov, path[i].camera.verticalFov, 1e-15);
    }
}

TEST_F(VisitorFiles, BookmarksAndRecentFilesComeBack) {
    scene::Camera camera;
    camera.name = "by the \"window\" \xff";
    io::writeBookmarks(file_, {camera, camera});
    ASSERT_EQ(io::readBookmarks(file_).size(), 2u);
    EXPECT_TRUE(io::readBookmarks(file_)[0].name.starts_with("by the \"window\""));
    const std::vector<std::string> files{"/a b/c.glb", "gallery"};
    io::writeRecentFiles(file_, files);
    EXPECT_EQ(io::readRecentFiles(file_), files);
    EXPECT_NE(errorFor("{\"fluxwalk\":\"recent files\",\"version\":1,\"files\":[\"a\",1]}",
                       [this] { io::readRecentFiles(file_); })
                  .find("/files/1: "),
              std::string::npos);
    EXPECT_NE(errorFor("{\"fluxwalk\":\"bookmarks\",\"version\":1,\"cameras\":[{" + kCamera + "}]}",
                       [this] { io::readBookmarks(file_); })
                  .find("/cameras/0/name: "),
              std::string::npos);
}

TEST_F(VisitorFiles, ErrorsNameThePlace) {
    const std::string key = "{\"seconds\":0," + kCamera + "}";
    EXPECT_EQ(pathError(pathOf(key)), "no error");
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "line 1: "},
        {"{\"fluxwalk\":\"camera path\",\n\"version\":1,\n\"keys\":[}", "line 3: "},
        {"[]", ": "},
        {"{\"fluxwalk\":\"bookmarks\",\"version\":1}", ": "},
        {"{\"fluxwalk\":\"camera path\",\"version\":2}", "/version: "},
        {"{\"fluxwalk\":\"camera path\",\"version\":1,\"keys\":{}}", "/keys: "},
        {pathOf(""), "/keys: "},
        {pathOf("1"), "/keys/0: "},
        {pathOf("{" + kCamera + "}"), "/keys/0/seconds: "},
        {pathOf(key + "," + key), "/keys/1/seconds: "},
        {pathOf("{\"seconds\":-1," + kCamera + "}"), "/keys/0/seconds: "},
        {pathOf("{\"seconds\":1e9," + kCamera + "}"), "/keys/0/seconds: "},
        {pathOf("{\"seconds\":1e999," + kCamera + "}"), ": "},
        {pathOf(R"({"seconds":0,"position":[1,2],"forward":[0,0,-1],"up":[0,1,0],"fov":50})"),
         "/keys/0/position: "},
        {pathOf(R"({"seconds":0,"position":[1,2,1e300],"forward":[0,0,-1],"up":[0,1,0],"fov":50})"),
         "/keys/0: "},
        {pathOf(R"({"seconds":0,"position":[1,2,1],"forward":[0,1,0],"up":[0,1,0],"fov":50})"), "/keys/0: "},
        {pathOf(R"({"seconds":0,"position":[1,2,1],"forward":[0,0,-1],"up":[0,1,0]})"), "/keys/0/fov: "},
        {pathOf(R"({"seconds":0,"position":[1,2,1],"forward":[0,0,-1],"up":[0,1,0],"fov":180})"),
         "/keys/0: "},
        {pathOf(R"({"seconds":0,"forward":[0,0,-1],"up":[0,1,0],"fov":50})"), "/keys/0: "}};
    for (const auto& [text, place] : cases) {
        const std::string error = pathError(text);
        EXPECT_TRUE(error.starts_with(place)) << text << "\n" << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
    std::filesystem::remove(file_);
    EXPECT_THROW(io::readCameraPath(file_), base::FileError);
}

}  // namespace
}  // namespace fluxwalk
