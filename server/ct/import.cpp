#include "ct/import.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace {

constexpr double max_grid_voxels = 1.5e9;  // more than 3 GB of density and coverage

void check_grid_size(const HuVolume& volume, int upsample) {
  const double n = upsample;
  if (static_cast<double>(volume.voxel_count()) * n * n * n > max_grid_voxels)
    throw Error(ErrorKind::invalid_input,
                "upsampling by " + std::to_string(upsample) +
                    " makes more than 1.5e9 voxels; choose a smaller --roi or --upsample");
}

}  // namespace

Mask mask_from_label(const HuVolume& volume, const HuVolume& label, int value) {
  Mask mask(volume.voxel_count());
  const Pose label_from_volume = label.world_from_volume.inverse() * volume.world_from_volume;
  bool any = false;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const Vec3 centre = (Vec3(u + 0.5, v + 0.5, w + 0.5).array() * volume.spacing_mm.array()).matrix();
        const Vec3 p = label_from_volume.point(centre);
        const Vec3i o = (p.array() / label.spacing_mm.array()).floor().cast<int>().matrix();
        if (!label.contains(o) || label.hu[label.index(o.x(), o.y(), o.z())] != value) continue;
        mask[volume.index(u, v, w)] = 1;
        any = true;
      }
  if (!any)
    throw Error(ErrorKind::invalid_input,
                "the label map " + label.source + " holds no voxel of value " + std::to_string(value) +
                    " within the CT's region; check --label, --label-value and --roi");
  return mask;
}

case_::Case import_ct(const std::filesystem::path& path, const std::string& id,
                      const ImportOptions& options) {
  HuVolume volume = read_ct(path);
  if (options.roi_mm) volume = cropped(volume, *options.roi_mm);
  check_grid_size(volume, options.segmentation.upsample);
  Mask mask;
  if (options.label) {
    const HuVolume label = read_volume_file(*options.label);
    smooth(volume, options.segmentation.sigma_mm);
    mask = mask_from_label(volume, label, options.label_value);
  } else {
    mask = segment(volume, options.segmentation);
  }
  case_::Case result;
  result.id = id;
  result.name = id;
  result.source = volume.source;
  result.side = options.side.value_or(case_::Side::right);
  result.warnings = volume.warnings;
  if (!options.side) result.warnings.push_back("no --side was given; the case is marked as a right shoulder");
  result.calibration = options.segmentation.calibration;
  result.calibration.threshold_hu = options.segmentation.threshold_hu;
  result.bone = bone_from_mask(volume, std::move(mask), options.segmentation);
  if (result.bone.filled_voxels() == 0)
    throw Error(ErrorKind::invalid_input,
                "the segmentation holds no bone that fills half a voxel; choose another --threshold-hu or "
                "--upsample");
  return result;
}

std::string case_id_from(const std::filesystem::path& folder) {
  std::filesystem::path named = std::filesystem::absolute(folder).lexically_normal();
  if (!named.has_filename()) named = named.parent_path();
  std::string id;
  for (const char c : named.filename().string()) {
    const bool upper = c >= 'A' && c <= 'Z', kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (upper)
      id += static_cast<char>(c - 'A' + 'a');
    else if (kept)
      id += c;
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id.empty() ? "case" : id;
}

}  // namespace ream::ct
