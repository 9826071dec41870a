#include "solve/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solve/elastic_operator.hpp"
#include "solve/multigrid.hpp"
#include "solve/multigrid_cl.hpp"
#include "solve/parallel_vectors.hpp"
#include "solve/rigid_aggregates_cl.hpp"

namespace ream::solve {
namespace {

using Doubles = std::vector<double>;

/// Vectors on the processor. `Cycle`: Multigrid, or MultigridCl for devices without doubles.
template <class Cycle>
class HostSpace {
 public:
  using Vector = Doubles;

  template <class... Device>
  HostSpace(const ElasticGrid& grid, double poisson, ThreadPool& pool, const RigidAggregates& aggregates,
            const Device&... device)
      : stiffness_(grid, poisson),
        multigrid_(device..., grid, poisson, pool),
        aggregates_(aggregates),
        pool_(pool) {}

  Vector vector() const { return Vector(3 * stiffness_.grid().corners(), 0.0); }
  Vector put(Doubles numbers) const { return numbers; }
  Doubles take(Vector& vector) const { return std::move(vector); }

  void apply(const Vector& displacements, Vector& forces) { stiffness_.apply(displacements, forces, pool_); }
  /// correction = V residual, V the multigrid cycle.
  void cycle(const Vector& residual, Vector& correction) { multigrid_.cycle(residual, correction); }
  /// correction += Q residual, Q the aggregates.
  void add_rigid_motions(const Vector& residual, Vector& correction) {
    aggregates_.add_correction(residual, correction, pool_);
  }
  /// y = a x + b y.
  void combine(double a, const Vector& x, double b, Vector& y) {
    for_parts(pool_, y.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) y[i] = a * x[i] + b * y[i];
    });
  }
  double dot(const Vector& x, const Vector& y) {
    return sum_of(pool_, x.size(), [&](size_t i) { return x[i] * y[i]; });
  }

 private:
  ElasticOperator<double> stiffness_;
  Cycle multigrid_;
  const RigidAggregates& aggregates_;
  ThreadPool& pool_;
};

/// Vectors on a device that knows doubles. What is left for the processor is between aggregates.
class DeviceSpace {
 public:
  using Vector = gpu::Buffer;

  DeviceSpace(const ElasticGrid& grid, double poisson, ThreadPool& pool, const RigidAggregates& aggregates,
              const gpu::Queue& queue)
      : queue_(queue),
        multigrid_(queue, grid, poisson, pool),
        program_(ElasticOperatorCl<double>::program(queue)),
        stiffness_(queue, program_, multigrid_.finest(), ElasticOperator<double>(grid, poisson)),
        vectors_(queue, 3 * grid.corners()),
        aggregates_(queue, multigrid_.finest(), aggregates) {}

  Vector vector() const { return vectors_.zeros(); }
  Vector put(const Doubles& numbers) const { return gpu::Buffer::copy_of(queue_, std::span(numbers)); }
  Doubles take(const Vector& vector) const {
    Doubles numbers(vector.bytes() / sizeof(double));
    vector.read(queue_, numbers.data(), vector.bytes());
    return numbers;
  }

  void apply(const Vector& displacements, Vector& forces) { stiffness_.apply(displacements, forces); }
  void cycle(const Vector& residual, Vector& correction) { multigrid_.cycle(residual, correction, vectors_); }
  void add_rigid_motions(const Vector& residual, Vector& correction) {
    aggregates_.add_correction(residual, correction);
  }
  void combine(double a, const Vector& x, double b, Vector& y) { vectors_.combine(a, x, b, y); }
  double dot(const Vector& x, const Vector& y) { return vectors_.dot(x, y); }

 private:
  const gpu::Queue& queue_;
  MultigridCl multigrid_;
  gpu::Program program_;
  ElasticOperatorCl<double> stiffness_;
  VectorsCl vectors_;
  RigidAggregatesCl aggregates_;
};

template <class Space>
class ConjugateGradients {
 public:
  using Vector = typename Space::Vector;

  /// `residual`: of the guess. Its length is over `first_length` in the end.
  ConjugateGradients(Space& space, Doubles guess, Doubles residual, double first_length)
      : space_(space),
        displacements_(space.put(std::move(guess))),
        residual_(space.put(std::move(residual))),
        corrected_(space.vector()),
        direction_(space.vector()),
        forces_(space.vector()),
        first_(first_length) {}

  Solution run(const SolverLimits& limits, const Progress& progress) {
    if (first_ > 0.0) take_out_rigid_motions();
    solution_.relative_residual = first_ > 0.0 ? length() / first_ : 0.0;
    double last_product = 0.0;
    while (solution_.relative_residual > limits.tolerance && solution_.iterations < limits.max_iterations) {
      progress(done(limits.tolerance), "solving");
      precondition();
      const double product = space_.dot(residual_, corrected_);
      space_.combine(1.0, corrected_, last_product > 0.0 ? product / last_product : 0.0, direction_);
      last_product = product;
      if (!advance(product)) break;
      solution_.relative_residual = length() / first_;
      ++solution_.iterations;
    }
    solution_.converged = solution_.relative_residual <= limits.tolerance;
    solution_.displacements_mm = space_.take(displacements_);
    return std::move(solution_);
  }

 private:
  /// The residual's part among the aggregates' motions goes first; the rest stays out of them all along
  /// (A-DEF2 of Tang et al. 2009).
  void take_out_rigid_motions() {
    space_.add_rigid_motions(residual_, corrected_);
    space_.apply(corrected_, forces_);
    space_.combine(1.0, corrected_, 1.0, displacements_);
    space_.combine(-1.0, forces_, 1.0, residual_);
  }

  /// corrected = V r + Q (r - A V r), V the multigrid cycle and Q the aggregates.
  void precondition() {
    space_.cycle(residual_, corrected_);
    space_.apply(corrected_, forces_);
    space_.combine(1.0, residual_, -1.0, forces_);
    space_.add_rigid_motions(forces_, corrected_);
  }

  /// False where rounding leaves nowhere to go.
  bool advance(double product) {
    space_.apply(direction_, forces_);
    const double curvature = space_.dot(direction_, forces_);
    if (!(curvature > 0.0) || !(product > 0.0) || !std::isfinite(product / curvature)) return false;
    const double step = product / curvature;
    space_.combine(step, direction_, 1.0, displacements_);
    space_.combine(-step, forces_, 1.0, residual_);
    return true;
  }

  double length() { return std::sqrt(space_.dot(residual_, residual_)); }
  double done(double tolerance) const {
    return std::clamp(std::log(solution_.relative_residual) / std::log(tolerance), 0.0, 1.0);
  }

  Space& space_;
  Vector displacements_, residual_, corrected_, direction_, forces_;
  double first_;
  Solution solution_;
};

}  // namespace

Solution solve(const ElasticGrid& grid, double poisson, Doubles guess, const SolverLimits& limits,
               ThreadPool& pool, const Progress& progress, std::span<const double> loads_n) {
  Doubles residual(guess.size());
  ElasticOperator<double>(grid, poisson).apply(guess, residual, pool);
  const auto load = [&](size_t i) {
    return loads_n.empty() || grid.is_held(i / 3, static_cast<int>(i % 3)) ? 0.0 : loads_n[i];
  };
  for (size_t i = 0; i < residual.size(); ++i) residual[i] = load(i) - residual[i];
  const double first = std::sqrt(sum_of(pool, residual.size(), [&](size_t i) {
    const double number = loads_n.empty() ? residual[i] : load(i);
    return number * number;
  }));
  if (!std::isfinite(first))
    throw Error(ErrorKind::invalid_input, "the bone's forces are not finite; its moduli are too large");
  const auto run = [&](auto&& space) {
    return ConjugateGradients(space, std::move(guess), std::move(residual), first).run(limits, progress);
  };
  const RigidAggregates aggregates(grid, poisson, limits.min_piece_corners, progress);
  if (limits.queue == nullptr) return run(HostSpace<Multigrid>(grid, poisson, pool, aggregates));
  if (!limits.queue->device().knows_doubles)
    return run(HostSpace<MultigridCl>(grid, poisson, pool, aggregates, *limits.queue));
  return run(DeviceSpace(grid, poisson, pool, aggregates, *limits.queue));
}

}  // namespace ream::solve
