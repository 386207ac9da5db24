#include "core/io/sensors_csv.h"

#include <gtest/gtest.h>

#include "core/io/file.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

class SensorsCsv : public testing::Test {
  protected:
    std::vector<scene::Sensor> read(const std::string& text) {
        test::writeBytes(file_, test::bytesOf(text));
        return io::readSensors(file_);
    }

    std::string errorFor(const std::string& text) {
        try {
            read(text);
        } catch (const base::FileError& e) {
            return e.what();
        }
        return "no error";
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "sensors.csv";
};

TEST_F(SensorsCsv, ReadsRowsAndIgnoresWhatFollows) {
    const auto sensors = read("x,y,z,nx,ny,nz,Er,Eg\n1,2.5,-3e-1,0,2,0,9,9\n\n+4, 5 ,6,-1,0,0\n");
    ASSERT_EQ(sensors.size(), 2u);
    EXPECT_EQ(sensors[0].position, base::Vec3d(1, 2.5, -0.3));
    EXPECT_EQ(sensors[0].normal, base::Vec3d(0, 1, 0));
    EXPECT_EQ(sensors[1].position, base::Vec3d(4, 5, 6));
    EXPECT_EQ(sensors[1].normal, base::Vec3d(-1, 0, 0));
}

TEST_F(SensorsCsv, BearsWindowsLineEndsAndByteOrderMark) {
    EXPECT_EQ(read("\xef\xbb\xbfx,y,z,nx,ny,nz\r\n1,2,3,0,0,1\r\n").size(), 1u);
}

TEST_F(SensorsCsv, MakesHugeAndTinyNormalsUnit) {
    const auto sensors = read("x,y,z,nx,ny,nz\n0,0,0,3e200,0,4e200\n0,0,0,3e-300,0,4e-300\n");
    for (const scene::Sensor& s : sensors) {
        EXPECT_NEAR(s.normal.x, 0.6, 1e-15);
        EXPECT_NEAR(s.normal.z, 0.8, 1e-15);
    }
}

TEST_F(SensorsCsv, NamesTheLineOfEveryKindOfBadRow) {
    const std::string head = "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n";
    EXPECT_NE(errorFor(head + "1,2,3,0,1\n").find("line 3: has 5 values"), std::string::npos);
    EXPECT_NE(errorFor(head + "1,2,three,0,1,0\n").find("line 3: z is not a number: 'three'"),
              std::string::npos);
    EXPECT_NE(errorFor(head + "1,2,3 4,0,1,0\n").find("line 3: z is not a number"), std::string::npos);
    EXPECT_NE(errorFor(head + "1,,3,0,1,0\n").find("line 3: y is not a number"), std::string::npos);
    EXPECT_NE(errorFor(head + "\nnan,2,3,0,1,0\n").find("line 4: x is not finite"), std::string::npos);
    EXPECT_NE(errorFor(head + "1,inf,3,0,1,0\n").find("line 3: y is not finite"), std::string::npos);
    EXPECT_NE(errorFor(head + "1,1e999,3,0,1,0\n").find("line 3: y is not"), std::string::npos);
    EXPECT_NE(errorFor(head + "1,2,3,0,0,0\n").find("line 3: the normal is zero"), std::string::npos);
    EXPECT_NE(errorFor("1,2,3,0,1,0\n").find("line 1: the header"), std::string::npos);
    EXPECT_NE(errorFor("x,y,z\n1,2,3\n").find("line 1: the header"), std::string::npos);
    EXPECT_NE(errorFor("x,y,z,nx,ny,nz\n").find("no sensors"), std::string::npos);
    EXPECT_NE(errorFor("").find("no sensors"), std::string::npos);
}

TEST_F(SensorsCsv, WritesTheOrderAndDigitsPromised) {
    const std::vector<scene::Sensor> sensors{{{0.1, -2, 1e-7}, {0, 1, 0}}, {{1, 2, 3}, {0, 0, -1}}};
    const std::vector<base::Vec3d> irradiance{{1000, 100, 10}, {0, 0, 1.0 / 3.0}};
    io::writeSensorTable(file_, {sensors, io::irradianceColumns(irradiance)});
    const auto bytes = io::readFile(file_);
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_EQ(text,
              "x,y,z,nx,ny,nz,E_r,E_g,E_b,lux\n"
              "0.1,-2,1e-07,0,1,0,1000,100,10,284.842\n"
              "1,2,3,0,0,-1,0,0,0.333333333,0.0240666667\n");
    EXPECT_EQ(io::readSensors(file_).size(), 2u);
}

}  // namespace
}  // namespace fluxwalk
