/* Nothing but files needs care at an end from outside, and text.h settles those: so the handler kills what processes
   there are, says how the report stands, and leaves at once, in the middle of whatever was being computed. */
#define _DEFAULT_SOURCE /* setitimer */
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "base/crew.h"
#include "cli.h"

static struct sigaction before[N_ENDING_SIGNALS];
static volatile sig_atomic_t in_place; /* reports of earlier scenes */

static void say(const char *text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) _exit(EXIT_INTERNAL);
}

static void on_end(int number) {
  crew_abandon();
  files_settle();
  if (isatty(STDERR_FILENO)) say("\r\033[K");
  say(number == SIGALRM ? "stickslip: error: the time limit was reached; " : "stickslip: error: interrupted; ");
  say(files_in_place() == in_place ? "nothing was written for this scene\n"
                                   : "this scene's report is written, and whole\n");
  _exit(EXIT_INTERNAL);
}

/* What the caller had ignored, as nohup does, stays so; the clock is its own. */
static bool is_wanted(int i) {
  return ending_signals[i] == SIGALRM || before[i].sa_handler != SIG_IGN;
}

bool interrupt_begin(double seconds) {
  struct sigaction a = {.sa_handler = on_end};
  sigset_t clock;
  sigemptyset(&a.sa_mask);
  for (int i = 0; i < N_ENDING_SIGNALS; i++) sigaddset(&a.sa_mask, ending_signals[i]);
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (sigaction(ending_signals[i], NULL, &before[i]) == 0 && is_wanted(i)) sigaction(ending_signals[i], &a, NULL);
  interrupt_next();
  sigemptyset(&clock);
  sigaddset(&clock, SIGALRM);
  sigprocmask(SIG_UNBLOCK, &clock, NULL);
  struct itimerval t = {.it_value = {(time_t)seconds, (suseconds_t)(1e6 * (seconds - (double)(time_t)seconds))}};
  return seconds <= 0 || setitimer(ITIMER_REAL, &t, NULL) == 0;
}

void interrupt_next(void) {
  in_place = files_in_place();
}

void interrupt_end(void) {
  struct itimerval none = {.it_value = {0, 0}};
  setitimer(ITIMER_REAL, &none, NULL);
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (is_wanted(i)) sigaction(ending_signals[i], &before[i], NULL);
}
