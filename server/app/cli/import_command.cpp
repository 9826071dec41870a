#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/numbers.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/log.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/build/import.hpp"
#include "session/export/session_bundle.hpp"

namespace ream::app {
namespace {

struct ImportOptions {
  std::filesystem::path path, label;
  std::string out, grow_from, humerus, glenoid, roi, calibration, side, labels_out;
  ct::ImportOptions import;
  bool replace = false, no_separate = false, without_ct = false, keep_labels = false;
};

Vec3 point(const std::vector<double>& n, size_t first = 0) { return {n[first], n[first + 1], n[first + 2]}; }

case_::Calibration parsed_calibration(const std::string& text) {
  const auto n = parse_numbers(text, 2, "--calibration");
  if (!(n[1] > 0.0))
    throw Error(ErrorKind::usage, "--calibration A,B: the slope B must be positive (mg/cc per HU)");
  case_::Calibration calibration;
  calibration.intercept_mg_cc = n[0];
  calibration.slope_mg_cc_per_hu = n[1];
  return calibration;
}

ct::ImportOptions parsed(const ImportOptions& options) {
  ct::ImportOptions import = options.import;
  if (!options.label.empty()) import.label = options.label;
  if (!options.side.empty()) import.side = case_::side_from_text(options.side);
  if (!options.labels_out.empty()) import.labels_out = options.labels_out;
  import.segmentation.separate = !options.no_separate;
  if (!options.grow_from.empty())
    import.segmentation.seeds.scapula_mm = point(parse_numbers(options.grow_from, 3, "--grow-from"));
  if (!options.humerus.empty())
    import.segmentation.seeds.humerus_mm = point(parse_numbers(options.humerus, 3, "--humerus"));
  if (!options.glenoid.empty()) import.glenoid_mm = point(parse_numbers(options.glenoid, 3, "--glenoid"));
  import.build.around_glenoid = !options.roi.empty();
  if (!options.roi.empty() && options.roi != "glenoid") {
    const auto n = parse_numbers(options.roi, 6, "--roi");
    import.build.roi_mm = Aabb{point(n).cwiseMin(point(n, 3)), point(n).cwiseMax(point(n, 3))};
  }
  if (!options.calibration.empty()) import.build.calibration = parsed_calibration(options.calibration);
  return import;
}

void report(const case_::Case& c, const std::filesystem::path& out, bool as_json) {
  const auto& d = c.bone.grid.dims;
  const auto& s = c.bone.grid.spacing_mm;
  const auto density = ct::density_range_g_cc(c.bone);
  for (const auto& warning : c.warnings) log::warn(warning);
  if (as_json) {
    std::cout << nlohmann::json{{"case", c.id},
                                {"out", out.string()},
                                {"dims", {d.x(), d.y(), d.z()}},
                                {"spacing_mm", {s.x(), s.y(), s.z()}},
                                {"bone_voxels", c.bone.filled_voxels()},
                                {"side", case_::to_text(c.side)},
                                {"threshold_hu", c.calibration.threshold_hu},
                                {"density_range_g_cc", density},
                                {"warnings", c.warnings}}
                     .dump()
              << '\n';
    return;
  }
  std::cout << c.bone.filled_voxels() << " bone voxels of " << s.x() << " x " << s.y() << " x " << s.z()
            << " mm in a grid of " << d.x() << " x " << d.y() << " x " << d.z() << ", "
            << case_::to_text(c.side) << " side\n"
            << "bone from " << c.calibration.threshold_hu << " HU on, density " << density[0] << " to "
            << density[1] << " g/cc\n"
            << out.string() << '\n';
}

void import_bundle(const ImportOptions& options, const GlobalOptions& global) {
  const std::filesystem::path data = data_folder(global.data);
  const std::string id = session::import_session_bundle(options.path, data, options.keep_labels);
  const std::string folder = (sessions_folder(data) / id).string();
  if (global.json)
    std::cout << nlohmann::json{{"session", id}, {"out", folder}}.dump() << '\n';
  else
    std::cout << "session " << id << '\n' << folder << '\n';
}

void import_case(const ImportOptions& options, const GlobalOptions& global) {
  if (session::is_session_bundle(options.path)) return import_bundle(options, global);
  if (options.out.empty()) throw Error(ErrorKind::usage, "--out is required: the name of the new case");
  const auto out = case_path(options.out, global.data);
  if (!options.replace && std::filesystem::exists(out / "case.json"))
    throw Error(ErrorKind::conflict,
                out.string() + " is a case already; choose another name or give --replace");
  const TerminalProgress progress;
  const ct::Imported result =
      ct::import_ct(options.path, ct::case_id_from(out), parsed(options), std::cref(progress));
  if (options.without_ct)
    case_::save_case(result.made, out, options.replace);
  else
    ct::save_imported(result, out, options.replace);
  report(result.made, out, global.json);
}

}  // namespace

void add_import_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ImportOptions>();
  ct::SegmentationSettings& segmentation = options->import.segmentation;
  ct::BuildSettings& build = options->import.build;
  build.upsample = 1;
  CLI::App* command =
      app.add_subcommand("import", "Make a case out of a CT, or take in a session from another machine");
  command
      ->add_option("PATH", options->path,
                   "Folder of DICOM slices, a NRRD, NIfTI or MetaImage file, text rows x y z gray, a zip "
                   "archive of one of these, or a session's bundle (.zip of ream export)")
      ->required();
  command->add_option("--out", options->out, "Name of the new case, or a folder; not for a session's bundle");
  command->add_option("--name", options->import.name, "Name for people");
  CLI::Option* label = command->add_option("--label", options->label,
                                           "Label map that tells bone, instead of segmenting the CT");
  command->add_option("--label-value", options->import.label_value, "Value of the bone in the label map")
      ->capture_default_str();
  command
      ->add_option("--threshold-hu", segmentation.threshold_hu,
                   "Bone is at least this. Default: suggested by the histogram")
      ->check(CLI::Range(-1000.0, 4000.0))
      ->excludes(label);
  command
      ->add_option("--grow-from", options->grow_from,
                   "X,Y,Z of a point in the scapula, LPS mm. Default: found beside the humeral head")
      ->excludes(label);
  command
      ->add_option("--humerus", options->humerus,
                   "X,Y,Z of a point in the humeral head, LPS mm. Default: found as the best sphere")
      ->excludes(label);
  command->add_flag("--no-separate", options->no_separate, "Leave bones together that touch")
      ->excludes(label);
  command->add_option("--sigma-mm", segmentation.sigma_mm, "Gaussian smoothing before everything")
      ->capture_default_str()
      ->excludes(label);
  command->add_option("--roi", options->roi,
                      "X0,Y0,Z0,X1,Y1,Z1: box to keep, LPS mm; or glenoid: 60 x 60 x 70 mm around it");
  command->add_option("--glenoid", options->glenoid,
                      "X,Y,Z of the glenoid's centre, LPS mm. Default: found beside the humeral head");
  command->add_option("--cartilage-mm", build.cartilage_mm, "Thickness of synthetic cartilage on the glenoid")
      ->check(CLI::Range(0.0, 6.0))
      ->capture_default_str();
  command->add_option("--labels-out", options->labels_out,
                      "Write the labels of all bones to this .nrrd, .nii or .nii.gz file");
  command->add_option("--upsample", build.upsample, "Parts of a CT voxel per axis")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_option("--calibration", options->calibration,
                      "A,B: rho_QCT = A + B HU, mg/cc. Default: 1.3152,0.6944");
  command->add_option("--side", options->side, "left or right")->check(CLI::IsMember({"left", "right"}));
  command->add_option("--series", options->import.series_uid,
                      "UID of the DICOM series. Default: the one of most slices");
  command->add_flag("--keep-names", options->import.keep_names,
                    "The patient's name and id become the case's name; else neither is kept");
  command->add_flag("--keep-labels", options->keep_labels,
                    "Of a session's bundle: keep who trained and for which study; else neither is kept");
  command->add_flag("--without-ct", options->without_ct,
                    "Do not keep the CT beside the case (its page then shows no slices)");
  command->add_flag("--replace", options->replace, "Replace an existing case of that name");
  command->callback([options, &global] { import_case(*options, global); });
}

}  // namespace ream::app
