#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "access/role.hpp"
#include "access/secret.hpp"
#include "core/clock.hpp"
#include "core/utc.hpp"
#include "store/credential_table.hpp"

namespace ream::access {

/// token: of programs, shown with every request. cookie: of a page after a login. link: lets a page watch.
enum class CredentialKind { token, cookie, link };

struct Lifetimes {
  std::chrono::seconds cookie_idle = std::chrono::hours(2);  ///< without any use
  std::chrono::seconds cookie = std::chrono::hours(24);
  std::chrono::seconds token = std::chrono::hours(24 * 90);  ///< unless asked otherwise
  std::chrono::seconds link = std::chrono::hours(12);        ///< unless asked otherwise
  std::chrono::seconds max = std::chrono::hours(24 * 366);
};

/// Whom a good credential stands for.
struct Identity {
  std::string credential;  ///< its id
  CredentialKind kind = CredentialKind::token;
  std::string user_id;  ///< empty: nobody in particular, a viewer by link
  std::string name, display_name;
  Role role = Role::viewer;
  std::string only_session;  ///< empty: not restricted
  std::string expires_utc;
};

/// What a new credential is for.
struct NewCredential {
  std::string user_id;         ///< whose; of a link: who makes it
  std::optional<Role> limit;   ///< of a token: at most this; none: what the user has
  std::string name;            ///< for people
  std::string only_session;    ///< of a link
  std::string expires_utc;     ///< empty: the default lifetime
  std::string parent_id = {};  ///< of a cookie: the link it was made with
};

struct IssuedCredential {
  store::CredentialRow row;
  Secret secret;  ///< for its owner, once; kept nowhere
};

/// Tokens, cookie sessions and viewer links. What has ended stays so when the machine's clock goes back: the
/// latest time that was seen is kept, and what had ended by it goes; so does what was made by a clock that
/// was ahead, as it would be good for too long. What was looked up is cached for `cache_time`, so that is how
/// long another process may take to see a revocation; in this one it holds at once. Thread-safe; errors are
/// those of the database.
class Credentials {
 public:
  static constexpr std::chrono::milliseconds cache_time{2000};

  explicit Credentials(store::Database& database, WallClock now = machine_clock(), Lifetimes lifetimes = {});

  /// None unless that secret is one of that kind and good now. Counts as a use.
  std::optional<Identity> identify(const Secret& secret, CredentialKind kind);
  /// Of a credential that was shown before and is still used: somebody watches. None when it is good no more.
  std::optional<Identity> identify_again(const std::string& id);

  /// Error invalid_input for an expiry in the past or too far away.
  IssuedCredential issue(CredentialKind kind, const NewCredential& request);

  /// Newest first; `user_id` empty: everybody's. Those that have ended are left out.
  std::vector<store::CredentialRow> list(CredentialKind kind, const std::string& user_id) const;
  /// None when there is none of that kind.
  std::optional<store::CredentialRow> find(const std::string& id, CredentialKind kind) const;

  /// With all that were made with it.
  void revoke(const std::string& id);
  /// A new password: all that a user has and has made but `except`; with `keep_tokens` cookie sessions only.
  void end_old_logins(const std::string& user_id, const std::string& except, bool keep_tokens);
  /// Viewer links that a user has made.
  void revoke_links(const std::string& user_id);
  /// All that a user has and has made.
  void revoke_all(const std::string& user_id);
  /// All that a user has is looked up anew, for the user may now do more or less.
  void renew(const std::string& user_id);

  /// The first user has come: `ids` were nobody's and are removed. What was let in without any credential, as
  /// long as the server was open, hears of it as of the id "".
  void end_open_beginning(std::vector<std::string> ids);

  /// Called with the ids of what is no longer as it was: revoked or renewed here. On the thread that did it.
  /// To be set before use.
  void on_change(std::function<void(const std::vector<std::string>&)> called) {
    on_change_ = std::move(called);
  }

 private:
  struct CachedCredential {
    store::KnownCredential known;
    SteadyClock::time_point since;
  };
  std::optional<store::KnownCredential> look_up(const std::string& id);
  std::optional<Identity> identity_of(const store::KnownCredential& known, UtcMoment now) const;
  /// The machine's time. When it has gone back, what had ended is removed first: to be asked before anything
  /// is looked up or made.
  UtcMoment judged_time();
  void turn_back(UtcMoment now);
  void note_use(const store::CredentialRow& row);
  void invalidate(const std::vector<std::string>& ids);

  store::CredentialTable table_;
  const WallClock now_;
  const Lifetimes lifetimes_;
  std::function<void(const std::vector<std::string>&)> on_change_;
  std::mutex mutex_;
  std::map<std::string, CachedCredential> cache_;
  uint64_t invalidations_ = 0;  ///< counts what invalidates look-ups that are under way
  std::mutex time_mutex_;
  std::optional<UtcMoment> latest_;  ///< that was seen; none: not read yet
  UtcMoment latest_kept_{};          ///< in the database
};

/// "token", "cookie" or "link".
std::string to_text(CredentialKind kind);

}  // namespace ream::access
