#include "bench/baselines/yau.hpp"

#include <cmath>
#include <cstring>
#include <optional>

#include "bench/baselines/kernel_source.hpp"
#include "collide/grid_transform.hpp"

namespace ream::bench {
namespace {

constexpr size_t yau_local_items = 64;

/// Voxels of the cap's box and the bone's box together; nothing when they do not meet.
std::optional<layout::YauExchange> arguments(const Voxmap& voxmap, const ImplicitCap& cap,
                                             const QuantisedPose& grid_from_tool) {
  if (voxmap.bone_box_mm.empty()) return std::nullopt;
  const Aabb voi = cap.box_mm().transformed(dequantised(grid_from_tool)).intersection(voxmap.bone_box_mm);
  if (voi.empty()) return std::nullopt;
  layout::YauExchange e{};
  for (int i = 0; i < 3; ++i) {
    const int low = static_cast<int>(std::floor(voi.min[i] / voxmap.spacing_mm[i]));
    const int high = static_cast<int>(std::ceil(voi.max[i] / voxmap.spacing_mm[i]));
    e.low[i] = std::max(low, 0);
    e.size[i] = std::min(high, voxmap.dims[i]) - e.low[i];
    e.dims[i] = voxmap.dims[i];
    if (e.size[i] <= 0) return std::nullopt;
  }
  const collide::GridAffine affine = collide::tool_from_voxel(grid_from_tool, voxmap.grid());
  std::memcpy(&e.tool_from_voxel, &affine, sizeof affine);
  e.inverse_a2 = static_cast<float>(1.0 / (cap.across_mm * cap.across_mm));
  e.inverse_b2 = static_cast<float>(1.0 / (cap.along_mm * cap.along_mm));
  e.centre_z = static_cast<float>(-cap.along_mm);
  e.plane_z = static_cast<float>(-cap.depth_mm);
  return e;
}

}  // namespace

Aabb ImplicitCap::box_mm() const {
  const double height = 1.0 - std::min(depth_mm / along_mm, 1.0);
  const double radius_mm = across_mm * std::sqrt(1.0 - height * height);
  return {Vec3(-radius_mm, -radius_mm, -depth_mm), Vec3(radius_mm, radius_mm, 0.0)};
}

Yau::Yau(const gpu::Queue& queue, const Voxmap& voxmap, const ImplicitCap& cap)
    : queue_(queue),
      voxmap_(voxmap),
      cap_(cap),
      program_(gpu::Program::from_source(queue, "yau.cl", baseline_source("yau.cl"))),
      kernel_(program_, "cap_contact"),
      gray_(gpu::Buffer::over(queue, std::span(voxmap.gray))),
      exchange_(queue, sizeof(layout::YauExchange)) {
  kernel_.set_all(gray_, exchange_);
}

Yau::Sums Yau::contact(const QuantisedPose& grid_from_tool) {
  std::optional<layout::YauExchange> e = arguments(voxmap_, cap_, grid_from_tool);
  if (!e) return {};
  exchange_.write(queue_, &*e, sizeof *e);
  kernel_.enqueue(queue_, static_cast<size_t>(e->size[0]), yau_local_items,
                  static_cast<size_t>(e->size[1]) * static_cast<size_t>(e->size[2]));
  exchange_.read(queue_, &*e, sizeof *e);
  return {e->collided, e->gray_sixteenths};
}

}  // namespace ream::bench
