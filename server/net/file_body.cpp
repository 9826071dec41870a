#include "net/file_body.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "net/conditional.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

std::string tag_of(const struct stat& facts) {
  uint64_t hash = mix64(static_cast<uint64_t>(facts.st_ino));
  for (const auto part : {static_cast<uint64_t>(facts.st_size), static_cast<uint64_t>(facts.st_mtim.tv_sec),
                          static_cast<uint64_t>(facts.st_mtim.tv_nsec)})
    hash = hash_combine(hash, part);
  return "\"" + to_hex(hash) + "\"";
}

bool is_plain_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         c == '.';
}

Response part_of(Response response, const ByteRange& range) {
  const uint64_t whole = response.file->bytes;
  response.status = 206;
  response.file->offset = range.offset;
  response.file->bytes = range.bytes;
  response.headers.emplace_back("Content-Range", "bytes " + std::to_string(range.offset) + "-" +
                                                     std::to_string(range.offset + range.bytes - 1) + "/" +
                                                     std::to_string(whole));
  return response;
}

Response nothing_of(uint64_t whole) {
  Response response =
      problem(416, "the range is outside of the file, which has " + std::to_string(whole) + " bytes");
  response.headers.emplace_back("Content-Range", "bytes */" + std::to_string(whole));
  return response;
}

/// Digits only; a number beyond 64 bits is as good as the largest.
std::optional<uint64_t> number_in(std::string_view text) {
  uint64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || failed == std::errc::invalid_argument) return std::nullopt;
  return failed == std::errc() ? value : UINT64_MAX;
}

}  // namespace

// Without O_NONBLOCK a named pipe in place of the file would hold us.
OpenFile::OpenFile(const std::filesystem::path& path)
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (!file_ && (errno == ENOENT || errno == ENOTDIR))
    throw Error(ErrorKind::not_found, "no such file: " + path.string());
  struct stat facts {};
  if (!file_ || ::fstat(file_.get(), &facts) != 0)
    throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  if (!S_ISREG(facts.st_mode)) throw Error(ErrorKind::invalid_input, path.string() + " is no file");
  bytes_ = static_cast<uint64_t>(facts.st_size);
  tag_ = tag_of(facts);
}

size_t OpenFile::read(uint64_t offset, std::span<std::byte> into) const {
  const ssize_t got = file_.read_at(offset, into);
  if (got < 0) throw Error(ErrorKind::io, "cannot read " + path_.string() + ": " + std::strerror(errno));
  return static_cast<size_t>(got);
}

Response file_response(const Request& request, const FileBody& body) {
  const auto file = std::make_shared<const OpenFile>(body.path);
  Response response;
  response.headers = {
      {"ETag", file->tag()}, {"Cache-Control", "private, no-cache"}, {"Accept-Ranges", "bytes"}};
  if (names_tag(request.header("if-none-match"), file->tag())) {
    response.status = 304;
    return response;
  }
  response.content_type = body.content_type;
  if (!body.download_name.empty())
    response.headers.emplace_back("Content-Disposition", attachment_named(body.download_name));
  response.file = FileStretch{file, 0, file->bytes()};
  const std::string_view only_if = request.header("if-range");
  if (request.method != "GET" || (!only_if.empty() && !names_tag_strongly(only_if, file->tag())))
    return response;
  const ByteRange range = read_range(request.header("range"), file->bytes());
  if (range.answer == ByteRange::Answer::unsatisfiable) return nothing_of(file->bytes());
  return range.answer == ByteRange::Answer::part ? part_of(std::move(response), range) : response;
}

std::string attachment_named(const std::string& name) {
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string plain, encoded;
  for (const char c : name) {
    plain += is_plain_letter(c) ? c : '_';
    if (is_plain_letter(c)) {
      encoded += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      encoded += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return "attachment; filename=\"" + plain + "\"; filename*=UTF-8''" + encoded;
}

ByteRange read_range(std::string_view header, uint64_t size) {
  using Answer = ByteRange::Answer;
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit)) return {};
  const std::string_view range = header.substr(unit.size());
  const size_t dash = range.find('-');
  if (dash == std::string_view::npos) return {};
  const std::string_view first_text = range.substr(0, dash), last_text = range.substr(dash + 1);
  const auto first = number_in(first_text), last = number_in(last_text);
  if (first_text.empty()) {
    if (!last) return {};
    const uint64_t bytes = std::min(*last, size);
    return {bytes > 0 ? Answer::part : Answer::unsatisfiable, size - bytes, bytes};
  }
  if (!first || (!last && !last_text.empty()) || (last && *last < *first)) return {};
  if (*first >= size) return {Answer::unsatisfiable, 0, 0};
  const uint64_t end = last ? std::min(*last, size - 1) + 1 : size;
  return {Answer::part, *first, end - *first};
}

}  // namespace ream::net
