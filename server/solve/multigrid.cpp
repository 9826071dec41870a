#include "solve/multigrid.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "solve/elastic_operator.hpp"
#include "solve/parallel_vectors.hpp"

namespace ream::solve {
namespace {

/// So few corners are solved directly.
constexpr size_t max_coarsest_corners = 500;
constexpr int smoothing_steps = 3;
/// Eigenvalues from the greatest down to this share of it are smoothed: what is below, the next grid sees.
constexpr double smoothed_share = 0.05;

using Floats = std::vector<float>;

}  // namespace

struct Multigrid::Level {
  Level(const ElasticGrid& given, double poisson, ThreadPool& pool_of)
      : grid(given), stiffness(grid, poisson), inverse_diagonal(stiffness.inverse_diagonal()), pool(pool_of) {
    const size_t count = 3 * grid.corners();
    for (Floats* vector : {&solution, &residual, &direction, &forces}) vector->resize(count);
  }
  Level(std::unique_ptr<ElasticGrid> made, double poisson, ThreadPool& pool_of)
      : Level(*made, poisson, pool_of) {
    own = std::move(made);
  }

  /// Improves `solution`, whose residual is `residual`; leaves the residual of what it became.
  void smooth(bool residual_is_needed) {
    const double greatest = stiffness.greatest_over_diagonal(), low = smoothed_share * greatest,
                 middle = 0.5 * (greatest + low), half = 0.5 * (greatest - low);
    const double sigma = middle / half;
    double rho = 1.0 / sigma;
    step(0.0f, static_cast<float>(1.0 / middle));
    for (int i = 1; i < smoothing_steps; ++i) {
      take_off();
      const double next = 1.0 / (2.0 * sigma - rho);
      step(static_cast<float>(next * rho), static_cast<float>(2.0 * next / half));
      rho = next;
    }
    if (residual_is_needed) take_off();
  }

  /// direction = kept direction + scale D^-1 residual, and one step along it.
  void step(float kept, float scale) {
    for_parts(pool, solution.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        direction[i] = kept * direction[i] + scale * inverse_diagonal[i] * residual[i];
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

  std::unique_ptr<ElasticGrid> own;  ///< but for the finest
  const ElasticGrid& grid;
  ElasticOperator<float> stiffness;
  Floats inverse_diagonal, solution, residual, direction, forces;
  ThreadPool& pool;
};

struct Multigrid::Coarsest {
  explicit Coarsest(const Level& level) {
    const ElasticGrid& grid = level.grid;
    const auto count = static_cast<Eigen::Index>(3 * grid.corners());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
    ThreadPool one(1);
    Floats unit(3 * grid.corners(), 0.0f), column(3 * grid.corners());
    for (Eigen::Index i = 0; i < count; ++i) {
      unit[static_cast<size_t>(i)] = 1.0f;
      level.stiffness.apply(unit, column, one);
      unit[static_cast<size_t>(i)] = 0.0f;
      for (Eigen::Index j = 0; j < count; ++j) stiffness(j, i) = double{column[static_cast<size_t>(j)]};
    }
    // What nobody holds may move as a whole; rounding makes nothing of it.
    const double greatest = std::max(stiffness.diagonal().maxCoeff(), 1e-30);
    for (Eigen::Index i = 0; i < count; ++i)
      if (level.inverse_diagonal[static_cast<size_t>(i)] == 0.0f) {
        stiffness.row(i).setZero();
        stiffness.col(i).setZero();
        stiffness(i, i) = greatest;
      } else {
        stiffness(i, i) += 1e-7 * greatest;
      }
    factors.compute(stiffness);
  }

  void solve(const Floats& residual, Floats& solution) const {
    Eigen::VectorXd right(static_cast<Eigen::Index>(residual.size()));
    for (size_t i = 0; i < residual.size(); ++i) right[static_cast<Eigen::Index>(i)] = double{residual[i]};
    const Eigen::VectorXd found = factors.solve(right);
    for (size_t i = 0; i < solution.size(); ++i)
      solution[i] = static_cast<float>(found[static_cast<Eigen::Index>(i)]);
  }

  Eigen::LDLT<Eigen::MatrixXd> factors;
};

namespace {

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

Multigrid::Multigrid(const ElasticGrid& finest, double poisson, ThreadPool& pool) : pool_(pool) {
  levels_.push_back(std::make_unique<Level>(finest, poisson, pool));
  const std::array<float, 256> energy_shares = BoxElement(finest.cell_mm(), poisson).energy_shares();
  while (levels_.back()->grid.corners() > max_coarsest_corners)
    levels_.push_back(std::make_unique<Level>(
        std::make_unique<ElasticGrid>(levels_.back()->grid.coarser(energy_shares)), poisson, pool));
  coarsest_ = std::make_unique<Coarsest>(*levels_.back());
}

Multigrid::~Multigrid() = default;

void Multigrid::cycle(std::span<const double> residual, std::span<double> correction) {
  Level& finest = *levels_.front();
  const double length =
      std::sqrt(sum_of(pool_, residual.size(), [&](size_t i) { return residual[i] * residual[i]; }) + 1e-300);
  for_parts(pool_, residual.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) finest.residual[i] = static_cast<float>(residual[i] / length);
  });
  descend(0);
  for_parts(pool_, correction.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) correction[i] = length * double{finest.solution[i]};
  });
}

/// Finds the solution for the residual of a level.
void Multigrid::descend(size_t number) {
  Level& level = *levels_[number];
  std::fill(level.solution.begin(), level.solution.end(), 0.0f);
  if (number + 1 == levels_.size()) return coarsest_->solve(level.residual, level.solution);
  level.smooth(true);
  Level& coarse = *levels_[number + 1];
  restrict_residual(level.grid, level.residual, coarse.grid, coarse.residual, pool_);
  descend(number + 1);
  interpolate(coarse.grid, coarse.solution, level.grid, level.direction, pool_);
  for_parts(pool_, level.solution.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) level.solution[i] += level.direction[i];
  });
  level.take_off();
  level.smooth(false);
}

}  // namespace ream::solve
