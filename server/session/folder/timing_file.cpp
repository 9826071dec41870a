#include "session/folder/timing_file.hpp"

#include <array>

#include "core/json.hpp"
#include "core/timing_json.hpp"

namespace ream::session {
namespace {

struct LoopTimes {
  const char* key;
  TimingSummary sim::LoopHealth::*times;
};
constexpr std::array loop_times{
    LoopTimes{"tick_us", &sim::LoopHealth::tick_us}, LoopTimes{"lateness_us", &sim::LoopHealth::lateness_us},
    LoopTimes{"read_us", &sim::LoopHealth::read_us}, LoopTimes{"step_us", &sim::LoopHealth::step_us},
    LoopTimes{"write_us", &sim::LoopHealth::write_us}};

}  // namespace

nlohmann::json timing_file_json(const sim::LoopHealth& health) {
  nlohmann::json timing{{"missed", health.missed},
                        {"ticks", health.tick_us.count},
                        {"realtime", health.realtime.fifo},
                        {"locked", health.realtime.locked},
                        {"cpu", health.realtime.cpu}};
  for (const LoopTimes& part : loop_times)
    timing[part.key] = timing_json(health.*part.times, TimingKeys::bare);
  return timing;
}

sim::LoopHealth loop_health_from(const nlohmann::json& timing) {
  sim::LoopHealth health;
  for (const LoopTimes& part : loop_times)
    health.*part.times = timing_from(timing.value(part.key, nlohmann::json::object()));
  health.missed = timing.value("missed", uint64_t{0});
  health.realtime.fifo = timing.value("realtime", false);
  health.realtime.locked = timing.value("locked", false);
  health.realtime.cpu = timing.value("cpu", -1);
  return health;
}

}  // namespace ream::session
