#include "study/study_sessions.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/new_id.hpp"

namespace ream::study {

int64_t day_of(const std::string& utc) {
  const auto number = [&](size_t at, size_t length) {
    return utc.size() >= at + length ? std::atoi(utc.substr(at, length).c_str()) : 0;
  };
  const std::chrono::year_month_day date{std::chrono::year(number(0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(8, 2)))};
  return date.ok() ? std::chrono::sys_days(date).time_since_epoch().count() : 0;
}

std::string date_text(int64_t days_since_1970) {
  const std::chrono::sys_days day{std::chrono::days(days_since_1970)};
  return utc_text(std::chrono::system_clock::to_time_t(day)).substr(0, 10);
}

bool touched_bone(const nlohmann::json& metrics) {
  const auto contact = metrics.find("contact_time_s");
  return contact != metrics.end() && contact->is_number() && contact->get<double>() > 0.0;
}

bool touched_both_plates(const nlohmann::json& metrics) {
  // Within a hollow the apex comes 2 or 3 mm off its middle; to the rim of the other plate it is 20 mm.
  constexpr double between_plates_mm = 30.0;
  const auto spread = metrics.find("contact_spread_mm");
  return spread != metrics.end() && spread->is_number() && spread->get<double>() >= between_plates_mm;
}

std::vector<const session::SessionRecord*> sessions_of(const std::string& code,
                                                       const std::vector<session::SessionRecord>& sessions) {
  std::vector<const session::SessionRecord*> own;
  for (const session::SessionRecord& session : sessions)
    if (session.request.participant == code) own.push_back(&session);
  std::stable_sort(own.begin(), own.end(), [](const auto* a, const auto* b) {
    return a->request.created_utc < b->request.created_utc;
  });
  return own;
}

}  // namespace ream::study
