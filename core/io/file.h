#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

/// Whole files in and out.
namespace fluxwalk::io {

/// Longest file that is read: a .glb cannot be longer, its lengths have 32 bits.
inline constexpr std::uint64_t kMaxFileBytes = 0xffffffffu;

/// Content of a regular file. Throws base::FileError.
std::vector<std::uint8_t> readFile(const std::filesystem::path& file, std::uint64_t maxBytes = kMaxFileBytes);

/// Writes beside `file` and renames, so that the old content stays until the new one is complete; a device
/// such as /dev/stdout is written to directly. Throws base::FileError and then leaves nothing behind.
void writeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
void writeFile(const std::filesystem::path& file, std::string_view text);

/// The same for several parts one behind the other, and durable: when it returns, they are on the disk.
void replaceFile(const std::filesystem::path& file, std::span<const std::span<const std::uint8_t>> parts);

}  // namespace fluxwalk::io
