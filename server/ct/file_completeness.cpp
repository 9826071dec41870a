#include "ct/file_completeness.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t nifti_header_bytes = 348;

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

std::string value_of(const std::string& line) {
  const auto first = line.find_first_not_of(" \t", line.find('=') + 1);
  if (line.find('=') == std::string::npos || first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

void check_meta_image(const fs::path& path, uint64_t image_bytes) {
  std::ifstream in(path, std::ios::binary);
  uint64_t needed = image_bytes;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("CompressedDataSize")) needed = std::strtoull(value_of(line).c_str(), nullptr, 10);
    if (!line.starts_with("ElementDataFile")) continue;
    const std::string data = value_of(line);
    if (data.starts_with("LIST") || data.find('%') != std::string::npos) return;
    const bool inside = data == "LOCAL" || data == "Local" || data == "local";
    const fs::path holder = inside ? path : path.parent_path() / data;
    if (!fs::is_regular_file(holder))
      throw Error(ErrorKind::not_found, "no such file: " + holder.string() + ", named by " + path.string());
    const uint64_t before = inside ? static_cast<uint64_t>(in.tellg()) : 0;
    if (fs::file_size(holder) < before + needed) cut_short(holder);
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
