#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "device/crash_guard.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/recorded_reaming.hpp"

// A program with a device in somebody's hand, told by its argument how to end. What its device is told, last
// of all, is what it printed last.
namespace ream::test {
namespace {

/// Prints, by nothing but write(2), each force that the device is given, until it is taken away for good.
class TellingDevice final : public device::HapticDevice {
 public:
  explicit TellingDevice(std::unique_ptr<device::HapticDevice> inner, int end_at = -1,
                         void (*end)() = nullptr)
      : inner_(std::move(inner)), end_(end), end_at_(end_at) {}
  const device::DeviceTraits& traits() const noexcept override { return inner_->traits(); }
  void open() override {
    inner_->open();
    say("open\n");
  }
  void close() noexcept override {
    inner_->close();
    say("closed\n");
  }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    if (tick_++ == end_at_) end_();
    return inner_->read(input);
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    if (!taken_away_) say(output.force_n.norm() > 0.0 ? "force\n" : "no force\n");
    return inner_->write(output);
  }
  void take_force_away() noexcept override {
    if (!taken_away_.exchange(true)) say("taken away\n");
  }
  void session_paused(bool paused) noexcept override { inner_->session_paused(paused); }
  double closing_ms() const noexcept override { return inner_->closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_->use_priority(fifo); }

 private:
  static void say(const char* words) noexcept {
    if (::write(STDOUT_FILENO, words, std::strlen(words)) < 0) ::_exit(3);
  }
  std::unique_ptr<device::HapticDevice> inner_;
  void (*end_)();
  int end_at_, tick_ = 0;
  std::atomic<bool> taken_away_{false};
};

volatile int* volatile nowhere = nullptr;

const std::map<std::string, void (*)()> ends{
    {"segv", [] { *nowhere = 1; }},
    {"abort", [] { std::abort(); }},
    {"fpe", [] { ::raise(SIGFPE); }},  // a division by zero is passed over by PoCL's handler
    {"ill", [] { ::raise(SIGILL); }},
    {"bus", [] { ::kill(::getpid(), SIGBUS); }},
    {"throw", [] { throw std::runtime_error("an exception that nobody catches"); }},
    {"unwatched", [] { *nowhere = 2; }},
    {"signal", [] {}},
};

int run(const std::string& how) {
  catch_interrupts();
  if (how != "unwatched") device::take_force_away_on_crash();
  const RecordedReaming reaming;
  session::SimulationSetup parts =
      session::build_setup(reaming.request(RecordedReaming::push("ideal", 600.0)), reaming.data());
  const int end_at = how == "signal" ? -1 : 700;
  parts.device = std::make_unique<TellingDevice>(std::move(parts.device), end_at, ends.at(how));
  session::Simulation simulation(std::move(parts));
  const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
  try {
    session::run_headless(simulation, start, reaming.folder().path(), true);
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace ream::test

int main(int argc, char** argv) {
  const std::string how = argc == 2 ? argv[1] : "";
  return ream::test::ends.contains(how) ? ream::test::run(how) : 2;
}
