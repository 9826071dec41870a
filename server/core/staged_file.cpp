#include "core/staged_file.hpp"

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream {

StagedFile::StagedFile(std::filesystem::path path, std::string_view text)
    : path_(std::move(path)), temporary_(path_) {
  temporary_ += ".staged.tmp";
  write_file_atomically(temporary_, text);
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void StagedFile::commit() {
  std::error_code failed;
  std::filesystem::rename(temporary_, path_, failed);
  if (failed) throw Error(ErrorKind::io, "cannot write " + path_.string() + ": " + failed.message());
  committed_ = true;
}

}  // namespace ream
