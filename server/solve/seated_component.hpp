#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "solve/conjugate_gradients.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

/// A component that stands on bone, in cubes. z goes into the bone; all arrays x fastest.
struct SeatedCells {
  Vec3i dims = Vec3i::Zero();
  double cell_mm = 1.0;
  std::vector<float> bone_share;   ///< of each cell's volume, 0 to 1
  std::vector<float> bone_mpa;     ///< modulus of the bone in it
  std::vector<uint8_t> component;  ///< 1: the cell is the component's; not at the sides of the box
  std::vector<uint8_t> supported;  ///< of each column (x, y): 1 where bone lies against its back
  std::vector<Vec3f> normals;      ///< of the back in each column, unit, into the bone
  std::vector<uint8_t> held;       ///< of each cell: 1 where bone goes on that is not here; empty: nowhere
  Vec3 axis = Vec3::UnitZ();       ///< of the component, unit, into the bone
};

struct SeatMaterials {
  double component_mpa = 600.0;  ///< polyethylene, as its makers give it (500 to 1000)
  double cement_mpa = 2000.0;    ///< fills what bone leaves of a cell between component and bone
  double poisson = 0.3;          ///< of all of them
};

/// A force along the component's axis, spread evenly over a disc of its front.
struct SeatLoad {
  double x_mm = 0.0, y_mm = 0.0;  ///< middle of the disc, from the box's corner
  double radius_mm = 5.0;
  double force_n = 750.0;
};

struct SeatResponse {
  bool converged = false;  ///< the last solution
  bool settled = false;    ///< which places of the joint are open no longer changes
  int rounds = 0, iterations = 0;
  double held_n = 0.0;      ///< against the load, at the box's sides; in balance as large as the load
  double sinking_mm = 0.0;  ///< of where the load acts, along the component's axis
  /// Of the columns that the component has.
  double carrying_share = 0.0;
  /// Of each column with a joint, NaN elsewhere: how far its two sides move against each other, mm; where it
  /// carries, that is how far it is squeezed.
  std::vector<float> motion_mm;
  std::vector<uint8_t> carrying;        ///< of each column: 1 where the joint is pressed
  std::vector<float> effective_strain;  ///< of each cell of bone and joint; 0 elsewhere
};

/// A component on bone under load. Between them lies a joint, one cell thick, that carries where it is
/// pressed along the component's axis, and nothing where it would be pulled: which is which is found in
/// rounds. Where it is pressed it does not slip. Bone is held at the sides of the box, at its far end, and in
/// `held` cells.
class SeatedComponent {
 public:
  /// Bone that hangs together with nothing that is held is left out. Errors: usage for a Poisson's ratio over
  /// 0.49; invalid_input where the component stands on nothing that is held, and for a modulus that is not
  /// between 1e-9 and 1e12 MPa.
  SeatedComponent(SeatedCells cells, const SeatMaterials& materials);

  /// Errors: invalid_input where the disc misses the component; those of solve(). What does not converge or
  /// settle is told, not thrown.
  SeatResponse respond(const SeatLoad& load, const SolverLimits& limits, ThreadPool& pool,
                       const Progress& progress = no_progress) const;

  /// With a closed joint.
  size_t elements() const { return elements_; }

 private:
  enum class Part : uint8_t { none, bone, component, joint };
  /// Where the joint of a column begins and ends: layers of the lattice; begin 0: there is none.
  struct JointSpan {
    int begin = 0, end = 0;
  };
  /// Of the joint in a column.
  struct Motion {
    bool known = false;                                        ///< there is one
    Vec3 component_mm = Vec3::Zero(), bone_mm = Vec3::Zero();  ///< of its two sides
    double pull = 0.0;  ///< across it, while it is closed; negative: pressure. Any unit
  };

  /// Which columns of the joint are open, by how those of the last round have moved.
  struct Opened {
    std::vector<uint8_t> columns;
    size_t joints = 0, closed = 0, changed = 0;
  };

  void find_joint();
  void find_spans();
  void leave_out_loose_bone();
  void hold(ElasticGrid& grid) const;
  ElasticGrid grid_of(const std::vector<uint8_t>& open) const;
  std::vector<double> forces_of(const SeatLoad& load, const ElasticGrid& grid) const;
  std::vector<Motion> joint_motions(const ElasticGrid& grid, const std::vector<double>& displacements) const;
  Opened opened(const std::vector<Motion>& motions, const std::vector<uint8_t>& open) const;
  void describe(const ElasticGrid& grid, const std::vector<double>& displacements,
                const std::vector<uint8_t>& open, ThreadPool& pool, SeatResponse& response) const;

  size_t index(const Vec3i& p) const {
    return static_cast<size_t>(p.x()) +
           static_cast<size_t>(cells_.dims.x()) *
               (static_cast<size_t>(p.y()) +
                static_cast<size_t>(cells_.dims.y()) * static_cast<size_t>(p.z()));
  }
  size_t columns() const {
    return static_cast<size_t>(cells_.dims.x()) * static_cast<size_t>(cells_.dims.y());
  }
  Vec3i place_of(size_t cell) const;
  size_t cell_of(const ElasticGrid& grid, size_t element) const;

  SeatedCells cells_;
  SeatMaterials materials_;
  std::vector<Part> parts_;        ///< of each cell
  std::vector<float> moduli_mpa_;  ///< of each cell, with a closed joint
  size_t elements_ = 0;
  std::vector<JointSpan> joints_;  ///< of each column
};

}  // namespace ream::solve
