#include "ct/segment/label_map.hpp"

#include "core/error.hpp"
#include "ct/segment/threshold_suggestion.hpp"

namespace ream::ct {
namespace {

BoneLabel label_of(int value, const LabelValues& values) {
  if (value == values.scapula) return BoneLabel::scapula;
  if (value == values.humerus) return BoneLabel::humerus;
  if (value == values.clavicle) return BoneLabel::clavicle;
  return value == 0 ? BoneLabel::none : BoneLabel::other;
}

}  // namespace

Segmentation segmentation_from_labels(const HuVolume& ct, const HuVolume& map, const LabelValues& values) {
  Segmentation result;
  result.labels.resize(ct.voxel_count());
  const Pose map_from_ct = map.world_from_volume.inverse() * ct.world_from_volume;
  bool any = false;
  size_t i = 0;
  for (int w = 0; w < ct.dims.z(); ++w)
    for (int v = 0; v < ct.dims.y(); ++v)
      for (int u = 0; u < ct.dims.x(); ++u, ++i) {
        const Vec3 centre = (Vec3(u + 0.5, v + 0.5, w + 0.5).array() * ct.spacing_mm.array()).matrix();
        const Vec3i o =
            (map_from_ct.point(centre).array() / map.spacing_mm.array()).floor().cast<int>().matrix();
        if (!map.contains(o)) continue;
        const BoneLabel label = label_of(map.hu[map.index(o.x(), o.y(), o.z())], values);
        result.labels[i] = static_cast<uint8_t>(label);
        any = any || label == BoneLabel::scapula;
      }
  if (!any)
    throw Error(ErrorKind::invalid_input, "the label map " + map.source + " holds no voxel of value " +
                                              std::to_string(values.scapula) +
                                              " (the scapula) within the CT");
  result.threshold_hu = suggested_threshold_hu(ct);
  result.parts = measure_parts(ct, result.labels);
  return result;
}

}  // namespace ream::ct
