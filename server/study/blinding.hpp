#pragma once
#include <set>
#include <string>

#include "net/message.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::study {

/// What one caller may know of who trained in sessions of studies: operators and the person everything,
/// others only the code until the study is unblinded. Who rates sessions of a study knows neither code nor
/// score until it is closed.
class Blinding {
 public:
  /// `unblinded`: ids of studies whose persons everybody may know who sees the session; `rated`: of open
  /// studies whose sessions the caller rates.
  Blinding(net::Caller caller, std::set<std::string> unblinded, std::set<std::string> rated)
      : caller_(std::move(caller)), unblinded_(std::move(unblinded)), rated_(std::move(rated)) {}

  /// While nothing can be looked up: all that may have to be hidden is.
  static Blinding of_nothing_known(net::Caller caller) {
    Blinding blinding(std::move(caller), {}, {});
    blinding.nothing_known_ = true;
    return blinding;
  }

  /// Whether the person is to be hidden.
  bool hides(const session::SessionRequest& session) const;
  /// Whether all that could sway a rater is to be hidden.
  bool hides_all(const session::SessionRequest& session) const;
  /// The session as the caller may see it: with the code for a name where the person is hidden.
  session::SessionRecord seen(session::SessionRecord record) const;

 private:
  bool is_own(const session::SessionRequest& session) const;

  net::Caller caller_;
  std::set<std::string> unblinded_, rated_;
  bool nothing_known_ = false;
};

}  // namespace ream::study
