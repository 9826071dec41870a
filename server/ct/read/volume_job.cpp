#include "ct/read/volume_job.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "core/text.hpp"
#include "ct/read/ct_file_names.hpp"

namespace ream::ct {
namespace {

constexpr size_t max_shown_name = 100;

/// Empty where the header holds the voxels itself. The answer is not trusted: whoever took the reader over
/// would name a file of somebody else.
std::string voxel_file_beside(isolation::IsolatedJob job) {
  job.task = "voxel_file";
  const isolation::IsolatedResult result = isolation::run_isolated(job);
  const std::string name = JsonReader(result.answer(), "the answer of the reader").text("name");
  if (name.starts_with('.') || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
    throw Error(ErrorKind::invalid_input, job.input.string() +
                                              ": its voxels must be in one file beside it, not in '" +
                                              one_line(name, max_shown_name) + "'");
  return name;
}

}  // namespace

isolation::IsolatedJob volume_job(const std::string& task, const std::filesystem::path& path,
                                  const std::filesystem::path& program) {
  isolation::IsolatedJob job;
  job.program = program;
  job.input = path;
  if (names_another_file(path)) job.neighbour = voxel_file_beside(job);
  job.task = task;
  return job;
}

}  // namespace ream::ct
