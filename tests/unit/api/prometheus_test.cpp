#include "api/prometheus.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

namespace ream::api {
namespace {

/// A reader of the format that trusts nothing: heads before samples, one head a metric, no sample twice.
std::map<std::string, double> read_page(const std::string& text) {
  static const std::regex head(R"(# (HELP|TYPE) ([a-z_]+) (.+))");
  static const std::regex sample(R"(([a-z_]+)\{([a-z]+="[^"\\]*"(?:,[a-z]+="[^"\\]*")*)\} ([-+0-9.e]+))");
  std::map<std::string, double> samples;
  std::map<std::string, std::string> types;
  std::string line, current;
  EXPECT_EQ(text.back(), '\n');
  for (std::istringstream lines(text); std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, head)) {
      current = found[2];
      if (found[1] == "TYPE") {
        EXPECT_TRUE(types.emplace(current, found[3]).second) << line;
      }
      continue;
    }
    if (!std::regex_match(line, found, sample)) {
      ADD_FAILURE() << "no line of the format: " << line;
      continue;
    }
    std::string name = found[1];
    if (types[current] == "summary") name = std::regex_replace(name, std::regex("_(sum|count)$"), "");
    EXPECT_EQ(name, current) << "under the head of another metric: " << line;
    EXPECT_TRUE(types.contains(name)) << line;
    EXPECT_TRUE(samples.emplace(found[1].str() + "{" + found[2].str() + "}", std::stod(found[3])).second)
        << line;
  }
  return samples;
}

session::SessionRecord running() {
  session::SessionRecord record;
  record.request.id = "abc-1";
  record.status.state = SessionState::running;
  record.status.tick = 61'000;
  record.status.loop.tick_us = {90.0, 80.0, 250.0, 400.0, 900.5, 61'000};
  record.status.loop.lateness_us.p999_us = 70.0;
  record.status.loop.missed = 12;
  record.status.loop.realtime.fifo = true;
  record.status.device = {"network", "touch", "fading", 3.5, 1000, 3, 2, 1};
  return record;
}

TEST(Prometheus, SaysHowALoopAndItsDeviceAre) {
  session::SessionRecord ended;
  ended.request.id = "abc-2";
  ended.status.state = SessionState::finished;
  const auto samples = read_page(prometheus_text({running(), ended}));
  const std::string of = "{session=\"abc-1\"";
  EXPECT_EQ(samples.at("ream_sessions{state=\"running\"}"), 1.0);
  EXPECT_EQ(samples.at("ream_sessions{state=\"finished\"}"), 1.0);
  EXPECT_EQ(samples.at("ream_sessions{state=\"paused\"}"), 0.0);
  EXPECT_DOUBLE_EQ(samples.at("ream_tick_seconds" + of + ",quantile=\"0.99\"}"), 250e-6);
  EXPECT_DOUBLE_EQ(samples.at("ream_tick_seconds" + of + ",quantile=\"1\"}"), 900.5e-6);
  EXPECT_NEAR(samples.at("ream_tick_seconds_sum" + of + "}"), 5.49, 1e-9);
  EXPECT_EQ(samples.at("ream_tick_seconds_count" + of + "}"), 61'000.0);
  EXPECT_DOUBLE_EQ(samples.at("ream_tick_lateness_seconds" + of + ",quantile=\"0.999\"}"), 70e-6);
  EXPECT_EQ(samples.at("ream_ticks_total" + of + "}"), 61'000.0);
  EXPECT_EQ(samples.at("ream_ticks_missed_total" + of + "}"), 12.0);
  EXPECT_EQ(samples.at("ream_loop_realtime" + of + "}"), 1.0);
  EXPECT_EQ(samples.at("ream_device_state" + of + ",state=\"fading\"}"), 1.0);
  EXPECT_EQ(samples.at("ream_device_state" + of + ",state=\"lost\"}"), 0.0);
  EXPECT_EQ(samples.at("ream_device_messages_total" + of + ",kind=\"missing\"}"), 3.0);
  EXPECT_DOUBLE_EQ(samples.at("ream_device_rtt_seconds" + of + "}"), 3.5e-3);
  EXPECT_FALSE(samples.contains("ream_device_rtt_seconds{session=\"abc-2\"}")) << "never known";
}

TEST(Prometheus, OfNoSessionIsAPageToo) {
  const auto samples = read_page(prometheus_text({}));
  EXPECT_EQ(samples.at("ream_sessions{state=\"running\"}"), 0.0);
}

// A week's ticks are more than six digits.
TEST(Prometheus, LosesNoTickOfALongSession) {
  session::SessionRecord record = running();
  record.status.tick = 604'800'001;
  EXPECT_EQ(read_page(prometheus_text({record})).at("ream_ticks_total{session=\"abc-1\"}"), 604'800'001.0);
}

}  // namespace
}  // namespace ream::api
