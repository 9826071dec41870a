#include "api/prometheus.hpp"

#include <array>
#include <functional>
#include <sstream>

#include "device/haptic_device.hpp"

namespace ream::api {
namespace {

using device::LinkState;

constexpr double s_per_us = 1e-6;

/// One metric after another, each with its head before its samples.
class Page {
 public:
  Page() { out_.precision(9); }

  void head(const std::string& name, const char* type, const char* help) {
    out_ << "# HELP " << name << ' ' << help << "\n# TYPE " << name << ' ' << type << '\n';
  }
  template <typename Value>
  void sample(const std::string& name, const std::string& labels, Value value) {
    out_ << name << '{' << labels << "} " << value << '\n';
  }
  std::string text() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

/// Ids are plain ([a-z0-9-]), so they need no escapes.
std::string label_of(const session::SessionRecord& record) { return "session=\"" + record.request.id + "\""; }

using Records = std::vector<session::SessionRecord>;

void counts_by_state(const Records& records, Page& page) {
  page.head("ream_sessions", "gauge", "Sessions of this server by state.");
  for (const SessionState state : {SessionState::created, SessionState::running, SessionState::paused,
                                   SessionState::finished, SessionState::stopped, SessionState::fault}) {
    size_t count = 0;
    for (const session::SessionRecord& record : records) count += record.status.state == state;
    page.sample("ream_sessions", "state=\"" + to_text(state) + "\"", count);
  }
}

void summaries(const Records& records, const std::string& name, const char* help,
               TimingSummary sim::LoopHealth::*which, Page& page) {
  page.head(name, "summary", help);
  for (const session::SessionRecord& record : records) {
    const TimingSummary& t = record.status.loop.*which;
    const std::string label = label_of(record);
    page.sample(name, label + ",quantile=\"0.5\"", t.p50_us * s_per_us);
    page.sample(name, label + ",quantile=\"0.99\"", t.p99_us * s_per_us);
    page.sample(name, label + ",quantile=\"0.999\"", t.p999_us * s_per_us);
    page.sample(name, label + ",quantile=\"1\"", t.max_us * s_per_us);
    page.sample(name + "_sum", label, t.mean_us * static_cast<double>(t.count) * s_per_us);
    page.sample(name + "_count", label, t.count);
  }
}

void per_session(const Records& records, const std::string& name, const char* type, const char* help,
                 const std::function<double(const session::SessionStatus&)>& value, Page& page) {
  page.head(name, type, help);
  for (const session::SessionRecord& record : records)
    page.sample(name, label_of(record), value(record.status));
}

void loops(const Records& records, Page& page) {
  summaries(records, "ream_tick_seconds", "Wall time of ticks.", &sim::LoopHealth::tick_us, page);
  summaries(records, "ream_tick_lateness_seconds", "How late ticks began.", &sim::LoopHealth::lateness_us,
            page);
  summaries(records, "ream_tick_read_seconds", "Reading the device, in ticks.", &sim::LoopHealth::read_us,
            page);
  summaries(records, "ream_tick_step_seconds", "Contact, force and removal, in ticks.",
            &sim::LoopHealth::step_us, page);
  summaries(records, "ream_tick_write_seconds", "Writing the device, in ticks.", &sim::LoopHealth::write_us,
            page);
  per_session(
      records, "ream_ticks_total", "counter", "Ticks of the session, 1 ms of its time each.",
      [](const session::SessionStatus& s) { return s.tick; }, page);
  per_session(
      records, "ream_ticks_missed_total", "counter", "Ticks that began more than 1 ms late.",
      [](const session::SessionStatus& s) { return static_cast<double>(s.loop.missed); }, page);
  per_session(
      records, "ream_loop_realtime", "gauge", "1 where the loop has real-time priority.",
      [](const session::SessionStatus& s) { return s.loop.realtime.fifo ? 1.0 : 0.0; }, page);
}

void devices(const Records& records, Page& page) {
  const std::string state = "ream_device_state";
  page.head(state, "gauge", "1 for the state that the session's device is in.");
  for (const session::SessionRecord& record : records)
    for (const LinkState one : {LinkState::fresh, LinkState::held, LinkState::fading, LinkState::lost}) {
      const std::string word = to_text(one);
      page.sample(state, label_of(record) + ",state=\"" + word + "\"", record.status.device.state == word);
    }
  const std::string messages = "ream_device_messages_total";
  page.head(messages, "counter", "Messages of devices that connect over a network.");
  for (const session::SessionRecord& record : records) {
    const session::DeviceLinkStatus& device = record.status.device;
    const std::array<std::pair<const char*, uint64_t>, 4> kinds{{{"received", device.received},
                                                                 {"missing", device.missing},
                                                                 {"late", device.late},
                                                                 {"refused", device.refused}}};
    for (const auto& [kind, count] : kinds)
      page.sample(messages, label_of(record) + ",kind=\"" + kind + "\"", count);
  }
  const std::string rtt = "ream_device_rtt_seconds";
  page.head(rtt, "gauge", "The way to the device and back.");
  for (const session::SessionRecord& record : records)
    if (record.status.device.rtt_ms) page.sample(rtt, label_of(record), *record.status.device.rtt_ms * 1e-3);
}

}  // namespace

std::string prometheus_text(const std::vector<session::SessionRecord>& records) {
  Page page;
  counts_by_state(records, page);
  loops(records, page);
  devices(records, page);
  return page.text();
}

}  // namespace ream::api
