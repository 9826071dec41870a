#include "api/new_id.hpp"

#include <random>
#include <string_view>

#include "core/utc.hpp"

namespace ream::api {
namespace {

constexpr size_t id_length = 8;

}  // namespace

std::string utc_text(std::time_t time) {
  return ream::utc_text(std::chrono::system_clock::from_time_t(time));
}

std::string utc_now() { return utc_text(std::time(nullptr)); }

std::string random_id() {
  static constexpr std::string_view letters = "23456789abcdefghjkmnpqrstuvwxyz";
  std::random_device entropy;
  std::uniform_int_distribution<size_t> pick(0, letters.size() - 1);
  std::string id;
  for (size_t i = 0; i < id_length; ++i) id += letters[pick(entropy)];
  return id;
}

}  // namespace ream::api
