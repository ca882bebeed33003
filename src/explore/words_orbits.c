/* The orbits of a word: what the search finds, enclosed, judged, and sorted. */
#include <stdlib.h>

#include "base/arena.h"
#include "words_impl.h"

enum { GUARD = 40, RAISES = 4 };

static void orbit_init(struct word_orbit *o, const struct phase_word *w) {
  *o = (struct word_orbit){.word = *w};
  o->n_free = word_free(o->free, w);
  o->t = _arb_vec_init(w->n);
  o->state = _arb_vec_init(N_STATE * w->n);
  o->jacobian = _arb_vec_init(o->n_free * o->n_free);
  arb_ptr all[] = {o->period, o->trace, o->det, o->u_r_min[0], o->u_r_min[1]};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_init(all[i]);
}

static void orbit_clear(struct word_orbit *o) {
  arb_ptr all[] = {o->period, o->trace, o->det, o->u_r_min[0], o->u_r_min[1]};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  _arb_vec_clear(o->jacobian, o->n_free * o->n_free);
  _arb_vec_clear(o->state, N_STATE * o->word.n);
  _arb_vec_clear(o->t, o->word.n);
}

/* Everything that follows from the unknowns. */
static int describe(struct word_orbit *o, const struct num_vec *x, const fmpq *params, const fmpq *const u_r[2]) {
  struct word_law m;
  int n = o->word.n;
  val at[WORD_UNKNOWNS], f[WORD_UNKNOWNS], states[N_STATE * WORD_MOST];
  struct calc c = calc_begin(x->ctx);
  word_law_make(&m, &c, params, u_r);
  flow_vals(at, x, 0, n + o->n_free);
  word_equations(f, NULL, states, &c, &m, &o->word, at);
  int status = c.status;
  arb_zero(o->period);
  for (int p = 0; p < n; p++) {
    struct word_event before = word_event_of(&o->word, (p + n - 1) % n);
    arb_set(o->t + p, at[p]);
    arb_add(o->period, o->period, at[p], x->ctx.prec);
    for (int i = 0; i < N_STATE; i++) arb_set(o->state + N_STATE * p + i, states[N_STATE * p + i]);
    /* what the event says of the state is exact */
    arb_zero(o->state + N_STATE * p + WORD_P1 + before.mass);
    if (before.from != MODE_STICK) continue;
    arb_ptr w = o->state + N_STATE * p + WORD_W1 + before.mass;
    arb_set(w, m.e[before.mass]);
    if (before.to == MODE_ABOVE) {
      arb_add(w, w, m.over[before.mass], x->ctx.prec);
      arb_neg(w, w);
    }
  }
  if (!status) {
    word_judge(o, &c, &m);
    status = word_jacobian(o, &c, &m);
  }
  calc_clear(&c);
  return status;
}

static bool undecided(const struct word_orbit *o) {
  bool any = o->stable == TRUTH_UNKNOWN;
  for (int i = 0; i < o->n_conditions; i++)
    any = any || o->condition[i].holds == TRUTH_UNKNOWN || o->condition[i].first == TRUTH_UNKNOWN;
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
static int enclose(struct word_orbit *o, const double *near, const fmpq *params, const fmpq *const u_r[2], slong prec) {
  slong work = prec + GUARD;
  int status = SS_UNABLE;
  for (int i = 0; i < RAISES; i++) {
    struct num_vec x;
    num_vec_init(&x, o->word.n + o->n_free, num_ctx_arb(work));
    status = word_unknowns_enclose(&x, near, &o->word, params, u_r);
    if (!status) status = describe(o, &x, params, u_r);
    num_vec_clear(&x);
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
  *list = (struct word_orbits){.n = 0};
  if (phase_word_fate(NULL, w) != WORD_OPEN || !in_domain(w, params, u_r)) return SS_DOMAIN;
  word_turn_best(&best);
  word_search(&finds, &best, params, u_r, seeds);
  list->evaluations = finds.evaluations;
  list->candidates = finds.candidates;
  list->orbit = ss_malloc((finds.n + 1) * sizeof *list->orbit);
  for (size_t i = 0; i < finds.n; i++) {
    struct word_orbit *o = &list->orbit[list->n];
    orbit_init(o, &best);
    int status = enclose(o, finds.found[i].x, params, u_r, prec);
    if (status) list->failed++;
    if (status || o->own == TRUTH_FALSE)
      orbit_clear(o);
    else
      list->n++;
  }
  free(finds.found);
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, by_period);
  return SS_OK;
}

void word_orbits_clear(struct word_orbits *list) {
  for (slong i = 0; i < list->n; i++) orbit_clear(&list->orbit[i]);
  free(list->orbit);
  *list = (struct word_orbits){.n = 0};
}
