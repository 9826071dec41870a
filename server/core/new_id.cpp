#include "core/new_id.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <string_view>

#include "core/utc.hpp"

namespace ream {
namespace {

constexpr size_t id_length = 8;

std::string random_text(std::string_view letters, size_t length) {
  std::random_device entropy;
  std::uniform_int_distribution<size_t> pick(0, letters.size() - 1);
  std::string text;
  for (size_t i = 0; i < length; ++i) text += letters[pick(entropy)];
  return text;
}

}  // namespace

std::string utc_text(std::time_t time) {
  return ream::utc_text(std::chrono::system_clock::from_time_t(time));
}

std::string utc_now() { return utc_text(std::time(nullptr)); }

std::string utc_now_in_order() {
  using std::chrono::milliseconds;
  static std::atomic<int64_t> newest_ms{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  int64_t before = newest_ms, ms = 0;
  do ms = std::max(std::chrono::duration_cast<milliseconds>(now).count(), before + 1);
  while (!newest_ms.compare_exchange_weak(before, ms));
  std::string text = utc_text(static_cast<std::time_t>(ms / 1000));
  const std::string thousandths = std::to_string(1000 + ms % 1000);
  return text.insert(text.size() - 1, "." + thousandths.substr(1));
}

std::string random_id() { return random_text("23456789abcdefghjkmnpqrstuvwxyz", id_length); }

std::string random_participant_code() {
  std::string code = random_text("23456789BCDFGHJKMNPQRSTVWXYZ", 5);
  return code.insert(2, "-");
}

}  // namespace ream
