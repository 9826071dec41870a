#include "surface/marching_cubes.hpp"

#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

namespace ream::surface {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();
using Loop = std::vector<int>;

int edge_between(int corner_a, int corner_b) {
  const int axis = (corner_a ^ corner_b) == 1 ? 0 : (corner_a ^ corner_b) == 2 ? 1 : 2;
  const int lower = corner_a & corner_b;
  return 4 * axis + ((lower >> ((axis + 1) % 3)) & 1) + 2 * ((lower >> ((axis + 2) % 3)) & 1);
}

/// Corners of the face at `side` of `axis`, counter-clockwise seen from outside the cell.
std::array<int, 4> face_corners(int axis, int side) {
  const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3), base = side << axis;
  if (side == 1) return {base, base + u, base + u + v, base + v};
  return {base, base + v, base + u + v, base + u};
}

/// next[e] is the edge that follows e on its contour, -1 where the surface does not cross e.
std::array<int, 12> contour_successors(int filled) {
  std::array<int, 12> next;
  next.fill(-1);
  const auto is_filled = [filled](int corner) { return ((filled >> corner) & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> c = face_corners(face / 2, face % 2);
    for (int i = 0; i < 4; ++i) {
      const int before = c[static_cast<size_t>((i + 3) % 4)];
      if (is_filled(before) || !is_filled(c[static_cast<size_t>(i)])) continue;
      int last = i;
      while (is_filled(c[static_cast<size_t>((last + 1) % 4)])) last = (last + 1) % 4;
      const int entry = edge_between(before, c[static_cast<size_t>(i)]);
      const int exit = edge_between(c[static_cast<size_t>(last)], c[static_cast<size_t>((last + 1) % 4)]);
      next[static_cast<size_t>(entry)] = exit;
    }
  }
  return next;
}

bool share_a_face(const CellEdge& a, const CellEdge& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.axis != axis && b.axis != axis &&
        a.lower_corner[static_cast<size_t>(axis)] == b.lower_corner[static_cast<size_t>(axis)])
      return true;
  return false;
}

/// Squared length between the middles of two edges (in quarter cells), or impossible inside a face.
double diagonal_cost(int edge_a, int edge_b) {
  const CellEdge a = cell_edge(edge_a), b = cell_edge(edge_b);
  if (share_a_face(a, b)) return impossible;
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const int d = 2 * a.lower_corner[i] + (a.axis == axis) - 2 * b.lower_corner[i] - (b.axis == axis);
    sum += d * d;
  }
  return sum;
}

struct Triangulation {
  double cost = impossible;
  std::vector<std::array<int, 3>> triangles;
};

/// Cheapest triangulation of the part of the loop from `first` to `last`, whose closing side is already paid
/// for.
Triangulation triangulate(const Loop& loop, size_t first, size_t last) {
  if (last - first < 2) return {0.0, {}};
  const auto side = [&](size_t i, size_t j) { return j - i < 2 ? 0.0 : diagonal_cost(loop[i], loop[j]); };
  Triangulation best;
  for (size_t apex = first + 1; apex < last; ++apex) {
    Triangulation left = triangulate(loop, first, apex), right = triangulate(loop, apex, last);
    const double cost = left.cost + right.cost + side(first, apex) + side(apex, last);
    if (cost >= best.cost) continue;
    best.cost = cost;
    best.triangles = std::move(left.triangles);
    best.triangles.insert(best.triangles.end(), right.triangles.begin(), right.triangles.end());
    best.triangles.push_back({loop[first], loop[apex], loop[last]});
  }
  return best;
}

CellCase derive(int filled) {
  CellCase result;
  std::array<int, 12> next = contour_successors(filled);
  for (int start = 0; start < 12; ++start) {
    Loop loop;
    for (int edge = start; next[static_cast<size_t>(edge)] >= 0;) {
      loop.push_back(edge);
      const int following = next[static_cast<size_t>(edge)];
      next[static_cast<size_t>(edge)] = -1;
      edge = following;
    }
    if (loop.empty()) continue;
    const Triangulation best = triangulate(loop, 0, loop.size() - 1);
    if (best.cost == impossible)
      throw std::logic_error("marching cubes: a loop needs a diagonal inside a face");
    for (const auto& t : best.triangles)
      result.triangles.at(result.triangle_count++) = {static_cast<uint8_t>(t[0]), static_cast<uint8_t>(t[1]),
                                                      static_cast<uint8_t>(t[2])};
  }
  return result;
}

std::array<CellCase, 256> derive_all() {
  std::array<CellCase, 256> cases;
  for (int filled = 0; filled < 256; ++filled) cases[static_cast<size_t>(filled)] = derive(filled);
  return cases;
}

}  // namespace

CellEdge cell_edge(int edge) {
  CellEdge result{edge / 4, {0, 0, 0}};
  result.lower_corner[static_cast<size_t>((result.axis + 1) % 3)] = edge & 1;
  result.lower_corner[static_cast<size_t>((result.axis + 2) % 3)] = (edge >> 1) & 1;
  return result;
}

const std::array<CellCase, 256>& cell_cases() {
  static const std::array<CellCase, 256> cases = derive_all();
  return cases;
}

}  // namespace ream::surface
