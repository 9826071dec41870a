#include "net/problem.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/json.hpp"
#include "core/log.hpp"

namespace ream::net {
namespace {

constexpr const char* failed_words = "the server failed on this request; its log says why";

}  // namespace

int http_status(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return 400;
    case ErrorKind::invalid_input: return 422;
    case ErrorKind::not_found: return 404;
    case ErrorKind::conflict: return 409;
    case ErrorKind::cancelled: return 409;
    case ErrorKind::unavailable: return 503;
    case ErrorKind::io: return 500;
  }
  return 500;
}

std::string status_title(int status) {
  switch (status) {
    case 200: return "OK";
    case 201: return "Created";
    case 202: return "Accepted";
    case 204: return "No Content";
    case 206: return "Partial Content";
    case 304: return "Not Modified";
    case 400: return "Bad Request";
    case 401: return "Unauthorized";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 408: return "Request Timeout";
    case 409: return "Conflict";
    case 412: return "Precondition Failed";
    case 413: return "Content Too Large";
    case 414: return "URI Too Long";
    case 415: return "Unsupported Media Type";
    case 416: return "Range Not Satisfiable";
    case 421: return "Misdirected Request";
    case 422: return "Unprocessable Content";
    case 426: return "Upgrade Required";
    case 428: return "Precondition Required";
    case 429: return "Too Many Requests";
    case 431: return "Request Header Fields Too Large";
    case 500: return "Internal Server Error";
    case 503: return "Service Unavailable";
    default: return "Error";
  }
}

Response problem(int status, const std::string& detail, const std::vector<FieldError>& errors) {
  nlohmann::json body = {
      {"type", "about:blank"}, {"title", status_title(status)}, {"status", status}, {"detail", detail}};
  for (const FieldError& error : errors)
    body["errors"].push_back({{"pointer", error.pointer}, {"detail", error.detail}});
  Response response = json_response(status, body);
  response.content_type = "application/problem+json";
  return response;
}

Response too_many_requests(const std::string& detail, double wait_s) {
  Response response = problem(429, detail);
  response.headers.emplace_back("Retry-After", std::to_string(std::max(1L, std::lround(std::ceil(wait_s)))));
  return response;
}

Response problem_of(const std::exception& failure) {
  if (const auto* request_error = dynamic_cast<const RequestError*>(&failure)) {
    Response response = problem(request_error->status(), request_error->what(), request_error->errors());
    const Headers& headers = request_error->headers();
    response.headers.insert(response.headers.end(), headers.begin(), headers.end());
    return response;
  }
  if (const auto* error = dynamic_cast<const Error*>(&failure)) {
    if (error->kind() == ErrorKind::io) log::error(error->what());
    return problem(http_status(error->kind()), error->what());
  }
  log::error(std::string("a request handler failed: ") + failure.what());
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr)
    return problem(503, "there is not enough memory for this request; try again later");
  return problem(500, failed_words);
}

Response problem_of_current_exception() noexcept {
  try {
    try {
      throw;
    } catch (const std::exception& failure) {
      return problem_of(failure);
    } catch (...) {
      log::current_exception("a request handler failed");
      return problem(500, failed_words);
    }
  } catch (...) {
    Response without_words;
    without_words.status = 503;
    return without_words;
  }
}

}  // namespace ream::net
