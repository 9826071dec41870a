#include "shell/reamer_library.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "shell/parametric_profile.hpp"

namespace ream::shell {
namespace fs = std::filesystem;
namespace {

std::string nipple_words() { return " nipple 3,8"; }

LibraryReamer convex(int radius_mm, int diameter_mm, bool cannulated) {
  LibraryReamer reamer;
  const std::string radius = std::to_string(radius_mm);
  reamer.name = (cannulated ? "cannulated-" : "convex-") + radius;
  reamer.words = "sphere " + radius + "," + std::to_string(diameter_mm / 2) +
                 (cannulated ? std::string() : nipple_words());
  reamer.diameter_mm = diameter_mm;
  reamer.radius_mm = radius_mm;
  if (!cannulated) reamer.nipple = Nipple{};
  reamer.cannulated = cannulated;
  reamer.description = "Convex, for a component whose back has a radius of " + radius + " mm; " +
                       (cannulated ? "runs on a guide pin" : "its nipple runs in the pilot hole");
  return reamer;
}

std::vector<LibraryReamer> made_built_in() {
  std::vector<LibraryReamer> all{
      {"thesis", thesis_tool, 32.0, 32.0, Nipple{}, false, "Bench case of the thesis, section 5.4.2"},
      {"thesis-appendix-a", "ellipse 18.25,9", 36.5, 18.25 * 18.25 / 9.0, std::nullopt, false,
       "Ellipsoid of the thesis, appendix A; no nipple"}};
  // Radii of the backs of anatomic components in use; diameters between the width and the height of a
  // glenoid, growing with the radius as sizes do. No maker's product is meant.
  constexpr int sizes[][2] = {{30, 28}, {35, 30}, {40, 32}, {45, 34}, {50, 36}, {55, 36}, {60, 38}};
  for (const auto& [radius, diameter] : sizes) all.push_back(convex(radius, diameter, false));
  for (const auto& [radius, diameter] : sizes) all.push_back(convex(radius, diameter, true));
  all.push_back(
      {"flat-30", "sphere 1000,15" + nipple_words(), 30.0, 1000.0, Nipple{}, false,
       "Nearly flat, for a component with a flat back (compared with convex ones by Karelse 2014)"});
  all.push_back({"baseplate-27", "sphere 60,13.5", 27.0, 60.0, std::nullopt, true,
                 "27 mm across on a guide pin, the size used for the base plate of reverse components; the "
                 "radius is our choice"});
  return all;
}

bool is_mesh_file(const fs::path& file) {
  for (const char* known : {".stl", ".obj", ".ply"})
    if (file.extension() == known) return true;
  return false;
}

bool is_reamer_name(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}

struct MeshNote {
  std::optional<ToolAxis> axis;
  bool cannulated = false;
  std::string description;
};

MeshNote note_beside(const fs::path& mesh) {
  MeshNote note;
  fs::path file = mesh;
  file.replace_extension(".json");
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return note;
  const nlohmann::json value = read_json_file(file);
  JsonReader reader(value, file.string());
  if (reader.has("axis")) {
    const auto n = reader.numbers("axis", 6);
    note.axis = ToolAxis{Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5])};
    if (!(note.axis->direction.norm() > 1e-9))
      reader.refuse("axis", "must end with a direction other than zero");
  }
  note.cannulated = reader.boolean_or("cannulated", false);
  note.description = reader.text_or("description", "");
  reader.finish();
  return note;
}

/// Radius of the sphere through the apex and the cutting surface half way out.
double radius_near_apex(const ToolProfile& profile) {
  const ProfilePoint* nearest = nullptr;
  const double half = 0.5 * profile.max_radius_mm();
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    const ProfilePoint& point = profile.points[i + 1];
    if (profile.roles[i] != SurfaceRole::cutting) continue;
    if (!nearest || std::abs(point.radius_mm - half) < std::abs(nearest->radius_mm - half)) nearest = &point;
  }
  if (!nearest || !(nearest->z_mm < 0.0)) return 0.0;
  return (nearest->radius_mm * nearest->radius_mm + nearest->z_mm * nearest->z_mm) / (-2.0 * nearest->z_mm);
}

std::optional<Nipple> nipple_of(const ToolProfile& profile) {
  Nipple nipple{0.0, 0.0};
  for (size_t i = 0; i < profile.roles.size(); ++i)
    if (profile.roles[i] == SurfaceRole::guiding) {
      nipple.radius_mm = std::max(nipple.radius_mm, profile.points[i + 1].radius_mm);
      nipple.height_mm = std::max(nipple.height_mm, profile.points[i].z_mm);
    }
  if (nipple.radius_mm > 0.0 && nipple.height_mm > 0.0) return nipple;
  return std::nullopt;
}

void measure_into(LibraryReamer& reamer, const ToolProfile& profile) {
  reamer.diameter_mm = 2.0 * profile.max_radius_mm();
  reamer.radius_mm = radius_near_apex(profile);
  reamer.nipple = nipple_of(profile);
}

LibraryReamer reamer_of_mesh(const fs::path& mesh) {
  const MeshNote note = note_beside(mesh);
  LibraryReamer reamer;
  reamer.name = mesh.stem().string();
  reamer.words = mesh.string();
  reamer.cannulated = note.cannulated;
  reamer.description = note.description;
  reamer.axis = note.axis;
  measure_into(reamer, make_tool(reamer.words, note.axis).profile);
  return reamer;
}

LibraryReamer listed_mesh(const fs::path& mesh) {
  const std::string name = mesh.stem().string();
  if (!is_reamer_name(name) || find_reamer(name))
    throw Error(ErrorKind::invalid_input,
                mesh.string() + ": the name must be of a-z, 0-9 and - and not that of a built-in reamer");
  return reamer_of_mesh(mesh);
}

std::vector<fs::path> mesh_files(const fs::path& data_folder) {
  std::vector<fs::path> files;
  std::error_code gone;
  for (const fs::path& path : paths_in(data_folder / "reamers"))
    if (fs::is_regular_file(path, gone) && is_mesh_file(path)) files.push_back(path);
  return files;
}

}  // namespace

const std::vector<LibraryReamer>& built_in_reamers() {
  static const std::vector<LibraryReamer> all = made_built_in();
  return all;
}

const LibraryReamer* find_reamer(const std::string& name) {
  for (const LibraryReamer& reamer : built_in_reamers())
    if (reamer.name == name) return &reamer;
  return nullptr;
}

std::string built_in_names() {
  std::string names;
  for (const LibraryReamer& reamer : built_in_reamers()) names += (names.empty() ? "" : ", ") + reamer.name;
  return names;
}

std::vector<LibraryReamer> reamers_of(const fs::path& data_folder, std::vector<std::string>* warnings) {
  std::vector<LibraryReamer> all = built_in_reamers();
  const auto warn = [&](const std::string& what) {
    if (warnings) warnings->push_back(what);
  };
  std::vector<fs::path> meshes;
  try {
    meshes = mesh_files(data_folder);
  } catch (const Error& e) {
    warn(std::string("reamers of the data folder are left out: ") + e.what());
  }
  for (const fs::path& mesh : meshes) try {
      all.push_back(listed_mesh(mesh));
    } catch (const Error& e) {
      warn(std::string("a reamer is left out: ") + e.what());
    }
  return all;
}

LibraryReamer reamer_named(const std::string& name, const fs::path& data_folder) {
  if (const LibraryReamer* built_in = find_reamer(name)) return *built_in;
  std::string names = built_in_names();
  for (const fs::path& mesh : mesh_files(data_folder)) {
    if (mesh.stem() == name) return listed_mesh(mesh);
    names += ", " + mesh.stem().string();
  }
  throw Error(ErrorKind::usage, "there is no reamer '" + name + "'; there are " + names);
}

LibraryReamer described_reamer(const std::string& asked_for) {
  if (const LibraryReamer* built_in = find_reamer(asked_for)) return *built_in;
  for (const LibraryReamer& reamer : built_in_reamers())
    if (reamer.words == asked_for) return reamer;
  if (!is_parametric(asked_for) && is_mesh_file(asked_for)) return reamer_of_mesh(asked_for);
  LibraryReamer reamer;
  reamer.words = asked_for;
  measure_into(reamer, make_tool(asked_for).profile);
  return reamer;
}

std::optional<ToolAxis> axis_noted_for(const fs::path& mesh) { return note_beside(mesh).axis; }

const LibraryReamer& reamer_for_implant(double implant_radius_mm) {
  const LibraryReamer* best = nullptr;
  for (const LibraryReamer& reamer : built_in_reamers()) {
    if (!reamer.name.starts_with("convex-")) continue;
    if (!best ||
        std::abs(reamer.radius_mm - implant_radius_mm) < std::abs(best->radius_mm - implant_radius_mm))
      best = &reamer;
  }
  return *best;
}

}  // namespace ream::shell
