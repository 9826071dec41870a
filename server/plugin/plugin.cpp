#include "plugin/plugin.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "access/signed_release.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "isolation/isolated_job.hpp"
#include "plugin/floating_point.hpp"

namespace ream::plugin {
namespace fs = std::filesystem;
namespace {

constexpr int64_t max_trial_ns = 60'000'000'000;
constexpr size_t max_answer_bytes = 4096;

[[noreturn]] void refuse(const fs::path& file, const std::string& why,
                         ErrorKind kind = ErrorKind::invalid_input) {
  throw Error(kind, "plug-in " + file.string() + ": " + why);
}

/// `what` is the file (empty) or a folder above it: only its owner may have had a hand in it, and that is who
/// runs this, or root. In a sticky folder, such as /tmp, nobody replaces what is another's.
void refuse_hand_of_others(const fs::path& file, const std::string& what, const struct stat& found) {
  if (found.st_uid != 0 && found.st_uid != ::geteuid())
    refuse(file, what + "belongs to another user; it must be yours or root's");
  const bool is_sticky_folder = S_ISDIR(found.st_mode) && (found.st_mode & S_ISVTX) != 0;
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0 && !is_sticky_folder)
    refuse(file, what + "can be written by others; run `chmod go-w` on it");
}

/// The file as it is now; its path is without links. Nobody else can have written or replaced it.
struct stat looked_at(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) refuse(file, std::strerror(errno), ErrorKind::not_found);
  if (!S_ISREG(found.st_mode)) refuse(file, "is no regular file");
  refuse_hand_of_others(file, "", found);
  for (fs::path folder = file; folder.has_relative_path();) {
    folder = folder.parent_path();
    struct stat above {};
    if (::stat(folder.c_str(), &above) != 0) refuse(file, folder.string() + ": " + std::strerror(errno));
    refuse_hand_of_others(file, "its folder " + folder.string() + " ", above);
  }
  return found;
}

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size &&
         a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

/// The program ream-plugin-trial at work; ends with this object.
class TrialProcess {
 public:
  explicit TrialProcess(const fs::path& file) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(file, std::strerror(errno), ErrorKind::io);
    answers_ = FileDescriptor(ends[0]);
    const FileDescriptor answer(ends[1]);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, answer.get(), STDOUT_FILENO);
    const fs::path program = isolation::helper_program("ream-plugin-trial");
    std::array<std::string, 4> words{program.string(), file.string(), std::to_string(trial_ticks),
                                     std::to_string(feed_budget_us)};
    std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                   nullptr};
    const int failed =
        ::posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
      refuse(file, "cannot be tried, as " + program.string() + " does not start: " + std::strerror(failed),
             ErrorKind::io);
  }
  ~TrialProcess() {
    if (process_ > 0) ended(SIGKILL);
  }
  TrialProcess(const TrialProcess&) = delete;
  TrialProcess& operator=(const TrialProcess&) = delete;

  /// All that it says until it ends; empty when it does not end in time.
  std::string said() const {
    std::string text;
    std::array<char, 1024> part{};
    const int64_t until_ns = steady_ns() + max_trial_ns;
    for (pollfd poll{answers_.get(), POLLIN, 0}; steady_ns() < until_ns && text.size() < max_answer_bytes;) {
      if (::poll(&poll, 1, 100) <= 0) continue;
      const ssize_t got = ::read(answers_.get(), part.data(), part.size());
      if (got <= 0) return text;
      text.append(part.data(), static_cast<size_t>(got));
    }
    return {};
  }

  /// How it ended, as waitpid() says it.
  int ended(int signal) {
    int status = 0;
    ::kill(process_, signal);
    ::waitpid(std::exchange(process_, 0), &status, 0);
    return status;
  }

 private:
  pid_t process_ = 0;
  FileDescriptor answers_;
};

nlohmann::json tried(const fs::path& file) {
  TrialProcess trial(file);
  const std::string said = trial.said();
  const int status = trial.ended(said.empty() ? SIGKILL : 0);
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
    refuse(file, std::string("crashes while it is loaded and tried: ") + ::strsignal(WTERMSIG(status)));
  if (said.empty()) refuse(file, "does not come back while it is loaded and tried");
  nlohmann::json found = parse_json_or_discard(said);
  if (!found.is_object()) refuse(file, one_line(said.substr(0, said.find('\n')), 300));
  return found;
}

/// 0.27 as people read it.
std::string hundredths(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

}  // namespace

std::string in_words(const Plugin& plugin) {
  std::string parts;
  const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : ", ") + part; };
  if (const auto feed = plugin.trial.find("feed"); feed != plugin.trial.end())
    add("feed model (" + hundredths(feed->at("p99_us")) + " us of processor time in 99 of 100 ticks)");
  if (plugin.trial.at("score") == true) add("score");
  if (const auto device = plugin.trial.find("device"); device != plugin.trial.end())
    add("device " + device->get<std::string>());
  return plugin.identity.in_words() + ": " + parts;
}

Plugin load_plugin(const fs::path& given) {
  std::error_code failed;
  const fs::path file = fs::canonical(given, failed);
  if (failed) refuse(given, failed.message(), ErrorKind::not_found);
  const struct stat before = looked_at(file);
  Plugin plugin;
  plugin.identity.sha256 = access::sha256_of(file);
  plugin.trial = tried(file);
  if (!is_same(before, looked_at(file))) refuse(file, "has changed while it was tried; start again");
  const FloatingPoint kept;
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!is_same(before, looked_at(file))) refuse(file, "has changed while it was tried; start again");
  if (handle != nullptr)
    plugin.description = static_cast<const ream_plugin_description*>(::dlsym(handle, "ream_plugin"));
  if (plugin.description == nullptr) refuse(file, "cannot be loaded: " + std::string(::dlerror()));
  plugin.identity.name = plugin.description->name;
  plugin.identity.version = plugin.description->version;
  return plugin;
}

}  // namespace ream::plugin
