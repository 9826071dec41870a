#include "fe/mesh_check.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/error.hpp"
#include "fe/mesh_file_checks.hpp"
#include "fe/number_text.hpp"

namespace ream::fe {
namespace {

/// Neighbours of each corner along x, y, z, each pointing the positive way: (from, to).
constexpr int edges[8][3][2] = {{{0, 1}, {0, 3}, {0, 4}}, {{0, 1}, {1, 2}, {1, 5}}, {{3, 2}, {1, 2}, {2, 6}},
                                {{3, 2}, {0, 3}, {3, 7}}, {{4, 5}, {4, 7}, {0, 4}}, {{4, 5}, {5, 6}, {1, 5}},
                                {{7, 6}, {5, 6}, {2, 6}}, {{7, 6}, {4, 7}, {3, 7}}};

double spanned(const Vec3& a, const Vec3& b, const Vec3& c) { return a.cross(b).dot(c); }

bool is_parallelepiped(const HexCorners& p) {
  const Vec3 x = p[1] - p[0], y = p[3] - p[0], z = p[4] - p[0];
  const double tolerance = 1e-9 * (std::abs(x.x()) + std::abs(y.y()) + std::abs(z.z()));
  const auto near = [&](const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff() <= tolerance; };
  return near(p[2] - p[3], x) && near(p[5] - p[4], x) && near(p[6] - p[7], x) && near(p[7] - p[4], y) &&
         near(p[6] - p[2], z);
}

/// Integral of the Jacobian of the trilinear map; two Gauss points along each axis are exact for it.
double volume_of(const HexCorners& p) {
  constexpr double gauss = 0.5773502691896257;
  double sum = 0.0;
  for (int point = 0; point < 8; ++point) {
    const double at[3] = {(point & 1) != 0 ? gauss : -gauss, (point & 2) != 0 ? gauss : -gauss,
                          (point & 4) != 0 ? gauss : -gauss};
    Vec3 along[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (size_t i = 0; i < 8; ++i) {
      const double sign[3] = {i % 4 == 1 || i % 4 == 2 ? 1.0 : -1.0, i % 4 >= 2 ? 1.0 : -1.0,
                              i >= 4 ? 1.0 : -1.0};
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        along[k] += 0.125 * sign[k] * (1.0 + sign[l] * at[l]) * (1.0 + sign[m] * at[m]) * p[i];
      }
    }
    sum += spanned(along[0], along[1], along[2]);
  }
  return sum;
}

}  // namespace

bool HexSum::add(const HexCorners& p) {
  if (is_parallelepiped(p)) {
    const double volume = spanned(p[1] - p[0], p[3] - p[0], p[4] - p[0]);
    min_mm3_ = std::min(min_mm3_, volume);
    volume_mm3_ += volume;
  } else {
    for (const auto& corner : edges) {
      const auto edge = [&](int k) {
        return p[static_cast<size_t>(corner[k][1])] - p[static_cast<size_t>(corner[k][0])];
      };
      min_mm3_ = std::min(min_mm3_, spanned(edge(0), edge(1), edge(2)));
    }
    volume_mm3_ += volume_of(p);
  }
  if (visit_) visit_(p);
  return min_mm3_ > 0.0;
}

namespace {

/// Of an element's edge, for coordinates rounded when written.
constexpr double place_tolerance = 1e-2;
constexpr double volume_tolerance = 1e-5;

/// Ticks voxels off as elements are found in their places.
class VoxelTicks {
 public:
  explicit VoxelTicks(const ElementModel& model) : model_(model), found_(model.mask.dims()) {}

  void operator()(const HexCorners& corners) {
    const Vec3 spacing = model_.spacing_mm;
    const Vec3 at = ((corners[0] - model_.origin_mm).array() / spacing.array()).matrix();
    const Vec3i voxel = (at.array() + 0.5).floor().cast<int>().matrix();
    const Vec3 size = ((corners[6] - corners[0]).array() / spacing.array()).matrix();
    const bool in_place = (at - voxel.cast<double>()).cwiseAbs().maxCoeff() < place_tolerance &&
                          (size - Vec3::Ones()).cwiseAbs().maxCoeff() < place_tolerance;
    const bool inside = (voxel.array() >= 0).all() && (voxel.array() < model_.mask.dims().array()).all();
    if (in_place && inside && model_.mask.at(voxel.x(), voxel.y(), voxel.z()) &&
        !found_.at(voxel.x(), voxel.y(), voxel.z()))
      found_.set(voxel.x(), voxel.y(), voxel.z());
    else
      ++wrong_;
  }
  uint64_t wrong() const { return wrong_; }

 private:
  const ElementModel& model_;
  VoxelMask found_;
  uint64_t wrong_ = 0;
};

}  // namespace

MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const MemoryBudget& budget,
                          const Progress& progress, const ElementVisitor& visit) {
  return format == MeshFormat::inp ? check_inp(path, budget, progress, visit)
                                   : check_vtu(path, budget, progress, visit);
}

MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const NumberedMesh& mesh,
                          MemoryBudget& budget, const Progress& progress) {
  const uint64_t bytes = mesh.model.mask.bytes();
  budget.take(bytes, "checking the mesh");
  VoxelTicks ticks(mesh.model);
  const MeshFacts facts = check_mesh_file(path, format, budget, progress, std::ref(ticks));
  budget.give_back(bytes);
  const auto expect = [&](const char* what, double found, double expected, double tolerance) {
    if (std::abs(found - expected) > tolerance)
      throw Error(ErrorKind::io, path.string() + " does not hold what was written: " + what + " " +
                                     real_text(found) + " instead of " + real_text(expected));
  };
  expect("nodes", static_cast<double>(facts.nodes), static_cast<double>(mesh.numbering.nodes()), 0.0);
  expect("elements", static_cast<double>(facts.elements), static_cast<double>(mesh.numbering.elements()),
         0.0);
  expect("elements that are no voxel", static_cast<double>(ticks.wrong()), 0.0, 0.0);
  expect("materials", static_cast<double>(facts.materials), static_cast<double>(mesh.materials.list.size()),
         0.0);
  const double volume = mesh.model.spacing_mm.prod() * static_cast<double>(mesh.numbering.elements());
  expect("volume", facts.volume_mm3, volume, volume_tolerance * volume);
  return facts;
}

}  // namespace ream::fe
