#include "loop/traps.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <vector>

// A system call from here is let through by the filter: it is how a trapped one is done after all.
// Arguments as of a function: number, then six.
asm(R"(
  .text
  .globl ream_let_through
  .type ream_let_through, @function
ream_let_through:
  movq %rdi, %rax
  movq %rsi, %rdi
  movq %rdx, %rsi
  movq %rcx, %rdx
  movq %r8, %r10
  movq %r9, %r8
  movq 8(%rsp), %r9
  syscall
  .globl ream_let_through_end
ream_let_through_end:
  ret
  .size ream_let_through, . - ream_let_through
)");
extern "C" long ream_let_through(long number, long a, long b, long c, long d, long e, long f);
extern "C" const char ream_let_through_end;
extern "C" void* __libc_malloc(size_t);
extern "C" void* __libc_calloc(size_t, size_t);
extern "C" void* __libc_realloc(void*, size_t);
extern "C" void* __libc_memalign(size_t, size_t);
extern "C" void __libc_free(void*);
// All interposed functions lie in a section of their own, whose ends the linker gives.
#define REAM_TRAP_CODE __attribute__((section("ream_traps")))
extern "C" const char __start_ream_traps[], __stop_ream_traps[];

namespace ream::test {
namespace {

constexpr int most_frames = 40;

/// Written by the one thread that is watched, read by others after it.
struct Findings {
  std::array<uint64_t, trap_kinds> ours{}, vendors{};
  std::array<void*, most_frames> first_frames{};
  int first_count = 0;
  Trap first{};
  long first_system_call = -1;
};
Findings findings;
thread_local bool armed = false, filtered = false;

struct Range {
  uintptr_t from = 0, to = 0;
  bool holds(const void* p) const {
    return reinterpret_cast<uintptr_t>(p) >= from && reinterpret_cast<uintptr_t>(p) < to;
  }
};
Range this_program;
std::vector<Range> open_cl;  ///< the loader's and the vendors' libraries

/// Parts of the names of libraries that are, or belong to, an implementation of OpenCL.
constexpr const char* open_cl_names[] = {"OpenCL", "opencl", "pocl", "amdocl", "igdrcl", "intelocl", "cuda"};

int note_object(dl_phdr_info* object, size_t, void*) {
  Range range{UINTPTR_MAX, 0};
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& header = object->dlpi_phdr[i];
    if (header.p_type != PT_LOAD || (header.p_flags & PF_X) == 0) continue;
    range.from = std::min<uintptr_t>(range.from, object->dlpi_addr + header.p_vaddr);
    range.to = std::max<uintptr_t>(range.to, object->dlpi_addr + header.p_vaddr + header.p_memsz);
  }
  const std::string name = object->dlpi_name;
  if (name.empty()) this_program = range;
  for (const char* part : open_cl_names)
    if (name.find(part) != std::string::npos) open_cl.push_back(range);
  return 0;
}

/// Whether it is in an interposed function, which is in place of the library's whoever calls it.
bool is_interposed(const void* frame) {
  return frame >= static_cast<const void*>(__start_ream_traps) &&
         frame <= static_cast<const void*>(__stop_ream_traps);
}

/// Whether OpenCL lies on the way from where it happened to the first code of this program. `caller` is whom
/// the interposed function was called by, or where the system call was made.
bool is_vendors(void* const* frames, int count, const void* caller) {
  void* const* const end = frames + count;
  for (void* const* frame = std::find(frames, end, caller); frame != end; ++frame) {
    if (is_interposed(*frame)) continue;
    if (this_program.holds(*frame)) return false;
    for (const Range& range : open_cl)
      if (range.holds(*frame)) return true;
  }
  return false;
}

void spring(Trap trap, long system_call, const void* caller) {
  armed = false;  // what the look around itself does is not counted
  const int saved_errno = errno;
  std::array<void*, most_frames> frames;
  const int count = ::backtrace(frames.data(), most_frames);
  const bool vendors = is_vendors(frames.data(), count, caller);
  ++(vendors ? findings.vendors : findings.ours)[static_cast<size_t>(trap)];
  if (!vendors && findings.first_count == 0) {
    findings.first_frames = frames;
    findings.first_count = count;
    findings.first = trap;
    findings.first_system_call = system_call;
  }
  errno = saved_errno;
  armed = true;
}

void on_system_call(int, siginfo_t* info, void* context) {
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  if (armed) spring(Trap::system_call, info->si_syscall, info->si_call_addr);
  registers[REG_RAX] =
      ream_let_through(info->si_syscall, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                       registers[REG_R10], registers[REG_R8], registers[REG_R9]);
}

void install_filter() {
  const auto from = reinterpret_cast<uintptr_t>(&ream_let_through);
  const auto to = reinterpret_cast<uintptr_t>(&ream_let_through_end);
  const auto high = static_cast<uint32_t>(from >> 32);
  // The kernel tells the address after the syscall instruction.
  const sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_nanosleep, 8, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_gettime, 7, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 6, 0),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, instruction_pointer) + 4),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, high, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, instruction_pointer)),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, static_cast<uint32_t>(from), 0, 1),
      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, static_cast<uint32_t>(to), 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{sizeof rules / sizeof rules[0], const_cast<sock_filter*>(rules)};
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  if (::sigaction(SIGSYS, &action, nullptr) != 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) != 0)
    ::abort();
}

/// Condition variables have an older form of the same name, which is not meant.
template <typename Function>
Function next(const char* name) {
  void* found = ::dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2");
  return reinterpret_cast<Function>(found != nullptr ? found : ::dlsym(RTLD_NEXT, name));
}

void trapped(Trap trap, const void* caller) {
  if (armed) spring(trap, -1, caller);
}

}  // namespace

const char* to_text(Trap trap) {
  switch (trap) {
    case Trap::allocate: return "allocation";
    case Trap::release: return "release of memory";
    case Trap::lock: return "lock";
    case Trap::wake: return "wake-up of another thread";
    case Trap::system_call: return "system call";
  }
  return "";
}

uint64_t Caught::of_ours() const { return std::accumulate(ours.begin(), ours.end(), uint64_t{0}); }

std::string Caught::words() const {
  std::string words;
  for (int i = 0; i < trap_kinds; ++i) {
    const auto kind = static_cast<size_t>(i);
    if (ours[kind] + vendors[kind] == 0) continue;
    words += std::string(to_text(static_cast<Trap>(i))) + ": " + std::to_string(ours[kind]) + " of ours, " +
             std::to_string(vendors[kind]) + " inside OpenCL\n";
  }
  return words + first;
}

void Traps::prepare() {
  std::array<void*, most_frames> frames;
  ::backtrace(frames.data(), most_frames);  // loads what it needs now
  this_program = {};
  open_cl.clear();
  ::dl_iterate_phdr(note_object, nullptr);
  findings = {};
}

void Traps::arm() noexcept {
  if (!filtered) install_filter();
  filtered = true;
  armed = true;
}

void Traps::disarm() noexcept { armed = false; }

Caught Traps::caught() {
  Caught caught{findings.ours, findings.vendors, ""};
  if (findings.first_count == 0) return caught;
  caught.first = std::string("the first of ours is a ") + to_text(findings.first);
  if (findings.first == Trap::system_call)
    caught.first += " with the number " + std::to_string(findings.first_system_call);
  char** names = ::backtrace_symbols(findings.first_frames.data(), findings.first_count);
  for (int i = 2; i < findings.first_count; ++i) caught.first += std::string("\n  ") + names[i];
  ::free(names);
  return caught;
}

}  // namespace ream::test

using ream::test::Trap;
using ream::test::trapped;

extern "C" {

REAM_TRAP_CODE void* malloc(size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  return __libc_malloc(size);
}
REAM_TRAP_CODE void* calloc(size_t count, size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  return __libc_calloc(count, size);
}
REAM_TRAP_CODE void* realloc(void* old, size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  return __libc_realloc(old, size);
}
REAM_TRAP_CODE void* memalign(size_t alignment, size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
REAM_TRAP_CODE void* aligned_alloc(size_t alignment, size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
REAM_TRAP_CODE int posix_memalign(void** out, size_t alignment, size_t size) {
  trapped(Trap::allocate, __builtin_return_address(0));
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
REAM_TRAP_CODE void free(void* p) {
  if (p != nullptr) trapped(Trap::release, __builtin_return_address(0));
  __libc_free(p);
}

#define REAM_TRAPPED(trap, name, parameters, arguments)                  \
  REAM_TRAP_CODE int name parameters {                                   \
    static const auto real = ream::test::next<int(*) parameters>(#name); \
    trapped(trap, __builtin_return_address(0));                          \
    return real arguments;                                               \
  }

REAM_TRAPPED(Trap::lock, pthread_mutex_lock, (pthread_mutex_t * m), (m))
REAM_TRAPPED(Trap::lock, pthread_mutex_trylock, (pthread_mutex_t * m), (m))
REAM_TRAPPED(Trap::lock, pthread_mutex_timedlock, (pthread_mutex_t * m, const timespec* t), (m, t))
REAM_TRAPPED(Trap::lock, pthread_rwlock_rdlock, (pthread_rwlock_t * l), (l))
REAM_TRAPPED(Trap::lock, pthread_rwlock_tryrdlock, (pthread_rwlock_t * l), (l))
REAM_TRAPPED(Trap::lock, pthread_rwlock_wrlock, (pthread_rwlock_t * l), (l))
REAM_TRAPPED(Trap::lock, pthread_rwlock_trywrlock, (pthread_rwlock_t * l), (l))
REAM_TRAPPED(Trap::lock, pthread_spin_lock, (pthread_spinlock_t * l), (l))
REAM_TRAPPED(Trap::lock, pthread_cond_wait, (pthread_cond_t * c, pthread_mutex_t* m), (c, m))
REAM_TRAPPED(Trap::lock, pthread_cond_timedwait, (pthread_cond_t * c, pthread_mutex_t* m, const timespec* t),
             (c, m, t))
REAM_TRAPPED(Trap::lock, pthread_cond_clockwait,
             (pthread_cond_t * c, pthread_mutex_t* m, clockid_t k, const timespec* t), (c, m, k, t))
REAM_TRAPPED(Trap::lock, sem_wait, (sem_t * s), (s))
REAM_TRAPPED(Trap::wake, pthread_cond_signal, (pthread_cond_t * c), (c))
REAM_TRAPPED(Trap::wake, pthread_cond_broadcast, (pthread_cond_t * c), (c))
REAM_TRAPPED(Trap::wake, sem_post, (sem_t * s), (s))

}  // extern "C"
