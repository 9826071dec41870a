#pragma once
#include <filesystem>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream::render {

/// sRGB; `hatch` of 255 strikes the surface with dark stripes, so that it can be told apart without colours.
struct VertexColour {
  uint8_t red = 255, green = 255, blue = 255, hatch = 0;
};

/// Bone that was cut, linear RGB: three times darker than other bone, as on the page
/// (web/src/scene/cut_bone.ts).
inline const Vec3f cut_bone_colour{0.2542f, 0.0467f, 0.0513f};

/// One mesh of a picture, world frame, lit from the camera; vertex normals are used where present.
struct Layer {
  const TriangleMesh* mesh = nullptr;
  Pose world_from_mesh;
  Vec3f colour{0.91f, 0.86f, 0.76f};  ///< linear RGB, 0 to 1
  float opacity = 1.0f;               ///< below 1: drawn after the opaque layers
  /// One a vertex, in place of colour; lit evenly, so that they stay what they are.
  const std::vector<VertexColour>* colours = nullptr;
};

/// Perspective camera.
struct Camera {
  Vec3 eye_mm = Vec3::Zero(), target_mm = Vec3::UnitX(), up = Vec3::UnitZ();
  double vertical_field_of_view_rad = 0.6;
};

/// RGBA, top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Drawn by ream-renderer, a process of its own, on the processor: no display is needed, and a driver that
/// crashes or finds no memory costs a picture. Throws Error: invalid_input for sizes and cameras that cannot
/// be; unavailable, "the picture cannot be drawn: ...", whatever keeps it from being drawn.
Image draw(const std::vector<Layer>& layers, const Camera& camera, int width, int height);

/// The bytes of a PNG file. Error invalid_input for a picture without pixels, or with another number than its
/// size says.
std::vector<std::byte> png_of(const Image& image);
/// Atomic PNG; Error io names the path.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace ream::render
