#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/signal_handlers.hpp"
#include "device/crash_guard.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/recorded_reaming.hpp"

// A program with a device in somebody's hand, told by its arguments how to end, in which thread, and with
// which backend: endangered_program HOW [loop|main|thread] [cpu|opencl]. What its device is told, last of
// all, is what it printed last.
namespace ream::test {
namespace {

/// Prints, by nothing but write(2), each force that the device is given, until it is taken away for good.
class TellingDevice final : public device::HapticDevice {
 public:
  explicit TellingDevice(std::unique_ptr<device::HapticDevice> inner, int end_at, std::function<void()> end)
      : inner_(std::move(inner)), end_(std::move(end)), end_at_(end_at) {}
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
  const std::function<void()> end_;
  int end_at_, tick_ = 0;
  std::atomic<bool> taken_away_{false};
};

volatile int* volatile nowhere = nullptr;
volatile int zero = 0;
volatile bool deeper = true;

int fall(int depth) {
  volatile char frame[1024];
  frame[0] = static_cast<char>(depth);
  return deeper ? fall(depth + 1) + frame[0] : depth;
}

void free_twice() {
  void* volatile memory = std::malloc(64);
  std::free(memory);
  std::free(memory);
}

const std::map<std::string, void (*)()> ends{
    {"segv", [] { *nowhere = 1; }},
    {"abort", [] { std::abort(); }},
    {"fpe", [] { zero = 1000 / zero; }},
    {"ill", [] { ::raise(SIGILL); }},
    {"bus", [] { ::kill(::getpid(), SIGBUS); }},
    {"trap", [] { ::raise(SIGTRAP); }},
    {"sys", [] { ::raise(SIGSYS); }},
    {"xcpu", [] { ::kill(::getpid(), SIGXCPU); }},
    {"throw", [] { throw std::runtime_error("an exception that nobody catches"); }},
    {"heap", free_twice},
    {"recursion", [] { zero = fall(0); }},
    {"unwatched", [] { *nowhere = 2; }},
    {"stuck",
     [] {
       for (;;) ::pause();
     }},
    {"signal", [] {}},
};

int run_session(const RecordedReaming& reaming, const std::string& backend, std::function<void()> end) {
  session::RunRequest request = reaming.request(RecordedReaming::push("ideal", 600.0));
  request.backend = backend;
  session::SimulationSetup parts = session::build_setup(request, reaming.data());
  parts.device = std::make_unique<TellingDevice>(std::move(parts.device), 700, std::move(end));
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

/// While the session goes on in a thread of its own.
int end_beside(const std::string& where, const RecordedReaming& reaming, const std::string& backend,
               void (*end)()) {
  std::atomic<bool> now{false};
  std::atomic<int> result{0};
  std::thread session = start_thread([&] {
    result = run_session(reaming, backend, [&now] {
      now = true;
      now.notify_one();
    });
  });
  now.wait(false);
  if (where == "thread")
    start_thread(end).join();
  else
    end();
  session.join();
  return result;
}

int run(const std::string& how, const std::string& where, const std::string& backend) {
  // The longest that it may take to end once it was told to, where it is stuck.
  where == "loop" ? catch_interrupts() : catch_interrupts(std::chrono::seconds(2));
  take_failed_writes_as_errors();
  const SignalStack stack;
  if (how != "unwatched") device::take_force_away_on_crash();
  const RecordedReaming reaming;
  void (*const end)() = ends.at(how);
  return where == "loop" ? run_session(reaming, backend, end) : end_beside(where, reaming, backend, end);
}

}  // namespace
}  // namespace ream::test

int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "", where = argc > 2 ? argv[2] : "loop",
                    backend = argc > 3 ? argv[3] : "cpu";
  return ream::test::ends.contains(how) ? ream::test::run(how, where, backend) : 2;
}
