#include "access/login_backoff.hpp"

#include <arpa/inet.h>

#include <algorithm>

#include "access/secret.hpp"

namespace ream::access {
namespace {

using std::chrono::seconds;
constexpr BackoffPolicy both_policy{4, seconds(900), seconds(24 * 3600)},
    name_policy{20, seconds(300), seconds(3600)}, place_policy{20, seconds(60), seconds(900)};
constexpr int64_t day_ms = 24 * 3600 * 1000, places_ms = 90 * day_ms;

/// What was typed as a name may be a password, so keys are hashes. That of name and place begins with the
/// name's.
struct Keys {
  Keys(const std::string& typed_name, const std::string& address)
      : name("name:" + hash_of(Secret(std::string_view(typed_name)))),
        place("place:" + hash_of(Secret(place_of(address)))),
        both(name + "@" + place) {}
  const std::string name, place, both;
};

int64_t counted_from(int64_t now_ms, const BackoffPolicy& policy) {
  return now_ms - 1000 * policy.forget_after.count();
}

/// Negative or 0: no longer.
int64_t wait_ms(const store::LoginFailures& failed, const BackoffPolicy& policy, int64_t now_ms) {
  if (failed.last_ms < counted_from(now_ms, policy)) return 0;
  return failed.last_ms + 1000 * wait_after(failed.failures, policy).count() - now_ms;
}

}  // namespace

std::string place_of(const std::string& address) {
  in6_addr six{};
  if (inet_pton(AF_INET6, address.c_str(), &six) != 1) return address;
  if (IN6_IS_ADDR_V4MAPPED(&six)) {
    char four[INET_ADDRSTRLEN];
    return inet_ntop(AF_INET, six.s6_addr + 12, four, sizeof four);
  }
  std::fill(six.s6_addr + 8, six.s6_addr + 16, uint8_t{0});
  char network[INET6_ADDRSTRLEN];
  return inet_ntop(AF_INET6, &six, network, sizeof network);
}

seconds wait_after(int failures, const BackoffPolicy& policy) {
  if (failures < policy.free_failures) return seconds(0);
  const int doublings = std::min(failures - policy.free_failures, 30);
  return std::min(seconds(int64_t{1} << doublings), policy.max_wait);
}

int64_t LoginBackoff::now_ms() const {
  return std::chrono::duration_cast<std::chrono::milliseconds>(now_().time_since_epoch()).count();
}

void LoginBackoff::require_allowed(const std::string& name, const std::string& address) {
  const Keys keys(name, address);
  const int64_t now = now_ms();
  auto found = attempts_.failures({keys.both, keys.name, keys.place});
  if (found.empty()) return;
  int64_t wait = wait_ms(found[keys.both], both_policy, now);
  const int64_t of_others =
      std::max(wait_ms(found[keys.name], name_policy, now), wait_ms(found[keys.place], place_policy, now));
  if (of_others > wait && !attempts_.knows_place(keys.both, now - places_ms)) wait = of_others;
  if (wait <= 0) return;
  const int retry_s = static_cast<int>((wait + 999) / 1000);
  throw TooManyAttempts("too many failed logins; try again in " + std::to_string(retry_s) + " s", retry_s);
}

void LoginBackoff::note_failure(const std::string& name, const std::string& address) {
  const Keys keys(name, address);
  const int64_t now = now_ms();
  attempts_.note_failure({{keys.both, counted_from(now, both_policy)},
                          {keys.name, counted_from(now, name_policy)},
                          {keys.place, counted_from(now, place_policy)}},
                         now, now - day_ms);
}

void LoginBackoff::note_success(const std::string& name, const std::string& address) {
  const Keys keys(name, address);
  const int64_t now = now_ms();
  attempts_.forget_failures(keys.both);
  attempts_.note_place(keys.both, now, now - places_ms);
}

void LoginBackoff::forget(const std::string& name) { attempts_.forget_failures(Keys(name, "").name); }

}  // namespace ream::access
