#include "store/database_url.hpp"

#include <utility>

#include "core/error.hpp"

namespace ream::store {
namespace {

constexpr std::string_view sqlite_scheme = "sqlite:";

/// What libpq is told unless the URI says otherwise: a server that has gone is noticed within seconds, and
/// texts are UTF-8.
constexpr std::pair<const char*, const char*> default_parameters[] = {
    {"connect_timeout", "3"},     {"keepalives_idle", "5"},      {"keepalives_interval", "2"},
    {"keepalives_count", "3"},    {"tcp_user_timeout", "10000"}, {"client_encoding", "UTF8"},
    {"application_name", "ream"},
};

bool names_parameter(const std::string& parameters, const std::string& name) {
  return ("&" + parameters).find("&" + name + "=") != std::string::npos;
}

DatabaseUrl sqlite_url(const std::string& text) {
  DatabaseUrl url;
  url.file = text.substr(sqlite_scheme.size());
  const std::string file = url.file.string();
  if (file.empty() || file.front() == ':' || file.find_first_of("\"\n") != std::string::npos)
    throw Error(ErrorKind::usage, "'" + text + "' names no file; give sqlite:FILE");
  url.shown = text;
  return url;
}

DatabaseUrl postgresql_url(const std::string& text, size_t scheme_length) {
  DatabaseUrl url;
  url.postgresql = true;
  const size_t question = text.find('?');
  const std::string parameters = question == std::string::npos ? "" : text.substr(question + 1);
  const std::string place = text.substr(scheme_length, question - scheme_length);
  const size_t slash = place.find('/');
  const size_t at = place.substr(0, slash).rfind('@');
  const std::string user = at == std::string::npos ? "" : place.substr(0, at);
  url.has_password = user.find(':') != std::string::npos || names_parameter(parameters, "password");
  url.shown = "postgresql://" + (at == std::string::npos ? place : place.substr(at + 1));
  url.connect = text;
  char separator = question == std::string::npos ? '?' : '&';
  for (const auto& [name, value] : default_parameters) {
    if (names_parameter(parameters, name)) continue;
    url.connect += separator + std::string(name) + "=" + value;
    separator = '&';
  }
  return url;
}

}  // namespace

DatabaseUrl parse_database_url(const std::string& text) {
  if (text.starts_with(sqlite_scheme)) return sqlite_url(text);
  for (const std::string_view scheme : {"postgresql://", "postgres://"})
    if (text.starts_with(scheme)) return postgresql_url(text, scheme.size());
  throw Error(ErrorKind::usage,
              "a database is named as sqlite:FILE or postgresql://user@host:port/name, without spaces");
}

bool is_there(const DatabaseUrl& url) {
  std::error_code failed;
  return url.postgresql || std::filesystem::exists(url.file, failed);
}

}  // namespace ream::store
