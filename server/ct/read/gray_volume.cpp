#include "ct/read/gray_volume.hpp"

#include <fcntl.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/json_reader.hpp"
#include "ct/read/volume_answer.hpp"
#include "isolation/reader_process.hpp"

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

isolation::ReaderResult read_codes(const fs::path& path, uint64_t max_bytes, const Progress& progress) {
  isolation::ReaderJob job;
  job.task = "gray";
  job.input = path;
  job.with_folder = path.extension() == ".nhdr" || path.extension() == ".mhd";
  job.options = {{"max_bytes", max_bytes}};
  return isolation::read_isolated(job, progress);
}

}  // namespace

struct GrayVolume::Contents {
  Contents(const fs::path& path, uint64_t max_bytes, const Progress& progress)
      : read(read_codes(path, max_bytes, progress)) {
    if (read.answer().contains("rows")) return;
    place = volume_from(read.answer()["volume"], true);
    gray = scale_from(read.answer()["gray"]);
    file = FileDescriptor(::open(read.file("values").c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  }

  isolation::ReaderResult read;
  HuVolume place;  ///< everything but the values
  voxel::GrayScale gray;
  FileDescriptor file;
};

GrayVolume::GrayVolume(const fs::path& path, uint64_t max_bytes, const Progress& progress)
    : contents_(std::make_unique<Contents>(path, max_bytes, progress)) {}

GrayVolume::~GrayVolume() = default;
GrayVolume::GrayVolume(GrayVolume&&) noexcept = default;
GrayVolume& GrayVolume::operator=(GrayVolume&&) noexcept = default;

const Vec3i& GrayVolume::dims() const { return contents_->place.dims; }
const Vec3& GrayVolume::spacing_mm() const { return contents_->place.spacing_mm; }
const Pose& GrayVolume::world_from_volume() const { return contents_->place.world_from_volume; }
const voxel::GrayScale& GrayVolume::gray() const { return contents_->gray; }
const std::vector<std::string>& GrayVolume::warnings() const { return contents_->place.warnings; }

fs::path GrayVolume::rows() const { return contents_->file ? fs::path() : contents_->read.file("rows"); }

void GrayVolume::read_layer(int w, std::span<uint16_t> codes) const {
  const Vec3i& dims = contents_->place.dims;
  const auto layer =
      std::as_writable_bytes(codes.first(static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y())));
  if (contents_->file.read_at(static_cast<uint64_t>(w) * layer.size(), layer) !=
      static_cast<ssize_t>(layer.size()))
    throw Error(ErrorKind::io,
                "the values of the volume cannot be read back; is the disk for temporary files full?");
}

}  // namespace ream::ct
