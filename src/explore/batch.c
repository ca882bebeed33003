/* Orbits in lanes: points are packed into blocks, each block is solved by the kernel of the widest instruction set that
   the machine has.

   The last block is filled up with copies of its first point, so that every point is solved by the same loop.  Points
   with a long phase H are gathered from the blocks of a tile to be looked at together. */
#include "batch.h"

#include <math.h>

#include "batch_impl.h"

enum { MOST_PARTS = 256, FINER = 4 };

#define FLAT __attribute__((flatten)) /* all of a loop's calls are inlined, or it is not vectorised */

#if defined(__x86_64__)
#if defined(__clang__)
#define WIDE "avx512f,avx512dq,avx512vl"
#else
#define WIDE "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
#define BATCH_RUN    run_avx512
#define BATCH_START  start_avx512
#define BATCH_PART   part_avx512
#define BATCH_TARGET FLAT __attribute__((target(WIDE)))
#include "batch_kernel.h"
#define BATCH_RUN    run_avx2
#define BATCH_START  start_avx2
#define BATCH_PART   part_avx2
#define BATCH_TARGET FLAT __attribute__((target("avx2")))
#include "batch_kernel.h"
#endif
#define BATCH_RUN    run_baseline
#define BATCH_START  start_baseline
#define BATCH_PART   part_baseline
#define BATCH_TARGET FLAT
#include "batch_kernel.h"

static bool always(void) {
  return true;
}

#if defined(__x86_64__)
static bool has_avx2(void) {
  return __builtin_cpu_supports("avx2");
}

static bool has_avx512(void) {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/* The widest first. */
static const struct set {
  const char *name;
  void (*run)(struct lanes *l);
  void (*start)(struct march *m, const struct lanes *l);
  void (*part)(struct march *m, double part);
  bool (*here)(void);
} sets[] = {
#if defined(__x86_64__)
    {"avx512", run_avx512, start_avx512, part_avx512, has_avx512},
    {"avx2", run_avx2, start_avx2, part_avx2, has_avx2},
#endif
    {"baseline", run_baseline, start_baseline, part_baseline, always},
};
enum { N_SETS = sizeof sets / sizeof *sets };

static int forced = -1;

const char *batch_set_name(int set) {
  return set < N_SETS ? sets[set].name : NULL;
}

bool batch_set_here(int set) {
  return sets[set].here();
}

void batch_set_use(int set) {
  forced = set;
}

static const struct set *set_to_use(void) {
  int set = forced;
  if (set < 0)
    for (set = 0; !sets[set].here();) set++;
  return &sets[set];
}

/* --- Tiles: blocks whose open points are looked at together. --- */

enum { TILE = 64 * LANES };

struct points {
  double *const *out;
  unsigned *violations;
  int *status;
  const double *const *params, *const *guess;
  const struct set *set; /* of instructions */
};

/* Points of a tile whose phase H asks for a closer look, in about so many parts. */
struct open {
  slong n, point[TILE];
  double parts[TILE];
};

/* The lanes of a block; those from n on repeat the first. */
static void fill(struct lanes *l, const struct points *p, const slong *point, slong n) {
  for (slong j = 0; j < LANES; j++) {
    slong from = point[j < n ? j : 0];
    for (int i = 0; i < N_PARAMS; i++) l->params[i][j] = p->params[i][from];
    for (int i = 0; i < 2; i++) l->guess[i][j] = p->guess[i][from];
  }
}

static void solve(struct open *open, const struct points *p, slong first, slong n) {
  struct lanes l;
  slong point[LANES] = {first};
  for (slong j = 0; j < n; j++) point[j] = first + j;
  fill(&l, p, point, n);
  p->set->run(&l);
  for (int i = 0; i < N_DYN_OUT; i++)
    for (slong j = 0; j < n; j++) p->out[i][first + j] = l.out[i][j];
  for (slong j = 0; j < n; j++) {
    p->status[first + j] = (int)l.status[j];
    p->violations[first + j] = (unsigned)l.broken[j];
    if (!(l.parts[j] > 0)) continue;
    open->point[open->n] = first + j;
    open->parts[open->n++] = l.parts[j];
  }
}

/* Marches through phase H of n <= LANES points in m->parts each.  What stays open is moved to the front of the rest. */
static void look(struct open *rest, const struct open *open, slong from, slong n, const struct points *p,
                 double finer) {
  struct lanes l;
  struct march m;
  double most = 0;
  fill(&l, p, open->point + from, n);
  for (slong j = 0; j < LANES; j++) {
    slong at = from + (j < n ? j : 0);
    l.out[DYN_OUT_TB][j] = p->out[DYN_OUT_TB][open->point[at]];
    l.out[DYN_OUT_TC][j] = p->out[DYN_OUT_TC][open->point[at]];
    l.parts[j] = finer * open->parts[at];
    most = fmax(most, l.parts[j]);
  }
  p->set->start(&m, &l);
  for (double part = 0; part < most + 1; part++) p->set->part(&m, part);
  for (slong j = 0; j < n; j++) {
    slong point = open->point[from + j];
    bool late = p->violations[point] & 1u << COND_C_V2; /* z_2' > V at the end of phase H */
    if (m.below[j] == 1 && (m.slow[j] == 1 || m.above[j] > 0 || late)) {
      p->status[point] = SS_OK;
      if (m.above[j] > 0) p->violations[point] |= 1u << COND_H_V2;
    } else {
      rest->point[rest->n] = point;
      rest->parts[rest->n++] = open->parts[from + j];
    }
  }
}

/* A closer look at all that are open, in `finer` times as many parts as they ask for, unless those are too many. */
static void look_closer(struct open *open, const struct points *p, double finer) {
  struct open now = {.n = 0};
  for (slong i = 0; i < open->n; i++) {
    if (finer * open->parts[i] > MOST_PARTS) continue;
    now.point[now.n] = open->point[i];
    now.parts[now.n++] = open->parts[i];
  }
  open->n = 0;
  for (slong i = 0; i < now.n; i += LANES) look(open, &now, i, FLINT_MIN(now.n - i, LANES), p, finer);
}

static int run_tile(const struct points *p, slong first, slong end) {
  struct open open = {.n = 0};
  int all = SS_OK;
  for (slong j = first; j < end; j += LANES) solve(&open, p, j, FLINT_MIN(end - j, LANES));
  look_closer(&open, p, 1);
  look_closer(&open, p, FINER);
  for (slong j = first; j < end; j++) {
    all |= p->status[j];
    if (p->status[j] == SS_OK) continue;
    p->violations[j] = 0;
    for (int i = 0; i < N_DYN_OUT; i++) p->out[i][j] = NAN;
  }
  return all;
}

int dyn_orbits_batch(double *const out[N_DYN_OUT], unsigned *violations, int *status,
                     const double *const params[N_PARAMS], const double *const guess[2], slong n) {
  const struct points p = {out, violations, status, params, guess, set_to_use()};
  int all = SS_OK;
  for (slong first = 0; first < n; first += TILE) all |= run_tile(&p, first, FLINT_MIN(n, first + TILE));
  return all;
}
