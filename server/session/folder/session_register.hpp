#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/folder/index_upkeep.hpp"
#include "session/folder/session_archive.hpp"
#include "store/session_query.hpp"

namespace ream::session {

/// A part of a list of sessions.
struct SessionPage {
  std::vector<SessionRecord> sessions;
  std::string next;  ///< cursor of the next page; empty: this is the last one
  size_t total = 0;  ///< sessions that the filters let pass, on all pages
};

/// Lists sessions: from the index in the database, corrected by what is not in it yet. Thread-safe.
class SessionRegister {
 public:
  /// Both outlive it.
  SessionRegister(const SessionArchive& archive, store::Database& database);

  /// `held`: those in the memory of this server, which count as they are now. Errors: invalid_input for a bad
  /// cursor or text; unavailable while the database cannot be reached.
  SessionPage list(const store::SessionQuery& query, std::vector<SessionRecord> held);

  /// Something of this session's folder was changed, so that its row is to be rebuilt.
  void changed(const std::string& id) { upkeep_.changed(id); }

 private:
  using RowAndRecord = std::pair<store::SessionRow, SessionRecord>;

  std::optional<SessionRecord> found(const std::string& id) const;
  std::vector<std::string> add_from_folders(std::vector<SessionRecord>& here);
  size_t add_from_index(const store::SessionQuery& query, const std::vector<std::string>& except,
                        std::vector<RowAndRecord>& listed);

  const SessionArchive& archive_;
  store::Database& database_;
  IndexUpkeep upkeep_;
};

}  // namespace ream::session
