#include "fe/line_reader.hpp"

#include <fcntl.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "core/error.hpp"

namespace ream::fe {
namespace {

constexpr size_t piece_bytes = 4 << 20;

void pass_blanks(const char*& at, const char* end) {
  while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
}

/// The comma behind a number, or the end.
bool pass_comma(const char*& at, const char* end) {
  pass_blanks(at, end);
  if (at == end) return true;
  return *at++ == ',';
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path) : path_(path), text_(piece_bytes) {
  if (!std::filesystem::is_regular_file(path))
    throw Error(ErrorKind::not_found, "no such file: " + path.string());
  file_ = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  file_bytes_ = std::filesystem::file_size(path);
}

void LineReader::seek(uint64_t byte, uint64_t line_number) {
  text_byte_ = byte;
  at_ = filled_ = 0;
  number_ = line_number;
}

/// More text behind what is left; false at the end of the file.
bool LineReader::fill() {
  std::memmove(text_.data(), text_.data() + at_, filled_ - at_);
  text_byte_ += at_;
  filled_ -= at_;
  at_ = 0;
  if (filled_ == text_.size()) text_.resize(2 * text_.size());
  const ssize_t n =
      file_.read_at(text_byte_ + filled_, std::as_writable_bytes(std::span(text_).subspan(filled_)));
  if (n < 0) throw Error(ErrorKind::io, "cannot read " + path_.string() + ": " + std::strerror(errno));
  filled_ += static_cast<size_t>(n);
  return n > 0;
}

bool LineReader::next(std::string_view& line) {
  size_t looked = 0;
  while (true) {
    const char* const begin = text_.data() + at_;
    const void* stop =
        filled_ > at_ + looked ? std::memchr(begin + looked, '\n', filled_ - at_ - looked) : nullptr;
    if (stop == nullptr) {
      looked = filled_ - at_;
      if (fill()) continue;
      if (filled_ == at_) return false;
    }
    const char* const end = stop != nullptr ? static_cast<const char*>(stop) : text_.data() + filled_;
    line = {text_.data() + at_, static_cast<size_t>(end - text_.data()) - at_};
    line_byte_ = text_byte_ + at_;
    at_ += line.size() + (stop != nullptr ? 1 : 0);
    ++number_;
    return true;
  }
}

bool read_id(const char*& at, const char* end, uint64_t& id) {
  pass_blanks(at, end);
  const char* const first = at;
  id = 0;
  while (at < end && *at >= '0' && *at <= '9' && at - first < 18)
    id = 10 * id + static_cast<uint64_t>(*at++ - '0');
  return at != first && pass_comma(at, end);
}

bool read_real(const char*& at, const char* end, double& value) {
  pass_blanks(at, end);
  const auto parsed = std::from_chars(at, end, value);
  if (parsed.ec != std::errc()) return false;
  at = parsed.ptr;
  return pass_comma(at, end);
}

}  // namespace ream::fe
