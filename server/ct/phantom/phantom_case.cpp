#include "ct/phantom/phantom_case.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/build/import.hpp"
#include "ct/build/surroundings.hpp"

namespace ream::ct {
namespace {

constexpr double seed_depth_mm = 5.0, seed_reach_mm = 2.0;  // in the vault, under the plate
constexpr double surroundings_sample_mm = 1.0;
constexpr double demo_depth_mm = 1.0;  // within the subchondral plate, and what the demo script reaches

/// What of the phantom grows from within the vault.
Mask scapula_of(const Phantom& phantom, double threshold_hu) {
  const case_::GlenoidFrame& glenoid = phantom.truth.glenoid;
  const Vec3 inside = glenoid.centre_mm - seed_depth_mm * glenoid.lateral;
  const Mask bone = above_threshold(phantom.volume, threshold_hu);
  const auto seed = nearest_set(bone, phantom.volume, inside, seed_reach_mm);
  if (!seed) throw Error(ErrorKind::invalid_input, "the phantom's vault holds no bone of its threshold");
  return grown_from(bone, phantom.volume.dims, *seed);
}

Segmentation segmentation_of(const HuVolume& volume, const Mask& mask, double threshold_hu) {
  Segmentation segmentation;
  segmentation.labels = mask;
  for (uint8_t& label : segmentation.labels)
    if (label != 0) label = static_cast<uint8_t>(BoneLabel::scapula);
  segmentation.threshold_hu = threshold_hu;
  segmentation.parts = measure_parts(volume, segmentation.labels);
  return segmentation;
}

case_::Case case_of(const Phantom& phantom, const Mask& mask, const std::string& id,
                    const PhantomParams& params, int upsample) {
  const case_::GlenoidFrame& glenoid = phantom.truth.glenoid;
  case_::Case result;
  result.id = id;
  result.name = "Phantom shoulder, " + case_::to_text(params.side);
  result.source = phantom.volume.source;
  result.side = params.side;
  result.bone = bone_of_whole_volume(phantom.volume, mask, upsample, params.calibration);
  result.calibration = params.calibration;
  result.glenoid = glenoid;
  case_::Plan plan;
  plan.entry_mm = glenoid.centre_mm;
  plan.axis_direction = -glenoid.lateral;
  result.plan = plan;
  return result;
}

/// The demo's CT shows the glenoid and its vault; the rest of that scapula is for pictures only, which do
/// without it where it cannot be kept.
void keep_rest_of_scapula(const case_::Case& demo, const std::filesystem::path& folder) {
  PhantomParams whole = phantom_preset("demo").params;
  whole.field_mm = PhantomParams{}.field_mm;
  try {
    keep_surroundings(surroundings_of(scapula_surface(whole, surroundings_sample_mm), demo.bone.grid),
                      demo.side, folder);
  } catch (const Error& e) {
    log::warn(std::string("the demo is shown without what lies around its bone: ") + e.what());
  }
}

/// Not somebody's own case of that name.
bool is_phantom(const case_::Case& demo) {
  return demo.source == phantom_source(phantom_preset("demo").params);
}

}  // namespace

PhantomPreset phantom_preset(const std::string& name) {
  PhantomPreset preset;
  PhantomParams& p = preset.params;
  if (name == "demo") {
    p.anatomical = AnatomicalSizes{};
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
  const Phantom phantom = make_phantom(params);
  return case_of(phantom, scapula_of(phantom, params.calibration.threshold_hu), id, params, upsample);
}

case_::Case load_or_make_demo_case(const std::filesystem::path& data_folder) {
  const auto folder = data_folder / "cases" / "demo";
  if (std::filesystem::exists(folder / "case.json")) {
    case_::Case demo = case_::load_case(folder);
    if (is_phantom(demo) && !std::filesystem::exists(folder / surroundings_file))
      keep_rest_of_scapula(demo, folder);
    return demo;
  }
  const auto [params, upsample] = phantom_preset("demo");
  Phantom phantom = make_phantom(params);
  SegmentationSettings settings;
  settings.threshold_hu = params.calibration.threshold_hu;
  settings.side = params.side;
  const Mask mask = scapula_of(phantom, *settings.threshold_hu);
  Segmentation segmentation = segmentation_of(phantom.volume, mask, *settings.threshold_hu);

  Imported demo;
  demo.made = case_of(phantom, mask, "demo", params, upsample);
  demo.made.plan->depth_mm = demo_depth_mm;
  demo.landmarks = phantom.truth.landmarks;
  demo.workup = new_workup(demo.made.id, demo.made.name, params.side, phantom.volume);
  record_segmentation(demo.workup, settings, segmentation);
  BuildSettings build;
  build.upsample = upsample;
  build.around_glenoid = false;
  build.calibration = params.calibration;
  demo.workup.built = build_record(demo.made.bone, build, demo.workup.segmentation()->revision);
  demo.hu = std::move(phantom.volume.hu);
  demo.labels = std::move(segmentation.labels);
  save_imported(demo, folder, true);
  keep_rest_of_scapula(demo.made, folder);
  return demo.made;
}

}  // namespace ream::ct
