#pragma once
#include <array>
#include <limits>
#include <vector>

#include "bench/bench.hpp"

namespace ream::bench {

/// Resolutions of tables 4.1 and 4.3 to 4.5.
inline constexpr std::array voxmap_resolutions{128, 256, 512, 1024};
inline constexpr std::array shell_resolutions{64, 128, 256, 512, 1024};

/// Who is measured. The baselines run on PoCL's one-thread device and on all cores.
enum class Method {
  flat_one_thread,
  flat_all_cores,
  zheng_one_thread,
  zheng_all_cores,
  zheng_flags_left,  ///< all cores, the collided flags of earlier ticks not cleared
  ours_cpu,
  ours_opencl,
};
inline constexpr size_t method_count = 7;

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Spacing, mm, of a shell "of N^3". The thesis' shells have 1.19 M points at 1024^3 and 213 k at 0.1 mm
/// (table 4.4, section 5.4.2), so its tool is 43.4 mm long; the bench's tool gets the same spacing and so the
/// same numbers of points.
double shell_spacing_mm(int resolution);

/// Mean times over 64 seeded poses of severe collision (glenoid_block.hpp), us; `not_measured`
/// where a method does not go.
struct ResolutionStudy {
  double us[voxmap_resolutions.size()][shell_resolutions.size()][method_count];
  double yau_one_thread_us[voxmap_resolutions.size()], yau_all_cores_us[voxmap_resolutions.size()];
  /// Bytes of this program; Voxmaps for all shell_resolutions, since table 4.4 starts at 64^3.
  double shell_bytes[shell_resolutions.size()], voxmap_bytes[shell_resolutions.size()];
  double points[shell_resolutions.size()];
  double mean_inside = 0.0;  ///< share of points, 0 to 1
  std::vector<Row> rows;  ///< goals that are not in a table: the finest pair, and the influence of the Voxmap

  double time_us(size_t voxmap, size_t shell, Method method) const {
    return us[voxmap][shell][static_cast<size_t>(method)];
  }
  double best_of_ours_us(size_t voxmap, size_t shell) const;
};

/// Takes some minutes and about 4 GB.
ResolutionStudy study_resolutions();

}  // namespace ream::bench
