#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// A session in the index: what lists filter and sort by, and all that a list shows of it.
struct SessionRow {
  std::string id;
  std::string case_id, script;
  std::string state;        ///< the word of session.json
  std::string created_utc;  ///< "2026-01-31T12:00:00Z"
  double duration_s = 0.0;
  std::string trainee_id, trainee;  ///< user's id and name to show; empty without users
  std::string study, participant;   ///< empty outside studies
  std::string record;               ///< for the owner of the index: what the folder says, any text
  int64_t stamp = 0;                ///< of the folder's files when it was read; another stamp: read it again
  bool lasting = true;              ///< false: may change its state without a new stamp (it was left live)

  bool operator==(const SessionRow&) const = default;
};

/// Sessions of a data folder in the database, to be found quickly. Holds nothing that the folders do not
/// hold. Thread-safe; errors are those of Database.
class SessionIndex {
 public:
  explicit SessionIndex(Database& database) : database_(database) {}

  /// Adds rows, or replaces those with the same id; all or none.
  void put(const std::vector<SessionRow>& rows);
  /// Unknown ids are no error.
  void remove(const std::vector<std::string>& ids);
  std::optional<SessionRow> get(const std::string& id) const;
  /// Stamps of all sessions by id.
  std::map<std::string, int64_t> stamps() const;

 private:
  Database& database_;
};

}  // namespace ream::store
