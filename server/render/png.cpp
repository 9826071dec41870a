#include <png.h>

#include <cstddef>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "render/snapshot.hpp"

namespace ream::render {

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
