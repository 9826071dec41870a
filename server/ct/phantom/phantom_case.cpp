#include "ct/phantom/phantom_case.hpp"

#include "core/error.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/build/import.hpp"

namespace ream::ct {
namespace {

constexpr double seed_depth_mm = 5.0;  // in the vault, under the plate
constexpr double demo_depth_mm = 1.0;  // within the subchondral plate, and what the demo script reaches

Segmentation segmentation_of(const HuVolume& volume, const Mask& mask, double threshold_hu) {
  Segmentation segmentation;
  segmentation.labels = mask;
  for (uint8_t& label : segmentation.labels)
    if (label != 0) label = static_cast<uint8_t>(BoneLabel::scapula);
  segmentation.threshold_hu = threshold_hu;
  segmentation.parts = measure_parts(volume, segmentation.labels);
  return segmentation;
}

Imported import_phantom(const std::string& id, const PhantomParams& params, int upsample) {
  Phantom phantom = make_phantom(params);
  const case_::GlenoidFrame& glenoid = phantom.truth.glenoid;
  SegmentationOptions options;
  options.upsample = upsample;
  options.calibration = params.calibration;
  options.threshold_hu = params.calibration.threshold_hu;
  options.grow_from_mm = glenoid.centre_mm - seed_depth_mm * glenoid.lateral;
  Mask mask = segment(phantom.volume, options);

  Imported imported;
  imported.segmentation = segmentation_of(phantom.volume, mask, options.threshold_hu);
  imported.landmarks = phantom.truth.landmarks;
  case_::Case& result = imported.made;
  result.id = id;
  result.name = "Phantom shoulder, " + case_::to_text(params.side);
  result.source = phantom.volume.source;
  result.side = params.side;
  result.bone = bone_from_mask(phantom.volume, std::move(mask), options);
  result.calibration = options.calibration;
  result.glenoid = glenoid;
  case_::Plan plan;
  plan.entry_mm = glenoid.centre_mm;
  plan.axis_direction = -glenoid.lateral;
  result.plan = plan;
  imported.volume = std::move(phantom.volume);
  return imported;
}

}  // namespace

PhantomPreset phantom_preset(const std::string& name) {
  PhantomPreset preset;
  PhantomParams& p = preset.params;
  if (name == "demo") {
    p.spacing_mm = Vec3::Constant(0.4);
    p.field_mm = {{-8.0, -16.0, -23.2}, {33.6, 22.4, 23.2}};
    preset.upsample = 2;
    return preset;
  }
  if (name == "thesis-5-4-2") {
    const Vec3 size(75 * 0.668, 48 * 0.668, 58 * 0.625);
    // A small shoulder, placed so that as many voxels are filled as the thesis had.
    p.glenoid_height_mm = 32.0;
    p.glenoid_width_mm = 20.0;
    const Vec3 low(-37.05, -14.0, -20.0);
    p.field_mm = {low, low + size};
    preset.upsample = 8;
    return preset;
  }
  throw Error(ErrorKind::not_found, "no phantom preset '" + name + "'; there are demo and thesis-5-4-2");
}

case_::Case make_phantom_case(const std::string& id, const PhantomParams& params, int upsample) {
  return import_phantom(id, params, upsample).made;
}

case_::Case load_or_make_demo_case(const std::filesystem::path& data_folder) {
  const auto folder = data_folder / "cases" / "demo";
  if (std::filesystem::exists(folder / "case.json")) return case_::load_case(folder);
  const PhantomPreset preset = phantom_preset("demo");
  Imported demo = import_phantom("demo", preset.params, preset.upsample);
  demo.made.plan->depth_mm = demo_depth_mm;
  ImportOptions options;
  options.segmentation.upsample = preset.upsample;
  options.shoulder.emplace().threshold_hu = demo.segmentation->threshold_hu;
  save_imported(demo, options, folder, true);
  return demo.made;
}

}  // namespace ream::ct
