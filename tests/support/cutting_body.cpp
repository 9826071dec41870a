#include "support/cutting_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace ream::test {
namespace {

constexpr double cell_mm = 0.02;  // of the distance table
constexpr double bin_mm = 0.02;   // of the STL's envelope
constexpr double sample_mm = 0.015;
constexpr double rim_roundness_mm = 0.002;

/// Squared distance.
double to_segment2(const MeridianPoint& a, const MeridianPoint& b, double radius_mm, double z_mm) {
  const double dr = b.radius_mm - a.radius_mm, dz = b.z_mm - a.z_mm;
  const double pr = radius_mm - a.radius_mm, pz = z_mm - a.z_mm;
  const double length2 = dr * dr + dz * dz;
  const double along = length2 > 0.0 ? std::clamp((pr * dr + pz * dz) / length2, 0.0, 1.0) : 0.0;
  const double er = pr - along * dr, ez = pz - along * dz;
  return er * er + ez * ez;
}

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> read_binary_stl(const std::filesystem::path& path, const Pose& tool_from_mesh) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 84> head{};
  file.read(head.data(), head.size());
  uint32_t count = 0;
  std::memcpy(&count, head.data() + 80, sizeof count);
  std::vector<Triangle> triangles(count);
  for (Triangle& t : triangles) {
    std::array<char, 50> record{};
    if (!file.read(record.data(), record.size())) throw std::runtime_error("cannot read " + path.string());
    for (size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), record.data() + 12 + 12 * corner, sizeof p);
      t[corner] = tool_from_mesh.point(Vec3(p[0], p[1], p[2]));
    }
  }
  return triangles;
}

/// Calls visit(point) for points all over the triangle, at most sample_mm apart.
template <typename Visit>
void sample(const Triangle& t, const Visit& visit) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  const int n = std::max(1, static_cast<int>(std::ceil(longest / sample_mm)));
  for (int i = 0; i <= n; ++i)
    for (int k = 0; i + k <= n; ++k)
      visit(Vec3(t[0] + u * (static_cast<double>(i) / n) + v * (static_cast<double>(k) / n)));
}

}  // namespace

CuttingBody::CuttingBody(std::vector<MeridianPoint> front, double back_mm) : front_(std::move(front)) {
  double lowest = front_[0].z_mm, highest = lowest;
  for (const MeridianPoint& p : front_) {
    lowest = std::min(lowest, p.z_mm);
    highest = std::max(highest, p.z_mm);
  }
  floor_z_mm_ = lowest - back_mm;
  top_z_mm_ = highest;
  radius_count_ = static_cast<int>((rim_radius_mm() + reach_mm) / cell_mm) + 3;
  z_count_ = static_cast<int>((top_z_mm_ - floor_z_mm_ + 2.0 * reach_mm) / cell_mm) + 3;
  for (int k = 0; k < z_count_; ++k)
    for (int i = 0; i < radius_count_; ++i)
      table_mm_.push_back(
          static_cast<float>(exact_distance_mm(i * cell_mm, floor_z_mm_ - reach_mm + k * cell_mm)));
}

double CuttingBody::exact_distance_mm(double radius_mm, double z_mm) const {
  const double rim = rim_radius_mm();
  double nearest2 = reach_mm * reach_mm;
  nearest2 = std::min(nearest2, to_segment2({0.0, floor_z_mm_}, {rim, floor_z_mm_}, radius_mm, z_mm));
  nearest2 = std::min(nearest2, to_segment2({rim, floor_z_mm_}, front_.back(), radius_mm, z_mm));
  const auto by_radius = [](const MeridianPoint& p, double r) { return p.radius_mm < r; };
  const auto near_end = std::lower_bound(front_.begin(), front_.end(), radius_mm + reach_mm, by_radius);
  auto b = std::lower_bound(front_.begin() + 1, front_.end(), radius_mm - reach_mm, by_radius);
  for (; b != front_.end(); ++b) {
    nearest2 = std::min(nearest2, to_segment2(*(b - 1), *b, radius_mm, z_mm));
    if (b == near_end) break;
  }
  bool inside = radius_mm <= rim && z_mm >= floor_z_mm_;
  if (inside) {
    const auto after =
        std::max(std::lower_bound(front_.begin(), front_.end(), radius_mm, by_radius), front_.begin() + 1);
    const MeridianPoint &low = *(after - 1), &high = *after;
    const double width = high.radius_mm - low.radius_mm;
    const double share = width > 0.0 ? (radius_mm - low.radius_mm) / width : 1.0;
    inside = z_mm <= low.z_mm + share * (high.z_mm - low.z_mm);
  }
  return inside ? -std::sqrt(nearest2) : std::sqrt(nearest2);
}

double CuttingBody::distance_mm(double radius_mm, double z_mm) const {
  const double fr = radius_mm / cell_mm, fz = (z_mm - floor_z_mm_ + reach_mm) / cell_mm;
  const int i = static_cast<int>(fr), k = static_cast<int>(fz);
  if (!(fz >= 0.0) || k + 1 >= z_count_ || !(fr < radius_count_ - 1)) return reach_mm;
  const float* low = table_mm_.data() + static_cast<size_t>(k) * static_cast<size_t>(radius_count_) + i;
  const float* high = low + radius_count_;
  const double tr = fr - i, tz = fz - k;
  return (1.0 - tz) * ((1.0 - tr) * low[0] + tr * low[1]) + tz * ((1.0 - tr) * high[0] + tr * high[1]);
}

double CuttingBody::size_mm() const {
  return std::hypot(rim_radius_mm(), std::max(std::abs(floor_z_mm_), std::abs(top_z_mm_)));
}

std::vector<MeridianPoint> sphere_meridian(double radius_mm, double outer_radius_mm) {
  std::vector<MeridianPoint> front;
  constexpr int steps = 800;
  for (int i = 0; i <= steps; ++i) {
    const double r = outer_radius_mm * i / steps;
    front.push_back({r, std::sqrt(radius_mm * radius_mm - r * r) - radius_mm});
  }
  return front;
}

std::vector<MeridianPoint> ellipse_meridian(double a_mm, double b_mm) {
  std::vector<MeridianPoint> front;
  constexpr int steps = 800;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 0.5 * 3.14159265358979323846 * i / steps;
    front.push_back({a_mm * std::sin(angle), b_mm * std::cos(angle) - b_mm});
  }
  return front;
}

std::vector<MeridianPoint> stl_meridian(const std::filesystem::path& stl, const Pose& tool_from_mesh,
                                        double nipple_radius_mm) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  const std::vector<Triangle> triangles = read_binary_stl(stl, tool_from_mesh);
  std::vector<double> highest;
  double rim = 0.0;
  for (const Triangle& t : triangles)
    sample(t, [&](const Vec3& p) {
      const double r = std::hypot(p.x(), p.y());
      const auto bin = static_cast<size_t>(r / bin_mm);
      if (bin >= highest.size()) highest.resize(bin + 1, none);
      highest[bin] = std::max(highest[bin], p.z());
      rim = std::max(rim, r);
    });
  std::vector<MeridianPoint> front;
  for (size_t bin = 0; bin < highest.size(); ++bin) {
    const double r = (static_cast<double>(bin) + 0.5) * bin_mm;
    if (r < nipple_radius_mm || r > rim - bin_mm || highest[bin] == none) continue;
    if (front.empty()) front.push_back({0.0, highest[bin]});
    front.push_back({r, highest[bin]});
  }
  // The rim's corner is a ring of the mesh's own corners; within its bin the surface may fall steeply.
  double rim_z = none;
  for (const Triangle& t : triangles)
    for (const Vec3& p : t)
      if (std::hypot(p.x(), p.y()) > rim - rim_roundness_mm) rim_z = std::max(rim_z, p.z());
  front.push_back({rim, rim_z});
  return front;
}

}  // namespace ream::test
