/// Memory that runs out once, for LD_PRELOAD: one allocation after the beginning of main() gets none
/// (disk_fault.hpp). When it is asked for again at once, a small one is there, as some memory comes free all
/// the time; a large one is not. Processes that the program starts are not given this library.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

#include "support/disk_fault.hpp"

// The names are those of the C library.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

std::atomic<bool> counting{false};
std::atomic<long> seen{0};
long failing = 0;
bool only_large = false;
constexpr size_t large_bytes = 4096;
/// What was refused to this thread just now, to be refused once more; 0: nothing.
thread_local size_t refused __attribute__((tls_model("initial-exec"))) = 0;

/// Whether this is the one that fails.
bool fails(size_t bytes) {
  if (!counting.load(std::memory_order_relaxed)) return false;
  const bool again = refused > 0 && bytes == refused;
  refused = 0;
  if (!again) {
    if ((only_large && bytes < large_bytes) || ++seen != failing) return false;
    if (bytes >= large_bytes) refused = bytes;
  }
  errno = ENOMEM;
  return true;
}

using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int counted_main(int count, char** words, char** environment) {
  const char* const number = std::getenv(ream::test::disk_fault_number_variable);
  failing = number == nullptr ? 0 : std::atol(number);
  const char* const call = std::getenv(ream::test::disk_fault_call_variable);
  only_large = call != nullptr && std::strcmp(call, "allocate-large") == 0;
  counting = true;
  const int code = real_main(count, words, environment);
  counting = false;
  return code;
}

struct Count {
  ~Count() {
    counting = false;
    const char* const file = std::getenv(ream::test::disk_fault_count_variable);
    if (file == nullptr) return;
    const long to = ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::array<char, 32> text{};
    const int size = std::snprintf(text.data(), text.size(), "%ld", seen.load());
    if (to < 0 || ::syscall(SYS_write, to, text.data(), size) < 0) std::abort();
  }
} count_at_the_end;

}  // namespace

extern "C" {
void* malloc(size_t size) { return fails(size) ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails(count * size) ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return fails(size) ? nullptr : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) {
  return fails(size) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return fails(size) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** to, size_t alignment, size_t size) {
  void* const found = fails(size) ? nullptr : __libc_memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *to = found;
  return 0;
}

int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*end)(), void (*loader_end)(),
                      void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto next = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  real_main = main;
  return next(counted_main, count, words, init, end, loader_end, stack);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
