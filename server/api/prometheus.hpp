#pragma once
#include <string>
#include <vector>

#include "session/service/session_service.hpp"

namespace ream::api {

/// Sessions in the text format that Prometheus reads (version 0.0.4). Times are seconds.
std::string prometheus_text(const std::vector<session::SessionRecord>& records);

}  // namespace ream::api
