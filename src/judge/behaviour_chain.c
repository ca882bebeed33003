/* "Even in the case of multi degrees of freedom": chains of three and four masses, patched and integrated. */
#include <math.h>
#include <string.h>

#include "behaviour.h"
#include "mech/walk.h"
#include "verdict.h"

enum { MOST_EVENTS = 256 };

static void draw(fmpq_t z, struct sampler *s, int quantity) {
  struct point p;
  point_init(&p);
  sampler_next(&p, s);
  fmpq_set(z, &p.q[quantity]);
  point_clear(&p);
}

/* What is drawn, over four. */
static void draw_quarter(fmpq_t z, struct sampler *s, int quantity) {
  draw(z, s, quantity);
  fmpq_div_2exp(z, z, 2);
}

/* Random springs, masses, friction and start; two of three masses begin with the belt, whose velocity is 1. */
static bool random_chain(struct mech *m, double start[2 * MECH_MASSES], int n, struct sampler *s) {
  const char *why, *name;
  mech_init(m);
  for (int i = 0; i < n; i++) {
    struct mech_link *spring = mech_add_link(m, true, "");
    struct mech_mass *mass = mech_add_mass(m, "");
    fmpq_t x;
    fmpq_init(x);
    spring->end[0] = i - 1; /* of the first: the ground */
    spring->end[1] = i;
    draw(spring->size, s, Q_CHI);
    draw_quarter(mass->inertia, s, Q_ETA);
    fmpq_set_si(x, 1, 2);
    fmpq_add(mass->inertia, mass->inertia, x);
    fmpq_inv(mass->inertia, mass->inertia);
    mass->rubbed = true;
    fmpq_one(mass->surface);
    draw_quarter(mass->sliding, s, Q_US1);
    draw_quarter(mass->limit, s, Q_US2);
    fmpq_add(mass->limit, mass->limit, mass->sliding);
    draw(x, s, Q_Z1);
    start[i] = fmpq_get_d(x);
    fmpq_one(x);
    if (i % 3 == 2) draw(x, s, Q_DZ1);
    start[n + i] = fmpq_get_d(x);
    fmpq_clear(x);
  }
  return mech_finish(m, &why, &name);
}

static bool same_motion(const struct mech_motion *a, const struct mech_motion *b, int n) {
  bool same = a->n_moments == b->n_moments;
  for (int i = 1; same && i < a->n_moments; i++)
    same = strcmp(a->moment[i].phase, b->moment[i].phase) == 0 && fabs(a->moment[i].t - b->moment[i].t) < 1e-6;
  for (int i = 0; same && i < 2 * n; i++) same = fabs(a->z[i] - b->z[i]) < 1e-6 * (1 + fabs(a->z[i]));
  return same;
}

/* One chain by both routes; its events are added. */
static bool same_by_both(long *events, int n, struct sampler *s) {
  struct mech m;
  struct mech_motion x[N_MECH_ROUTES];
  double start[2 * MECH_MASSES];
  int status = random_chain(&m, start, n, s) ? SS_OK : SS_DOMAIN;
  for (int r = 0; r < N_MECH_ROUTES; r++)
    status |= mech_simulate(&x[r], (enum mech_route)r, &m, start, 12, MOST_EVENTS);
  bool same = status == SS_OK && same_motion(&x[MECH_PATCHED], &x[MECH_INTEGRATED], n);
  *events += x[MECH_PATCHED].n_moments - 1;
  for (int r = 0; r < N_MECH_ROUTES; r++) mech_motion_clear(&x[r]);
  mech_clear(&m);
  return same;
}

bool behaviour_patching(struct behaviour *b) {
  enum { EACH = 12 };
  struct sampler s;
  long good = 0, bad = 0, events = 0;
  sampler_init(&s, b->c->id, POINT_PARAMS, PHASE_D, NULL);
  for (int i = 0; i < 2 * EACH; i++) {
    bool same = same_by_both(&events, i < EACH ? 3 : 4, &s);
    good += same;
    bad += !same;
  }
  enum route_outcome outcome = bad ? ROUTE_UNDECIDED : good ? ROUTE_AGREES : ROUTE_NOTHING;
  struct route_result w[2];
  w[0] = behaviour_route(
      b, "exponential", "model", outcome, true, good + bad, NULL,
      result_str(
          b->j->out,
          "chains of three and of four masses, random springs, masses, friction and starts over 12 units of time: "
          "solutions of the successive configurations by matrix exponentials, patched at %ld events",
          events));
  w[1] = behaviour_route(b, "integration", "model", outcome, false, good + bad, NULL,
                         result_str(b->j->out,
                                    "GSL's direct integration has the same events and ends at the same state "
                                    "at %ld of %ld",
                                    good, good + bad));
  b->f->verdict = verdict_of(w, 2, false);
  return true;
}
