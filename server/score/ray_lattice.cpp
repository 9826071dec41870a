#include "score/ray_lattice.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ream::score {
namespace {

/// What of `direction` lies across `along`; empty vector where nearly nothing does.
Vec3 part_across(const Vec3& direction, const Vec3& along) {
  const Vec3 part = direction - direction.dot(along) * along;
  return part.norm() > 1e-3 ? Vec3(part.normalized()) : Vec3(Vec3::Zero());
}

}  // namespace

RayLattice::RayLattice(const Vec3& origin_mm, const Vec3& along, case_::Side side, double reach_mm,
                       double spacing_mm)
    : origin_mm_(origin_mm), along_(along), reach_mm_(reach_mm), spacing_mm_(spacing_mm) {
  up_ = part_across(Vec3::UnitZ(), along);
  if (up_.isZero()) up_ = part_across(Vec3::UnitY(), along);
  across_ = side == case_::Side::right ? Vec3(along_.cross(up_)) : Vec3(up_.cross(along_));
  half_ = static_cast<int>(std::floor(reach_mm / spacing_mm));
  const int width = 2 * half_ + 1;
  ray_at_.assign(static_cast<size_t>(width) * static_cast<size_t>(width), -1);
  for (int row = -half_; row <= half_; ++row)
    for (int column = -half_; column <= half_; ++column) {
      const double x = column * spacing_mm, y = row * spacing_mm;
      if (x * x + y * y > reach_mm * reach_mm) continue;
      ray_at_[static_cast<size_t>((row + half_) * width + column + half_)] = static_cast<int>(x_mm_.size());
      x_mm_.push_back(x);
      y_mm_.push_back(y);
      column_.push_back(column);
      row_.push_back(row);
    }
}

Vec3 RayLattice::world_direction(const Vec3& d) const {
  return d.x() * across_ + d.y() * up_ + d.z() * along_;
}

Vec3 RayLattice::lattice_direction(const Vec3& d) const {
  return {d.dot(across_), d.dot(up_), d.dot(along_)};
}

Vec3 RayLattice::world(const Vec3& p) const { return origin_mm_ + world_direction(p); }

Vec3 RayLattice::in_lattice(const Vec3& world_mm) const { return lattice_direction(world_mm - origin_mm_); }

int RayLattice::at(int column, int row) const {
  if (std::abs(column) > half_ || std::abs(row) > half_) return -1;
  return ray_at_[static_cast<size_t>((row + half_) * (2 * half_ + 1) + column + half_)];
}

int RayLattice::neighbour(size_t ray, int columns, int rows) const {
  return at(column_[ray] + columns, row_[ray] + rows);
}

int RayLattice::nearest(double x_mm, double y_mm) const {
  if (!(std::abs(x_mm) <= reach_mm_ && std::abs(y_mm) <= reach_mm_)) return -1;
  return at(static_cast<int>(std::lround(x_mm / spacing_mm_)),
            static_cast<int>(std::lround(y_mm / spacing_mm_)));
}

double RayLattice::between(const std::vector<double>& values, double x_mm, double y_mm) const {
  if (!(std::abs(x_mm) <= reach_mm_ && std::abs(y_mm) <= reach_mm_)) return no_surface_mm;
  const double u = x_mm / spacing_mm_, v = y_mm / spacing_mm_;
  const double column = std::floor(u), row = std::floor(v), s = u - column, t = v - row;
  double sum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const double weight = ((corner & 1) ? s : 1.0 - s) * ((corner & 2) ? t : 1.0 - t);
    if (weight == 0.0) continue;
    const int ray = at(static_cast<int>(column) + (corner & 1), static_cast<int>(row) + (corner >> 1));
    if (ray < 0 || values[static_cast<size_t>(ray)] == no_surface_mm) return no_surface_mm;
    sum += weight * values[static_cast<size_t>(ray)];
  }
  return sum;
}

std::vector<double> RayLattice::smoothed(const std::vector<double>& values, double radius_mm,
                                         double steepest) const {
  struct Beside {
    int columns, rows;
    double difference;
  };
  std::vector<Beside> besides;
  const int most = static_cast<int>(radius_mm / spacing_mm_);
  for (int rows = -most; rows <= most; ++rows)
    for (int columns = -most; columns <= most; ++columns) {
      const double away_mm = std::hypot(rows, columns) * spacing_mm_;
      if (away_mm <= radius_mm) besides.push_back({columns, rows, steepest * away_mm});
    }
  std::vector<double> means(values);
  for (size_t ray = 0; ray < size(); ++ray) {
    if (values[ray] == no_surface_mm) continue;
    double sum = 0.0;
    int count = 0;
    for (const Beside& b : besides) {
      const int found = neighbour(ray, b.columns, b.rows);
      if (found < 0) continue;
      const double value = values[static_cast<size_t>(found)];
      if (!(std::abs(value - values[ray]) <= b.difference)) continue;
      sum += value;
      ++count;
    }
    means[ray] = sum / count;
  }
  return means;
}

RayLattice RayLattice::thinned(int stride, std::vector<size_t>& kept) const {
  RayLattice thin(*this);
  thin.spacing_mm_ = spacing_mm_ * stride;
  thin.half_ = half_ / stride;
  thin.ray_at_.assign(static_cast<size_t>(2 * thin.half_ + 1) * static_cast<size_t>(2 * thin.half_ + 1), -1);
  thin.column_.clear(), thin.row_.clear(), thin.x_mm_.clear(), thin.y_mm_.clear();
  kept.clear();
  for (size_t ray = 0; ray < size(); ++ray) {
    if (column_[ray] % stride != 0 || row_[ray] % stride != 0) continue;
    const int column = column_[ray] / stride, row = row_[ray] / stride;
    thin.ray_at_[static_cast<size_t>((row + thin.half_) * (2 * thin.half_ + 1) + column + thin.half_)] =
        static_cast<int>(kept.size());
    thin.column_.push_back(column);
    thin.row_.push_back(row);
    thin.x_mm_.push_back(x_mm_[ray]);
    thin.y_mm_.push_back(y_mm_[ray]);
    kept.push_back(ray);
  }
  return thin;
}

}  // namespace ream::score
