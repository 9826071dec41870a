#pragma once
#include <chrono>
#include <string>

#include "access/secret.hpp"
#include "net/message.hpp"

namespace ream::api {

/// What a page keeps after a login: HttpOnly, never sent from other sites. Where there is TLS it is sent over
/// TLS only, and its name makes browsers refuse it from elsewhere (__Host-).
std::string login_cookie(const access::Secret& secret, std::chrono::seconds lifetime, bool encrypted);
/// Makes a page forget it.
std::string no_login_cookie(bool encrypted);

/// The cookie that a request shows; empty without one.
access::Secret cookie_of(const net::Request& request);
/// What tells a browser in which somebody has logged in from others (access::LoginOrigin); it lets nobody in.
std::string device_cookie(const access::Secret& secret, bool encrypted);
/// What the request shows of it; empty without one.
access::Secret device_of(const net::Request& request);
/// The bearer token that a request shows; empty without one. RequestError 401 when the Authorization header
/// is of another kind.
access::Secret bearer_token_of(const net::Request& request);

/// A 401 for people and programs; `error` as RFC 6750 has it, empty when nothing was shown.
[[noreturn]] void refuse_unknown(const std::string& detail, const std::string& error = {});

}  // namespace ream::api
