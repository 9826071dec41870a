#include "bench/baselines/zheng.hpp"

#include <bit>
#include <cstring>

#include "bench/baselines/kernel_source.hpp"
#include "collide/grid_transform.hpp"

namespace ream::bench {
namespace {

constexpr size_t zheng_local_items = 64;
constexpr size_t reduction_items = 256;
constexpr float unscaled_force = 1.0f;

gpu::Buffer points_of(const gpu::Queue& queue, const MortonShell& shell) {
  std::vector<float> points;
  points.reserve(3 * shell.codes.size());
  for (const uint32_t code : shell.codes) {
    const Vec3f p = shell.point_mm(code);
    points.insert(points.end(), {p.x(), p.y(), p.z()});
  }
  return gpu::Buffer::copy_of(queue, std::span<const float>(points));
}

/// Converted slice by slice, so that no second copy of the whole grid exists.
gpu::Buffer gray_of(const gpu::Queue& queue, const Voxmap& voxmap) {
  gpu::Buffer buffer(queue, voxmap.gray.size() * sizeof(float));
  const size_t slice = static_cast<size_t>(voxmap.dims.x()) * static_cast<size_t>(voxmap.dims.y());
  std::vector<float> values(slice);
  for (size_t first = 0; first < voxmap.gray.size(); first += slice) {
    for (size_t i = 0; i < slice; ++i) values[i] = static_cast<float>(voxmap.gray[first + i]);
    buffer.write(queue, values.data(), slice * sizeof(float), first * sizeof(float));
  }
  return buffer;
}

size_t reduced(size_t count) { return (count + 2 * reduction_items - 1) / (2 * reduction_items); }

}  // namespace

Zheng::Zheng(const gpu::Queue& queue, const Voxmap& voxmap, const MortonShell& shell)
    : queue_(queue),
      grid_(voxmap.grid()),
      point_count_(shell.codes.size()),
      program_(gpu::Program::from_source(queue, "zheng.cl", baseline_source("zheng.cl"))),
      find_(program_, "find_voxels"),
      reduce_(program_, "reduce"),
      points_(points_of(queue, shell)),
      gray_(gray_of(queue, voxmap)),
      collided_(queue, voxmap.gray.size()),
      argument_buffer_(queue, sizeof(layout::ZhengArguments)),
      forces_(queue, point_count_ * sizeof(Force)),
      partial_{gpu::Buffer(queue, reduced(point_count_) * sizeof(Force)),
               gpu::Buffer(queue, reduced(reduced(point_count_)) * sizeof(Force))} {
  collided_.fill(queue, 0);
  const Vec3 centre = shell.box_mm.centre();
  for (int i = 0; i < 3; ++i) {
    arguments_.centre[i] = static_cast<float>(centre[i]);
    arguments_.dims[i] = voxmap.dims[i];
  }
  arguments_.force_scale = unscaled_force / (255.0f * static_cast<float>(shell.box_mm.half_size().norm()));
  arguments_.root_edge = static_cast<int>(std::bit_ceil(static_cast<unsigned>(voxmap.dims.maxCoeff())));
  arguments_.points = static_cast<uint32_t>(point_count_);
  find_.set_all(points_, gray_, collided_, argument_buffer_, forces_);
}

Zheng::Sums Zheng::contact(const QuantisedPose& grid_from_tool, bool clear_flags) {
  const collide::GridAffine affine = collide::voxel_from_tool(grid_from_tool, grid_);
  std::memcpy(&arguments_.voxel_from_tool, &affine, sizeof affine);
  argument_buffer_.write(queue_, &arguments_, sizeof arguments_);
  if (clear_flags) collided_.fill(queue_, 0);
  find_.enqueue(queue_, point_count_, zheng_local_items);

  size_t count = point_count_, turn = 0;
  const gpu::Buffer* from = &forces_;
  while (count > 1 || turn == 0) {
    const gpu::Buffer& to = partial_[turn % 2];
    reduce_.set_all(*from, static_cast<uint32_t>(count), to);
    reduce_.enqueue(queue_, reduced(count) * reduction_items, reduction_items);
    count = reduced(count);
    from = &to;
    ++turn;
  }
  Force total{};
  from->read(queue_, total.data(), sizeof total);
  return {{total[0], total[1], total[2]}, static_cast<int64_t>(total[3])};
}

std::vector<uint8_t> Zheng::inside() const {
  std::vector<Force> forces(point_count_);
  forces_.read(queue_, forces.data(), forces.size() * sizeof(Force));
  std::vector<uint8_t> result(point_count_);
  for (size_t i = 0; i < point_count_; ++i) result[i] = forces[i][3] > 0.0f;
  return result;
}

int64_t Zheng::collided_voxels() const {
  std::vector<uint8_t> flags(grid_.voxel_count());
  collided_.read(queue_, flags.data(), flags.size());
  int64_t count = 0;
  for (const uint8_t flag : flags) count += flag;
  return count;
}

}  // namespace ream::bench
