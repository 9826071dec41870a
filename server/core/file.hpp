#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ream {

/// Whole file as text or bytes. Throws Error: not_found when there is no such file, io when it cannot be
/// read.
std::string read_text_file(const std::filesystem::path& path);
std::vector<std::byte> read_binary_file(const std::filesystem::path& path);

/// Replaces `path` as a whole: written to a temporary name beside it, fsynced, renamed. On any failure the
/// old file is untouched and no temporary is left. Throws Error io naming the path.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Parsed JSON (parse_json of core/json.hpp) of at most 64 MB; Error invalid_input names the file and the
/// place of a syntax error.
nlohmann::json read_json_file(const std::filesystem::path& path);

/// Indented, with a line feed at the end. Error io.
void write_json_file(const std::filesystem::path& path, const nlohmann::json& json);

/// Names that were made in the folder survive a loss of power from here on, where the file system can promise
/// it. Throws Error io.
void sync_folder(const std::filesystem::path& folder);

/// What a file holds survives a loss of power from here on. Throws Error io.
void sync_file(const std::filesystem::path& file);
/// Files and names of a whole folder survive a loss of power from here on, but not yet its own name. Throws
/// Error io.
void sync_tree(const std::filesystem::path& folder);

/// Creates `path` and its parents, so that they survive a loss of power, and proves that a file can be
/// written there. Throws Error io.
void make_writable_folder(const std::filesystem::path& path);

/// Reads a file that holds one zstd frame of exactly the size of `raw`, as `description` (the name of a file
/// beside it) says. Errors name the file: not_found; io; invalid_input when it is no zstd data, of another
/// size, damaged or cut short.
void read_zstd_file(const std::filesystem::path& path, std::span<std::byte> raw, const char* description);

/// Replaces the file atomically. Throws Error io.
void write_zstd_file(const std::filesystem::path& path, std::span<const std::byte> raw);

}  // namespace ream
