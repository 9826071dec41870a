#pragma once
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include "stream/mailbox.hpp"
#include "stream_generated.h"

namespace ream::stream {

/// The surface itself, however its vertices and triangles are ordered.
using Corner = std::array<int, 5>;
using Surface = std::vector<std::array<Corner, 3>>;

inline Surface surface_of(const std::vector<surface::BlockVertex>& vertices,
                          const std::vector<uint32_t>& indices) {
  Surface result;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    std::array<Corner, 3> t;
    for (size_t k = 0; k < 3; ++k) {
      const surface::BlockVertex& v = vertices.at(indices[i + k]);
      t[k] = {v.x, v.y, v.z, v.ox, v.oy};
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

inline Surface decoded(const void* vertices, size_t vertex_bytes, size_t vertex_count, const void* indices,
                       size_t index_bytes, size_t index_count) {
  std::vector<surface::BlockVertex> v(vertex_count);
  std::vector<uint32_t> i(index_count);
  if (vertex_count == 0 && index_count == 0) return {};
  if (meshopt_decodeVertexBuffer(v.data(), v.size(), 8, static_cast<const unsigned char*>(vertices),
                                 vertex_bytes) != 0 ||
      meshopt_decodeIndexBuffer(i.data(), i.size(), 4, static_cast<const unsigned char*>(indices),
                                index_bytes) != 0)
    throw std::runtime_error("meshopt refuses the block");
  return surface_of(v, i);
}

inline Surface decoded(const EncodedBlock& block) {
  return decoded(block.vertices.data(), block.vertices.size(), block.vertex_count, block.indices.data(),
                 block.indices.size(), block.index_count);
}

inline bool verified(const std::byte* data, size_t size) {
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(data), size);
  return wire::VerifyServerMessageBuffer(verifier);
}

/// A browser in small: holds the newest surface of each block it was told of.
struct Viewer {
  struct Held {
    uint32_t revision = 0;
    Surface surface;
  };
  std::map<uint32_t, Held> blocks;  ///< without empty ones
  std::map<uint32_t, uint32_t> revisions;
  int hellos = 0, key_completes = 0, mesh_messages = 0, telemetry_messages = 0;
  size_t blocks_received = 0, largest_mesh_message = 0, samples = 0;
  size_t blocks_with_classes = 0;
  uint32_t dropped = 0;

  /// Fails the test on messages that do not verify or blocks that are older than what is held.
  void receive(const Message& message) {
    ASSERT_TRUE(verified(message->data(), message->size()));
    const wire::ServerMessage* m = wire::GetServerMessage(message->data());
    if (m->body_type() == wire::Body::Hello) ++hellos;
    if (const wire::Telemetry* t = m->body_as_Telemetry()) {
      ++telemetry_messages;
      samples += t->thrust_n()->size();
      EXPECT_GE(t->dropped(), dropped);
      dropped = t->dropped();
    }
    const wire::MeshDelta* delta = m->body_as_MeshDelta();
    if (delta == nullptr) return;
    ++mesh_messages;
    largest_mesh_message = std::max(largest_mesh_message, message->size());
    for (const wire::MeshBlock* b : *delta->blocks()) {
      ++blocks_received;
      if (b->classes()->size() > 0) {
        EXPECT_EQ(b->classes()->size(), (b->vertex_count() + 3) / 4);
        ++blocks_with_classes;
      }
      if (b->vertices()->size() > 0) {
        EXPECT_EQ((reinterpret_cast<const std::byte*>(b->vertices()->data()) - message->data()) % 8, 0);
      }
      EXPECT_GT(b->revision(), revisions[b->block()]);
      revisions[b->block()] = b->revision();
      if (b->index_count() == 0)
        blocks.erase(b->block());
      else
        blocks[b->block()] = {b->revision(),
                              decoded(b->vertices()->data(), b->vertices()->size(), b->vertex_count(),
                                      b->indices()->data(), b->indices()->size(), b->index_count())};
    }
    key_completes += delta->key_complete();
  }

  /// Receives up to `count` messages.
  void pull(Mailbox& mailbox, int count = 1 << 30) {
    for (; count > 0; --count) {
      const Message message = mailbox.next();
      if (!message) return;
      receive(message);
    }
  }

  bool same_picture(const Viewer& other) const {
    return std::equal(blocks.begin(), blocks.end(), other.blocks.begin(), other.blocks.end(),
                      [](const auto& a, const auto& b) {
                        return a.first == b.first && a.second.revision == b.second.revision &&
                               a.second.surface == b.second.surface;
                      });
  }
};

inline SharedBlock small_block(uint32_t block, uint32_t revision, bool empty = false) {
  surface::BlockMesh mesh;
  mesh.block = block;
  const auto x = static_cast<uint16_t>(revision % 60000);
  if (!empty) {
    mesh.vertices = {{x, 1, 2, 3, 4}, {5, x, 6, 7, 8}, {9, 10, x, 11, 12}, {x, x, x, 1, 1}};
    mesh.indices = {0, 1, 2, 2, 1, 3};
  }
  return std::make_shared<const EncodedBlock>(encode(mesh, revision, revision));
}

}  // namespace ream::stream
