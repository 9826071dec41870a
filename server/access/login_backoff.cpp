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

/// What was typed as a name may be a password, so keys are hashes. Those of name and place, and of name and
/// device, begin with the name's.
struct Keys {
  Keys(const std::string& typed_name, const LoginOrigin& origin)
      : name("name:" + hash_of(Secret(std::string_view(typed_name)))),
        place("place:" + hash_of(Secret(place_of(origin.address)))),
        both(name + "@" + place),
        device(origin.device.empty() ? "" : name + "@device:" + hash_of(origin.device)) {}
  const std::string name, place, both, device;
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

bool LoginBackoff::knows_device(const std::string& key, const LoginOrigin& origin, int64_t now) const {
  if (key.empty()) return false;
  return origin.logged_in || attempts_.knows_place(key, now - places_ms);
}

void LoginBackoff::require_allowed(const std::string& name, const LoginOrigin& origin) {
  const Keys keys(name, origin);
  const int64_t now = now_ms();
  const bool by_itself = knows_device(keys.device, origin, now);
  auto found =
      by_itself ? attempts_.failures({keys.device}) : attempts_.failures({keys.both, keys.name, keys.place});
  if (found.empty()) return;
  if (std::any_of(found.begin(), found.end(), [&](const auto& one) { return one.second.last_ms > now; })) {
    attempts_.take_from_future(now);
    for (auto& [key, failed] : found) failed.last_ms = std::min(failed.last_ms, now);
  }
  int64_t wait = wait_ms(found[by_itself ? keys.device : keys.both], both_policy, now);
  const int64_t of_others =
      std::max(wait_ms(found[keys.name], name_policy, now), wait_ms(found[keys.place], place_policy, now));
  if (of_others > wait && !attempts_.knows_place(keys.both, now - places_ms)) wait = of_others;
  if (wait <= 0) return;
  const int retry_s = static_cast<int>((wait + 999) / 1000);
  throw TooManyAttempts("too many failed logins; try again in " + std::to_string(retry_s) + " s", retry_s);
}

void LoginBackoff::note_failure(const std::string& name, const LoginOrigin& origin) {
  const Keys keys(name, origin);
  const int64_t now = now_ms();
  using Counts = std::vector<store::LoginAttemptTable::Count>;
  const Counts counts = knows_device(keys.device, origin, now)
                            ? Counts{{keys.device, counted_from(now, both_policy)}}
                            : Counts{{keys.both, counted_from(now, both_policy)},
                                     {keys.name, counted_from(now, name_policy)},
                                     {keys.place, counted_from(now, place_policy)}};
  attempts_.note_failure(counts, now, now - day_ms);
}

void LoginBackoff::note_success(const std::string& name, const LoginOrigin& origin) {
  const Keys keys(name, origin);
  const int64_t now = now_ms();
  const bool by_itself = knows_device(keys.device, origin, now);
  attempts_.forget_failures(by_itself ? keys.device : keys.both);
  if (origin.logged_in) return;
  attempts_.note_place(keys.both, now, now - places_ms);
  if (!keys.device.empty()) attempts_.note_place(keys.device, now, now - places_ms);
}

void LoginBackoff::forget(const std::string& name) { attempts_.forget_failures(Keys(name, {}).name); }

}  // namespace ream::access
