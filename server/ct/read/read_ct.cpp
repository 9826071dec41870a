#include "ct/read/read_ct.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "ct/read/volume_answer.hpp"
#include "ct/read/volume_job.hpp"
#include "isolation/isolated_job.hpp"

namespace ream::ct {
namespace {

constexpr double reading_share = 0.95;

HuVolume read(const char* task, const std::filesystem::path& path, const ReadOptions& options,
              const Progress& progress) {
  isolation::IsolatedJob job = volume_job(task, path, options.reader);
  job.options = {{"series_uid", options.series_uid},
                 {"keep_names", options.keep_names},
                 {"max_bytes", options.max_bytes}};
  job.scratch = options.scratch;
  const isolation::IsolatedResult result =
      isolation::run_isolated(job, part_of(progress, 0.0, reading_share));
  HuVolume volume = volume_from(result.answer(), true);
  const uint64_t bytes = sizeof(int16_t) * volume.voxel_count();
  if (bytes > options.max_bytes)
    throw Error(ErrorKind::io, "the reader answered with a volume of " + std::to_string(bytes) +
                                   " bytes, where at most " + std::to_string(options.max_bytes) +
                                   " are taken");
  result.require_bytes("values", bytes);
  volume.hu = result.values<int16_t>("values", bytes);
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
