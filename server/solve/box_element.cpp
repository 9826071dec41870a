#include "solve/box_element.hpp"

#include <Eigen/Eigenvalues>
#include <bit>
#include <cmath>

namespace ream::solve {
namespace {

using Strains = Eigen::Matrix<double, 6, 24>;
using Elasticity = Eigen::Matrix<double, 6, 6>;

/// Hooke's law for a modulus of 1: xx, yy, zz, then engineering shears yz, zx, xy.
Elasticity elasticity(double poisson) {
  const double lame = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), shear = 0.5 / (1.0 + poisson);
  Elasticity c = Elasticity::Zero();
  c.topLeftCorner<3, 3>().setConstant(lame);
  for (int i = 0; i < 3; ++i) {
    c(i, i) += 2.0 * shear;
    c(i + 3, i + 3) = shear;
  }
  return c;
}

/// Strains at a point of the element, -1 to 1 along each axis.
Strains strains_at(const Vec3& at, const Vec3& edges_mm) {
  Strains b = Strains::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 factor, slope;
    for (int k = 0; k < 3; ++k) {
      const double sign = (corner >> k & 1) != 0 ? 1.0 : -1.0;
      factor[k] = 0.5 * (1.0 + sign * at[k]);
      slope[k] = sign / edges_mm[k];
    }
    const Vec3 d(slope.x() * factor.y() * factor.z(), factor.x() * slope.y() * factor.z(),
                 factor.x() * factor.y() * slope.z());
    const int dof = 3 * corner;
    for (int k = 0; k < 3; ++k) b(k, dof + k) = d[k];
    b(3, dof + 1) = d.z();
    b(3, dof + 2) = d.y();
    b(4, dof) = d.z();
    b(4, dof + 2) = d.x();
    b(5, dof) = d.y();
    b(5, dof + 1) = d.x();
  }
  return b;
}

BoxElement::Stiffness integrated(const Vec3& edges_mm, double poisson) {
  const Elasticity c = elasticity(poisson);
  const double gauss = 1.0 / std::sqrt(3.0), weight_mm3 = edges_mm.prod() / 8.0;
  BoxElement::Stiffness k = BoxElement::Stiffness::Zero();
  for (int point = 0; point < 8; ++point) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = (point >> axis & 1) != 0 ? gauss : -gauss;
    const Strains b = strains_at(at, edges_mm);
    k += weight_mm3 * b.transpose() * c * b;
  }
  return k;
}

double sign(int mode, int corner) {
  return std::popcount(static_cast<unsigned>(mode & corner)) % 2 == 0 ? 1.0 : -1.0;
}

/// Of component k of mode m, and component l of mode n.
double in_modes(const BoxElement::Stiffness& stiffness, int m, int k, int n, int l) {
  double sum = 0.0;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 8; ++d) sum += sign(m, c) * stiffness(3 * c + k, 3 * d + l) * sign(n, d);
  return sum / 64.0;
}

/// Displacements of an octant's corners, from those of the box.
BoxElement::Stiffness within_octant(int octant) {
  BoxElement::Stiffness from_box = BoxElement::Stiffness::Zero();
  for (int corner = 0; corner < 8; ++corner)
    for (int c = 0; c < 8; ++c) {
      double weight = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double at = 0.5 * ((octant >> axis & 1) + (corner >> axis & 1));
        weight *= (c >> axis & 1) != 0 ? at : 1.0 - at;
      }
      for (int k = 0; k < 3; ++k) from_box(3 * corner + k, 3 * c + k) = weight;
    }
  return from_box;
}

}  // namespace

BoxElement::BoxElement(const Vec3& edges, double poissons_ratio)
    : edges_mm(edges), poisson(poissons_ratio), stiffness(integrated(edges, poissons_ratio)) {
  for (size_t parity = 0; parity < 8; ++parity)
    for (size_t i = 0; i < 9; ++i) {
      const int p = static_cast<int>(parity), k = static_cast<int>(i / 3), l = static_cast<int>(i % 3);
      blocks[parity][i] = in_modes(stiffness, p ^ (1 << k), k, p ^ (1 << l), l);
    }
  diagonal = stiffness.diagonal().head<3>();
}

double BoxElement::greatest_over_diagonal() const {
  const Eigen::Matrix<double, 24, 1> scale = stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Stiffness scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Stiffness>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[23];
}

std::array<float, 256> BoxElement::energy_shares() const {
  const Eigen::SelfAdjointEigenSolver<Stiffness> whole(stiffness);
  // Without the six rigid motions, which have no energy anywhere.
  const Eigen::Matrix<double, 24, 18> strained =
      whole.eigenvectors().rightCols<18>() *
      whole.eigenvalues().tail<18>().cwiseSqrt().cwiseInverse().asDiagonal();
  const Stiffness small = integrated(0.5 * edges_mm, poisson);
  std::array<Eigen::Matrix<double, 18, 18>, 8> of_octant;
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Matrix<double, 24, 18> moved = within_octant(octant) * strained;
    of_octant[static_cast<size_t>(octant)] = moved.transpose() * small * moved;
  }
  std::array<float, 256> shares{};
  for (size_t set = 1; set < 256; ++set) {
    Eigen::Matrix<double, 18, 18> energy = Eigen::Matrix<double, 18, 18>::Zero();
    for (size_t octant = 0; octant < 8; ++octant)
      if ((set >> octant & 1) != 0) energy += of_octant[octant];
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 18, 18>>;
    shares[set] = static_cast<float>(Solver(energy, Eigen::EigenvaluesOnly).eigenvalues()[17]);
  }
  return shares;
}

}  // namespace ream::solve
