#pragma once
#include <filesystem>
#include <string>

#include "isolation/reader_process.hpp"

namespace ream::ct {

/// The reading of a volume by ream-reader, to be completed with its options. A header that names the file
/// with its voxels is read first, in a run of its own, so that nothing else of its folder can be read.
/// `program`: see ReaderJob. Errors as read_isolated(); invalid_input for a name that is no plain one.
isolation::ReaderJob volume_job(const std::string& task, const std::filesystem::path& path,
                                const std::filesystem::path& program);

}  // namespace ream::ct
