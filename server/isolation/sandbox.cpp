#include "isolation/sandbox.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <sstream>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"

namespace ream::isolation {
namespace {

[[noreturn]] void fail(const std::string& what, int error = errno) {
  throw Error(ErrorKind::io,
              "a process of its own cannot be closed off: " + what + ": " + std::strerror(error));
}

/// The lower of this and of what the process may have anyhow: an administrator's limit is kept.
void limit(__rlimit_resource_t resource, uint64_t to, const char* what, uint64_t margin = 0) {
  rlimit bounds{};
  if (::getrlimit(resource, &bounds) != 0) fail(what);
  bounds.rlim_max = std::min<rlim_t>(to + margin, bounds.rlim_max);
  bounds.rlim_cur = std::min<rlim_t>(to, bounds.rlim_max);
  if (::setrlimit(resource, &bounds) != 0) fail(what);
}

/// Best effort: without these the process is only a worse neighbour.
void step_back(bool background) {
  if (const FileDescriptor file{::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC)}) [[maybe_unused]]
    const ssize_t written = ::write(file.get(), "1000", 4);
  if (!background) return;
  const sched_param idle{};
  ::sched_setscheduler(0, SCHED_IDLE, &idle);
  ::setpriority(PRIO_PROCESS, 0, 19);
  constexpr int of_process = 1, idle_class = 3 << 13;
  ::syscall(SYS_ioprio_set, of_process, 0, idle_class);
}

void set_limits(const SandboxLimits& limits) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limit(RLIMIT_AS, limits.memory_bytes, "memory");  // a sanitizer's shadow takes terabytes of addresses
#endif
  limit(RLIMIT_CPU, limits.processor_s, "processor time", 5);  // first a signal that says why
  limit(RLIMIT_FSIZE, limits.file_bytes, "size of files");
  limit(RLIMIT_CORE, 0, "core files");
  limit(RLIMIT_NOFILE, 64, "open files");
}

/// Newest form of landlock_ruleset_attr; an older kernel is given the part that it knows.
struct LandlockRules {
  uint64_t files, network, scopes;
};

/// Rights over files, by the version of the interface that brought them.
uint64_t all_file_rights(int version) {
  constexpr uint64_t move = 1 << 13, truncate = 1 << 14, control_devices = 1 << 15;
  uint64_t rights = (1 << 13) - 1;
  if (version >= 2) rights |= move;
  if (version >= 3) rights |= truncate;
  if (version >= 5) rights |= control_devices;
  return rights;
}

void allow_below(int rules, int descriptor, uint64_t rights, const char* what) {
  landlock_path_beneath_attr rule{};
  rule.allowed_access = rights;
  rule.parent_fd = descriptor;
  if (::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) != 0) fail(what);
}

void close_files_off(int version, std::span<const int> inputs, int output) {
  constexpr uint64_t read = LANDLOCK_ACCESS_FS_READ_FILE, list = LANDLOCK_ACCESS_FS_READ_DIR;
  constexpr uint64_t connect_and_bind = 3, signals_and_abstract_sockets = 3;
  const uint64_t all = all_file_rights(version);
  const LandlockRules wanted{all, connect_and_bind, signals_and_abstract_sockets};
  const size_t known = version >= 6 ? 24 : version >= 4 ? 16 : 8;
  const FileDescriptor rules{static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, known, 0))};
  if (!rules) fail("Landlock");
  for (const int input : inputs) {
    struct stat status {};
    if (::fstat(input, &status) != 0) fail("its input");
    allow_below(rules.get(), input, S_ISDIR(status.st_mode) ? read | list : read, "its input");
  }
  allow_below(rules.get(), output,
              all & ~uint64_t{LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                              LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SOCK |
                              LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_SYM},
              "its output");
  if (::syscall(SYS_landlock_restrict_self, rules.get(), 0) != 0) fail("Landlock");
}

/// Calls that reading and drawing need: files, memory, time, its own threads and signals. All others fail
/// with EPERM. None changes what Landlock does not govern (modes, times, owners and attributes of files) or
/// acts on a process.
constexpr const char* allowed_calls =
    "read write readv writev pread64 pwrite64 open openat close lseek fstat stat lstat newfstatat statx "
    "statfs fstatfs access faccessat faccessat2 getdents64 getcwd readlink readlinkat mkdir mkdirat "
    "rename renameat renameat2 unlink unlinkat rmdir ftruncate fallocate fsync fdatasync fadvise64 umask "
    "dup poll ppoll brk munmap mremap madvise futex set_robust_list rseq rt_sigaction rt_sigprocmask "
    "rt_sigreturn sigaltstack restart_syscall exit exit_group getpid gettid getuid geteuid getgid getegid "
    "getrandom getrusage getrlimit uname sysinfo times time gettimeofday clock_gettime clock_getres "
    "nanosleep clock_nanosleep sched_yield sched_getaffinity";
/// Of fcntl(). Its others let a descriptor that the server shares signal the server (F_SETOWN, F_SETSIG,
/// O_ASYNC).
constexpr int allowed_descriptor_commands[] = {F_GETFD, F_SETFD, F_GETFL, F_DUPFD_CLOEXEC};

scmp_arg_cmp equal(unsigned argument, uint64_t value) { return {argument, SCMP_CMP_EQ, value, 0}; }
scmp_arg_cmp without(unsigned argument, uint64_t bits) { return {argument, SCMP_CMP_MASKED_EQ, bits, 0}; }
scmp_arg_cmp with(unsigned argument, uint64_t bits) { return {argument, SCMP_CMP_MASKED_EQ, bits, bits}; }

void close_calls_off(bool compiles) {
  const std::unique_ptr<void, decltype(&::seccomp_release)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                   ::seccomp_release);
  if (!filter) fail("seccomp", ENOMEM);
  const auto check = [](int result) {
    if (result != 0) fail("seccomp", -result);
  };
  std::istringstream calls(allowed_calls);
  for (std::string name; calls >> name;)
    check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, ::seccomp_syscall_resolve_name(name.c_str()), 0));
  for (const int command : allowed_descriptor_commands)
    check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1,
                             equal(1, static_cast<uint64_t>(command))));
  // Memory, but none that could be run: every library is loaded by now.
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
    check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 1, without(2, PROT_EXEC)));
  // What compiles writes code into memory that is no file's.
  if (compiles) {
    check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(mmap), 1, with(3, MAP_ANONYMOUS)));
    check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(mprotect), 1, with(2, PROT_EXEC)));
  }
  // A thread of its own, but no process. The newer call hides its flags: without it libc takes the older.
  constexpr uint64_t thread_flag = 0x10000;
  check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(clone), 1, with(0, thread_flag)));
  check(::seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0));
  // abort() signals its own thread.
  check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                           equal(0, static_cast<uint64_t>(::getpid()))));
  // Limits may be asked for, not set.
  check(::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 1, equal(2, 0)));
  check(::seccomp_load(filter.get()));
}

}  // namespace

SandboxSupport sandbox_support() {
  SandboxSupport support;
  support.landlock = std::max(0, static_cast<int>(::syscall(SYS_landlock_create_ruleset, nullptr, 0,
                                                            LANDLOCK_CREATE_RULESET_VERSION)));
  support.seccomp = ::prctl(PR_GET_SECCOMP) >= 0;
  return support;
}

std::string sandbox_in_words(const SandboxSupport& support) {
  const std::string process = "files from outside are read in a process of its own";
  if (support.landlock > 0 && support.seccomp)
    return process + ", closed off by Landlock " + std::to_string(support.landlock) + " and seccomp";
  const std::string missing = support.landlock > 0 ? "seccomp"
                              : support.seccomp    ? "Landlock"
                                                   : "Landlock and seccomp";
  return process + ", but this kernel has no " + missing +
         ": a file that takes the reader over could read other files; take files only from people you trust";
}

void enter_sandbox(std::span<const int> inputs, int output, const SandboxLimits& limits) {
  step_back(limits.background);
  set_limits(limits);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail("privileges");
  const SandboxSupport support = sandbox_support();
  if (support.landlock > 0) close_files_off(support.landlock, inputs, output);
  if (support.seccomp) close_calls_off(limits.compiles);
}

}  // namespace ream::isolation
