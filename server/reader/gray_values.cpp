#include "reader/gray_values.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.hpp"
#include "ct/read/ct_file_names.hpp"
#include "ct/read/volume_answer.hpp"
#include "reader/ct_files.hpp"
#include "reader/volume_file.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

using Type = itk::IOComponentEnum;

constexpr double hu_offset = -32768.0;
constexpr uint64_t megabyte = 1'000'000;
constexpr double scale_share = 0.5;

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

/// The layers of an opened file, one by one or all at once, in the order of the grid.
class Layers {
 public:
  Layers(const fs::path& path, uint64_t max_bytes) : volume_(path), path_(path) {
    if (volume_.values_per_voxel() != 1)
      throw Error(ErrorKind::invalid_input, volume_.name() + " has more than one value per voxel");
    place.warnings = volume_.header().warnings();
    reversed_ = volume_.place(place);
    count = static_cast<size_t>(place.dims.x()) * static_cast<size_t>(place.dims.y());
    begin_ = volume_.header().raw_begin(volume_.image_bytes());
    if (begin_ == 0) {
      read_whole(max_bytes);
      return;
    }
    in_.open(path_, std::ios::binary);
    layer_.resize(count * volume_.value_bytes());
  }

  /// Calls use(values, w) with the values of each layer, in their own type.
  template <typename Use>
  void each(const Progress& progress, Use&& use) {
    for (int w = 0; w < place.dims.z(); ++w) {
      progress(static_cast<double>(w) / place.dims.z(), "reading values");
      with_values(type(), bytes(reversed_ ? place.dims.z() - 1 - w : w), volume_.name(), use);
    }
  }

  Type type() const { return volume_.type(); }

  ct::HuVolume place;  ///< everything but the values
  size_t count = 0;    ///< of values in a layer

 private:
  const char* bytes(int w) {
    const auto at = static_cast<uint64_t>(w) * count * volume_.value_bytes();
    if (begin_ == 0) return whole_.data() + at;
    in_.seekg(static_cast<std::streamoff>(begin_ + at));
    in_.read(layer_.data(), static_cast<std::streamsize>(layer_.size()));
    if (!in_) throw Error(ErrorKind::io, "cannot read " + volume_.name());
    return layer_.data();
  }

  void read_whole(uint64_t max_bytes) {
    const uint64_t needed = place.voxel_count() * volume_.value_bytes();
    if (needed > max_bytes)
      throw Error(ErrorKind::invalid_input,
                  volume_.name() + " needs " + std::to_string(needed / megabyte + 1) +
                      " MB while it is read; give more --memory-mb, or unpack it into a .nrrd of encoding "
                      "raw, which is read layer by layer");
    whole_.resize(needed);
    volume_.read(whole_.data());
  }

  VolumeFile volume_;
  fs::path path_;
  bool reversed_ = false;  ///< the last axis
  uint64_t begin_ = 0;     ///< of the values in the file; 0: they are in whole_
  std::vector<char> whole_, layer_;
  std::ifstream in_;
};

GrayValues write_layers(const fs::path& path, const fs::path& values, uint64_t max_bytes,
                        const Progress& progress) {
  Layers layers(path, max_bytes);
  GrayValues result;
  if (const auto known = scale_of(layers.type())) {
    result.gray = *known;
  } else {
    voxel::GrayScaleFinder finder;
    layers.each(part_of(progress, 0.0, scale_share),
                [&](const auto* all) { add_values(all, layers.count, finder); });
    result.gray = finder.scale();
  }
  std::vector<uint16_t> codes(layers.count);
  layers.each(part_of(progress, scale_share, 1.0), [&](const auto* all) {
    for (size_t i = 0; i < codes.size(); ++i) codes[i] = result.gray.code(static_cast<double>(all[i]));
    ct::write_values(values, codes.data(), codes.size());
  });
  result.place = std::move(layers.place);
  return result;
}

/// HU as codes.
GrayValues write_ct(const fs::path& path, const fs::path& values, const Progress& progress) {
  GrayValues result{read_ct_files(path, {}, progress), {hu_offset, 1.0, true}};
  std::vector<uint16_t> codes(result.place.hu.size());
  std::transform(result.place.hu.begin(), result.place.hu.end(), codes.begin(),
                 [](int16_t hu) { return static_cast<uint16_t>(hu + 32768); });
  ct::write_values(values, codes.data(), codes.size());
  return result;
}

}  // namespace

GrayValues write_gray_values(const fs::path& path, const fs::path& values, uint64_t max_bytes,
                             const Progress& progress) {
  return ct::kind_by_name(path) == ct::CtFileKind::volume ? write_layers(path, values, max_bytes, progress)
                                                          : write_ct(path, values, progress);
}

}  // namespace ream::reader
