#include "api/audit_rules.hpp"

#include <array>
#include <string_view>

namespace ream::api {
namespace {

struct AuditRule {
  std::string_view method, pattern, action;
};

constexpr std::array<AuditRule, 6> audit_rules = {
    {{"DELETE", "/api/v1/sessions/{id}", "session.delete"},
     {"POST", "/api/v1/sessions/{id}/restore", "session.restore"},
     {"GET", "/api/v1/sessions/{id}/recording", "session.download"},
     {"POST", "/api/v1/sessions/{id}/exports", "session.export"},
     {"POST", "/api/v1/sessions/{id}/score", "session.score"},
     {"DELETE", "/api/v1/cases/{id}", "case.delete"}}};

}  // namespace

void audit_change(const Audit& audit, const net::Request& request, const std::string& pattern,
                  const net::Response& response) {
  if (response.status < 200 || response.status >= 300) return;
  for (const AuditRule& rule : audit_rules)
    if (request.method == rule.method && pattern == rule.pattern)
      audit(request, std::string(rule.action), request.parameters.at("id"), "");
}

}  // namespace ream::api
