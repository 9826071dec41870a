#include "ct/file_completeness.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t nifti_header_bytes = 352;  // with the four bytes that always follow it

[[noreturn]] void cut_short(const fs::path& path) {
  throw Error(ErrorKind::invalid_input,
              path.string() + " is cut short or damaged; copy it again from its source");
}

/// Size after unpacking what follows byte `start` (what is not packed counts as it is); throws when the
/// stream is damaged or has no end.
uint64_t unpacked_bytes(const fs::path& path, off_t start = 0) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(ErrorKind::io, "cannot read " + path.string());
  ::lseek(descriptor, start, SEEK_SET);
  const gzFile file = gzdopen(descriptor, "rb");
  if (file == nullptr) {
    ::close(descriptor);
    throw Error(ErrorKind::io, "cannot read " + path.string());
  }
  std::vector<char> piece(1 << 18);
  uint64_t total = 0;
  int got = 0;
  while ((got = gzread(file, piece.data(), static_cast<unsigned>(piece.size()))) > 0)
    total += static_cast<uint64_t>(got);
  // A stream that ends too early is told only on closing.
  const int closed = gzclose(file);
  if (got < 0 || closed != Z_OK) cut_short(path);
  return total;
}

struct EndInflate {
  void operator()(z_stream* stream) const {
    inflateEnd(stream);
    delete stream;
  }
};

/// Checks that a zlib stream from byte `start` on is whole and makes so many bytes: the reading library hands
/// out zeros for a damaged one.
void check_deflated(const fs::path& path, uint64_t start, uint64_t needed) {
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(start));
  const std::unique_ptr<z_stream, EndInflate> stream(new z_stream{});
  constexpr int any_header = 15 + 32;
  if (inflateInit2(stream.get(), any_header) != Z_OK)
    throw Error(ErrorKind::io, "no memory to unpack " + path.string());
  std::vector<unsigned char> packed(1 << 18), plain(1 << 18);
  uint64_t total = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
    stream->next_in = packed.data();
    stream->avail_in = static_cast<unsigned>(in.gcount());
    if (stream->avail_in == 0) cut_short(path);
    while (stream->avail_in > 0 && state != Z_STREAM_END) {
      stream->next_out = plain.data();
      stream->avail_out = static_cast<unsigned>(plain.size());
      state = inflate(stream.get(), Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END) cut_short(path);
      total += plain.size() - stream->avail_out;
    }
  }
  if (total < needed) cut_short(path);
}

std::string value_of(const std::string& line) {
  const auto first = line.find_first_not_of(" \t", line.find('=') + 1);
  if (line.find('=') == std::string::npos || first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

void check_meta_image(const fs::path& path, uint64_t image_bytes) {
  std::ifstream in(path, std::ios::binary);
  bool packed = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("CompressedData ") || line.starts_with("CompressedData="))
      packed = value_of(line).starts_with('T');
    if (!line.starts_with("ElementDataFile")) continue;
    const std::string data = value_of(line);
    const bool inside = data == "LOCAL" || data == "Local" || data == "local";
    const fs::path holder = inside ? path : path.parent_path() / data;
    if (!fs::is_regular_file(holder))
      throw Error(ErrorKind::not_found, "no such file: " + holder.string() + ", named by " + path.string());
    const uint64_t before = inside ? static_cast<uint64_t>(in.tellg()) : 0;
    if (packed)
      check_deflated(holder, before, image_bytes);
    else if (fs::file_size(holder) < before + image_bytes)
      cut_short(holder);
    return;
  }
}

/// The reading library does not look at the checksum behind a packed stream. What lies in another file or
/// after skipped bytes is left to it.
void check_nrrd(const fs::path& path, uint64_t image_bytes) {
  std::ifstream in(path, std::ios::binary);
  bool packed = false;
  for (std::string line; std::getline(in, line) && !line.empty() && line != "\r";) {
    if (line.starts_with("encoding:")) packed = line.find("gz") != std::string::npos;
    for (const char* elsewhere :
         {"data file:", "datafile:", "line skip:", "lineskip:", "byte skip:", "byteskip:"})
      if (line.starts_with(elsewhere)) return;
  }
  if (packed && in && unpacked_bytes(path, in.tellg()) < image_bytes) cut_short(path);
}

}  // namespace

void check_complete(const fs::path& path, uint64_t image_bytes) {
  const std::string name = path.filename().string();
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) {
    if (unpacked_bytes(path) < nifti_header_bytes + image_bytes) cut_short(path);
  } else if (name.ends_with(".mha") || name.ends_with(".mhd")) {
    check_meta_image(path, image_bytes);
  } else if (name.ends_with(".nrrd")) {
    check_nrrd(path, image_bytes);
  }
}

}  // namespace ream::ct
