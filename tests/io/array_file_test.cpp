#include "core/io/array_file.h"

#include <csignal>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/io/file.h"
#include "core/io/hdf5_arrays.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

namespace fs = std::filesystem;
using base::NamedArrays;

template <class T>
std::vector<T> someValues(std::size_t count) {
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(static_cast<T>(i * 37 % 101));
    }
    return values;
}

// Every type; lengths below and above those that are stored in chunks; nothing at all.
NamedArrays makeArrays() {
    NamedArrays arrays;
    arrays.kind = "test";
    arrays.version = 7;
    arrays.arrays.push_back({"a/bytes", someValues<std::uint8_t>(10'000)});
    arrays.arrays.push_back({"a/pairs", someValues<std::int8_t>(9'000), 2});
    arrays.arrays.push_back({"a/shorts", someValues<std::uint16_t>(70'001)});
    arrays.arrays.push_back({"b/ids", someValues<std::uint32_t>(5)});
    arrays.arrays.push_back({"b/names", someValues<std::uint64_t>(600)});
    arrays.arrays.push_back({"b/rgb", someValues<float>(3 * 40'000), 3, "lux"});
    arrays.arrays.push_back({"c/empty", std::vector<double>{}});
    arrays.arrays.push_back({"c/nan", std::vector<double>{-0.0, 1e-310, INFINITY}});
    return arrays;
}

std::string readErrorOf(const fs::path& file) {
    try {
        io::readArrayFile(file);
    } catch (const base::FileError& e) {
        return e.what();
    }
    return "no error";
}

TEST(ArrayFile, ComesBackAsItWas) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.fwc";
    const NamedArrays arrays = makeArrays();
    io::writeArrayFile(file, arrays);
    const NamedArrays read = io::readArrayFile(file);
    EXPECT_EQ(read.kind, "test");
    EXPECT_EQ(read.version, 7u);
    ASSERT_EQ(read.arrays.size(), arrays.arrays.size());
    for (std::size_t i = 0; i < arrays.arrays.size(); ++i) {
        EXPECT_EQ(read.arrays[i].name, arrays.arrays[i].name);
        EXPECT_EQ(read.arrays[i].columns, arrays.arrays[i].columns);
        EXPECT_EQ(read.arrays[i].values, arrays.arrays[i].values) << arrays.arrays[i].name;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(ArrayFile, SameArraysAreTheSameBytes) {
    const test::TemporaryFolder folder;
    io::writeArrayFile(folder.path() / "a", makeArrays());
    io::writeArrayFile(folder.path() / "b", makeArrays());
    EXPECT_EQ(io::readFile(folder.path() / "a"), io::readFile(folder.path() / "b"));
}

TEST(ArrayFile, AnyAlteredByteIsRefused) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.fwc";
    io::writeArrayFile(file, makeArrays());
    const std::vector<std::uint8_t> whole = io::readFile(file);
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::uint8_t> altered = whole;
        // The first hundred hit the header's fields.
        const std::size_t at = i < 100 ? static_cast<std::size_t>(i) : random() % whole.size();
        altered[at] ^= static_cast<std::uint8_t>(1 + random() % 255);
        test::writeBytes(file, altered);
        const std::string message = readErrorOf(file);
        ASSERT_TRUE(message.starts_with(file.string() + ": ")) << at << ": " << message;
        ASSERT_EQ(io::readFile(file), altered);
    }
}

TEST(ArrayFile, AnyCutIsRefused) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.fwc";
    io::writeArrayFile(file, makeArrays());
    const std::vector<std::uint8_t> whole = io::readFile(file);
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        const std::size_t size = i < 20 ? static_cast<std::size_t>(30 * i) : random() % whole.size();
        test::writeBytes(file, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
        ASSERT_TRUE(readErrorOf(file).starts_with(file.string() + ": ")) << size;
    }
    std::vector<std::uint8_t> longer = whole;
    longer.push_back(0);
    test::writeBytes(file, longer);
    EXPECT_NE(readErrorOf(file).find("altered"), std::string::npos);
}

TEST(ArrayFile, SaysWhatIsWrong) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.fwc";
    EXPECT_NE(readErrorOf(file).find("no such file"), std::string::npos);
    io::writeFile(file, std::string_view(""));
    EXPECT_NE(readErrorOf(file).find("is no checkpoint"), std::string::npos);
    io::writeArrayFile(file, makeArrays());
    std::vector<std::uint8_t> bytes = io::readFile(file);
    bytes[24] = 9;
    test::writeBytes(file, bytes);
    EXPECT_NE(readErrorOf(file).find("written by another version: layout 9"), std::string::npos);
}

// What a digest does not tell: bytes that are no HDF5.
TEST(ArrayFile, BytesThatAreNoHdf5AreRefused) {
    EXPECT_THROW(io::readHdf5Image({}, "none"), base::FileError);
    const std::vector<std::uint8_t> noise = someValues<std::uint8_t>(5000);
    EXPECT_THROW(io::readHdf5Image(noise, "noise"), base::FileError);
}

// A file that cannot grow further stands for a full disk.
TEST(ArrayFile, AFullDiskKeepsTheFormerFile) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.fwc";
    NamedArrays small;
    small.kind = "small";
    io::writeArrayFile(file, small);

    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit tight = before;
    tight.rlim_cur = 8192;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
    std::string message = "no error";
    try {
        io::writeArrayFile(file, makeArrays());
    } catch (const base::FileError& e) {
        message = e.what();
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);

    EXPECT_NE(message.find("cannot be written: File too large"), std::string::npos) << message;
    EXPECT_EQ(io::readArrayFile(file).kind, "small");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace fluxwalk
