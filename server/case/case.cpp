#include "case/case.hpp"

#include <zstd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/calibration.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json_reader.hpp"
#include "voxel/brick_order.hpp"

namespace ream::case_ {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr int compression_level = 1;
constexpr int64_t max_dim = 65528;
constexpr double max_voxels = 4.0e9;
constexpr double rotation_tolerance = 1e-6;

json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const std::vector<double>& n) { return {n[0], n[1], n[2]}; }

json rotation_rows(const Mat3& r) {
  return {list(r.row(0).transpose()), list(r.row(1).transpose()), list(r.row(2).transpose())};
}

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
                {"spacing_mm", list(grid.spacing_mm)},
                {"world_from_grid",
                 {{"rotation", rotation_rows(grid.world_from_grid.rotation)},
                  {"translation_mm", list(grid.world_from_grid.translation_mm)}}},
                {"cortical_threshold_g_cc", c.bone.cortical_threshold_g_cc},
                {"calibration", to_json(c.calibration)},
                {"warnings", c.warnings}};
  if (c.glenoid)
    value["glenoid"] = {{"centre_mm", list(c.glenoid->centre_mm)},
                        {"lateral", list(c.glenoid->lateral)},
                        {"superior", list(c.glenoid->superior)},
                        {"anterior", list(c.glenoid->anterior)}};
  return value;
}

Mat3 read_rotation(JsonReader& reader, const json& value) {
  const auto complain = [&] {
    reader.refuse("rotation", "must be three rows of an orthonormal, right-handed matrix");
  };
  if (!reader.has("rotation")) reader.refuse("rotation", "is missing");
  const json& rows = value.at("rotation");
  if (!rows.is_array() || rows.size() != 3) complain();
  Mat3 r;
  for (int i = 0; i < 3; ++i) {
    const json& row = rows[static_cast<size_t>(i)];
    if (!row.is_array() || row.size() != 3) complain();
    for (int j = 0; j < 3; ++j) {
      if (!row[static_cast<size_t>(j)].is_number()) complain();
      r(i, j) = row[static_cast<size_t>(j)].get<double>();
    }
  }
  const double deviation = (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < rotation_tolerance) || r.row(0).cross(r.row(1)).dot(r.row(2)) < 0.0) complain();
  return r;
}

voxel::VoxelGrid read_grid(JsonReader& reader, const json& value) {
  voxel::VoxelGrid grid;
  const auto dims = reader.numbers("dims", 3);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = dims[static_cast<size_t>(axis)];
    if (!(d >= 1.0 && d <= static_cast<double>(max_dim)) || d != std::floor(d))
      reader.refuse("dims", "must be three positive whole numbers");
    grid.dims[axis] = static_cast<int>(d);
  }
  if (dims[0] * dims[1] * dims[2] > max_voxels) reader.refuse("dims", "is more than 4e9 voxels");
  grid.spacing_mm = vec3(reader.numbers("spacing_mm", 3));
  JsonReader pose = reader.object("world_from_grid");
  grid.world_from_grid.rotation = read_rotation(pose, value.at("world_from_grid"));
  grid.world_from_grid.translation_mm = vec3(pose.numbers("translation_mm", 3));
  pose.finish();
  try {
    voxel::validate(grid);
  } catch (const Error& e) {
    throw Error(e.kind(), reader.place() + ": " + e.what());
  }
  return grid;
}

GlenoidFrame read_glenoid(JsonReader reader) {
  GlenoidFrame frame;
  frame.centre_mm = vec3(reader.numbers("centre_mm", 3));
  for (const auto& [key, axis] :
       {std::pair{"lateral", &frame.lateral}, std::pair{"superior", &frame.superior},
        std::pair{"anterior", &frame.anterior}}) {
    *axis = vec3(reader.numbers(key, 3));
    if (!(std::abs(axis->norm() - 1.0) < rotation_tolerance)) reader.refuse(key, "must be a unit vector");
  }
  reader.finish();
  return frame;
}

std::vector<uint8_t> read_compressed(const fs::path& file, size_t expected_size) {
  const auto bytes = read_binary_file(file);
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN)
    throw Error(ErrorKind::invalid_input, file.string() + " is not zstd data; import the case again");
  if (size != expected_size)
    throw Error(ErrorKind::invalid_input, file.string() + " holds " + std::to_string(size) +
                                              " voxels, case.json says " + std::to_string(expected_size) +
                                              "; import the case again");
  std::vector<uint8_t> result(expected_size);
  const size_t read = ZSTD_decompress(result.data(), result.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(read) || read != expected_size)
    throw Error(ErrorKind::invalid_input, file.string() + " is damaged or cut short; import the case again");
  return result;
}

void write_compressed(const fs::path& file, const std::vector<uint8_t>& data) {
  std::vector<std::byte> packed(ZSTD_compressBound(data.size()));
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), data.data(), data.size(), compression_level);
  if (ZSTD_isError(size))
    throw Error(ErrorKind::io, "cannot compress " + file.string() + ": " + ZSTD_getErrorName(size));
  write_file_atomically(file, std::span<const std::byte>(packed.data(), size));
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
  const std::string side = reader.text("side");
  if (side != "left" && side != "right") reader.refuse("side", "must be left or right");
  c.side = side_from_text(side);
  c.bone.grid = read_grid(reader, value);
  c.bone.cortical_threshold_g_cc = reader.number("cortical_threshold_g_cc", 0.0, 3.0);
  if (!reader.has("calibration")) reader.refuse("calibration", "is missing");
  c.calibration = calibration_from_json(value.at("calibration"), reader.place() + ".calibration");
  if (reader.has("glenoid")) c.glenoid = read_glenoid(reader.object("glenoid"));
  c.warnings = reader.texts_or_none("warnings");
  reader.finish();
  const fs::path plan = folder / "plan.json";
  if (fs::exists(plan)) c.plan = plan_from_json(read_json_file(plan), plan.string());
  return c;
}

Case load_case(const fs::path& folder) {
  Case c = load_case_description(folder);
  const size_t voxels = c.bone.grid.voxel_count();
  c.bone.density = voxel::bricks_from_rows(c.bone.grid, read_compressed(folder / "density.zst", voxels));
  c.bone.coverage = voxel::bricks_from_rows(c.bone.grid, read_compressed(folder / "coverage.zst", voxels));
  return c;
}

Case load_case(const fs::path& folder, const voxel::SharedBytes& density) {
  Case c = load_case_description(folder);
  const size_t voxels = c.bone.grid.voxel_count();
  if (density.size() != voxels) return load_case(folder);
  c.bone.density = density;
  c.bone.coverage = voxel::bricks_from_rows(c.bone.grid, read_compressed(folder / "coverage.zst", voxels));
  return c;
}

CaseSummary load_case_summary(const fs::path& folder) {
  const Case c = load_case_description(folder);
  return {c.id, c.name, c.side, c.bone.grid.dims, c.bone.grid.spacing_mm, c.plan.has_value()};
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
  write_compressed(folder / "density.zst", voxel::rows_from_bricks(c.bone.grid, c.bone.density));
  write_compressed(folder / "coverage.zst", voxel::rows_from_bricks(c.bone.grid, c.bone.coverage));
  write_file_atomically(folder / "case.json", to_json(c).dump(2) + "\n");
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
  FolderInProgress target(folder, replace);
  if (c.plan) write_file_atomically(target.path() / "plan.json", to_json(*c.plan).dump(2) + "\n");
  write_bone(c, target.path());
  target.commit();
}

void save_bone(const Case& c, const fs::path& folder) {
  check(c);
  FolderInProgress target(folder, true);
  link_files(folder, target.path());
  write_bone(c, target.path());
  target.commit();
}

std::string to_text(GuideKind guide) {
  switch (guide) {
    case GuideKind::none:
      return "none";
    case GuideKind::nipple:
      return "nipple";
    case GuideKind::pin:
      return "pin";
  }
  return "none";
}

GuideKind guide_from_text(const std::string& text) {
  if (text == "none") return GuideKind::none;
  if (text == "nipple") return GuideKind::nipple;
  if (text == "pin") return GuideKind::pin;
  throw Error(ErrorKind::invalid_input, "guide '" + text + "' must be none, nipple or pin");
}

std::string frame_in_words(Side side) { return "millimetres, LPS, " + to_text(side) + " shoulder"; }

std::string to_text(Side side) { return side == Side::left ? "left" : "right"; }

Side side_from_text(const std::string& text) {
  if (text == "left") return Side::left;
  if (text == "right") return Side::right;
  throw Error(ErrorKind::invalid_input, "side '" + text + "' must be left or right");
}

}  // namespace ream::case_
