#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace ream {

/// Reads a file that holds one zstd frame of exactly the size of `raw`, as `description` (the name of a file
/// beside it) says. Errors name the file: not_found; io; invalid_input when it is no zstd data, of another
/// size, damaged or cut short.
void read_zstd_file(const std::filesystem::path& path, std::span<std::byte> raw, const char* description);

/// Replaces the file atomically. Throws Error io.
void write_zstd_file(const std::filesystem::path& path, std::span<const std::byte> raw);

}  // namespace ream
