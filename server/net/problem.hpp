#pragma once
#include <exception>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/json_schema.hpp"
#include "net/message.hpp"

namespace ream::net {

/// One thing wrong with a request.
using FieldError = SchemaFault;

using Headers = std::vector<std::pair<std::string, std::string>>;

/// An Error whose HTTP status is more precise than its kind, with the places in the request at fault and what
/// headers its reply has (Retry-After, say).
class RequestError : public Error {
 public:
  RequestError(int status, const std::string& detail, std::vector<FieldError> errors = {},
               Headers headers = {})
      : Error(ErrorKind::invalid_input, detail),
        status_(status),
        errors_(std::move(errors)),
        headers_(std::move(headers)) {}
  int status() const { return status_; }
  const std::vector<FieldError>& errors() const { return errors_; }
  const Headers& headers() const { return headers_; }

 private:
  int status_;
  std::vector<FieldError> errors_;
  Headers headers_;
};

/// The one mapping of ErrorKind to an HTTP status: usage 400, invalid_input 422, not_found 404, conflict 409,
/// unavailable 503, io 500.
int http_status(ErrorKind kind);

/// Reason phrase: "Not Found" for 404; "Error" for a status this server never sends.
std::string status_title(int status);

/// application/problem+json (RFC 9457) with type, title, status, detail and, when given, errors[{pointer,
/// detail}].
Response problem(int status, const std::string& detail, const std::vector<FieldError>& errors = {});

/// 429 with Retry-After. `wait_s`: until there is room again, rounded up to whole seconds.
Response too_many_requests(const std::string& detail, double wait_s);

/// Problem of an exception that left a handler. Want of memory is a 503. What else is not an Error becomes a
/// plain 500; its words go to the log only.
Response problem_of(const std::exception& failure);

/// For a catch (...) around a handler: the problem of whatever it is, or 503 without words where there is not
/// even memory for them.
Response problem_of_current_exception() noexcept;

}  // namespace ream::net
