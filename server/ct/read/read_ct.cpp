#include "ct/read/read_ct.hpp"

#include <fcntl.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "ct/read/ct_file_names.hpp"
#include "ct/read/volume_answer.hpp"
#include "isolation/reader_process.hpp"

namespace ream::ct {
namespace {

constexpr double reading_share = 0.95;

void load_values(HuVolume& volume, const std::filesystem::path& file) {
  const FileDescriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  volume.hu.resize(volume.voxel_count());
  const auto bytes = std::as_writable_bytes(std::span(volume.hu));
  if (!in || in.read_at(0, bytes) != static_cast<ssize_t>(bytes.size()))
    throw Error(ErrorKind::io, "the reader wrote fewer values than its volume has");
}

HuVolume read(const char* task, const std::filesystem::path& path, const ReadOptions& options,
              const Progress& progress) {
  isolation::ReaderJob job;
  job.task = task;
  job.input = path;
  job.with_folder = names_another_file(path);
  job.options = {{"series_uid", options.series_uid},
                 {"keep_names", options.keep_names},
                 {"max_bytes", options.max_bytes}};
  job.scratch = options.scratch;
  const isolation::ReaderResult result = isolation::read_isolated(job, part_of(progress, 0.0, reading_share));
  HuVolume volume = volume_from(result.answer(), true);
  load_values(volume, result.file("values"));
  return volume;
}

}  // namespace

HuVolume read_ct(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  HuVolume volume = read("ct", path, options, progress);
  progress(1.0, "reading slices");
  return volume;
}

HuVolume read_volume_file(const std::filesystem::path& path) { return read("labels", path, {}, no_progress); }

}  // namespace ream::ct
