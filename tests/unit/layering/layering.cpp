#include "unit/layering/layering.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <numeric>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "unit/layering/source_shape.hpp"

namespace ream::layering {
namespace fs = std::filesystem;
namespace {

using Rooms = std::map<std::string, std::set<std::string>>;

/// The arrows as the house plan draws them, before following them further.
const Rooms& drawn_arrows() {
  static const Rooms arrows{
      {"app", {"api", "plugin"}},
      {"api", {"study", "workup"}},
      {"workup", {"jobs"}},
      {"reader", {"ct", "record", "store"}},
      {"study", {"session", "access", "statistics"}},
      {"jobs", {"session"}},
      {"session", {"sim", "openigtlink", "report", "ct", "render", "solve", "store", "net", "twin"}},
      {"twin", {"collide", "record", "stream"}},
      {"sim", {"collide", "force", "record", "case"}},
      {"collide", {"shell"}},
      {"stream", {"surface"}},
      {"openigtlink", {"stream"}},
      {"score", {"record", "surface", "render", "statistics"}},
      {"report", {"score"}},
      {"plugin", {"score", "device", "access"}},
      {"ct", {"case", "isolation", "surface"}},
      {"solve", {"fe"}},
      {"fe", {"case"}},
      {"case", {"voxel", "shell", "force"}},
      {"shell", {"voxel", "voxelizer"}},
      {"voxelizer", {"geometry", "gpu"}},
      {"record", {"case", "device", "tables"}},
      {"surface", {"voxel"}},
      {"voxel", {"geometry", "gpu"}},
      {"device", {"force", "net"}},
      {"force", {"geometry"}},
      {"renderer", {"render"}},
      {"render", {"geometry"}},
      {"geometry", {"isolation"}},
      {"gpu", {"core"}},
      {"access", {"store"}},
      {"store", {"core"}},
      {"net", {"core"}},
      {"tables", {"isolation"}},
      {"isolation", {"core"}},
      {"statistics", {"core"}},
      {"core", {}},
  };
  return arrows;
}

struct Library {
  const char* name;
  std::regex header;
  const char* rooms;  ///< "one" or "one, other"
};

const std::vector<Library>& single_room_libraries() {
  static const std::vector<Library> libraries{
      {"OpenCL", std::regex("(CL|OpenCL)/.*"), "gpu"},
      {"Beast and Asio", std::regex("boost/(beast|asio)(/|\\.).*"), "net"},
      {"Boost.Math", std::regex("boost/math(/|\\.).*"), "statistics"},
      {"OpenSSL", std::regex("openssl/.*"), "net"},
      {"ITK", std::regex("(itk|vnl/|gdcm).*"), "ct, reader"},
      {"assimp", std::regex("assimp/.*"), "geometry, reader"},
      {"assimp's importer", std::regex("assimp/(Importer|postprocess)\\..*"), "reader"},
      {"SOCI", std::regex("soci/.*"), "store"},
      {"libsodium", std::regex("sodium(/.*|\\.h)"), "access"},
      {"OSMesa and OpenGL", std::regex("(GL|EGL|GLES[0-9]*)/.*"), "renderer"},
      {"Cairo and Pango", std::regex("(cairo|pango)[-a-z/]*\\.h"), "report"},
      {"libsndfile", std::regex("sndfile\\.h.*"), "reader"},
      {"libsamplerate", std::regex("samplerate\\.h.*"), "force"},
      {"OpenIGTLink", std::regex("igtl.*\\.h"), "openigtlink"},
      {"libseccomp and Landlock", std::regex("(seccomp|linux/landlock)\\.h"), "isolation"},
      {"HDF5", std::regex("(H5.*|hdf5(_hl)?)\\.h"), "tables"},
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

bool is_header(const fs::path& file) { return has_extension(file, {".hpp", ".h"}); }
std::string name_of(const fs::path& root, const fs::path& file) { return fs::relative(file, root).string(); }

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}
int lines_of(const fs::path& file) {
  const std::string text = text_of(file);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::vector<FunctionLines> functions_under(const fs::path& root) {
  std::vector<FunctionLines> functions;
  for (const fs::path& file : files_under(root / "server"))
    for (const FunctionLines& function : function_lines(name_of(root, file), text_of(file)))
      functions.push_back(function);
  return functions;
}

/// Names, and for each the names it leads to.
using Graph = std::map<std::string, std::set<std::string>>;

Graph include_graph(const fs::path& root) {
  Graph graph;
  for (const fs::path& file : files_under(root / "server"))
    for (const Include& include : includes_of(root, file))
      if (fs::exists(root / "server" / include.path))
        graph[name_of(root, file)].insert("server/" + include.path);
  return graph;
}

/// Walks the graph and writes down each cycle it meets, "a -> b -> a".
class CycleFinder {
 public:
  explicit CycleFinder(const Graph& graph) : graph_(graph) {}
  std::vector<std::string> find() {
    for (const auto& [name, targets] : graph_) visit(name);
    return found_;
  }

 private:
  void visit(const std::string& name) {
    const auto on_way = std::find(way_.begin(), way_.end(), name);
    if (on_way != way_.end()) {
      std::string cycle;
      for (auto step = on_way; step != way_.end(); ++step) cycle += *step + " -> ";
      found_.push_back(cycle + name);
      return;
    }
    if (!seen_.insert(name).second || !graph_.contains(name)) return;
    way_.push_back(name);
    for (const std::string& target : graph_.at(name)) visit(target);
    way_.pop_back();
  }

  const Graph& graph_;
  std::set<std::string> seen_;
  std::vector<std::string> way_, found_;
};

std::vector<std::string> cycles(const Graph& graph) { return CycleFinder(graph).find(); }

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

/// Lines of server/ that match, but for those of the files named: "FILE:LINE: words".
std::vector<std::string> lines_with(const fs::path& root, const std::regex& pattern,
                                    const std::set<std::string>& but, const std::string& words) {
  std::vector<std::string> found;
  for (const fs::path& file : files_under(root / "server")) {
    if (but.contains(name_of(root / "server", file))) continue;
    std::ifstream in(file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number)
      if (std::regex_search(line, pattern))
        found.push_back(name_of(root, file) + ":" + std::to_string(number) + ": " + words);
  }
  return found;
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

bool named_in(const std::string& rooms, const std::string& room) {
  return (", " + rooms + ",").find(" " + room + ",") != std::string::npos;
}

std::vector<std::string> library_violations(const fs::path& root) {
  std::vector<std::string> found;
  for_each_include(root, [&](const std::string& room, const Include& include) {
    for (const Library& library : single_room_libraries())
      if (!named_in(library.rooms, room) && std::regex_match(include.path, library.header))
        found.push_back(include.place + ": " + include.path + ": " + library.name + " belongs to " +
                        library.rooms);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> thread_violations(const fs::path& root) {
  static const std::regex started(
      "std::j?thread "
      "*[({]|std::jthread|std::async|pthread_create|\\bthreads?_?[({]\\[|(threads|workers|helpers)_?\\."
      "emplace_back");
  return lines_with(root, started, {"core/signal_handlers.hpp"}, "use start_thread() or start_task()");
}

std::vector<std::string> json_violations(const fs::path& root) {
  static const std::regex parsed("json::(parse|accept|sax_parse|from_\\w+) *\\(|>> *\\w*json\\b");
  // The second reads a file of this project while it is built.
  return lines_with(root, parsed, {"core/json.cpp", "record/make_ops.cpp"},
                    "use parse_json() or parse_json_or_discard()");
}

std::vector<std::string> length_violations(const fs::path& root) {
  std::vector<std::string> found;
  for (const char* folder : {"server", "kernels"})
    for (const fs::path& file : files_under(root / folder)) {
      const int lines = lines_of(file);
      const int limit = is_header(file) ? server_limits.header_lines : server_limits.source_lines;
      if (lines > limit)
        found.push_back(name_of(root, file) + ":" + std::to_string(lines) + ": longer than " +
                        std::to_string(limit) + " lines");
    }
  return found;
}

std::vector<std::string> function_violations(const fs::path& root) {
  std::vector<std::string> found;
  for (const FunctionLines& function : functions_under(root))
    if (function.lines > server_limits.function_lines)
      found.push_back(function.place + ": a function of " + std::to_string(function.lines) + " lines");
  return found;
}

std::vector<std::string> file_cycles(const fs::path& root) { return cycles(include_graph(root)); }

std::vector<std::string> folder_cycles(const fs::path& root) {
  Graph folders;
  for (const auto& [file, targets] : include_graph(root))
    for (const std::string& target : targets) {
      const std::string from = fs::path(file).parent_path(), to = fs::path(target).parent_path();
      if (from != to) folders[from].insert(to);
    }
  return cycles(folders);
}

std::vector<std::string> single_function_headers(const fs::path& root) {
  std::vector<std::string> found;
  for (const fs::path& file : files_under(root / "server")) {
    if (!is_header(file)) continue;
    const Declarations declared = declarations(text_of(file));
    if (declared.functions == 1 && declared.types == 0) found.push_back(name_of(root, file));
  }
  return found;
}

std::vector<std::string> private_headers(const fs::path& root) {
  std::map<std::string, std::set<std::string>> users;
  for (const auto& [file, targets] : include_graph(root))
    for (const std::string& target : targets)
      if (fs::path(file).replace_extension() != fs::path(target).replace_extension())
        users[target].insert(file);
  for (const fs::path& test : files_under(root / "tests"))
    for (const Include& include : includes_of(root, test)) users["server/" + include.path].insert("tests");
  std::vector<std::string> found;
  for (const auto& [header, by] : users)
    if (by.size() == 1 && fs::path(*by.begin()).parent_path() == fs::path(header).parent_path())
      found.push_back(header + ": " + *by.begin() + " alone includes it");
  return found;
}

Totals totals(const fs::path& root) {
  std::vector<int> files, functions;
  for (const fs::path& file : files_under(root / "server")) files.push_back(lines_of(file));
  for (const FunctionLines& function : functions_under(root)) functions.push_back(function.lines);
  std::sort(files.begin(), files.end());
  std::sort(functions.begin(), functions.end());
  Totals sizes;
  sizes.files = static_cast<int>(files.size());
  sizes.lines = std::accumulate(files.begin(), files.end(), 0);
  sizes.functions = static_cast<int>(functions.size());
  if (!files.empty()) sizes.median_file_lines = files[files.size() / 2];
  if (!functions.empty()) sizes.p90_function_lines = functions[functions.size() * 9 / 10];
  return sizes;
}

}  // namespace ream::layering
