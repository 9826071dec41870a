#include "case/case.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "case/plan.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json_reader.hpp"
#include "force/edge_load.hpp"
#include "geometry/pose_json.hpp"
#include "voxel/bricks.hpp"

namespace ream::case_ {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr int64_t max_dim = 65528;
constexpr double max_voxels = 4.0e9;
constexpr double min_slope = 1e-6, max_coefficient = 1e6;
constexpr double unit_tolerance = 1e-6;

bool valid_id(const std::string& id) {
  return !id.empty() && id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}

json to_json(const Case& c) {
  const auto& grid = c.bone.grid;
  json value = {{"id", c.id},
                {"name", c.name},
                {"source", c.source},
                {"side", to_text(c.side)},
                {"dims", {grid.dims.x(), grid.dims.y(), grid.dims.z()}},
                {"spacing_mm", json_of(grid.spacing_mm)},
                {"world_from_grid", ream::to_json(grid.world_from_grid)},
                {"cortical_threshold_g_cc", c.bone.cortical_threshold_g_cc},
                {"calibration", to_json(c.calibration)},
                {"warnings", c.warnings}};
  if (c.glenoid) value["glenoid"] = to_json(*c.glenoid);
  if (c.cutting) value["cutting"] = force::to_json(*c.cutting);
  return value;
}

voxel::VoxelGrid read_grid(JsonReader& reader) {
  voxel::VoxelGrid grid;
  const auto dims = reader.numbers("dims", 3);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = dims[static_cast<size_t>(axis)];
    if (!(d >= 1.0 && d <= static_cast<double>(max_dim)) || d != std::floor(d))
      reader.refuse("dims", "must be three positive whole numbers");
    grid.dims[axis] = static_cast<int>(d);
  }
  if (dims[0] * dims[1] * dims[2] > max_voxels) reader.refuse("dims", "is more than 4e9 voxels");
  grid.spacing_mm = read_vec3(reader, "spacing_mm");
  grid.world_from_grid = pose_from_json(reader.object("world_from_grid"));
  try {
    voxel::validate(grid);
  } catch (const Error& e) {
    throw Error(e.kind(), reader.place() + ": " + e.what());
  }
  return grid;
}

std::vector<uint8_t> read_voxels(const fs::path& file, const voxel::VoxelGrid& grid) {
  std::vector<uint8_t> rows(grid.voxel_count());
  read_zstd_file(file, std::as_writable_bytes(std::span(rows)), "case.json");
  return voxel::bricks_from_rows(grid, rows);
}

void write_voxels(const fs::path& file, const voxel::VoxelGrid& grid, std::span<const uint8_t> bricks) {
  const std::vector<uint8_t> rows = voxel::rows_from_bricks(grid, bricks);
  write_zstd_file(file, std::as_bytes(std::span(rows)));
}

}  // namespace

Case load_case_description(const fs::path& folder) {
  const fs::path file = folder / "case.json";
  if (fs::is_regular_file(folder / "ct" / "ct.json") && !fs::is_regular_file(file))
    throw Error(ErrorKind::conflict, "case '" + folder.filename().string() +
                                         "' holds only a CT so far; build its bone first, on its page");
  if (!fs::is_regular_file(file))
    throw Error(ErrorKind::not_found, folder.string() + " is not a case: it has no case.json");
  const json value = read_json_file(file);
  JsonReader reader(value, file.string());
  Case c;
  c.id = reader.text("id");
  if (!valid_id(c.id)) reader.refuse("id", "may hold only a-z, 0-9 and -");
  c.name = reader.text("name");
  c.source = reader.text("source");
  c.side = side_from_json(reader);
  c.bone.grid = read_grid(reader);
  c.bone.cortical_threshold_g_cc = reader.number("cortical_threshold_g_cc", 0.0, 3.0);
  if (!reader.has("calibration")) reader.refuse("calibration", "is missing");
  c.calibration = calibration_from_json(value.at("calibration"), reader.place() + ".calibration");
  if (reader.has("glenoid")) c.glenoid = glenoid_from_json(reader.object("glenoid"));
  if (reader.has("cutting")) c.cutting = force::cutting_from_json(reader.object("cutting"));
  c.warnings = reader.texts_or_none("warnings");
  reader.finish();
  const fs::path plan = folder / "plan.json";
  if (fs::exists(plan)) c.plan = plan_from_json(read_json_file(plan), plan.string());
  return c;
}

Case load_case(const fs::path& folder) {
  Case c = load_case_description(folder);
  c.bone.density = read_voxels(folder / "density.zst", c.bone.grid);
  c.bone.coverage = read_voxels(folder / "coverage.zst", c.bone.grid);
  return c;
}

Case load_case(const fs::path& folder, const voxel::SharedBytes& density) {
  Case c = load_case_description(folder);
  if (density.size() != c.bone.grid.voxel_count()) return load_case(folder);
  c.bone.density = density;
  c.bone.coverage = read_voxels(folder / "coverage.zst", c.bone.grid);
  return c;
}

namespace {

void check(const Case& c) {
  if (!valid_id(c.id))
    throw Error(ErrorKind::invalid_input, "case id '" + c.id + "' may hold only a-z, 0-9 and -");
  voxel::validate(c.bone.grid);
  const size_t voxels = c.bone.grid.voxel_count();
  if (c.bone.density.size() != voxels || c.bone.coverage.size() != voxels)
    throw Error(ErrorKind::invalid_input,
                "case '" + c.id + "' does not have one density and coverage per voxel");
  if (c.plan) validate(*c.plan, "plan of case '" + c.id + "'");
}

void write_bone(const Case& c, const fs::path& folder) {
  write_voxels(folder / "density.zst", c.bone.grid, c.bone.density);
  write_voxels(folder / "coverage.zst", c.bone.grid, c.bone.coverage);
  write_json_file(folder / "case.json", to_json(c));
}

/// The files of a case folder, its CT's included, under a second name.
void link_files(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::create_hard_links, failed);
  if (failed) fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing, failed);
  if (failed) throw Error(ErrorKind::io, "cannot copy " + from.string() + ": " + failed.message());
}

}  // namespace

void save_case(const Case& c, const fs::path& folder, bool replace) {
  check(c);
  AtomicFolder target(folder, replace);
  if (c.plan) write_json_file(target.path() / "plan.json", to_json(*c.plan));
  write_bone(c, target.path());
  target.commit();
}

void save_bone(const Case& c, const fs::path& folder) {
  check(c);
  AtomicFolder target(folder, true);
  link_files(folder, target.path());
  write_bone(c, target.path());
  target.commit();
}

std::string to_text(GuideKind guide) {
  switch (guide) {
    case GuideKind::none: return "none";
    case GuideKind::nipple: return "nipple";
    case GuideKind::pin: return "pin";
  }
  return "none";
}

GuideKind guide_from_text(const std::string& text) {
  if (text == "none") return GuideKind::none;
  if (text == "nipple") return GuideKind::nipple;
  if (text == "pin") return GuideKind::pin;
  throw Error(ErrorKind::invalid_input, "guide '" + text + "' must be none, nipple or pin");
}

GuideKind guide_from_json(JsonReader& reader) {
  const std::string guide = reader.text("guide");
  if (guide != "none" && guide != "nipple" && guide != "pin")
    reader.refuse("guide", "must be none, nipple or pin");
  return guide_from_text(guide);
}

std::string frame_in_words(Side side) { return "millimetres, LPS, " + to_text(side) + " shoulder"; }

std::string to_text(Side side) { return side == Side::left ? "left" : "right"; }

Side side_from_text(const std::string& text) {
  if (text == "left") return Side::left;
  if (text == "right") return Side::right;
  throw Error(ErrorKind::invalid_input, "side '" + text + "' must be left or right");
}

Side side_from_json(JsonReader& reader) {
  const std::string side = reader.text("side");
  if (side != "left" && side != "right") reader.refuse("side", "must be left or right");
  return side_from_text(side);
}

Calibration calibration_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Calibration c;
  c.intercept_mg_cc = reader.number("intercept_mg_cc", -max_coefficient, max_coefficient);
  c.slope_mg_cc_per_hu = reader.number("slope_mg_cc_per_hu", min_slope, max_coefficient);
  c.threshold_hu = reader.number("threshold_hu");
  c.scanner = reader.text_or("scanner", c.scanner);
  c.ash_law = reader.text_or("ash_law", c.ash_law);
  c.ash_intercept_g_cc = reader.number_or("ash_intercept_g_cc", c.ash_intercept_g_cc, -10.0, 10.0);
  c.ash_slope = reader.number_or("ash_slope", c.ash_slope, min_slope, max_coefficient);
  c.ash_per_apparent = reader.number_or("ash_per_apparent", c.ash_per_apparent, 0.01, 1.0);
  reader.finish();
  return c;
}

json to_json(const Calibration& c) {
  json value = {{"intercept_mg_cc", c.intercept_mg_cc},
                {"slope_mg_cc_per_hu", c.slope_mg_cc_per_hu},
                {"threshold_hu", c.threshold_hu},
                {"ash_law", c.ash_law},
                {"ash_intercept_g_cc", c.ash_intercept_g_cc},
                {"ash_slope", c.ash_slope},
                {"ash_per_apparent", c.ash_per_apparent}};
  if (!c.scanner.empty()) value["scanner"] = c.scanner;
  return value;
}

GlenoidFrame glenoid_from_json(JsonReader reader) {
  GlenoidFrame frame;
  frame.centre_mm = read_vec3(reader, "centre_mm");
  for (const auto& [key, axis] :
       {std::pair{"lateral", &frame.lateral}, std::pair{"superior", &frame.superior},
        std::pair{"anterior", &frame.anterior}}) {
    *axis = read_vec3(reader, key);
    if (!(std::abs(axis->norm() - 1.0) < unit_tolerance)) reader.refuse(key, "must be a unit vector");
  }
  reader.finish();
  return frame;
}

json to_json(const GlenoidFrame& frame) {
  return {{"centre_mm", json_of(frame.centre_mm)},
          {"lateral", json_of(frame.lateral)},
          {"superior", json_of(frame.superior)},
          {"anterior", json_of(frame.anterior)}};
}

namespace {

void fold(uint64_t& rolling, double value) {
  rolling = hash_combine(rolling, std::bit_cast<uint64_t>(value));
}

}  // namespace

uint64_t case_hash(const Case& c) {
  const voxel::VoxelGrid& grid = c.bone.grid;
  uint64_t rolling = 0;
  for (int axis = 0; axis < 3; ++axis) {
    rolling = hash_combine(rolling, static_cast<uint64_t>(grid.dims[axis]));
    fold(rolling, grid.spacing_mm[axis]);
    fold(rolling, grid.world_from_grid.translation_mm[axis]);
    for (int column = 0; column < 3; ++column) fold(rolling, grid.world_from_grid.rotation(axis, column));
  }
  fold(rolling, c.bone.cortical_threshold_g_cc);
  rolling = hash_bytes(std::as_bytes(std::span(c.bone.density)), rolling);
  return hash_bytes(std::as_bytes(std::span(c.bone.coverage)), rolling);
}

}  // namespace ream::case_
