#include "geometry/scene_export.hpp"

#include <algorithm>
#include <cstring>
#include <set>

namespace ream {
namespace {

template <typename T>
void append(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void append(std::string& out, const Vec3f& v) {
  out.append(reinterpret_cast<const char*>(v.data()), 3 * sizeof(float));
}

bool has_normals(const TriangleMesh& mesh) { return mesh.normals.size() == mesh.vertices_mm.size(); }

/// What any of the objects has.
struct PlyLayout {
  bool normals = true, colours = false;
  std::set<std::string> properties;
  size_t vertices = 0, triangles = 0;

  explicit PlyLayout(std::span<const SceneObject> objects) {
    for (const SceneObject& object : objects) {
      vertices += object.mesh->vertices_mm.size();
      triangles += object.mesh->triangles.size();
      normals = normals && has_normals(*object.mesh);
      colours = colours || !object.colours.empty();
      for (const VertexProperty& property : object.properties) properties.insert(property.name);
    }
  }

  std::string header(std::span<const SceneObject> objects, const std::string& remark) const {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + remark + "\n";
    for (size_t i = 0; i < objects.size(); ++i)
      text += "comment object " + std::to_string(i) + " is the " + objects[i].name + "\n";
    text += "element vertex " + std::to_string(vertices) +
            "\nproperty float x\nproperty float y\nproperty float z\n";
    if (normals) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (colours) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    for (const std::string& property : properties) text += "property char " + property + "\n";
    return text + "element face " + std::to_string(triangles) +
           "\nproperty list uchar int vertex_indices\nproperty uchar object\nend_header\n";
  }
};

void append_vertices(std::string& out, const SceneObject& object, const PlyLayout& layout) {
  const TriangleMesh& mesh = *object.mesh;
  std::vector<const std::vector<int8_t>*> columns;
  for (const std::string& name : layout.properties) {
    const auto found = std::find_if(object.properties.begin(), object.properties.end(),
                                    [&](const VertexProperty& p) { return p.name == name; });
    columns.push_back(found == object.properties.end() ? nullptr : &found->values);
  }
  for (size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    append(out, mesh.vertices_mm[i]);
    if (layout.normals) append(out, mesh.normals[i]);
    if (layout.colours)
      append(out, object.colours.empty() ? std::array<uint8_t, 3>{255, 255, 255} : object.colours[i]);
    for (const auto* column : columns) append(out, column ? (*column)[i] : int8_t{-128});
  }
}

}  // namespace

std::string stl_of(const TriangleMesh& mesh, const std::string& remark) {
  std::string out = remark.substr(0, 79);
  out.resize(80, ' ');
  append(out, static_cast<uint32_t>(mesh.triangles.size()));
  out.reserve(84 + 50 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices_mm[t[0]], &b = mesh.vertices_mm[t[1]], &c = mesh.vertices_mm[t[2]];
    const Vec3f across = (b - a).cross(c - a);
    const float length = across.norm();
    append(out, length > 0.0f ? Vec3f(across / length) : Vec3f(Vec3f::Zero()));
    for (const Vec3f& corner : {a, b, c}) append(out, corner);
    append(out, uint16_t{0});
  }
  return out;
}

std::string ply_of(std::span<const SceneObject> objects, const std::string& remark) {
  const PlyLayout layout(objects);
  std::string out = layout.header(objects, remark);
  for (const SceneObject& object : objects) append_vertices(out, object, layout);
  uint32_t base = 0;
  for (size_t i = 0; i < objects.size(); ++i) {
    for (const auto& t : objects[i].mesh->triangles) {
      out.push_back(3);
      for (const uint32_t corner : t) append(out, corner + base);
      out.push_back(static_cast<char>(i));
    }
    base += static_cast<uint32_t>(objects[i].mesh->vertices_mm.size());
  }
  return out;
}

}  // namespace ream
