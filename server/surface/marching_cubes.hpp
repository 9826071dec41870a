#pragma once
#include <array>
#include <cstdint>

namespace ream::surface {

/// Numbering of a cell. Corner c is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e runs along axis a = e / 4 from
/// its lower corner, whose coordinates along the axes (a + 1) % 3 and (a + 2) % 3 are the bits 0 and 1 of e
/// % 4.
struct CellEdge {
  int axis;
  std::array<int, 3> lower_corner;
};
CellEdge cell_edge(int edge);

/// Triangles of one of the 256 cells, as cell edges, counter-clockwise seen from the empty side.
struct CellCase {
  uint8_t triangle_count = 0;
  std::array<std::array<uint8_t, 3>, 5> triangles{};
};

/// Case i has the corners filled whose bit is set in i.
///
/// The table is derived, not typed: on each face the contour cuts off every run of filled corners by itself
/// (so two filled corners across a face's diagonal stay apart), which depends on the face alone and is
/// therefore the same for both cells that share it. The contours of the six faces join to closed loops, and
/// each loop is triangulated without any diagonal inside a face. So over a whole grid each edge lies in
/// exactly two triangles: the surface is a closed 2-manifold whatever the volume.
const std::array<CellCase, 256>& cell_cases();

}  // namespace ream::surface
