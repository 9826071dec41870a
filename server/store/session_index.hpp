#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "store/session_query.hpp"

namespace ream::store {

/// Sessions of a data folder in the database, to be found quickly. Holds nothing that the folders do not
/// hold. Thread-safe; errors are those of Database, and invalid_input for texts that no database holds.
class SessionIndex {
 public:
  explicit SessionIndex(Database& database) : database_(database) {}

  /// Adds rows, or replaces those with the same id; all or none.
  void put(const std::vector<SessionRow>& rows);
  /// Unknown ids are no error.
  void remove(const std::vector<std::string>& ids);
  /// Nothing but these rows from now on.
  void replace_all(const std::vector<SessionRow>& rows);

  std::optional<SessionRow> get(const std::string& id) const;
  struct Mark {
    int64_t stamp = 0;
    bool lasting = true;
  };
  /// Of all sessions by id.
  std::map<std::string, Mark> marks() const;

  struct Found {
    std::vector<SessionRow> rows;  ///< at most `limit` + 1: one more tells that there is another page
    size_t total = 0;              ///< that the filters let pass, on all pages
  };
  /// In the query's order, without the sessions named in `except`. Error invalid_input for a bad cursor.
  Found find(const SessionQuery& query, const std::vector<std::string>& except = {}) const;

 private:
  Database& database_;
};

}  // namespace ream::store
