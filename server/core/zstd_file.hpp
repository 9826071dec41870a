#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace ream {

/// A file that holds one zstd frame of exactly `raw_bytes`. Errors name the file: not_found, io,
/// invalid_input
/// ("is not zstd data", "holds N bytes where M are needed", "is damaged or cut short").
void read_zstd_file(const std::filesystem::path& path, std::span<std::byte> raw);

/// Replaces the file atomically. Throws Error io.
void write_zstd_file(const std::filesystem::path& path, std::span<const std::byte> raw);

}  // namespace ream
