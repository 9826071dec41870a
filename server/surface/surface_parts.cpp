#include "surface/surface_parts.hpp"

namespace ream::surface {
namespace {

/// The axes along which a vertex lies on the block's first, or behind its last, layer of samples.
struct Layers {
  size_t first = 0, behind = 0;
};

Layers layers_of(const BlockVertex& v, int stride) {
  const int first = units_per_voxel + stride * units_per_voxel / 2;
  const int behind = first + block_edge * units_per_voxel;
  const auto set = [&](int at) {
    return static_cast<size_t>((v.x == at) | (v.y == at) << 1 | (v.z == at) << 2);
  };
  return {set(first), set(behind)};
}

}  // namespace

void count_owned(SurfacePart& part, int stride) {
  for (const BlockVertex& v : part.mesh.vertices) {
    const Layers layers = layers_of(v, stride);
    if (layers.behind != 0) continue;
    if (layers.first != 0)
      for (size_t set = 1; set < SurfacePart::axis_sets; ++set)
        if ((set & layers.first) == set) part.lent[set].push_back(part.owned);
    ++part.owned;
  }
}

TriangleMesh lay_out(std::vector<SurfacePart>& parts) {
  size_t vertices = 0, triangles = 0;
  for (SurfacePart& part : parts) {
    part.first_vertex = vertices;
    part.first_triangle = triangles;
    vertices += part.owned;
    triangles += part.mesh.indices.size() / 3;
  }
  TriangleMesh whole;
  whole.vertices_mm.resize(vertices);
  whole.normals.resize(vertices);
  whole.triangles.resize(triangles);
  return whole;
}

/// Writes the part into the whole, whose arrays have their sizes already.
void join(const BlockLayout& layout, const Vec3& spacing_mm, int stride,
          const std::vector<SurfacePart>& parts, const SurfacePart& part, TriangleMesh& whole) {
  const Vec3i block = layout.coordinates(part.mesh.block);
  std::array<const SurfacePart*, SurfacePart::axis_sets> owner{};
  std::array<size_t, SurfacePart::axis_sets> borrowed{};
  size_t next = part.first_vertex;
  std::vector<uint32_t> number;
  number.reserve(part.mesh.vertices.size());
  for (const BlockVertex& v : part.mesh.vertices) {
    const size_t set = layers_of(v, stride).behind;
    if (set != 0) {
      if (owner[set] == nullptr)
        owner[set] = &parts[layout.index(block + Vec3i(set & 1, set >> 1 & 1, set >> 2 & 1))];
      number.push_back(
          static_cast<uint32_t>(owner[set]->first_vertex + owner[set]->lent[set][borrowed[set]++]));
      continue;
    }
    whole.vertices_mm[next] = position_mm(v, block, spacing_mm);
    whole.normals[next] = direction_from_octahedral(v.ox, v.oy);
    number.push_back(static_cast<uint32_t>(next++));
  }
  auto triangle = whole.triangles.begin() + static_cast<ptrdiff_t>(part.first_triangle);
  const std::vector<uint32_t>& indices = part.mesh.indices;
  for (size_t i = 0; i < indices.size(); i += 3)
    *triangle++ = {number[indices[i]], number[indices[i + 1]], number[indices[i + 2]]};
}

}  // namespace ream::surface
