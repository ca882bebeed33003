/* Orbits in lanes: points are packed into blocks, each block is solved by the kernel of the widest instruction set that
   the machine has, and threads share the blocks.

   The last block is filled up with copies of its first point, so that every point is solved by the same loop. */
#include "stickslip/batch.h"

#include <math.h>

#include "batch_impl.h"

enum { MOST_PARTS = 64 };

#define FLAT __attribute__((flatten))

#if defined(__GNUC__) && defined(__x86_64__)
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

#if defined(__GNUC__) && defined(__x86_64__)
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
#if defined(__GNUC__) && defined(__x86_64__)
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

/* Looks closer at phase H of the lanes that ask for it, and decides them where that settles it. */
static void look_closer(struct lanes *l, const struct set *set) {
  struct march m;
  double most = 0;
  for (int j = 0; j < LANES; j++) {
    if (l->parts[j] > MOST_PARTS) l->parts[j] = 0;
    most = fmax(most, l->parts[j]);
  }
  if (most == 0) return;
  set->start(&m, l);
  for (double part = 0; part < most + 1; part++) set->part(&m, part);
  for (int j = 0; j < LANES; j++) {
    bool late = l->broken[j] & UINT64_C(1) << COND_C_V2; /* z_2' > V at the end of phase H */
    if (l->parts[j] == 0 || !m.below[j] || !(m.slow[j] || m.above[j] || late)) continue;
    l->status[j] = SS_OK;
    if (m.above[j]) l->broken[j] |= UINT64_C(1) << COND_H_V2;
  }
}

/* Points from first on, as many as fit. */
static int run_block(double *const out[N_DYN_OUT], unsigned *violations, int *status,
                     const double *const params[N_PARAMS], const double *const guess[2], slong first, slong n,
                     const struct set *set) {
  struct lanes l;
  slong used = FLINT_MIN(n - first, LANES);
  for (slong j = 0; j < LANES; j++) {
    slong from = first + (j < used ? j : 0);
    for (int i = 0; i < N_PARAMS; i++) l.params[i][j] = params[i][from];
    for (int i = 0; i < 2; i++) l.guess[i][j] = guess[i][from];
  }
  set->run(&l);
  look_closer(&l, set);
  int all = SS_OK;
  for (slong j = 0; j < used; j++) {
    status[first + j] = (int)l.status[j];
    violations[first + j] = (unsigned)l.broken[j];
    all |= (int)l.status[j];
  }
  for (int i = 0; i < N_DYN_OUT; i++)
    for (slong j = 0; j < used; j++) out[i][first + j] = l.status[j] ? (double)NAN : l.out[i][j];
  return all;
}

int dyn_orbits_batch(double *const out[N_DYN_OUT], unsigned *violations, int *status,
                     const double *const params[N_PARAMS], const double *const guess[2], slong n, int jobs) {
  const struct set *set = set_to_use();
  int all = SS_OK;
  (void)jobs;
#ifdef _OPENMP
#pragma omp parallel for num_threads(jobs > 1 ? jobs : 1) schedule(dynamic, 4) reduction(| : all) if (jobs > 1)
#endif
  for (slong first = 0; first < n; first += LANES)
    all |= run_block(out, violations, status, params, guess, first, n, set);
  return all;
}
