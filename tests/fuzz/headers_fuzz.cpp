// Values of single headers: ranges, entity tags, hosts, names of downloads, cookies, tokens; and a request's
// target.
#include "api/login_cookie.hpp"
#include "fuzz_input.hpp"
#include "net/conditional.hpp"
#include "net/file_body.hpp"
#include "net/guard.hpp"
#include "net/problem.hpp"

namespace ream::fuzz {
namespace {

void read_ranges(std::string_view text) {
  for (const uint64_t size : {uint64_t{0}, uint64_t{1}, uint64_t{1000}, UINT64_MAX}) {
    const net::ByteRange range = net::read_range(text, size);
    if (range.answer != net::ByteRange::Answer::part) continue;
    require(range.bytes > 0 && range.bytes <= size && range.offset <= size - range.bytes,
            "a range leads out of its body");
  }
}

void read_tags(std::string_view text) {
  const bool weakly = net::names_tag(text, "\"a\""), strongly = net::names_tag_strongly(text, "\"a\"");
  require(weakly || !strongly, "a tag that is equal is not alike");
}

void read_names(const std::string& text) {
  const std::string attachment = net::attachment_named(text);
  for (const char c : attachment) require(c >= ' ' && c <= '~', "a name leaves its header");
  try {
    require(net::plain_host(net::plain_host(text)) == net::plain_host(text), "a plain host is not plain");
  } catch (const Error&) {
  }
}

void read_target(std::string_view text) {
  net::Request request;
  try {
    net::set_target(request, text);
  } catch (const net::RequestError&) {
    return;
  }
  require(request.path.starts_with('/') && request.path.find('\0') == std::string::npos, "a path is no path");
}

void read_guarded(const std::string& text, size_t cut) {
  net::Request request;
  request.method = "POST";
  request.headers["host"] = text.substr(0, cut);
  if (cut < text.size()) request.headers["origin"] = text.substr(cut);
  const std::vector<std::string> names{"ream.example.org"};
  const std::string local = "2001:db8::1";
  if (net::refuse_foreign(request, false, {names, local})) return;
  const std::string origin(request.header("origin"));
  require(origin.empty() || origin.size() == request.header("host").size() + 7 ||
              origin.size() == request.header("host").size() + 8,
          "an origin passes that is not the host");
}

void read_credentials(const std::string& text) {
  net::Request request;
  request.headers["cookie"] = text;
  const access::Secret cookie = api::cookie_of(request);
  require(text.find(cookie.reveal()) != std::string::npos, "a cookie is not what was sent");
  request.headers["authorization"] = text;
  try {
    require(
        !api::bearer_token_of(request).reveal().empty() || text.find_first_not_of(" \t") == std::string::npos,
        "a token is empty");
  } catch (const net::RequestError&) {
  }
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream::fuzz;
  Input input(data, size);
  const size_t cut = input.byte();
  const std::string text(input.rest());
  read_ranges(text);
  read_tags(text);
  read_names(text);
  read_target(text);
  read_credentials(text);
  read_guarded(text, std::min(cut, text.size()));
  return 0;
}
