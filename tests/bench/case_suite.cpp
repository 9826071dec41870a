#include <algorithm>
#include <filesystem>
#include <random>
#include <span>

#include "bench/bench.hpp"
#include "case/case.hpp"
#include "core/clock.hpp"
#include "core/file.hpp"
#include "ct/build/ct_workspace.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "ct/segment/shoulder_bones.hpp"
#include "session/simulation/find_case.hpp"
#include "support/temporary_folder.hpp"
#include "voxel/upsample.hpp"

namespace ream::bench {
namespace {

constexpr int runs = 7;
constexpr double goal_upsample_s = 1.0, goal_import_s = 60.0;
/// The thesis upsamples 65 million cells a second (section 2.4).
constexpr double thesis_cells_s = 65e6;

template <typename Action>
double median_s(int times, Action&& action) {
  std::vector<double> seconds;
  for (int run = 0; run < times; ++run) {
    const auto start = SteadyClock::now();
    action();
    seconds.push_back(std::chrono::duration<double>(SteadyClock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + times / 2, seconds.end());
  return seconds[static_cast<size_t>(times / 2)];
}

template <typename T>
Row upsample_row(const std::string& what) {
  const Vec3i dims(75, 48, 58);
  constexpr int factor = 8;
  std::vector<T> input(static_cast<size_t>(dims.prod()));
  std::mt19937 random(1);
  for (T& value : input) value = static_cast<T>(random());
  const double seconds =
      median_s(runs, [&] { voxel::upsample_trilinear(std::span<const T>(input), dims, factor); });
  const double cells = static_cast<double>(input.size()) * factor * factor * factor;
  return {"case",  what + " upsampled by 8 to 600 x 384 x 464 (baseline: the thesis' rate)",
          seconds, cells / thesis_cells_s,
          "s",     goal_upsample_s};
}

void loading_rows(std::vector<Row>& rows) {
  const test::TemporaryFolder folder;
  const auto preset = ct::phantom_preset("thesis-5-4-2");
  case_::save_case(ct::make_phantom_case("thesis-5-4-2", preset.params, preset.upsample),
                   folder.path() / "case");
  session::CaseCache cache;
  case_::Case first, second;
  rows.push_back({"case", "thesis-5-4-2 loaded for a first session",
                  median_s(1, [&] { first = cache.load(folder.path() / "case"); }), 0.0, "s"});
  rows.push_back({"case", "the same for a second one beside it",
                  median_s(1, [&] { second = cache.load(folder.path() / "case"); }), 0.0, "s"});
  const bool shared = first.bone.density.shares_with(second.bone.density);
  const double voxels = static_cast<double>(first.bone.grid.voxel_count());
  rows.push_back({"case", "memory of the second one's voxels", (shared ? 1.0 : 2.0) * voxels / 1e6,
                  2.0 * voxels / 1e6, "MB"});
}

/// A whole shoulder of the size of a clinical CT's half.
void making_rows(std::vector<Row>& rows) {
  ct::PhantomParams params;
  params.spacing_mm = {0.6, 0.6, 1.0};
  const ct::Phantom phantom = ct::make_phantom(params);
  const test::TemporaryFolder folder;
  const auto at = folder.path() / "case";
  ct::Workup workup = ct::create_workup(at, "case", "case", case_::Side::right, phantom.volume);
  ct::Segmentation made;
  const double segmenting =
      median_s(1, [&] { made = ct::segment_shoulder(phantom.volume, {}, no_progress); });
  ct::add_segmentation(at, workup, {}, made);
  const double building = median_s(1, [&] {
    ct::build_from(workup, phantom.volume.hu, made.labels, phantom.truth.landmarks, {}, no_progress);
  });
  const Vec3i& d = phantom.volume.dims;
  const std::string size =
      std::to_string(d.x()) + " x " + std::to_string(d.y()) + " x " + std::to_string(d.z());
  rows.push_back({"case", "bones of a CT of " + size + " told apart", segmenting, 0.0, "s", goal_import_s});
  rows.push_back({"case", "its glenoid built at upsample 4", building, 0.0, "s", goal_import_s});
}

}  // namespace

std::vector<Row> case_suite(const Options&) {
  std::vector<Row> rows = {upsample_row<uint8_t>("8 bits"), upsample_row<int16_t>("16 bits")};
  loading_rows(rows);
  making_rows(rows);
  return rows;
}

}  // namespace ream::bench
