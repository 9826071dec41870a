#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ream::net {

/// Who asks, as the router's policy has found out; net itself does not look. Without users everybody is an
/// operator with an empty user_id.
struct Caller {
  std::string user_id;       ///< empty: nobody in particular (no users, or a viewer link)
  std::string name;          ///< for people
  std::string role;          ///< operator, instructor, trainee, viewer; empty: not known (open routes only)
  std::string only_session;  ///< of a viewer link to one session; empty: not restricted
  std::string credential;    ///< id of the token, cookie session or link that was shown; never its secret
};

using Bytes = std::vector<std::byte>;
/// Made once, sent to any number of connections, never changed after.
using SharedBytes = std::shared_ptr<const Bytes>;

SharedBytes share(std::string_view text);

/// One HTTP request as a handler sees it.
struct Request {
  std::string method;                             ///< as sent, "GET"
  std::string path;                               ///< percent-decoded, begins with '/', without the query
  std::map<std::string, std::string> query;       ///< decoded; the last of equal names wins
  std::map<std::string, std::string> headers;     ///< names in lower case; repeated ones joined by ", "
  std::map<std::string, std::string> parameters;  ///< what the {names} of the route's pattern matched
  std::string body;
  std::shared_ptr<const nlohmann::json> json;  ///< the body once it was read and checked; null: no JSON
  std::string peer;        ///< numeric address of the client, without the port; see TrustedProxies
  bool encrypted = false;  ///< came from there over TLS
  bool passed_on = false;  ///< by a proxy, as far as can be seen
  Caller caller;           ///< set by the router's policy

  /// Value of a header, empty when absent. `name` in lower case.
  std::string_view header(const std::string& name) const;
};

class OpenFile;

/// Bytes of a file that are read from disk in pieces while they are sent; see net/file_body.hpp.
struct FileStretch {
  std::shared_ptr<const OpenFile> file;
  uint64_t offset = 0, bytes = 0;
};

struct Response {
  int status = 200;
  std::string content_type;
  SharedBytes body;  ///< null: no body, or `file`
  std::vector<std::pair<std::string, std::string>> headers;
  std::optional<FileStretch> file = std::nullopt;  ///< instead of `body`

  /// First value of a header set by a handler, empty when absent; exact spelling.
  std::string_view header(std::string_view name) const;
  /// Of the body, wherever it comes from.
  uint64_t body_bytes() const { return file ? file->bytes : body ? body->size() : 0; }
};

/// application/json that no cache keeps.
Response json_response(int status, const nlohmann::json& body);
Response bytes_response(int status, std::string content_type, SharedBytes body);

/// Splits and decodes the target of a request line ("/a/b?c=d") into path and query.
/// Throws RequestError 400 on broken percent-encoding, encoded '/', '\' or control characters, or a target
/// that is not a path.
void set_target(Request& request, std::string_view target);

/// The head of a reply as it goes over the wire, up to and including the empty line: status, the reply's own
/// headers, those of `fixed` that it does not set itself, length and connection. A header that would break
/// out of its line is left out, and logged by its name.
std::string response_head(const Response& response,
                          const std::vector<std::pair<std::string, std::string>>& fixed, bool keep_alive);

}  // namespace ream::net
