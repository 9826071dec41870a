#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/progress.hpp"
#include "fe/element_model.hpp"
#include "fe/materials.hpp"
#include "fe/mesh_writers.hpp"
#include "solve/conjugate_gradients.hpp"

namespace ream::solve {

/// A test of compression on voxels, each of them an element, between two platens that touch the bone's box at
/// both ends of an axis.
struct CompressionRequest {
  fe::MaterialRule rule;
  fe::Compression compression;
  bool keep_islands = false;
  SolverLimits limits;
  int threads = 2;
};

struct CompressionResult {
  size_t elements = 0, corners = 0;  ///< of what is loaded
  size_t unloaded_elements = 0;      ///< of parts that do not reach both platens
  fe::ComponentCount components;
  Vec3 box_mm = Vec3::Zero();  ///< around the elements
  double bone_share = 0.0;     ///< of the box
  double force_n = 0.0;        ///< on the platen that stands
  double unbalanced = 0.0;     ///< length of the forces that nothing holds, over that of the platens' own
  double modulus_mpa = 0.0;    ///< of the box: force over its area over the strain
  double voigt_mpa = 0.0;      ///< never exceeded; for fixed platens of a body that cannot expand sideways
  double reuss_mpa = 0.0;      ///< never undercut where every voxel of the box is bone; else 0
  /// Of the elements' effective strains, sqrt(2 energy / (volume modulus)) (Pistoia 2002): quantiles 0.5,
  /// 0.95, 0.99, and the greatest.
  std::array<double, 4> effective_strain{};
  int iterations = 0;
  double relative_residual = 0.0;
  bool converged = false;
  double build_s = 0.0, solve_s = 0.0;
};

/// Parts that do not reach both platens carry nothing and are left out. Errors: invalid_input where no part
/// does, for more than 2^31 places in the box and for moduli beyond 1e-9 to 1e12 MPa; usage for a strain and
/// a Poisson's ratio that cannot be (elements as these lock above 0.49); those of make_materials; what
/// `progress` throws. What does not converge is told, not thrown.
CompressionResult compress(fe::ElementModel model, const CompressionRequest& request, MemoryBudget& budget,
                           const Progress& progress = no_progress);

nlohmann::json to_json(const CompressionResult& result);

}  // namespace ream::solve
