#ifndef REAM_WATCHED_CALLS_H
#define REAM_WATCHED_CALLS_H
#ifdef __cplusplus
extern "C" {
#endif

/* While it is not 0, this thread is in a tick: what a tick may not call ends the process by
 * refused_in_tick(). */
extern __thread int watched_tick;

/* Says why the plug-in is refused, and ends the process. Safe in a signal handler. `what`: "calls malloc". */
void refused_in_tick(const char* what) __attribute__((noreturn));

/* From now on this thread makes no system call in a tick but to tell the time, to answer on `descriptor`, and
 * to end; 0, or -1 with errno. */
int watch_system_calls(int descriptor);

#ifdef __cplusplus
}
#endif
#endif
