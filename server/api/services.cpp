#include "api/services.hpp"

namespace ream::api {

namespace {

access::Actor actor_of(const net::Request& request) {
  const net::Caller& caller = request.caller;
  return {caller.user_id, caller.name, caller.role, caller.credential, request.peer};
}

}  // namespace

void Services::audit(const net::Request& request, const std::string& action, const std::string& object,
                     const std::string& detail) const {
  access_control.audit.note(actor_of(request), action, object, detail);
}

void Services::audit_reading(const net::Request& request, const std::string& action,
                             const std::string& object) const {
  access_control.audit.note_reading(actor_of(request), action, object);
}

session::SessionRecord Services::seen(const net::Caller& caller, session::SessionRecord record) const {
  if (record.request.study.empty()) return record;
  return studies.blinding(caller).seen(std::move(record));
}

}  // namespace ream::api
