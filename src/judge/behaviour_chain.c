/* "Even in the case of multi degrees of freedom": chains of three and four masses, patched and integrated. */
#include <math.h>

#include "behaviour.h"
#include "motion/chain.h"
#include "verdict.h"

static double drawn(struct sampler *s, int quantity) {
  struct point p;
  point_init(&p);
  sampler_next(&p, s);
  double x = fmpq_get_d(&p.q[quantity]);
  point_clear(&p);
  return x;
}

/* Random springs, masses, friction and start; two of three masses begin with the belt. */
static void random_chain(struct chain *c, double start[2 * CHAIN_MOST], int n, struct sampler *s) {
  *c = (struct chain){.n = n, .V = 1};
  for (int i = 0; i < n; i++) {
    c->spring[i] = drawn(s, Q_CHI);
    c->mobility[i] = 0.5 + drawn(s, Q_ETA) / 4;
    c->us[i] = drawn(s, Q_US1) / 4;
    c->ur[i] = c->us[i] + drawn(s, Q_US2) / 4;
    start[i] = drawn(s, Q_Z1);
    start[n + i] = i % 3 == 2 ? drawn(s, Q_DZ1) : c->V;
  }
}

static bool same_motion(const struct chain_motion *a, const struct chain_motion *b, int n) {
  bool same = a->n_events == b->n_events;
  for (int i = 0; same && i < a->n_events; i++)
    same = a->event[i].mass == b->event[i].mass && a->event[i].to == b->event[i].to &&
           fabs(a->event[i].t - b->event[i].t) < 1e-6;
  for (int i = 0; same && i < 2 * n; i++) same = fabs(a->z[i] - b->z[i]) < 1e-6 * (1 + fabs(a->z[i]));
  return same;
}

bool behaviour_patching(struct behaviour *b) {
  enum { EACH = 12 };
  struct sampler s;
  long good = 0, bad = 0, events = 0;
  sampler_init(&s, b->c->id, POINT_PARAMS, PHASE_D, NULL);
  for (int i = 0; i < 2 * EACH; i++) {
    struct chain c;
    struct chain_motion m[N_CHAIN_ROUTES];
    double start[2 * CHAIN_MOST];
    int n = i < EACH ? 3 : 4, status = SS_OK;
    random_chain(&c, start, n, &s);
    for (int r = 0; r < N_CHAIN_ROUTES; r++) status |= chain_simulate(&m[r], (enum chain_route)r, &c, start, 12);
    bool same = status == SS_OK && same_motion(&m[CHAIN_PATCHED], &m[CHAIN_INTEGRATED], n);
    good += same;
    bad += !same;
    events += m[CHAIN_PATCHED].n_events;
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
