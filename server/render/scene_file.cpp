#include "render/scene_file.hpp"

#include <array>
#include <fstream>
#include <span>
#include <string>
#include <type_traits>

#include "core/error.hpp"

namespace ream::render {
namespace fs = std::filesystem;
namespace {

using Three = std::array<double, 3>;

struct SceneHeader {
  uint64_t form;
  Three eye_mm, target_mm, up;
  double vertical_field_of_view_rad;
  int32_t width, height;
  uint64_t layers;
};
struct LayerHeader {
  std::array<Three, 3> rotation_rows;
  Three translation_mm;
  std::array<float, 3> colour;
  float opacity;
  uint64_t vertices, normals, colours, triangles;
};

/// Programs of two builds that lay their numbers out otherwise do not understand each other.
constexpr uint64_t scene_form = 0x72656163ull << 32 | sizeof(SceneHeader) << 16 | sizeof(LayerHeader);

Three three(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const Three& v) { return {v[0], v[1], v[2]}; }

class SceneWriter {
 public:
  explicit SceneWriter(const fs::path& path) : out_(path, std::ios::binary), path_(path) {}

  template <typename Value>
  void put(const Value& value) {
    put_all(std::span(&value, 1));
  }
  template <typename Values>
  void put_all(const Values& values) {
    const auto bytes = std::as_bytes(std::span(values));
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  void finish() {
    if (!out_.flush())
      throw Error(ErrorKind::io, path_.string() + ": what is to be drawn cannot be written; free some space");
  }

 private:
  std::ofstream out_;
  const fs::path& path_;
};

class SceneReader {
 public:
  explicit SceneReader(const fs::path& path)
      : in_(path, std::ios::binary), path_(path), left_(fs::file_size(path)) {}

  template <typename Value>
  Value value() {
    static_assert(std::is_trivially_copyable_v<Value>);
    return values<Value>(1).front();
  }
  template <typename Value>
  std::vector<Value> values(uint64_t count) {
    if (count > left_ / sizeof(Value)) throw cut_off();
    std::vector<Value> all(count);
    const auto bytes = std::as_writable_bytes(std::span(all));
    if (!in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
      throw cut_off();
    left_ -= bytes.size();
    return all;
  }

 private:
  Error cut_off() const { return {ErrorKind::io, path_.string() + ": what is to be drawn is not whole"}; }

  std::ifstream in_;
  const fs::path& path_;
  uint64_t left_;  ///< bytes
};

void write_layer(SceneWriter& to, const Layer& layer) {
  const TriangleMesh& mesh = *layer.mesh;
  const size_t vertices = mesh.vertices_mm.size();
  const bool has_normals = mesh.normals.size() == vertices;
  const bool has_colours = layer.colours && layer.colours->size() == vertices;
  const Mat3& rotation = layer.world_from_mesh.rotation;
  to.put(LayerHeader{{three(rotation.row(0)), three(rotation.row(1)), three(rotation.row(2))},
                     three(layer.world_from_mesh.translation_mm),
                     {layer.colour.x(), layer.colour.y(), layer.colour.z()},
                     layer.opacity,
                     vertices,
                     has_normals ? vertices : 0,
                     has_colours ? vertices : 0,
                     mesh.triangles.size()});
  to.put_all(mesh.vertices_mm);
  if (has_normals) to.put_all(mesh.normals);
  if (has_colours) to.put_all(*layer.colours);
  to.put_all(mesh.triangles);
}

void require_vertices(const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t vertex : triangle)
      if (vertex >= mesh.vertices_mm.size())
        throw Error(ErrorKind::invalid_input, "a triangle has a vertex that is not there");
}

void read_layer(SceneReader& from, SceneWithMeshes& into) {
  const auto header = from.value<LayerHeader>();
  Layer layer;
  for (int row = 0; row < 3; ++row)
    layer.world_from_mesh.rotation.row(row) = vec3(header.rotation_rows[static_cast<size_t>(row)]);
  layer.world_from_mesh.translation_mm = vec3(header.translation_mm);
  layer.colour = {header.colour[0], header.colour[1], header.colour[2]};
  layer.opacity = header.opacity;
  TriangleMesh& mesh = into.meshes.emplace_back();
  mesh.vertices_mm = from.values<Vec3f>(header.vertices);
  mesh.normals = from.values<Vec3f>(header.normals);
  layer.mesh = &mesh;
  if (header.colours > 0)
    layer.colours = &into.colours.emplace_back(from.values<VertexColour>(header.colours));
  mesh.triangles = from.values<std::array<uint32_t, 3>>(header.triangles);
  require_vertices(mesh);
  into.scene.layers.push_back(layer);
}

}  // namespace

void write_scene(const fs::path& path, const Scene& scene) {
  SceneWriter to(path);
  const Camera& camera = scene.camera;
  to.put(SceneHeader{scene_form, three(camera.eye_mm), three(camera.target_mm), three(camera.up),
                     camera.vertical_field_of_view_rad, scene.width, scene.height, scene.layers.size()});
  for (const Layer& layer : scene.layers) write_layer(to, layer);
  to.finish();
}

SceneWithMeshes read_scene(const fs::path& path) {
  SceneReader from(path);
  const auto header = from.value<SceneHeader>();
  if (header.form != scene_form)
    throw Error(ErrorKind::invalid_input, "ream and ream-renderer are of two builds; start ream again");
  SceneWithMeshes read;
  read.scene.camera = {vec3(header.eye_mm), vec3(header.target_mm), vec3(header.up),
                       header.vertical_field_of_view_rad};
  read.scene.width = header.width;
  read.scene.height = header.height;
  for (uint64_t layer = 0; layer < header.layers; ++layer) read_layer(from, read);
  return read;
}

}  // namespace ream::render
