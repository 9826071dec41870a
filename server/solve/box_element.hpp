#pragma once
#include <Eigen/Core>
#include <array>

#include "geometry/vec.hpp"

namespace ream::solve {

/// A linear elastic, isotropic element with the shape of a box and eight corners: trilinear displacements,
/// two Gauss points along each axis (C3D8 of CalculiX). Corner c lies at the greater end of axis k
/// where bit k of c is set.
struct BoxElement {
  using Stiffness = Eigen::Matrix<double, 24, 24>;

  Vec3 edges_mm;
  double poisson;

  /// `edges_mm` positive; -1 < poisson < 0.5.
  BoxElement(const Vec3& edges_mm, double poisson);

  /// For a modulus of 1 MPa, N/mm: force on component k of corner c at 3 c + k.
  Stiffness stiffness;
  /// The same in the element's modes, sums and differences over its corners: what is even and odd in the
  /// three axes does not mix, so that eight blocks of 3 x 3 are left. Mode m has the sign (-1)^popcount(m &
  /// c) at corner c. Block p couples component k of mode p ^ (1 << k). Divided by 64, so that
  ///   force = modulus * H blocks H displacement,   H[m][c] the signs.
  std::array<std::array<double, 9>, 8> blocks;
  /// Diagonal of the stiffness; the same at every corner.
  Vec3 diagonal;
  /// Greatest eigenvalue of the stiffness over its diagonal. That of elements put together is at most the
  /// greatest of them, whatever their moduli.
  double greatest_over_diagonal() const;
  /// The greatest share of its energy that the box can have in some of its eight octants, by their bits
  /// (octant c is that at corner c). 1 for all of them.
  std::array<float, 256> energy_shares() const;
};

}  // namespace ream::solve
