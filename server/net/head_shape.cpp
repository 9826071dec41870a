#include "net/head_shape.hpp"

#include <set>
#include <string>

#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

constexpr std::string_view line_end = "\r\n";

[[noreturn]] void refuse(const std::string& what) {
  throw RequestError(400, "not a plain HTTP/1.1 request: " + what);
}

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The headers that say where a request ends and whom it is for.
struct Framing {
  bool length = false, host = false, coding = false;

  void take(const std::string& name, std::string_view value) {
    if (name == "content-length") {
      if (length) refuse("Content-Length comes twice");
      if (value.empty() || value.find_first_not_of("0123456789") != std::string_view::npos)
        refuse("Content-Length is no number");
      length = true;
    } else if (name == "transfer-encoding") {
      if (coding) refuse("Transfer-Encoding comes twice");
      if (lower(value) != "chunked") refuse("the only transfer coding is chunked");
      coding = true;
    } else if (name == "host") {
      if (host) refuse("Host comes twice");
      host = true;
    }
    if (length && coding) refuse("Content-Length and Transfer-Encoding exclude each other");
  }
};

void take_line(std::string_view line, const Limits& limits, Framing& framing) {
  if (line.size() > limits.header_line_bytes)
    throw RequestError(431, "a header line is over " + std::to_string(limits.header_line_bytes) + " bytes");
  if (line.front() == ' ' || line.front() == '\t') refuse("a header goes on in a second line");
  const size_t colon = line.find(':');
  if (colon == std::string_view::npos) refuse("a header line has no colon");
  const std::string_view name = line.substr(0, colon);
  if (name.empty() || name.find_first_of(" \t") != std::string_view::npos)
    refuse("white space in a header's name");
  framing.take(lower(name), trimmed(line.substr(colon + 1)));
}

}  // namespace

void require_plain_beginning(std::string_view beginning, size_t from, const Limits& limits) {
  if (beginning.size() > limits.header_bytes)
    throw RequestError(431, "the request header is over " + std::to_string(limits.header_bytes) + " bytes");
  for (size_t i = from; i < beginning.size(); ++i) {
    const auto c = static_cast<unsigned char>(beginning[i]);
    if (c == '\r') {
      if (i + 1 < beginning.size() && beginning[i + 1] != '\n') refuse("a stray CR");
    } else if (c == '\n') {
      if (i == 0 || beginning[i - 1] != '\r') refuse("a stray LF");
    } else if ((c < 32 && c != '\t') || c == 127) {
      refuse("a control character in its header");
    }
  }
}

void require_plain_head(std::string_view head, const Limits& limits) {
  require_plain_beginning(head, 0, limits);
  const size_t first = head.find(line_end);
  if (first > limits.target_bytes)
    throw RequestError(414, "the request line is over " + std::to_string(limits.target_bytes) + " bytes");
  Framing framing;
  size_t lines = 0;
  for (size_t begin = first + 2; begin < head.size();) {
    const size_t end = head.find(line_end, begin);
    if (end == begin) break;
    if (++lines > limits.header_lines)
      throw RequestError(431,
                         "the request has over " + std::to_string(limits.header_lines) + " header lines");
    take_line(head.substr(begin, end - begin), limits, framing);
    begin = end + line_end.size();
  }
}

}  // namespace ream::net
