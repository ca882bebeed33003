/* Where simulations under Coulomb's law settle: from random starts they run until the last events repeat with a period,
   or until the budget is used up. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/random.h"
#include "motion/coulomb.h"
#include "words_impl.h"

enum { MOST_EVENTS = 3000, MOST_STEPS = 100000, RECENT = 6 * WORD_MOST };
static const double same_state = 1e-7;  /* relative: of a period's states, and of two seeds' lengths */
static const double much_nearer = 1e-4; /* of how far a period's states are apart to a shorter one's */

/* A fixed sequence of numbers in (0, 1). */
static double next_random(uint64_t *seed) {
  return ((double)(random_next(seed) >> 12) + 0.5) / 4503599627370496.0;
}

/* The last events, each with the state just after it. */
struct recent {
  const double *params;
  double scale;
  int n; /* at most RECENT */
  struct {
    double t, state[N_STATE];
    char phase[MECH_PHASE + 1];
    bool both;
  } at[RECENT];
  int period; /* 0: none yet */
};

static double apart(const struct recent *r, int i, int k) {
  if (strcmp(r->at[i].phase, r->at[k].phase) != 0 || r->at[i].both || r->at[k].both) return INFINITY;
  double off = 0;
  for (int c = 0; c < N_STATE; c++) off = fmax(off, fabs(r->at[i].state[c] - r->at[k].state[c]));
  return off;
}

/* The shortest period with which the last events, three times over, repeat; not one that goes several times through a
   shorter word without repeating much more nearly than that, as before a motion has settled on the shorter one. */
static int find_period(const struct recent *r) {
  double off[WORD_MOST + 1];
  for (int n = 1; n <= WORD_MOST && 3 * n <= r->n; n++) {
    off[n] = 0;
    for (int i = r->n - 2 * n; i < r->n && off[n] < INFINITY; i++) off[n] = fmax(off[n], apart(r, i, i - n));
    if (!(off[n] < same_state * r->scale)) continue;
    for (int m = 1; m < n; m++)
      if (n % m == 0 && off[n] > much_nearer * off[m]) return 0;
    return n;
  }
  return 0;
}

static bool remember(void *self, const struct coulomb_event *e) {
  struct recent *r = self;
  const double *p = r->params;
  if (r->n == RECENT) {
    memmove(&r->at[0], &r->at[1], (RECENT - 1) * sizeof r->at[0]);
    r->n--;
  }
  double f[2];
  coulomb_forces(f, p, e->at.x);
  r->at[r->n].t = e->at.t;
  r->at[r->n].both = e->simultaneous;
  for (int i = 0; i < 2; i++) {
    r->at[r->n].phase[i] = coulomb_mode_letter[e->at.mode[i]];
    r->at[r->n].state[WORD_W1 + i] = f[i] - p[COULOMB_US1 + i];
    r->at[r->n].state[WORD_P1 + i] = e->at.mode[i] == MODE_STICK ? 0 : e->at.v[i] - p[COULOMB_V];
  }
  r->n++;
  r->period = find_period(r);
  return r->period == 0;
}

/* The settled motion as a seed that begins with the first phase of the canonical word. */
static struct word_seed seed_of(const struct recent *r) {
  struct word_seed s = {.count = 1};
  int n = r->period, first = r->n - 1 - n;
  struct mech_word raw = {.n = n};
  for (int i = 0; i < n; i++) memcpy(raw.phase[i], r->at[first + i].phase, sizeof raw.phase[i]);
  s.word = raw;
  phase_word_canonical(&s.word);
  int by = mech_word_turned(&s.word, &raw);
  for (int i = 0; i < n; i++) {
    int at = first + (i + by) % n;
    s.t[i] = r->at[at + 1].t - r->at[at].t;
    memcpy(s.state[i], r->at[at].state, sizeof s.state[i]);
  }
  return s;
}

static bool same_seed(const struct word_seed *a, const struct word_seed *b) {
  double total = 0, off = 0;
  if (!mech_word_same(&a->word, &b->word)) return false;
  for (int i = 0; i < a->word.n; i++) {
    total += a->t[i];
    off = fmax(off, fabs(a->t[i] - b->t[i]));
  }
  return off < 100 * same_state * total;
}

static void keep(struct word_seeds *seeds, const struct word_seed *s) {
  for (size_t i = 0; i < seeds->n; i++)
    if (same_seed(&seeds->seed[i], s)) {
      seeds->seed[i].count++;
      return;
    }
  *SS_PUSH(seeds->seed, seeds->n, seeds->cap) = *s;
}

void word_seeds_find(struct word_seeds *seeds, const fmpq *params, const fmpq *const u_r[2], int starts) {
  double model[N_PARAMS], p[N_COULOMB];
  uint64_t random = 1;
  *seeds = (struct word_seeds){.starts = starts};
  for (int i = 0; i < N_PARAMS; i++) model[i] = fmpq_get_d(params + i);
  for (int i = 0; i < 3; i++) p[COULOMB_CHI + i] = model[P_CHI + i];
  for (int i = 0; i < 2; i++) {
    seeds->u_r[i] = u_r[i] ? fmpq_get_d(u_r[i]) : 10 * (model[P_E1] + model[P_E2]);
    p[COULOMB_UR1 + i] = seeds->u_r[i];
    p[COULOMB_US1 + i] = seeds->u_r[i] - model[P_E1 + i];
  }
  double reach = 2 * (model[P_E1] + model[P_E2] + model[P_V]);
  for (int k = 0; k < starts; k++) {
    struct recent r = {.params = p, .scale = reach};
    struct coulomb_sink sink = {&r, remember, NULL};
    struct coulomb_plan plan = coulomb_plan_default;
    struct coulomb_result result;
    double f[2], start[N_STATE];
    for (int i = 0; i < 2; i++) {
      f[i] = p[COULOMB_US1 + i] + reach * (2 * next_random(&random) - 1);
      start[DZ_1 + i] = p[COULOMB_V] * (4 * next_random(&random) - 2);
    }
    start[Z_1] = (f[0] + f[1]) / (1 - p[COULOMB_CHI]);
    start[Z_2] = start[Z_1] + f[1] / p[COULOMB_CHI];
    plan.duration = INFINITY;
    plan.returns = LONG_MAX;
    plan.max_events = MOST_EVENTS;
    plan.max_steps = MOST_STEPS;
    coulomb_simulate_d(&result, p, start, &plan, &sink);
    if (r.period == 0) continue;
    struct word_seed s = seed_of(&r);
    seeds->settled++;
    keep(seeds, &s);
  }
}

void word_seeds_clear(struct word_seeds *seeds) {
  free(seeds->seed);
  *seeds = (struct word_seeds){.n = 0};
}
