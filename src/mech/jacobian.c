/* The derivative of the first return of an orbit's free coordinates by routes that do not differentiate the equations
   that were solved: saltation matrices, and central differences of simulated motions. */
#include <math.h>
#include <string.h>

#include "equations.h"
#include "motion/differences.h"
#include "num/pi.h"
#include "walk.h"

/* --- Saltation --- */

/* Across the event at the end of phase k: the state, the first column, and what is carried beside it, the differences d
   of states of one time, become those after it,

     d+ = R (d - f- q) + f+ q,   q = n d / (n f-),

   with n the row that is zero at the event, f- and f+ the rates before and after, R the rebound.  At the end of the
   period f+ q is left out: there d is taken on to the event, where the return is. */
static void cross(arb_mat_t d, const struct mech_equations *e, int k) {
  bool last = k + 1 == e->w->n;
  slong columns = arb_mat_ncols(d);
  NUMBERS(arb, speed);
  SIZED(arb_mat, rate, e->side, columns);
  SIZED(arb_mat, lead, 1, columns);
  arb_mat_mul(rate, e->rate[k], d, e->prec);
  arb_dot(speed, NULL, 0, e->event[k]->entries, 1, rate->entries, columns, e->side, e->prec);
  arb_mat_mul(lead, e->event[k], d, e->prec);
  arb_mat_scalar_div_arb(lead, lead, speed, e->prec);
  for (int i = 0; i < e->side; i++)
    for (slong l = 1; l < columns; l++)
      arb_submul(arb_mat_entry(d, i, l), arb_mat_entry(rate, i, 0), arb_mat_entry(lead, 0, l), e->prec);
  for (slong l = 0; e->hit[k] >= 0 && l < columns; l++) {
    arb_ptr velocity = arb_mat_entry(d, e->m->n + e->hit[k], l);
    arb_mul(velocity, velocity, e->rebound[k], e->prec);
  }
  if (!last) arb_mat_mul(rate, e->rate[k + 1], d, e->prec);
  for (int i = 0; !last && i < e->side; i++)
    for (slong l = 1; l < columns; l++)
      arb_addmul(arb_mat_entry(d, i, l), arb_mat_entry(rate, i, 0), arb_mat_entry(lead, 0, l), e->prec);
}

/* The state at the first entry, and its derivatives by what is free there. */
static void enter(arb_mat_t d, const struct mech_equations *e, const struct mech_orbit *o) {
  NUMBERS(arb, part);
  for (int i = 0; i < o->states; i++) arb_set(arb_mat_entry(d, i, 0), o->state + i);
  arb_one(arb_mat_entry(d, o->states, 0));
  for (int l = 0; l < o->n_free; l++)
    for (int i = 0; i < e->side; i++) {
      arb_ptr to = arb_mat_entry(d, i, l + 1);
      arb_srcptr from = arb_mat_entry(e->entry, i, l);
      if (o->free[l] < 2 * o->n) arb_set(to, from);
      for (int k = 0; o->free[l] == 2 * o->n && k < e->m->n_orders; k++, from += 2) { /* theta, by cosines and sines */
        arb_srcptr cosine = o->state + 2 * o->n + 2 * k;
        arb_mul(part, from + 1, cosine, e->prec);
        arb_submul(part, from, cosine + 1, e->prec);
        mech_times_order(part, e->m->order[k], e->prec);
        arb_add(to, to, part, e->prec);
      }
    }
}

void mech_saltation(arb_mat_t j, const struct mech_equations *e, const struct mech_orbit *o) {
  arb_srcptr cosine = o->state + 2 * o->n, sine = cosine + 1;
  SIZED(arb_mat, d, e->side, 1 + o->n_free);
  SIZED(arb_mat, flow, e->side, e->side);
  enter(d, e, o);
  for (int k = 0; k < o->word.n; k++) {
    mech_flow(flow, e, k, o->t + k);
    arb_mat_mul(d, flow, d, e->prec);
    cross(d, e, k);
  }
  for (int i = 0; i < o->n_free; i++)
    for (int l = 0; l < o->n_free; l++) {
      arb_ptr to = arb_mat_entry(j, i, l);
      if (o->free[i] < 2 * o->n) {
        arb_set(to, arb_mat_entry(d, o->free[i], l + 1));
      } else {
        arb_mul(to, cosine, arb_mat_entry(d, 2 * o->n + 1, l + 1), e->prec);
        arb_submul(to, sine, arb_mat_entry(d, 2 * o->n, l + 1), e->prec);
      }
    }
}

/* --- Differences --- */

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
  if (r->m->n_loads) mech_at_angle(q + n - 1, r->m, x[n - 1]);
  q[columns - 1] = 1;
  for (int i = 0; i < r->m->states; i++) {
    z[i] = 0;
    for (int l = 0; l < columns; l++) z[i] += num_arb.get_d(arb_mat_entry(r->e->entry, i, l)) * q[l];
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
  OWNED(mech_motion) motion;
  double z[MECH_STATES];
  state_at(z, r, x);
  struct mech_plan plan = {.duration = 2 * num_arb.get_d(o->period), .most = o->word.n + 1, .phase = o->word.phase[0]};
  int status = mech_simulate(&motion, r->route, r->m, z, &plan);
  if (!status && !same_word(&motion, &o->word)) status = SS_DOMAIN;
  for (int l = 0; !status && l < o->n_free; l++) {
    const struct mech_moment *end = &motion.moment[o->word.n];
    double turns = 2 * PI * (double)o->turns;
    out[l] = o->free[l] < 2 * o->n ? end->z[o->free[l]] : x[l] + fmpq_get_d(r->m->frequency) * end->t - turns;
  }
  return status;
}

static int by_differences(arb_mat_t j, const struct mech_equations *e, const struct mech_orbit *o,
                          enum mech_route route) {
  struct replay r = {e->m, o, e, route};
  double x[MECH_STATES], scale = 0, worst = 0;
  int status = SS_OK;
  for (int i = 0; i < 2 * o->n; i++) scale = fmax(scale, fabs(num_arb.get_d(o->state + i)));
  for (int l = 0; l < o->n_free; l++) x[l] = num_arb.get_d(o->free[l] < 2 * o->n ? o->state + o->free[l] : o->angle);
  struct double_map map = {return_of, &r, o->n_free, o->n_free, scale, route == MECH_INTEGRATED ? 1e-12 : 1e-14, 0};
  for (int l = 0; l < o->n_free && !status; l++) {
    double column[DIFFERENCES_MOST], direction[DIFFERENCES_MOST] = {0}, off;
    direction[l] = 1;
    status = differences_along(column, &off, &map, x, direction);
    for (int i = 0; i < o->n_free; i++) arb_set_d(arb_mat_entry(j, i, l), column[i]);
    worst = fmax(worst, off);
  }
  for (int i = 0; i < o->n_free * o->n_free; i++) mag_set_d(arb_radref(j->entries + i), worst);
  return status;
}

int mech_jacobian(arb_mat_t j, const struct mech *m, const struct mech_orbit *o, enum mech_derivative how, slong prec) {
  int status = SS_OK;
  if (how == MECH_IMPLICIT) {
    arb_mat_set(j, o->jacobian);
    return SS_OK;
  }
  OWNED(mech_equations) e;
  mech_equations_init(&e, m, &o->word, o->turns, prec);
  if (how == MECH_SALTATION)
    mech_saltation(j, &e, o);
  else
    status = by_differences(j, &e, o, how == MECH_BESIDE_INTEGRATED ? MECH_INTEGRATED : MECH_PATCHED);
  return status;
}
