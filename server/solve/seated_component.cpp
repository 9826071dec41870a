#include "solve/seated_component.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "solve/elastic_operator.hpp"
#include "solve/element_strains.hpp"
#include "solve/sets.hpp"

namespace ream::solve {
namespace {

constexpr int max_rounds = 20;
/// Of the joint's columns: so many may still change when it counts as settled.
constexpr double settled_share = 0.02;

/// Which places are open is found roughly first.
constexpr double rough_tolerance = 2e-2;

void hold_sides(ElasticGrid& grid) {
  const Vec3i& dims = grid.dims();
  for (size_t corner = 0; corner < grid.corners(); ++corner) {
    const Vec3i p = grid.place_of(corner);
    if (p.x() > 0 && p.x() < dims.x() && p.y() > 0 && p.y() < dims.y() && p.z() < dims.z()) continue;
    for (int axis = 0; axis < 3; ++axis) grid.hold(corner, axis);
  }
}

/// d u / d x at an element's middle: column k is the derivative along axis k.
Mat3 gradient(const std::array<Vec3, 8>& corners, double cell_mm) {
  Mat3 sum = Mat3::Zero();
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) {
      const Vec3& u = corners[static_cast<size_t>(c)];
      sum.col(k) += (c >> k & 1) != 0 ? u : Vec3(-u);
    }
  return sum / (4.0 * cell_mm);
}

/// Stress along a normal, over twice the shear modulus.
double stress_along(const Vec3& normal, const Mat3& change, double poisson) {
  return normal.dot(change * normal) + poisson / (1.0 - 2.0 * poisson) * change.trace();
}

/// Mean displacement of a cell's corners in a layer of the lattice, of those that there are; nothing without.
Vec3 mean_at(const ElasticGrid& grid, const std::vector<double>& displacements, const Vec3i& place) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int c = 0; c < 4; ++c) {
    const int32_t corner = grid.corner_at(place + Vec3i(c & 1, c >> 1, 0));
    if (corner < 0) continue;
    sum += Eigen::Map<const Vec3>(displacements.data() + 3 * static_cast<size_t>(corner));
    ++count;
  }
  return count > 0 ? Vec3(sum / count) : sum;
}

/// Displacements of every place of a lattice: what one grid's solution is for the next one's corners.
class LatticeField {
 public:
  explicit LatticeField(const Vec3i& dims)
      : values_(3 * static_cast<size_t>((dims.array() + 1).cast<int64_t>().prod()), 0.0) {}

  std::vector<double> at_corners(const ElasticGrid& grid) const {
    std::vector<double> values(3 * grid.corners());
    for (size_t corner = 0; corner < grid.corners(); ++corner)
      std::copy_n(&values_[3 * grid.lattice_index(grid.place_of(corner))], 3, &values[3 * corner]);
    return values;
  }
  void keep(const ElasticGrid& grid, const std::vector<double>& values) {
    for (size_t corner = 0; corner < grid.corners(); ++corner)
      std::copy_n(&values[3 * corner], 3, &values_[3 * grid.lattice_index(grid.place_of(corner))]);
  }

 private:
  std::vector<double> values_;
};

}  // namespace

SeatedComponent::SeatedComponent(SeatedCells cells, const SeatMaterials& materials)
    : cells_(std::move(cells)), materials_(materials), parts_(cells_.component.size(), Part::none) {
  if (!(materials.poisson > -1.0 && materials.poisson <= max_poisson))
    throw Error(ErrorKind::usage,
                "--poisson must be above -1 and at most 0.49: cubes as elements lock beyond");
  moduli_mpa_.assign(parts_.size(), 0.0f);
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (cells_.component[i] != 0) {
      parts_[i] = Part::component;
      moduli_mpa_[i] = static_cast<float>(materials.component_mpa);
    } else if (cells_.bone_share[i] > 0.0f && cells_.bone_mpa[i] > 0.0f) {
      parts_[i] = Part::bone;
      moduli_mpa_[i] = cells_.bone_share[i] * cells_.bone_mpa[i];
    }
  }
  find_joint();
  leave_out_loose_bone();
  find_spans();
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i] == Part::none) continue;
    if (!(moduli_mpa_[i] > min_modulus_mpa && moduli_mpa_[i] < max_modulus_mpa))
      throw Error(ErrorKind::invalid_input, "a modulus is " + std::to_string(moduli_mpa_[i]) +
                                                " MPa; give a law that is between 1e-9 and 1e12");
    ++elements_;
  }
}

Vec3i SeatedComponent::place_of(size_t cell) const {
  const auto x = static_cast<size_t>(cells_.dims.x());
  return {static_cast<int>(cell % x), static_cast<int>(cell % columns() / x),
          static_cast<int>(cell / columns())};
}

size_t SeatedComponent::cell_of(const ElasticGrid& grid, size_t element) const {
  return index(grid.place_of(grid.corner_of_element(element, 0)));
}

void SeatedComponent::find_spans() {
  joints_.assign(columns(), {});
  for (size_t cell = columns(); cell < parts_.size(); ++cell) {
    if (parts_[cell] != Part::joint) continue;
    JointSpan& span = joints_[cell % columns()];
    const int z = static_cast<int>(cell / columns());
    if (parts_[cell - columns()] == Part::component) span.begin = z;
    span.end = z + 1;
  }
}

/// Every cell that has a corner in common with the component: nothing else may, or it would be glued to it.
void SeatedComponent::find_joint() {
  const Vec3i& dims = cells_.dims;
  std::vector<int> behind(columns(), dims.z());  // of each column: the first layer behind the component
  for (size_t i = 0; i < parts_.size(); ++i)
    if (parts_[i] == Part::component) behind[i % columns()] = static_cast<int>(i / columns()) + 1;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i] != Part::component) continue;
    const Vec3i at = place_of(i);
    for (int n = 0; n < 27; ++n) {
      const Vec3i p = at + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      if ((p.array() < 0).any() || (p.array() >= dims.array()).any()) continue;
      const size_t cell = index(p);
      if (parts_[cell] == Part::component || parts_[cell] == Part::joint) continue;
      const bool carries = cells_.supported[cell % columns()] != 0 && p.z() >= behind[cell % columns()];
      parts_[cell] = carries ? Part::joint : Part::none;
      const float bone = carries ? cells_.bone_share[cell] : 0.0f;
      moduli_mpa_[cell] =
          carries ? bone * cells_.bone_mpa[cell] + (1.0f - bone) * static_cast<float>(materials_.cement_mpa)
                  : 0.0f;
    }
  }
}

void SeatedComponent::leave_out_loose_bone() {
  const ElasticGrid grid(cells_.dims, Vec3::Constant(cells_.cell_mm), moduli_mpa_);
  Sets sets(grid.corners());
  for (size_t e = 0; e < grid.elements(); ++e)
    for (int c = 1; c < 8; ++c)
      sets.join(static_cast<uint32_t>(grid.corner_of_element(e, 0)),
                static_cast<uint32_t>(grid.corner_of_element(e, c)));
  ElasticGrid held = grid;
  hold(held);
  std::vector<uint8_t> stands(grid.corners(), 0);
  for (uint32_t corner = 0; corner < grid.corners(); ++corner)
    if (held.is_held(corner, 0)) stands[sets.find(corner)] = 1;
  size_t element = 0;
  bool component_stands = false;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (moduli_mpa_[i] <= 0.0f) continue;
    const auto corner = static_cast<uint32_t>(grid.corner_of_element(element++, 0));
    if (stands[sets.find(corner)] != 0) {
      component_stands = component_stands || parts_[i] == Part::component;
      continue;
    }
    parts_[i] = Part::none;
    moduli_mpa_[i] = 0.0f;
  }
  if (!component_stands)
    throw Error(ErrorKind::invalid_input,
                "the component stands on bone that ends close behind it on all sides; the case must have "
                "more of the vault");
}

void SeatedComponent::hold(ElasticGrid& grid) const {
  hold_sides(grid);
  if (cells_.held.empty()) return;
  for (size_t cell = 0; cell < cells_.held.size(); ++cell) {
    if (cells_.held[cell] == 0) continue;
    const Vec3i at = place_of(cell);
    for (int c = 0; c < 8; ++c) {
      const int32_t corner = grid.corner_at(at + Vec3i(c & 1, c >> 1 & 1, c >> 2 & 1));
      for (int axis = 0; corner >= 0 && axis < 3; ++axis) grid.hold(static_cast<size_t>(corner), axis);
    }
  }
}

/// Open columns have no joint: pieces of the preconditioner end there, too.
ElasticGrid SeatedComponent::grid_of(const std::vector<uint8_t>& open) const {
  std::vector<float> moduli = moduli_mpa_;
  for (size_t i = 0; i < moduli.size(); ++i)
    if (parts_[i] == Part::joint && open[i % columns()] != 0) moduli[i] = 0.0f;
  ElasticGrid grid(cells_.dims, Vec3::Constant(cells_.cell_mm), moduli);
  hold(grid);
  return grid;
}

std::vector<double> SeatedComponent::forces_of(const SeatLoad& load, const ElasticGrid& grid) const {
  const Eigen::Vector2d middle(load.x_mm, load.y_mm);
  std::vector<size_t> pushed;  // elements whose front lies under the disc
  for (size_t e = 0; e < grid.elements(); ++e) {
    const size_t cell = cell_of(grid, e);
    if (parts_[cell] != Part::component) continue;
    const bool covered = cell >= columns() && parts_[cell - columns()] == Part::component;
    const Eigen::Vector2d at = (place_of(cell).head<2>().cast<double>().array() + 0.5) * cells_.cell_mm;
    if (!covered && (at - middle).norm() <= load.radius_mm) pushed.push_back(e);
  }
  if (pushed.empty())
    throw Error(ErrorKind::invalid_input, "the load lies beside the component; move it nearer to its middle");
  std::vector<double> forces(3 * grid.corners(), 0.0);
  const Vec3 each = load.force_n / (4.0 * static_cast<double>(pushed.size())) * cells_.axis;
  for (const size_t e : pushed)
    for (int c = 0; c < 4; ++c) Eigen::Map<Vec3>(forces.data() + 3 * grid.corner_of_element(e, c)) += each;
  return forces;
}

std::vector<SeatedComponent::Motion> SeatedComponent::joint_motions(
    const ElasticGrid& grid, const std::vector<double>& displacements) const {
  std::vector<Motion> motions(columns());
  for (size_t column = 0; column < columns(); ++column) {
    const JointSpan& span = joints_[column];
    motions[column].known = span.begin > 0;
    if (span.begin == 0) continue;
    Vec3i place = place_of(column);
    place.z() = span.begin;
    motions[column].component_mm = mean_at(grid, displacements, place);
    place.z() = span.end;
    motions[column].bone_mm = mean_at(grid, displacements, place);
  }
  for (size_t e = 0; e < grid.elements(); ++e) {
    const size_t cell = cell_of(grid, e);
    if (parts_[cell] != Part::joint) continue;
    const Vec3 normal = cells_.normals[cell % columns()].cast<double>();
    const Mat3 change = gradient(corner_displacements(grid, e, displacements), cells_.cell_mm);
    motions[cell % columns()].pull +=
        double{moduli_mpa_[cell]} * stress_along(normal, change, materials_.poisson);
  }
  return motions;
}

void SeatedComponent::describe(const ElasticGrid& grid, const std::vector<double>& displacements,
                               const std::vector<uint8_t>& open, ThreadPool& pool,
                               SeatResponse& response) const {
  const std::vector<float> strains = effective_strains(grid, materials_.poisson, displacements, pool);
  response.effective_strain.assign(parts_.size(), 0.0f);
  std::vector<uint8_t> covered(columns(), 0);
  for (size_t e = 0; e < strains.size(); ++e) {
    const size_t cell = cell_of(grid, e);
    if (parts_[cell] != Part::component) response.effective_strain[cell] = strains[e];
    if (parts_[cell] == Part::component) covered[cell % columns()] = 1;
  }
  response.motion_mm.assign(columns(), std::numeric_limits<float>::quiet_NaN());
  response.carrying.assign(columns(), 0);
  const std::vector<Motion> motions = joint_motions(grid, displacements);
  for (size_t column = 0; column < columns(); ++column) {
    if (!motions[column].known) continue;
    response.motion_mm[column] =
        static_cast<float>((motions[column].component_mm - motions[column].bone_mm).norm());
    response.carrying[column] = open[column] == 0;
  }
  const auto count = [](const std::vector<uint8_t>& of) {
    return static_cast<double>(std::count(of.begin(), of.end(), uint8_t{1}));
  };
  response.carrying_share = count(response.carrying) / count(covered);
  std::vector<double> forces(displacements.size());
  ElasticOperator<double>(grid, materials_.poisson).apply_with_reactions(displacements, forces, pool);
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    if (grid.is_held(corner, 0))
      response.held_n -= cells_.axis.dot(Eigen::Map<const Vec3>(forces.data() + 3 * corner));
}

SeatedComponent::Opened SeatedComponent::opened(const std::vector<Motion>& motions,
                                                const std::vector<uint8_t>& open) const {
  Opened next;
  next.columns = open;
  for (size_t column = 0; column < columns(); ++column) {
    const Motion& motion = motions[column];
    if (!motion.known) continue;
    const Vec3 normal = cells_.normals[column].cast<double>();
    const bool apart = normal.dot(motion.component_mm - motion.bone_mm) < 0.0;
    next.columns[column] = open[column] != 0 ? apart : motion.pull > 0.0;
    next.changed += next.columns[column] != open[column];
    next.closed += next.columns[column] == 0;
    ++next.joints;
  }
  return next;
}

SeatResponse SeatedComponent::respond(const SeatLoad& load, const SolverLimits& limits, ThreadPool& pool,
                                      const Progress& progress) const {
  SeatResponse response;
  SolverLimits now = limits;
  now.tolerance = std::max(limits.tolerance, rough_tolerance);
  std::vector<uint8_t> open(columns(), 0);
  LatticeField field(cells_.dims);
  while (true) {
    constexpr double a_round = 1.0 / max_rounds;
    const ElasticGrid grid = grid_of(open);
    const std::vector<double> forces = forces_of(load, grid);
    const Solution solution =
        solve(grid, materials_.poisson, field.at_corners(grid), now, pool,
              part_of(progress, response.rounds * a_round, (response.rounds + 1) * a_round), forces);
    field.keep(grid, solution.displacements_mm);
    response.converged = solution.converged;
    response.iterations += solution.iterations;
    ++response.rounds;
    const Opened next = opened(joint_motions(grid, solution.displacements_mm), open);
    const bool steady = static_cast<double>(next.changed) <= settled_share * static_cast<double>(next.joints);
    response.settled = steady && now.tolerance <= limits.tolerance;
    if (response.settled || response.rounds == max_rounds || next.closed == 0) {
      response.sinking_mm =
          std::inner_product(forces.begin(), forces.end(), solution.displacements_mm.begin(), 0.0) /
          load.force_n;
      describe(grid, solution.displacements_mm, open, pool, response);
      return response;
    }
    if (steady || response.rounds + 1 == max_rounds) now.tolerance = limits.tolerance;
    open = next.columns;
  }
}

}  // namespace ream::solve
