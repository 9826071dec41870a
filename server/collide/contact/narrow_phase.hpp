#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "collide/contact/broad_phase.hpp"
#include "collide/contact/contact_shell.hpp"
#include "collide/grid_transform.hpp"
#include "voxel/bone_model.hpp"
#include "voxel/brick_distance.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::collide {

/// What bone of each density code resists, in any unit: 0 to 4095.
using ResistanceTable = std::array<uint32_t, 256>;
inline constexpr ResistanceTable no_resistances{};

/// Exact integer sums over the engaged points: equal on every device and in any order. With weights up to
/// 255, components up to 127 and 2 M points the products stay below 2^43.
struct ContactSums {
  struct Part {
    int64_t points = 0;
    /// Sum of w g_i over the normal and the moment arm (1/127 each), then sum of w.
    std::array<int64_t, 7> first{};
    /// Sum of w times cosine and sine (1/127) of the angle about the axis.
    std::array<int64_t, 2> around{};
    int64_t area = 0;  ///< in 1/16 cell face
    /// Sum of w g_i g_j, upper triangle row by row: 00 01 .. 05 11 12 .. 55. Those with the arm about the
    /// tool's axis (5) are zero while the shell is an envelope (collide/contact/contact_shell.hpp).
    std::array<int64_t, 21> second{};
    bool operator==(const Part&) const = default;
  };
  Part cutting, guiding;
  /// Weights of the engaged cutting points, and weights times density codes, by voxel::BoneClass. Cartilage
  /// counts its code.
  std::array<int64_t, voxel::bone_class_count> class_weight{}, class_density{};
  int64_t resistance = 0;  ///< sum of their weights times the ResistanceTable's entries
  /// The engaged cutting point farthest along the feed axis, the lowest numbered of equals: its height (tool
  /// frame z, in the shell's place_unit_mm) above 32 bits of the complement of its number; no_point when
  /// nothing cutting is engaged. Larger is deeper, so that a maximum combines them.
  static constexpr int64_t no_point = std::numeric_limits<int64_t>::min();
  int64_t deepest = no_point;

  static constexpr int64_t depth_key(int32_t height_units, uint32_t point) {
    return (static_cast<int64_t>(height_units) << 32) | (0xffffffffu - point);
  }
  int32_t deepest_height_units() const { return static_cast<int32_t>(deepest >> 32); }

  int64_t engaged() const { return cutting.points + guiding.points; }
  bool operator==(const ContactSums&) const = default;
};

/// Adds ContactProducts (collide/contact/contact_shell.hpp), of whatever integer type, of `points` points.
template <class Products>
void add_products_to(ContactSums::Part& part, const Products& products, int64_t points) noexcept {
  part.points += points;
  size_t k = 0;
  for (size_t i = 0; i < 5; ++i)
    for (size_t j = i; j < 5; ++j) part.second[i * 6 - i * (i - 1) / 2 + (j - i)] += products[k++];
  for (size_t i = 0; i < 5; ++i) part.first[i] += products[k++];
  for (int64_t& around : part.around) around += products[k++];
  part.first[6] += products[k++];
  part.area += products[k];
}

/// What the narrow phases share: the prepared shell, the bone they look at, and what culls. Bone and cells
/// are read live, so removal between two calls is seen. When a point is engaged: surface_judge.hpp.
struct NarrowPhaseInput {
  const ContactShell& shell;
  const voxel::BoneModel& bone;
  const voxel::BrickDistance& distance;
  const voxel::SolidCells& cells;
  const ResistanceTable& resistances = no_resistances;
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
