#include "solve/multigrid_cl.hpp"

#include <cmath>

#include "core/error.hpp"
#include "solve/multigrid_cycle.hpp"
#include "solve/parallel_vectors.hpp"

namespace ream::solve {
namespace {

/// Of a level: five vectors of floats, and the grid.
size_t level_bytes(const ElasticGrid& grid) {
  const size_t places = grid.lattice_index(grid.dims()) + 1;
  return grid.corners() * (15 * sizeof(float) + sizeof(uint32_t) + 1) + places * 2 * sizeof(float);
}

void require_room(const gpu::Device& device, const ElasticGrid& finest,
                  std::span<const std::unique_ptr<ElasticGrid>> coarser) {
  if (!device.keeps_small_floats)
    throw Error(
        ErrorKind::unavailable,
        device.name + " takes floats below 1e-38 for zero, so that results would differ; use --backend cpu");
  size_t bytes = level_bytes(finest);
  for (const auto& grid : coarser) bytes += level_bytes(*grid);
  if (device.knows_doubles) bytes += finest.corners() * 15 * sizeof(double);
  if (bytes > device.memory_bytes)
    throw Error(ErrorKind::unavailable, "OpenCL: " + std::to_string(finest.elements()) + " elements need " +
                                            std::to_string((bytes >> 20) + 1) + " MiB of " + device.name +
                                            ", which has " + std::to_string(device.memory_bytes >> 20) +
                                            "; use a smaller region or --backend cpu");
}

}  // namespace

struct MultigridCl::Programs {
  explicit Programs(const gpu::Queue& queue)
      : stiffness(ElasticOperatorCl<float>::program(queue)), multigrid(queue, "multigrid.cl") {}

  gpu::Program stiffness, multigrid;
};

struct MultigridCl::Level {
  Level(const gpu::Queue& on, const Programs& programs, const ElasticGrid& given, double poisson)
      : Level(on, programs, given, ElasticOperator<float>(given, poisson)) {}

  Level(const gpu::Queue& on, const Programs& programs, const ElasticGrid& given,
        const ElasticOperator<float>& twin)
      : queue(on),
        count(static_cast<uint32_t>(3 * given.corners())),
        grid(on, given),
        stiffness(on, programs.stiffness, grid, twin),
        steps(chebyshev_steps(twin.greatest_over_diagonal())),
        step_kernel(programs.multigrid, "step_along"),
        restrict_kernel(programs.multigrid, "restrict_residual"),
        coarse_kernel(programs.multigrid, "step_by_coarse") {
    const std::vector<float> inverse = twin.inverse_diagonal();
    inverse_diagonal = gpu::Buffer::copy_of(queue, std::span(inverse));
    for (gpu::Buffer* vector : {&solution, &residual, &direction}) {
      *vector = gpu::Buffer(queue, count * sizeof(float));
      vector->fill(queue, 0);
    }
  }

  void clear() { solution.fill(queue, 0); }

  void solve(const DirectSolution& directly) {
    std::vector<float> numbers(count);
    residual.read(queue, numbers.data(), residual.bytes());
    numbers = directly.of(numbers);
    solution.write(queue, numbers.data(), solution.bytes());
  }

  void step(const ChebyshevStep& s) {
    step_kernel.set_all(count, s.kept, s.scale, inverse_diagonal, residual, direction, solution);
    step_kernel.enqueue(queue, count, solve_local_size);
  }

  void take_off() { stiffness.take_off(direction, residual); }

  void restrict_to(Level& coarse) {
    const ElasticGridCl& to = coarse.grid;
    restrict_kernel.set_all(grid.layout, grid.corner_of, to.layout, to.places, to.held, residual,
                            coarse.residual);
    restrict_kernel.enqueue(queue, to.layout.corners, solve_local_size);
  }

  void step_by(const Level& coarse) {
    const ElasticGridCl& from = coarse.grid;
    coarse_kernel.set_all(from.layout, from.corner_of, grid.layout, grid.places, grid.held, coarse.solution,
                          direction, solution);
    coarse_kernel.enqueue(queue, grid.layout.corners, solve_local_size);
  }

  const gpu::Queue& queue;
  const uint32_t count;
  const ElasticGridCl grid;
  ElasticOperatorCl<float> stiffness;
  const std::vector<ChebyshevStep> steps;
  gpu::Kernel step_kernel, restrict_kernel, coarse_kernel;
  gpu::Buffer inverse_diagonal, solution, residual, direction;
};

MultigridCl::MultigridCl(const gpu::Queue& queue, const ElasticGrid& finest, double poisson, ThreadPool& pool)
    : queue_(queue), pool_(pool), coarser_(coarser_grids(finest, poisson)) {
  require_room(queue.device(), finest, coarser_);
  programs_ = std::make_unique<Programs>(queue);
  levels_.push_back(std::make_unique<Level>(queue, *programs_, finest, poisson));
  for (const auto& grid : coarser_)
    levels_.push_back(std::make_unique<Level>(queue, *programs_, *grid, poisson));
  coarsest_ = std::make_unique<DirectSolution>(coarser_.empty() ? finest : *coarser_.back(), poisson);
}

MultigridCl::~MultigridCl() = default;

const ElasticGridCl& MultigridCl::finest() const { return levels_.front()->grid; }

void MultigridCl::cycle(std::span<const double> residual, std::span<double> correction) {
  Level& finest = *levels_.front();
  const double length =
      std::sqrt(sum_of(pool_, residual.size(), [&](size_t i) { return residual[i] * residual[i]; }) + 1e-300);
  const double scale = 1.0 / length;
  std::vector<float> numbers(residual.size());
  for_parts(pool_, numbers.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) numbers[i] = static_cast<float>(scale * residual[i]);
  });
  finest.residual.write(queue_, numbers.data(), finest.residual.bytes());
  descend<Level>(levels_, *coarsest_);
  finest.solution.read(queue_, numbers.data(), finest.solution.bytes());
  for_parts(pool_, numbers.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) correction[i] = length * double{numbers[i]};
  });
}

void MultigridCl::cycle(const gpu::Buffer& residual, gpu::Buffer& correction, VectorsCl& vectors) {
  Level& finest = *levels_.front();
  const double length = std::sqrt(vectors.dot(residual, residual) + 1e-300);
  vectors.to_floats(1.0 / length, residual, finest.residual);
  descend<Level>(levels_, *coarsest_);
  vectors.to_doubles(length, finest.solution, correction);
}

}  // namespace ream::solve
