#pragma once
#include <string>

namespace ream::test {

/// Folder of the repository's files.
std::string source_folder();
/// Folder that this build was made in, where its programs lie.
std::string build_folder();

}  // namespace ream::test
