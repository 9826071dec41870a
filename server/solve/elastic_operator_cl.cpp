#include "solve/elastic_operator_cl.hpp"

#include <type_traits>

#include "core/error.hpp"

namespace ream::solve {
namespace {

layout::ElasticGridLayout layout_of(const ElasticGrid& grid) {
  const Vec3i& dims = grid.dims();
  return {static_cast<uint32_t>(grid.corners()),
          static_cast<uint32_t>(grid.corner_offset(2)),
          static_cast<uint32_t>(grid.corner_offset(4)),
          dims.x(),
          dims.y(),
          dims.z()};
}

size_t places_of_lattice(const ElasticGrid& grid) { return grid.lattice_index(grid.dims()) + 1; }

std::vector<float> moduli_by_place(const ElasticGrid& grid) {
  const size_t before = grid.corner_offset(7);
  std::vector<float> moduli(before + places_of_lattice(grid), 0.0f);
  for (size_t e = 0; e < grid.elements(); ++e) moduli[before + grid.first_places()[e]] = grid.moduli_mpa()[e];
  return moduli;
}

}  // namespace

ElasticGridCl::ElasticGridCl(const gpu::Queue& queue, const ElasticGrid& grid)
    : layout(layout_of(grid)),
      places(gpu::Buffer::copy_of(queue, grid.places())),
      corner_of(gpu::Buffer::copy_of(queue, std::span(grid.corner_of(), places_of_lattice(grid)))),
      held(gpu::Buffer::copy_of(queue, grid.held())) {
  const std::vector<float> moduli = moduli_by_place(grid);
  moduli_mpa = gpu::Buffer::copy_of(queue, std::span(moduli));
}

template <typename Real>
gpu::Program ElasticOperatorCl<Real>::program(const gpu::Queue& queue) {
  if constexpr (std::is_same_v<Real, float>) return {queue, "elastic_operator.cl"};
  if (!queue.device().knows_doubles)
    throw Error(ErrorKind::unavailable, queue.device().name + " has no double precision");
  return {queue, "elastic_operator.cl", "-D DOUBLES"};
}

template <typename Real>
ElasticOperatorCl<Real>::ElasticOperatorCl(const gpu::Queue& queue, const gpu::Program& program,
                                           const ElasticGridCl& grid, const ElasticOperator<Real>& twin)
    : queue_(queue),
      corners_(grid.layout.corners),
      blocks_(gpu::Buffer::copy_of(queue, std::span<const std::array<Real, 9>>(twin.blocks()))),
      kernel_(program, "apply_stiffness") {
  kernel_.set_all(grid.layout, grid.places, grid.corner_of, grid.moduli_mpa, grid.held, blocks_);
}

template <typename Real>
void ElasticOperatorCl<Real>::enqueue(const gpu::Buffer& displacements, gpu::Buffer& forces,
                                      int32_t take_off) {
  kernel_.set(6, take_off);
  kernel_.set(7, displacements);
  kernel_.set(8, forces);
  kernel_.enqueue(queue_, corners_, solve_local_size);
}

template class ElasticOperatorCl<float>;
template class ElasticOperatorCl<double>;

}  // namespace ream::solve
