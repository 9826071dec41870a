#include "render/snapshot.hpp"

#include <png.h>

#include <cstddef>
#include <mutex>
#include <new>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/temporary_file.hpp"
#include "isolation/isolated_job.hpp"
#include "render/camera.hpp"
#include "render/scene_file.hpp"

namespace ream::render {
namespace fs = std::filesystem;
namespace {

constexpr int max_edge_pixels = 8192;  // 16384 in OSMesa before downsampling
/// A picture takes a second; meanwhile no other one is drawn.
constexpr std::chrono::minutes max_drawing_time{2};
const std::string cannot_be_drawn = "the picture cannot be drawn";

isolation::IsolatedJob drawing_of(const fs::path& scene) {
  isolation::IsolatedJob job;
  job.program = isolation::helper_program(isolation::renderer_name);
  job.task = "draw";
  job.input = scene;
  job.words = {"the renderer", cannot_be_drawn, "", ErrorKind::unavailable};
  job.limits.time = max_drawing_time;
  job.limits.processor_s = 1200;
  job.limits.least_free_bytes = 1;  // a picture is small; what has no room says so
  job.limits.compiles = true;
  job.limits.background = false;
  return job;
}

Image drawn(const Scene& scene) {
  const TemporaryFolder folder(fs::temp_directory_path() / "ream-picture");
  const fs::path file = folder.path() / "scene";
  write_scene(file, scene);
  const isolation::IsolatedResult result = isolation::run_isolated(drawing_of(file));
  const uint64_t bytes = 4 * static_cast<uint64_t>(scene.width) * static_cast<uint64_t>(scene.height);
  result.require_bytes("pixels", bytes);
  return {scene.width, scene.height, result.values<uint8_t>("pixels", bytes)};
}

}  // namespace

Image draw(const std::vector<Layer>& layers, const Camera& camera, int width, int height) {
  if (width < 1 || height < 1 || width > max_edge_pixels || height > max_edge_pixels)
    throw Error(ErrorKind::invalid_input,
                "picture: " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels cannot be drawn; each edge must be 1 to " + std::to_string(max_edge_pixels));
  static_cast<void>(camera_from_world(camera));
  static std::mutex one_at_a_time;  // the renderer uses every core
  const std::lock_guard lock(one_at_a_time);
  try {
    return drawn({layers, camera, width, height});
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::unavailable, cannot_be_drawn + ": this machine has not enough free memory for it");
  } catch (const std::exception& failure) {
    // Whatever it is, the rest of a report goes without.
    const std::string what = failure.what();
    throw Error(ErrorKind::unavailable,
                what.starts_with(cannot_be_drawn) ? what : cannot_be_drawn + ": " + what);
  }
}

std::vector<std::byte> png_of(const Image& image) {
  const auto pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != 4 * pixels)
    throw Error(ErrorKind::invalid_input, "the picture has no pixels, or not as many as its size says");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGBA;
  const auto write = [&](void* to, png_alloc_size_t& size) {
    if (png_image_write_to_memory(&header, to, &size, 0, image.rgba.data(), 0, nullptr) == 0)
      throw Error(ErrorKind::io, std::string("the picture cannot be encoded as PNG: ") + header.message);
  };
  png_alloc_size_t size = 0;
  write(nullptr, size);
  std::vector<std::byte> bytes(size);
  write(bytes.data(), size);
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  try {
    write_file_atomically(path, png_of(image));
  } catch (const Error& e) {
    const std::string what = e.what();
    if (what.find(path.string()) != std::string::npos) throw;
    throw Error(e.kind(), path.string() + ": " + what);
  }
}

}  // namespace ream::render
