#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "collide/broad_phase.hpp"
#include "collide/contact_shell.hpp"
#include "collide/contact_sums.hpp"
#include "collide/voxel_transform.hpp"
#include "voxel/brick_distance.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::collide {

/// What the narrow phases share: the prepared shell, the bone they look at, and what culls. Bone and cells
/// are read live, so removal between two calls is seen. A point is engaged when its probe lies in a solid
/// voxel.
struct NarrowPhaseInput {
  const ContactShell& shell;
  const voxel::BoneModel& bone;
  const voxel::BrickDistance& distance;
  const voxel::SolidCells& cells;
};

/// Finds the engaged points of the shell. All memory is allocated at construction; contact() is called from
/// the tick.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;
  /// Sums at one pose. `voi` comes from the broad phase at the same pose. False when the device failed;
  /// `sums` is then not to be used.
  virtual bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept = 0;
  /// To be told of the bricks whose cells have changed since: devices with memory of their own follow. False
  /// when the device failed.
  virtual bool bricks_changed(std::span<const uint32_t>) noexcept { return true; }
};

/// The instructions a C++ narrow phase may use; results are the same bits.
enum class Instructions { best, portable };

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input,
                                                   Instructions instructions = Instructions::best);

}  // namespace ream::collide
