#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "session/running_session.hpp"

namespace ream::session {

/// What of a session people may change; what is absent stays as it is.
struct SessionChange {
  std::optional<std::string> title, trainee_id, trainee;
  std::optional<bool> keep;
};

void apply(const SessionChange& change, SessionRequest& request);

/// The labels of a session (who trains, for which study, what it is called, which attempt it is, theatre
/// mode) from and to session.json: what is empty is left out there. Throws json::exception for values of
/// other types.
void read_labels(const nlohmann::json& session, SessionRequest& request);
void write_labels(const SessionRequest& request, nlohmann::json& session);

/// The same for REST: every key, null for what is empty.
nlohmann::json labels_json(const SessionRequest& request);

/// Replaces the labels in the session.json of a session that has ended. Errors: conflict when a process has
/// the session; not_found when it left no folder; invalid_input for a damaged one; io, with nothing written.
void relabel_folder(const std::filesystem::path& folder, const SessionRequest& request);

}  // namespace ream::session
