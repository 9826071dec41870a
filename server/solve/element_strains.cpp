#include "solve/element_strains.hpp"

#include <algorithm>
#include <cmath>

#include "solve/box_element.hpp"
#include "solve/parallel_vectors.hpp"

namespace ream::solve {

std::array<Vec3, 8> corner_displacements(const ElasticGrid& grid, size_t element,
                                         std::span<const double> displacements_mm) {
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c)
    corners[static_cast<size_t>(c)] =
        Eigen::Map<const Vec3>(displacements_mm.data() + 3 * grid.corner_of_element(element, c));
  return corners;
}

std::vector<float> effective_strains(const ElasticGrid& grid, double poisson,
                                     std::span<const double> displacements_mm, ThreadPool& pool) {
  const BoxElement box(grid.cell_mm(), poisson);
  const double volume_mm3 = grid.cell_mm().prod();
  std::vector<float> strains(grid.elements());
  for_parts(pool, strains.size(), [&](size_t begin, size_t end) {
    Eigen::Matrix<double, 24, 1> u;
    for (size_t e = begin; e < end; ++e) {
      const std::array<Vec3, 8> corners = corner_displacements(grid, e, displacements_mm);
      for (int c = 0; c < 8; ++c) u.segment<3>(Eigen::Index{3} * c) = corners[static_cast<size_t>(c)];
      strains[e] = static_cast<float>(std::sqrt(std::max(0.0, u.dot(box.stiffness * u) / volume_mm3)));
    }
  });
  return strains;
}

double quantile(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return double{values[static_cast<size_t>(at)]};
}

}  // namespace ream::solve
