#include "bench/many_sessions.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

namespace ream::bench {
using nlohmann::json;

void write_sessions(const test::TemporaryFolder& folder, int count, const std::string& below) {
  std::mt19937 random(1);
  const auto pick = [&](int choices) { return std::uniform_int_distribution<int>(0, choices - 1)(random); };
  const char* const states[] = {"finished", "finished", "finished",   "stopped",
                                "stopped",  "fault",    "interrupted"};
  for (int i = 0; i < count; ++i) {
    char utc[32];
    std::snprintf(utc, sizeof utc, "202%d-%02d-%02dT%02d:%02d:%02dZ", 4 + i / (count / 2),
                  1 + i / (count / 24) % 12, 1 + i / (count / 672) % 28, 8 + i % 10, pick(60), pick(60));
    const int trainee = pick(80);
    const json session = {
        {"id", "s" + std::to_string(i)},
        {"case", "shoulder-" + std::to_string(pick(40))},
        {"case_name", "Phantom shoulder, right"},
        {"script", "practice"},
        {"device", "network"},
        {"device_profile", "omega.6"},
        {"created_utc", utc},
        {"state", states[pick(7)]},
        {"trainee_id", "u" + std::to_string(trainee)},
        {"trainee", "Trainee number " + std::to_string(trainee)},
        {"study", pick(4) == 0 ? "pilot" : ""},
        {"participant", "P-" + std::to_string(trainee)},
        {"title", pick(10) == 0 ? "Second try, other reamer" : ""},
        {"force_scale", 26.0},
        {"ticks", 20'000 + pick(100'000)},
        {"fault", pick(10) == 0 ? "the device fell silent for more than half a second" : ""},
        {"grid_dims", {208, 192, 232}},
        {"tool", "ellipse 18.25,9"}};
    const json times = {{"mean", 61.0}, {"p50", 58.0}, {"p99", 210.0}, {"p999", 400.0}, {"max", 900.0}};
    const std::string one = below + session.at("id").get<std::string>();
    folder.write(one + "/session.json", session.dump(2));
    folder.write(one + "/timing.json",
                 json{{"tick_us", times}, {"lateness_us", times}, {"missed", 3}, {"ticks", 20'000}}.dump(2));
  }
}

}  // namespace ream::bench
