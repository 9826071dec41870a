#include "voxelizer/closed_mesh.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace ream::voxelizer {
namespace {

uint64_t edge_key(uint32_t a, uint32_t b) {
  return static_cast<uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

template <class Visit>
void for_each_edge(const TriangleMesh& mesh, Visit visit) {
  for (const auto& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) visit(edge_key(t[k], t[(k + 1) % 3]));
}

/// A number that looks drawn at random.
uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

std::vector<uint64_t> open_edges(const TriangleMesh& mesh) {
  std::vector<uint64_t> edges, open;
  edges.reserve(3 * mesh.triangles.size());
  for_each_edge(mesh, [&](uint64_t key) { edges.push_back(key); });
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end = std::upper_bound(first, edges.end(), *first);
    if ((end - first) % 2 != 0) open.push_back(*first);
    first = end;
  }
  return open;
}

}  // namespace

void require_closed(const TriangleMesh& mesh, double scale) {
  // Edges that come twice cancel out in the sums, which then are 0 but for one chance in 2^128; no memory is
  // needed unless the mesh is refused.
  uint64_t sum = 0, other_sum = 0;
  for_each_edge(mesh, [&](uint64_t key) {
    const uint64_t number = mixed(key);
    sum ^= number;
    other_sum ^= mixed(number ^ key);
  });
  if (sum == 0 && other_sum == 0) return;
  const std::vector<uint64_t> open = open_edges(mesh);
  const Vec3 a = scale * mesh.vertices_mm[open.front() >> 32].cast<double>();
  const Vec3 b = scale * mesh.vertices_mm[open.front() & 0xffffffffu].cast<double>();
  const Vec3 middle = 0.5 * (a + b);
  std::ostringstream text;
  text << "the mesh is not closed and has no inside to fill: " << open.size()
       << (open.size() == 1 ? " edge belongs" : " edges belong")
       << " to an odd number of triangles, the first near (" << middle.x() << ", " << middle.y() << ", "
       << middle.z() << ") mm; close it, or leave out --solid";
  throw Error(ErrorKind::invalid_input, text.str());
}

}  // namespace ream::voxelizer
