#pragma once
#include "core/progress.hpp"
#include "geometry/triangle_mesh.hpp"
#include "voxelizer/voxel_set.hpp"

namespace ream::voxelizer {

/// Throws Error invalid_input unless every edge belongs to an even number of triangles, which is what parity
/// needs: holes, not cavities, crossings or doubled faces. Says how many edges are open and where the first
/// one is.
void require_closed(const TriangleMesh& mesh, double scale);

/// What to mark. With both, the solid and its surface.
struct Request {
  bool surface = true;
  Separability separability = Separability::twenty_six;
  /// Voxels whose centre lies inside, by the parity of crossings along x: cavities stay empty. The mesh must
  /// be closed (require_closed()), else rows run out of it.
  bool solid = false;
  double scale = 1.0;  ///< mm for one unit of the mesh's coordinates
};

/// Marks voxels in C++ on several threads. Tiles of the grid are worked on one by one by the triangles that
/// may touch them; the result does not depend on threads or tiles.
class Voxelizer {
 public:
  explicit Voxelizer(int threads = 0) : pool_(threads) {}

  /// Replaces what `set` holds. The mesh and its reach must have been checked (used_bounds, check_reach).
  /// `progress` may throw.
  void voxelize(const TriangleMesh& mesh, const Request& request, VoxelSet& set,
                const Progress& progress = no_progress);

 private:
  ThreadPool pool_;
};

/// Tiles as the C++ form cuts a set's grid: what fits in a processor's second cache.
TilePlan default_tiles(const VoxelSet& set, int threads);

}  // namespace ream::voxelizer
