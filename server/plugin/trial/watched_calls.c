// The program's own malloc and the like come before the C library's also for a shared object that it loads,
// so that a call of them in a tick is seen. What makes system calls in other ways meets a filter of the
// kernel.
#define _GNU_SOURCE
#include "plugin/trial/watched_calls.h"

#include <dlfcn.h>
#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

__thread int watched_tick = 0;

static void watch(const char* call) {
  if (watched_tick != 0) refused_in_tick(call);
}

// Those of memory by the C library's other names: to look for them would allocate.
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

void* malloc(size_t bytes) {
  watch("allocates memory (malloc)");
  return __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
  watch("allocates memory (calloc)");
  return __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) {
  watch("allocates memory (realloc)");
  return __libc_realloc(old, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  watch("allocates memory (memalign)");
  return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  watch("allocates memory (aligned_alloc)");
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** made, size_t alignment, size_t bytes) {
  watch("allocates memory (posix_memalign)");
  *made = __libc_memalign(alignment, bytes);
  return *made == NULL ? ENOMEM : 0;
}
void free(void* memory) {
  if (memory != NULL) watch("frees memory (free)");
  __libc_free(memory);
}

#define WATCHED_LOCK(name, type)                                \
  int name(type* lock) {                                        \
    static int (*real)(type*);                                  \
    watch("takes a lock (" #name ")");                          \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name); \
    return real(lock);                                          \
  }
WATCHED_LOCK(pthread_mutex_lock, pthread_mutex_t)
WATCHED_LOCK(pthread_mutex_trylock, pthread_mutex_t)
WATCHED_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
WATCHED_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
WATCHED_LOCK(sem_wait, sem_t)
int pthread_spin_lock(pthread_spinlock_t* lock) {
  static int (*real)(pthread_spinlock_t*);
  watch("takes a lock (pthread_spin_lock)");
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "pthread_spin_lock");
  return real(lock);
}

static const struct {
  int number;
  const char* words;
} known_calls[] = {{SYS_openat, "opens a file (openat)"},
                   {SYS_read, "reads from a file (read)"},
                   {SYS_write, "writes to a file (write)"},
                   {SYS_writev, "writes to a file (writev)"},
                   {SYS_socket, "opens a socket (socket)"},
                   {SYS_sendto, "sends to a socket (sendto)"},
                   {SYS_recvfrom, "receives from a socket (recvfrom)"},
                   {SYS_nanosleep, "sleeps (nanosleep)"},
                   {SYS_clock_nanosleep, "sleeps (clock_nanosleep)"},
                   {SYS_sched_yield, "gives its processor away (sched_yield)"},
                   {SYS_futex, "takes a lock (futex)"},
                   {SYS_mmap, "allocates memory (mmap)"},
                   {SYS_munmap, "frees memory (munmap)"},
                   {SYS_brk, "allocates memory (brk)"}};

static void on_system_call(int signal, siginfo_t* info, void* context) {
  char other[64];
  size_t end = 0;
  (void)signal;
  (void)context;
  for (size_t i = 0; i < sizeof known_calls / sizeof known_calls[0]; ++i)
    if (info->si_syscall == known_calls[i].number) refused_in_tick(known_calls[i].words);
  // No snprintf in a signal handler.
  static const char words[] = "makes system call ";
  for (const char* c = words; *c != 0; ++c) other[end++] = *c;
  for (int unit = 100; unit > 0; unit /= 10) other[end++] = (char)('0' + info->si_syscall / unit % 10);
  other[end] = 0;
  refused_in_tick(other);
}

#define ALLOWED(number) \
  BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (number), 0, 1), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)
#define LOADED(member) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, member))

int watch_system_calls(int descriptor) {
  struct sigaction action;
  struct sock_filter filter[] = {
      LOADED(nr), ALLOWED(SYS_clock_gettime), ALLOWED(SYS_exit_group), ALLOWED(SYS_rt_sigreturn),
      // abort() and a crash end the process by their signals.
      ALLOWED(SYS_rt_sigprocmask), ALLOWED(SYS_rt_sigaction), ALLOWED(SYS_getpid), ALLOWED(SYS_gettid),
      ALLOWED(SYS_tgkill), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_write, 0, 3), LOADED(args[0]),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)descriptor, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP)};
  const struct sock_fprog program = {sizeof filter / sizeof filter[0], filter};
  memset(&action, 0, sizeof action);
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  if (sigaction(SIGSYS, &action, NULL) != 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}
