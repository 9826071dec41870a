#include "app/mesh_source.hpp"

#include <atomic>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "ct/read/gray_volume.hpp"
#include "fe/element_model.hpp"
#include "record/recorded_bone.hpp"
#include "session/export/export_formats.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::app {
namespace fs = std::filesystem;
namespace {

enum class Kind { volume, case_folder, session };

/// A path first, then the data folder.
Kind kind_of(const MeshSource& source) {
  std::error_code failed;
  const fs::path path(source.name);
  if (fs::exists(path / "case.json", failed)) return Kind::case_folder;
  if (path.extension() == ".ream" || fs::exists(path / "recording.ream", failed)) return Kind::session;
  if (fs::exists(path, failed)) return Kind::volume;
  if (source.name == "demo" || fs::exists(cases_folder(source.data) / source.name / "case.json", failed))
    return Kind::case_folder;
  if (fs::exists(sessions_folder(source.data) / source.name / "recording.ream", failed)) return Kind::session;
  throw Error(ErrorKind::not_found, "no such volume, case or session: " + source.name +
                                        "; `ream list cases` and `ream list sessions` "
                                        "say what the data folder holds");
}

/// The mesh frame: the world's where the grid's axes are the world's, else the grid's own.
void set_frame(fe::ElementModel& model, const Pose& world_from_grid) {
  const bool along_world = (world_from_grid.rotation - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12;
  if (along_world)
    model.origin_mm = world_from_grid.translation_mm;
  else
    model.world_from_mesh = world_from_grid;
}

fe::ElementModel from_volume(const fs::path& path, const MeshSource& source, MemoryBudget& budget,
                             const Progress& progress) {
  const ct::GrayVolume volume(path, budget.left(), part_of(progress, 0.0, 0.4));
  fe::ElementModel model;
  model.gray = volume.gray();
  model.spacing_mm = volume.spacing_mm();
  set_frame(model, volume.world_from_volume());
  model.remarks = volume.warnings();
  model.source = volume.partly_given() ? "text rows x y z gray" : "a volume";
  std::vector<bool> bone(65536);
  for (size_t code = 0; code < bone.size(); ++code) {
    const double value = model.gray.value(static_cast<double>(code));
    bone[code] = source.threshold ? value >= *source.threshold : volume.partly_given() || value > 0.0;
  }
  const auto read = [&](int w, std::span<int32_t> codes) {
    volume.read_layer(w, codes);
    for (int32_t& code : codes)
      if (code == ct::GrayVolume::no_code || !bone[static_cast<size_t>(code)]) code = fe::no_element;
  };
  fe::fill_from_layers(model, volume.dims(), read, budget, part_of(progress, 0.4, 1.0));
  return model;
}

fe::ElementModel from_bone(const voxel::BoneModel& bone, const MeshSource& source, MemoryBudget& budget,
                           const Progress& progress) {
  budget.take(2 * bone.grid.voxel_count(), "the bone of the case");
  fe::ElementModel model;
  model.gray = {0.0, voxel::density_step_g_cc, true};
  model.gray_is_density_g_cc = true;
  model.spacing_mm = bone.grid.spacing_mm;
  set_frame(model, bone.grid.world_from_grid);
  const Vec3i dims = bone.grid.dims;
  std::atomic<uint64_t> cartilage{0};
  const auto read = [&](int w, std::span<int32_t> codes) {
    size_t at = 0;
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++at) {
        const size_t i = bone.grid.index(u, v, w);
        const uint8_t density = bone.density[i];
        const bool solid = bone.coverage[i] >= voxel::solid_coverage,
                   is_bone = density != voxel::cartilage_code;
        if (solid && !is_bone) ++cartilage;
        const bool above = !source.threshold || model.gray.value(density) >= *source.threshold;
        codes[at] = solid && is_bone && above ? int32_t{density} : fe::no_element;
      }
  };
  fe::fill_from_layers(model, dims, read, budget, progress);
  budget.give_back(2 * bone.grid.voxel_count());
  if (cartilage > 0) model.remarks.push_back("cartilage was left out; the mesh is bone alone");
  return model;
}

fe::ElementModel from_session(const MeshSource& source, MemoryBudget& budget, const Progress& progress) {
  session::ExportRequest request;
  request.recording = session::recording_path(source.name, source.data);
  request.case_name = source.case_name;
  request.data = source.data;
  progress(0.0, "reading the recording");
  const record::Recording recording = session::recording_of(request);
  case_::Case left = session::case_of(recording, source.case_name, source.data);
  record::RecordedBone recorded(recording, left.bone.grid, left.bone.coverage);
  recorded.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
  recorded.write_to(left.bone.coverage);
  fe::ElementModel model = from_bone(left.bone, source, budget, part_of(progress, 0.5, 1.0));
  model.source = "case " + left.id + " after reaming, " + case_::frame_in_words(left.side);
  return model;
}

fe::ElementModel from_case(const MeshSource& source, MemoryBudget& budget, const Progress& progress) {
  progress(0.0, "reading the case");
  std::error_code failed;
  const fs::path path(source.name);
  const bool by_path = fs::exists(path / "case.json", failed);
  const case_::Case c = by_path ? case_::load_case(path) : session::find_case(source.name, source.data);
  fe::ElementModel model = from_bone(c.bone, source, budget, part_of(progress, 0.5, 1.0));
  model.source = "case " + c.id + ", " + case_::frame_in_words(c.side);
  return model;
}

}  // namespace

fe::ElementModel open_mesh_source(const MeshSource& source, MemoryBudget& budget, const Progress& progress) {
  switch (kind_of(source)) {
    case Kind::case_folder: return from_case(source, budget, progress);
    case Kind::session: return from_session(source, budget, progress);
    case Kind::volume: break;
  }
  return from_volume(source.name, source, budget, progress);
}

}  // namespace ream::app
