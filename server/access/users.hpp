#pragma once
#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "access/credentials.hpp"
#include "access/login_backoff.hpp"
#include "access/password_hasher.hpp"
#include "access/role.hpp"
#include "core/clock.hpp"
#include "store/user_table.hpp"

namespace ream::access {

struct User {
  std::string id;
  std::string name;  ///< to log in with: [a-z0-9._@-], at most 64; looked for in small letters
  std::string display_name;
  Role role = Role::trainee;
  bool enabled = true;
  std::string created_utc;
};

struct NewUser {
  std::string name, display_name;  ///< display_name empty: the name
  Role role = Role::trainee;
  Secret password;
};

/// What is to change; what is absent stays.
struct UserChange {
  std::optional<std::string> display_name;
  std::optional<Role> role;
  std::optional<bool> enabled;
  std::optional<Secret> password;
  bool keep_tokens = false;  ///< when the password is new; see PasswordChange
};

/// Of one's own password. A new one ends what came by the old one: all logins but this, and tokens and links
/// too unless they are to stay, as whoever knew the old one may have made them.
struct PasswordChange {
  Secret present, wanted;
  std::string this_login = {};  ///< id of the credential that goes on
  bool keep_tokens = false;
};

/// Who may log in. There is always an operator who can, once there is anybody. Thread-safe. Errors:
/// not_found, conflict, invalid_input, TooManyAttempts (passwords), those of the database.
class Users {
 public:
  Users(store::Database& database, PasswordHasher& hasher, Credentials& credentials, LoginBackoff& backoff,
        WallClock now);

  /// Whether the server is past its open beginning. Asks the database at most once a second until then.
  bool any();

  /// The first one ends what was made and opened while everybody could do everything.
  User add(const NewUser& user);
  /// A new password ends what came by the old one and forgives failed logins; disabling revokes all.
  User change(const std::string& id, const UserChange& change);
  void remove(const std::string& id);

  User get(const std::string& id) const;
  std::optional<User> find_by_name(const std::string& name) const;
  /// By name.
  std::vector<User> list() const;

  /// The user when name and password belong together, after as long as it takes when they do not.
  /// Errors: TooManyAttempts.
  std::optional<User> log_in(const std::string& name, const Secret& password, const LoginOrigin& origin);
  /// One's own. False when the present password is another.
  bool change_password(const std::string& id, const PasswordChange& change, const LoginOrigin& origin);

 private:
  bool check_password(const std::optional<store::UserRow>& row, const std::string& name,
                      const Secret& password, const LoginOrigin& origin);

  void rehash(const store::UserRow& row, const Secret& password);

  store::UserTable table_;
  PasswordHasher& hasher_;
  Credentials& credentials_;
  LoginBackoff& backoff_;
  const WallClock now_;
  std::atomic<bool> any_{false};
  std::mutex mutex_;
  std::optional<SteadyClock::time_point> last_asked_;
};

bool is_user_name(const std::string& name);
/// Error invalid_input, which does not repeat it.
void require_user_name(const std::string& name);
/// Without control characters, line ends among them.
bool is_plain_line(const std::string& text);

}  // namespace ream::access
