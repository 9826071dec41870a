#include "stream/codec.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/error.hpp"
#include "surface/block_mesh.hpp"

namespace ream::stream {
namespace {

using surface::BlockVertex;

/// The library keeps the formats to write in globals; browsers of every age read these.
void choose_formats_once() {
  static const bool chosen = [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    return true;
  }();
  static_cast<void>(chosen);
}

template <typename Encode>
std::vector<std::byte> encoded(size_t bound, Encode encode) {
  std::vector<std::byte> bytes(bound);
  const size_t size = encode(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size());
  if (size == 0) throw std::logic_error("mesh codec: the bound of the encoded size is too small");
  bytes.resize(size);
  return bytes;
}

}  // namespace

EncodedBlock encode(const surface::BlockMesh& mesh, uint32_t revision, uint32_t tick, int stride,
                    const SurfaceClasses* classes, std::span<const uint8_t> removed) {
  EncodedBlock result;
  result.block = mesh.block;
  result.revision = revision;
  result.tick = tick;
  result.stride = stride;
  if (mesh.indices.empty()) return result;
  choose_formats_once();

  // A cheap order: the best one, for strips, packs 10 % better and takes twice as long in all.
  constexpr unsigned cache_vertices = 8;
  std::vector<uint32_t> indices(mesh.indices.size());
  meshopt_optimizeVertexCacheFifo(indices.data(), mesh.indices.data(), indices.size(), mesh.vertices.size(),
                                  cache_vertices);
  // In the order in which triangles come to them.
  std::vector<uint32_t> place(mesh.vertices.size());
  const size_t count =
      meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), place.size());
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), place.data());
  std::vector<BlockVertex> vertices(count);
  meshopt_remapVertexBuffer(vertices.data(), mesh.vertices.data(), mesh.vertices.size(), sizeof(BlockVertex),
                            place.data());
  result.vertex_count = static_cast<uint32_t>(vertices.size());
  result.index_count = static_cast<uint32_t>(indices.size());
  std::vector<uint8_t> codes;
  if (classes != nullptr) codes = classes->codes(vertices, mesh.block, stride);
  if (!codes.empty()) result.classes = classes->packed_classes(codes);
  if (!removed.empty()) {
    std::vector<uint8_t> levels(count);
    meshopt_remapVertexBuffer(levels.data(), removed.data(), removed.size(), 1, place.data());
    result.removed = RemovedBone::packed(levels);
    result.densities = SurfaceClasses::packed_densities(codes);
  }
  result.vertices = encoded(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(BlockVertex)),
                            [&](unsigned char* to, size_t size) {
                              return meshopt_encodeVertexBuffer(to, size, vertices.data(), vertices.size(),
                                                                sizeof(BlockVertex));
                            });
  result.indices = encoded(meshopt_encodeIndexBufferBound(indices.size(), vertices.size()),
                           [&](unsigned char* to, size_t size) {
                             return meshopt_encodeIndexBuffer(to, size, indices.data(), indices.size());
                           });
  return result;
}

surface::BlockMesh decode(const EncodedBlock& block) {
  surface::BlockMesh mesh;
  mesh.block = block.block;
  if (block.empty()) return mesh;
  mesh.vertices.resize(block.vertex_count);
  mesh.indices.resize(block.index_count);
  const auto* vertices = reinterpret_cast<const unsigned char*>(block.vertices.data());
  const auto* indices = reinterpret_cast<const unsigned char*>(block.indices.data());
  const bool whole = meshopt_decodeVertexBuffer(mesh.vertices.data(), mesh.vertices.size(),
                                                sizeof(BlockVertex), vertices, block.vertices.size()) == 0 &&
                     meshopt_decodeIndexBuffer(mesh.indices.data(), mesh.indices.size(), sizeof(uint32_t),
                                               indices, block.indices.size()) == 0;
  const auto is_vertex = [&](uint32_t index) { return index < block.vertex_count; };
  if (!whole || !std::all_of(mesh.indices.begin(), mesh.indices.end(), is_vertex))
    throw Error(ErrorKind::invalid_input,
                "the surface of block " + std::to_string(block.block) + " is damaged; have it made again");
  return mesh;
}

}  // namespace ream::stream
