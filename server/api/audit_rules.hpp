#pragma once
#include <string>

#include "api/audit.hpp"
#include "net/message.hpp"

namespace ream::api {

/// Keeps that data was deleted or taken out, by the route that did it, once it was answered with `response`.
/// Changes of access and of studies are kept by their own resources, which know more.
void audit_change(const Audit& audit, const net::Request& request, const std::string& pattern,
                  const net::Response& response);

}  // namespace ream::api
