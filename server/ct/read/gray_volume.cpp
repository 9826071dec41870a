#include "ct/read/gray_volume.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>

#include "core/error.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/volume_file.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

using Type = itk::IOComponentEnum;

constexpr double hu_offset = -32768.0;
constexpr uint64_t megabyte = 1'000'000;

/// The scale of whole numbers of a type that has no more than 16 bits.
std::optional<voxel::GrayScale> scale_of(Type type) {
  if (type == Type::UCHAR || type == Type::USHORT) return voxel::GrayScale{};
  if (type == Type::CHAR || type == Type::SHORT) return voxel::GrayScale{hu_offset, 1.0, true};
  return {};
}

template <typename T>
void add_values(const T* values, size_t count, voxel::GrayScaleFinder& finder) {
  for (size_t i = 0; i < count; ++i)
    if (const auto v = static_cast<float>(values[i]); std::isfinite(v)) finder.add(v);
}

}  // namespace

struct GrayVolume::Contents {
  HuVolume place;  ///< everything but the values, unless they are HU
  voxel::GrayScale gray;
  std::vector<uint16_t> codes;
  // Of a file that is read layer by layer.
  std::string file;
  mutable std::ifstream in;
  mutable std::mutex mutex;
  Type type = Type::UNKNOWNCOMPONENTTYPE;
  uint64_t begin = 0, value_bytes = 0;
  bool reversed = false;  ///< the last axis

  size_t layer() const { return static_cast<size_t>(place.dims.x()) * static_cast<size_t>(place.dims.y()); }

  void open(const fs::path& path, uint64_t max_bytes, const Progress& progress);
  void read_raw(int w, std::vector<char>& bytes) const;
  void encode(const char* bytes, size_t count, uint16_t* to) const {
    with_values(type, bytes, file, [&](const auto* values) {
      for (size_t i = 0; i < count; ++i) to[i] = gray.code(static_cast<double>(values[i]));
    });
  }
  void find_scale(const Progress& progress);
  void read_whole(VolumeFile& volume, uint64_t max_bytes);
};

void GrayVolume::Contents::open(const fs::path& path, uint64_t max_bytes, const Progress& progress) {
  VolumeFile volume(path);
  file = volume.name();
  place.warnings = volume.header().warnings();
  if (volume.values_per_voxel() != 1)
    throw Error(ErrorKind::invalid_input, file + " has more than one value per voxel");
  type = volume.type();
  value_bytes = volume.value_bytes();
  reversed = volume.place(place);
  begin = volume.header().raw_begin(volume.image_bytes());
  if (begin == 0) return read_whole(volume, max_bytes);
  in.open(path, std::ios::binary);
  find_scale(progress);
}

void GrayVolume::Contents::read_raw(int w, std::vector<char>& bytes) const {
  const auto at = static_cast<uint64_t>(reversed ? place.dims.z() - 1 - w : w);
  bytes.resize(layer() * value_bytes);
  const std::lock_guard lock(mutex);
  in.seekg(static_cast<std::streamoff>(begin + at * bytes.size()));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw Error(ErrorKind::io, "cannot read " + file);
}

void GrayVolume::Contents::find_scale(const Progress& progress) {
  if (const auto known = scale_of(type)) {
    gray = *known;
    return;
  }
  voxel::GrayScaleFinder finder;
  std::vector<char> bytes;
  for (int w = 0; w < place.dims.z(); ++w) {
    progress(static_cast<double>(w) / place.dims.z(), "reading values");
    read_raw(w, bytes);
    with_values(type, bytes.data(), file, [&](const auto* values) { add_values(values, layer(), finder); });
  }
  gray = finder.scale();
}

void GrayVolume::Contents::read_whole(VolumeFile& volume, uint64_t max_bytes) {
  const size_t count = place.voxel_count();
  const uint64_t needed = count * (value_bytes + sizeof(uint16_t));
  if (needed > max_bytes)
    throw Error(ErrorKind::invalid_input,
                file + " needs " + std::to_string(needed / megabyte + 1) +
                    " MB while it is read; give more --memory-mb, or unpack it into a .nrrd of encoding raw, "
                    "which is read layer by layer");
  std::vector<char> bytes(count * value_bytes);
  volume.read(bytes.data());
  const auto known = scale_of(type);
  voxel::GrayScaleFinder finder;
  if (!known)
    with_values(type, bytes.data(), file, [&](const auto* values) { add_values(values, count, finder); });
  gray = known ? *known : finder.scale();
  codes.resize(count);
  encode(bytes.data(), count, codes.data());
}

GrayVolume::GrayVolume(const fs::path& path, uint64_t max_bytes, const Progress& progress)
    : contents_(std::make_unique<Contents>()) {
  if (!fs::exists(path)) throw Error(ErrorKind::not_found, "no such file or folder: " + path.string());
  try {
    if (is_volume_file(path)) {
      contents_->open(path, max_bytes, progress);
    } else {
      contents_->place = read_ct(path, {}, progress);
      contents_->gray = {hu_offset, 1.0, true};
    }
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::invalid_input, path.string() + " does not fit into memory");
  }
  if (!contents_->gray.exact)
    contents_->place.warnings.push_back(
        "gray values were rounded to 65,536 steps between the least and the greatest");
}

GrayVolume::~GrayVolume() = default;
GrayVolume::GrayVolume(GrayVolume&&) noexcept = default;
GrayVolume& GrayVolume::operator=(GrayVolume&&) noexcept = default;

const Vec3i& GrayVolume::dims() const { return contents_->place.dims; }
const Vec3& GrayVolume::spacing_mm() const { return contents_->place.spacing_mm; }
const Pose& GrayVolume::world_from_volume() const { return contents_->place.world_from_volume; }
const voxel::GrayScale& GrayVolume::gray() const { return contents_->gray; }
const std::vector<std::string>& GrayVolume::warnings() const { return contents_->place.warnings; }
uint64_t GrayVolume::bytes() const {
  return (contents_->codes.size() + contents_->place.hu.size()) * sizeof(uint16_t);
}

void GrayVolume::read_layer(int w, std::span<uint16_t> codes) const {
  const Contents& c = *contents_;
  const auto first = static_cast<std::ptrdiff_t>(c.layer()) * w;
  const auto count = static_cast<std::ptrdiff_t>(c.layer());
  if (c.begin > 0) {
    std::vector<char> bytes;
    c.read_raw(w, bytes);
    c.encode(bytes.data(), c.layer(), codes.data());
  } else if (!c.codes.empty()) {
    const auto from = c.reversed ? static_cast<std::ptrdiff_t>(c.codes.size()) - first - count : first;
    std::copy_n(c.codes.begin() + from, count, codes.begin());
  } else {
    for (size_t i = 0; i < c.layer(); ++i)
      codes[i] = static_cast<uint16_t>(c.place.hu[static_cast<size_t>(first) + i] + 32768);
  }
}

}  // namespace ream::ct
