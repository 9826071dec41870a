#pragma once
#include <array>
#include <string>

namespace ream::bench {

inline constexpr std::array<double, 3> thesis_sizes_mm = {0.5, 0.25, 0.1};

/// Milliseconds of tables 3.4 and 3.5, at 0.5, 0.25 and 0.1 mm.
struct ThesisTimes {
  std::string mesh;
  std::array<double, 3> gtx_970, hd_530, core_i7_6700k, fx_770k, single_thread;
};

/// In the order of benchmark_meshes(). The thesis' dragon has 100,000 triangles and its scapula 470,340, ours
/// 202,520 and 28,106. Table 3.5's column of the 6700HQ repeats a number and is left out.
const std::array<ThesisTimes, 5>& thesis_times();

/// Table 3.1: voxel size, tests by voxel, tests by triangle, in millions; of a mesh that the thesis does not
/// name.
inline constexpr std::array<std::array<double, 3>, 4> thesis_tests = {
    {{3.0, 1.767431, 93e-6}, {2.0, 4.615507, 224e-6}, {1.0, 44.406021, 1107e-6}, {0.5, 368.832950, 5874e-6}}};

}  // namespace ream::bench
