#include "ct/read/gray_volume.hpp"

#include <fcntl.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/json_reader.hpp"
#include "ct/read/volume_answer.hpp"
#include "ct/read/volume_job.hpp"
#include "isolation/isolated_job.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

voxel::GrayScale scale_from(const nlohmann::json& answer) {
  JsonReader reader(answer, "the answer of the reader");
  voxel::GrayScale scale;
  scale.offset = reader.number("offset");
  scale.step = reader.number("step", 1e-300);
  scale.exact = reader.boolean("exact");
  return scale;
}

isolation::IsolatedResult read_codes(const fs::path& path, uint64_t max_bytes, const Progress& progress,
                                     const fs::path& reader) {
  isolation::IsolatedJob job = volume_job("gray", path, reader);
  job.options = {{"max_bytes", max_bytes}};
  return isolation::run_isolated(job, progress);
}

FileDescriptor opened(const fs::path& file) {
  return FileDescriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
}

template <typename T>
void read_at(const FileDescriptor& file, uint64_t first, std::span<T> values) {
  const auto bytes = std::as_writable_bytes(values);
  if (!file || file.read_at(first * sizeof(T), bytes) != static_cast<ssize_t>(bytes.size()))
    throw Error(ErrorKind::io,
                "the values of the volume cannot be read back; is the disk for temporary files full?");
}

size_t layer_voxels(const Vec3i& dims) {
  return static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y());
}

}  // namespace

struct GrayVolume::Contents {
  explicit Contents(isolation::IsolatedResult&& result) : read(std::move(result)) {
    place = volume_from(read.answer().at("volume"), true);
    gray = scale_from(read.answer().at("gray"));
    values = opened(read.file("values"));
    if (!read.answer().contains("given")) {
      read.require_bytes("values", sizeof(uint16_t) * place.voxel_count());
      return;
    }
    const uint64_t words = given_words_per_layer(place.dims) * static_cast<uint64_t>(place.dims.z());
    read.require_bytes("given", sizeof(uint64_t) * words);
    given = opened(read.file("given"));
    for (int w = 0; w < place.dims.z(); ++w) {
      uint64_t sum = before.empty() ? 0 : before.back();
      if (before.empty()) before.push_back(0);
      for (const uint64_t word : given_words(w)) sum += static_cast<uint64_t>(std::popcount(word));
      before.push_back(sum);
    }
    read.require_bytes("values", sizeof(uint16_t) * before.back());
  }

  std::vector<uint64_t> given_words(int w) const {
    std::vector<uint64_t> words(given_words_per_layer(place.dims));
    read_at(given, static_cast<uint64_t>(w) * words.size(), std::span(words));
    return words;
  }

  isolation::IsolatedResult read;
  HuVolume place;  ///< everything but the values
  voxel::GrayScale gray;
  FileDescriptor values, given;  ///< given: none where every voxel has a value
  std::vector<uint64_t> before;  ///< given voxels before each layer
};

GrayVolume::GrayVolume(const fs::path& path, uint64_t max_bytes, const Progress& progress,
                       const fs::path& reader)
    : contents_(std::make_unique<Contents>(read_codes(path, max_bytes, progress, reader))) {}

GrayVolume::~GrayVolume() = default;
GrayVolume::GrayVolume(GrayVolume&&) noexcept = default;
GrayVolume& GrayVolume::operator=(GrayVolume&&) noexcept = default;

const Vec3i& GrayVolume::dims() const { return contents_->place.dims; }
const Vec3& GrayVolume::spacing_mm() const { return contents_->place.spacing_mm; }
const Pose& GrayVolume::world_from_volume() const { return contents_->place.world_from_volume; }
const voxel::GrayScale& GrayVolume::gray() const { return contents_->gray; }
const std::vector<std::string>& GrayVolume::warnings() const { return contents_->place.warnings; }
bool GrayVolume::partly_given() const { return static_cast<bool>(contents_->given); }

void GrayVolume::read_layer(int w, std::span<int32_t> codes) const {
  const Contents& from = *contents_;
  const size_t count = layer_voxels(from.place.dims);
  const auto layer = static_cast<size_t>(w);
  if (!partly_given()) {
    std::vector<uint16_t> values(count);
    read_at(from.values, layer * count, std::span(values));
    std::copy(values.begin(), values.end(), codes.begin());
    return;
  }
  const std::vector<uint64_t> given = from.given_words(w);
  std::vector<uint16_t> values(from.before[layer + 1] - from.before[layer]);
  read_at(from.values, from.before[layer], std::span(values));
  size_t next = 0;
  for (size_t i = 0; i < count; ++i) {
    const bool has = (given[i / 64] >> i % 64 & 1u) != 0 && next < values.size();
    codes[i] = has ? int32_t{values[next++]} : no_code;
  }
}

}  // namespace ream::ct
