#include "solve/bone_compression.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "solve/elastic_operator.hpp"
#include "solve/element_strains.hpp"
#include "solve/parallel_vectors.hpp"
#include "solve/sets.hpp"

namespace ream::solve {
namespace {

/// The elements' box, and what each of its cells is made of.
struct Cells {
  Vec3i dims = Vec3i::Zero();
  std::vector<float> moduli_mpa;  ///< x fastest; 0 without bone
};

Cells cells_of(const fe::ElementModel& model, const fe::Materials& materials) {
  const fe::MeshBounds bounds = fe::bounds_of(model.mask);
  Cells cells;
  cells.dims = bounds.greatest - bounds.least;
  const double corners = (cells.dims.cast<double>().array() + 1.0).prod();
  if (corners >= 2147483648.0)
    throw Error(ErrorKind::invalid_input,
                "the box around the bone has more than 2^31 places; choose a smaller region");
  for (const fe::Material& material : materials.list)
    if (!(material.modulus_mpa > min_modulus_mpa && material.modulus_mpa < max_modulus_mpa))
      throw Error(ErrorKind::invalid_input,
                  "a modulus is " + std::to_string(material.modulus_mpa) +
                      " MPa; give a --modulus or --law that is between 1e-9 and 1e12");
  cells.moduli_mpa.assign(static_cast<size_t>(cells.dims.cast<int64_t>().prod()), 0.0f);
  uint64_t element = 0;
  std::vector<uint16_t> scratch;
  const auto add_run = [&](int begin, int end, int v, int w) {
    const auto count = static_cast<size_t>(end - begin);
    const Vec3i at = Vec3i(begin, v, w) - bounds.least;
    float* to =
        cells.moduli_mpa.data() + static_cast<size_t>(at.x()) +
        static_cast<size_t>(cells.dims.x()) *
            (static_cast<size_t>(at.y()) + static_cast<size_t>(cells.dims.y()) * static_cast<size_t>(at.z()));
    for (const uint16_t code : model.codes.read(element, count, scratch))
      *to++ = static_cast<float>(materials.list[materials.of_code[code]].modulus_mpa);
    element += count;
  };
  const fe::VoxelMask& mask = model.mask;
  for (int w = 0; w < mask.dims().z(); ++w)
    for (int v = 0; v < mask.dims().y(); ++v)
      fe::for_each_run(mask.row(v, w), mask.words_per_row(),
                       [&](int begin, int end) { add_run(begin, end, v, w); });
  return cells;
}

/// Takes out of the cells what does not hang together, by corners at least, with both platens. Returns how
/// many.
size_t take_out_unloaded(Cells& cells, const ElasticGrid& grid, int axis) {
  Sets sets(grid.corners());
  std::vector<uint32_t> corner_of_element(grid.elements());
  for (size_t e = 0; e < grid.elements(); ++e) {
    const auto corner = [&](int c) { return static_cast<uint32_t>(grid.corner_of_element(e, c)); };
    corner_of_element[e] = corner(0);
    for (int c = 1; c < 8; ++c) sets.join(corner(0), corner(c));
  }
  std::vector<uint8_t> reaches(grid.corners(), 0);
  for (uint32_t corner = 0; corner < grid.corners(); ++corner) {
    const int at = grid.place_of(corner)[axis];
    if (at == 0) reaches[sets.find(corner)] |= 1;
    if (at == grid.dims()[axis]) reaches[sets.find(corner)] |= 2;
  }
  size_t taken = 0, element = 0;
  for (float& modulus : cells.moduli_mpa)
    if (modulus > 0.0f && reaches[sets.find(corner_of_element[element++])] != 3) {
      modulus = 0.0f;
      ++taken;
    }
  if (taken == grid.elements())
    throw Error(ErrorKind::invalid_input,
                "no part of the bone reaches both platens; give a lower --threshold or another region");
  return taken;
}

/// Of what is loaded. `cells` is empty afterwards.
ElasticGrid loaded_grid(Cells cells, const Vec3& cell_mm, int axis, CompressionResult& result) {
  ElasticGrid grid(cells.dims, cell_mm, cells.moduli_mpa);
  result.unloaded_elements = take_out_unloaded(cells, grid, axis);
  return result.unloaded_elements == 0 ? std::move(grid) : ElasticGrid(cells.dims, cell_mm, cells.moduli_mpa);
}

/// Corners at both ends of the axis, held.
struct Platens {
  std::vector<size_t> base, top;
};

Platens hold_platens(ElasticGrid& grid, const fe::Compression& compression) {
  Platens platens;
  for (size_t corner = 0; corner < grid.corners(); ++corner) {
    const int at = grid.place_of(corner)[compression.axis];
    if (at != 0 && at != grid.dims()[compression.axis]) continue;
    (at == 0 ? platens.base : platens.top).push_back(corner);
    for (int axis = 0; axis < 3; ++axis)
      if (axis == compression.axis || compression.fixed_platens) grid.hold(corner, axis);
  }
  return platens;
}

/// Each layer is where it is in a body that is the same all through.
std::vector<double> even_compression(const ElasticGrid& grid, const fe::Compression& compression) {
  std::vector<double> displacements(3 * grid.corners(), 0.0);
  const auto axis = static_cast<size_t>(compression.axis);
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    displacements[3 * corner + axis] =
        -compression.strain * grid.cell_mm()[compression.axis] * grid.place_of(corner)[compression.axis];
  return displacements;
}

std::array<double, 4> quantiles(const std::vector<float>& strains) {
  return {quantile(strains, 0.5), quantile(strains, 0.95), quantile(strains, 0.99), quantile(strains, 1.0)};
}

void describe_bounds(const ElasticGrid& grid, const fe::Materials& materials,
                     const CompressionRequest& request, CompressionResult& result) {
  const double cells = grid.dims().cast<double>().prod();
  double compliance = 0.0;
  for (const fe::Material& material : materials.list) {
    const double share = static_cast<double>(material.elements) / cells;
    result.voigt_mpa += share * material.modulus_mpa;
    compliance += share / material.modulus_mpa;
  }
  const double poisson = request.rule.poisson;
  if (request.compression.fixed_platens)
    result.voigt_mpa *= (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const auto elements = static_cast<double>(grid.elements() + result.unloaded_elements);
  result.bone_share = elements / cells;
  if (elements == cells) result.reuss_mpa = 1.0 / compliance;
}

void describe_forces(const ElasticGrid& grid, const Platens& platens, const CompressionRequest& request,
                     const std::vector<double>& displacements, ThreadPool& pool, CompressionResult& result) {
  std::vector<double> forces(displacements.size());
  ElasticOperator<double>(grid, request.rule.poisson).apply_with_reactions(displacements, forces, pool);
  const int axis = request.compression.axis;
  for (const size_t corner : platens.base) result.force_n += forces[3 * corner + static_cast<size_t>(axis)];
  const auto length = [&](bool held) {
    return std::sqrt(sum_of(pool, forces.size(), [&](size_t i) {
      return grid.is_held(i / 3, static_cast<int>(i % 3)) == held ? forces[i] * forces[i] : 0.0;
    }));
  };
  result.unbalanced = length(false) / length(true);
  const double area_mm2 = result.box_mm.prod() / result.box_mm[axis];
  result.modulus_mpa = result.force_n / area_mm2 / request.compression.strain;
}

/// Error usage.
void require_sound(const CompressionRequest& request) {
  if (!(request.compression.strain > 0.0 && request.compression.strain < 1.0))
    throw Error(ErrorKind::usage, "the strain must be above 0 and below 100 %");
  if (request.rule.poisson > max_poisson)
    throw Error(ErrorKind::usage, "--poisson must be at most 0.49: voxels as elements lock beyond");
}

}  // namespace

CompressionResult compress(fe::ElementModel model, const CompressionRequest& request, MemoryBudget& budget,
                           const Progress& progress) {
  if (model.codes.size() == 0)
    throw Error(ErrorKind::invalid_input,
                "no voxel is bone, so there is nothing to solve; give a lower --threshold or another region");
  require_sound(request);
  CompressionResult result;
  auto start = SteadyClock::now();
  if (!request.keep_islands)
    result.components = keep_largest_component(model, budget, part_of(progress, 0.0, 0.05));
  const fe::Materials materials = make_materials(fe::histogram_of(model.codes), model.gray, request.rule);
  Cells cells = cells_of(model, materials);
  const Vec3 spacing_mm = model.spacing_mm;
  model = {};
  ElasticGrid grid = loaded_grid(std::move(cells), spacing_mm, request.compression.axis, result);
  const Platens platens = hold_platens(grid, request.compression);
  ThreadPool pool(request.threads);
  result.elements = grid.elements();
  result.corners = grid.corners();
  result.box_mm = grid.dims().cast<double>().cwiseProduct(spacing_mm);
  describe_bounds(grid, materials, request, result);
  result.build_s = elapsed_us(start) * 1e-6;
  start = SteadyClock::now();
  const Solution solution = solve(grid, request.rule.poisson, even_compression(grid, request.compression),
                                  request.limits, pool, part_of(progress, 0.05, 1.0));
  result.solve_s = elapsed_us(start) * 1e-6;
  result.iterations = solution.iterations;
  result.relative_residual = solution.relative_residual;
  result.converged = solution.converged;
  describe_forces(grid, platens, request, solution.displacements_mm, pool, result);
  result.effective_strain =
      quantiles(effective_strains(grid, request.rule.poisson, solution.displacements_mm, pool));
  return result;
}

nlohmann::json to_json(const CompressionResult& r) {
  return {{"elements", r.elements},
          {"corners", r.corners},
          {"unloaded_elements", r.unloaded_elements},
          {"islands", r.components.components > 0 ? r.components.components - 1 : 0},
          {"island_voxels", r.components.removed_voxels},
          {"box_mm", {r.box_mm.x(), r.box_mm.y(), r.box_mm.z()}},
          {"bone_share", r.bone_share},
          {"force_n", r.force_n},
          {"unbalanced", r.unbalanced},
          {"modulus_mpa", r.modulus_mpa},
          {"voigt_mpa", r.voigt_mpa},
          {"reuss_mpa", r.reuss_mpa > 0.0 ? nlohmann::json(r.reuss_mpa) : nlohmann::json(nullptr)},
          {"effective_strain",
           {{"median", r.effective_strain[0]},
            {"q95", r.effective_strain[1]},
            {"q99", r.effective_strain[2]},
            {"greatest", r.effective_strain[3]}}},
          {"iterations", r.iterations},
          {"relative_residual", r.relative_residual},
          {"converged", r.converged},
          {"build_s", r.build_s},
          {"solve_s", r.solve_s}};
}

}  // namespace ream::solve
