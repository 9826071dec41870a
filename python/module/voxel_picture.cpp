#include "module/voxel_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "render/camera.hpp"
#include "surface/removed_share.hpp"

namespace ream::python {
namespace {

using voxel::brick_edge;
using voxel::VoxelGrid;

constexpr double surface_coverage = 127.5;
/// Of a voxel's least edge: bone thinner than this along a ray may be missed.
constexpr double sample_share = 0.5;
constexpr int refinements = 6;
constexpr float nothing_mm = std::numeric_limits<float>::infinity();

/// Rays of a camera in the grid's frame, as long as they are deep: a point of one at `depth` is so many mm
/// before the camera's plane.
class Rays {
 public:
  Rays(const Pose& grid_from_world, const render::Camera& camera, int width, int height)
      : eye_(grid_from_world.point(camera.eye_mm)), width_(width), height_(height) {
    const Eigen::Matrix3d rows = render::camera_from_world(camera).topLeftCorner<3, 3>().cast<double>();
    axes_ = grid_from_world.rotation * rows.transpose();
    pixel_ = 2.0 * std::tan(0.5 * camera.vertical_field_of_view_rad) / height;
  }

  const Vec3& eye() const { return eye_; }
  int width() const { return width_; }
  int height() const { return height_; }
  Vec3 through(int column, int row) const {
    return axes_ * Vec3(pixel_ * (column + 0.5 - 0.5 * width_), pixel_ * (0.5 * height_ - row - 0.5), -1.0);
  }
  /// Column and row, and depth, of a point.
  Vec3 pixel_of(const Vec3& point) const {
    const Vec3 seen = axes_.transpose() * (point - eye_);
    const double depth = -seen.z();
    return {seen.x() / (depth * pixel_) + 0.5 * width_ - 0.5,
            0.5 * height_ - 0.5 - seen.y() / (depth * pixel_), depth};
  }
  /// A direction's part to the right, upwards and towards the eye.
  Vec3 seen(const Vec3& direction) const { return axes_.transpose() * direction; }

 private:
  Vec3 eye_;
  Mat3 axes_;  ///< right, up, back
  double pixel_ = 0.0;
  int width_, height_;
};

/// Bricks in which, or beside which, there is bone: elsewhere coverage is nothing.
std::vector<uint8_t> bricks_with_bone(const voxel::BoneModel& bone) {
  const VoxelGrid& grid = bone.grid;
  const Vec3i dims = grid.brick_dims();
  std::vector<uint8_t> near(grid.brick_count(), 0);
  for (uint32_t brick = 0; brick < grid.brick_count(); ++brick) {
    const uint8_t* voxels = bone.coverage.data() + grid.brick_base(brick);
    if (std::all_of(voxels, voxels + voxel::brick_voxels, [](uint8_t c) { return c == 0; })) continue;
    const Vec3i at = grid.brick_coordinates(brick);
    const Vec3i low = (at.array() - 1).max(0), high = (at.array() + 1).min(dims.array() - 1);
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) near[grid.brick_index({x, y, z})] = 1;
  }
  return near;
}

class BoneRays {
 public:
  explicit BoneRays(const voxel::BoneModel& bone)
      : bone_(bone),
        near_(bricks_with_bone(bone)),
        brick_mm_(bone.grid.spacing_mm * brick_edge),
        step_mm_(sample_share * bone.grid.min_spacing_mm()) {}

  /// How deep a ray first meets bone; empty where it does not before `limit`.
  std::optional<double> first_hit(const Vec3& eye, const Vec3& ray, double limit) const {
    auto [from, to] = within_grid(eye, ray);
    to = std::min(to, limit);
    const double step = step_mm_ / ray.norm();
    double outside = from;
    for (double depth = from; depth < to;) {
      const Vec3 point = eye + depth * ray;
      if (const Vec3i brick = brick_of(point); near_[bone_.grid.brick_index(brick)] == 0) {
        outside = depth;
        depth = exit_of(brick, eye, ray, depth) + 1e-3 * step;
        continue;
      }
      if (voxel::coverage_at(bone_, point) >= surface_coverage)
        return depth > outside ? refined(eye, ray, outside, depth) : depth;
      outside = depth;
      depth += step;
    }
    return std::nullopt;
  }

  /// Outwards, of unit length.
  Vec3 normal_at(const Vec3& point) const {
    Vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step = Vec3::Zero();
      step[axis] = 0.5 * bone_.grid.spacing_mm[axis];
      slope[axis] = (voxel::coverage_at(bone_, point - step) - voxel::coverage_at(bone_, point + step)) /
                    bone_.grid.spacing_mm[axis];
    }
    return slope.norm() > 0.0 ? Vec3(slope.normalized()) : Vec3::UnitZ();
  }

  /// Of the fullest voxel about a point of the surface.
  voxel::BoneClass class_at(const Vec3& point, const std::array<voxel::BoneClass, 256>& classes) const {
    const Vec3i middle = bone_.grid.voxel_at(point);
    size_t fullest = 0;
    int most = -1;
    for (int i = 0; i < 27; ++i) {
      const Vec3i at = middle + Vec3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (!bone_.grid.contains(at)) continue;
      const size_t index = bone_.grid.index(at);
      // Of equals the nearest, which is the middle one or beside it.
      const int distance = std::abs(i % 3 - 1) + std::abs(i / 3 % 3 - 1) + std::abs(i / 9 - 1);
      const int value = 4 * bone_.coverage[index] - distance;
      if (bone_.coverage[index] > 0 && value > most) {
        most = value;
        fullest = index;
      }
    }
    return classes[bone_.density[fullest]];
  }

 private:
  std::pair<double, double> within_grid(const Vec3& eye, const Vec3& ray) const {
    double from = 0.0, to = std::numeric_limits<double>::infinity();
    const Vec3 size = bone_.grid.bounds_mm().max;
    for (int axis = 0; axis < 3; ++axis) {
      if (ray[axis] == 0.0) {
        if (eye[axis] < 0.0 || eye[axis] > size[axis]) return {0.0, 0.0};
        continue;
      }
      const double a = -eye[axis] / ray[axis], b = (size[axis] - eye[axis]) / ray[axis];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return {from, to};
  }

  Vec3i brick_of(const Vec3& point) const {
    const Vec3i brick = (point.array() / brick_mm_.array()).floor().cast<int>();
    return brick.cwiseMax(0).cwiseMin(Vec3i(bone_.grid.brick_dims().array() - 1));
  }

  double exit_of(const Vec3i& brick, const Vec3& eye, const Vec3& ray, double depth) const {
    double exit = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (ray[axis] == 0.0) continue;
      const double face = (brick[axis] + (ray[axis] > 0.0 ? 1 : 0)) * brick_mm_[axis];
      exit = std::min(exit, (face - eye[axis]) / ray[axis]);
    }
    return std::max(exit, depth);
  }

  double refined(const Vec3& eye, const Vec3& ray, double outside, double inside) const {
    for (int i = 0; i < refinements; ++i) {
      const double middle = 0.5 * (outside + inside);
      (voxel::coverage_at(bone_, Vec3(eye + middle * ray)) >= surface_coverage ? inside : outside) = middle;
    }
    return inside;
  }

  const voxel::BoneModel& bone_;
  const std::vector<uint8_t> near_;
  const Vec3 brick_mm_;
  const double step_mm_;
};

// Linear RGB.
const Vec3 cancellous_colour(0.87, 0.72, 0.56), cortical_colour(0.91, 0.86, 0.76),
    cartilage_colour(0.78, 0.87, 0.90), reamer_colour(0.50, 0.54, 0.60);

/// Lit by a lamp above the left shoulder, the eye's own, and from all around. The root stands for sRGB: it is
/// the same on every machine.
void paint(VoxelPicture& picture, size_t pixel, const Vec3& colour, const Vec3& seen_normal) {
  static const Vec3 lamp = Vec3(-0.4, 0.5, 0.77).normalized();
  const double light = 0.22 + 0.63 * std::max(0.0, seen_normal.dot(lamp)) + 0.15 * std::abs(seen_normal.z());
  for (int i = 0; i < 3; ++i)
    picture.rgb[3 * pixel + static_cast<size_t>(i)] =
        static_cast<uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(light * colour[i], 0.0, 1.0))));
}

void set(VoxelPicture& picture, size_t pixel, double depth, PixelLabel label) {
  picture.depth_mm[pixel] = static_cast<float>(depth);
  picture.labels[pixel] = static_cast<uint8_t>(label);
}

/// A triangle in pixels: x and y, and depth as z.
struct SeenTriangle {
  Vec3 a, b, c;
  Vec3 normal;

  /// Twice the area to the left of a to b, of p.
  static double side(const Vec3& a, const Vec3& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  }
  /// Depth at a pixel's middle; empty outside. One over the depth is even in a picture.
  std::optional<double> depth_at(double x, double y) const {
    const double all = side(a, b, c.x(), c.y());
    if (all == 0.0) return std::nullopt;
    const double u = side(b, c, x, y) / all, v = side(c, a, x, y) / all, w = 1.0 - u - v;
    if (u < 0.0 || v < 0.0 || w < 0.0) return std::nullopt;
    return 1.0 / (u / a.z() + v / b.z() + w / c.z());
  }
};

void draw_triangle(VoxelPicture& picture, const SeenTriangle& triangle) {
  const auto& [a, b, c, normal] = triangle;
  const auto bound = [](double least, double most, int edge) {
    return std::pair(static_cast<int>(std::clamp(std::ceil(least), 0.0, static_cast<double>(edge))),
                     static_cast<int>(std::clamp(std::floor(most), -1.0, static_cast<double>(edge - 1))));
  };
  const auto [left, right] =
      bound(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), picture.width);
  const auto [top, bottom] =
      bound(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), picture.height);
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const auto depth = triangle.depth_at(column, row);
      const size_t pixel =
          static_cast<size_t>(row) * static_cast<size_t>(picture.width) + static_cast<size_t>(column);
      if (!depth || *depth >= picture.depth_mm[pixel]) continue;
      set(picture, pixel, *depth, PixelLabel::reamer);
      paint(picture, pixel, reamer_colour, normal);
    }
}

void draw_reamer(VoxelPicture& picture, const VoxelScene& scene, const Rays& rays) {
  constexpr double nearest_mm = 0.1;
  for (const auto& corners : scene.reamer->triangles) {
    Vec3 at[3], pixel[3];
    for (size_t i = 0; i < 3; ++i) {
      at[i] = scene.grid_from_reamer.point(scene.reamer->vertices_mm[corners[i]].cast<double>());
      pixel[i] = rays.pixel_of(at[i]);
    }
    if (std::min({pixel[0].z(), pixel[1].z(), pixel[2].z()}) < nearest_mm) continue;
    Vec3 normal = rays.seen((at[1] - at[0]).cross(at[2] - at[0]));
    if (!(normal.norm() > 0.0)) continue;
    normal.normalize();
    if (normal.z() < 0.0) normal = -normal;
    draw_triangle(picture, {pixel[0], pixel[1], pixel[2], normal});
  }
}

void draw_bone(VoxelPicture& picture, const VoxelScene& scene, const Rays& rays) {
  const BoneRays bone(scene.bone);
  std::vector<size_t> hits;
  std::vector<Vec3f> points;
  for (int row = 0; row < rays.height(); ++row)
    for (int column = 0; column < rays.width(); ++column) {
      const size_t pixel =
          static_cast<size_t>(row) * static_cast<size_t>(rays.width()) + static_cast<size_t>(column);
      const Vec3 ray = rays.through(column, row);
      const auto depth = bone.first_hit(rays.eye(), ray, picture.depth_mm[pixel]);
      if (!depth) continue;
      picture.depth_mm[pixel] = static_cast<float>(*depth);
      hits.push_back(pixel);
      points.push_back((rays.eye() + *depth * ray).cast<float>());
    }
  const std::vector<float> removed =
      surface::removed_shares(points, scene.bone.grid, scene.coverage_before, scene.bone.coverage.data());
  const auto classes = voxel::class_table(scene.bone.cortical_threshold_g_cc);
  const Vec3 colours[] = {cancellous_colour, cortical_colour, cartilage_colour};
  for (size_t i = 0; i < hits.size(); ++i) {
    const Vec3 point = points[i].cast<double>();
    const auto kind = static_cast<size_t>(bone.class_at(point, classes));
    const bool cut = removed[i] >= surface::cut_share;
    picture.labels[hits[i]] = static_cast<uint8_t>(static_cast<size_t>(PixelLabel::cancellous) + kind);
    picture.cut[hits[i]] = cut ? 1 : 0;
    paint(picture, hits[i], cut ? Vec3(render::cut_bone_colour.cast<double>()) : colours[kind],
          rays.seen(bone.normal_at(point)));
  }
}

void require_sound(const render::Camera& camera, int width, int height) {
  if (width < 1 || height < 1 || width > max_picture_edge_pixels || height > max_picture_edge_pixels)
    throw Error(ErrorKind::invalid_input,
                "a picture has 1 to " + std::to_string(max_picture_edge_pixels) + " pixels along each edge");
  if (!camera.eye_mm.allFinite() || !camera.up.allFinite())
    throw Error(ErrorKind::invalid_input, "the camera's place is not finite");
  if (!(camera.vertical_field_of_view_rad > 0.0 && camera.vertical_field_of_view_rad < std::numbers::pi))
    throw Error(ErrorKind::invalid_input, "the camera's field of view must be between 0 and pi");
}

}  // namespace

VoxelPicture draw_voxels(const VoxelScene& scene, const Pose& grid_from_world, const render::Camera& camera,
                         int width, int height) {
  require_sound(camera, width, height);
  const Rays rays(grid_from_world, camera, width, height);
  const auto pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  VoxelPicture picture{width, height, {}, {}, {}, {}};
  picture.rgb.assign(3 * pixels, 255);
  picture.depth_mm.assign(pixels, nothing_mm);
  picture.labels.assign(pixels, 0);
  picture.cut.assign(pixels, 0);
  if (scene.reamer != nullptr) draw_reamer(picture, scene, rays);
  draw_bone(picture, scene, rays);
  return picture;
}

}  // namespace ream::python
