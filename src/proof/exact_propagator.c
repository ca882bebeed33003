/* exp(A u) of a phase over the field: a polynomial in A with the sines and cosines of the phase's frequencies.  How it
   is made is no proof; once in a run it is held against what defines it, P' = A P and P(0) = I, and used only if it
   fulfils that. */
#include "exact_motion_impl.h"
#include "num/calc.h"

#include "base/work.h"
#include "num/num_exact.h"
#include "propagator_law.h"

/* The squares of the phase's frequencies, and how many it has besides 0 (twice in phase D). */
static int frequencies(element *w[2], struct exact_motion *m, enum phase ph, struct num_vec *own) {
  int s = SS_OK;
  w[0] = at(own, 0);
  w[1] = at(own, 1);
  if (ph == PHASE_GAMMA) s |= num_exact.set_d(w[0], 1, 0);
  if (ph == PHASE_C) {
    s |= num_exact.mul(w[1], at(&m->params, P_CHI), at(&m->params, P_ETA), 0);
    s |= exact_sqrt(w[0], m->field, w[1]);
    fmpz_mpoly_q_zero(w[1], num_exact_ctx());
  }
  if (ph != PHASE_H) return s;
  w[0] = at(&m->frequency, 0);
  w[1] = at(&m->frequency, 1);
  m->wants_modes = !m->attempt.modes;
  return m->attempt.modes ? s : SS_UNABLE;
}

/* cos(w u) and sin(w u)/w, at w = 0: 1 and u; at u = NULL, for 0: 1 and 0. */
static int pair_of(element *c, element *s, struct exact_motion *m, const element *w, const element *u) {
  if (!u || exact_is_zero(w)) {
    if (u) num_exact.set(s, u);
    return num_exact.set_d(c, 1, 0);
  }
  struct num_vec x = calc_vec(&m->c, 1);
  int status = motion_op(num_exact.mul, at(&x, 0), m, w, u);
  if (status == SS_OK) status = exact_sin_cos(s, c, m->field, at(&x, 0));
  return status == SS_OK ? motion_op(num_exact.div, s, m, s, w) : status;
}

/* p += (c + A s) (-A^2 - skip)/(own - skip), which is the share of the eigenvalue own of -A^2. */
static int add_share(struct num_vec *p, struct exact_motion *m, const struct num_vec *a, const element *c,
                     const element *s, const element *own, const element *skip) {
  const struct num_type *t = &num_exact;
  struct num_vec square = calc_vec(&m->c, 16), factor = calc_vec(&m->c, 16), gap = calc_vec(&m->c, 2);
  int status = motion_multiply(&square, m, a, a, 4, 4, 4);
  status |= t->sub(at(&gap, 0), own, skip, 0);
  for (int i = 0; i < 16; i++) {
    status |= t->neg(at(&square, i), at(&square, i), 0);
    if (i % 5 == 0) status |= t->sub(at(&square, i), at(&square, i), skip, 0);
    status |= t->div(at(&square, i), at(&square, i), at(&gap, 0), 0);
    status |= t->mul(at(&factor, i), at(a, i), s, 0);
    if (i % 5 == 0) status |= t->add(at(&factor, i), at(&factor, i), c, 0);
  }
  status |= motion_reduce(&square, m) | motion_reduce(&factor, m);
  if (status == SS_OK) status = motion_multiply(&square, m, &factor, &square, 4, 4, 4);
  for (int i = 0; status == SS_OK && i < 16; i++) status = motion_op(t->add, at(p, i), m, at(p, i), at(&square, i));
  return status;
}

static int make_propagator(struct num_vec *p, struct exact_motion *m, enum phase ph, const element *u) {
  const struct num_type *t = &num_exact;
  element *w[2];
  struct num_vec a = calc_vec(&m->c, 16), own = calc_vec(&m->c, 2), f = calc_vec(&m->c, 6);
  int s = motion_system(&a, m, ph);
  s |= frequencies(w, m, ph, &own);
  for (int i = 0; s == SS_OK && i < 2; i++) {
    s |= pair_of(at(&f, i), at(&f, 2 + i), m, w[i], u);
    s |= motion_op(t->mul, at(&f, 4 + i), m, w[i], w[i]);
  }
  for (int i = 0; i < 16; i++) s |= t->set_d(at(p, i), 0, 0);
  if (ph == PHASE_D) { /* A^2 = 0 */
    for (int i = 0; s == SS_OK && i < 16; i++) {
      s |= t->mul(at(p, i), at(&a, i), at(&f, 2), 0);
      if (i % 5 == 0) s |= t->add(at(p, i), at(p, i), at(&f, 0), 0);
    }
  } else {
    for (int i = 0; s == SS_OK && i < 2; i++)
      s = add_share(p, m, &a, at(&f, i), at(&f, 2 + i), at(&f, 4 + i), at(&f, 5 - i));
  }
  return s;
}

/* P' - A P and P(0) - I are zero. */
static bool solves(struct exact_motion *m, enum phase ph) {
  struct num_vec p = calc_vec(&m->c, 16), rate = calc_vec(&m->c, 16), start = calc_vec(&m->c, 16),
                 a = calc_vec(&m->c, 16), rest = calc_vec(&m->c, PROPAGATOR_LAW), u = calc_vec(&m->c, 1);
  int s = exact_symbol(at(&u, 0), m->field, "t");
  s |= make_propagator(&p, m, ph, at(&u, 0));
  s |= make_propagator(&start, m, ph, NULL);
  s |= motion_system(&a, m, ph);
  for (int i = 0; s == SS_OK && i < 16; i++) s = exact_derivative(at(&rate, i), m->field, at(&p, i), "t");
  if (s == SS_OK) s = propagator_law(&rest, &p, &rate, &start, &a);
  if (s == SS_OK) s = motion_reduce(&rest, m);
  bool ok = s == SS_OK;
  for (int i = 0; ok && i < PROPAGATOR_LAW; i++) ok = exact_is_zero(at(&rest, i));
  return ok;
}

static bool is_proved(enum phase ph) {
  static truth known[N_PHASES] = {TRUTH_UNKNOWN, TRUTH_UNKNOWN, TRUTH_UNKNOWN, TRUTH_UNKNOWN};
  if (known[ph] != TRUTH_UNKNOWN) return known[ph] == TRUTH_TRUE;
  const struct exact_attempt modes = {.modes = true};
  const struct point_spec spec = {.kind = POINT_PARAMS};
  OWNED(exact_motion) m;
  exact_motion_begin(&m, &modes, &spec);
  known[ph] = solves(&m, ph) ? TRUTH_TRUE : TRUTH_FALSE;
  return known[ph] == TRUTH_TRUE;
}

int exact_propagator(struct num_vec *p, struct exact_motion *m, enum phase ph, const element *u) {
  work_touch((enum work_part)(WORK_PHASE_D + (int)ph));
  int s = make_propagator(p, m, ph, u);
  return s == SS_OK && !is_proved(ph) ? SS_UNABLE : s;
}
