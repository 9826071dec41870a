#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "app/cli/commands.hpp"
#include "case/landmarks.hpp"
#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/units.hpp"
#include "ct/phantom/individual.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "ct/read/write_volume.hpp"

namespace ream::app {
namespace {

constexpr double default_version_deg = -2.0, default_inclination_deg = 4.2;

struct PhantomOptions {
  std::filesystem::path out;
  std::optional<uint64_t> individual;
  std::optional<double> version_deg, inclination_deg, radius_mm, spacing_mm;
  double noise_hu = ct::PhantomParams{}.noise_hu;
  std::optional<uint64_t> random_seed;
  std::optional<std::string> shape;
  std::string side = "right", type = "A1", format = "dicom", preset;
};

void write_volume(const ct::HuVolume& volume, const PhantomOptions& options, uint64_t random_seed,
                  const std::filesystem::path& folder) {
  if (options.format == "dicom")
    ct::write_dicom_folder(volume, folder, random_seed);
  else
    ct::write_volume_file(volume, folder / (options.format == "nrrd" ? "ct.nrrd" : "ct.nii.gz"));
}

/// One of many people, or the mean shoulder; then what was asked for.
ct::PhantomParams params_of(const PhantomOptions& options) {
  ct::PhantomParams params = options.individual ? ct::individual(*options.individual) : ct::PhantomParams{};
  if (!options.preset.empty()) {
    const ct::PhantomParams preset = ct::phantom_preset(options.preset).params;
    params.field_mm = preset.field_mm;
    params.spacing_mm = preset.spacing_mm;
    if (!options.individual) {
      params.glenoid_height_mm = preset.glenoid_height_mm;
      params.glenoid_width_mm = preset.glenoid_width_mm;
      params.anatomical = preset.anatomical;
    }
  }
  params.side = case_::side_from_text(options.side);
  params.type = ct::phantom_type_from_text(options.type);
  const bool is_simple =
      options.shape ? *options.shape == "simple" : !options.preset.empty() && !params.anatomical;
  if (is_simple)
    params.anatomical.reset();
  else if (!params.anatomical)
    params.anatomical = ct::AnatomicalSizes{};
  if (options.version_deg || !options.individual)
    params.version_rad = radians_from_degrees(options.version_deg.value_or(default_version_deg));
  if (options.inclination_deg || !options.individual)
    params.inclination_rad = radians_from_degrees(options.inclination_deg.value_or(default_inclination_deg));
  if (options.radius_mm) params.glenoid_radius_mm = *options.radius_mm;
  if (options.spacing_mm) params.spacing_mm = Vec3::Constant(*options.spacing_mm);
  params.noise_hu = options.noise_hu;
  if (options.random_seed) params.random_seed = *options.random_seed;
  return params;
}

/// Of the identifiers of a DICOM series: two phantoms of one individual are not taken for one.
uint64_t uid_seed(const PhantomOptions& options, const ct::PhantomParams& params) {
  if (!options.individual) return params.random_seed;
  const std::string words =
      options.type + ' ' + options.side + (params.anatomical ? " anatomical" : " simple");
  return hash_combine(params.random_seed, hash_bytes(std::as_bytes(std::span(words))));
}

void phantom(const PhantomOptions& options, const GlobalOptions& global) {
  AtomicFolder folder(options.out);
  const ct::PhantomParams params = params_of(options);
  const ct::Phantom made = ct::make_phantom(params);
  write_volume(made.volume, options, uid_seed(options, params), folder.path());
  const nlohmann::json truth = ct::to_json(made.truth);
  write_json_file(folder.path() / "ground_truth.json", truth);
  case_::save_landmarks(made.truth.landmarks, folder.path());
  folder.commit();
  const Vec3i& d = made.volume.dims;
  if (global.json) {
    const Vec3& s = made.volume.spacing_mm;
    std::cout << nlohmann::json{{"out", options.out.string()},
                                {"dims", {d.x(), d.y(), d.z()}},
                                {"spacing_mm", {s.x(), s.y(), s.z()}},
                                {"ground_truth", truth}}
                     .dump()
              << '\n';
    return;
  }
  std::cout << options.side << " shoulder, " << d.x() << " x " << d.y() << " x " << d.z()
            << " voxels, its ground truth and landmarks in " << options.out.string() << '\n';
}

}  // namespace

void add_phantom_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<PhantomOptions>();
  CLI::App* command = app.add_subcommand("phantom", "Make a shoulder CT whose truth is known exactly");
  command
      ->add_option("--out", options->out,
                   "Folder for the CT, ground_truth.json and landmarks.json; must be new or empty")
      ->required();
  command->add_option("--version-deg", options->version_deg,
                      "Glenoid version, retroversion negative. Default: -2, or the individual's");
  command->add_option("--inclination-deg", options->inclination_deg,
                      "Glenoid inclination, superior positive. Default: 4.2, or the individual's");
  command->add_option("--radius-mm", options->radius_mm,
                      "Radius of the bony articular surface. Default: 35, or the individual's");
  command->add_option("--spacing-mm", options->spacing_mm, "Voxel size. Default: 0.668 x 0.668 x 0.625")
      ->check(CLI::Range(0.05, 10.0));
  command->add_option("--side", options->side, "left or right")
      ->check(CLI::IsMember({"left", "right"}))
      ->capture_default_str();
  command
      ->add_option(
          "--type", options->type,
          "Walch's A1, A2 (worn in the centre), B1 (head slid back), B2 (biconcave), B3 (worn behind), "
          "C1 (dysplastic) or D (anteverted); osteophytes (at the rim), osteoporotic")
      ->check(CLI::IsMember(ct::phantom_type_texts(), CLI::ignore_case))
      ->capture_default_str();
  command
      ->add_option(
          "--shape", options->shape,
          "anatomical, or simple: body, acromion, coracoid and humerus of plain bars and plates, around "
          "the same glenoid. Default: anatomical; with --preset, that case's")
      ->check(CLI::IsMember({"anatomical", "simple"}));
  command
      ->add_option(
          "--individual", options->individual,
          "The shoulder of one of many people, by number: sizes and angles drawn from published means and "
          "spreads")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1'000'000'000}));
  command->add_option("--format", options->format, "dicom, nrrd or nifti")
      ->check(CLI::IsMember({"dicom", "nrrd", "nifti"}))
      ->capture_default_str();
  command
      ->add_option("--preset", options->preset,
                   "Field and voxel size of a known case instead of the whole shoulder")
      ->check(CLI::IsMember({"demo", "thesis-5-4-2"}));
  command->add_option("--noise-hu", options->noise_hu, "Standard deviation of the noise")
      ->capture_default_str();
  command->add_option("--random-seed", options->random_seed,
                      "Seed of the noise. Default: 1, or the individual's number");
  command->callback([options, &global] { phantom(*options, global); });
}

}  // namespace ream::app
