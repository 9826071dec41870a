#pragma once
#include <deque>
#include <filesystem>
#include <vector>

#include "render/snapshot.hpp"

namespace ream::render {

/// What ream-renderer draws, as draw() is asked for it.
struct Scene {
  std::vector<Layer> layers;
  Camera camera;
  int width = 0, height = 0;  ///< pixels
};

/// A scene that was read, with what its layers point to.
struct SceneWithMeshes {
  Scene scene;
  std::deque<TriangleMesh> meshes;
  std::deque<std::vector<VertexColour>> colours;
};

/// For a program of the same build on the same machine: numbers as they lie in memory. Throws Error io where
/// the file cannot be written; a layer whose normals or colours are not one a vertex has none.
void write_scene(const std::filesystem::path& path, const Scene& scene);
/// Throws Error io for a file that is not whole, invalid_input for triangles of vertices that are not there.
SceneWithMeshes read_scene(const std::filesystem::path& path);

}  // namespace ream::render
