#include "bench/baselines/flat_kernel.hpp"

#include <cstring>
#include <optional>

#include "bench/baselines/kernel_source.hpp"
#include "collide/contact/broad_phase.hpp"
#include "collide/grid_transform.hpp"
#include "core/error.hpp"

namespace ream::bench {
namespace {

constexpr size_t local_items = 64;
/// Sums of 2 M points of at most this force each stay below 2^31.
constexpr float largest_force = 1000.0f;
constexpr double voi_slack_mm = 1e-3;  // covers rounding to float

constexpr uint64_t thesis_code_limit = uint64_t{1} << 30;

/// Every third bit of a 30-bit Morton code, as the kernel gathers them.
uint32_t gather_bits_10(uint32_t x) {
  x &= 0x09249249;
  x = (x | (x >> 2)) & 0x030c30c3;
  x = (x | (x >> 4)) & 0x0300f00f;
  x = (x | (x >> 8)) & 0x030000ff;
  return (x | (x >> 16)) & 0x3ff;
}

static_assert(sizeof(layout::BaselineAffine) == sizeof(collide::GridAffine));

/// Arguments of one tick; nothing when the boxes do not meet.
std::optional<layout::FlatExchange> arguments(const Voxmap& voxmap, const MortonShell& shell,
                                              const QuantisedPose& grid_from_tool,
                                              const FlatOptions& options) {
  Aabb voi = shell.box_mm;
  if (options.use_voi) {
    voi = thesis_voi(voxmap.bone_box_mm, shell.box_mm, dequantised(grid_from_tool));
    if (voi.empty()) return std::nullopt;
  }
  voi = voi.grown(voi_slack_mm);
  layout::FlatExchange e{};
  const collide::GridAffine affine = collide::voxel_from_tool(grid_from_tool, voxmap.grid());
  std::memcpy(&e.voxel_from_tool, &affine, sizeof affine);
  const Vec3 centre = shell.box_mm.centre();
  for (int i = 0; i < 3; ++i) {
    e.voi_low[i] = static_cast<float>(voi.min[i]);
    e.voi_high[i] = static_cast<float>(voi.max[i]);
    e.origin[i] = shell.origin_mm[i];
    e.centre[i] = static_cast<float>(centre[i]);
    e.dims[i] = voxmap.dims[i];
  }
  e.spacing = shell.spacing_mm;
  e.force_scale = largest_force / (255.0f * static_cast<float>(shell.box_mm.half_size().norm()));
  e.points = static_cast<uint32_t>(shell.codes.size());
  e.decay = options.decay;
  return e;
}

/// A run of points. The same operations as the kernel's, in floats; what is outside counts as void.
#if defined(__x86_64__)
__attribute__((optimize("O3"), target_clones("arch=x86-64-v4", "avx2", "default")))
#endif
FlatSums
sums_of_points(const layout::FlatExchange& e, const uint8_t* gray, const float* xs, const float* ys,
               const float* zs, size_t count) {
  const float* m = e.voxel_from_tool.m;
  const float* t = e.voxel_from_tool.t;
  const auto dx = e.dims[0], dy = e.dims[1], dz = e.dims[2];
  int32_t fx = 0, fy = 0, fz = 0, inside = 0;
  for (size_t i = 0; i < count; ++i) {
    const float x = xs[i], y = ys[i], z = zs[i];
    const float u = m[0] * x + m[1] * y + m[2] * z + t[0];
    const float v = m[3] * x + m[4] * y + m[5] * z + t[1];
    const float w = m[6] * x + m[7] * y + m[8] * z + t[2];
    const bool here = (x >= e.voi_low[0]) & (y >= e.voi_low[1]) & (z >= e.voi_low[2]) & (x <= e.voi_high[0]) &
                      (y <= e.voi_high[1]) & (z <= e.voi_high[2]) & (u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f) &
                      (u < static_cast<float>(dx)) & (v < static_cast<float>(dy)) &
                      (w < static_cast<float>(dz));
    const int32_t cu = here ? static_cast<int32_t>(u) : 0, cv = here ? static_cast<int32_t>(v) : 0,
                  cw = here ? static_cast<int32_t>(w) : 0;
    const int32_t level = here ? gray[cu + dx * (cv + dy * cw)] : 0;
    const float strength = static_cast<float>(level) * e.force_scale;
    fx += static_cast<int32_t>(strength * (e.centre[0] - x));
    fy += static_cast<int32_t>(strength * (e.centre[1] - y));
    fz += static_cast<int32_t>(strength * (e.centre[2] - z));
    inside += level > 0 ? 1 : 0;
  }
  return {{fx, fy, fz}, inside};
}

FlatSums sums_of(const layout::FlatExchange& e) { return {{e.force[0], e.force[1], e.force[2]}, e.inside}; }

}  // namespace

Vec3f MortonShell::point_mm(uint32_t code) const {
  return {origin_mm.x() + (static_cast<float>(gather_bits_10(code)) + 0.5f) * spacing_mm,
          origin_mm.y() + (static_cast<float>(gather_bits_10(code >> 1)) + 0.5f) * spacing_mm,
          origin_mm.z() + (static_cast<float>(gather_bits_10(code >> 2)) + 0.5f) * spacing_mm};
}

MortonShell morton_shell(const shell::PointShell& shell) {
  MortonShell result;
  result.origin_mm = shell.origin_mm.cast<float>();
  result.spacing_mm = static_cast<float>(shell.spacing_mm);
  result.codes.reserve(shell.points.size());
  const double half = 0.5 * shell.spacing_mm;
  for (const shell::ShellPoint& p : shell.points) {
    if (p.morton >= thesis_code_limit)
      throw Error(ErrorKind::invalid_input,
                  "bench: the thesis' 32-bit codes end at 1024 cells a side; use a coarser shell");
    result.codes.push_back(static_cast<uint32_t>(p.morton));
    const Vec3 centre = shell.cell_centre_mm(p.morton);
    result.box_mm.include((centre.array() - half).matrix());
    result.box_mm.include((centre.array() + half).matrix());
  }
  return result;
}

Aabb thesis_voi(const Aabb& bone_box_mm, const Aabb& tool_box_mm, const Pose& grid_from_tool) {
  if (bone_box_mm.empty() || tool_box_mm.empty()) return {};
  if (!collide::overlap(Obb::from(bone_box_mm, Pose{}), Obb::from(tool_box_mm, grid_from_tool))) return {};
  return tool_box_mm.intersection(bone_box_mm.transformed(grid_from_tool.inverse()));
}

FlatKernel::FlatKernel(const gpu::Queue& queue, Voxmap& voxmap, const MortonShell& shell)
    : queue_(queue),
      voxmap_(voxmap),
      shell_(shell),
      program_(gpu::Program::from_source(queue, "flat_kernel.cl", baseline_source("flat_kernel.cl"))),
      kernel_(program_, "flat_contact"),
      codes_(gpu::Buffer::over(queue, std::span(shell.codes))),
      gray_(gpu::Buffer::over(queue, std::span(voxmap.gray))),
      exchange_(queue, sizeof(layout::FlatExchange)) {
  kernel_.set_all(codes_, gray_, exchange_);
}

FlatSums FlatKernel::contact(const QuantisedPose& grid_from_tool, const FlatOptions& options) {
  std::optional<layout::FlatExchange> e = arguments(voxmap_, shell_, grid_from_tool, options);
  if (!e) return {};
  exchange_.write(queue_, &*e, sizeof *e);
  kernel_.enqueue(queue_, shell_.codes.size(), local_items);
  exchange_.read(queue_, &*e, sizeof *e);
  return sums_of(*e);
}

FlatThreads::FlatThreads(const Voxmap& voxmap, const MortonShell& shell) : voxmap_(voxmap), shell_(shell) {
  for (const uint32_t code : shell.codes) {
    const Vec3f p = shell.point_mm(code);
    x_.push_back(p.x());
    y_.push_back(p.y());
    z_.push_back(p.z());
  }
  thread_ = std::thread([this] { second_thread(); });
}

FlatThreads::~FlatThreads() {
  stop_ = true;
  ++asked_;
  asked_.notify_one();
  thread_.join();
}

void FlatThreads::second_thread() {
  const size_t half = x_.size() / 2;
  constexpr int max_spins = 1'000'000;  // some milliseconds
  for (uint32_t done = 0;;) {
    for (int i = 0; i < max_spins && asked_.load(std::memory_order_relaxed) == done; ++i) {
    }
    asked_.wait(done, std::memory_order_acquire);
    if (stop_) return;
    const uint32_t asked = asked_.load(std::memory_order_acquire);
    second_sums_ = sums_of_points(exchange_, voxmap_.gray.data(), x_.data() + half, y_.data() + half,
                                  z_.data() + half, x_.size() - half);
    done = asked;
    answered_.store(done, std::memory_order_release);
  }
}

FlatSums FlatThreads::contact(const QuantisedPose& grid_from_tool) {
  const auto found = arguments(voxmap_, shell_, grid_from_tool, {});
  if (!found) return {};
  exchange_ = *found;
  const uint32_t turn = asked_.load(std::memory_order_relaxed) + 1;
  asked_.store(turn, std::memory_order_release);
  asked_.notify_one();
  FlatSums sums =
      sums_of_points(exchange_, voxmap_.gray.data(), x_.data(), y_.data(), z_.data(), x_.size() / 2);
  while (answered_.load(std::memory_order_acquire) != turn) std::this_thread::yield();
  for (size_t i = 0; i < 3; ++i) sums.force[i] += second_sums_.force[i];
  sums.inside += second_sums_.inside;
  return sums;
}

FlatSums flat_contact_cpu(Voxmap& voxmap, const MortonShell& shell, const QuantisedPose& grid_from_tool,
                          const FlatOptions& options, std::vector<uint8_t>* inside) {
  if (inside != nullptr) inside->assign(shell.codes.size(), 0);
  std::optional<layout::FlatExchange> found = arguments(voxmap, shell, grid_from_tool, options);
  if (!found) return {};
  layout::FlatExchange& e = *found;
  const float* m = e.voxel_from_tool.m;
  const float* t = e.voxel_from_tool.t;
  const size_t dx = static_cast<size_t>(e.dims[0]), dy = static_cast<size_t>(e.dims[1]);
  for (size_t i = 0; i < shell.codes.size(); ++i) {
    const Vec3f p = shell.point_mm(shell.codes[i]);
    const float x = p.x(), y = p.y(), z = p.z();
    if (x < e.voi_low[0] || y < e.voi_low[1] || z < e.voi_low[2] || x > e.voi_high[0] || y > e.voi_high[1] ||
        z > e.voi_high[2])
      continue;
    const float u = m[0] * x + m[1] * y + m[2] * z + t[0];
    const float v = m[3] * x + m[4] * y + m[5] * z + t[1];
    const float w = m[6] * x + m[7] * y + m[8] * z + t[2];
    if (!(u >= 0.0f && v >= 0.0f && w >= 0.0f && u < static_cast<float>(e.dims[0]) &&
          v < static_cast<float>(e.dims[1]) && w < static_cast<float>(e.dims[2])))
      continue;
    uint8_t& gray =
        voxmap.gray[static_cast<size_t>(u) + dx * (static_cast<size_t>(v) + dy * static_cast<size_t>(w))];
    if (gray == 0) continue;
    const float strength = static_cast<float>(gray) * e.force_scale;
    gray = static_cast<uint8_t>(gray > e.decay ? gray - e.decay : 0);
    e.force[0] += static_cast<int32_t>(strength * (e.centre[0] - x));
    e.force[1] += static_cast<int32_t>(strength * (e.centre[1] - y));
    e.force[2] += static_cast<int32_t>(strength * (e.centre[2] - z));
    ++e.inside;
    if (inside != nullptr) (*inside)[i] = 1;
  }
  return sums_of(e);
}

}  // namespace ream::bench
