#pragma once
#include <filesystem>
#include <string>

#include "isolation/isolated_job.hpp"

namespace ream::ct {

/// The reading of a volume by ream-reader, to be completed with its options. A header that names the file
/// with its voxels is read first, in a run of its own, so that nothing else of its folder can be read.
/// `program`: see IsolatedJob. Errors as run_isolated(); invalid_input for a name that is no plain one.
isolation::IsolatedJob volume_job(const std::string& task, const std::filesystem::path& path,
                                  const std::filesystem::path& program);

}  // namespace ream::ct
