#include "ct/segment/shoulder_bones.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "ct/hu_volume.hpp"
#include "ct/segment/mask.hpp"
#include "ct/segment/shoulder_steps.hpp"
#include "ct/segment/threshold_suggestion.hpp"
#include "ct/segment/voxel_window.hpp"

namespace ream::ct {
namespace {

constexpr double neck_reach_mm = 18.0;  // a joint's width
constexpr double thick_slice_mm = 2.5, min_other_mm3 = 50.0;
constexpr auto code = [](BoneLabel label) { return static_cast<uint8_t>(label); };

/// Components of the thresholded bone, each wholly of the first label that has a marker in it.
void spread_unseparated(const HuVolume& volume, double threshold_hu, std::vector<uint8_t>& labels) {
  const std::vector<uint8_t> markers = labels;
  std::fill(labels.begin(), labels.end(), uint8_t{0});
  for (const BoneLabel label :
       {BoneLabel::scapula, BoneLabel::humerus, BoneLabel::clavicle, BoneLabel::other}) {
    for (size_t i = 0; i < labels.size(); ++i)
      if (labels[i] == 0 && markers[i] == code(label)) labels[i] = code(label);
    flood_by_hu(volume, threshold_hu, labels);
  }
}

/// Visits each face-connected part of `mask` as the list of its voxels; `mask` is empty afterwards.
template <typename Visit>
void each_part(Mask& mask, const Vec3i& dims, Visit&& visit) {
  const Steps steps(dims);
  std::vector<size_t> part;
  for (size_t start = 0; start < mask.size(); ++start) {
    if (!mask[start]) continue;
    part.assign(1, start);
    mask[start] = 0;
    for (size_t k = 0; k < part.size(); ++k)
      each_face_neighbour(steps, part[k], [&](size_t n) {
        if (!mask[n]) return;
        mask[n] = 0;
        part.push_back(n);
      });
    visit(part);
  }
}

/// Of the bone that is neither scapula nor humerus, the clavicle: the part with its seed or, without one, the
/// largest that comes near the top of the head.
void separate_clavicle(std::vector<uint8_t>& labels, const HuVolume& volume,
                       const std::optional<HumeralHead>& head) {
  constexpr double near_top_mm = 40.0;
  Mask pending(labels.size());
  bool seeded = false;
  for (size_t i = 0; i < labels.size(); ++i) {
    pending[i] = labels[i] >= code(BoneLabel::clavicle);
    seeded = seeded || labels[i] == code(BoneLabel::clavicle);
  }
  const Vec3 top = head ? Vec3(head->centre_mm + Vec3(0.0, 0.0, head->radius_mm)) : Vec3::Zero();
  const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
  const auto near_top = [&](size_t i) {
    const Vec3i o(static_cast<int>(i % nx), static_cast<int>((i / nx) % ny), static_cast<int>(i / (nx * ny)));
    return (volume.world_of_centre(o) - top).norm() <= near_top_mm;
  };
  std::vector<size_t> largest;
  each_part(pending, volume.dims, [&](const std::vector<size_t>& part) {
    const bool is_it =
        seeded ? std::any_of(part.begin(), part.end(),
                             [&](size_t i) { return labels[i] == code(BoneLabel::clavicle); })
               : head && part.size() > largest.size() && std::any_of(part.begin(), part.end(), near_top);
    for (const size_t i : part) labels[i] = code(BoneLabel::other);
    if (is_it && part.size() > largest.size()) largest = part;
  });
  for (const size_t i : largest) labels[i] = code(BoneLabel::clavicle);
}

/// Everything above the threshold that has no label yet, but for flecks.
void label_the_rest(std::vector<uint8_t>& labels, const HuVolume& volume, double threshold_hu) {
  const auto least = static_cast<size_t>(std::ceil(min_other_mm3 / volume.spacing_mm.prod()));
  Mask pending(labels.size());
  for (size_t i = 0; i < labels.size(); ++i) pending[i] = labels[i] == 0 && volume.hu[i] >= threshold_hu;
  each_part(pending, volume.dims, [&](const std::vector<size_t>& part) {
    if (part.size() < least) return;
    for (const size_t i : part) labels[i] = code(BoneLabel::other);
  });
}

/// Labels of the region around the head (or of the whole volume without one).
std::vector<uint8_t> labels_of_region(const HuVolume& region, const SegmentationSettings& settings,
                                      double threshold_hu, const std::optional<HumeralHead>& head,
                                      const Progress& progress) {
  progress(0.0, "marking bones");
  std::vector<uint8_t> labels = shoulder_markers(region, threshold_hu, head, settings.side, settings.seeds);
  const Seeds& seeds = settings.seeds;
  if (!head && !seeds.scapula_mm) {
    const Mask scapula = largest_part(above_threshold(region, threshold_hu), region.dims);
    for (size_t i = 0; i < labels.size(); ++i)
      if (scapula[i] && labels[i] == 0) labels[i] = code(BoneLabel::scapula);
  }
  progress(0.2, "parting bones");
  if (settings.separate) {
    const std::vector<uint8_t> markers = labels;
    flood_by_hu(region, threshold_hu, labels);
    progress(0.3, "parting joints");
    cut_at_necks(labels, markers, region, threshold_hu, neck_reach_mm);
  } else {
    spread_unseparated(region, threshold_hu, labels);
  }
  separate_clavicle(labels, region, head);
  if (!settings.fill_holes) return labels;
  progress(0.5, "closing thin bone");
  WholeBoneSettings whole;
  whole.threshold_hu = threshold_hu;
  const SoftTissue soft = soft_tissue_of(region);
  whole.thin_bone_hu =
      std::min(threshold_hu, std::max(0.55 * threshold_hu, soft.hu + 3.0 * soft.deviation_hu));
  make_whole(labels, region, BoneLabel::scapula, whole);
  progress(0.8, "filling the humerus");
  make_whole(labels, region, BoneLabel::humerus, whole);
  make_whole(labels, region, BoneLabel::clavicle, whole);
  return labels;
}

void warn(Segmentation& result, const HuVolume& volume, const SegmentationSettings& settings,
          const std::optional<HumeralHead>& head) {
  if (volume.spacing_mm.maxCoeff() > thick_slice_mm) {
    const auto tenths = std::to_string(volume.spacing_mm.maxCoeff());
    result.warnings.push_back("slices of " + tenths.substr(0, tenths.find('.') + 2) +
                              " mm hide the thin blade and close joint spaces; look at the labels slice by "
                              "slice and set seeds where bones run together");
  }
  if (!head && !settings.seeds.humerus_mm)
    result.warnings.push_back(
        "no humeral head was found on the " + case_::to_text(settings.side) +
        " side, so the humerus is not parted from the scapula; give a seed in the humerus");
}

}  // namespace

Segmentation segment_shoulder(const HuVolume& given, const SegmentationSettings& settings,
                              const Progress& progress) {
  progress(0.0, "finding the threshold");
  HuVolume smoothed;
  if (settings.sigma_mm > 0.0) {
    smoothed = given;
    smooth(smoothed, settings.sigma_mm);
  }
  const HuVolume& volume = settings.sigma_mm > 0.0 ? smoothed : given;
  Segmentation result;
  result.threshold_hu = settings.threshold_hu ? *settings.threshold_hu : suggested_threshold_hu(volume);
  const int highest = volume.hu.empty() ? min_hu : *std::max_element(volume.hu.begin(), volume.hu.end());
  if (highest < result.threshold_hu)
    throw Error(ErrorKind::invalid_input,
                "no voxel reaches the threshold of " + std::to_string(std::lround(result.threshold_hu)) +
                    " HU (the highest is " + std::to_string(highest) + "); lower the threshold");
  progress(0.05, "finding the humeral head");
  const auto head = find_head(volume, result.threshold_hu, settings.side, settings.seeds);
  VoxelWindow window{Vec3i::Zero(), volume.dims};
  HuVolume region;
  if (head) {
    region = cropped(volume, shoulder_box_mm(*head, settings.side));
    window = {volume.voxel_at_world(region.world_of_centre(Vec3i::Zero())), region.dims};
  }
  const HuVolume& worked_on = head ? region : volume;
  const std::vector<uint8_t> labels =
      labels_of_region(worked_on, settings, result.threshold_hu, head, part_of(progress, 0.2, 0.85));
  result.labels.resize(volume.voxel_count());
  put_back(result.labels, volume.dims, window, labels);
  result.head = head;
  if (head) result.glenoid_mm = glenoid_facing(*head, settings.side, worked_on, labels);
  progress(0.85, "labelling other bones");
  label_the_rest(result.labels, volume, result.threshold_hu);
  result.parts = measure_parts(volume, result.labels);
  warn(result, volume, settings, head);
  progress(1.0, "segmented");
  return result;
}

std::vector<BonePart> measure_parts(const HuVolume& volume, const std::vector<uint8_t>& labels) {
  struct Sums {
    size_t voxels = 0;
    int64_t u = 0, v = 0, w = 0;
    Aabb box;
  };
  std::vector<Sums> sums(bone_label_count);
  const Vec3 half = 0.5 * volume.world_from_volume.rotation.cwiseAbs() * volume.spacing_mm;
  size_t i = 0;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u, ++i) {
        if (labels[i] == 0 || labels[i] >= bone_label_count) continue;
        Sums& s = sums[labels[i]];
        ++s.voxels, s.u += u, s.v += v, s.w += w;
        const Vec3 centre = volume.world_of_centre({u, v, w});
        s.box.include(centre - half);
        s.box.include(centre + half);
      }
  std::vector<BonePart> parts;
  for (int label = 1; label < bone_label_count; ++label) {
    const Sums& s = sums[static_cast<size_t>(label)];
    if (s.voxels == 0) continue;
    const auto n = static_cast<double>(s.voxels);
    const Vec3 mean = Vec3(static_cast<double>(s.u) / n + 0.5, static_cast<double>(s.v) / n + 0.5,
                           static_cast<double>(s.w) / n + 0.5);
    parts.push_back({static_cast<BoneLabel>(label), s.voxels, n * volume.spacing_mm.prod(),
                     volume.world_from_volume.point((mean.array() * volume.spacing_mm.array()).matrix()),
                     s.box.min, s.box.max});
  }
  return parts;
}

Mask mask_of(const std::vector<uint8_t>& labels, BoneLabel label) {
  Mask mask(labels.size());
  std::transform(labels.begin(), labels.end(), mask.begin(),
                 [label](uint8_t l) { return uint8_t{l == code(label)}; });
  return mask;
}

}  // namespace ream::ct
