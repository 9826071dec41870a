/// A reader that does what a file might make a reader do. Every task answers with what it got.
#include <arpa/inet.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "isolation/isolated_service.hpp"

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string outcome(long result) { return result < 0 ? std::strerror(errno) : "done"; }

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

json read_input(const fs::path& input, const json&, const ream::Progress& progress) {
  progress(0.5, "half\nway");
  std::ofstream("copy") << text_of(input);
  std::vector<std::string> below;
  if (fs::is_directory(input))
    for (const auto& entry : fs::directory_iterator(input)) below.push_back(entry.path().filename());
  return {{"text", text_of(input)}, {"below", below}};
}

/// Opens, makes or removes what the options name.
json reach(const fs::path&, const json& options, const ream::Progress&) {
  const std::string path = options.at("path");
  json told;
  told["read"] = outcome(::open(path.c_str(), O_RDONLY));
  told["write"] = outcome(::open(path.c_str(), O_WRONLY));
  told["create"] = outcome(::open((path + ".new").c_str(), O_WRONLY | O_CREAT, 0600));
  told["remove"] = outcome(::unlink(path.c_str()));
  std::array<char, 4096> names{};
  told["list"] =
      outcome(::syscall(SYS_getdents64, ream::isolation::input_descriptor, names.data(), names.size()));
  told["link"] = outcome(::symlink(path.c_str(), "link"));
  return told;
}

json call(const fs::path&, const json& options, const ream::Progress&) {
  const auto network = [](int family, int type) { return outcome(::socket(family, type, 0)); };
  char name[] = "/bin/true";
  char* const arguments[] = {name, nullptr};
  json told{{"tcp", network(AF_INET, SOCK_STREAM)},
            {"udp", network(AF_INET6, SOCK_DGRAM)},
            {"unix", network(AF_UNIX, SOCK_STREAM)}};
  told["fork"] = outcome(::fork());
  told["exec"] = outcome(::execv(name, arguments));
  told["signal"] = outcome(::kill(options.at("parent").get<int>(), SIGUSR1));
  void* const memory =
      ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  told["code"] = outcome(memory == MAP_FAILED ? -1 : 0);
  std::ofstream("code") << std::string(4096, '\0');
  const int file = ::open("code", O_RDWR);
  void* const mapped = ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE, file, 0);
  told["code of a file"] = outcome(mapped == MAP_FAILED ? -1 : 0);
  ::close(file);
  told["descriptors"] = json::array();
  for (int descriptor = 7; descriptor < 60; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) >= 0) told["descriptors"].push_back(descriptor);
  told["environment"] = json::array();
  for (char** variable = ::environ; *variable != nullptr; ++variable)
    told["environment"].push_back(*variable);
  int sum = 0;
  std::thread([&sum] { sum = 7; }).join();
  told["thread"] = sum;
  return told;
}

/// A call that reading does not need, by which a process changes files that it does not own the way to, or
/// another process.
struct Misuse {
  const char* name;
  long number;
  std::array<long, 4> arguments;
};

long address(const void* of) { return reinterpret_cast<long>(of); }

/// `path` is another file of the user, `parent` the process that started this one.
std::vector<Misuse> misuses(const char* path, long parent, const void* scratch) {
  constexpr long here = AT_FDCWD, input = ream::isolation::input_descriptor,
                 shared = ream::isolation::answer_descriptor, open_pipe = O_WRONLY | O_ASYNC;
  const long file = address(path), memory = address(scratch);
  return {{"chmod", SYS_chmod, {file, 0777}},
          {"fchmod", SYS_fchmod, {input, 0777}},
          {"fchmodat", SYS_fchmodat, {here, file, 0777}},
          {"fchmodat2", 452, {here, file, 0777, 0}},
          {"chown", SYS_chown, {file, -1, -1}},
          {"fchown", SYS_fchown, {input, -1, -1}},
          {"utime", SYS_utime, {file, 0}},
          {"utimes", SYS_utimes, {file, 0}},
          {"utimensat", SYS_utimensat, {here, file, 0, 0}},
          {"setxattr", SYS_setxattr, {file, address("user.a"), address("a"), 1}},
          {"fsetxattr", SYS_fsetxattr, {input, address("user.a"), address("a"), 1}},
          {"truncate", SYS_truncate, {file, 0}},
          {"flock", SYS_flock, {input, LOCK_EX | LOCK_NB}},
          {"inotify_init1", SYS_inotify_init1, {0}},
          {"open_by_handle_at", SYS_open_by_handle_at, {here, memory, 0}},
          {"fcntl F_SETOWN", SYS_fcntl, {shared, F_SETOWN, parent}},
          {"fcntl F_SETOWN_EX", SYS_fcntl, {shared, F_SETOWN_EX, memory}},
          {"fcntl F_SETSIG", SYS_fcntl, {shared, F_SETSIG, SIGKILL}},
          {"fcntl F_SETFL", SYS_fcntl, {shared, F_SETFL, open_pipe}},
          {"fcntl F_SETLEASE", SYS_fcntl, {input, F_SETLEASE, F_RDLCK}},
          {"fcntl F_NOTIFY", SYS_fcntl, {input, F_NOTIFY, DN_MODIFY}},
          {"fcntl F_SETPIPE_SZ", SYS_fcntl, {shared, F_SETPIPE_SZ, 1 << 20}},
          {"fcntl F_ADD_SEALS", SYS_fcntl, {shared, F_ADD_SEALS, 0}},
          {"fcntl F_SETOWN, hidden", SYS_fcntl, {shared, (1L << 32) | F_SETOWN, parent}},
          {"ioctl FIOASYNC", SYS_ioctl, {shared, FIOASYNC, memory}},
          {"ioctl FIOSETOWN", SYS_ioctl, {shared, FIOSETOWN, memory}},
          {"ioctl SIOCSPGRP", SYS_ioctl, {shared, SIOCSPGRP, memory}},
          {"prctl", SYS_prctl, {PR_SET_PTRACER, -1}},
          {"ptrace", SYS_ptrace, {PTRACE_SEIZE, parent, 0, 0}},
          {"process_vm_readv", SYS_process_vm_readv, {parent, memory, 0, memory}},
          {"process_vm_writev", SYS_process_vm_writev, {parent, memory, 0, memory}},
          {"pidfd_open", SYS_pidfd_open, {parent, 0}},
          {"pidfd_send_signal", SYS_pidfd_send_signal, {input, 0, 0, 0}},
          {"pidfd_getfd", SYS_pidfd_getfd, {input, 0, 0}},
          {"kcmp", SYS_kcmp, {parent, parent, 0, 0}},
          {"kill", SYS_kill, {parent, 0}},
          {"tkill", SYS_tkill, {parent, 0}},
          {"tgkill", SYS_tgkill, {parent, parent, 0}},
          {"rt_sigqueueinfo", SYS_rt_sigqueueinfo, {parent, 0, memory}},
          {"timer_create", SYS_timer_create, {CLOCK_MONOTONIC, 0, memory}},
          {"setitimer", SYS_setitimer, {ITIMER_REAL, memory, 0}},
          {"sched_setaffinity", SYS_sched_setaffinity, {parent, 8, memory}},
          {"sched_setscheduler", SYS_sched_setscheduler, {parent, SCHED_OTHER, memory}},
          {"sched_setattr", SYS_sched_setattr, {parent, memory, 0}},
          {"setpriority", SYS_setpriority, {PRIO_PROCESS, parent, 19}},
          {"ioprio_set", SYS_ioprio_set, {1, parent, 3 << 13}},
          {"prlimit64", SYS_prlimit64, {parent, RLIMIT_CPU, memory, 0}},
          {"setrlimit", SYS_setrlimit, {RLIMIT_CORE, memory}},
          {"move_pages", SYS_move_pages, {parent, 0, 0, 0}},
          {"process_madvise", 440, {input, memory, 1, 0}},
          {"unshare", SYS_unshare, {0}},
          {"setns", SYS_setns, {input, 0}},
          {"mount", SYS_mount, {0, file, 0, 0}},
          {"chroot", SYS_chroot, {file}},
          {"io_uring_setup", SYS_io_uring_setup, {1, memory}},
          {"bpf", SYS_bpf, {0, memory, 0}},
          {"perf_event_open", SYS_perf_event_open, {memory, parent, -1, -1}},
          {"userfaultfd", SYS_userfaultfd, {0}},
          {"keyctl", SYS_keyctl, {0, -3, 0}},
          {"memfd_create", SYS_memfd_create, {file, 0}},
          {"shmget", SYS_shmget, {0, 4096, 0600}},
          {"mq_open", SYS_mq_open, {file, O_RDONLY}},
          {"personality", SYS_personality, {0}},
          {"setsid", SYS_setsid, {}}};
}

json misuse(const fs::path&, const json& options, const ream::Progress&) {
  const std::string path = options.at("path");
  std::array<char, 4096> scratch{};
  json told;
  for (const Misuse& one : misuses(path.c_str(), options.at("parent").get<long>(), scratch.data()))
    told[one.name] = outcome(
        ::syscall(one.number, one.arguments[0], one.arguments[1], one.arguments[2], one.arguments[3], 0, 0));
  return told;
}

json take_memory(const fs::path&, const json&, const ream::Progress&) {
  std::vector<std::vector<char>> kept;
  while (true) kept.emplace_back(16 << 20, 'x');
}

json take_disk(const fs::path&, const json&, const ream::Progress&) {
  std::ofstream out("large");
  const std::string piece(1 << 20, 'x');
  while (out << piece) {
  }
  return {};
}

json spin(const fs::path&, const json&, const ream::Progress&) {
  while (true) [[maybe_unused]] const auto now = std::chrono::steady_clock::now();
}

json sleep_long(const fs::path&, const json&, const ream::Progress&) {
  while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
}

/// Never says anything but how far it is.
json tell(const fs::path&, const json&, const ream::Progress& progress) {
  for (int i = 0;; ++i) {
    progress(0.5, std::to_string(i));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

json crash(const fs::path&, const json& options, const ream::Progress&) {
  if (options.at("how") == "abort") std::abort();
  if (options.at("how") == "exit") std::_Exit(0);
  if (options.at("how") == "throw") throw std::runtime_error("a library\ngave up");
  volatile int* nowhere = nullptr;
  *nowhere = 1;
  return {};
}

/// Answers of its own, past the service.
json answer_oddly(const fs::path&, const json& options, const ream::Progress&) {
  std::string text = options.at("text");
  const size_t times = options.at("times");
  for (size_t i = 0; i < times; ++i)
    if (::write(ream::isolation::answer_descriptor, text.data(), text.size()) < 0) break;
  std::_Exit(0);
}

}  // namespace

int main() {
  ream::isolation::serve_one_job({{"read", read_input},
                                  {"reach", reach},
                                  {"call", call},
                                  {"misuse", misuse},
                                  {"take_memory", take_memory},
                                  {"take_disk", take_disk},
                                  {"spin", spin},
                                  {"sleep", sleep_long},
                                  {"tell", tell},
                                  {"crash", crash},
                                  {"answer_oddly", answer_oddly}});
}
