#pragma once

// Vectors are only passed between functions that become one.
#pragma GCC diagnostic ignored "-Wpsabi"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// a*b - c*d as if rounded once, for values whose products do not overflow: Dekker's exact products.
template <class Real>
__attribute__((always_inline)) inline Real difference_of_products(const Real& a, const Real& b, const Real& c,
                                                                  const Real& d) {
  struct Product {
    Real value, error;
  };
  const auto exact = [](const Real& p, const Real& q) {
    constexpr double splitter = 134217729.0;  // 2^27 + 1
    const Real sp = splitter * p, sq = splitter * q;
    const Real ph = sp - (sp - p), qh = sq - (sq - q);
    const Real pl = p - ph, ql = q - qh;
    const Real value = p * q;
    return Product{value, ((ph * qh - value) + ph * ql + pl * qh) + pl * ql};
  };
  const Product p = exact(a, b), q = exact(c, d);
  return (p.value - q.value) + (p.error - q.error);
}

}  // namespace ream::voxelizer
