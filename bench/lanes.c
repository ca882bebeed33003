/* Orbits in lanes against the scalar solver: a sweep of the example over e2, every orbit at each point, guessed from
   the point before.  What the lanes leave open is done by the scalar solver, in the time of the lanes.  The peers take
   turns, so that a busy machine meets all of them; the least time of each counts. */
#include <math.h>

#include "bench/jobs.h"
#include "explore/batch_impl.h"
#include "explore/family_impl.h"
#include "motion/search.h"
#include "motion/warm.h"

enum { LINE = 4096, ROUNDS = 100, QUICK_ROUNDS = 5 };
static const double low = 0.80, high = 0.90; /* of e2 */

struct sweep {
  slong n;
  struct family_lanes lanes;
};

/* One orbit along the line from its times at the low end. */
static void add_branch(struct sweep *s, double tb, double tc) {
  for (int i = 0; i < LINE; i++) {
    double p[N_PARAMS], out[N_DYN_OUT], guess[2] = {tb, tc};
    unsigned violations, unsure;
    for (int k = 0; k < N_PARAMS; k++) p[k] = bench_example[k];
    p[P_E2] = low + (high - low) * i / (LINE - 1);
    if (dyn_orbit_warm(out, &violations, &unsure, p, guess)) return;
    s->lanes.params[P_E2][s->n] = p[P_E2];
    s->lanes.guess[0][s->n] = tb;
    s->lanes.guess[1][s->n++] = tc;
    tb = out[DYN_OUT_TB];
    tc = out[DYN_OUT_TC];
  }
}

static void one_by_one(struct sweep *s, slong j) {
  double p[N_PARAMS], out[N_DYN_OUT], guess[2] = {s->lanes.guess[0][j], s->lanes.guess[1][j]};
  unsigned unsure;
  for (int k = 0; k < N_PARAMS; k++) p[k] = s->lanes.params[k][j];
  s->lanes.status[j] = dyn_orbit_warm(out, &s->lanes.violations[j], &unsure, p, guess);
  for (int k = 0; k < N_DYN_OUT; k++) s->lanes.out[k][j] = out[k];
}

static double time_scalar(struct sweep *s) {
  double begin = bench_now();
  for (slong j = 0; j < s->n; j++) one_by_one(s, j);
  return bench_now() - begin;
}

static double time_bare(struct sweep *s) {
  double begin = bench_now();
  for (slong j = 0; j < s->n; j++) {
    double p[N_PARAMS], out[N_DYN_OUT], guess[2] = {s->lanes.guess[0][j], s->lanes.guess[1][j]};
    for (int k = 0; k < N_PARAMS; k++) p[k] = s->lanes.params[k][j];
    s->lanes.status[j] = dyn_orbit_bare(out, p, guess);
    for (int k = 0; k < DYN_OUT_U1; k++) s->lanes.out[k][j] = out[k];
  }
  return bench_now() - begin;
}

static double time_lanes(struct sweep *s, int set) {
  batch_set_use(set);
  double begin = bench_now();
  family_lanes_run(&s->lanes, s->n);
  for (slong j = 0; j < s->n; j++)
    if (s->lanes.status[j] == SS_UNABLE) one_by_one(s, j);
  double took = bench_now() - begin;
  batch_set_use(-1);
  return took;
}

void bench_lanes(struct bench_lanes *b, bool quick) {
  OWNED(search) found;
  struct sweep s = {.n = 0};
  double p[N_PARAMS], scalar = INFINITY, bare = INFINITY, best[MOST_SETS];
  int widest = -1;
  for (int k = 0; k < N_PARAMS; k++) p[k] = bench_example[k];
  p[P_E2] = low;
  *b = (struct bench_lanes){.bare = NAN};
  if (search_run(&found, p, true, false, &dyn_limits_default) == SS_OK) {
    family_lanes_room(&s.lanes, LINE * (slong)found.n + 1, p);
    for (size_t i = 0; i < found.n; i++) add_branch(&s, found.zeros[i].at.tb, found.zeros[i].at.tc);
    for (int i = 0; i < MOST_SETS; i++) best[i] = INFINITY;
    for (int round = 0; round < (quick ? QUICK_ROUNDS : ROUNDS); round++) {
      scalar = fmin(scalar, time_scalar(&s));
      bare = fmin(bare, time_bare(&s));
      for (int set = 0; set < MOST_SETS && batch_set_name(set); set++)
        if (batch_set_here(set)) best[set] = fmin(best[set], time_lanes(&s, set));
    }
    for (int set = 0; set < MOST_SETS && batch_set_name(set); set++) {
      if (!batch_set_here(set)) continue;
      if (widest < 0) widest = set;
      b->set[b->n] = batch_set_name(set);
      b->gain[b->n++] = scalar / best[set];
    }
    if (widest >= 0) b->bare = bare / best[widest];
    family_lanes_clear(&s.lanes);
  }
}
