#include <algorithm>
#include <cstring>

#include "collide/narrow_phase.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

constexpr size_t max_block_points = 512;
constexpr int occupancy_shift = 2;
static_assert(1 << occupancy_shift == voxel::occupancy_edge);

/// Probes of a run that lie in occupied cells: their voxel index and number within the run. Straight-line
/// arithmetic, so that it vectorizes; the order of operations is that of kernels/narrow_phase.cl.
struct Candidates {
  int32_t voxel[max_block_points];
  int32_t number[max_block_points];
  size_t count = 0;
};

REAM_VECTOR_CLONES void find_candidates(const float* __restrict x, const float* __restrict y,
                                        const float* __restrict z, int n, const GridAffine& shared_affine,
                                        const Vec3i& dims, const voxel::Occupancy& occupancy,
                                        Candidates& found) {
  const float dx = static_cast<float>(dims.x()), dy = static_cast<float>(dims.y()),
              dz = static_cast<float>(dims.z());
  const int brick_row = dims.x() / 8, brick_slice = brick_row * (dims.y() / 8);
  const int cell_row = occupancy.dims.x(), cell_slice = cell_row * occupancy.dims.y();
  const GridAffine a = shared_affine;  // a copy, so that the compiler knows that stores do not change it
  // Signed on purpose: only signed 32-bit indices become gathers.
  const int32_t* __restrict words = reinterpret_cast<const int32_t*>(occupancy.words.data());
  int32_t occupied_memory[max_block_points], voxel_memory[max_block_points];
  int32_t* __restrict voxel_index = voxel_memory;
  int32_t* __restrict occupied = occupied_memory;
  for (int i = 0; i < n; ++i) {
    const float u = a.m[0] * x[i] + a.m[1] * y[i] + a.m[2] * z[i] + a.t[0];
    const float v = a.m[3] * x[i] + a.m[4] * y[i] + a.m[5] * z[i] + a.t[1];
    const float w = a.m[6] * x[i] + a.m[7] * y[i] + a.m[8] * z[i] + a.t[2];
    // Outside points look at voxel 0 of their axis and are dropped by the flag. Written so that it
    // vectorizes.
    const int in_u = u >= 0.0f ? (u < dx ? -1 : 0) : 0;
    const int in_v = v >= 0.0f ? (v < dy ? -1 : 0) : 0;
    const int in_w = w >= 0.0f ? (w < dz ? -1 : 0) : 0;
    const int inside = in_u & in_v & in_w;
    const float low_u = u >= 0.0f ? u : 0.0f, low_v = v >= 0.0f ? v : 0.0f, low_w = w >= 0.0f ? w : 0.0f;
    const int iu = static_cast<int>(low_u < dx ? low_u : 0.0f);
    const int iv = static_cast<int>(low_v < dy ? low_v : 0.0f);
    const int iw = static_cast<int>(low_w < dz ? low_w : 0.0f);
    const int cell =
        (iu >> occupancy_shift) + (iv >> occupancy_shift) * cell_row + (iw >> occupancy_shift) * cell_slice;
    const int brick = (iu >> 3) + (iv >> 3) * brick_row + (iw >> 3) * brick_slice;
    voxel_index[i] = brick * 512 + (iu & 7) + (iv & 7) * 8 + (iw & 7) * 64;
    occupied[i] = (words[cell >> 5] >> (cell & 31)) & inside & 1;
  }
  size_t count = 0;
  for (int i = 0; i < n; ++i) {
    found.voxel[count] = voxel_index[i];
    found.number[count] = i;
    count += static_cast<size_t>(occupied[i]);
  }
  found.count = count;
}

/// Upper triangle of the outer-product sums of one run; 512 points of weight 28 and components 127 stay below
/// 2^31.
struct RunSums {
  int32_t products[7][7];

  void add_to(ContactSums::Part& part, size_t points) const {
    part.points += static_cast<int64_t>(points);
    for (size_t i = 0; i < 7; ++i) part.first[i] += products[i][6];
    size_t k = 0;
    for (size_t i = 0; i < 6; ++i)
      for (size_t j = i; j < 6; ++j) part.second[k++] += products[i][j];
  }
};

/// Component by component, so that each sum is one long vectorized dot product.
REAM_VECTOR_CLONES void sum_products(const ContactVector* vectors, const uint8_t* weights,
                                     const int32_t* numbers, int n, RunSums& sums) {
  alignas(64) int32_t g[7][max_block_points], weighted[7][max_block_points];
  for (int p = 0; p < n; ++p) {
    const int16_t* vector = vectors[numbers[p]].data();
    const int32_t weight = weights[numbers[p]];
    for (int i = 0; i < 7; ++i) {
      g[i][p] = vector[i];
      weighted[i][p] = weight * vector[i];
    }
  }
  for (int i = 0; i < 7; ++i)
    for (int j = i; j < 7; ++j) {
      int32_t sum = 0;
      for (int p = 0; p < n; ++p) sum += weighted[i][p] * g[j][p];
      sums.products[i][j] = sum;
    }
}

class NarrowPhaseCpu final : public NarrowPhase {
 public:
  explicit NarrowPhaseCpu(const NarrowPhaseInput& input)
      : in_(input),
        classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
        survivors_(input.shell.blocks.size()) {}

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const GridAffine affine = voxel_from_tool(grid_from_tool, in_.bone.grid);
    const size_t n = cull_blocks(in_.shell, in_.distance, voi, affine,
                                 static_cast<float>(in_.bone.grid.min_spacing_mm()), survivors_);
    for (size_t i = 0; i < n; ++i) {
      const shell::ShellBlock& block = in_.shell.blocks[survivors_[i]];
      for (uint32_t done = 0; done < block.count; done += max_block_points)
        add_run(block.first + done, std::min<size_t>(block.count - done, max_block_points), affine, sums);
    }
    return true;
  }

 private:
  void add_run(size_t first, size_t count, const GridAffine& affine, ContactSums& sums) noexcept {
    const ContactShell& s = in_.shell;
    Candidates found;
    find_candidates(s.probe_x_mm.data() + first, s.probe_y_mm.data() + first, s.probe_z_mm.data() + first,
                    static_cast<int>(count), affine, in_.bone.grid.dims, in_.occupancy, found);
    const uint8_t* coverage = in_.bone.coverage.data();
    const uint8_t* density = in_.bone.density.data();
    int32_t cutting[max_block_points], guiding[max_block_points];
    size_t cutting_count = 0, guiding_count = 0;
    for (size_t i = 0; i < found.count; ++i) {
      if (coverage[found.voxel[i]] < engaging_coverage) continue;
      const int32_t number = found.number[i];
      if (s.guiding[first + static_cast<size_t>(number)]) {
        guiding[guiding_count++] = number;
        continue;
      }
      cutting[cutting_count++] = number;
      const uint8_t code = density[found.voxel[i]];
      const auto bone_class = static_cast<size_t>(classes_[code]);
      ++sums.class_points[bone_class];
      sums.class_density[bone_class] += code;
    }
    add_part(first, cutting, cutting_count, sums.cutting);
    add_part(first, guiding, guiding_count, sums.guiding);
  }

  void add_part(size_t first, const int32_t* numbers, size_t count, ContactSums::Part& part) noexcept {
    if (count == 0) return;
    RunSums run;
    sum_products(in_.shell.vectors.data() + first, in_.shell.weights.data() + first, numbers,
                 static_cast<int>(count), run);
    run.add_to(part, count);
  }

  NarrowPhaseInput in_;
  std::array<voxel::BoneClass, 256> classes_;
  std::vector<uint32_t> survivors_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input) {
  return std::make_unique<NarrowPhaseCpu>(input);
}

size_t cull_blocks(const ContactShell& shell, const voxel::BrickDistance& distance, const Voi& voi,
                   const GridAffine& a, float min_spacing_mm, std::span<uint32_t> survivors) noexcept {
  const Vec3f low = voi.box_tool_mm.min.cast<float>(), high = voi.box_tool_mm.max.cast<float>();
  const float voxels_per_mm = 1.0f / min_spacing_mm;
  size_t n = 0;
  for (uint32_t b = 0; b < shell.blocks.size(); ++b) {
    const auto& block = shell.blocks[b];
    const Vec3f& c = block.centre_mm;
    const float r = block.radius_mm;
    if (c.x() + r < low.x() || c.x() - r > high.x() || c.y() + r < low.y() || c.y() - r > high.y() ||
        c.z() + r < low.z() || c.z() - r > high.z())
      continue;
    const float u = a.m[0] * c.x() + a.m[1] * c.y() + a.m[2] * c.z() + a.t[0];
    const float v = a.m[3] * c.x() + a.m[4] * c.y() + a.m[5] * c.z() + a.t[1];
    const float w = a.m[6] * c.x() + a.m[7] * c.y() + a.m[8] * c.z() + a.t[2];
    // One voxel of slack covers rounding in the centre's coordinates.
    if (distance.lower_bound_voxels(u, v, w) > r * voxels_per_mm + 1.0f) continue;
    survivors[n++] = b;
  }
  return n;
}

}  // namespace ream::collide
