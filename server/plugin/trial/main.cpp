// ream-plugin-trial: loads a plug-in, asks its models as sessions would, and says whether it may be used: one
// line on descriptor 1, JSON of what it is, or a sentence. Exit code 1 with a sentence. Uses nothing of the
// program's rooms, so that what the plug-in breaks is here alone.
//   ream-plugin-trial FILE TICKS BUDGET_US
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "plugin/ream_plugin.h"
#include "plugin/trial/watched_calls.h"

namespace {

constexpr double min_resistance_n_s_mm = 1e-3, max_force_n = 1000.0, max_reach_mm = 10'000.0;
constexpr rlim_t processor_s = 10;

int answer_descriptor = 1;

void say(const char* text) noexcept {
  if (::write(answer_descriptor, text, std::strlen(text)) < 0) ::_exit(2);
}

[[noreturn]] void refuse(const std::string& why) {
  say((why + "\n").c_str());
  ::_exit(1);
}

bool is_name(const char* text, size_t max, bool is_version) {
  if (text == nullptr || *text == '\0' || std::strlen(text) > max) return false;
  return std::all_of(text, text + std::strlen(text), [&](char c) {
    return is_version ? c > ' ' && c < 127 && c != '"' && c != '\\'
                      : (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool is_between(double value, double low, double high) { return value >= low && value <= high; }

void check_device(const ream_device& device) {
  if (device.struct_size < sizeof(ream_device)) refuse("its ream_device is of another size; set struct_size");
  if (!is_name(device.name, 40, false) || device.about == nullptr)
    refuse("its device needs `about`, and a name of small letters, digits and -");
  if (!device.open || !device.read || !device.write || !device.close)
    refuse("its device needs open, read, write and close");
  if (!is_between(device.force_max_n, 1e-3, max_force_n) || !is_between(device.torque_max_n_mm, 0.0, 1e6) ||
      !is_between(device.stiffness_max_n_mm, 1e-3, 1e4) || !is_between(device.damping_max_n_s_mm, 0.0, 1e3) ||
      !is_between(device.workspace_radius_mm, 1.0, max_reach_mm) ||
      !is_between(device.handle_mass_kg, 1e-3, 100.0) || device.degrees_of_freedom < 3 ||
      device.degrees_of_freedom > 7)
    refuse("a limit of its device is no plausible number; compare units with ream_plugin.h");
}

const ream_plugin_description& loaded(const char* file) {
  void* handle = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    std::string why = ::dlerror();
    const size_t path = why.find(file);
    if (path == 0) why = why.substr(std::min(why.size(), std::strlen(file) + 2));
    refuse("it is no shared object that can be loaded here: " + why);
  }
  const auto* plugin = static_cast<const ream_plugin_description*>(::dlsym(handle, "ream_plugin"));
  if (plugin == nullptr) refuse("it exports no constant `ream_plugin`; see docs/plugins.md");
  if (plugin->abi != REAM_PLUGIN_ABI)
    refuse("it is made for interface " + std::to_string(plugin->abi) + ", and this program has interface " +
           std::to_string(REAM_PLUGIN_ABI) + "; compile it with this version's ream_plugin.h");
  if (plugin->struct_size < sizeof(ream_plugin_description))
    refuse("its ream_plugin_description is of another size; set struct_size");
  if (!is_name(plugin->name, 40, false) || !is_name(plugin->version, 20, true))
    refuse("it needs a name of small letters, digits and -, and a version without spaces");
  if (plugin->feed == nullptr && plugin->score == nullptr && plugin->device == nullptr)
    refuse("it has neither feed model nor score nor device");
  if (plugin->feed != nullptr &&
      (plugin->feed->struct_size < sizeof(ream_feed_model) || plugin->feed->load == nullptr))
    refuse("its ream_feed_model needs struct_size and load");
  if (plugin->score != nullptr &&
      (plugin->score->struct_size < sizeof(ream_score_model) || plugin->score->score == nullptr))
    refuse("its ream_score_model needs struct_size and score");
  if (plugin->device != nullptr) check_device(*plugin->device);
  return *plugin;
}

/// splitmix64: the same bone in every trial.
class Random {
 public:
  double between(double low, double high) {
    uint64_t x = state_ += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return low + (high - low) * 0x1p-53 * static_cast<double>((x ^ (x >> 31)) >> 11);
  }

 private:
  uint64_t state_ = 1;
};

/// What a reamer of some size meets at some place: one class or a mixture, a touch or all of it, any thrust.
ream_engaged_bone plausible_bone(Random& random) {
  ream_engaged_bone bone{};
  const std::array<double, 3> low{0.01, 0.6, 1.1}, high{1.2, 2.55, 1.1};
  double sum = 0.0;
  const int alone = static_cast<int>(random.between(0.0, 6.0));
  for (int k = 0; k < 3; ++k) {
    const double share = random.between(0.0, 1.0);
    bone.share[k] = alone < 3 ? (k == alone ? 1.0 : 0.0) : share;
    sum += bone.share[k];
  }
  for (int k = 0; k < 3; ++k) {
    bone.share[k] /= sum;
    if (bone.share[k] > 0.0) bone.density_g_cc[k] = random.between(low[k], high[k]);
  }
  bone.area_mm2 = random.between(0.0, 1.0) < 0.2 ? random.between(0.001, 1.0) : random.between(1.0, 1200.0);
  bone.edge_mm = bone.area_mm2 * random.between(0.01, 0.1);
  bone.resistance_s_mm = random.between(1.0 / 32.0, 128.0);
  bone.thrust_n = random.between(0.0, 1.0) < 0.1 ? 0.0 : random.between(0.0, 400.0);
  return bone;
}

int64_t processor_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }

/// Asks both models the same, the second one backwards: a model that keeps something gives other bits.
class Ticks {
 public:
  Ticks(const ream_feed_model& feed, void* first, void* second, int count, double budget_us)
      : feed_(feed),
        first_(first),
        second_(second),
        loads_(static_cast<size_t>(count)),
        ns_(loads_.size(), std::numeric_limits<int64_t>::max()),
        budget_us_(budget_us),
        too_slow_("its feed model is too slow: 1 % of its ticks take more than " +
                  std::to_string(std::lround(budget_us)) + " us of processor time\n") {
    Random random;
    for (size_t i = 0; i < loads_.size(); ++i) bones_.push_back(plausible_bone(random));
  }

  void run() {
    for (size_t i = 0; i < loads_.size(); ++i) {
      loads_[i] = timed(first_, i, ns_[i]);
      check(loads_[i]);
      // What interrupts a machine counts as the tick's; it seldom does so thrice for the same bone.
      for (int again = 0; again < 2 && is_slow(ns_[i]); ++again) timed(first_, i, ns_[i]);
      if (is_slow(ns_[i]) && ++slow_ > ns_.size() / 100) {
        say(too_slow_.c_str());
        ::_exit(1);
      }
    }
    for (size_t i = loads_.size(); i-- > 0;) {
      const ream_cutting_load again = timed(second_, i, ns_[i]);
      if (!same_bits(again.resistance_n_s_mm, loads_[i].resistance_n_s_mm) ||
          !same_bits(again.torque_arm_mm, loads_[i].torque_arm_mm) ||
          !same_bits(again.tangential_ratio, loads_[i].tangential_ratio))
        refused_in_tick("gives something else for the same bone when it is asked again");
    }
  }

  void answer() {
    std::sort(ns_.begin(), ns_.end());
    const auto us = [&](size_t part) { return 1e-3 * static_cast<double>(ns_[ns_.size() * part / 1000]); };
    char line[160];
    std::snprintf(line, sizeof line, "{\"ticks\":%zu,\"p50_us\":%.2f,\"p99_us\":%.2f,\"max_us\":%.2f}\n",
                  ns_.size(), us(500), us(990), 1e-3 * static_cast<double>(ns_.back()));
    say(line);
  }

 private:
  ream_cutting_load asked(void* model, size_t i) {
    ream_cutting_load load{};
    watched_tick = 1;
    feed_.load(model, &bones_[i], &load);
    watched_tick = 0;
    return load;
  }

  /// asked(); `least_ns` becomes the processor time that it took, where that is less.
  ream_cutting_load timed(void* model, size_t i, int64_t& least_ns) {
    const int64_t before_ns = processor_ns();
    const ream_cutting_load load = asked(model, i);
    least_ns = std::min(least_ns, processor_ns() - before_ns);
    return load;
  }
  bool is_slow(int64_t ns) const { return 1e-3 * static_cast<double>(ns) > budget_us_; }

  static void check(const ream_cutting_load& load) {
    if (!std::isfinite(load.resistance_n_s_mm) || !std::isfinite(load.torque_arm_mm) ||
        !std::isfinite(load.tangential_ratio))
      refused_in_tick("gives a value that is not finite");
    if (load.resistance_n_s_mm < min_resistance_n_s_mm)
      refused_in_tick("gives a resistance below 0.001 N s/mm");
    if (load.torque_arm_mm < 0.0 || load.tangential_ratio < 0.0) refused_in_tick("gives a negative value");
  }

  const ream_feed_model& feed_;
  void *first_, *second_;
  std::vector<ream_engaged_bone> bones_;
  std::vector<ream_cutting_load> loads_;
  std::vector<int64_t> ns_;
  const double budget_us_;
  const std::string too_slow_;
  size_t slow_ = 0;
};

/// In a process of its own, which the kernel watches. What it says goes on to who started us; returns it.
std::string tried_feed(const ream_feed_model& feed, int ticks, double budget_us) {
  const ream_feed_settings settings{sizeof(ream_feed_settings), 1.5, 1.0, 70.5, 0.0, 1.0};
  const auto made = [&] { return feed.create != nullptr ? feed.create(&settings) : nullptr; };
  void *first = made(), *second = made();
  Ticks run(feed, first, second, ticks, budget_us);
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) refuse("no pipe for its trial");
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    answer_descriptor = ends[1];
    if (watch_system_calls(ends[1]) != 0) {
      say("its system calls cannot be watched: the kernel has no seccomp filters\n");
      ::_exit(1);
    }
    run.run();
    run.answer();
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string said;
  std::array<char, 512> part{};
  for (ssize_t got = 0; (got = ::read(ends[0], part.data(), part.size())) > 0;)
    said.append(part.data(), static_cast<size_t>(got));
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    refuse(WTERMSIG(status) == SIGXCPU
               ? "its feed model does not come back: " + std::to_string(processor_s) + " s of processor time"
               : std::string("its feed model crashes: ") + ::strsignal(WTERMSIG(status)));
  if (feed.destroy != nullptr)
    for (void* model : {first, second}) feed.destroy(model);
  if (said.empty() || said[0] != '{') refuse(said.substr(0, said.find('\n')));
  return said.substr(0, said.find('\n'));
}

void try_score(const ream_score_model& model) {
  Random random;
  const std::array<const char*, 4> names{"removed_volume_mm3", "depth_error_mm", "axial_thrust_peak_n",
                                         "duration_s"};
  for (int round = 0; round < 100; ++round) {
    std::vector<ream_metric> metrics;
    for (const char* name : names)
      metrics.push_back({name, random.between(0.0, 1.0) < 0.2 ? std::numeric_limits<double>::quiet_NaN()
                                                              : random.between(0.0, 100.0)});
    const auto first = std::make_unique<ream_score>(), again = std::make_unique<ream_score>();
    model.score(metrics.data(), metrics.size(), first.get());
    model.score(metrics.data(), metrics.size(), again.get());
    if (std::memcmp(first.get(), again.get(), sizeof(ream_score)) != 0)
      refuse("its score says something else for the same metrics when it is asked again");
    if (!is_between(first->points, 0.0, 100.0) || first->outcome < -1 || first->outcome > 1)
      refuse("its score gives points that are not 0 to 100, or an outcome that is not -1, 0 or 1");
    bool ended = first->line_count <= REAM_SCORE_LINES;
    for (uint32_t i = 0; ended && i < first->line_count; ++i)
      ended = std::memchr(first->lines[i], 0, REAM_SCORE_LINE_BYTES) != nullptr;
    if (!ended) refuse("its score gives too many lines, or one without a zero byte at its end");
  }
}

/// Another output for us than for what the plug-in prints.
void keep_answer_apart() {
  answer_descriptor = ::fcntl(1, F_DUPFD_CLOEXEC, 100);
  const int nothing = ::open("/dev/null", O_RDWR);
  if (answer_descriptor < 0 || nothing < 0) ::_exit(2);
  for (int standard = 0; standard < 3; ++standard) ::dup2(nothing, standard);
  std::setvbuf(stdout, nullptr, _IONBF, 0);
}

}  // namespace

void refused_in_tick(const char* what) {
  char line[200];
  watched_tick = 0;
  size_t end = 0;
  for (const char* part : {"its feed model ", what, " in a tick\n"})
    for (; *part != '\0' && end + 1 < sizeof line; ++part) line[end++] = *part;
  line[end] = '\0';
  say(line);
  ::_exit(1);
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  keep_answer_apart();
  const rlimit no_core{0, 0}, processor{processor_s, processor_s + 1};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_CPU, &processor);
  const ream_plugin_description& plugin = loaded(argv[1]);
  std::string answer =
      std::string("{\"name\":\"") + plugin.name + "\",\"version\":\"" + plugin.version + "\"";
  if (plugin.feed != nullptr)
    answer += ",\"feed\":" + tried_feed(*plugin.feed, std::atoi(argv[2]), std::atof(argv[3]));
  if (plugin.score != nullptr) try_score(*plugin.score);
  answer += std::string(",\"score\":") + (plugin.score != nullptr ? "true" : "false");
  if (plugin.device != nullptr) answer += std::string(",\"device\":\"") + plugin.device->name + "\"";
  say((answer + "}\n").c_str());
  ::_exit(0);
}
