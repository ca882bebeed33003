/* Whether a list of orbits is complete.

   march.c encloses every common zero of the two equations.  Each zero must be an orbit of the list, or is settled here,
   and each orbit of the list must be met among the zeros.  complete.h says what is proved and how. */
#include "complete.h"

#include <stdlib.h>

#include "base/arena.h"
#include "march.h"
#include "num/pi.h"
#include "orbit_judge.h"
#include "warm.h"

#define TEXT(name, text) text,
const char *const dyn_gap_text[N_GAPS] = {DYN_GAPS(TEXT)};
#undef TEXT

static double full_turns(const struct dyn_orbit *o) {
  return floor(o->guess[1] / (2 * PI));
}

void dyn_leave_gap(struct dyn_orbits *list, enum dyn_gap why, double tb, double tc) {
  if (list->gap != GAP_UNTRIED) return;
  list->gap = (int)why;
  list->gap_at[0] = tb;
  list->gap_at[1] = tc;
}

/* A zero that is no orbit of the list. */
static void settle(struct dyn_orbits *list, const struct common *z, const struct disk_params *g, const fmpq *params,
                   slong prec) {
  struct dyn_orbit o;
  truth first;
  struct dyn_place at = common_place(z, g);
  int status = dyn_orbit_near(&o, &first, params, at, prec, NULL);
  struct known found = known_of(&o, z->k);
  bool settled = status == SS_OK && known_is(&found, z), before = settled && arb_is_negative(o.t[1]); /* t_b < 0 */
  if (settled && (before || first != TRUTH_UNKNOWN)) {
    if (first == TRUTH_TRUE && !before) {
      list->orbit = ss_realloc(list->orbit, (size_t)(list->n + 1) * sizeof *list->orbit);
      list->orbit[list->n++] = o;
      return;
    }
  } else {
    dyn_leave_gap(list, settled ? GAP_GRAZING : GAP_DOUBLE, at.tb, at.tc);
  }
  dyn_orbit_clear(&o);
}

/* Every zero is an orbit of the list, and every orbit of the list a zero; known tells which were met as such. */
static void compare(struct dyn_orbits *list, const struct march *s, const struct known *known, const fmpq *params,
                    slong prec) {
  slong listed = list->n;
  FREED bool *seen = ss_malloc((size_t)listed + 1);
  for (slong i = 0; i < listed; i++) seen[i] = known[i].met;
  for (size_t k = 0; k < s->zeros.n; k++) {
    bool taken = false;
    for (slong i = 0; i < listed && !taken; i++)
      if (known_is(&known[i], &s->zeros.at[k])) taken = seen[i] = true;
    for (slong i = listed; i < list->n && !taken; i++) { /* added for the same zero, proved in two cells */
      struct known z = known_of(&list->orbit[i], full_turns(&list->orbit[i]));
      taken = known_is(&z, &s->zeros.at[k]);
    }
    if (!taken) settle(list, &s->zeros.at[k], &s->params, params, prec);
  }
  for (slong i = 0; i < listed; i++) {
    const struct dyn_orbit *o = &list->orbit[i];
    if (o->grazing) dyn_leave_gap(list, GAP_GRAZING, o->guess[1], o->guess[2]);
    if (!seen[i]) dyn_leave_gap(list, GAP_CONFLICT, o->guess[1], o->guess[2]);
  }
}

int dyn_orbits_complete(struct dyn_orbits *list, const fmpq *params, slong prec, long budget) {
  if (!dyn_in_domain(params, N_PARAMS)) return SS_DOMAIN;
  list->complete = false;
  list->gap = GAP_UNTRIED;
  FREED struct known *known = ss_malloc(((size_t)list->n + 1) * sizeof *known);
  for (slong i = 0; i < list->n; i++) known[i] = known_of(&list->orbit[i], full_turns(&list->orbit[i]));
  OWNED(march) s;
  if (!march_run(&s, params, known, (size_t)list->n, budget)) {
    dyn_leave_gap(list, GAP_RANGE, 0, 0);
  } else {
    list->cells = s.cells;
    if (s.spent) dyn_leave_gap(list, GAP_BUDGET, 0, 0);
    if (s.stuck) dyn_leave_gap(list, s.crest ? GAP_GRAZING : GAP_DOUBLE, s.where[0], s.where[1]);
    compare(list, &s, known, params, prec);
    list->complete = list->gap == GAP_UNTRIED;
    if (list->n > 1) qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, dyn_orbits_by_z10);
  }
  return SS_OK;
}
