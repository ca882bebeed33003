/* The parameters of an exact motion.  They are free generators, or numbers where a sentence is asked about under a
   condition such as V = 1; with modes, chi and eta are made of two free frequencies instead, so that the roots of phase
   H are no new unknowns.  Quantities that the model makes of the parameters alone are here too. */
#include <stdlib.h>
#include <string.h>

#include "exact_motion_impl.h"
#include "num/calc.h"

enum { TERMS = 1500 }; /* of the largest polynomial of a motion's field */

int motion_reduce(struct num_vec *v, const struct exact_motion *m) {
  int s = SS_OK;
  for (slong i = 0; i < v->len; i++) s |= exact_reduce(at(v, i), m->field);
  return s;
}

int motion_multiply(struct num_vec *z, const struct exact_motion *m, const struct num_vec *x, const struct num_vec *y,
                    slong rows, slong inner, slong cols) {
  int s = num_mat_mul(z, x, y, rows, inner, cols);
  return s ? s : motion_reduce(z, m);
}

int motion_op(num_binary f, element *z, const struct exact_motion *m, const element *x, const element *y) {
  int s = f(z, x, y, 0);
  return s ? s : exact_reduce(z, m->field);
}

int motion_symbol(element *z, struct exact_motion *m, const char *name) {
  const struct restriction *r = m->spec.restriction;
  if (!r || r->quantity > Q_V || strcmp(name_param[r->quantity - Q_CHI], name) != 0)
    return exact_symbol(z, m->field, name);
  NUMBERS(fmpq, q);
  int s = num_parse_decimal(q, r->value, strlen(r->value));
  if (s == SS_OK) s = num_exact.set_q(z, q, 0);
  return s;
}

int motion_unknown(struct exact_motion *m, const char *name) {
  if (!*m->unbound) snprintf(m->unbound, sizeof m->unbound, "%s", name);
  return SS_UNABLE;
}

/* --- Parameters --- */

int motion_system(struct num_vec *a, struct exact_motion *m, enum phase ph) {
  int s = dyn_system(a, ph, &m->params);
  return s ? s : motion_reduce(a, m);
}

/* Is w^2 an eigenvalue of the stiffness of phase H, as the first-order system has it? */
static bool is_frequency(struct exact_motion *m, const element *w) {
  struct num_vec a = calc_vec(&m->c, 16), k = calc_vec(&m->c, 4), det = calc_vec(&m->c, 1);
  int s = motion_system(&a, m, PHASE_H);
  for (int i = 0; i < 4; i++) s |= num_exact.neg(at(&k, i), at(&a, 8 + 4 * (i / 2) + i % 2), 0);
  s |= num_exact.mul(at(&det, 0), w, w, 0);
  for (int i = 0; i < 4; i += 3) s |= num_exact.sub(at(&k, i), at(&k, i), at(&det, 0), 0);
  s |= num_mat_det(at(&det, 0), &k, 2);
  s |= exact_reduce(at(&det, 0), m->field);
  return s == SS_OK && exact_is_zero(at(&det, 0));
}

/* chi eta = w1^2 + w2^2 - 1 and chi = (1 - w1^2)(w2^2 - 1)/(chi eta): the trace and the determinant of K solved for chi
   and eta; 0 < w1 < 1 < w2 is the domain 0 < chi < 1, eta > 0 once. */
static int take_modes(struct exact_motion *m) {
  OWNED(calc) c = calc_begin(num_ctx_exact());
  element *w1 = at(&m->frequency, 0), *w2 = at(&m->frequency, 1);
  c.status = exact_symbol(w1, m->field, "w_1") | exact_symbol(w2, m->field, "w_2");
  val one = calc_d(&c, 1), a = calc_mul(&c, w1, w1), b = calc_mul(&c, w2, w2);
  val stiff = calc_sub(&c, calc_add(&c, a, b), one);
  val det = calc_mul(&c, calc_sub(&c, one, a), calc_sub(&c, b, one));
  calc_store(&c, at(&m->params, P_CHI), calc_div(&c, det, stiff));
  calc_store(&c, at(&m->params, P_ETA), calc_div(&c, stiff, at(&m->params, P_CHI)));
  int s = c.status;
  if (s == SS_OK && !(is_frequency(m, w1) && is_frequency(m, w2))) s = SS_UNABLE;
  exact_field_roots(m->field, w1, 2);
  return s;
}

static int take_params(struct exact_motion *m) {
  int s = SS_OK;
  for (int i = m->attempt.modes ? P_V : P_CHI; i < N_PARAMS; i++)
    s |= motion_symbol(at(&m->params, i), m, name_param[i]);
  if (!m->attempt.modes) return s;
  if (m->spec.restriction && (m->spec.restriction->quantity == Q_ETA || m->spec.restriction->quantity == Q_CHI))
    return SS_UNABLE;
  return s | take_modes(m);
}

int motion_as_values(struct values *v, struct exact_motion *m, const struct point *p) {
  *v = (struct values){.ctx = num_ctx_exact(), .point = p, .params = m->params, .q = calc_vec(&m->c, N_Q)};
  for (int i = 0; i < N_PARAMS; i++) num_exact.set(at(&v->q, Q_CHI + i), at(&m->params, i));
  return exact_symbol(at(&v->q, Q_US1), m->field, "u_s1") | exact_symbol(at(&v->q, Q_US2), m->field, "u_s2");
}

int motion_of_params(struct num_vec *out, struct exact_motion *m, const char *name) {
  const struct point p = {.kind = POINT_PARAMS};
  struct values v;
  int s = motion_as_values(&v, m, &p);
  s |= oracle_eval(out, oracle_find(name), &v);
  return s ? s : motion_reduce(out, m);
}

void exact_motion_begin(struct exact_motion *m, const struct exact_attempt *a, const struct point_spec *spec) {
  *m = (struct exact_motion){.attempt = *a, .spec = *spec, .bare = spec->paper && !spec->paper->system};
  m->field = exact_field_new(NULL, 0);
  exact_field_limit(m->field, TERMS);
  m->c = exact_calc(m->field);
  m->frequency = calc_vec(&m->c, 2);
  m->params = calc_vec(&m->c, N_PARAMS);
  m->state = calc_vec(&m->c, 20);
  m->tangent = calc_vec(&m->c, 20);
  m->shift = calc_vec(&m->c, 4);
  if (!m->bare) m->state_status = take_params(m);
}

void exact_motion_clear(struct exact_motion *m) {
  calc_clear(&m->c);
  exact_field_free(m->field);
}
