#pragma once
#include <string>
#include <vector>

#include "api/session_service.hpp"

namespace ream::api {

/// Sessions in the text format that Prometheus reads (version 0.0.4). Times are seconds.
std::string prometheus_text(const std::vector<SessionRecord>& records);

}  // namespace ream::api
