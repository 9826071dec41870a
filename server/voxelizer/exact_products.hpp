#pragma once

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// a*b - c*d as if rounded once, for values whose products do not overflow: Dekker's exact products.
inline double difference_of_products(double a, double b, double c, double d) {
  struct Product {
    double value, error;
  };
  const auto exact = [](double p, double q) {
    constexpr double splitter = 134217729.0;  // 2^27 + 1
    const double sp = splitter * p, sq = splitter * q;
    const double ph = sp - (sp - p), qh = sq - (sq - q);
    const double pl = p - ph, ql = q - qh;
    const double value = p * q;
    return Product{value, ((ph * qh - value) + ph * ql + pl * qh) + pl * ql};
  };
  const Product p = exact(a, b), q = exact(c, d);
  return (p.value - q.value) + (p.error - q.error);
}

}  // namespace ream::voxelizer
