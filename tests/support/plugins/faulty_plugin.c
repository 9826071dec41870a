/* A plug-in that does in a tick, or is, what FAULT names. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <ream_plugin.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { nothing, allocates, frees, locks, sleeps, loops, writes, connects, slow, nan_value, negative, remembers,
       reads_clock, crashes, aborts, other_abi, short_struct, bad_name, empty_one, hangs_at_start };

static void* volatile kept;
static volatile double sink;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static void* create(const ream_feed_settings* settings) {
  (void)settings;
  return malloc(16);
}

static void load(const void* model, const ream_engaged_bone* bone, ream_cutting_load* load) {
  static double before;
  struct timespec now = {0, 1000};
  load->resistance_n_s_mm = 500.0 + 800.0 * bone->density_g_cc[0] + bone->thrust_n;
  switch (FAULT) {
    case allocates: kept = malloc(100); break;
    case frees: free((void*)model); break;
    case locks: pthread_mutex_lock(&mutex); pthread_mutex_unlock(&mutex); break;
    case sleeps: nanosleep(&now, NULL); break;
    case loops: while (1) sink = sink + 1.0;
    case writes: sink = (double)open("written", O_CREAT | O_WRONLY, 0600); break;
    case connects: sink = (double)socket(AF_INET, SOCK_STREAM, 0); break;
    case slow: for (int i = 0; i < 60000; ++i) sink = sink * 0.5 + 1.0; break;
    case nan_value: if (bone->thrust_n > 399.0) load->torque_arm_mm = NAN; break;
    case negative: load->tangential_ratio = -1.0; break;
    case remembers: load->resistance_n_s_mm += before; before = bone->thrust_n; break;
    case reads_clock:
      clock_gettime(CLOCK_MONOTONIC, &now);
      load->resistance_n_s_mm += (double)(now.tv_nsec % 1000);
      break;
    case crashes: *(volatile int*)8 = 1; break;
    case aborts: abort();
    default: break;
  }
}

#if FAULT == 19
__attribute__((constructor)) static void hang(void) {
  while (1) sink = sink + 1.0;
}
#endif

static const ream_feed_model feed = {FAULT == short_struct ? 4 : sizeof(ream_feed_model), create, free, load};

REAM_PLUGIN_EXPORT const ream_plugin_description ream_plugin = {
    FAULT == other_abi ? 99u : REAM_PLUGIN_ABI, sizeof(ream_plugin_description),
    FAULT == bad_name ? "../Bad" : "faulty", "0.1", FAULT == empty_one ? NULL : &feed, NULL, NULL};
