/* Where orbits may be: motions from random starts, in double precision, and the stretches of them that nearly
   return. */
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/random.h"
#include "moments.h"
#include "num/pi.h"
#include "orbit.h"

enum { WIDE = 24, MOMENTS = 240, KEPT = 4, ROUNDS = 10, MUCH = 8 };
static const char seed[] = "motions of a system";
static const double near = 0.2; /* relative distance of the ends */
/* A motion lasts while the slowest mode goes through so many radians and a surface drags a mass so many times as long
   as it can, but no longer than this. */
static const double phase_angle = 150, drags = 20, longest = 1e6;

/* A stretch of a motion from an event to another one with the same phase behind it. */
struct stretch {
  struct mech_word word;
  double t[MECH_PHASES], z[MECH_STATES], gap; /* the relative distance of its ends */
};
struct stretches {
  struct stretch *at;
  int n;
  size_t cap;
};

static double uniform(uint64_t *stream) {
  return 2 * random_unit(stream) - 1;
}

/* Where the masses are in balance while each is slower than its surface. */
static void balance(double *x, const struct mech *m) {
  SIZED(fmpq_mat, force, m->n, 1);
  SIZED(fmpq_mat, at, m->n, 1);
  for (int i = 0; i < m->n; i++)
    if (m->mass[i].rubbed) {
      int sign = fmpq_sgn(m->mass[i].surface);
      fmpq_mul_si(fmpq_mat_entry(force, i, 0), m->mass[i].sliding, sign);
    }
  fmpq_mat_solve(at, m->stiffness, force);
  for (int i = 0; i < m->n; i++) x[i] = fmpq_get_d(fmpq_mat_entry(at, i, 0));
}

/* Positions about as far out as friction and loads can hold them; or near the balance, as far from it as the loads and
   the excess of static friction reach, since friction that is large against its excess takes many periods to drag the
   masses there.  Velocities about those of the surfaces. */
static void random_start(double *z, const struct mech *m, bool near_balance, uint64_t *stream) {
  double x[MECH_MASSES] = {0};
  if (near_balance) balance(x, m);
  for (int i = 0; i < m->n; i++) {
    const struct mech_mass *mass = &m->mass[i];
    double stiffness = fmpq_get_d(fmpq_mat_entry(m->stiffness, i, i)),
           force = mass->rubbed ? fmpq_get_d(mass->limit) : 1;
    if (mass->rubbed && near_balance) force -= fmpq_get_d(mass->sliding);
    for (int j = 0; j < 2 * m->n_orders; j++) force += fabs(fmpq_get_d(fmpq_mat_entry(m->loading, i, j)));
    z[i] = x[i] + uniform(stream) * 2 * force / stiffness;
    if (mass->stop[0].given) z[i] = fmax(z[i], fmpq_get_d(mass->stop[0].position));
    if (mass->stop[1].given) z[i] = fmin(z[i], fmpq_get_d(mass->stop[1].position));
    z[m->n + i] = fmpq_get_d(mass->surface) * (random_next(stream) % 2 ? 1 : uniform(stream));
  }
  if (m->n_loads) mech_at_angle(z + 2 * m->n, m, PI * uniform(stream));
}

/* Whether the word is a shorter one several times over. */
static bool repeats(const struct mech_word *w) {
  for (int by = 1; by < w->n; by++)
    if (mech_word_goes_through(w, w, by)) return true;
  return false;
}

/* Is it that word, from whichever phase, once or several times over? */
static bool is_rounds_of(const struct mech_word *w, const struct mech_word *once) {
  for (int by = 0; by < once->n; by++)
    if (mech_word_goes_through(w, once, by)) return true;
  return false;
}

/* The stretch from moment i over k phases; false when it does not go through the word that is wanted. */
static bool make_stretch(struct stretch *out, const struct mech_motion *x, int i, int k, const struct mech_word *wanted,
                         const struct mech *m) {
  const struct mech_moment *a = &x->moment[i];
  struct mech_word w = {.n = k};
  for (int l = 0; l < k; l++) memcpy(w.phase[l], a[l].phase, sizeof w.phase[l]);
  if (!mech_word_good(&w) || (wanted && !is_rounds_of(&w, wanted))) return false;
  *out = (struct stretch){.word = w, .gap = mech_gap(a, k, m->n, m->states)};
  for (int l = 0; l < k; l++) out->t[l] = a[l + 1].t - a[l].t;
  memcpy(out->z, a[0].z, sizeof out->z);
  return true;
}

/* Of each word the few that return most nearly. */
static void keep(struct stretches *list, const struct stretch *s) {
  int same = 0, worst = -1;
  for (int i = 0; i < list->n; i++) {
    if (!mech_word_same(&list->at[i].word, &s->word)) continue;
    same++;
    if (worst < 0 || list->at[i].gap > list->at[worst].gap) worst = i;
  }
  if (same == KEPT) {
    if (s->gap < list->at[worst].gap) list->at[worst] = *s;
    return;
  }
  *SS_PUSH(list->at, list->n, list->cap) = *s;
}

/* A longer stretch is kept beside a shorter one in it only where it returns much more nearly, as after a period
   doubling. */
static void look_through(struct stretches *list, const struct mech_motion *x, const struct mech_word *wanted,
                         const struct mech *m) {
  for (int i = x->n_moments / 4 + 1; i < x->n_moments; i++) {
    double most = near;
    for (int k = 1; k <= MECH_PHASES && i + k < x->n_moments; k++) {
      struct stretch s;
      if (strcmp(x->moment[i].phase, x->moment[i + k].phase) != 0 || x->moment[i].mass != x->moment[i + k].mass)
        continue;
      if (!make_stretch(&s, x, i, k, wanted, m) || !(s.gap < most)) continue;
      keep(list, &s);
      most = s.gap / MUCH;
    }
  }
}

/* Enough of the slowest natural mode of what slips everywhere, whose frequency squared is the least eigenvalue of
   M^-1/2 K M^-1/2, and of the time for which a surface can drag a mass along. */
static double duration(const struct mech *m) {
  size_t n = (size_t)m->n;
  gsl_matrix *k = gsl_matrix_alloc(n, n);
  gsl_vector *squares = gsl_vector_alloc(n);
  gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(n);
  for (int i = 0; i < m->n; i++)
    for (int j = 0; j < m->n; j++) {
      double scale = sqrt(fmpq_get_d(m->mass[i].inertia) * fmpq_get_d(m->mass[j].inertia));
      gsl_matrix_set(k, (size_t)i, (size_t)j, fmpq_get_d(fmpq_mat_entry(m->stiffness, i, j)) / scale);
    }
  gsl_eigen_symm(k, squares, work);
  double least = sqrt(gsl_vector_min(squares)), drag = 0;
  for (int i = 0; i < m->n; i++)
    if (!fmpq_is_zero(m->mass[i].surface))
      drag = fmax(drag, fmpq_get_d(m->mass[i].limit) /
                            (fmpq_get_d(fmpq_mat_entry(m->stiffness, i, i)) * fabs(fmpq_get_d(m->mass[i].surface))));
  gsl_eigen_symm_free(work);
  gsl_vector_free(squares);
  gsl_matrix_free(k);
  return least > 0 ? fmin(longest, phase_angle / least + drags * drag) : longest;
}

/* --- Orbits --- */

void mech_first_start(double *z, const struct mech *m) {
  uint64_t stream = random_seed(seed);
  random_start(z, m, false, &stream);
}

/* Begun at its phase number by, is a the same as b, as far as their enclosures tell? */
static bool meets_turned(const struct mech_orbit *a, int by, const struct mech_orbit *b) {
  bool same = a->word.n == b->word.n && mech_word_goes_through(&b->word, &a->word, by);
  for (int k = 0; same && k < b->word.n; k++) {
    int l = (k + by) % b->word.n;
    same = arb_overlaps(a->t + l, b->t + k);
    for (int c = 0; c < b->states; c++)
      same = same && arb_overlaps(a->state + l * b->states + c, b->state + k * b->states + c);
  }
  return same;
}

bool mech_orbit_meets(const struct mech_orbit *a, const struct mech_orbit *b) {
  bool same = false;
  for (int by = 0; by < a->word.n; by++) same = same || meets_turned(a, by, b);
  return same;
}

/* After how many phases it is where it began: fewer than its word has where it is a shorter orbit, several times
   over. */
static int phases_of_a_round(const struct mech_orbit *o) {
  int by = 1;
  while (by < o->word.n && !meets_turned(o, by, o)) by++;
  return by;
}

bool mech_orbits_hold(const struct mech_orbits *list, const struct mech_orbit *o) {
  bool held = false;
  for (int i = 0; i < list->n; i++) held = held || mech_orbit_meets(&list->orbit[i], o);
  return held;
}

void mech_orbits_add(struct mech_orbits *list, const struct mech_orbit *o) {
  list->orbit = ss_realloc(list->orbit, (size_t)(list->n + 1) * sizeof *list->orbit);
  list->orbit[list->n++] = *o;
}

/* Those that return most nearly first. */
static int by_gap(const void *x, const void *y) {
  const struct stretch *a = x, *b = y;
  return (a->gap > b->gap) - (a->gap < b->gap);
}

static int by_period(const void *x, const void *y) {
  const struct mech_orbit *a = x, *b = y;
  return arf_cmp(arb_midref(a->period), arb_midref(b->period));
}

void mech_orbits_sort(struct mech_orbits *list) {
  if (list->n > 1) qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, by_period);
}

/* The orbit near a stretch; of one that goes round several times the first round. */
static int solve_near(struct mech_orbit *o, struct stretch *s, const struct mech *m, slong prec) {
  mech_word_best(&s->word, s->t, s->z, m);
  int status = mech_orbit_near(o, m, &s->word, s->t, s->z, prec);
  int phases = status ? s->word.n : phases_of_a_round(o);
  if (phases == s->word.n) return status;
  mech_orbit_clear(o);
  s->word.n = phases;
  return mech_orbit_near(o, m, &s->word, s->t, s->z, prec);
}

static void say(const struct mech_tell *tell, int done) {
  if (tell && tell->to) tell->to(tell->before + (size_t)done, tell->of);
}

/* Newton's iteration from what was found; any: up to the first motion, and whether there is one. */
static bool solve(struct mech_orbits *list, struct stretches *found, const struct mech_word *wanted,
                  const struct mech *m, bool any, slong prec, const struct mech_tell *tell) {
  bool done = false;
  if (found->n > 1) qsort(found->at, (size_t)found->n, sizeof *found->at, by_gap);
  for (int i = 0; i < found->n && i < MECH_CANDIDATES && !done; i++) {
    struct mech_orbit o;
    if (!any) say(tell, MECH_SIMULATIONS + i);
    list->candidates++;
    if (solve_near(&o, &found->at[i], m, prec) != SS_OK) {
      list->failed++;
      continue;
    }
    if ((wanted && o.word.n != wanted->n) || mech_orbits_hold(list, &o)) {
      mech_orbit_clear(&o);
      continue;
    }
    mech_orbit_decide(&o, m, prec);
    mech_orbits_add(list, &o);
    done = any && mech_orbit_is_motion(&o);
  }
  return done;
}

void mech_orbits_find(struct mech_orbits *list, const struct mech *m, const struct mech_word *w, bool any, slong prec,
                      const struct mech_tell *tell) {
  struct stretches found = {.n = 0};
  uint64_t stream = random_seed(seed);
  struct mech_plan plan = {.duration = duration(m), .most = MOMENTS};
  *list = (struct mech_orbits){.n = 0};
  bool done = false;
  while (list->simulations < MECH_SIMULATIONS && !done) {
    OWNED(mech_motion) x;
    double z[MECH_STATES];
    say(tell, list->simulations);
    random_start(z, m, list->simulations >= WIDE, &stream);
    int status = mech_simulate(&x, MECH_PATCHED, m, z, &plan);
    if (status != SS_DOMAIN) look_through(&found, &x, w, m);
    list->unfinished += status != SS_OK;
    if (++list->simulations == MECH_SIMULATIONS || any) done = solve(list, &found, w, m, any, prec, tell);
    if (any) found.n = 0;
  }
  mech_orbits_sort(list);
  free(found.at);
}

void mech_orbits_clear(struct mech_orbits *list) {
  for (int i = 0; i < list->n; i++) mech_orbit_clear(&list->orbit[i]);
  free(list->orbit);
}

int mech_orbits_certified(const struct mech_orbits *list) {
  int n = 0;
  for (int i = 0; i < list->n; i++) n += list->orbit[i].certified;
  return n;
}

/* --- Where motions settle --- */

static void count(struct mech_settling *s, const struct mech_word *w) {
  int i = 0;
  while (i < s->n && !mech_word_same(&s->on[i].word, w)) i++;
  if (i == s->n) {
    s->on = ss_realloc(s->on, (size_t)(s->n + 1) * sizeof *s->on);
    s->on[s->n++] = (struct mech_settled){*w, 0};
  }
  s->on[i].motions++;
  s->settled++;
}

/* From z, in rounds of that length.  A word that repeats a shorter one may still become it, and is taken only after the
   last round. */
static void follow(struct mech_settling *s, double *z, const struct mech *m, double length) {
  char phase[MECH_PHASE + 1];
  bool eventless = false;
  for (int round = 1; round <= ROUNDS; round++) {
    struct mech_plan plan = {.duration = length, .most = MOMENTS, .phase = round > 1 ? phase : NULL};
    OWNED(mech_motion) x;
    struct mech_word w;
    double period, gap;
    int status = mech_simulate(&x, MECH_PATCHED, m, z, &plan);
    bool settles = status != SS_DOMAIN && mech_settles(&w, &period, &gap, &x, m->n, m->states);
    if (!status) {
      memcpy(phase, x.moment[x.n_moments - 1].phase, sizeof phase);
      memcpy(z, x.z, (size_t)m->states * sizeof *z);
    }
    eventless = x.n_moments == 1;
    if (settles && (round == ROUNDS || !repeats(&w))) {
      count(s, &w);
      return;
    }
    s->unfinished += status != SS_OK;
    if (status) return;
  }
  s->eventless += eventless;
}

void mech_settle(struct mech_settling *s, const struct mech *m, const struct mech_tell *tell) {
  uint64_t stream = random_seed(seed);
  double length = duration(m);
  *s = (struct mech_settling){.n = 0};
  while (s->starts < MECH_SIMULATIONS) {
    double z[MECH_STATES];
    say(tell, s->starts);
    random_start(z, m, s->starts >= WIDE, &stream);
    s->starts++;
    follow(s, z, m, length);
  }
}

void mech_settling_clear(struct mech_settling *s) {
  free(s->on);
}
