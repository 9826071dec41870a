#include "core/streamed_file.hpp"

#include <utility>

namespace ream {
namespace {

constexpr size_t piece_bytes = size_t{1} << 20;

}  // namespace

StreamedFile::StreamedFile(std::filesystem::path path) : file_(std::move(path)) {
  waiting_.reserve(2 * piece_bytes);
}

void StreamedFile::write(std::span<const std::byte> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.size() >= piece_bytes) flush();
}

void StreamedFile::flush() {
  file_.write_at(written_bytes_, waiting_);
  written_bytes_ += waiting_.size();
  waiting_.clear();
}

void StreamedFile::finish() {
  flush();
  file_.finish();
}

void StreamedFile::commit() {
  finish();
  file_.commit();
}

}  // namespace ream
