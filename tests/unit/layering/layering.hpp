#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ream::layering {

/// Rooms of server/ and, for each, every room whose headers it may include: the house plan's arrows and all
/// that they reach. A room is not in its own set.
const std::map<std::string, std::set<std::string>>& allowed_rooms();

/// Each returns what is wrong as "file:line: what", paths relative to `root`, sorted; empty when all is well.
/// `root` is a source tree with folders server/ and, where there are any, kernels/.

/// Includes that point up or sideways, leave their folder by "..", or name an unknown room; folders of
/// server/ that are no room; kernels that include anything outside kernels/.
std::vector<std::string> arrow_violations(const std::filesystem::path& root);

/// Headers of OpenCL, Beast and Asio, Boost.Math, ITK, assimp, SOCI, OSMesa and NATS outside the one room
/// that may use them.
std::vector<std::string> library_violations(const std::filesystem::path& root);

/// Headers and sources (kernels too) with more lines than `server_limits` has.
std::vector<std::string> length_violations(const std::filesystem::path& root);

/// Threads of server/ that are started otherwise than by core's start_thread() and start_task(), which give
/// them a stack for signals.
std::vector<std::string> thread_violations(const std::filesystem::path& root);

/// Text of server/ that is read as JSON otherwise than by core's parse_json() and parse_json_or_discard(),
/// which bound its depth.
std::vector<std::string> json_violations(const std::filesystem::path& root);

/// Functions of server/ with more lines than `server_limits` has.
std::vector<std::string> function_violations(const std::filesystem::path& root);

/// Cycles of includes under server/, "a -> b -> a": between files, and between the folders in which they lie
/// (every folder for itself, not with those inside it).
std::vector<std::string> file_cycles(const std::filesystem::path& root);
std::vector<std::string> folder_cycles(const std::filesystem::path& root);

/// Headers of server/ that declare one free function and no type: they belong to a noun's header.
std::vector<std::string> single_function_headers(const std::filesystem::path& root);

/// Headers of server/ that one other file includes, one of their own folder, and no test: private parts of
/// it.
std::vector<std::string> private_headers(const std::filesystem::path& root);

/// Sizes of what lies under server/.
struct Totals {
  int files = 0, lines = 0, median_file_lines = 0;
  int functions = 0, p90_function_lines = 0;
};
Totals totals(const std::filesystem::path& root);

/// Upper and lower bounds on the shape of server/
struct Limits {
  int header_lines, source_lines, function_lines, p90_function_lines;
  int folder_cycles, single_function_headers, private_headers;
  int files, lines, min_median_file_lines, max_median_file_lines;
};
inline constexpr Limits server_limits{.header_lines = 250,
                                      .source_lines = 600,
                                      .function_lines = 80,
                                      .p90_function_lines = 25,
                                      .folder_cycles = 0,
                                      .single_function_headers = 15,
                                      .private_headers = 23,
                                      .files = 1097,
                                      .lines = 101900,
                                      .min_median_file_lines = 70,
                                      .max_median_file_lines = 110};

}  // namespace ream::layering
