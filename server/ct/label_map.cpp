#include "ct/label_map.hpp"

#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include "core/error.hpp"
#include "ct/itk_volume.hpp"
#include "ct/threshold_suggestion.hpp"

namespace ream::ct {
namespace {

itk::ImageIOBase::Pointer io_for_labels(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with(".nrrd")) return itk::NrrdImageIO::New().GetPointer();
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return itk::NiftiImageIO::New().GetPointer();
  throw Error(ErrorKind::invalid_input,
              path.string() + ": labels are written as .nrrd, .nii or .nii.gz; choose one of these endings");
}

BoneLabel label_of(int value, const LabelValues& values) {
  if (value == values.scapula) return BoneLabel::scapula;
  if (value == values.humerus) return BoneLabel::humerus;
  if (value == values.clavicle) return BoneLabel::clavicle;
  return value == 0 ? BoneLabel::none : BoneLabel::other;
}

}  // namespace

void write_label_map(const HuVolume& ct, const std::vector<uint8_t>& labels,
                     const std::filesystem::path& path) {
  if (labels.size() != ct.voxel_count())
    throw Error(ErrorKind::invalid_input, "there is not one label per voxel of the CT");
  const auto io = io_for_labels(path);
  try {
    describe(*io, ct);
    io->SetComponentType(itk::IOComponentEnum::UCHAR);
    io->SetUseCompression(true);
    io->SetFileName(path.string());
    io->WriteImageInformation();
    io->Write(labels.data());
  } catch (const itk::ExceptionObject& e) {
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + short_reason(e));
  }
}

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
