#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "geometry/scene_export.hpp"

namespace ream {
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
