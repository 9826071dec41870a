#pragma once
#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "support/fake_hardware.hpp"

namespace ream::test {

/// Haply's Inverse Service with one Inverse3, and a grip unless told otherwise, on free ports of 127.0.0.1:
/// an inventory on connect, then exactly one state for each message; takes a force as `vector` or `values`,
/// lets it act until the next message and forgets it 10 ms later; refuses (and ends the connection) what is
/// no JSON, names no device of its own, has no force in it, or does not configure the session with the first
/// message alone. States leave out what is as in the frame before. The hand moves 1 ms a message. On plain
/// sockets. Asked for its full state it answers with that, configurations among it; a profile may bring a
/// scale of forces of its own, from the configuring message on.
class FakeHaply {
 public:
  struct Setting {
    bool grip = true, inverse3 = true;
    double force_scale = 1.0;
    std::array<double, 4> grip_wxyz{1, 0, 0, 0};
    bool grip_says_buttons = true;
    std::optional<double> profile_force_scale;
  };
  /// Left out of every state, told as not connected, or there.
  enum class Grip { there, gone, not_connected };
  std::atomic<Grip> grip_now{Grip::there};
  FakeHaply() : FakeHaply(Setting{}) {}
  explicit FakeHaply(const Setting& setting);
  ~FakeHaply();
  FakeHaply(const FakeHaply&) = delete;
  FakeHaply& operator=(const FakeHaply&) = delete;

  static constexpr const char* id = "049D";
  static constexpr double force_lives_ms = 10.0;

  uint16_t port() const { return port_; }
  uint16_t events_port() const { return events_port_; }
  FakeHardware& hardware() { return hardware_; }
  /// Every message as it came, at most the first 1000.
  std::vector<std::string> messages() const;
  /// To everybody who listens to events.
  void tell_event(const nlohmann::json& event);
  /// Ends all connections, as a service that dies; new ones are refused until revive().
  void die();
  void revive() { dead_ = false; }

 private:
  void accept_all();
  void serve(int socket);
  void serve_events(int socket);
  nlohmann::json inventory() const;
  nlohmann::json grip_of_now(bool whole) const;
  nlohmann::json state_frame();
  std::string answer(bool whole);
  std::string why_refused(const nlohmann::json& message, bool first) const;

  const Setting setting_;
  FakeHardware hardware_{force_lives_ms};
  int listener_ = -1, events_listener_ = -1;
  uint16_t port_ = 0, events_port_ = 0;
  std::atomic<bool> leaving_{false}, dead_{false};
  std::atomic<double> scale_;
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
  std::vector<int> sockets_, event_sockets_;
  std::array<double, 3> told_mm_{};
  std::vector<std::thread> threads_;
  std::thread acceptor_;
};

}  // namespace ream::test
