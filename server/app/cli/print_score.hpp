#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ream::app {

/// A score_document() for people, on stdout.
void print_score(const std::string& session, const nlohmann::json& document);

/// A score::learning_json for people, on stdout.
void print_learning(const std::string& trainee, const nlohmann::json& learning);

}  // namespace ream::app
