#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "core/progress.hpp"
#include "ct/hu_volume.hpp"
#include "ct/segment/shoulder_bones.hpp"

namespace ream::ct {

/// A segmentation that was made of a CT, without its labels.
struct SegmentationRecord {
  int revision = 0;  ///< 1 for the first of a case; never used twice
  SegmentationSettings settings;
  double threshold_hu = 0.0;  ///< that was used: the settings', or the suggested one
  std::vector<BonePart> parts;
  std::optional<HumeralHead> head;  ///< as it was found
  std::optional<Vec3> glenoid_mm;   ///< about the middle of the face, to begin with
  std::vector<std::string> warnings;
};

/// What of the CT becomes the bone of a case, and how fine.
struct BuildSettings {
  int upsample = 4;                ///< parts of a CT voxel per axis, 1 to 16
  bool around_glenoid = true;      ///< else the whole CT
  std::optional<Aabb> roi_mm;      ///< LPS; this instead of the box around the glenoid; no key of its own
  double cartilage_mm = 0.0;       ///< thickness of synthetic cartilage; 0: none
  case_::Calibration calibration;  ///< its threshold is the segmentation's
};

struct BuildRecord {
  BuildSettings settings;
  Aabb roi_mm;  ///< the bone's grid, LPS
  uint64_t bone_voxels = 0;
  std::array<double, 2> density_range_g_cc{};  ///< least and greatest of the bone
  int segmentation_revision = 0;
};

/// A CT on its way to a case: the folder ct/ of a case folder holds hu.zst (16-bit HU, x fastest),
/// labels-REVISION.zst (one byte a voxel, BoneLabel) and ct.json (proto/ct.schema.json), which is written
/// last and names what counts.
struct Workup {
  std::string id;    ///< of the case
  std::string name;  ///< for people
  case_::Side side = case_::Side::right;
  HuVolume volume;  ///< its `hu` is empty: read it with load_hu
  int hu_min = 0, hu_max = 0;
  double suggested_threshold_hu = 0.0;
  std::vector<SegmentationRecord> segmentations;  ///< newest last, at most kept_segmentations
  int last_revision = 0;                          ///< given to a segmentation so far
  std::optional<BuildRecord> built;

  /// The one that counts; null before the first.
  const SegmentationRecord* segmentation() const {
    return segmentations.empty() ? nullptr : &segmentations.back();
  }
};

/// How many steps back undo can go, and one.
inline constexpr size_t kept_segmentations = 8;

bool has_workup(const std::filesystem::path& case_folder);

/// Errors: not_found without a ct/ct.json; invalid_input naming file and key; io.
Workup load_workup(const std::filesystem::path& case_folder);
std::vector<int16_t> load_hu(const std::filesystem::path& case_folder, const Workup& workup);
std::vector<uint8_t> load_labels(const std::filesystem::path& case_folder, const Workup& workup,
                                 int revision);

/// What is known of a CT that was read: its place, range and suggested threshold. Nothing is written.
Workup new_workup(const std::string& id, const std::string& name, case_::Side side, const HuVolume& volume);
/// What ct.json says of a segmentation becomes the one that counts; its labels are not kept here.
void record_segmentation(Workup& workup, const SegmentationSettings& settings, const Segmentation& made);

/// Writes CT, labels of the newest segmentation (where there is one) and ct.json into a folder in progress.
/// Error io.
void write_workup(const std::filesystem::path& folder, const Workup& workup, const std::vector<int16_t>& hu,
                  const std::vector<uint8_t>& labels);

/// A new case folder that holds nothing but the CT; it appears whole or not at all. Errors: conflict when the
/// folder exists; io.
Workup create_workup(const std::filesystem::path& case_folder, const std::string& id, const std::string& name,
                     case_::Side side, const HuVolume& volume);

/// A new case folder with the same CT, by hard links where the file system has them, and nothing else.
Workup copy_workup(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& id,
                   const std::string& name, case_::Side side);

/// Makes it the segmentation that counts; the oldest beyond kept_segmentations goes.
void add_segmentation(const std::filesystem::path& case_folder, Workup& workup,
                      const SegmentationSettings& settings, const Segmentation& made);

/// Goes back to the one before. Error conflict when there is none.
void undo_segmentation(const std::filesystem::path& case_folder, Workup& workup);

/// Only ct.json, atomically.
void save_workup(const std::filesystem::path& case_folder, const Workup& workup);

/// The segmented scapula at the CT's own resolution with sub-voxel surface, in a grid about its bounding box.
/// Throws Error conflict when the segmentation holds no scapula.
voxel::BoneModel scapula_of(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels);

/// Where the glenoid is and how it faces, as far as it is known; world (LPS).
struct GlenoidPlace {
  std::optional<Vec3> centre_mm;
  Vec3 lateral;                             ///< from the scapula to the joint, of any length
  std::optional<case_::GlenoidFrame> face;  ///< what cartilage is laid on
};
/// As the landmarks say that somebody placed; a face needs its centre and the four points of its rim.
GlenoidPlace glenoid_place(const case_::Landmarks& landmarks, case_::Side side);
/// As a segmentation found it beside the humeral head; `centre_mm` instead of its own where given. The face
/// looks at the head, or to the patient's side and front without one.
GlenoidPlace glenoid_place(const SegmentationRecord& segmentation, case_::Side side,
                           const std::optional<Vec3>& centre_mm);

/// The case that comes out: scapula cropped, upsampled and, where asked, covered with cartilage; the ROI that
/// was taken is in `workup.built`. Errors: conflict without a segmentation, or naming the landmarks that are
/// missing (glenoid centre for the ROI, rim points for cartilage); invalid_input for too many voxels or a
/// bone that fills none.
case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const GlenoidPlace& glenoid, const BuildSettings& settings, const Progress& progress);
/// The same on landmarks; the case knows its glenoid's frame then.
case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const case_::Landmarks& landmarks, const BuildSettings& settings,
                       const Progress& progress);

/// What ct.json says of a bone that was built.
BuildRecord build_record(const voxel::BoneModel& bone, const BuildSettings& settings,
                         int segmentation_revision);

/// ct.json (proto/ct.schema.json).
nlohmann::json to_json(const Workup& workup);
/// Error invalid_input naming `place` and key.
Workup workup_from_json(const nlohmann::json& value, const std::string& place);

/// Keys threshold_hu, sigma_mm, separate, fill_holes and seeds {scapula, humerus, clavicle}, all optional.
/// The side is the case's and no key.
nlohmann::json to_json(const SegmentationSettings& settings);
SegmentationSettings segmentation_settings_from_json(const nlohmann::json& value, const std::string& place);

/// Keys upsample, roi ("glenoid" or "whole") and cartilage_mm, all optional.
nlohmann::json to_json(const BuildSettings& settings);
BuildSettings build_settings_from_json(const nlohmann::json& value, const std::string& place);

nlohmann::json to_json(const BonePart& part);

}  // namespace ream::ct
