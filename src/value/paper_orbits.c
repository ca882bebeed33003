/* The paper's own route to an orbit, (44)-(46), at a scene: where Newton's iteration starts, where it ends, and which
   of the model's orbits lies there.  The printed times are where the paper's readers would start; without them the
   model's orbits, moved, stand in for a guess that somebody had. */
#include <stdlib.h>

#include "base/arena.h"
#include "orbits.h"
#include "paper_orbits.h"

static bool printed_times(double guess[4], const struct scene *s) {
  for (int i = 0; i < 4; i++) {
    const struct printed_number *p = scene_printed(s, scene_key_name[KEY_TA + i]);
    if (!p) return false;
    guess[i] = fmpq_get_d(&p->value);
  }
  return true;
}

static arb_srcptr number_of(const struct dyn_orbit *o, int i) {
  return i < ROUTE_Z ? o->t[i] : i == ROUTE_Z ? o->z10 : o->z20;
}

/* The largest difference of the six numbers, bounded from above. */
static void distance_to(arb_t distance, const struct num_vec *x, const struct dyn_orbit *o) {
  NUMBERS(arb, d);
  NUMBERS(arf, most, bound);
  for (int i = 0; i < N_ROUTE; i++) {
    num_mpfr.get_arb(d, num_vec_at(x, i));
    arb_sub(d, d, number_of(o, i), 2 * x->ctx.prec);
    arb_get_abs_ubound_arf(bound, d, 64);
    if (arf_cmp(most, bound) < 0) arf_set(most, bound);
  }
  arb_set_arf(distance, most);
}

static void find_nearest(struct paper_orbit *p, const struct dyn_orbits *list) {
  NUMBERS(arb, d);
  p->nearest = -1;
  for (slong i = 0; i < list->n; i++) {
    distance_to(d, &p->route.x, &list->orbit[i]);
    if (p->nearest >= 0 && !arb_lt(d, p->distance)) continue;
    arb_set(p->distance, d);
    p->nearest = i;
  }
}

/* One start; e1 and e2 are the scene's, or those of the orbit. */
static void run_from(struct paper_orbits *out, const struct scene *s, const struct dyn_orbits *list, slong orbit,
                     const double *guess, slong prec) {
  struct paper_orbit *p = SS_PUSH(out->item, out->n, out->cap);
  fmpq params[N_PARAMS];
  *p = (struct paper_orbit){.from = guess ? -1 : orbit};
  arb_init(p->distance);
  paper_route_init(&p->route, prec);
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_init(params + i);
    if (i < P_E1 || scene_has_forces(s))
      fmpq_set(params + i, &s->value[KEY_CHI + i]);
    else
      arf_get_fmpq(params + i, arb_midref(i == P_E1 ? list->orbit[orbit].e1 : list->orbit[orbit].e2));
  }
  for (int i = 0; i < 4; i++)
    p->guess[i] = guess ? guess[i] : list->orbit[orbit].guess[i] * (1 + PAPER_START_MOVED / 100.0);
  p->status = paper_route_run(&p->route, params, p->guess);
  p->nearest = -1;
  if (p->status == SS_OK) find_nearest(p, list);
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(params + i);
}

bool audit_paper_orbits(struct paper_orbits *out, const struct scene *s, slong prec, struct diag *d) {
  OWNED(dyn_orbits) list;
  double guess[4];
  *out = (struct paper_orbits){.n = 0};
  bool printed = printed_times(guess, s);
  audit_orbits(&list, s, prec);
  if (printed && scene_has_forces(s))
    run_from(out, s, &list, 0, guess, prec);
  else
    for (slong i = 0; i < list.n; i++) run_from(out, s, &list, i, printed ? guess : NULL, prec);
  if (out->n == 0)
    diag_set(d, "%s: error: no start for the paper's route: the scene prints no times, or no orbit was found", s->path);
  return out->n > 0;
}

void paper_orbits_clear(struct paper_orbits *p) {
  for (size_t i = 0; i < p->n; i++) {
    paper_route_clear(&p->item[i].route);
    arb_clear(p->item[i].distance);
  }
  free(p->item);
}
