#include "core/io/gltf_accessors.h"

#include <gtest/gtest.h>

#include "core/io/file.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using test::GltfFixture;
using test::json;

class Accessors : public testing::Test {
  protected:
    io::GltfModel load() {
        const auto file = folder_.path() / "scene.glb";
        test::writeBytes(file, fixture_.glb());
        return io::loadGltf(file);
    }

    std::string errorFor(int accessor) {
        try {
            const io::GltfModel model = load();
            const io::AccessorReader reader(model, accessor);
        } catch (const base::FileError& e) {
            return e.what();
        }
        return "no error";
    }

    template <class T>
    std::vector<double> readScalars(const std::vector<T>& values, int type, bool normalized) {
        const int accessor = fixture_.addAccessor(fixture_.addView(values), type, values.size(), "SCALAR");
        fixture_.root["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = normalized;
        const io::GltfModel model = load();
        const io::AccessorReader reader(model, accessor);
        std::vector<double> result;
        for (std::size_t i = 0; i < reader.size(); ++i) {
            result.push_back(reader.component(i, 0));
        }
        return result;
    }

    test::TemporaryFolder folder_;
    GltfFixture fixture_;
};

TEST_F(Accessors, ReadsEveryComponentType) {
    using Values = std::vector<double>;
    EXPECT_EQ(readScalars(std::vector<std::int8_t>{-128, 0, 127}, 5120, false), (Values{-128, 0, 127}));
    EXPECT_EQ(readScalars(std::vector<std::int8_t>{-128, -127, 127}, 5120, true), (Values{-1, -1, 1}));
    EXPECT_EQ(readScalars(std::vector<std::uint8_t>{0, 255}, 5121, false), (Values{0, 255}));
    EXPECT_EQ(readScalars(std::vector<std::uint8_t>{0, 51, 255}, 5121, true), (Values{0, 0.2, 1}));
    EXPECT_EQ(readScalars(std::vector<std::int16_t>{-32768, 32767}, 5122, false), (Values{-32768, 32767}));
    EXPECT_EQ(readScalars(std::vector<std::int16_t>{-32768, 32767}, 5122, true), (Values{-1, 1}));
    EXPECT_EQ(readScalars(std::vector<std::uint16_t>{1, 65535}, 5123, false), (Values{1, 65535}));
    EXPECT_EQ(readScalars(std::vector<std::uint16_t>{13107, 65535}, 5123, true), (Values{0.2, 1}));
    EXPECT_EQ(readScalars(std::vector<std::uint32_t>{7, 4294967295u}, 5125, false),
              (Values{7, 4294967295.0}));
    EXPECT_EQ(readScalars(std::vector<float>{0.5f, -1e30f}, 5126, false),
              (Values{0.5, static_cast<double>(-1e30f)}));
}

TEST_F(Accessors, ReadsInterleavedVertices) {
    // Position (3 floats), then a texture coordinate (2 floats): stride 20.
    const std::vector<float> vertices{1, 2, 3, 10, 11, 4, 5, 6, 12, 13};
    const int view = fixture_.addView(vertices, 20);
    fixture_.addAccessor(view, 5126, 2, "VEC3");
    const int uv = fixture_.addAccessor(view, 5126, 2, "VEC2");
    fixture_.root["accessors"][1]["byteOffset"] = 12;
    const io::GltfModel model = load();
    const io::AccessorReader positions(model, 0);
    EXPECT_EQ(positions.component(1, 2), 6.0);
    const io::AccessorReader texcoords(model, uv);
    EXPECT_EQ(texcoords.component(0, 1), 11.0);
    EXPECT_EQ(texcoords.component(1, 0), 12.0);
}

TEST_F(Accessors, AppliesSparseValuesOverDataAndOverZeros) {
    const int dense = fixture_.addFloats({1, 2, 3, 4}, "SCALAR", 1);
    const int zeros = fixture_.addAccessor(-1, 5126, 4, "SCALAR");
    const json sparse = {
        {"count", 2},
        {"indices",
         {{"bufferView", fixture_.addView(std::vector<std::uint8_t>{1, 3})}, {"componentType", 5121}}},
        {"values", {{"bufferView", fixture_.addView(std::vector<float>{20, 40})}}}};
    fixture_.root["accessors"][0]["sparse"] = sparse;
    fixture_.root["accessors"][1]["sparse"] = sparse;
    const io::GltfModel model = load();
    const io::AccessorReader overData(model, dense);
    const io::AccessorReader overZeros(model, zeros);
    const std::vector<double> expectedData{1, 20, 3, 40};
    const std::vector<double> expectedZeros{0, 20, 0, 40};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(overData.component(i, 0), expectedData[i]);
        EXPECT_EQ(overZeros.component(i, 0), expectedZeros[i]);
    }
}

TEST_F(Accessors, RefusesElementsBeyondTheirView) {
    const int view = fixture_.addView(std::vector<float>(9));
    fixture_.addAccessor(view, 5126, 1000000, "VEC3");
    EXPECT_NE(errorFor(0).find("/accessors/0: 1000000 elements end at byte 12000000"), std::string::npos);
    fixture_.root["accessors"][0]["count"] = 3;
    EXPECT_EQ(errorFor(0), "no error");
    fixture_.root["accessors"][0]["byteOffset"] = 4;
    EXPECT_NE(errorFor(0).find("/accessors/0: 3 elements end at byte 40"), std::string::npos);
    // 2^32 - 1 elements: the product leaves 32 bits.
    fixture_.root["accessors"][0] = {
        {"bufferView", view}, {"componentType", 5126}, {"count", 4294967295u}, {"type", "VEC4"}};
    EXPECT_NE(errorFor(0).find("elements end at byte"), std::string::npos);
}

TEST_F(Accessors, RefusesOverlappingElementsAndWrongTypes) {
    const int view = fixture_.addView(std::vector<float>(12), 4);
    fixture_.addAccessor(view, 5126, 2, "VEC3");
    EXPECT_NE(errorFor(0).find("overlap"), std::string::npos);
    fixture_.root["accessors"][0]["type"] = "MAT4";
    EXPECT_NE(errorFor(0).find("/accessors/0/type"), std::string::npos);
    fixture_.root["accessors"][0]["type"] = "SCALAR";
    fixture_.root["accessors"][0]["componentType"] = 5124;
    EXPECT_NE(errorFor(0).find("/accessors/0/componentType"), std::string::npos);
}

TEST_F(Accessors, RefusesMoreZerosThanTheFileCouldMean) {
    fixture_.addFloats({1, 2, 3}, "SCALAR", 1);
    const int zeros = fixture_.addAccessor(-1, 5126, 4000000000u, "VEC3");
    EXPECT_NE(errorFor(zeros).find("without data"), std::string::npos);
}

TEST_F(Accessors, RefusesBadSparseParts) {
    const int accessor = fixture_.addFloats({1, 2, 3, 4}, "SCALAR", 1);
    const auto errorWith = [&](const std::vector<std::uint8_t>& indices, int count, int type) {
        fixture_.root["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", fixture_.addView(indices)}, {"componentType", type}}},
            {"values", {{"bufferView", fixture_.addView(std::vector<float>{7, 8})}}}};
        return errorFor(accessor);
    };
    EXPECT_EQ(errorWith({0, 3}, 2, 5121), "no error");
    EXPECT_NE(errorWith({0, 4}, 2, 5121).find("/accessors/0/sparse/indices: index 4"), std::string::npos);
    EXPECT_NE(errorWith({3, 0}, 2, 5121).find("range or order"), std::string::npos);
    EXPECT_NE(errorWith({0, 1, 2}, 3, 5121).find("/accessors/0/sparse/values"), std::string::npos);
    EXPECT_NE(errorWith({0, 1, 2, 3, 3}, 5, 5121).find("/accessors/0/sparse/count"), std::string::npos);
    EXPECT_NE(errorWith({0, 3, 0, 0}, 2, 5126).find("componentType"), std::string::npos);
}

}  // namespace
}  // namespace fluxwalk
