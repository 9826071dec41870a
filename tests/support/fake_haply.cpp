#include "support/fake_haply.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <openssl/evp.h>
#include <openssl/sha.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <stdexcept>

namespace ream::test {
namespace {

using nlohmann::json;

constexpr double mm_per_m = 1000.0, step_s = 0.001;
constexpr int text_opcode = 1, close_opcode = 8;
constexpr auto slowness = std::chrono::milliseconds(15);

int listen_on_any(uint16_t& port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(socket, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(socket, 16) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no port for the fake service");
  port = ntohs(address.sin_port);
  return socket;
}

bool send_all(int socket, const std::string& bytes) {
  size_t sent = 0;
  while (sent < bytes.size()) {
    const auto n = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<size_t>(n);
  }
  return true;
}

bool receive_all(int socket, char* into, size_t bytes) {
  return bytes == 0 || ::recv(socket, into, bytes, MSG_WAITALL) == static_cast<ssize_t>(bytes);
}

/// The server's half of RFC 6455, 4.2.
bool shake_hands(int socket) {
  std::string request;
  for (char c = 0; !request.ends_with("\r\n\r\n"); request += c)
    if (request.size() > 8192 || !receive_all(socket, &c, 1)) return false;
  const std::string name = "Sec-WebSocket-Key: ";
  const size_t at = request.find(name);
  if (at == std::string::npos) return false;
  const size_t begin = at + name.size();
  const std::string key =
      request.substr(begin, request.find("\r\n", begin) - begin) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  unsigned char hash[SHA_DIGEST_LENGTH];
  ::SHA1(reinterpret_cast<const unsigned char*>(key.data()), key.size(), hash);
  unsigned char encoded[64];
  const int length = ::EVP_EncodeBlock(encoded, hash, sizeof hash);
  return send_all(socket,
                  "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                  "Sec-WebSocket-Accept: " +
                      std::string(reinterpret_cast<char*>(encoded), static_cast<size_t>(length)) +
                      "\r\n\r\n");
}

bool send_text(int socket, const std::string& text) {
  std::string frame{static_cast<char>(0x80 | text_opcode)};
  if (text.size() < 126) {
    frame += static_cast<char>(text.size());
  } else {
    frame += static_cast<char>(126);
    frame += static_cast<char>(text.size() >> 8);
    frame += static_cast<char>(text.size() & 0xff);
  }
  return send_all(socket, frame + text);
}

/// False at the end of the connection.
bool receive_text(int socket, std::string& text) {
  for (;;) {
    unsigned char head[2];
    if (!receive_all(socket, reinterpret_cast<char*>(head), 2)) return false;
    size_t length = head[1] & 0x7f;
    if (length == 127) return false;
    if (length == 126) {
      unsigned char more[2];
      if (!receive_all(socket, reinterpret_cast<char*>(more), 2)) return false;
      length = static_cast<size_t>(more[0]) << 8 | more[1];
    }
    char mask[4];
    if ((head[1] & 0x80) == 0 || !receive_all(socket, mask, 4)) return false;  // clients must mask
    text.resize(length);
    if (!receive_all(socket, text.data(), length)) return false;
    for (size_t i = 0; i < length; ++i) text[i] = static_cast<char>(text[i] ^ mask[i % 4]);
    if ((head[0] & 0x0f) == close_opcode) return false;
    if ((head[0] & 0x0f) == text_opcode) return true;
  }
}

json xyz(const std::array<double, 3>& v) { return {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}}; }

}  // namespace

FakeHaply::FakeHaply(const Setting& setting) : setting_(setting), scale_(setting.force_scale) {
  listener_ = listen_on_any(port_);
  events_listener_ = listen_on_any(events_port_);
  acceptor_ = std::thread([this] { accept_all(); });
}

FakeHaply::~FakeHaply() {
  leaving_ = true;
  acceptor_.join();
  die();
  for (std::thread& thread : threads_) thread.join();
  for (const int socket : sockets_) ::close(socket);
  ::close(listener_);
  ::close(events_listener_);
}

void FakeHaply::die() {
  dead_ = true;
  const std::lock_guard lock(mutex_);
  for (const int socket : sockets_) ::shutdown(socket, SHUT_RDWR);
  hardware_.off();
}

std::vector<std::string> FakeHaply::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

void FakeHaply::tell_event(const json& event) {
  const std::lock_guard lock(mutex_);
  for (const int socket : event_sockets_) send_text(socket, event.dump());
}

void FakeHaply::accept_all() {
  while (!leaving_) {
    std::array<pollfd, 2> ready{{{listener_, POLLIN, 0}, {events_listener_, POLLIN, 0}}};
    ::poll(ready.data(), ready.size(), 10);
    for (const pollfd& one : ready) {
      if ((one.revents & POLLIN) == 0) continue;
      const int socket = ::accept4(one.fd, nullptr, nullptr, SOCK_CLOEXEC);
      if (socket < 0) continue;
      if (dead_) {
        ::close(socket);
        continue;
      }
      const int on = 1;
      ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      const std::lock_guard lock(mutex_);
      sockets_.push_back(socket);
      if (one.fd == listener_)
        threads_.emplace_back([this, socket] { serve(socket); });
      else
        threads_.emplace_back([this, socket] { serve_events(socket); });
    }
  }
}

void FakeHaply::serve_events(int socket) {
  if (!shake_hands(socket)) return;
  {
    const std::lock_guard lock(mutex_);
    event_sockets_.push_back(socket);
  }
  std::string ignored;
  while (receive_text(socket, ignored)) {
  }
  const std::lock_guard lock(mutex_);
  std::erase(event_sockets_, socket);
}

/// Null where there is none. `whole`: with its orientation and configuration.
json FakeHaply::grip_of_now(bool whole) const {
  const Grip now = grip_now;
  if (!setting_.grip || now == Grip::gone) return nullptr;
  json state = json::object();
  const unsigned pressed = whole ? 0 : hardware_.buttons.load();
  if (setting_.grip_says_buttons)
    state["buttons"] = {{"a", (pressed & 1) != 0}, {"b", (pressed & 2) != 0}, {"c", (pressed & 4) != 0}};
  if (whole)
    state["orientation"] = {{"w", setting_.grip_wxyz[0]},
                            {"x", setting_.grip_wxyz[1]},
                            {"y", setting_.grip_wxyz[2]},
                            {"z", setting_.grip_wxyz[3]}};
  json told = {{"device_id", "61548"}, {"state", state}};
  if (whole) told["config"] = {{"type", "wireless_verse_grip"}};
  told["status"] = {{"connected", now != Grip::not_connected}};
  return told;
}

json FakeHaply::inventory() const {
  json frame = {{"session_id", 7}, {"inverse3", json::array()}};
  if (!setting_.inverse3 || hardware_.fault == HardwareFault::absent) return frame;
  frame["inverse3"].push_back(
      {{"device_id", id},
       {"config",
        {{"type", "inverse3"},
         {"handedness", "right"},
         {"gravity_compensation", {{"enabled", true}, {"scaling_factor", 1.0}}},
         {"torque_scaling", {{"enabled", true}}},
         {"preset", "defaults"},
         {"basis", {{"permutation", "XYZ"}}},
         {"filters",
          {{"force_gate", {{"gain", 0.3}}},
           {"damping", {{"scalar", 0.0}}},
           {"force_scale", {{"gain", scale_.load()}}}}}}},
       {"state",
        {{"cursor_position", xyz({told_mm_[0] / mm_per_m, told_mm_[1] / mm_per_m, told_mm_[2] / mm_per_m})},
         {"cursor_velocity", xyz({0, 0, 0})},
         {"angular_position", {{"a0", 0.0}, {"a1", 0.0}, {"a2", 0.0}}},
         {"body_orientation", {{"w", 1.0}, {"x", 0.0}, {"y", 0.0}, {"z", 0.0}}},
         {"current_cursor_force", xyz({0, 0, 0})},
         {"control_domain", "cartesian"},
         {"control_mode", "idle"}}},
       {"status", {{"calibrated", true}, {"ready", true}}}});
  if (const json grip = grip_of_now(true); !grip.is_null()) frame["wireless_verse_grip"] = {grip};
  return frame;
}

/// Of the position only what has changed.
json FakeHaply::state_frame() {
  if (!setting_.inverse3 || hardware_.fault == HardwareFault::absent)
    return {{"session_id", 7}, {"inverse3", json::array()}};
  const std::array<double, 3> place_mm = hardware_.move_hand(step_s);
  json position = json::object();
  for (size_t i = 0; i < 3; ++i)
    if (place_mm[i] != told_mm_[i])
      position[std::string(1, static_cast<char>('x' + i))] = place_mm[i] / mm_per_m;
  told_mm_ = place_mm;
  if (hardware_.fault == HardwareFault::not_finite) position["x"] = std::nan("");
  if (hardware_.fault == HardwareFault::absurd) position["x"] = 1000.0;
  if (hardware_.fault == HardwareFault::none) position["x"] = place_mm[0] / mm_per_m;
  json frame = {{"session_id", 7},
                {"inverse3", {{{"device_id", id}, {"state", {{"cursor_position", position}}}}}}};
  if (const json grip = grip_of_now(false); !grip.is_null()) frame["wireless_verse_grip"] = {grip};
  return frame;
}

std::string FakeHaply::answer(bool whole) {
  const std::lock_guard lock(mutex_);
  if (hardware_.fault == HardwareFault::malformed) return "[{\"inverse3\": 7";
  if (!whole) return state_frame().dump();
  told_mm_ = hardware_.move_hand(step_s);
  return inventory().dump();
}

std::string FakeHaply::why_refused(const json& message, bool first) const {
  if (!message.is_object()) return "no JSON object";
  const bool asks = message.contains("session") && message["session"].contains("force_render_full_state");
  if (asks && (first || message["session"].size() != 1)) return "everything is asked for at a wrong time";
  if (!asks && message.contains("session") != first)
    return first ? "the first message does not configure the session" : "the session is configured twice";
  if (first && !message["session"].value("/configure/profile/name"_json_pointer, json()).is_string())
    return "the session's profile has no name";
  const json device = message.value("/inverse3/0"_json_pointer, json());
  if (!device.is_object() || device.value("device_id", "") != id) return "no such Inverse3";
  const json command = device.value("/commands/set_cursor_force"_json_pointer, json());
  if (!command.is_object() || command.size() != 1) return "no force";
  const json force = command.contains("vector") ? command["vector"] : command.value("values", json());
  for (const char* axis : {"x", "y", "z"})
    if (!force.is_object() || !force.contains(axis) || !force[axis].is_number())
      return "a force that is none";
  return "";
}

void FakeHaply::serve(int socket) {
  if (!shake_hands(socket)) return;
  if (hardware_.fault == HardwareFault::malformed) {
    send_text(socket, "what?");
  } else if (hardware_.fault != HardwareFault::silent) {
    std::string text;
    {
      const std::lock_guard lock(mutex_);
      text = inventory().dump();
    }
    if (!send_text(socket, text)) return;
  }
  hardware_.called("connect");
  std::string text;
  bool first = true;
  while (receive_text(socket, text)) {
    {
      const std::lock_guard lock(mutex_);
      if (messages_.size() < 1000) messages_.push_back(text);
    }
    const json message = json::parse(text, nullptr, false);
    if (const std::string why = why_refused(message, first); !why.empty()) {
      hardware_.refused(why + ": " + text);
      break;
    }
    if (first) scale_ = setting_.profile_force_scale.value_or(setting_.force_scale);
    first = false;
    const bool whole = message.contains("session") && message["session"].contains("force_render_full_state");
    const json command = message.at("/inverse3/0/commands/set_cursor_force"_json_pointer);
    const json& force = command.front();
    const double scale = scale_;
    hardware_.render({scale * force["x"].get<double>(), scale * force["y"].get<double>(),
                      scale * force["z"].get<double>()});
    if (hardware_.fault == HardwareFault::slow) std::this_thread::sleep_for(slowness);
    if (hardware_.fault == HardwareFault::silent) continue;
    if (!send_text(socket, answer(whole))) break;
  }
  hardware_.called("disconnect");
  ::shutdown(socket, SHUT_RDWR);
}

}  // namespace ream::test
