#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/file_descriptor.hpp"

namespace ream::fe {

/// A text file line by line, from any place of it, in pieces.
class LineReader {
 public:
  /// Throws Error not_found or io.
  explicit LineReader(const std::filesystem::path& path);

  /// Goes to a place where a line begins.
  void seek(uint64_t byte, uint64_t line_number);
  /// False at the end. The line, without its break, is valid until the next call.
  bool next(std::string_view& line);
  /// Of the line that next() gave last.
  uint64_t byte() const { return line_byte_; }
  uint64_t number() const { return number_ - 1; }
  uint64_t file_bytes() const { return file_bytes_; }

 private:
  bool fill();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::vector<char> text_;
  size_t at_ = 0, filled_ = 0;
  uint64_t text_byte_ = 0, file_bytes_ = 0, line_byte_ = 0, number_ = 1;
};

/// Reads a whole number and the comma behind it; false when there is none. Advances `at`.
bool read_id(const char*& at, const char* end, uint64_t& id);
/// The same for a number with decimals.
bool read_real(const char*& at, const char* end, double& value);

}  // namespace ream::fe
