#include <cmath>
#include <vector>

#include "bench/text_table.hpp"
#include "bench/validate/found_landmarks.hpp"
#include "bench/validate/normal_noise.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/validate_parts.hpp"
#include "case/measures.hpp"
#include "core/units.hpp"
#include "statistics/regression.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

constexpr size_t scapulae = 12;
constexpr uint64_t version_seed = 4001;
constexpr ScanProtocol version_protocol{"0.6 x 1.25 mm", 0.6, 1.25};
/// What surgeons who are told their angle come within (Axford 2019), and half of it for a common error.
constexpr double error_goal_deg = 1.0, bias_goal_deg = 0.5;
constexpr double scale_goal_percent = 3.0;
/// A hand's error on a landmark.
constexpr double hand_mm = 1.0;

/// Measured less true, of all scapulae, degrees.
struct AngleErrors {
  std::vector<double> truth_deg, measured_deg, hand_deg;
};
struct VersionErrors {
  AngleErrors version, inclination;
  explicit VersionErrors(size_t count) {
    for (AngleErrors* angle : {&version, &inclination})
      for (std::vector<double>* values : {&angle->truth_deg, &angle->measured_deg, &angle->hand_deg})
        values->resize(count);
  }
};

ScannedScapula scapula_of_seed(uint64_t seed) {
  NormalNoise random(seed);
  ScannedScapula scanned;
  test::ShoulderShape& shoulder = scanned.glenoid.shoulder;
  shoulder.side = seed % 2 == 0 ? case_::Side::right : case_::Side::left;
  shoulder.version_deg = random.between(-25.0, 10.0);
  shoulder.inclination_deg = random.between(-8.0, 16.0);
  shoulder.plane_deg = random.between(22.0, 40.0);
  shoulder.height_mm = random.between(33.0, 40.0);
  shoulder.width_mm = random.between(22.0, 28.0);
  scanned.glenoid.radius_mm = random.between(30.0, 40.0);
  scanned.glenoid.vault_mm = 13.0;  // as much as is looked at
  scanned.protocol = version_protocol;
  scanned.seed = 10 * seed;
  return scanned;
}

/// One scapula: as it is scanned, found and measured, with a steady hand and with one that misses.
void measure_scapula(size_t i, VersionErrors& errors) {
  const ScannedScapula scanned = scapula_of_seed(version_seed + i);
  const ImportedScapula imported = imported_scapula(scanned);
  const auto measured = [&](double click_error_mm) {
    return case_::measure(found_landmarks(scanned, imported, {5.0, click_error_mm, version_seed + 100 + i}),
                          scanned.glenoid.shoulder.side);
  };
  const case_::Measures steady = measured(0.0), hand = measured(hand_mm);
  errors.version.truth_deg[i] = scanned.glenoid.shoulder.version_deg;
  errors.version.measured_deg[i] = degrees_from_radians(steady.version_3d_rad.value());
  errors.version.hand_deg[i] = degrees_from_radians(hand.version_3d_rad.value());
  errors.inclination.truth_deg[i] = scanned.glenoid.shoulder.inclination_deg;
  errors.inclination.measured_deg[i] = degrees_from_radians(steady.inclination_3d_rad.value());
  errors.inclination.hand_deg[i] = degrees_from_radians(hand.inclination_3d_rad.value());
}

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference;
  for (size_t i = 0; i < a.size(); ++i) difference.push_back(a[i] - b[i]);
  return difference;
}

double mean_size(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::abs(value);
  return sum / static_cast<double>(values.size());
}

void add_angle(const char* angle, const AngleErrors& errors, std::vector<Row>& rows) {
  constexpr double limits_of_agreement = 1.96;  // deviations
  const std::string name = std::string("CT, ") + angle + " by landmarks found on 12 scapulae, ";
  const std::vector<double> off = less(errors.measured_deg, errors.truth_deg),
                            by_hand = less(errors.hand_deg, errors.truth_deg);
  const auto row = [&](const char* what, double value, const char* unit, double goal) {
    rows.push_back({"validate", name + what, value, 0.0, unit, goal});
  };
  row("mean error", mean_size(off), "deg", error_goal_deg);
  row("bias", std::abs(statistics::mean_of(off)), "deg", bias_goal_deg);
  row("95 % limits", limits_of_agreement * statistics::spread_of(off).sd, "deg", 0.0);
  row("scale off 1",
      100.0 * std::abs(statistics::regression(errors.truth_deg, errors.measured_deg).slope - 1.0), "%",
      scale_goal_percent);
  row("95 % limits, clicks 1 mm off", limits_of_agreement * statistics::spread_of(by_hand).sd, "deg", 0.0);
}

void print_scapulae(const VersionErrors& errors, std::ostream* out) {
  TextTable table;
  table.title = "Version and inclination, degrees, of scapulae scanned at 0.6 x 1.25 mm";
  table.corner = "seed";
  table.columns = {"version", "found", "1 mm off", "inclination", "found", "1 mm off"};
  for (size_t i = 0; i < scapulae; ++i)
    table.lines.push_back({std::to_string(version_seed + i),
                           {errors.version.truth_deg[i], errors.version.measured_deg[i],
                            errors.version.hand_deg[i], errors.inclination.truth_deg[i],
                            errors.inclination.measured_deg[i], errors.inclination.hand_deg[i]}});
  table.print(out, 2);
}

}  // namespace

std::vector<Row> version_rows(const Options& options) {
  VersionErrors errors(scapulae);
  in_parallel(scapulae, [&](size_t i) { measure_scapula(i, errors); });
  print_scapulae(errors, options.tables);
  std::vector<Row> rows;
  add_angle("version", errors.version, rows);
  add_angle("inclination", errors.inclination, rows);
  return rows;
}

}  // namespace ream::bench
