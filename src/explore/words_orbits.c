/* The orbits of a word: what the search finds, enclosed and judged by the engine for any system. */
#include <stdlib.h>
#include <string.h>

#include "mech/two_masses.h"
#include "words_impl.h"

enum { GUARD = 40, RAISES = 4, MOST_TIMES = 8 };

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

/* u_ri is larger than e_i where it is given. */
static bool lacks_friction(const struct mech *m, int mass) {
  return fmpq_is_zero(m->mass[mass].sliding);
}

/* --- An orbit --- */

/* Near what the search has found; not judged.  Positions are those at which the springs pull with the forces w_i and
   the sliding friction. */
static int near_found(struct mech_orbit *o, const struct word_found *found, const struct word_orbits *list,
                      slong prec) {
  const struct mech *m = &list->m;
  double f[2], z[N_STATE];
  for (int i = 0; i < 2; i++) {
    f[i] = found->state[WORD_W1 + i] + fmpq_get_d(m->mass[i].sliding);
    z[2 + i] = found->state[WORD_P1 + i] + fmpq_get_d(m->mass[i].surface);
  }
  z[0] = (f[0] + f[1]) / fmpq_get_d(m->spring[0].size);
  z[1] = z[0] + f[1] / fmpq_get_d(m->spring[1].size);
  return mech_orbit_near(o, m, &list->word, found->t, z, prec);
}

/* What is said of an orbit of a word, see words.h. */
static void conclude(struct mech_orbit *o, const struct mech *m) {
  int n = 0;
  bool settled = true;
  o->own = o->admissible = TRUTH_TRUE;
  o->stable = o->multipliers ? mech_all_inside(o->multiplier, o->n_free) : TRUTH_UNKNOWN;
  for (int i = 0; i < o->n_facts; i++) {
    struct mech_fact f = o->fact[i];
    bool length = f.rule == MECH_LENGTH, d = strcmp(o->word.phase[f.phase], "ss") == 0;
    if (!length && o->fact[f.phase].holds != TRUTH_TRUE) continue; /* the lengths come first */
    if (f.rule == MECH_ABOVE && lacks_friction(m, f.mass)) continue;
    o->fact[n++] = f;
    o->admissible = truth_and(o->admissible, f.holds);
    if (length && !d) o->own = truth_and(o->own, f.holds);
    if (f.ends) o->own = truth_and(o->own, truth_or(f.holds, f.reversed));
    settled = settled && f.holds != TRUTH_UNKNOWN;
  }
  o->n_facts = n;
  o->certified = settled && o->own != TRUTH_UNKNOWN && o->stable != TRUTH_UNKNOWN;
}

/* The fewest relative bits of any length, state and of the trace of J. */
static slong accuracy(const struct mech_orbit *o, slong prec) {
  slong least = ARF_PREC_EXACT;
  NUMBERS(arb, trace);
  arb_mat_trace(trace, o->jacobian, prec);
  for (int p = 0; p < o->word.n; p++) least = FLINT_MIN(least, arb_rel_accuracy_bits(o->t + p));
  for (int i = 0; i < o->states * o->word.n; i++) least = FLINT_MIN(least, arb_rel_accuracy_bits(o->state + i));
  least = FLINT_MIN(least, arb_rel_accuracy_bits(trace));
  return FLINT_MAX(least, 0);
}

/* Encloses near; the precision is raised as long as it is not enough. */
static int enclose(struct mech_orbit *o, const struct word_found *near, const struct word_orbits *list, slong prec) {
  slong work = prec + GUARD;
  int status = SS_UNABLE;
  for (int i = 0; i < RAISES; i++) {
    if (!status) mech_orbit_clear(o);
    status = near_found(o, near, list, work);
    if (!status) {
      mech_orbit_judge(o, &list->m, work);
      conclude(o, &list->m);
    }
    slong lacks = status ? work : prec - accuracy(o, work);
    if (!status && lacks <= 0 && o->certified) break;
    work += FLINT_MAX(lacks, 0) + GUARD;
  }
  return status;
}

static bool in_domain(const struct mech_word *w, const fmpq *params, const fmpq *const u_r[2]) {
  if (!dyn_in_domain(params, N_PARAMS)) return false;
  for (int i = 0; i < 2; i++)
    if (u_r[i] && fmpq_cmp(u_r[i], params + P_E1 + i) <= 0) return false;
  return !phase_word_has_faster(w) || (u_r[0] && u_r[1]);
}

int word_orbits_find(struct word_orbits *list, const struct mech_word *w, const fmpq *params, const fmpq *const u_r[2],
                     const struct word_seeds *seeds, slong prec) {
  struct word_finds finds;
  *list = (struct word_orbits){.word = *w};
  if (phase_word_fate(NULL, w) != WORD_OPEN || !in_domain(w, params, u_r)) return SS_DOMAIN;
  make_system(&list->m, params, u_r);
  mech_word_turn(&list->word, w, mech_best_turn(&list->m, w));
  word_search(&finds, list, params, u_r, seeds);
  list->evaluations = finds.evaluations;
  list->found.candidates = (int)finds.candidates;
  for (size_t i = 0; i < finds.n; i++) {
    struct mech_orbit o;
    int status = enclose(&o, &finds.found[i], list, prec);
    if (status)
      list->found.failed++;
    else if (o.own == TRUTH_FALSE)
      mech_orbit_clear(&o);
    else
      mech_orbits_add(&list->found, &o);
  }
  free(finds.found);
  mech_orbits_sort(&list->found);
  return SS_OK;
}

void word_orbits_clear(struct word_orbits *list) {
  mech_orbits_clear(&list->found);
  mech_clear(&list->m);
}

/* --- Static friction --- */

/* A mass that is captured at f needs u_s >= -(e + w)/2, which makes |f| <= u_r: u_r is at least (e - w)/2 = (r -
   f)/2. */
bool word_orbit_friction(arb_t least, const struct mech_orbit *o, const struct mech *m, int mass, slong prec) {
  bool faster = false;
  NUMBERS(arb, lack, stiffness);
  arb_zero(least);
  for (int p = 0; p < o->word.n; p++) {
    const char *before = o->word.phase[(p + o->word.n - 1) % o->word.n], *now = o->word.phase[p];
    faster = faster || strchr(now, '+');
    if (before[mass] == 's' || now[mass] != 's') continue;
    arb_set_fmpq(lack, m->mass[mass].limit, prec);
    for (int i = 0; i < o->n; i++) {
      arb_set_fmpq(stiffness, fmpq_mat_entry(m->stiffness, mass, i), prec);
      arb_submul(lack, stiffness, o->state + p * o->states + i, prec);
    }
    arb_mul_2exp_si(lack, lack, -1);
    arb_max(least, least, lack, prec);
  }
  return !faster;
}

/* How far the friction of a mass, static and sliding alike, is from enough. */
static void find_raise(fmpq_t raise, const struct word_orbits *list, int mass, slong prec) {
  const fmpq *limit = list->m.mass[mass].limit;
  NUMBERS(fmpq, need);
  NUMBERS(arb, least);
  NUMBERS(arf, bound);
  fmpq_set(raise, limit);
  for (int k = 0; k < list->found.n; k++) {
    word_orbit_friction(least, &list->found.orbit[k], &list->m, mass, prec);
    arf_set_round(bound, arb_midref(least), 53, ARF_RND_UP);
    arf_get_fmpq(need, bound);
    if (fmpq_cmp(need, raise) > 0) fmpq_set(raise, need);
  }
  fmpq_set_si(need, 5, 4);
  fmpq_mul(raise, raise, need);
  fmpq_sub(raise, raise, limit);
}

/* The orbit beside its enclosure, whose positions have moved with the friction; precise enough for prec bits of it. */
static int enclose_again(struct mech_orbit *o, const struct mech_orbit *old, const struct mech *m, slong prec) {
  int status = SS_UNABLE;
  for (int times = 1; times <= MOST_TIMES; times *= 2) {
    if (!status) mech_orbit_clear(o);
    status = mech_orbit_beside(o, m, old, times * prec);
    if (!status && accuracy(o, times * prec) >= prec - GUARD) break;
  }
  return status;
}

void word_orbits_with_friction(struct word_orbits *list, slong prec) {
  struct mech_orbits old = list->found;
  if (!old.n || (!lacks_friction(&list->m, 0) && !lacks_friction(&list->m, 1))) return;
  NUMBERS(arb, by);
  SIZED(fmpq_mat, raise, 2, 1);
  SIZED(fmpq_mat, move, 2, 1);
  for (int i = 0; i < 2; i++)
    if (lacks_friction(&list->m, i)) find_raise(fmpq_mat_entry(raise, i, 0), list, i, prec);
  for (int i = 0; i < 2; i++) {
    struct mech_mass *mass = &list->m.mass[i];
    fmpq_add(mass->sliding, mass->sliding, fmpq_mat_entry(raise, i, 0));
    fmpq_add(mass->limit, mass->limit, fmpq_mat_entry(raise, i, 0));
  }
  fmpq_mat_solve(move, list->m.stiffness, raise);
  list->found = (struct mech_orbits){.n = 0};
  for (int k = 0; k < old.n; k++) {
    struct mech_orbit again = {.n = 0};
    for (int i = 0; i < 2; i++) {
      arb_set_fmpq(by, fmpq_mat_entry(move, i, 0), prec);
      arb_add(old.orbit[k].state + i, old.orbit[k].state + i, by, prec);
    }
    if (enclose_again(&again, &old.orbit[k], &list->m, prec) != SS_OK) continue;
    again.admissible = old.orbit[k].admissible;
    mech_orbits_add(&list->found, &again);
  }
  mech_orbits_clear(&old);
}
