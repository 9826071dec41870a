#include "bench/femesh/our_mesh.hpp"

#include <memory>

#include "core/clock.hpp"
#include "core/thread_pool.hpp"
#include "fe/element_model.hpp"
#include "fe/materials.hpp"
#include "fe/node_numbering.hpp"

namespace ream::bench {
namespace {

template <typename Phase>
double timed_ms(Phase&& phase) {
  const auto start = SteadyClock::now();
  phase();
  return elapsed_us(start) * 1e-3;
}

/// As the thesis ends its geometry: arrays of nodes and of eight ids an element. Both threads write their
/// parts first, so that the system finds memory for both at once.
uint64_t make_explicit(const fe::ElementModel& model, const fe::NodeNumbering& numbering) {
  const auto nodes = std::make_unique_for_overwrite<std::array<float, 3>[]>(numbering.nodes());
  const auto elements = std::make_unique_for_overwrite<std::array<uint32_t, 8>[]>(numbering.elements());
  parallel_for(2, numbering.corners().count(), [&](size_t slab) {
    size_t at = numbering.nodes_before(slab);
    fe::for_each_corner_row(numbering, slab, [&](int v, int w, const fe::CornerRow& row) {
      const auto y = static_cast<float>(v * model.spacing_mm.y()),
                 z = static_cast<float>(w * model.spacing_mm.z());
      fe::for_each_run(row.words().data(), row.words().size(), [&](int begin, int end) {
        for (int u = begin; u < end; ++u) nodes[at++] = {static_cast<float>(u * model.spacing_mm.x()), y, z};
      });
    });
  });
  parallel_for(2, numbering.voxels().count(), [&](size_t slab) {
    size_t at = numbering.elements_before(slab);
    if (at == numbering.elements_before(slab + 1)) return;
    fe::for_each_element_run<fe::CornerRow>(
        numbering, slab, [&](int, int begin, int end, const fe::CornerRow* rows) {
          uint32_t n[4];
          for (int k = 0; k < 4; ++k) n[k] = static_cast<uint32_t>(rows[k].first_id() + rows[k].rank(begin));
          for (int u = begin; u < end; ++u) {
            elements[at++] = {n[0], n[0] + 1, n[1] + 1, n[1], n[2], n[2] + 1, n[3] + 1, n[3]};
            for (uint32_t& id : n) ++id;
          }
        });
  });
  return elements[numbering.elements() - 1][6] + static_cast<uint64_t>(nodes[numbering.nodes() - 1][0]);
}

fe::ElementModel model_of(const Foam& foam, const std::vector<uint16_t>& gray, double& ms) {
  fe::ElementModel model;
  model.spacing_mm = foam.spacing_mm();
  MemoryBudget budget;
  const Vec3i dims = foam.dims();
  const size_t layer = static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y());
  const auto read = [&](int w, std::span<int32_t> codes) {
    const uint16_t* from = gray.data() + layer * static_cast<size_t>(w);
    for (size_t i = 0; i < layer; ++i) codes[i] = from[i] == 0 ? fe::no_element : int32_t{from[i]};
  };
  ms = timed_ms([&] { fe::fill_from_layers(model, dims, read, budget); });
  return model;
}

std::vector<uint16_t> dense_gray(const Foam& foam) {
  const Vec3i d = foam.dims();
  std::vector<uint16_t> gray(static_cast<size_t>(d.x()) * static_cast<size_t>(d.y()) *
                             static_cast<size_t>(d.z()));
  size_t at = 0;
  for (int w = 0; w < d.z(); ++w)
    for (int v = 0; v < d.y(); ++v)
      for (int u = 0; u < d.x(); ++u) gray[at++] = foam.gray(u, v, w);
  return gray;
}

}  // namespace

OurMesh our_mesh(const Foam& foam, int upsample, double bin_width) {
  OurMesh mesh;
  MemoryBudget budget;
  fe::ElementModel model = model_of(foam, dense_gray(foam), mesh.grid_ms);
  mesh.components_ms =
      timed_ms([&] { mesh.islands = fe::keep_largest_component(model, budget).components - 1; });
  mesh.upsample_ms = timed_ms([&] { model = fe::refined(std::move(model), upsample, budget); });
  fe::MaterialRule rule;
  if (bin_width > 0.0) rule.bin_width_mpa = bin_width;
  fe::Materials materials;
  mesh.materials_ms =
      timed_ms([&] { materials = fe::make_materials(fe::histogram_of(model.codes), model.gray, rule); });
  mesh.sets_ms = timed_ms(
      [&] { fe::for_each_part_of_sets(model.codes, materials, budget, [](const fe::SetsPart&) {}); });
  std::optional<fe::NodeNumbering> numbering;
  mesh.numbering_ms = timed_ms([&] { numbering.emplace(model.mask); });
  mesh.explicit_ms = timed_ms([&] { make_explicit(model, *numbering); });
  mesh.elements = numbering->elements();
  mesh.nodes = numbering->nodes();
  mesh.materials = materials.list.size();
  return mesh;
}

OurMesh our_numbering(const Foam& foam) {
  OurMesh mesh;
  double ignored = 0.0;
  const fe::ElementModel model = model_of(foam, dense_gray(foam), ignored);
  std::optional<fe::NodeNumbering> numbering;
  mesh.numbering_ms = timed_ms([&] { numbering.emplace(model.mask); });
  mesh.explicit_ms = timed_ms([&] { make_explicit(model, *numbering); });
  mesh.elements = numbering->elements();
  mesh.nodes = numbering->nodes();
  return mesh;
}

}  // namespace ream::bench
