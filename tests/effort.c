#include "effort.h"

#include <math.h>
#include <time.h>

static double cost(const struct effort *e) {
  struct timespec begin, end;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  e->work(e->arg);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}

bool costs_less(const struct effort *one, double factor, const struct effort *other) {
  enum { RUNS = 3, MOST = 15 };
  double least[2] = {INFINITY, INFINITY};
  for (int i = 0; i < MOST; i++) {
    least[0] = fmin(least[0], cost(one));
    least[1] = fmin(least[1], cost(other));
    if (i + 1 >= RUNS && least[0] < factor * least[1]) return true;
  }
  return false;
}
