#pragma once
#include <functional>
#include <string>

#include "net/message.hpp"

namespace ream::api {

/// Keeps who has changed access or data: one row a change, after it has happened. `action` is a word such as
/// "session.delete", `object` the id of what was changed, `detail` a few words for people, never a secret.
/// Does nothing where there is no database. Never throws: what cannot be kept is said in the log.
using Audit = std::function<void(const net::Request& request, const std::string& action,
                                 const std::string& object, const std::string& detail)>;

/// For servers that keep none.
inline Audit no_audit() {
  return [](const net::Request&, const std::string&, const std::string&, const std::string&) {};
}

}  // namespace ream::api
