#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "geometry/vec.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

/// Effective strain of each element, sqrt(2 energy / (volume modulus)) (Pistoia 2002). `displacements_mm`:
/// 3 corners().
std::vector<float> effective_strains(const ElasticGrid& grid, double poisson,
                                     std::span<const double> displacements_mm, ThreadPool& pool);

/// Displacements of an element's eight corners.
std::array<Vec3, 8> corner_displacements(const ElasticGrid& grid, size_t element,
                                         std::span<const double> displacements_mm);

/// The value below which that share of them lies, 0 to 1; 0 where there are none.
double quantile(std::vector<float> values, double share);

}  // namespace ream::solve
