#include "solve/multigrid.hpp"

#include <cmath>

#include "solve/multigrid_cycle.hpp"
#include "solve/parallel_vectors.hpp"

namespace ream::solve {
namespace {

using Floats = std::vector<float>;

/// Sums of the fine residual about each coarse corner, with the weights of interpolation.
void restrict_residual(const ElasticGrid& fine, const Floats& residual, const ElasticGrid& coarse,
                       Floats& sums, ThreadPool& pool) {
  pool.run(static_cast<size_t>(coarse.dims().z()) + 1, [&](size_t layer, int) {
    for (size_t corner = coarse.layer_corners()[layer]; corner < coarse.layer_corners()[layer + 1];
         ++corner) {
      const Vec3i middle = 2 * coarse.place_of(corner);
      float sum[3] = {0.0f, 0.0f, 0.0f};
      for (int i = 0; i < 27; ++i) {
        const Vec3i step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), place = middle + step;
        if ((place.array() < 0).any() || (place.array() > fine.dims().array()).any()) continue;
        const int32_t near = fine.corner_at(place);
        if (near < 0) continue;
        const float weight = 1.0f / static_cast<float>(1 << step.cwiseAbs().sum());
        for (size_t k = 0; k < 3; ++k) sum[k] += weight * residual[3 * static_cast<size_t>(near) + k];
      }
      for (size_t k = 0; k < 3; ++k)
        sums[3 * corner + k] = coarse.is_held(corner, static_cast<int>(k)) ? 0.0f : sum[k];
    }
  });
}

/// Trilinear between the coarse corners; nothing where the fine one is held.
void interpolate(const ElasticGrid& coarse, const Floats& values, const ElasticGrid& fine, Floats& to,
                 ThreadPool& pool) {
  pool.run(static_cast<size_t>(fine.dims().z()) + 1, [&](size_t layer, int) {
    for (size_t corner = fine.layer_corners()[layer]; corner < fine.layer_corners()[layer + 1]; ++corner) {
      const Vec3i place = fine.place_of(corner), low = place / 2;
      const Vec3i odd = place - 2 * low;
      const float weight = 1.0f / static_cast<float>(1 << odd.sum());
      float sum[3] = {0.0f, 0.0f, 0.0f};
      for (int c = 0; c < 8; ++c) {
        const Vec3i step(c & 1, c >> 1 & 1, c >> 2);
        if ((step.array() > odd.array()).any()) continue;
        const int32_t near = coarse.corner_at(low + step);  // the cell that the fine corner lies in has it
        for (size_t k = 0; k < 3; ++k) sum[k] += weight * values[3 * static_cast<size_t>(near) + k];
      }
      for (size_t k = 0; k < 3; ++k)
        to[3 * corner + k] = fine.is_held(corner, static_cast<int>(k)) ? 0.0f : sum[k];
    }
  });
}

}  // namespace

struct Multigrid::Level {
  Level(const ElasticGrid& given, double poisson, ThreadPool& pool_of)
      : grid(given),
        stiffness(grid, poisson),
        steps(chebyshev_steps(stiffness.greatest_over_diagonal())),
        inverse_diagonal(stiffness.inverse_diagonal()),
        pool(pool_of) {
    const size_t count = 3 * grid.corners();
    for (Floats* vector : {&solution, &residual, &direction, &forces}) vector->resize(count);
  }

  void clear() { std::fill(solution.begin(), solution.end(), 0.0f); }
  void solve(const DirectSolution& directly) { solution = directly.of(residual); }

  /// direction = kept direction + scale D^-1 residual, and one step along it.
  void step(const ChebyshevStep& s) {
    for_parts(pool, solution.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        direction[i] = s.kept * direction[i] + s.scale * inverse_diagonal[i] * residual[i];
        solution[i] += direction[i];
      }
    });
  }

  /// residual -= stiffness * direction.
  void take_off() {
    stiffness.apply(direction, forces, pool);
    for_parts(pool, residual.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) residual[i] -= forces[i];
    });
  }

  void restrict_to(Level& coarse) const {
    restrict_residual(grid, residual, coarse.grid, coarse.residual, pool);
  }

  void step_by(const Level& coarse) {
    interpolate(coarse.grid, coarse.solution, grid, direction, pool);
    for_parts(pool, solution.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) solution[i] += direction[i];
    });
  }

  const ElasticGrid& grid;
  ElasticOperator<float> stiffness;
  const std::vector<ChebyshevStep> steps;
  Floats inverse_diagonal, solution, residual, direction, forces;
  ThreadPool& pool;
};

Multigrid::Multigrid(const ElasticGrid& finest, double poisson, ThreadPool& pool)
    : pool_(pool), coarser_(coarser_grids(finest, poisson)) {
  levels_.push_back(std::make_unique<Level>(finest, poisson, pool));
  for (const auto& grid : coarser_) levels_.push_back(std::make_unique<Level>(*grid, poisson, pool));
  coarsest_ = std::make_unique<DirectSolution>(levels_.back()->grid, poisson);
}

Multigrid::~Multigrid() = default;

void Multigrid::cycle(std::span<const double> residual, std::span<double> correction) {
  Level& finest = *levels_.front();
  const double length =
      std::sqrt(sum_of(pool_, residual.size(), [&](size_t i) { return residual[i] * residual[i]; }) + 1e-300);
  const double scale = 1.0 / length;
  for_parts(pool_, residual.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) finest.residual[i] = static_cast<float>(scale * residual[i]);
  });
  descend<Level>(levels_, *coarsest_);
  for_parts(pool_, correction.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) correction[i] = length * double{finest.solution[i]};
  });
}

}  // namespace ream::solve
