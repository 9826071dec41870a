#pragma once
#include <set>
#include <string>

#include "net/message.hpp"
#include "session/running_session.hpp"

namespace ream::study {

/// What one caller may know of who trained in sessions of studies: operators and the person everything,
/// others only the code until the study is unblinded.
class Blinding {
 public:
  /// `unblinded`: ids of studies whose persons everybody may know who sees the session.
  Blinding(net::Caller caller, std::set<std::string> unblinded)
      : caller_(std::move(caller)), unblinded_(std::move(unblinded)) {}

  /// Whether the person is to be hidden.
  bool hides(const session::SessionRequest& session) const;
  /// The session as the caller may see it: with the code for a name where the person is hidden.
  session::SessionRequest seen(session::SessionRequest session) const;

 private:
  net::Caller caller_;
  std::set<std::string> unblinded_;
};

}  // namespace ream::study
