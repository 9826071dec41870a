#include "api/idempotency.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "core/log.hpp"
#include "net/problem.hpp"

namespace ream::api {
namespace {

constexpr size_t max_body_bytes = size_t{256} * 1024, max_in_memory = 1000;

bool is_key(std::string_view key) {
  return !key.empty() && key.size() <= Idempotency::max_key_length &&
         std::all_of(key.begin(), key.end(), [](char c) { return c > 0x20 && c < 0x7f; });
}

int64_t in_ms(UtcMoment moment) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(moment.time_since_epoch()).count();
}

/// Tells different requests apart.
std::string print_of(const net::Request& request) {
  uint64_t print = hash_text(request.body, hash_text(request.path, hash_text(request.method)));
  for (const auto& [name, value] : request.query) print = hash_text(value, hash_text(name, print));
  return to_hex(print);
}

net::Response response_of(const store::StoredResponse& answer) {
  net::Response response = net::bytes_response(answer.status, answer.content_type, nullptr);
  if (!answer.body.empty()) response.body = net::share(answer.body);
  response.headers.emplace_back("Cache-Control", "no-store");
  if (!answer.location.empty()) response.headers.emplace_back("Location", answer.location);
  response.headers.emplace_back("Idempotency-Replayed", "true");
  return response;
}

std::string text_of(const net::SharedBytes& body) {
  return body ? std::string(reinterpret_cast<const char*>(body->data()), body->size()) : std::string();
}

}  // namespace

int64_t Idempotency::oldest_ms() const { return in_ms(now_() - kept_for); }

std::optional<store::StoredResponse> Idempotency::find(const Name& name) {
  std::optional<store::StoredResponse> found;
  {
    const std::lock_guard lock(mutex_);
    if (const auto kept = in_memory_.find(name); kept != in_memory_.end()) found = kept->second;
  }
  if (!found) found = table_.find(name.first, name.second);
  return found && found->at_ms >= oldest_ms() ? found : std::nullopt;
}

void Idempotency::keep(const Name& name, const std::string& request, const net::Response& response,
                       Place place) {
  if (response.status >= 300 || response.body_bytes() > max_body_bytes) return;
  const store::StoredResponse answer{name.first,
                                     name.second,
                                     request,
                                     response.status,
                                     response.content_type,
                                     std::string(response.header("Location")),
                                     text_of(response.body),
                                     in_ms(now_())};
  if (place == Place::memory) {
    const std::lock_guard lock(mutex_);
    in_memory_[name] = answer;
    if (in_memory_.size() > max_in_memory)
      in_memory_.erase(
          std::min_element(in_memory_.begin(), in_memory_.end(),
                           [](const auto& a, const auto& b) { return a.second.at_ms < b.second.at_ms; }));
    return;
  }
  try {
    table_.put(answer);
  } catch (const Error& error) {
    log::warn(std::string("an answer could not be kept for its repetition: ") + error.what());
  }
}

net::Response Idempotency::answer(const net::Request& request, const net::Handler& next, Place place) {
  const std::string_view key = request.header(header);
  if (!request.headers.contains(header)) return next(request);
  if (!is_key(key))
    throw net::RequestError(
        400, "Idempotency-Key must be 1 to " + std::to_string(max_key_length) + " visible ASCII characters");
  const Name name(request.caller.user_id, key);
  const std::string print = print_of(request);
  {
    const std::lock_guard lock(mutex_);
    if (!under_way_.insert(name).second)
      throw net::RequestError(409, "the first request with this Idempotency-Key is still under way");
  }
  struct Done {
    Idempotency& all;
    const Name& name;
    ~Done() {
      const std::lock_guard lock(all.mutex_);
      all.under_way_.erase(name);
    }
  } const done{*this, name};
  if (const auto before = find(name)) {
    if (before->request != print)
      throw net::RequestError(422, "this Idempotency-Key was used for another request; use a new one");
    return response_of(*before);
  }
  net::Response response = next(request);
  keep(name, print, response, place);
  return response;
}

void Idempotency::forget_old() {
  table_.remove_before(oldest_ms());
  const std::lock_guard lock(mutex_);
  std::erase_if(in_memory_, [oldest = oldest_ms()](const auto& kept) { return kept.second.at_ms < oldest; });
}

void Idempotency::forget_about(const std::string& id) {
  table_.remove_about(id);
  const std::lock_guard lock(mutex_);
  std::erase_if(in_memory_, [&](const auto& kept) { return kept.first.first == id; });
}

}  // namespace ream::api
