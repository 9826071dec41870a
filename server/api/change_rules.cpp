#include "api/change_rules.hpp"

#include <algorithm>
#include <array>

namespace ream::api {
namespace {

struct ChangeRule {
  const char* method;
  const char* pattern;
  const char* kind;
  const char* change;
};

/// Sessions tell of their own states (SessionWatch), jobs of theirs and of what they make.
constexpr std::array change_rules{
    ChangeRule{"PATCH", "/api/v1/sessions/{id}", "session", "changed"},
    ChangeRule{"POST", "/api/v1/sessions/{id}/annotations", "session", "annotated"},
    ChangeRule{"POST", "/api/v1/sessions/{id}/replay", "replay", "created"},
    ChangeRule{"POST", "/api/v1/sessions/{id}/score", "session", "scored"},
    ChangeRule{"DELETE", "/api/v1/cases/{id}", "case", "deleted"},
    ChangeRule{"PUT", "/api/v1/cases/{id}/landmarks", "case", "changed"},
    ChangeRule{"PUT", "/api/v1/cases/{id}/plan", "case", "changed"},
    ChangeRule{"POST", "/api/v1/cases/{id}/segmentation/undo", "case", "changed"},
    ChangeRule{"POST", "/api/v1/users", "user", "created"},
    ChangeRule{"PATCH", "/api/v1/users/{id}", "user", "changed"},
    ChangeRule{"DELETE", "/api/v1/users/{id}", "user", "deleted"},
    ChangeRule{"POST", "/api/v1/studies", "study", "created"},
    ChangeRule{"PUT", "/api/v1/studies/{id}", "study", "changed"},
    ChangeRule{"POST", "/api/v1/studies/{id}/close", "study", "changed"},
    ChangeRule{"POST", "/api/v1/studies/{id}/reopen", "study", "changed"},
    ChangeRule{"POST", "/api/v1/studies/{id}/unblind", "study", "changed"},
    ChangeRule{"DELETE", "/api/v1/studies/{id}/participants/{code}", "study", "changed"},
    ChangeRule{"PUT", "/api/v1/studies/{id}/participants/{code}/answers", "study", "changed"},
    ChangeRule{"DELETE", "/api/v1/studies/{id}", "study", "deleted"}};

}  // namespace

std::optional<Change> change_made(const net::Request& request, const std::string& pattern,
                                  const net::Response& response) {
  if (response.status >= 300) return std::nullopt;
  const auto rule = std::find_if(change_rules.begin(), change_rules.end(), [&](const ChangeRule& one) {
    return request.method == one.method && pattern == one.pattern;
  });
  if (rule == change_rules.end()) return std::nullopt;
  const std::string_view made = response.header("Location");
  const auto id = request.parameters.find("id");
  if (!made.empty()) return Change{rule->kind, std::string(made.substr(made.rfind('/') + 1)), rule->change};
  if (id == request.parameters.end()) return std::nullopt;
  return Change{rule->kind, id->second, rule->change};
}

}  // namespace ream::api
