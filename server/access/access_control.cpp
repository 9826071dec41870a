#include "access/access_control.hpp"

#include "core/log.hpp"

namespace ream::access {

void AuditLog::note(const Actor& actor, const std::string& action, const std::string& object,
                    const std::string& detail) noexcept {
  try {
    table_.add({0, utc_text(now_()), actor.user_id, actor.name, actor.role, actor.credential, actor.address,
                action, object, detail});
  } catch (const std::exception& failure) {
    log::error("not in the audit log: " + action + " " + object + " by '" + actor.name +
               "': " + failure.what());
  }
}

}  // namespace ream::access
