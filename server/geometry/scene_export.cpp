#include "geometry/scene_export.hpp"

#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <set>

#include "core/error.hpp"

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

namespace {

aiVector3D vector_of(const Vec3f& v) { return {v.x(), v.y(), v.z()}; }

/// glTF's colours are linear.
float linear(uint8_t level) {
  const double c = level / 255.0;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// Owned by the scene, as assimp has it.
aiMesh* mesh_of(const SceneObject& object, unsigned material) {
  const TriangleMesh& mesh = *object.mesh;
  auto* out = new aiMesh;
  out->mName = object.name;
  out->mMaterialIndex = material;
  out->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out->mNumVertices = static_cast<unsigned>(mesh.vertices_mm.size());
  out->mVertices = new aiVector3D[out->mNumVertices];
  const bool normals = mesh.normals.size() == mesh.vertices_mm.size();
  if (normals) out->mNormals = new aiVector3D[out->mNumVertices];
  if (!object.colours.empty()) out->mColors[0] = new aiColor4D[out->mNumVertices];
  for (size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    out->mVertices[i] = vector_of(mesh.vertices_mm[i]);
    if (normals) out->mNormals[i] = vector_of(mesh.normals[i]);
    if (object.colours.empty()) continue;
    const auto [red, green, blue] = object.colours[i];
    out->mColors[0][i] = {linear(red), linear(green), linear(blue), 1.0f};
  }
  out->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  out->mFaces = new aiFace[out->mNumFaces];
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    out->mFaces[i].mNumIndices = 3;
    out->mFaces[i].mIndices = new unsigned[3];
    for (size_t k = 0; k < 3; ++k) out->mFaces[i].mIndices[k] = mesh.triangles[i][k];
  }
  return out;
}

aiMaterial* material_of(const SceneObject& object) {
  auto* material = new aiMaterial;
  const aiString name(object.name);
  material->AddProperty(&name, AI_MATKEY_NAME);
  const aiColor4D colour =
      object.colours.empty() ? aiColor4D(0.55f, 0.60f, 0.66f, 1.0f) : aiColor4D(1, 1, 1, 1);
  material->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
  return material;
}

/// Left, posterior, superior in mm to left, superior, anterior in metres.
aiMatrix4x4 gltf_from_lps() {
  constexpr float metre = 0.001f;
  return {metre, 0, 0, 0, 0, 0, metre, 0, 0, -metre, 0, 0, 0, 0, 0, 1};
}

}  // namespace

std::string glb_of(std::span<const SceneObject> objects, const std::string& remark) {
  aiScene scene;
  scene.mNumMeshes = scene.mNumMaterials = static_cast<unsigned>(objects.size());
  scene.mMeshes = new aiMesh*[objects.size()];
  scene.mMaterials = new aiMaterial*[objects.size()];
  scene.mRootNode = new aiNode(remark);
  scene.mRootNode->mTransformation = gltf_from_lps();
  scene.mRootNode->mNumChildren = static_cast<unsigned>(objects.size());
  scene.mRootNode->mChildren = new aiNode*[objects.size()];
  for (unsigned i = 0; i < objects.size(); ++i) {
    scene.mMeshes[i] = mesh_of(objects[i], i);
    scene.mMaterials[i] = material_of(objects[i]);
    auto* node = new aiNode(objects[i].name);
    node->mParent = scene.mRootNode;
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{i};
    scene.mRootNode->mChildren[i] = node;
  }
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, "glb2");
  if (blob == nullptr || blob->data == nullptr)
    throw Error(ErrorKind::io, std::string("the GLB file cannot be made: ") + exporter.GetErrorString());
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace ream
