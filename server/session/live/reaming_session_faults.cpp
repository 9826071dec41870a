#include <algorithm>
#include <cstring>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "session/folder/black_box_files.hpp"
#include "session/live/reaming_session.hpp"

namespace ream::session {
namespace {

/// A loop that stands still for longer than this will not come back: its session ends without it.
constexpr int64_t longest_standstill_ns = 1'000'000'000;

}  // namespace

/// With the mutex held.
void ReamingSession::note_device() {
  DeviceLinkStatus& device = status_.device;
  device.state = device::to_text(device_state_);
  if (!simulation_.link) return;
  const device::RemoteLink& link = *simulation_.link;
  const int64_t rtt_us = link.rtt_us;
  device.rtt_ms = rtt_us < 0 ? std::nullopt : std::optional(1.0e-3 * static_cast<double>(rtt_us));
  device.received = link.received;
  device.missing = link.missing;
  device.late = link.late;
  device.refused = link.refused;
  tell_port();
}

void ReamingSession::tell_port() {
  if (port_) port_->set_state(sample_.state);
}

void ReamingSession::note_events(const record::TickReport& report) {
  for (const record::ops::Event& event : files_->newest_events()) {
    log::info("session " + id_ + ", tick " + std::to_string(event.tick) + ": " + event.words);
    if (event.kind == "device_lost") keep_black_box(recent_);
  }
  device_state_ = report.link;
  held_ = report.held;
  if (files_->events().device_is_lost() == device_is_lost_) return;
  device_is_lost_ = !device_is_lost_;
  tell_fault(files_->events().device_words());
}

/// The loop's thread is dead, stuck or very late; the guard has left the device without force. A late one
/// ends by itself when it is back.
void ReamingSession::note_standstill() {
  const std::string words = end_words(sim::LoopEnd::stood_still);
  const int64_t now_ns = steady_ns();
  if (standstill_told_ns_ == 0) {
    standstill_told_ns_ = now_ns;
    log::error("session " + id_ + ": " + words);
    keep_black_box(recent_);
    tell_fault(words);
    batcher_.add(sample_);
    batcher_.flush();
  }
  if (now_ns - standstill_told_ns_ > longest_standstill_ns) throw Error(ErrorKind::unavailable, words);
}

/// To REST, and to viewers from the next sample on; empty: there is none any more.
void ReamingSession::tell_fault(const std::string& words) {
  sample_.fault.fill('\0');
  std::memcpy(sample_.fault.data(), words.data(), std::min(words.size(), sample_.fault.size() - 1));
  const std::lock_guard lock(mutex_);
  status_.fault = words;
}

std::string ReamingSession::end_words(sim::LoopEnd end) const {
  if (end != sim::LoopEnd::stood_still) return message_of(end);
  return "The haptic loop stopped for " + std::to_string(loop_.stood_still_ms()) +
         " ms; force off. Start a new session, on a computer with less to do.";
}

/// The last seconds of the loop, beside the recording, at any fault.
void ReamingSession::keep_black_box(const sim::BlackBox& box) const {
  try {
    const std::filesystem::path path = write_black_box(box, folder_, sample_.tick);
    log::info("session " + id_ + ": the last seconds are in " + path.string());
  } catch (const std::exception& e) {
    log::error("session " + id_ + ": its black box could not be written: " + e.what());
  }
}

}  // namespace ream::session
