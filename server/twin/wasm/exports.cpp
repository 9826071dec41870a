// What a browser calls of the twin: memory goes in, parts are taken, surfaces come out. One player a module,
// as a module is one worker's; a module whose memory runs out or whose code traps is thrown away with it.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "twin/twin_player.hpp"

#define REAM_EXPORT(name) __attribute__((export_name(#name))) extern "C"

namespace {

ream::twin::TwinPlayer& player() {
  static ream::twin::TwinPlayer instance;
  return instance;
}

std::vector<std::byte>& input() {
  static std::vector<std::byte> bytes;
  return bytes;
}

ream::twin::MarkedSurface& surface() {
  static ream::twin::MarkedSurface last;
  return last;
}

ream::TriangleMesh& whole() {
  static ream::TriangleMesh last;
  return last;
}

const std::vector<uint8_t>& marks(uint32_t kind) {
  const ream::twin::MarkedSurface& of = surface();
  return kind == 0 ? of.classes : kind == 1 ? of.removed : of.densities;
}

std::vector<uint32_t>& blocks() {
  static std::vector<uint32_t> changed;
  return changed;
}

/// Else `new` would give null, and address 0 can be written to.
[[maybe_unused]] const bool memory_ends_in_a_trap = [] {
  std::set_new_handler([] { __builtin_trap(); });
  return true;
}();

template <typename T>
uint32_t address_of(const std::vector<T>& values) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(values.data()));
}

}  // namespace

/// There are no exceptions: what throws elsewhere ends the module, and its worker says so.
extern "C" void* __cxa_allocate_exception(size_t) noexcept { __builtin_trap(); }
extern "C" void __cxa_throw(void*, void*, void (*)(void*)) { __builtin_trap(); }

/// Room for the next part; where its bytes are to be put.
REAM_EXPORT(twin_input) uint32_t twin_input(uint32_t bytes) {
  input().resize(bytes);
  return address_of(input());
}

/// Takes what lies there: TwinPlayer::Outcome.
REAM_EXPORT(twin_take) uint32_t twin_take() { return static_cast<uint32_t>(player().take(input())); }

REAM_EXPORT(twin_agreed_ticks) uint32_t twin_agreed_ticks() { return player().agreed_ticks(); }
REAM_EXPORT(twin_ended) uint32_t twin_ended() { return player().ended(); }

REAM_EXPORT(twin_recorded_ticks) uint32_t twin_recorded_ticks() { return player().recorded_ticks(); }

REAM_EXPORT(twin_coverage_hash) uint64_t twin_coverage_hash() {
  return player().twin() ? player().twin()->bone().coverage_hash() : 0;
}

/// Looks for blocks that have changed since the last call: how many. Their numbers are at twin_blocks_at().
REAM_EXPORT(twin_find_changed_blocks) uint32_t twin_find_changed_blocks() {
  blocks() = player().twin() ? player().twin()->take_changed_blocks() : std::vector<uint32_t>();
  return static_cast<uint32_t>(blocks().size());
}
REAM_EXPORT(twin_blocks_at) uint32_t twin_blocks_at() { return address_of(blocks()); }

/// Makes the surface of a block: how many indices it has (surface/block_mesh.hpp). 0 also for no such block.
REAM_EXPORT(twin_make_surface) uint32_t twin_make_surface(uint32_t block) {
  ream::twin::BoneTwin* twin = player().twin();
  surface() = twin && block < twin->block_count() ? twin->surface_of(block) : ream::twin::MarkedSurface();
  return static_cast<uint32_t>(surface().mesh.indices.size());
}
REAM_EXPORT(twin_indices_at) uint32_t twin_indices_at() { return address_of(surface().mesh.indices); }
REAM_EXPORT(twin_vertices_at) uint32_t twin_vertices_at() { return address_of(surface().mesh.vertices); }
REAM_EXPORT(twin_vertex_count) uint32_t twin_vertex_count() {
  return static_cast<uint32_t>(surface().mesh.vertices.size());
}
/// What is known of its vertices, as MeshBlock of proto/stream.fbs: 0 classes, 1 removed, 2 densities.
REAM_EXPORT(twin_marks_at) uint32_t twin_marks_at(uint32_t kind) { return address_of(marks(kind)); }
REAM_EXPORT(twin_marks_bytes) uint32_t twin_marks_bytes(uint32_t kind) {
  return static_cast<uint32_t>(marks(kind).size());
}

/// Makes the whole surface (BoneTwin::whole_surface): how many vertices it has. Three floats a vertex and
/// normal, three u32 a triangle.
REAM_EXPORT(twin_make_whole_surface) uint32_t twin_make_whole_surface() {
  whole() = player().twin() ? player().twin()->whole_surface() : ream::TriangleMesh();
  return static_cast<uint32_t>(whole().vertices_mm.size());
}
REAM_EXPORT(twin_whole_vertices_at) uint32_t twin_whole_vertices_at() {
  return address_of(whole().vertices_mm);
}
REAM_EXPORT(twin_whole_normals_at) uint32_t twin_whole_normals_at() { return address_of(whole().normals); }
REAM_EXPORT(twin_whole_triangle_count) uint32_t twin_whole_triangle_count() {
  return static_cast<uint32_t>(whole().triangles.size());
}
REAM_EXPORT(twin_whole_triangles_at) uint32_t twin_whole_triangles_at() {
  return address_of(whole().triangles);
}

/// TwinPlayer::keep_snapshot; all bits set where there is none.
REAM_EXPORT(twin_keep_snapshot) uint32_t twin_keep_snapshot() {
  return static_cast<uint32_t>(player().keep_snapshot().value_or(UINT32_MAX));
}
/// TwinPlayer::go_to: 1 or 0.
REAM_EXPORT(twin_go_to) uint32_t twin_go_to(uint32_t snapshot) { return player().go_to(snapshot); }
