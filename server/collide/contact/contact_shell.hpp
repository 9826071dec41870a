#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "shell/point_shell.hpp"

namespace ream::collide {

/// What an engaged point adds to the sums, before its weight: unit normal n in 1/127 and the x and y of its
/// moment arm (r x n) / moment length in 1/127. The arm has no z: a normal of the swept envelope, a surface
/// of revolution, meets the axis.
struct ContactVector {
  std::array<int32_t, 5> g{};
  int32_t cosine = 0, sine = 0;  ///< of the angle about the axis, in 1/127
  int32_t weight = 0;            ///< cutting edge for cutting points, area for others; 1 to 255
  int32_t area = 0;  ///< in 1/16 cell face, 16 to 28; 0 where the edge of a point has no room left
};

/// Direction codes: the meridian entry (normal and arm in the half plane through the axis) above ten bits of
/// angle about the axis. Two small tables and integer products give the vector on every device.
inline constexpr int azimuth_bits = 10;
inline constexpr uint32_t azimuth_count = 1u << azimuth_bits;
inline constexpr uint32_t max_meridian_entries = 2048;
inline constexpr int azimuth_shift = 14;

struct DirectionTable {
  /// A byte each, lowest first: radial and axial normal, arm about the tangent (signed), weight.
  std::vector<uint32_t> meridian;
  std::vector<uint32_t> areas;  ///< of the meridian entries
  /// cos, then sin in the high half, signed, in 2^-14.
  std::vector<uint32_t> azimuth;

  ContactVector vector(uint32_t direction) const noexcept;
};

/// A meridian entry packed.
constexpr uint32_t meridian_entry(int normal_radial, int normal_z, int arm, int weight) {
  return (static_cast<uint32_t>(normal_radial) & 0xff) | (static_cast<uint32_t>(normal_z) & 0xff) << 8 |
         (static_cast<uint32_t>(arm) & 0xff) << 16 | static_cast<uint32_t>(weight) << 24;
}

/// The azimuth half of the table.
std::vector<uint32_t> azimuth_table();

/// Sums over points of w g_i g_j (upper triangle of 5 x 5, row by row), then w g_i, w times cosine and sine,
/// w, and the area. A block's stay within 32 bits: 512 points of weight 255 and components 127.
using ContactProducts = std::array<int32_t, 24>;
void add_products(const ContactVector& v, ContactProducts& sums) noexcept;

inline ContactVector DirectionTable::vector(uint32_t direction) const noexcept {
  const uint32_t m = meridian[direction >> azimuth_bits], a = azimuth[direction & (azimuth_count - 1)];
  const auto signed_byte = [m](int shift) { return static_cast<int32_t>(static_cast<int8_t>(m >> shift)); };
  const int32_t radial = signed_byte(0), axial = signed_byte(8), arm = signed_byte(16);
  const int32_t cosine = static_cast<int16_t>(a), sine = static_cast<int16_t>(a >> 16);
  const auto turned = [](int32_t product) { return (product + (1 << (azimuth_shift - 1))) >> azimuth_shift; };
  return {{turned(radial * cosine), turned(radial * sine), axial, turned(arm * sine), turned(-arm * cosine)},
          turned(127 * cosine),
          turned(127 * sine),
          static_cast<int32_t>(m >> 24),
          static_cast<int32_t>(areas[direction >> azimuth_bits])};
}

/// Points looked at together, as one vector: consecutive ones of a block, whose last chunk may have fewer.
inline constexpr int chunk_points = 16;
inline constexpr int max_block_points = 512;
inline constexpr int max_block_chunks = max_block_points / chunk_points;

/// Probes of one 8^3-cell block of the PointShell, or of a few small ones side by side, that are all cutting
/// or all guiding.
struct ContactBlock {
  uint32_t first = 0;  ///< of its points
  uint16_t count = 0;
  uint16_t guiding = 0;         ///< 1: guiding or smooth surface, which never cuts
  Vec3i origin_units{0, 0, 0};  ///< of its points' places, tool frame, in place_unit_mm
  int32_t height_units = 0;     ///< greatest place along z
  ContactProducts whole{};      ///< of all its points
};

/// When a cutting point feels bone.
enum class ContactRule {
  /// When the surface that it lies on meets the bone's (collide/contact/surface_judge.hpp).
  at_surface,
  /// When the voxel one voxel out along its normal is solid: for removal by decay, which takes the voxels
  /// that
  /// points lie in and would clear its own contact.
  one_voxel_out,
};

/// A PointShell made ready for one grid: where each point probes for bone and what it adds when it meets
/// some. Ten bytes a point and less than two for its block. Read-only, shared by all narrow phases.
///
/// Cutting points probe on the true surface; within three quarters of a voxel of the rim, that much inside
/// it, since bone beside the rim is never cut and shall not be felt as if it were under it. Guiding points
/// probe one voxel below the surface, end faces also two nearer to the axis: corners of voxels, which stand
/// out by up to 0.87 edges, shall not stop a nipple at the mouth of a hole that is barely wider, and its side
/// meets the wall of the hole before its end does.
///
/// Cutting points count by the cutting edge that passes over them, not by their area: the lips pass a place
/// at radius r lip_count times a turn, so edge per area is lip_count / (2 pi r) (mechanics of reaming: a chip
/// is as thick whatever the radius). Their weight is area times edge_radius_mm / r. Where that is more than a
/// byte holds, close to the axis, further points stand in the same place.
struct ContactShell {
  /// Places in a block, nine bits each for x, y, z (x lowest) in place_unit_mm from the block's origin, then
  /// the five high bits of the direction code. Padded by a chunk, as the directions, to be read in chunks.
  std::vector<uint32_t> places;
  std::vector<uint16_t> directions;  ///< low sixteen bits of the direction code
  /// Where bone's surface decides: the unit normal, tool frame, in 1/127, a signed byte each, x lowest. 0 for
  /// points that meet whatever voxel they probe. The highest byte is the weight. Padded as the places.
  std::vector<uint32_t> normals;
  std::vector<ContactBlock> blocks;
  std::vector<uint32_t> first_chunks;  ///< of the blocks, and one more: the number of chunks
  /// Bounding spheres of the blocks' probes, tool frame, mm; struct of arrays for the culling.
  std::vector<float> centre_x_mm, centre_y_mm, centre_z_mm, radius_mm;
  DirectionTable table;
  double place_unit_mm = 0.0;
  double moment_length_mm = 1.0;
  double cell_area_mm2 = 0.0;
  double probe_length_mm = 0.0;
  Aabb bounds_mm;

  size_t size() const { return places.size() - chunk_points; }
  size_t chunk_count() const { return first_chunks.back(); }
  /// Direction code of a point.
  uint32_t direction(size_t point) const { return directions[point] | (places[point] >> 27) << 16; }
  /// Where a point of a block probes, tool frame.
  Vec3 probe_mm(const ContactBlock& block, size_t point) const;
  /// Bytes held.
  size_t bytes() const;
};

inline constexpr int place_bits = 9;
inline constexpr uint32_t place_mask = (1u << place_bits) - 1;

/// At this radius a point's edge weight is its area.
inline constexpr double edge_radius_mm = 20.0;

/// `probe_length_mm`: the grid's largest voxel edge.
ContactShell make_contact_shell(const shell::PointShell& shell, double probe_length_mm,
                                ContactRule rule = ContactRule::at_surface);

}  // namespace ream::collide
