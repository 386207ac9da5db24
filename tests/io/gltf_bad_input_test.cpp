#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/io/image_write.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using test::GltfFixture;
using test::json;

class GltfBadInput : public testing::Test {
  protected:
    GltfBadInput() { fixture_.addNode({{"name", "square"}, {"mesh", fixture_.addSquare()}}); }

    // The message after one change of a good file.
    template <class Change>
    std::string errorAfter(const Change& change) {
        GltfFixture copy = fixture_;
        change(copy.root);
        return test::errorOf(copy, folder_);
    }

    void expectError(const std::string& error, const std::string& part) {
        EXPECT_NE(error.find(part), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }

    test::TemporaryFolder folder_;
    GltfFixture fixture_;
};

TEST_F(GltfBadInput, TheUnchangedFileIsGood) {
    EXPECT_EQ(test::errorOf(fixture_, folder_), "no error");
}

TEST_F(GltfBadInput, WrongIndices) {
    expectError(errorAfter([](json& r) { r["nodes"][0]["mesh"] = 42; }),
                "/nodes/0/mesh: index 42 is out of range: there are 1 meshes");
    expectError(errorAfter([](json& r) { r["nodes"][0]["mesh"] = -1; }), "/nodes/0/mesh: is not an index");
    expectError(errorAfter([](json& r) { r["nodes"][0]["mesh"] = "0"; }), "/nodes/0/mesh: is not an index");
    expectError(errorAfter([](json& r) { r["nodes"][0]["mesh"] = 0.5; }), "/nodes/0/mesh: is not an index");
    // Cut to 32 bits, this would be a good index.
    expectError(errorAfter([](json& r) { r["nodes"][0]["mesh"] = 4294967296; }), "/nodes/0/mesh");
    for (const char* key :
         {"fluxwalk_surface", "fluxwalk_radius", "fluxwalk_inside", "fluxwalk_subdivision"}) {
        expectError(errorAfter([key](json& r) {
                        r["nodes"][0]["extras"] = {{key, nullptr}};
                    }),
                    std::string("/nodes/0/extras/") + key + ": is null");
    }
    expectError(errorAfter([](json& r) { r["nodes"][0]["camera"] = 0; }), "/nodes/0/camera");
    expectError(errorAfter([](json& r) { r["nodes"][0]["children"] = {7}; }), "/nodes/0/children/0");
    expectError(errorAfter([](json& r) { r["meshes"][0]["primitives"][0]["indices"] = 9; }),
                "/meshes/0/primitives/0/indices");
    expectError(errorAfter([](json& r) { r["meshes"][0]["primitives"][0]["material"] = 0; }),
                "/meshes/0/primitives/0/material");
    expectError(errorAfter([](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; }),
                "/meshes/0/primitives/0/attributes/POSITION");
    expectError(errorAfter([](json& r) { r["accessors"][0]["bufferView"] = 99; }), "/accessors/0/bufferView");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["buffer"] = 9; }), "/bufferViews/0/buffer");
    expectError(errorAfter([](json& r) { r["scenes"] = {{{"nodes", {3}}}}; }), "/scenes/0/nodes/0");
    expectError(errorAfter([](json& r) { r["scene"] = 5; }), "/scene: index 5");
    expectError(errorAfter([](json& r) { r["textures"] = {{{"source", 3}}}; }), "/textures/0/source");
}

TEST_F(GltfBadInput, WrongCountsStridesAndRanges) {
    expectError(errorAfter([](json& r) { r["accessors"][0]["count"] = 1000000; }), "/accessors/0: 1000000");
    expectError(errorAfter([](json& r) { r["accessors"][0]["count"] = 0; }), "/accessors/0/count");
    expectError(errorAfter([](json& r) { r["accessors"][0]["count"] = -4; }), "/accessors/0/count");
    expectError(errorAfter([](json& r) { r["accessors"][0]["count"] = 1e19; }), "/accessors/0/count");
    expectError(errorAfter([](json& r) { r["accessors"][0]["byteOffset"] = -4; }), "/accessors/0/byteOffset");
    expectError(errorAfter([](json& r) { r["accessors"][0]["byteOffset"] = 40; }),
                "/accessors/0: 4 elements");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteLength"] = 1 << 20; }),
                "/bufferViews/0: ends");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteOffset"] = 4294967295u; }),
                "/bufferViews/0: ends at byte 4294967343");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteStride"] = 8; }), "overlap");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteStride"] = 13; }), "byteStride");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteStride"] = -12; }), "byteStride");
    expectError(errorAfter([](json& r) { r["bufferViews"][0]["byteStride"] = 252; }),
                "/accessors/0: 4 elements");
    expectError(errorAfter([](json& r) {
                    r["buffers"] = {{{"byteLength", 1 << 30}}};
                }),
                "/buffers/0/byteLength");
    expectError(errorAfter([](json& r) {
                    r["buffers"] = {{{"byteLength", 92}}, {{"byteLength", 92}}};
                }),
                "/buffers/1: has no data");
    expectError(errorAfter([](json& r) { r["accessors"][2]["count"] = 5; }), "corners do not make triangles");
    expectError(errorAfter([](json& r) {
                    r["accessors"][1]["count"] = 3;
                    r["materials"] = json::array({json::object()});
                }),
                "no error");  // texture coordinates that nothing uses are not read
    expectError(errorAfter([](json& r) { r["nodes"][0]["translation"] = {1, 2}; }), "/nodes/0/translation");
    expectError(errorAfter([](json& r) { r["nodes"][0]["rotation"] = {0, 0, 0, 0}; }), "rotation");
    expectError(errorAfter([](json& r) { r["nodes"][0]["matrix"] = "unit"; }), "/nodes/0/matrix");
    expectError(errorAfter([](json& r) { r["meshes"] = json::object(); }), "/meshes: is not an array");
    expectError(errorAfter([](json& r) { r["meshes"] = {1}; }), "/meshes/0: is not an object");
    expectError(errorAfter([](json& r) { r["meshes"][0].erase("primitives"); }),
                "/meshes/0: has no primitives");
    expectError(errorAfter([](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 7; }), "mode");
    expectError(errorAfter([](json& r) { r["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
                "has no POSITION");
}

TEST_F(GltfBadInput, IndicesBeyondTheVertices) {
    GltfFixture other;
    other.addNode({{"mesh", other.addMesh({{"attributes",
                                            {{"POSITION", other.addPositions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}},
                                           {"indices", other.addIndices({0, 1, 3})}})}});
    expectError(test::errorOf(other, folder_), "/accessors/1: element 2 is 3, but there are 3 vertices");
}

TEST_F(GltfBadInput, PositionsThatAreNoPlace) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1e30f}) {
        GltfFixture other;
        other.addNode(
            {{"mesh", other.addMesh({{"attributes",
                                      {{"POSITION", other.addPositions({0, 0, 0, 1, bad, 0, 0, 1, 0})}}}})}});
        expectError(test::errorOf(other, folder_), "/accessors/0: element 1 is not finite");
    }
    expectError(errorAfter([](json& r) { r["nodes"][0]["scale"] = {1e300, 1e300, 1e300}; }), "not finite");
    expectError(errorAfter([](json& r) { r["nodes"][0]["translation"] = {1e10, 0, 0}; }), "beyond 1e9 m");
}

TEST_F(GltfBadInput, CyclesAndNodesWithTwoParents) {
    expectError(errorAfter([](json& r) { r["nodes"][0]["children"] = {0}; }),
                "/nodes/0 'square': the node is part of a cycle");
    expectError(errorAfter([](json& r) {
                    r["nodes"].push_back({{"children", {2}}});
                    r["nodes"].push_back({{"children", {1}}});
                    r["scenes"] = {{{"nodes", {0}}}};
                }),
                "/nodes/1: the node is part of a cycle");
    expectError(errorAfter([](json& r) {
                    r["nodes"].push_back({{"children", {0}}});
                    r["nodes"].push_back({{"children", {0}}});
                }),
                "node 0 has two parents");
    expectError(errorAfter([](json& r) { r["scenes"] = {{{"nodes", {0, 0}}}}; }), "listed twice");
}

TEST_F(GltfBadInput, DeepHierarchiesNeedNoStack) {
    GltfFixture deep = fixture_;
    constexpr int kDepth = 200000;
    deep.root["nodes"][0]["children"] = {1};
    for (int i = 1; i < kDepth; ++i) {
        deep.root["nodes"].push_back({{"children", {i + 1}}});
    }
    deep.root["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(deep.read(folder_).objects.size(), 2u);
}

TEST_F(GltfBadInput, DeeplyNestedJson) {
    const auto file = folder_.path() / "deep.gltf";
    const std::string open(200000, '[');
    const std::string close(200000, ']');
    test::writeBytes(file, test::bytesOf(R"({"asset":{"version":"2.0"},"extras":)" + open + close + "}"));
    expectError(test::errorOf(file), "nested deeper");
}

TEST_F(GltfBadInput, VersionsAndExtensions) {
    expectError(errorAfter([](json& r) { r["asset"]["version"] = "1.0"; }), "/asset/version: is 1.0");
    expectError(errorAfter([](json& r) { r.erase("asset"); }), "/asset/version: is missing");
    expectError(errorAfter([](json& r) { r["asset"] = 3; }), "/asset/version: is missing");
    expectError(errorAfter([](json& r) { r["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
                "/extensionsRequired/0: the file requires \"KHR_draco_mesh_compression\"");
    expectError(errorAfter([](json& r) { r["extensionsRequired"] = "FOO_bar"; }), "/extensionsRequired");
}

TEST_F(GltfBadInput, EmptyScenes) {
    expectError(errorAfter([](json& r) { r["nodes"][0].erase("mesh"); }), "no surface");
    expectError(errorAfter([](json& r) { r["nodes"][0]["scale"] = {0, 0, 0}; }), "no surface");
    expectError(test::errorOf(GltfFixture{}, folder_), "no surface");
}

TEST_F(GltfBadInput, PathsThatLeaveTheFolder) {
    const auto inner = folder_.path() / "inner";
    std::filesystem::create_directory(inner);
    test::writeBytes(folder_.path() / "outside.bin", fixture_.bin);
    test::writeBytes(inner / "inside.bin", fixture_.bin);
    std::filesystem::create_symlink(folder_.path() / "outside.bin", inner / "link.bin");
    const auto errorWith = [&](const std::string& uri) {
        json root = fixture_.root;
        root["buffers"] = {{{"byteLength", fixture_.bin.size()}, {"uri", uri}}};
        test::writeBytes(inner / "scene.gltf", test::bytesOf(root.dump()));
        return test::errorOf(inner / "scene.gltf");
    };
    EXPECT_EQ(errorWith("inside.bin"), "no error");
    EXPECT_EQ(errorWith("./inside.bin"), "no error");
    for (const char* uri : {"../outside.bin", "%2e%2e/outside.bin", "a/../../outside.bin", "link.bin",
                            "/etc/hostname", "file:///etc/hostname", "..", "", "inside.bin%00.png"}) {
        expectError(errorWith(uri),
                    "/buffers/0/uri: '" + std::string(uri) + "' is not a path inside the scene's folder");
    }
    expectError(errorWith("missing.bin"), "missing.bin");
    json root = fixture_.root;
    root["buffers"] = {{{"byteLength", fixture_.bin.size()}, {"uri", "inside.bin"}}};
    root["images"] = {{{"uri", "../secret.png"}}};
    test::writeBytes(inner / "scene.gltf", test::bytesOf(root.dump()));
    expectError(test::errorOf(inner / "scene.gltf"), "/images/0/uri");
}

TEST_F(GltfBadInput, FilesThatAreNoGltf) {
    const auto file = folder_.path() / "scene.glb";
    expectError(test::errorOf(folder_.path() / "missing.glb"), "no such file");
    expectError(test::errorOf(folder_.path()), "not a file");
    test::writeBytes(file, {});
    expectError(test::errorOf(file), "neither binary glTF nor JSON");
    test::writeBytes(file, test::bytesOf("solid ascii stl"));
    expectError(test::errorOf(file), "neither binary glTF nor JSON");
    test::writeBytes(file, test::bytesOf("{\"asset\": "));
    expectError(test::errorOf(file), "not valid JSON");
    test::writeBytes(file, test::bytesOf("{\"asset\": {\"version\": \"2.0\"}, \"x\": NaN}"));
    expectError(test::errorOf(file), "not valid JSON");
    std::vector<std::uint8_t> old = fixture_.glb();
    old[4] = 1;
    test::writeBytes(file, old);
    expectError(test::errorOf(file), "version 1");
}

// The binary chunk's length is eight bytes too long: its end, counted without its header, is still inside.
TEST_F(GltfBadInput, ChunkLengthsThatForgetTheirHeader) {
    std::vector<std::uint8_t> bytes = fixture_.glb();
    const std::size_t jsonBytes = bytes[12] + std::size_t{256} * bytes[13];
    bytes[20 + jsonBytes] = static_cast<std::uint8_t>(bytes[20 + jsonBytes] + 8);
    const auto file = folder_.path() / "scene.glb";
    test::writeBytes(file, bytes);
    expectError(test::errorOf(file), "second chunk");
}

TEST_F(GltfBadInput, NamesCannotWriteToTheTerminal) {
    expectError(errorAfter([](json& r) {
                    r["nodes"][0]["name"] = "a\nb\x1b[2J";
                    r["nodes"][0]["children"] = {0};
                }),
                "/nodes/0 'a?b?[2J'");
    GltfFixture copy = fixture_;
    copy.root["extensionsUsed"] = {"X\nY"};
    EXPECT_TRUE(test::hasWarning(copy.read(folder_), "X?Y is not supported"));
}

// A small file with some of everything, for the damage below.
GltfFixture richFixture() {
    GltfFixture f;
    const int texture = f.addTexture(io::encodePng(2, 2, 4, std::vector<std::uint8_t>(16, 200)));
    f.add("materials",
          {{"name", "m"},
           {"alphaMode", "MASK"},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {0.5, 0.5, 0.5, 1}},
             {"baseColorTexture",
              {{"index", texture}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}}}},
           {"emissiveFactor", {1, 1, 1}},
           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}});
    const int mesh = f.addSquare({{"material", 0}});
    f.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", f.addView(std::vector<std::uint8_t>{2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", f.addView(std::vector<float>{1, 1, 0})}}}};
    f.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    f.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 5}, {"spot", {{"outerConeAngle", 0.5}}}}};
    f.addNode({{"children", {1, 2, 3}}, {"translation", {0, 0, 1}}});
    f.addNode({{"mesh", mesh}, {"rotation", {0, 0, 0, 1}}});
    f.addNode({{"mesh", mesh}, {"extras", {{"fluxwalk_surface", "sphere"}, {"fluxwalk_radius", 0.1}}}});
    f.addNode({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    f.root["scenes"] = {{{"nodes", {0}}}};
    return f;
}

// Reads bytes as a file; only a FileError may come out. Returns whether one did.
bool isRefused(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes) {
    test::writeBytes(file, bytes);
    try {
        io::readGltf(file);
    } catch (const base::FileError& e) {
        EXPECT_FALSE(std::string(e.what()).empty());
        return true;
    }
    return false;
}

TEST_F(GltfBadInput, EveryTruncationIsRefused) {
    const std::vector<std::uint8_t> whole = richFixture().glb();
    const auto file = folder_.path() / "scene.glb";
    EXPECT_FALSE(isRefused(file, whole));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_TRUE(isRefused(file, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}))
            << length << " of " << whole.size() << " bytes";
    }
}

// The JSON cut short inside a container whose lengths are right.
TEST_F(GltfBadInput, EveryTruncationOfTheJsonIsRefused) {
    const GltfFixture rich = richFixture();
    json root = rich.root;
    root["buffers"] = {{{"byteLength", rich.bin.size()}}};
    const std::string text = root.dump();
    const auto file = folder_.path() / "scene.glb";
    for (std::size_t length = 1; length < text.size(); length += 7) {
        EXPECT_TRUE(isRefused(file, GltfFixture::packGlb(text.substr(0, length), rich.bin)));
    }
}

TEST_F(GltfBadInput, RandomDamageIsRefusedOrRead) {
    const std::vector<std::uint8_t> whole = richFixture().glb();
    const auto file = folder_.path() / "scene.glb";
    base::RandomStream random(20240611);
    int refused = 0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<std::uint8_t> bytes = whole;
        const int changes = 1 + static_cast<int>(random.next() * 4.0);
        for (int i = 0; i < changes; ++i) {
            const auto at = static_cast<std::size_t>(random.next() * static_cast<double>(bytes.size()));
            bytes[at] = static_cast<std::uint8_t>(random.next() * 256.0);
        }
        refused += isRefused(file, bytes) ? 1 : 0;
    }
    EXPECT_GT(refused, kTrials / 10);
    EXPECT_LT(refused, kTrials);
}

// Numbers are what does harm: each digit of the JSON replaced by others.
TEST_F(GltfBadInput, ChangedNumbersAreRefusedOrRead) {
    const GltfFixture rich = richFixture();
    json root = rich.root;
    root["buffers"] = {{{"byteLength", rich.bin.size()}}};
    const std::string text = root.dump();
    const auto file = folder_.path() / "scene.glb";
    int tried = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] < '0' || text[i] > '9') {
            continue;
        }
        for (const char* with : {"9", "-1", "99999999999", "1e9", "0.5", "null", "[]", "\"x\""}) {
            isRefused(file, GltfFixture::packGlb(text.substr(0, i) + with + text.substr(i + 1), rich.bin));
            ++tried;
        }
    }
    EXPECT_GT(tried, 500);
}

}  // namespace
}  // namespace fluxwalk
