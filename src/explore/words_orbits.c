/* The orbits of a word: what the search finds, enclosed and judged by the engine for any system, in the coordinates of
   words.h, and sorted. */
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "mech/two_masses.h"
#include "words_impl.h"

enum { GUARD = 40, RAISES = 4, MOST_TIMES = 8 };

static void orbit_init(struct word_orbit *o, const struct phase_word *w) {
  *o = (struct word_orbit){.word = *w};
  o->n_free = word_free(o->free, w);
  o->t = _arb_vec_init(w->n);
  o->state = _arb_vec_init(N_STATE * w->n);
  arb_mat_init(o->jacobian, o->n_free, o->n_free);
  arb_ptr all[] = {o->period, o->trace, o->det, o->u_r_min[0], o->u_r_min[1]};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_init(all[i]);
}

static void orbit_clear(struct word_orbit *o) {
  arb_ptr all[] = {o->period, o->trace, o->det, o->u_r_min[0], o->u_r_min[1]};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  arb_mat_clear(o->jacobian);
  _arb_vec_clear(o->state, N_STATE * o->word.n);
  _arb_vec_clear(o->t, o->word.n);
}

/* --- The two masses as a system --- */

/* With the friction that is given; of a word without a faster phase the orbits are the same for every sliding friction,
   and it is left out where it is not given. */
static void make_system(struct mech *m, const fmpq *params, const fmpq *const u_r[2]) {
  fmpq sliding[2];
  for (int i = 0; i < 2; i++) {
    fmpq_init(sliding + i);
    if (u_r[i]) fmpq_sub(sliding + i, u_r[i], params + P_E1 + i);
  }
  two_masses(m, params, (const fmpq *const[]){sliding, sliding + 1});
  for (int i = 0; i < 2; i++) fmpq_clear(sliding + i);
}

static struct mech_word letters(const struct phase_word *w) {
  static const char letter[N_MODES] = {[MODE_STICK] = 's', [MODE_BELOW] = '-', [MODE_ABOVE] = '+'};
  struct mech_word out = {.n = w->n};
  for (int p = 0; p < w->n; p++)
    for (int i = 0; i < 2; i++) out.phase[p][i] = letter[w->mode[p][i]];
  return out;
}

/* x and x' of the state w, p: K x is the force, w and the sliding friction. */
static void positions(double x[N_STATE], const double s[N_STATE], const struct mech *m, const fmpq *params) {
  double chi = fmpq_get_d(params + P_CHI), f[2];
  for (int i = 0; i < 2; i++) f[i] = s[WORD_W1 + i] + fmpq_get_d(m->mass[i].sliding);
  x[0] = (f[0] + f[1]) / (1 - chi);
  x[1] = x[0] + f[1] / chi;
  for (int i = 0; i < 2; i++) x[2 + i] = fmpq_get_d(params + P_V) + s[WORD_P1 + i];
}

/* w_i = (K x)_i - u_si and p_i = x_i' - V. */
static void coordinates(arb_ptr state, arb_srcptr x, const struct mech *m, slong prec) {
  arb_t part;
  arb_init(part);
  for (int i = 0; i < 2; i++) {
    arb_ptr w = state + WORD_W1 + i;
    arb_set_fmpq(w, m->mass[i].sliding, prec);
    arb_neg(w, w);
    for (int k = 0; k < 2; k++) {
      arb_set_fmpq(part, fmpq_mat_entry(m->stiffness, i, k), prec);
      arb_addmul(w, part, x + k, prec);
    }
    arb_set_fmpq(part, m->mass[i].surface, prec);
    arb_sub(state + WORD_P1 + i, x + 2 + i, part, prec);
  }
  arb_clear(part);
}

/* What the modes and the event before say of a state at the entry of a phase is exact. */
static void make_exact(arb_ptr state, const struct phase_word *w, int phase, const struct mech *m, slong prec) {
  struct word_event before = word_event_of(w, (phase + w->n - 1) % w->n);
  arb_zero(state + WORD_P1 + before.mass);
  for (int i = 0; i < 2; i++)
    if (w->mode[phase][i] == MODE_STICK) arb_zero(state + WORD_P1 + i);
  if (before.from != MODE_STICK) return;
  fmpq_t force; /* r or -r, less s */
  fmpq_init(force);
  fmpq_set(force, m->mass[before.mass].limit);
  if (before.to == MODE_ABOVE) fmpq_neg(force, force);
  fmpq_sub(force, force, m->mass[before.mass].sliding);
  arb_set_fmpq(state + WORD_W1 + before.mass, force, prec);
  fmpq_clear(force);
}

/* dw/dx of the free coordinates, p going as x': K, or of the mass beside one that has just broken loose, whose force
   does not change, det K over the other's stiffness. */
static void change_of_coordinates(fmpq_mat_t t, const struct word_orbit *o, const struct mech *m) {
  struct word_event before = word_event_of(&o->word, o->word.n - 1);
  fmpq_mat_one(t);
  if (before.from != MODE_STICK) {
    for (int i = 0; i < 4; i++) fmpq_set(fmpq_mat_entry(t, i / 2, i % 2), fmpq_mat_entry(m->stiffness, i / 2, i % 2));
    return;
  }
  fmpq_t det;
  fmpq_init(det);
  fmpq_mat_det(det, m->stiffness);
  fmpq_div(fmpq_mat_entry(t, 0, 0), det, fmpq_mat_entry(m->stiffness, before.mass, before.mass));
  fmpq_clear(det);
}

/* J in x and x' becomes that in w and p. */
static void transform(arb_mat_t j, const struct word_orbit *o, const struct mech *m, slong prec) {
  fmpq_mat_t t;
  arb_mat_t by, back;
  fmpq_mat_init(t, o->n_free, o->n_free);
  arb_mat_init(by, o->n_free, o->n_free);
  arb_mat_init(back, o->n_free, o->n_free);
  change_of_coordinates(t, o, m);
  arb_mat_set_fmpq_mat(by, t, prec);
  fmpq_mat_inv(t, t);
  arb_mat_set_fmpq_mat(back, t, prec);
  arb_mat_mul(j, by, j, prec);
  arb_mat_mul(j, j, back, prec);
  arb_mat_clear(back);
  arb_mat_clear(by);
  fmpq_mat_clear(t);
}

/* --- An orbit --- */

/* Near the unknowns of words_impl.h, in double precision; not judged. */
static int near_unknowns(struct mech_orbit *e, const double *x, const struct word_orbit *o, const struct mech *m,
                         const fmpq *params, slong prec) {
  struct mech_word w = letters(&o->word);
  double s[N_STATE] = {0}, z[N_STATE];
  struct word_event before = word_event_of(&o->word, o->word.n - 1);
  if (before.from == MODE_STICK) {
    double limit = fmpq_get_d(m->mass[before.mass].limit);
    s[WORD_W1 + before.mass] = (before.to == MODE_BELOW ? limit : -limit) - fmpq_get_d(m->mass[before.mass].sliding);
  }
  for (int l = 0; l < o->n_free; l++) s[o->free[l]] = x[o->word.n + l];
  positions(z, s, m, params);
  return mech_orbit_near(e, m, &w, x, z, prec);
}

/* u_r is at least (e - w)/2 where the mass is captured: u_s >= -(e + w)/2 makes |f| <= u_r. */
static void find_friction(struct word_orbit *o, const fmpq *params, slong prec) {
  arb_t least;
  arb_init(least);
  for (int mass = 0; mass < 2; mass++) {
    arb_zero(o->u_r_min[mass]);
    for (int p = 0; p < o->word.n; p++) {
      struct word_event before = word_event_of(&o->word, (p + o->word.n - 1) % o->word.n);
      if (before.mass != mass || before.to != MODE_STICK) continue;
      arb_set_fmpq(least, params + P_E1 + mass, prec);
      arb_sub(least, least, o->state + N_STATE * p + WORD_W1 + mass, prec);
      arb_mul_2exp_si(least, least, -1);
      arb_max(o->u_r_min[mass], o->u_r_min[mass], least, prec);
    }
  }
  arb_clear(least);
}

/* The facts that count: of phases that have a length, and of a sticking mass's lower limit only where u_r is given. */
static void take_conditions(struct word_orbit *o, const struct mech_orbit *e, const fmpq *const u_r[2]) {
  o->n_conditions = 0;
  o->own = o->admissible = TRUTH_TRUE;
  for (int i = 0; i < e->n_facts; i++) {
    const struct mech_fact *f = &e->fact[i];
    const enum coulomb_mode *mode = o->word.mode[f->phase];
    bool length = f->rule == MECH_LENGTH, d = mode[0] == MODE_STICK && mode[1] == MODE_STICK;
    if (!length && e->fact[f->phase].holds != TRUTH_TRUE) continue; /* the lengths come first */
    if (f->rule == MECH_ABOVE && !u_r[f->mass]) continue;
    o->condition[o->n_conditions++] = *f;
    o->admissible = truth_and(o->admissible, f->holds);
    if (length && !d) o->own = truth_and(o->own, f->holds);
    if (f->ends) o->own = truth_and(o->own, truth_or(f->holds, f->reversed));
  }
}

static void describe(struct word_orbit *o, const struct mech_orbit *e, const struct mech *m, const fmpq *params,
                     const fmpq *const u_r[2], slong prec) {
  _arb_vec_set(o->t, e->t, o->word.n);
  arb_set(o->period, e->period);
  for (int p = 0; p < o->word.n; p++) {
    coordinates(o->state + N_STATE * p, e->state + N_STATE * p, m, prec);
    make_exact(o->state + N_STATE * p, &o->word, p, m, prec);
  }
  arb_mat_set(o->jacobian, e->jacobian);
  transform(o->jacobian, o, m, prec);
  arb_mat_trace(o->trace, e->jacobian, prec);
  arb_mat_det(o->det, e->jacobian, prec);
  o->stable = e->multipliers ? mech_all_inside(e->multiplier, e->n_free) : TRUTH_UNKNOWN;
  take_conditions(o, e, u_r);
  find_friction(o, params, prec);
}

static bool undecided(const struct word_orbit *o) {
  bool any = o->stable == TRUTH_UNKNOWN || o->own == TRUTH_UNKNOWN;
  for (int i = 0; i < o->n_conditions; i++) any = any || o->condition[i].holds == TRUTH_UNKNOWN;
  return any;
}

/* The fewest relative bits of any number that is not zero; what is tiny beside its kind counts as zero. */
static slong accuracy(const struct word_orbit *o) {
  slong least = ARF_PREC_EXACT;
  for (int p = 0; p < o->word.n; p++) least = FLINT_MIN(least, arb_rel_accuracy_bits(o->t + p));
  for (int i = 0; i < N_STATE * o->word.n; i++)
    if (!arb_is_zero(o->state + i)) least = FLINT_MIN(least, arb_rel_accuracy_bits(o->state + i));
  return FLINT_MAX(FLINT_MIN(least, arb_rel_accuracy_bits(o->trace)), 0);
}

/* Encloses near; the precision is raised as long as it is not enough. */
static int enclose(struct word_orbit *o, const double *near, const struct mech *m, const fmpq *params,
                   const fmpq *const u_r[2], slong prec) {
  slong work = prec + GUARD;
  int status = SS_UNABLE;
  for (int i = 0; i < RAISES; i++) {
    struct mech_orbit e;
    status = near_unknowns(&e, near, o, m, params, work);
    if (!status) {
      mech_orbit_judge(&e, m, work);
      describe(o, &e, m, params, u_r, work);
      mech_orbit_clear(&e);
    }
    slong lacks = status ? work : prec - accuracy(o);
    if (!status && lacks <= 0 && !undecided(o)) break;
    work += FLINT_MAX(lacks, 0) + GUARD;
  }
  o->certified = !status && !undecided(o);
  return status;
}

static int by_period(const void *x, const void *y) {
  const struct word_orbit *a = x, *b = y;
  return arf_cmp(arb_midref(a->period), arb_midref(b->period));
}

static bool in_domain(const struct phase_word *w, const fmpq *params, const fmpq *const u_r[2]) {
  if (!dyn_in_domain(params, N_PARAMS)) return false;
  for (int i = 0; i < 2; i++)
    if (u_r[i] && fmpq_cmp(u_r[i], params + P_E1 + i) <= 0) return false;
  return !phase_word_has_faster(w) || (u_r[0] && u_r[1]);
}

int word_orbits_find(struct word_orbits *list, const struct phase_word *w, const fmpq *params, const fmpq *const u_r[2],
                     const struct word_seeds *seeds, slong prec) {
  struct word_finds finds;
  struct phase_word best = *w;
  struct mech m;
  *list = (struct word_orbits){.n = 0};
  if (phase_word_fate(NULL, w) != WORD_OPEN || !in_domain(w, params, u_r)) return SS_DOMAIN;
  word_turn_best(&best);
  word_search(&finds, &best, params, u_r, seeds);
  list->evaluations = finds.evaluations;
  list->candidates = finds.candidates;
  list->orbit = ss_malloc((finds.n + 1) * sizeof *list->orbit);
  make_system(&m, params, u_r);
  for (size_t i = 0; i < finds.n; i++) {
    struct word_orbit *o = &list->orbit[list->n];
    orbit_init(o, &best);
    int status = enclose(o, finds.found[i].x, &m, params, u_r, prec);
    if (status) list->failed++;
    if (status || o->own == TRUTH_FALSE)
      orbit_clear(o);
    else
      list->n++;
  }
  mech_clear(&m);
  free(finds.found);
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, by_period);
  return SS_OK;
}

void word_orbits_clear(struct word_orbits *list) {
  for (slong i = 0; i < list->n; i++) orbit_clear(&list->orbit[i]);
  free(list->orbit);
  *list = (struct word_orbits){.n = 0};
}

/* --- With static friction --- */

/* The system in which the orbits move: with the static friction that is given, or a quarter more than the larger of e_i
   and what they need. */
static void make_with_enough(struct mech *m, const struct word_orbit *o, slong n, const fmpq *params,
                             const fmpq *const given[2]) {
  fmpq *u_r = _fmpq_vec_init(2);
  fmpq_t least, enough;
  arf_t bound;
  fmpq_init(least);
  fmpq_init(enough);
  arf_init(bound);
  fmpq_set_si(enough, 5, 4);
  for (int i = 0; i < 2; i++) {
    fmpq_set(u_r + i, params + P_E1 + i);
    for (slong k = 0; k < n; k++) {
      arf_set_round(bound, arb_midref(o[k].u_r_min[i]), 53, ARF_RND_UP);
      arf_get_fmpq(least, bound);
      if (fmpq_cmp(least, u_r + i) > 0) fmpq_set(u_r + i, least);
    }
    fmpq_mul(u_r + i, u_r + i, enough);
    if (given[i]) fmpq_set(u_r + i, given[i]);
  }
  make_system(m, params, (const fmpq *const[]){u_r, u_r + 1});
  arf_clear(bound);
  fmpq_clear(enough);
  fmpq_clear(least);
  _fmpq_vec_clear(u_r, 2);
}

/* The orbit again, in that system, with up to eight times as many bits where it needs them; not judged. */
static int found_again(struct mech_orbit *e, const struct word_orbit *o, const struct mech *m, const fmpq *params,
                       slong prec) {
  double x[WORD_UNKNOWNS];
  for (int p = 0; p < o->word.n; p++) x[p] = num_arb.get_d(o->t + p);
  for (int l = 0; l < o->n_free; l++) x[o->word.n + l] = num_arb.get_d(o->state + o->free[l]);
  int status = SS_UNABLE;
  for (int times = 1; status && times <= MOST_TIMES; times *= 2)
    status = near_unknowns(e, x, o, m, params, times * prec);
  return status;
}

int word_jacobian(arb_mat_t j, const struct word_orbit *o, const fmpq *params, const fmpq *const u_r[2],
                  enum mech_derivative how, slong prec) {
  struct mech m;
  struct mech_orbit e;
  make_with_enough(&m, o, 1, params, u_r);
  int status = found_again(&e, o, &m, params, prec);
  if (!status) {
    status = mech_jacobian(j, &m, &e, how, prec);
    mech_orbit_clear(&e);
  }
  if (!status) transform(j, o, &m, prec);
  mech_clear(&m);
  return status;
}

void word_orbits_as_system(struct mech *m, struct mech_orbits *out, const struct word_orbits *list, const fmpq *params,
                           const fmpq *const u_r[2], slong prec) {
  *out = (struct mech_orbits){.n = 0};
  make_with_enough(m, list->orbit, list->n, params, u_r);
  for (slong i = 0; i < list->n; i++) {
    struct mech_orbit e;
    if (found_again(&e, &list->orbit[i], m, params, prec) != SS_OK) continue;
    mech_orbit_decide(&e, m, prec);
    mech_orbits_add(out, &e);
  }
}
