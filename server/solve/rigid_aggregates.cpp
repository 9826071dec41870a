#include "solve/rigid_aggregates.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "solve/box_element.hpp"
#include "solve/parallel_vectors.hpp"
#include "solve/sets.hpp"

namespace ream::solve {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Motion = Eigen::Matrix<double, 3, 6>;  ///< of a point, by shift and turn

/// Of the direct solution, which takes some seconds then; see cost_of().
constexpr double max_cost = 3e10;
constexpr double max_aggregates = 40000.0;
constexpr size_t aggregates_in_part = 64;

/// Grows as the time for factors does, which was measured for blocks and for networks of struts.
/// `neighbours`: blocks of a row.
double cost_of(double aggregates, double neighbours) {
  return aggregates * std::sqrt(aggregates) * std::pow(neighbours, 6);
}

Eigen::Matrix3d cross(const Vec3& d) {
  Eigen::Matrix3d m;
  m << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
  return m;
}

/// Displacement shift + turn x d.
Motion motion_at(const Vec3& d) {
  Motion motion;
  motion << Eigen::Matrix3d::Identity(), -cross(d);
  return motion;
}

/// Motion about another place, `by` before the first one.
Mat6 moved(const Vec3& by) {
  Mat6 m = Mat6::Identity();
  m.topRightCorner<3, 3>() = -cross(by);
  return m;
}

std::array<size_t, 8> corners_of(const ElasticGrid& grid, size_t element) {
  std::array<size_t, 8> corners;
  for (int c = 0; c < 8; ++c) corners[static_cast<size_t>(c)] = grid.corner_of_element(element, c);
  return corners;
}

/// Which aggregate each corner belongs to, and where each lies on the lattice.
struct Aggregates {
  std::vector<uint32_t> of_corner;
  std::vector<Vec3> centres;
};

Aggregates aggregates_of(const ElasticGrid& grid, int edge) {
  std::vector<uint32_t> block(grid.corners());
  const Vec3i blocks = grid.dims() / edge + Vec3i::Ones();
  for (size_t corner = 0; corner < grid.corners(); ++corner) {
    const Vec3i at = grid.place_of(corner) / edge;
    block[corner] = static_cast<uint32_t>(at.x() + blocks.x() * (at.y() + blocks.y() * at.z()));
  }
  Sets sets(grid.corners());
  for (size_t e = 0; e < grid.elements(); ++e) {
    const auto corners = corners_of(grid, e);
    // Neighbours along the element's edges are enough.
    for (size_t c = 0; c < 8; ++c)
      for (const size_t bit : {1u, 2u, 4u})
        if ((c & bit) == 0 && block[corners[c]] == block[corners[c | bit]])
          sets.join(static_cast<uint32_t>(corners[c]), static_cast<uint32_t>(corners[c | bit]));
  }
  Aggregates found;
  found.of_corner.resize(grid.corners());
  std::vector<size_t> sizes;
  for (size_t corner = 0; corner < grid.corners(); ++corner) {
    const uint32_t first = sets.find(static_cast<uint32_t>(corner));
    if (first == corner) {
      found.of_corner[corner] = static_cast<uint32_t>(sizes.size());
      sizes.push_back(0);
      found.centres.push_back(Vec3::Zero());
    }
    const uint32_t aggregate = found.of_corner[corner] = found.of_corner[first];
    found.centres[aggregate] += grid.place_of(corner).cast<double>();
    ++sizes[aggregate];
  }
  for (size_t i = 0; i < sizes.size(); ++i) found.centres[i] /= static_cast<double>(sizes[i]);
  return found;
}

using Blocks = std::unordered_map<uint64_t, Mat6>;  ///< by the greater number and the smaller

/// Sums what elements add to the stiffness between aggregates.
class Assembly {
 public:
  Assembly(const ElasticGrid& grid, const Aggregates& aggregates, double poisson, double length)
      : grid_(grid), aggregates_(aggregates), box_(grid.cell_mm(), poisson), length_(length) {}

  Blocks run() {
    for (uint32_t i = 0; i < aggregates_.centres.size(); ++i) blocks_[key(i, i)] = Mat6::Zero();
    for (size_t e = 0; e < grid_.elements(); ++e) add(e);
    return std::move(blocks_);
  }

 private:
  static uint64_t key(uint32_t a, uint32_t b) { return uint64_t{std::max(a, b)} << 32 | std::min(a, b); }

  void add(size_t element) {
    const auto corners = corners_of(grid_, element);
    std::array<uint32_t, 8> of{};
    bool held = false;
    for (size_t c = 0; c < 8; ++c) {
      of[c] = aggregates_.of_corner[corners[c]];
      held = held || grid_.held()[corners[c]] != 0;
    }
    // A rigid motion strains nothing.
    if (!held && std::all_of(of.begin(), of.end(), [&](uint32_t a) { return a == of[0]; })) return;
    const Vec3 origin = grid_.place_of(corners[0]).cast<double>();
    std::array<uint8_t, 8> sets{};
    std::array<uint32_t, 8> list{};
    size_t count = 0;
    for (size_t c = 0; c < 8; ++c) {
      const auto at =
          static_cast<size_t>(std::find(list.begin(), list.begin() + count, of[c]) - list.begin());
      if (at == count) list[count++] = of[c];
      sets[at] = static_cast<uint8_t>(sets[at] | 1u << c);
    }
    std::array<uint8_t, 8> held_bits{};
    if (held)
      for (size_t c = 0; c < 8; ++c) held_bits[c] = grid_.held()[corners[c]];
    for (size_t i = 0; i < count; ++i)
      for (size_t j = 0; j <= i; ++j) {
        const uint32_t a = list[i], b = list[j];
        const bool turned = a < b;  // the block of the greater number's row
        const size_t row = turned ? j : i, column = turned ? i : j;
        const Mat6 between =
            held ? summed(sets[row], sets[column], held_bits) : cached(sets[row], sets[column]);
        blocks_.try_emplace(key(a, b), Mat6::Zero()).first->second += double{grid_.moduli_mpa()[element]} *
                                                                      shift(list[row], origin).transpose() *
                                                                      between * shift(list[column], origin);
      }
  }

  Mat6 shift(uint32_t aggregate, const Vec3& origin) const {
    return moved((origin - aggregates_.centres[aggregate]).cwiseProduct(grid_.cell_mm()) / length_);
  }

  const Mat6& cached(uint8_t rows, uint8_t columns) {
    const auto [at, is_new] = cache_.try_emplace(static_cast<uint16_t>(rows << 8 | columns));
    if (is_new) at->second = summed(rows, columns, {});
    return at->second;
  }

  /// Sum over corners i of `rows` and j of `columns` of motion_i^T K_ij motion_j, about corner 0.
  Mat6 summed(uint8_t rows, uint8_t columns, const std::array<uint8_t, 8>& held) const {
    const auto motions = [&](uint8_t set) {
      Eigen::Matrix<double, 24, 6> all = Eigen::Matrix<double, 24, 6>::Zero();
      for (Eigen::Index c = 0; c < 8; ++c) {
        if ((set >> c & 1) == 0) continue;
        const Vec3 at =
            Vec3(static_cast<double>(c & 1), static_cast<double>(c >> 1 & 1), static_cast<double>(c >> 2 & 1))
                .cwiseProduct(grid_.cell_mm()) /
            length_;
        all.middleRows<3>(3 * c) = motion_at(at);
        for (Eigen::Index k = 0; k < 3; ++k)
          if ((held[static_cast<size_t>(c)] >> k & 1) != 0) all.row(3 * c + k).setZero();
      }
      return all;
    };
    return motions(rows).transpose() * box_.stiffness * motions(columns);
  }

  const ElasticGrid& grid_;
  const Aggregates& aggregates_;
  const BoxElement box_;
  const double length_;
  std::unordered_map<uint16_t, Mat6> cache_;
  Blocks blocks_;
};

/// Its lower triangle.
Eigen::SparseMatrix<double> sparse(const Blocks& blocks, size_t aggregates) {
  const auto size = static_cast<Eigen::Index>(6 * aggregates);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * blocks.size());
  double greatest = 0.0;
  for (const auto& [key, block] : blocks)
    if (key >> 32 == (key & 0xffffffffu)) greatest = std::max(greatest, block.diagonal().maxCoeff());
  for (const auto& [key, block] : blocks) {
    const auto row = static_cast<Eigen::Index>(6 * (key >> 32));
    const auto column = static_cast<Eigen::Index>(6 * (key & 0xffffffffu));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        if (row + i < column + j) continue;
        // What nobody holds may move as a whole, and a few corners in a row turn about themselves.
        const bool none = block(i, j) < 1e-14 * greatest;
        const double own = row + i != column + j ? 0.0 : none ? greatest : 1e-11 * block(i, j);
        entries.emplace_back(row + i, column + j, block(i, j) + own);
      }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

struct RigidAggregates::Parts {
  Parts(const ElasticGrid& given, double poisson, int edge, const Progress& progress) : grid(given) {
    while (const int next = next_edge(edge, poisson, progress)) edge = next;
    scale = grid.cell_mm() / length_mm;
    list_members();
  }

  /// Takes blocks of so many places along each edge: 0 where that is done, else the edge to try next.
  int next_edge(int edge, double poisson, const Progress& progress) {
    progress(0.0, "preparing");
    aggregates = aggregates_of(grid, edge);
    length_mm = edge * grid.cell_mm().mean();
    const auto count = static_cast<double>(aggregates.centres.size());
    const bool last = edge > grid.dims().maxCoeff();
    double cost = max_cost * std::pow(count / max_aggregates, 1.5);
    if (count <= max_aggregates || last) {
      const Blocks blocks = Assembly(grid, aggregates, poisson, length_mm).run();
      progress(0.0, "preparing");
      cost = cost_of(count, static_cast<double>(blocks.size()) / count);
      if (cost <= max_cost || last) {
        factors.compute(sparse(blocks, aggregates.centres.size()));
        if (factors.info() != Eigen::Success)
          throw Error(ErrorKind::unavailable, "the stiffness between pieces of bone cannot be factorised");
        return 0;
      }
    }
    // There are fewer as the cube of the edge, and each has about as many neighbours.
    return std::max(edge + 1, static_cast<int>(std::ceil(edge * std::pow(cost / max_cost, 1.0 / 4.5))));
  }

  /// From the aggregate's centre.
  Vec3 arm(size_t corner) const {
    const Vec3& centre = aggregates.centres[aggregates.of_corner[corner]];
    return (grid.place_of(corner).cast<double>() - centre).cwiseProduct(scale);
  }

  std::span<const uint32_t> corners_of(size_t aggregate) const {
    return std::span(members).subspan(begins[aggregate], begins[aggregate + 1] - begins[aggregate]);
  }

  Vec3 but_held(size_t corner, Vec3 values) const {
    for (int k = 0; k < 3; ++k)
      if (grid.is_held(corner, k)) values[k] = 0.0;
    return values;
  }

  /// Corners by the aggregate that they belong to.
  void list_members() {
    begins.assign(aggregates.centres.size() + 1, 0);
    for (const uint32_t aggregate : aggregates.of_corner) ++begins[aggregate + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    members.resize(aggregates.of_corner.size());
    std::vector<uint32_t> next(begins.begin(), begins.end() - 1);
    for (size_t corner = 0; corner < members.size(); ++corner)
      members[next[aggregates.of_corner[corner]]++] = static_cast<uint32_t>(corner);
  }

  const ElasticGrid& grid;
  Aggregates aggregates;
  std::vector<uint32_t> members;
  std::vector<uint32_t> begins;  ///< in members, of each aggregate, and the end
  double length_mm = 1.0;
  Vec3 scale = Vec3::Ones();  ///< of arms: cells in lengths
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
};

RigidAggregates::RigidAggregates(const ElasticGrid& grid, double poisson, int min_edge,
                                 const Progress& progress)
    : parts_(std::make_unique<Parts>(grid, poisson, min_edge, progress)) {}

RigidAggregates::~RigidAggregates() = default;

void RigidAggregates::add_correction(std::span<const double> residual, std::span<double> correction,
                                     ThreadPool& pool) const {
  const Parts& parts = *parts_;
  std::vector<double> motions(6 * count());
  for_parts(
      pool, count(),
      [&](size_t begin, size_t end) {
        for (size_t aggregate = begin; aggregate < end; ++aggregate) {
          Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
          for (const size_t corner : parts.corners_of(aggregate)) {
            const Vec3 arm = parts.arm(corner), f = parts.but_held(corner, Vec3(&residual[3 * corner]));
            force += f;
            moment += arm.cross(f);
          }
          std::copy_n(force.data(), 3, &motions[6 * aggregate]);
          std::copy_n(moment.data(), 3, &motions[6 * aggregate + 3]);
        }
      },
      aggregates_in_part);
  balance(motions);
  pool.run(static_cast<size_t>(parts.grid.dims().z()) + 1, [&](size_t layer, int) {
    const auto corners = parts.grid.layer_corners();
    for (size_t corner = corners[layer]; corner < corners[layer + 1]; ++corner) {
      const double* motion = &motions[6 * size_t{parts.aggregates.of_corner[corner]}];
      const Vec3 shift(motion), turn(motion + 3);
      const Vec3 moved_by = parts.but_held(corner, shift + turn.cross(parts.arm(corner)));
      for (int k = 0; k < 3; ++k) correction[3 * corner + static_cast<size_t>(k)] += moved_by[k];
    }
  });
}

void RigidAggregates::balance(std::span<double> motions) const {
  Eigen::Map<Eigen::VectorXd> numbers(motions.data(), static_cast<Eigen::Index>(motions.size()));
  numbers = parts_->factors.solve(numbers).eval();
}

RigidAggregates::Lists RigidAggregates::lists() const {
  return {parts_->members, parts_->begins, parts_->aggregates.of_corner, parts_->aggregates.centres,
          parts_->scale};
}

size_t RigidAggregates::count() const { return parts_->aggregates.centres.size(); }

}  // namespace ream::solve
