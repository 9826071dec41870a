#include "workup/case_service.hpp"

#include <nlohmann/json.hpp>
#include <span>

#include "case/measures.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/new_id.hpp"
#include "core/temporary_file.hpp"
#include "core/text.hpp"
#include "ct/build/ct_workspace.hpp"
#include "ct/build/import.hpp"
#include "ct/build/surroundings.hpp"
#include "ct/hu_volume.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"
#include "geometry/mesh_io.hpp"
#include "surface/block_mesh.hpp"
#include "workup/case_json.hpp"

namespace ream::workup {
namespace fs = std::filesystem;
namespace {

constexpr double read_share = 0.8;
constexpr uint64_t always_taken_bytes = 32 << 20, max_packing = 16;
constexpr size_t max_id_length = 60;
constexpr double max_fine_voxels = 2.0e7;  // beyond, a surface is sampled every other voxel

/// Whether the bone was built of what is segmented now.
bool is_up_to_date(const ct::Workup& workup) {
  return workup.built && workup.segmentation() &&
         workup.built->segmentation_revision == workup.segmentation()->revision;
}

template <typename T>
net::Bytes bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

/// action(), whose errors name the uploaded file as its sender calls it, not by where it lies here.
template <typename Action>
auto naming_as_sent(const fs::path& file, Action&& action) {
  try {
    return action();
  } catch (const Error& error) {
    std::string words = error.what();
    const std::string folder = file.parent_path().string() + "/";
    for (size_t at = words.find(folder); at != std::string::npos; at = words.find(folder))
      words.erase(at, folder.size());
    throw Error(error.kind(), words);
  }
}

/// A zip is unpacked beside it; `series_uid` empty: the largest series. A CT packs to a half or a quarter, so
/// that what unpacks to far more is none, but would take the server's memory.
ct::HuVolume read_upload(const fs::path& file, const std::string& series_uid, const Progress& progress) {
  ct::ReadOptions options;
  options.series_uid = series_uid;
  options.max_bytes = always_taken_bytes + max_packing * fs::file_size(file);
  options.scratch = file.parent_path();
  return ct::read_ct(file, options, progress);
}

/// Goes away with whatever is left of an upload.
class TakenUpload {
 public:
  explicit TakenUpload(fs::path file) : file_(std::move(file)) {}
  ~TakenUpload() { remove_tree(file_.parent_path()); }
  TakenUpload(const TakenUpload&) = delete;
  TakenUpload& operator=(const TakenUpload&) = delete;
  const fs::path& file() const { return file_; }

 private:
  fs::path file_;
};

}  // namespace

CaseService::CaseService(fs::path cases_folder, const session::SessionService& sessions,
                         jobs::JobService& jobs)
    : cases_folder_(std::move(cases_folder)), sessions_(sessions), jobs_(jobs) {}

fs::path CaseService::folder_of(const std::string& id) const {
  const fs::path folder = cases_folder_ / id;
  if (!is_name(id) || !is_case_folder(folder)) throw Error(ErrorKind::not_found, "no case '" + id + "'");
  return folder;
}

ct::Workup CaseService::workup(const std::string& id) const {
  const fs::path folder = folder_of(id);
  if (!ct::has_workup(folder))
    throw Error(ErrorKind::conflict,
                "case '" + id + "' has no CT beside it; it was made before, or without one");
  return ct::load_workup(folder);
}

std::string CaseService::unused_id(const std::string& wanted) const {
  const std::string base = wanted.substr(0, max_id_length);
  std::string id = base;
  for (int n = 2; fs::exists(cases_folder_ / id); ++n) id = base + "-" + std::to_string(n);
  return id;
}

jobs::JobRecord CaseService::import(const NewCase& wanted, UploadStore& uploads) {
  const Upload upload = uploads.get(wanted.upload_id);
  if (!wanted.id.empty() && fs::exists(cases_folder_ / wanted.id))
    throw Error(ErrorKind::conflict, "there is a case '" + wanted.id + "' already; choose another id");
  // Names of files from a hospital are often those of patients.
  const std::string id = wanted.id.empty() ? unused_id("case-" + random_id()) : wanted.id;
  const std::string name = wanted.name.empty() ? id : wanted.name;
  if (jobs_.busy(id)) throw Error(ErrorKind::conflict, "a case '" + id + "' is being made; wait for it");
  const auto taken = std::make_shared<TakenUpload>(uploads.take(wanted.upload_id));
  jobs::JobOrder order{"import", id};
  order.sender = upload.owner;
  return jobs_.submit(order, [this, taken, id, name, wanted](const Progress& progress) {
    const ct::HuVolume volume = naming_as_sent(taken->file(), [&] {
      return read_upload(taken->file(), wanted.series_uid, part_of(progress, 0.0, read_share));
    });
    progress(read_share, "writing the CT");
    ct::create_workup(cases_folder_ / id, id, name, wanted.side, volume);
  });
}

jobs::JobRecord CaseService::copy(const std::string& from, case_::Side side) {
  const ct::Workup source = workup(from);
  const std::string id = unused_id(from + "-" + case_::to_text(side));
  return jobs_.submit({"import", id}, [this, from, id, side, source](const Progress& progress) {
    progress(0.0, "copying the CT");
    ct::copy_workup(folder_of(from), cases_folder_ / id, id, source.name, side);
  });
}

jobs::JobRecord CaseService::segment(const std::string& id, ct::SegmentationSettings settings) {
  settings.side = workup(id).side;
  return jobs_.submit({"segmentation", id}, [this, id, settings](const Progress& progress) {
    const fs::path folder = folder_of(id);
    ct::Workup workup = this->workup(id);
    ct::HuVolume volume = workup.volume;
    volume.hu = *cache_.hu(folder, workup);
    const ct::Segmentation made = ct::segment_shoulder(volume, settings, progress);
    const std::lock_guard lock(changing_);
    workup = this->workup(id);
    ct::add_segmentation(folder, workup, settings, made);
  });
}

void CaseService::undo_segmentation(const std::string& id) {
  if (jobs_.busy(id)) throw Error(ErrorKind::conflict, "other work on case '" + id + "' is not done");
  const std::lock_guard lock(changing_);
  ct::Workup workup = this->workup(id);
  ct::undo_segmentation(folder_of(id), workup);
}

void CaseService::require_no_sessions(const std::string& id, const std::string& what) const {
  store::SessionQuery query;
  query.case_id = id;
  query.limit = 0;
  const size_t count = sessions_.list(query).total;
  if (count > 0)
    throw Error(ErrorKind::conflict, std::to_string(count) + " sessions belong to case '" + id +
                                         "' and need its bone as it is; it cannot be " + what +
                                         ". Copy it instead");
}

jobs::JobRecord CaseService::build(const std::string& id, const ct::BuildSettings& settings) {
  if (!workup(id).segmentation()) throw Error(ErrorKind::conflict, "case '" + id + "' is not segmented yet");
  require_no_sessions(id, "built anew");
  return jobs_.submit({"build", id}, [this, id, settings](const Progress& progress) {
    const fs::path folder = folder_of(id);
    ct::Workup workup = this->workup(id);
    const auto hu = cache_.hu(folder, workup);
    const auto labels = cache_.labels(folder, workup, workup.segmentation()->revision);
    case_::Case made =
        ct::build_from(workup, *hu, *labels, landmarks(id), settings, part_of(progress, 0.0, read_share));
    progress(read_share, "writing the case");
    const TriangleMesh around = ct::scapula_around(workup, *hu, *labels, made.bone.grid);
    const std::lock_guard lock(changing_);
    case_::save_bone(made, folder);
    ct::keep_surroundings(around, made.side, folder);
    ct::save_workup(folder, workup);
    cache_.forget(id);
  });
}

void CaseService::remove(const std::string& id) {
  const fs::path folder = folder_of(id);
  if (jobs_.busy(id)) throw Error(ErrorKind::conflict, "there is work on case '" + id + "'; cancel it first");
  require_no_sessions(id, "deleted");
  const std::lock_guard lock(changing_);
  const fs::path gone = cases_folder_ / ("." + id + ".deleted");
  std::error_code failed;
  fs::rename(folder, gone, failed);
  if (failed) throw Error(ErrorKind::io, "cannot delete " + folder.string() + ": " + failed.message());
  sync_folder(cases_folder_);
  fs::remove_all(gone, failed);
  cache_.forget(id);
}

case_::Side CaseService::side_of(const std::string& id) const {
  const fs::path folder = folder_of(id);
  return ct::has_workup(folder) ? ct::load_workup(folder).side : case_::load_case_description(folder).side;
}

case_::Landmarks CaseService::landmarks(const std::string& id) const {
  return case_::load_landmarks(folder_of(id)).value_or(case_::Landmarks{});
}

void CaseService::set_landmarks(const std::string& id, const case_::Landmarks& landmarks) {
  const std::lock_guard lock(changing_);
  case_::save_landmarks(landmarks, folder_of(id));
}

CtCache::Bone CaseService::surface_of(const std::string& id) {
  const fs::path folder = folder_of(id);
  if (ct::has_workup(folder)) {
    const ct::Workup workup = ct::load_workup(folder);
    if (workup.segmentation()) return cache_.bone(folder, workup);
  }
  if (fs::exists(folder / "case.json"))
    return std::make_shared<const voxel::BoneModel>(case_::load_case(folder).bone);
  throw Error(ErrorKind::conflict, "case '" + id + "' is not segmented yet");
}

case_::Plan CaseService::propose(const std::string& id, const case_::PlanTargets& targets) {
  const auto bone = surface_of(id);
  return case_::propose_plan(targets, landmarks(id), side_of(id), [&](const Vec3& point, const Vec3& way) {
    return case_::surface_along(*bone, point, way);
  });
}

case_::PlanAssessment CaseService::assess(const std::string& id, const case_::Plan& plan) {
  const auto bone = surface_of(id);
  const std::optional<case_::GlenoidFrame> glenoid = built_glenoid(id);
  return case_::assess_plan(plan, landmarks(id), side_of(id), bone.get(), glenoid ? &*glenoid : nullptr);
}

std::optional<case_::GlenoidFrame> CaseService::built_glenoid(const std::string& id) const {
  const fs::path folder = folder_of(id);
  if (!fs::exists(folder / "case.json")) return std::nullopt;
  return case_::load_case_description(folder).glenoid;
}

score::MetricResults CaseService::outcome(const std::string& id, const case_::Plan& plan,
                                          shell::ToolProfile reamer) {
  const fs::path folder = folder_of(id);
  score::Task task{{side_of(id), landmarks(id), built_glenoid(id)}, plan, std::move(reamer)};
  const bool is_built =
      !ct::has_workup(folder) ? fs::exists(folder / "case.json") : is_up_to_date(ct::load_workup(folder));
  if (is_built) return score::plan_outcome({task, case_::load_case(folder).bone});
  task.anatomy.glenoid = case_::glenoid_frame(landmarks(id), task.anatomy.side);
  return score::plan_outcome({task, *surface_of(id)});
}

case_::PlanAssessment CaseService::set_plan(const std::string& id, const case_::Plan& plan) {
  const case_::PlanAssessment assessment = assess(id, plan);
  if (assessment.needs_override) throw Error(ErrorKind::conflict, case_::why_refused(assessment));
  const std::lock_guard lock(changing_);
  case_::save_plan(plan, folder_of(id));
  return assessment;
}

net::Bytes CaseService::slice(const std::string& id, int axis, int index, bool of_labels,
                              std::optional<int> revision) {
  const fs::path folder = folder_of(id);
  const ct::Workup workup = this->workup(id);
  const Vec3i& dims = workup.volume.dims;
  if (index < 0 || index >= dims[axis])
    throw Error(ErrorKind::not_found, "case '" + id + "' has the slices 0 to " +
                                          std::to_string(dims[axis] - 1) + " along that axis");
  if (!of_labels)
    return bytes_of(ct::slice_of(std::span<const int16_t>(*cache_.hu(folder, workup)), dims, axis, index));
  if (!workup.segmentation()) throw Error(ErrorKind::conflict, "case '" + id + "' is not segmented yet");
  if (revision && *revision != workup.segmentation()->revision)
    throw Error(ErrorKind::conflict, "case '" + id + "' has been segmented again or undone since");
  const auto labels = cache_.labels(folder, workup, workup.segmentation()->revision);
  return bytes_of(ct::slice_of(std::span<const uint8_t>(*labels), dims, axis, index));
}

void CaseService::write_volume(const std::string& id, const fs::path& file) {
  const fs::path folder = folder_of(id);
  const ct::Workup workup = this->workup(id);
  ct::HuVolume volume = workup.volume;
  volume.hu = *cache_.hu(folder, workup);
  ct::write_volume_file(volume, file);
}

std::string CaseService::mesh(const std::string& id) {
  const auto bone = surface_of(id);
  const bool coarse = static_cast<double>(bone->grid.voxel_count()) > max_fine_voxels;
  const TriangleMesh mesh = surface::whole_surface(bone->grid, bone->coverage.data(), 1, coarse ? 2 : 1);
  return ply_of(mesh.transformed(bone->grid.world_from_grid), case_::frame_in_words(side_of(id)));
}

std::string CaseService::surroundings(const std::string& id) {
  const fs::path file = folder_of(id) / ct::surroundings_file;
  if (!fs::exists(file))
    throw Error(ErrorKind::not_found, "case '" + id + "' has nothing around the bone that is reamed");
  return read_text_file(file);
}

}  // namespace ream::workup
