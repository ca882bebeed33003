/* The first return of an orbit's free coordinates, differentiated by central differences of simulated motions. */
#include "motion/differences.h"

#include <math.h>
#include <string.h>

#include "equations.h"
#include "num/pi.h"
#include "walk.h"

/* A motion beside the orbit, over one period. */
struct replay {
  const struct mech *m;
  const struct mech_orbit *o;
  const struct mech_equations *e;
  enum mech_route route;
};

/* The state at the entry of the first phase. */
static void state_at(double z[MECH_STATES], const struct replay *r, const double *x) {
  double q[MECH_STATES];
  int columns = (int)arb_mat_ncols(r->e->entry), n = r->o->n_free;
  memcpy(q, x, (size_t)n * sizeof *q);
  if (r->m->n_loads) {
    q[n - 1] = cos(x[n - 1]);
    q[n] = sin(x[n - 1]);
  }
  q[columns - 1] = 1;
  for (int i = 0; i < r->m->states; i++) {
    z[i] = 0;
    for (int l = 0; l < columns; l++)
      z[i] += arf_get_d(arb_midref(arb_mat_entry(r->e->entry, i, l)), ARF_RND_NEAR) * q[l];
  }
}

static bool same_word(const struct mech_motion *x, const struct mech_word *w) {
  bool same = x->n_moments == w->n + 1;
  for (int k = 0; same && k <= w->n; k++) same = strcmp(x->moment[k].phase, w->phase[k % w->n]) == 0;
  return same;
}

static int return_of(double *out, const double *x, const void *self) {
  const struct replay *r = self;
  const struct mech_orbit *o = r->o;
  struct mech_motion motion;
  double z[MECH_STATES];
  state_at(z, r, x);
  struct mech_plan plan = {
      .duration = 2 * arf_get_d(arb_midref(o->period), ARF_RND_NEAR), .most = o->word.n + 1, .phase = o->word.phase[0]};
  int status = mech_simulate(&motion, r->route, r->m, z, &plan);
  if (!status && !same_word(&motion, &o->word)) status = SS_DOMAIN;
  for (int l = 0; !status && l < o->n_free; l++) {
    const struct mech_moment *end = &motion.moment[o->word.n];
    double turns = 2 * PI * (double)o->turns;
    out[l] = o->free[l] < 2 * o->n ? end->z[o->free[l]] : x[l] + fmpq_get_d(r->m->load[0].frequency) * end->t - turns;
  }
  mech_motion_clear(&motion);
  return status;
}

int mech_jacobian_differences(double *j, double *err, const struct mech *m, const struct mech_orbit *o,
                              enum mech_route route) {
  struct mech_equations e;
  double x[MECH_STATES], scale = 0;
  mech_equations_init(&e, m, &o->word, o->turns, 64);
  struct replay r = {m, o, &e, route};
  for (int i = 0; i < 2 * o->n; i++) scale = fmax(scale, fabs(arf_get_d(arb_midref(o->state + i), ARF_RND_NEAR)));
  for (int l = 0; l < o->n_free; l++)
    x[l] = arf_get_d(arb_midref(o->free[l] < 2 * o->n ? o->state + o->free[l] : o->angle), ARF_RND_NEAR);
  struct double_map map = {return_of, &r, o->n_free, o->n_free, scale, route == MECH_INTEGRATED ? 1e-12 : 1e-14, 0};
  int status = SS_OK;
  *err = 0;
  for (int l = 0; l < o->n_free && !status; l++) {
    double column[DIFFERENCES_MOST], direction[DIFFERENCES_MOST] = {0}, off;
    direction[l] = 1;
    status = differences_along(column, &off, &map, x, direction);
    for (int i = 0; i < o->n_free; i++) j[i * o->n_free + l] = column[i];
    *err = fmax(*err, off);
  }
  mech_equations_clear(&e);
  return status;
}
