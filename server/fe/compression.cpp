#include "fe/compression.hpp"

#include "fe/number_text.hpp"

namespace ream::fe {
namespace {

/// Nodes that stop a body on a sliding platen from drifting and from turning.
struct Pins {
  uint64_t held = 0, guided = 0;
};

/// The least face's first node, and the farthest from it along the first axis across among those level with
/// it along the second.
Pins pins_on(const NodeNumbering& numbering, int axis) {
  const int along = (axis + 1) % 3, level = (axis + 2) % 3;
  Pins pins;
  Vec3i held = Vec3i::Zero();
  int farthest = 0;
  for_each_face_node(numbering, [&](int face, const Vec3i& corner, uint64_t id) {
    if (face != 2 * axis) return;
    if (pins.held == 0) {
      pins.held = id;
      held = corner;
    }
    const int distance = std::abs(corner[along] - held[along]);
    if (corner[level] != held[level] || distance <= farthest) return;
    farthest = distance;
    pins.guided = id;
  });
  return pins;
}

std::string fixed(const std::string& nodes, int direction, const std::string& value = "0.0") {
  const std::string d = std::to_string(direction + 1);
  return nodes + ", " + d + ", " + d + ", " + value + "\n";
}

}  // namespace

double compression_mm(const Compression& compression, const NodeNumbering& numbering,
                      const Vec3& spacing_mm) {
  const MeshBounds bounds = bounds_of(numbering.mask());
  const int axis = compression.axis;
  return compression.strain * (bounds.greatest[axis] - bounds.least[axis]) * spacing_mm[axis];
}

std::string compression_text(const Compression& compression, const NodeNumbering& numbering,
                             const Vec3& spacing_mm) {
  const int axis = compression.axis;
  const std::string base = face_names[static_cast<size_t>(2 * axis)],
                    top = face_names[static_cast<size_t>(2 * axis + 1)];
  std::string text = "*BOUNDARY\n" + fixed(base, axis);
  for (const int across : {(axis + 1) % 3, (axis + 2) % 3})
    if (compression.fixed_platens) text += fixed(base, across) + fixed(top, across);
  if (!compression.fixed_platens) {
    const Pins pins = pins_on(numbering, axis);
    text += fixed(std::to_string(pins.held), (axis + 1) % 3) +
            fixed(std::to_string(pins.held), (axis + 2) % 3) +
            fixed(std::to_string(pins.guided), (axis + 2) % 3);
  }
  text += "*STEP\n*STATIC\n*BOUNDARY\n" +
          fixed(top, axis, real_text(-compression_mm(compression, numbering, spacing_mm)));
  for (const std::string& face : {base, top}) text += "*NODE PRINT, NSET=" + face + ", TOTALS=ONLY\nRF\n";
  return text + "*NODE FILE\nU\n*EL FILE\nS, E\n*END STEP\n";
}

}  // namespace ream::fe
