#pragma once
#include <string>

namespace ream::net {

/// Who asks, as the router's gate has found out; net itself does not look. Without users everybody is an
/// operator with an empty user_id.
struct Caller {
  std::string user_id;       ///< empty: nobody in particular (no users, or a viewer link)
  std::string name;          ///< for people
  std::string role;          ///< operator, instructor, trainee, viewer; empty: not known (open routes only)
  std::string only_session;  ///< of a viewer link to one session; empty: not restricted
  std::string credential;    ///< id of the token, cookie session or link that was shown; never its secret
};

}  // namespace ream::net
