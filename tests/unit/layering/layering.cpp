#include "unit/layering/layering.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>

namespace ream::layering {
namespace fs = std::filesystem;
namespace {

using Rooms = std::map<std::string, std::set<std::string>>;

/// The arrows as the house plan draws them, before following them further.
const Rooms& drawn_arrows() {
  static const Rooms arrows{
      {"app", {"api", "openigtlink"}},
      {"api", {"sim", "stream", "score", "report", "ct", "fe", "render", "access", "net"}},
      {"sim", {"collide", "force", "record", "case"}},
      {"collide", {"shell"}},
      {"stream", {"surface"}},
      {"openigtlink", {"stream"}},
      {"score", {"record", "surface", "render"}},
      {"report", {"score"}},
      {"ct", {"case"}},
      {"fe", {"case"}},
      {"case", {"voxel", "shell"}},
      {"shell", {"voxel", "voxelizer"}},
      {"voxelizer", {"geometry", "gpu"}},
      {"record", {"case", "device"}},
      {"surface", {"voxel"}},
      {"voxel", {"geometry", "gpu"}},
      {"device", {"geometry", "net"}},
      {"force", {"geometry"}},
      {"render", {"geometry"}},
      {"geometry", {"core"}},
      {"gpu", {"core"}},
      {"access", {"store"}},
      {"store", {"core"}},
      {"net", {"core"}},
      {"core", {}},
  };
  return arrows;
}

struct Library {
  const char* name;
  std::regex header;
  const char* room;
};

const std::vector<Library>& single_room_libraries() {
  static const std::vector<Library> libraries{
      {"OpenCL", std::regex("(CL|OpenCL)/.*"), "gpu"},
      {"Beast and Asio", std::regex("boost/(beast|asio)(/|\\.).*"), "net"},
      {"OpenSSL", std::regex("openssl/.*"), "net"},
      {"ITK", std::regex("(itk|vnl/|gdcm).*"), "ct"},
      {"assimp", std::regex("assimp/.*"), "geometry"},
      {"SOCI", std::regex("soci/.*"), "store"},
      {"libsodium", std::regex("sodium(/.*|\\.h)"), "access"},
      {"OSMesa and OpenGL", std::regex("(GL|EGL|GLES[0-9]*)/.*"), "render"},
      {"Cairo and Pango", std::regex("(cairo|pango)[-a-z/]*\\.h"), "report"},
      {"libsndfile and libsamplerate", std::regex("(sndfile|samplerate)\\.h.*"), "force"},
      {"OpenIGTLink", std::regex("igtl.*\\.h"), "openigtlink"},
      {"NATS", std::regex("nats(/.*|\\.h)"), "stream"},
  };
  return libraries;
}

struct Include {
  std::string place;  ///< file:line
  std::string path;
  bool quoted = false;
};

bool has_extension(const fs::path& file, std::initializer_list<const char*> extensions) {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* e) { return file.extension() == e; });
}

std::vector<fs::path> files_under(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && has_extension(entry.path(), {".hpp", ".h", ".cpp", ".c", ".cl"}))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Include> includes_of(const fs::path& root, const fs::path& file) {
  static const std::regex directive("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  std::vector<Include> includes;
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::smatch match;
    if (std::regex_match(line, match, directive))
      includes.push_back(
          {fs::relative(file, root).string() + ":" + std::to_string(number), match[2], match[1] == "\""});
  }
  return includes;
}

/// First folder of a path with folders; empty for a bare name.
std::string first_folder(const fs::path& path) {
  return path.has_parent_path() ? path.begin()->string() : "";
}

/// Calls `visit(room, include)` for every include under server/.
void for_each_include(const fs::path& root,
                      const std::function<void(const std::string&, const Include&)>& visit) {
  for (const fs::path& file : files_under(root / "server")) {
    const std::string room = first_folder(fs::relative(file, root / "server"));
    for (const Include& include : includes_of(root, file)) visit(room, include);
  }
}

std::optional<std::string> arrow_fault(const fs::path& root, const std::string& room,
                                       const Include& include) {
  const std::string target = first_folder(include.path);
  if (include.path.find("..") != std::string::npos) return "leaves its folder by \"..\"";
  // <net/if.h> and the like are the system's, unless there is such a file of ours.
  const bool ours = include.quoted || fs::exists(root / "server" / include.path);
  if (target.empty() || target == room || target == "kernels" || !ours) return std::nullopt;
  if (!allowed_rooms().contains(target)) return "\"" + target + "\" is no room";
  if (!allowed_rooms().at(room).contains(target)) return room + " may not include " + target;
  return std::nullopt;
}

void check_kernel_includes(const fs::path& root, std::vector<std::string>& found) {
  for (const fs::path& file : files_under(root / "kernels"))
    for (const Include& include : includes_of(root, file)) {
      // A structure shared with C++ may take its integer types from there.
      if (include.path == "cstdint" || include.path == "stdint.h") continue;
      if (!fs::exists(root / "kernels" / include.path))
        found.push_back(include.place + ": " + include.path + ": kernels include only files of kernels/");
    }
}

}  // namespace

const Rooms& allowed_rooms() {
  static const Rooms reached = [] {
    Rooms rooms = drawn_arrows();
    for (bool grew = true; grew;) {
      grew = false;
      for (auto& [room, targets] : rooms) {
        const std::set<std::string> before = targets;
        for (const std::string& target : before)
          targets.insert(rooms.at(target).begin(), rooms.at(target).end());
        grew = grew || targets.size() != before.size();
      }
    }
    return rooms;
  }();
  return reached;
}

std::vector<std::string> arrow_violations(const fs::path& root) {
  std::vector<std::string> found;
  std::set<std::string> unknown_rooms;
  for_each_include(root, [&](const std::string& room, const Include& include) {
    if (!allowed_rooms().contains(room)) {
      unknown_rooms.insert(room);
    } else if (const auto fault = arrow_fault(root, room, include)) {
      found.push_back(include.place + ": " + include.path + ": " + *fault);
    }
  });
  for (const std::string& room : unknown_rooms)
    found.push_back("server/" + room + ":1: is no room of the house plan");
  check_kernel_includes(root, found);
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> library_violations(const fs::path& root) {
  std::vector<std::string> found;
  for_each_include(root, [&](const std::string& room, const Include& include) {
    for (const Library& library : single_room_libraries())
      if (room != library.room && std::regex_match(include.path, library.header))
        found.push_back(include.place + ": " + include.path + ": " + library.name + " belongs to " +
                        library.room);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> length_violations(const fs::path& root) {
  std::vector<std::string> found;
  for (const char* folder : {"server", "kernels"})
    for (const fs::path& file : files_under(root / folder)) {
      std::ifstream in(file);
      const auto lines =
          std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
      const int limit = has_extension(file, {".hpp", ".h"}) ? 150 : 400;
      if (lines > limit)
        found.push_back(fs::relative(file, root).string() + ":" + std::to_string(lines) + ": longer than " +
                        std::to_string(limit) + " lines");
    }
  return found;
}

}  // namespace ream::layering
