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

/// Headers of OpenCL, Beast and Asio, ITK, assimp, SOCI, OSMesa and NATS outside the one room that may use
/// them.
std::vector<std::string> library_violations(const std::filesystem::path& root);

/// Headers over 150 lines and sources (kernels too) over 400.
std::vector<std::string> length_violations(const std::filesystem::path& root);

}  // namespace ream::layering
