#pragma once
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "store/user_table.hpp"

namespace ream::store {

/// A token, a cookie session or a viewer link. Its secret is kept as a hash only.
struct CredentialRow {
  std::string id;
  std::string kind;        ///< token, cookie or link
  std::string hash;        ///< of the secret
  std::string user_id;     ///< whose it is, of a link who made it; empty: nobody's
  std::string role;        ///< at most this; empty: what the user has
  std::string name;        ///< for people
  std::string session_id;  ///< the only session it shows; empty: not restricted
  std::string parent_id;   ///< credential that it was made with and ends with; empty: none
  std::string created_utc, expires_utc, last_used_utc;

  bool operator==(const CredentialRow&) const = default;
};

/// A credential with what decides whether it is good.
struct KnownCredential {
  CredentialRow credential;
  std::optional<UserRow> user;  ///< whose user_id it has; none when that is nobody or has gone
};

/// What people and programs show to be let in. Thread-safe; errors are those of Database.
class CredentialTable {
 public:
  explicit CredentialTable(Database& database) : database_(database) {}

  void add(const CredentialRow& row);
  std::optional<KnownCredential> find(const std::string& id) const;
  /// Of one kind, newest first; `user_id` empty: everybody's.
  std::vector<CredentialRow> list(const std::string& kind, const std::string& user_id) const;
  /// Unknown ids are no error.
  void note_use(const std::string& id, const std::string& utc);

  /// Removes one and all that were made with it; ids of what is gone.
  std::vector<std::string> remove(const std::string& id);
  /// Removes a user's, of one kind or (`kind` empty) all, but `except`, with all that were made with them.
  std::vector<std::string> remove_of_user(const std::string& user_id, const std::string& kind,
                                          const std::string& except);
  /// The latest time they were judged by; empty: none yet.
  std::string latest_time() const;
  void note_latest_time(const std::string& utc);
  /// The clock has gone back from `latest` to `now`: removes those that had ended by then, cookies that were
  /// used last before `idle_since` among them, and those that were made later than now. Ids of what is gone.
  std::vector<std::string> turn_back(const std::string& latest, const std::string& now,
                                     const std::string& idle_since);
  /// Those that ended before that moment.
  void remove_expired(const std::string& before_utc);

 private:
  Database& database_;
};

}  // namespace ream::store
