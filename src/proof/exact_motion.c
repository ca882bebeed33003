/* Motions of the word as elements of a field; see the header.  exp(A u) is a polynomial in A with the sines and cosines of
   the phase's frequencies, which are held against A: P' = A P and P(0) = I decide, not the way it was made. */
#include "exact_motion.h"

#include "stickslip/work.h"

#include "claim/kinds.h"
#include "value/local_maps.h"
#include <stdlib.h>
#include <string.h>

enum { TERMS = 1500 };

typedef fmpz_mpoly_q_struct element;

static element *at(const struct num_vec *v, slong i) {
  return num_vec_at(v, i);
}

static void vec_init(struct num_vec *v, slong n) {
  num_vec_init(v, n, num_ctx_exact());
}

static int reduce_all(struct num_vec *v, const struct exact_motion *m) {
  int s = SS_OK;
  for (slong i = 0; i < v->len; i++) s |= exact_reduce(at(v, i), m->field);
  return s;
}

static int multiply(struct num_vec *z, const struct exact_motion *m, const struct num_vec *x, const struct num_vec *y,
                    slong rows, slong inner, slong cols) {
  int s = num_mat_mul(z, x, y, rows, inner, cols);
  return s ? s : reduce_all(z, m);
}

static int op(num_binary f, element *z, const struct exact_motion *m, const element *x, const element *y) {
  int s = f(z, x, y, 0);
  return s ? s : exact_reduce(z, m->field);
}

/* A vector that shares n elements of another from i on. */
static struct num_vec part(const struct num_vec *v, slong i, slong n) {
  return (struct num_vec){v->ctx, n, num_vec_at(v, i)};
}

static int symbol(element *z, struct exact_motion *m, const char *name) {
  const struct restriction *r = m->restriction;
  static const struct {
    const char *name;
    int q;
  } restricted[] = {{"chi", Q_CHI}, {"eta", Q_ETA}, {"V", Q_V}};
  for (size_t i = 0; r && i < sizeof restricted / sizeof *restricted; i++) {
    if (restricted[i].q != r->quantity || strcmp(restricted[i].name, name) != 0) continue;
    fmpq_t q;
    fmpq_init(q);
    int s = num_parse_decimal(q, r->value, strlen(r->value));
    if (s == SS_OK) s = num_exact.set_q(z, q, 0);
    fmpq_clear(q);
    return s;
  }
  return exact_symbol(z, m->field, name);
}

/* --- Parameters --- */

static int system_of(struct num_vec *a, struct exact_motion *m, enum phase ph) {
  int s = dyn_system(a, ph, &m->params);
  return s ? s : reduce_all(a, m);
}

/* Is w^2 an eigenvalue of the stiffness of phase H, as the first-order system has it? */
static bool is_frequency(struct exact_motion *m, const element *w) {
  struct num_vec a, k, det;
  vec_init(&a, 16);
  vec_init(&k, 4);
  vec_init(&det, 1);
  int s = system_of(&a, m, PHASE_H);
  for (int i = 0; i < 4; i++) s |= num_exact.neg(at(&k, i), at(&a, 8 + 4 * (i / 2) + i % 2), 0);
  s |= num_exact.mul(at(&det, 0), w, w, 0);
  for (int i = 0; i < 4; i += 3) s |= num_exact.sub(at(&k, i), at(&k, i), at(&det, 0), 0);
  s |= num_mat_det(at(&det, 0), &k, 2);
  s |= exact_reduce(at(&det, 0), m->field);
  bool zero = s == SS_OK && exact_is_zero(m->field, at(&det, 0));
  num_vec_clear(&det);
  num_vec_clear(&k);
  num_vec_clear(&a);
  return zero;
}

/* chi eta = w1^2 + w2^2 - 1 and chi = (1 - w1^2)(w2^2 - 1)/(chi eta): the trace and the determinant of K solved for chi and
   eta; 0 < w1 < 1 < w2 is the domain 0 < chi < 1, eta > 0 once. */
static int take_modes(struct exact_motion *m) {
  const struct num_type *t = &num_exact;
  struct num_vec w;
  vec_init(&w, 4);
  element *one = at(&w, 0), *a = at(&w, 1), *b = at(&w, 2), *stiff = at(&w, 3);
  int s = exact_symbol(at(&m->frequency, 0), m->field, "w_1");
  s |= exact_symbol(at(&m->frequency, 1), m->field, "w_2");
  s |= t->set_d(one, 1, 0);
  s |= t->mul(a, at(&m->frequency, 0), at(&m->frequency, 0), 0);
  s |= t->mul(b, at(&m->frequency, 1), at(&m->frequency, 1), 0);
  s |= t->add(stiff, a, b, 0);
  s |= t->sub(stiff, stiff, one, 0);
  s |= t->sub(a, one, a, 0);
  s |= t->sub(b, b, one, 0);
  s |= t->mul(a, a, b, 0);
  s |= t->div(at(&m->params, P_CHI), a, stiff, 0);
  s |= t->div(at(&m->params, P_ETA), stiff, at(&m->params, P_CHI), 0);
  num_vec_clear(&w);
  if (s == SS_OK && !(is_frequency(m, at(&m->frequency, 0)) && is_frequency(m, at(&m->frequency, 1)))) s = SS_UNABLE;
  exact_field_roots(m->field, at(&m->frequency, 0), 2);
  return s;
}

static int take_params(struct exact_motion *m) {
  static const char *const names[N_PARAMS] = {"chi", "eta", "V", "e_1", "e_2"};
  int s = SS_OK;
  for (int i = m->attempt.modes ? P_V : P_CHI; i < N_PARAMS; i++) s |= symbol(at(&m->params, i), m, names[i]);
  if (!m->attempt.modes) return s;
  if (m->restriction && (m->restriction->quantity == Q_ETA || m->restriction->quantity == Q_CHI)) return SS_UNABLE;
  return s | take_modes(m);
}

/* --- Propagators --- */

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
  if (!u || exact_is_zero(m->field, w)) {
    if (u) num_exact.set(s, u);
    return num_exact.set_d(c, 1, 0);
  }
  struct num_vec x;
  vec_init(&x, 1);
  int status = op(num_exact.mul, at(&x, 0), m, w, u);
  if (status == SS_OK) status = exact_sin_cos(s, c, m->field, at(&x, 0));
  if (status == SS_OK) status = op(num_exact.div, s, m, s, w);
  num_vec_clear(&x);
  return status;
}

/* p += (c + A s) (-A^2 - skip)/(own - skip), which is the share of the eigenvalue own of -A^2. */
static int add_share(struct num_vec *p, struct exact_motion *m, const struct num_vec *a, const element *c,
                     const element *s, const element *own, const element *skip) {
  const struct num_type *t = &num_exact;
  struct num_vec square, factor, gap;
  vec_init(&square, 16);
  vec_init(&factor, 16);
  vec_init(&gap, 2);
  int status = multiply(&square, m, a, a, 4, 4, 4);
  status |= t->sub(at(&gap, 0), own, skip, 0);
  for (int i = 0; i < 16; i++) {
    status |= t->neg(at(&square, i), at(&square, i), 0);
    if (i % 5 == 0) status |= t->sub(at(&square, i), at(&square, i), skip, 0);
    status |= t->div(at(&square, i), at(&square, i), at(&gap, 0), 0);
    status |= t->mul(at(&factor, i), at(a, i), s, 0);
    if (i % 5 == 0) status |= t->add(at(&factor, i), at(&factor, i), c, 0);
  }
  status |= reduce_all(&square, m) | reduce_all(&factor, m);
  if (status == SS_OK) status = multiply(&square, m, &factor, &square, 4, 4, 4);
  for (int i = 0; status == SS_OK && i < 16; i++) status = op(t->add, at(p, i), m, at(p, i), at(&square, i));
  num_vec_clear(&gap);
  num_vec_clear(&factor);
  num_vec_clear(&square);
  return status;
}

static int make_propagator(struct num_vec *p, struct exact_motion *m, enum phase ph, const element *u) {
  const struct num_type *t = &num_exact;
  struct num_vec a, own, f;
  element *w[2];
  vec_init(&a, 16);
  vec_init(&own, 2);
  vec_init(&f, 6);
  int s = system_of(&a, m, ph);
  s |= frequencies(w, m, ph, &own);
  for (int i = 0; s == SS_OK && i < 2; i++) {
    s |= pair_of(at(&f, i), at(&f, 2 + i), m, w[i], u);
    s |= op(t->mul, at(&f, 4 + i), m, w[i], w[i]);
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
  num_vec_clear(&f);
  num_vec_clear(&own);
  num_vec_clear(&a);
  return s;
}

/* P' = A P entry by entry, and P(0) = I. */
static bool solves(struct exact_motion *m, enum phase ph) {
  struct num_vec p, ap, a, u;
  vec_init(&p, 16);
  vec_init(&ap, 16);
  vec_init(&a, 16);
  vec_init(&u, 1);
  int s = exact_symbol(at(&u, 0), m->field, "t");
  s |= make_propagator(&p, m, ph, at(&u, 0));
  s |= system_of(&a, m, ph);
  if (s == SS_OK) s = multiply(&ap, m, &a, &p, 4, 4, 4);
  bool ok = s == SS_OK;
  for (int i = 0; ok && i < 16; i++) {
    ok = exact_derivative(at(&u, 0), m->field, at(&p, i), "t") == SS_OK && exact_equal(m->field, at(&u, 0), at(&ap, i));
  }
  ok = ok && make_propagator(&p, m, ph, NULL) == SS_OK;
  for (int i = 0; ok && i < 16; i++) {
    num_exact.set_d(at(&u, 0), i % 5 == 0, 0);
    ok = exact_equal(m->field, at(&u, 0), at(&p, i));
  }
  num_vec_clear(&u);
  num_vec_clear(&a);
  num_vec_clear(&ap);
  num_vec_clear(&p);
  return ok;
}

bool exact_propagator_proved(enum phase ph) {
  static truth known[N_PHASES] = {TRUTH_UNKNOWN, TRUTH_UNKNOWN, TRUTH_UNKNOWN, TRUTH_UNKNOWN};
  if (known[ph] != TRUTH_UNKNOWN) return known[ph] == TRUTH_TRUE;
  const struct exact_attempt modes = {.modes = true};
  const struct point_spec spec = {.kind = POINT_PARAMS};
  const struct tape nothing = {.n = 0};
  struct exact_motion m;
  exact_motion_init(&m, &modes, &spec, false, NULL, &nothing);
  known[ph] = solves(&m, ph) ? TRUTH_TRUE : TRUTH_FALSE;
  exact_motion_clear(&m);
  return known[ph] == TRUTH_TRUE;
}

int exact_propagator(struct num_vec *p, struct exact_motion *m, enum phase ph, const element *u) {
  work_touch((enum work_part)(WORK_PHASE_D + (int)ph));
  int s = make_propagator(p, m, ph, u);
  return s == SS_OK && !exact_propagator_proved(ph) ? SS_UNABLE : s;
}

/* --- States and their events --- */

static int length(element *z, struct exact_motion *m, int phase) {
  static const char *const names[] = {"t_a", "t_b", "t_c", "t_d"};
  return symbol(z, m, names[phase]);
}

/* What a switching function says of a vector: its value, or without its constant, for perturbations. */
static int switching(element *z, struct exact_motion *m, int phase, const struct num_vec *v, bool linear) {
  struct num_vec w;
  vec_init(&w, 5);
  struct num_vec zero = part(&w, 0, 4);
  int s = dyn_switching(z, (enum phase)phase, &m->params, v);
  if (linear) {
    s |= dyn_switching(at(&w, 4), (enum phase)phase, &m->params, &zero);
    s |= num_exact.sub(z, z, at(&w, 4), 0);
  }
  if (s == SS_OK) s = exact_reduce(z, m->field);
  num_vec_clear(&w);
  return s;
}

/* Component i of v so chosen that the affine switching function that ends the phase is zero. */
static int obey(struct num_vec *v, struct exact_motion *m, int phase, int i, bool linear) {
  struct num_vec w;
  vec_init(&w, 2);
  int s = num_exact.set_d(at(v, i), 0, 0);
  s |= switching(at(&w, 0), m, phase, v, linear);
  s |= num_exact.set_d(at(v, i), 1, 0);
  s |= switching(at(&w, 1), m, phase, v, linear);
  s |= op(num_exact.sub, at(&w, 1), m, at(&w, 0), at(&w, 1));
  if (s == SS_OK) s = op(num_exact.div, at(v, i), m, at(&w, 0), at(&w, 1));
  num_vec_clear(&w);
  return s;
}

/* For each end of a phase, from the start of the period on: which components are free, which one the event decides (-1:
   none), and which are those of a mass that sticks to the belt. */
static const struct {
  const char *name[N_STATE], *small[N_STATE];
  int decided;
  bool sticks[N_STATE];
} ends[5] = {{{"z_10", "z_20", NULL, NULL}, {"x", "y", NULL, NULL}, -1, {[DZ_1] = true, [DZ_2] = true}},
             {{NULL, "z_2a", NULL, NULL}, {NULL, "y_a", NULL, NULL}, Z_1, {[DZ_1] = true, [DZ_2] = true}},
             {{"z_1b", NULL, "z'_1b", NULL}, {"x_b", NULL, "u_b", NULL}, Z_2, {[DZ_2] = true}},
             {{"z_1c", "z_2c", NULL, "z'_2c"}, {"x_c", "y_c", NULL, "v_c"}, DZ_1, {false}},
             {{"z_1f", "z_2f", NULL, NULL}, {"x_f", "y_f", NULL, NULL}, DZ_2, {[DZ_1] = true}}};

/* Any state at all: no mass sticks, no event has been. */
static int any_state(struct num_vec *v, struct exact_motion *m, int k) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    char name[16];
    snprintf(name, sizeof name, "Z%d[%d]", k, i + 1);
    s |= exact_symbol(at(v, i), m->field, name);
  }
  return s;
}

static int free_end(struct num_vec *v, struct exact_motion *m, int k, bool perturbation) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    const char *name = perturbation ? ends[k].small[i] : ends[k].name[i];
    if (name) s |= exact_symbol(at(v, i), m->field, name);
    if (ends[k].sticks[i] && !perturbation) num_exact.set(at(v, i), at(&m->params, P_V));
    if (ends[k].sticks[i] && perturbation) s |= num_exact.set_d(at(v, i), 0, 0);
  }
  return s == SS_OK && ends[k].decided >= 0 ? obey(v, m, k - 1, ends[k].decided, perturbation) : s;
}

/* The event decides e_1 or e_2 where the state is known. */
static int decide_limit(struct exact_motion *m, int k, struct num_vec *z) {
  struct num_vec w;
  vec_init(&w, 1);
  int limit = k == 1 ? P_E1 : P_E2;
  num_exact.set_d(at(&m->params, limit), 0, 0);
  int s = switching(at(&w, 0), m, k - 1, z, false);
  num_exact.set(at(&m->params, limit), at(&w, 0));
  num_vec_clear(&w);
  return s;
}

static int carried(struct num_vec *z, struct exact_motion *m, int k, const struct num_vec *from, const element *more) {
  struct num_vec p, u;
  vec_init(&p, 16);
  vec_init(&u, 1);
  int s = length(at(&u, 0), m, k - 1);
  if (more) s |= op(num_exact.add, at(&u, 0), m, at(&u, 0), more);
  s |= exact_propagator(&p, m, (enum phase)(k - 1), at(&u, 0));
  if (s == SS_OK) s = multiply(z, m, &p, from, 4, 4, 1);
  num_vec_clear(&u);
  num_vec_clear(&p);
  return s;
}

static bool is_periodic(const struct exact_motion *m) {
  return m->kind == POINT_ORBIT;
}

/* Z_c = exp(-A_C t_d) Z_0. */
static int carried_back(struct num_vec *z, struct exact_motion *m, const struct num_vec *start) {
  struct num_vec p, u;
  vec_init(&p, 16);
  vec_init(&u, 1);
  int s = length(at(&u, 0), m, PHASE_C);
  s |= num_exact.neg(at(&u, 0), at(&u, 0), 0);
  if (s == SS_OK) s = exact_propagator(&p, m, PHASE_C, at(&u, 0));
  if (s == SS_OK) s = multiply(z, m, &p, start, 4, 4, 1);
  num_vec_clear(&u);
  num_vec_clear(&p);
  return s;
}

/* Z_0, Z_a, Z_b, Z_c, Z_f; on a periodic motion the last is the first. */
static int state(struct num_vec *z, struct exact_motion *m, int k) {
  if (k == 4 && is_periodic(m)) k = 0;
  *z = part(&m->state, 4 * k, 4);
  if (m->have_state[k]) return m->state_status;
  m->have_state[k] = true;
  bool patched = m->kind == POINT_PATCHED;
  if (k <= m->attempt.anchor || k <= m->first_state || (k == 0 && is_periodic(m)))
    return m->state_status |= patched ? any_state(z, m, k) : free_end(z, m, k, false);
  struct num_vec before;
  bool back = k == 3 && m->attempt.anchor == ANCHOR_BACK;
  int s = state(&before, m, back ? 4 : k - 1);
  if (s == SS_OK) s = back ? carried_back(z, m, &before) : carried(z, m, k, &before, NULL);
  if (s == SS_OK && !patched && (k == 1 || k == 2)) s = decide_limit(m, k, z);
  return m->state_status |= s;
}

/* --- Perturbations --- */

static int rate_of(struct num_vec *f, struct exact_motion *m, int phase, const struct num_vec *z) {
  struct num_vec a;
  vec_init(&a, 16);
  int s = system_of(&a, m, (enum phase)phase);
  if (s == SS_OK) s = multiply(f, m, &a, z, 4, 4, 1);
  num_vec_clear(&a);
  return s;
}

/* -n dz/(n f), by which the event comes later when the state at its time is dz off. */
static int delay(element *dt, struct exact_motion *m, int k, const struct num_vec *dz, const struct num_vec *z) {
  struct num_vec w;
  vec_init(&w, 1);
  int s = switching(dt, m, k - 1, dz, true);
  s |= dyn_switching_rate(at(&w, 0), (enum phase)(k - 1), &m->params, z);
  s |= exact_reduce(at(&w, 0), m->field);
  if (s == SS_OK) s = op(num_exact.div, dt, m, dt, at(&w, 0));
  if (s == SS_OK) s = num_exact.neg(dt, dt, 0);
  num_vec_clear(&w);
  return s;
}

static int free_shift(element *dt, struct exact_motion *m, int phase) {
  static const char *const names[] = {"dt_a", "dt_b", "dt_c", "dt_d"};
  return exact_symbol(dt, m->field, names[phase]);
}

/* P dz + f dt, with dt where the event asks for it (located) or free. */
static int first_order(struct num_vec *out, struct exact_motion *m, int k, const struct num_vec *dz) {
  struct num_vec z, f;
  element *dt = at(&m->shift, k - 1);
  vec_init(&f, 4);
  int s = state(&z, m, k);
  s |= carried(out, m, k, dz, NULL);
  if (s == SS_OK) s = rate_of(&f, m, k - 1, &z);
  if (s == SS_OK) s = m->attempt.tangents == TANGENTS_LOCATED ? delay(dt, m, k, out, &z) : free_shift(dt, m, k - 1);
  for (int i = 0; s == SS_OK && i < 4; i++) {
    s = op(num_exact.mul, at(&f, i), m, at(&f, i), dt);
    if (s == SS_OK) s = op(num_exact.add, at(out, i), m, at(out, i), at(&f, i));
  }
  num_vec_clear(&f);
  return s;
}

/* The other motion, Z + dZ, carried over the longer phase, less this one. */
static int difference(struct num_vec *out, struct exact_motion *m, int k, const struct num_vec *dz) {
  struct num_vec z, other;
  element *dt = at(&m->shift, k - 1);
  vec_init(&other, 4);
  int s = state(&z, m, k - 1);
  s |= free_shift(dt, m, k - 1);
  for (int i = 0; s == SS_OK && i < 4; i++) s = op(num_exact.add, at(&other, i), m, at(&z, i), at(dz, i));
  if (s == SS_OK) s = carried(out, m, k, &other, dt);
  if (s == SS_OK) s = state(&z, m, k);
  for (int i = 0; s == SS_OK && i < 4; i++) s = op(num_exact.sub, at(out, i), m, at(out, i), at(&z, i));
  num_vec_clear(&other);
  return s;
}

/* At patched points any numbers, but that the velocity of a mass which sticks in the phase before, constant in that phase's
   system, is the belt's with and without the perturbation. */
static int any_tangent(struct num_vec *dz, struct exact_motion *m, int k) {
  static const char letters[] = "xyuv", places[] = "abcf";
  struct num_vec a;
  vec_init(&a, 16);
  int s = k > 0 ? system_of(&a, m, (enum phase)(k - 1)) : SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    char name[8];
    bool sticks = k > 0 && i >= DZ_1;
    for (int c = 0; sticks && c < N_STATE; c++) sticks = exact_is_zero(m->field, at(&a, 4 * i + c));
    snprintf(name, sizeof name, k > 0 ? "%c_%c" : "%c", letters[i], places[k > 0 ? k - 1 : 0]);
    s |= sticks ? num_exact.set_d(at(dz, i), 0, 0) : exact_symbol(at(dz, i), m->field, name);
  }
  num_vec_clear(&a);
  return s;
}

static int tangent(struct num_vec *dz, struct exact_motion *m, int k) {
  *dz = part(&m->tangent, 4 * k, 4);
  if (m->have_tangent[k]) return m->tangent_status;
  m->have_tangent[k] = true;
  bool patched = m->kind == POINT_PATCHED;
  if (patched || m->attempt.tangents == TANGENTS_FREE || k <= m->first_tangent) {
    if (k > 0) m->tangent_status |= free_shift(at(&m->shift, k - 1), m, k - 1);
    return m->tangent_status |= patched ? any_tangent(dz, m, k) : free_end(dz, m, k, true);
  }
  struct num_vec before;
  int s = tangent(&before, m, k - 1);
  if (s == SS_OK) s = m->finite ? difference(dz, m, k, &before) : first_order(dz, m, k, &before);
  return m->tangent_status |= s;
}

/* Z, or the perturbed one. */
static int some_state(struct num_vec *out, struct exact_motion *m, int k, bool perturbed) {
  struct num_vec z, dz;
  int s = state(&z, m, k);
  num_vec_set(out, &z);
  if (!perturbed || s != SS_OK) return s;
  s = tangent(&dz, m, k);
  for (int i = 0; s == SS_OK && i < 4; i++) s = op(num_exact.add, at(out, i), m, at(out, i), at(&dz, i));
  return s;
}

/* --- Names --- */

static bool has_word(const struct exact_motion *m) {
  return m->kind == POINT_ARC || m->kind == POINT_ORBIT || m->kind == POINT_PATCHED;
}

/* The last switch before the time t, or at it. */
static int end_now(const struct exact_motion *m) {
  return (int)m->phase + (m->attempt.time == TIME_END);
}

/* The time t: on an arc that of the phases before, of the perturbed motion where there is one, and tau. */
static int time_now(element *z, struct exact_motion *m) {
  if (!has_word(m)) return exact_symbol(z, m->field, "t");
  struct num_vec w, dz;
  vec_init(&w, 1);
  int s = m->attempt.time == TIME_INSIDE ? exact_symbol(z, m->field, "tau") : num_exact.set_d(z, 0, 0);
  for (int k = 0; s == SS_OK && k < end_now(m); k++) {
    s = length(at(&w, 0), m, k);
    if (s == SS_OK) s = op(num_exact.add, z, m, z, at(&w, 0));
    if (s != SS_OK || !m->finite) continue;
    s = tangent(&dz, m, k + 1);
    if (s == SS_OK) s = op(num_exact.add, z, m, z, at(&m->shift, k));
  }
  num_vec_clear(&w);
  return s;
}

/* Z(t) or, for the second derivative, its rate. */
static int state_now(struct num_vec *out, struct exact_motion *m, bool rate) {
  static const char *const start[] = {"z_1(0)", "z_2(0)", "z_1'(0)", "z_2'(0)"};
  struct num_vec p, u;
  vec_init(&p, 16);
  vec_init(&u, 1);
  int s = exact_symbol(at(&u, 0), m->field, has_word(m) ? "tau" : "t");
  if (has_word(m) && m->attempt.time != TIME_INSIDE) num_exact.set_d(at(&u, 0), 0, 0);
  if (has_word(m)) s |= some_state(out, m, end_now(m), m->finite);
  for (int i = 0; !has_word(m) && i < 4; i++) s |= exact_symbol(at(out, i), m->field, start[i]);
  s |= exact_propagator(&p, m, m->phase, at(&u, 0));
  if (s == SS_OK) s = multiply(out, m, &p, out, 4, 4, 1);
  if (s == SS_OK && rate) s = rate_of(out, m, (int)m->phase, out);
  num_vec_clear(&u);
  num_vec_clear(&p);
  return s;
}

static int unknown(struct exact_motion *m, const char *name) {
  if (!*m->unbound) snprintf(m->unbound, sizeof m->unbound, "%s", name);
  return SS_UNABLE;
}

static int motion_value(element *z, struct exact_motion *m, const char *name, int component, int primes,
                        const char *argument) {
  struct num_vec out;
  vec_init(&out, 4);
  int s = SS_OK, k = name_of_switching_time(argument);
  if (m->kind == POINT_FLOW && strcmp(argument, "(0)") == 0 && primes < 2)
    s = exact_symbol(at(&out, component + 2 * primes), m->field, name);
  else if (m->kind != POINT_PARAMS && strcmp(argument, "(t)") == 0)
    s = state_now(&out, m, primes == 2);
  else if (has_word(m) && primes < 2 && k >= 0 && (k < 4 || m->finite))
    s = some_state(&out, m, k % 4 + 1, k >= 4);
  else
    s = unknown(m, name);
  if (s == SS_OK) num_exact.set(z, at(&out, component + (primes ? 2 : 0)));
  num_vec_clear(&out);
  return s;
}

static int bind_motion(element *z, struct exact_motion *m, const char *name) {
  bool in_x;
  int component, primes;
  const char *argument;
  if (!name_of_motion(name, &in_x, &component, &primes, &argument)) return unknown(m, name);
  int s = motion_value(z, m, name, component, primes, argument);
  if (s != SS_OK || !in_x || primes) return s;
  struct num_vec d;
  vec_init(&d, 1);
  s = exact_motion_oracle(&d, m, component ? "d_02" : "d_01");
  if (s == SS_OK) s = op(num_exact.add, z, m, z, at(&d, 0));
  num_vec_clear(&d);
  return s;
}

static int bind_tangent(element *z, struct exact_motion *m, int index) {
  struct num_vec dz;
  int s = tangent(&dz, m, index >= 100 ? index - 99 : index / 4);
  num_exact.set(z, index >= 100 ? at(&m->shift, index - 100) : at(&dz, index % 4));
  return s;
}

/* The motion's parameters as those of a point, for what is defined for every number type; clear q. */
static int as_values(struct values *v, struct exact_motion *m, const struct point *p) {
  *v = (struct values){.ctx = num_ctx_exact(), .point = p, .params = m->params};
  vec_init(&v->q, N_Q);
  for (int i = 0; i < N_PARAMS; i++) num_exact.set(at(&v->q, Q_CHI + i), at(&m->params, i));
  return exact_symbol(at(&v->q, Q_US1), m->field, "u_s1") | exact_symbol(at(&v->q, Q_US2), m->field, "u_s2");
}

/* omega_3 is the root of an element, and t' is t/omega_3. */
static int block_time(element *z, struct exact_motion *m, struct values *v, bool old_time) {
  int s = springs_square_of_omega_3(z, v);
  if (s == SS_OK) s = exact_sqrt(z, m->field, z);
  if (s == SS_OK && old_time) s = op(num_exact.div, z, m, at(&v->t, 0), z);
  return s;
}

/* The blocks and springs behind (1): value/springs.c.  The friction of a mass that sticks is read off the motion. */
static bool bind_block(int *status, element *z, struct exact_motion *m, const char *name) {
  const struct point p = {.kind = POINT_FLOW, .phase = m->phase};
  struct values v;
  bool old_time = strcmp(name, "t_prime") == 0, known = true;
  int s = as_values(&v, m, &p);
  vec_init(&v.zt, N_STATE);
  vec_init(&v.t, 1);
  s |= exact_symbol(at(&v.t, 0), m->field, "t");
  if (name[0] == 'u' || name[0] == 'F') s |= state_now(&v.zt, m, false);
  if (old_time || strcmp(name, "omega_3") == 0)
    *status = block_time(z, m, &v, old_time);
  else
    known = springs_bind(status, z, &v, name);
  if (known) *status |= s;
  if (known && *status == SS_OK) *status = exact_reduce(z, m->field);
  num_vec_clear(&v.t);
  num_vec_clear(&v.zt);
  num_vec_clear(&v.q);
  return known;
}

static int bind_state(element *z, struct exact_motion *m, int k, int component) {
  struct num_vec v;
  int s = state(&v, m, k);
  num_exact.set(z, at(&v, component));
  return s;
}

static int bind_arc(element *z, struct exact_motion *m, int index) {
  return index >= 100 ? length(z, m, index % 100) : bind_state(z, m, index / 4 % 4, index % 4);
}

/* e_1 and e_2 are known once the states are that decide them. */
static int bind_param(element *z, struct exact_motion *m, int i) {
  struct num_vec v;
  int s = SS_OK, end = i == P_E1 ? 1 : 2;
  if (i >= P_E1 && has_word(m) && m->kind != POINT_PATCHED && m->attempt.anchor < end && m->first_state < end)
    s = state(&v, m, end);
  num_exact.set(z, at(&m->params, i));
  return s;
}

/* N Z_0 = Z_0 on a periodic motion, solved for the column of N that multiplies z_1'. */
static int periodic_entry(element *z, struct exact_motion *m, int row) {
  struct num_vec v, w;
  vec_init(&w, 1);
  char name[16];
  m->used_matrix = true;
  int s = state(&v, m, 0);
  num_exact.set(z, at(&v, row - 1));
  for (int j = 1; s == SS_OK && j <= 4; j++) {
    if (j == 3) continue;
    snprintf(name, sizeof name, "N[%d,%d]", row, j);
    s = exact_symbol(at(&w, 0), m->field, name);
    if (s == SS_OK) s = op(num_exact.mul, at(&w, 0), m, at(&w, 0), at(&v, j - 1));
    if (s == SS_OK) s = op(num_exact.sub, z, m, z, at(&w, 0));
  }
  if (s == SS_OK) s = op(num_exact.div, z, m, z, at(&v, 2));
  num_vec_clear(&w);
  return s;
}

/* The number of the state of which "S_a", "S_b" or "S_c" is the name, or the start of one; 0 for another name. */
static int meeting(const char *name) {
  static const char places[] = "abc";
  const char *c = strncmp(name, "S_", 2) == 0 && name[2] ? strchr(places, name[2]) : NULL;
  return c ? (int)(c - places) + 1 : 0;
}

/* "J_a[1,2]": a matrix held as unknowns; S_a, S_b, S_c are the motion's states; of the matrix of the period it is known what it does to its own start. */
static int bind_entry(element *z, struct exact_motion *m, const char *name) {
  int row, col, end = meeting(name);
  if (has_word(m) && end > 0 && sscanf(name + 3, "[%d,1]", &row) == 1) {
    m->used_matrix = true;
    return bind_state(z, m, end, row - 1);
  }
  if (is_periodic(m) && sscanf(name, "N[%d,%d]", &row, &col) == 2 && col == 3) return periodic_entry(z, m, row);
  return exact_symbol(z, m->field, name);
}

int exact_motion_bind(element *z, struct exact_field *f, const char *name, void *motion) {
  static const char *const params[] = {"chi", "eta", "V", "e_1", "e_2"};
  static const char *const free_names[] = {"u_s1", "u_s2", "lambda"};
  struct exact_motion *m = motion;
  int index, status;
  for (int i = 0; i < N_PARAMS; i++)
    if (strcmp(name, params[i]) == 0) return bind_param(z, m, i);
  for (size_t i = 0; i < sizeof free_names / sizeof *free_names; i++)
    if (strcmp(name, free_names[i]) == 0) return exact_symbol(z, f, name);
  if (strcmp(name, "t") == 0) return time_now(z, m);
  if (strcmp(name, "u_r1") == 0 || strcmp(name, "u_r2") == 0) {
    struct num_vec w;
    vec_init(&w, 1);
    int s = bind_param(at(&w, 0), m, name[3] == '1' ? P_E1 : P_E2);
    s |= exact_symbol(z, f, name[3] == '1' ? "u_s1" : "u_s2");
    if (s == SS_OK) s = op(num_exact.add, z, m, z, at(&w, 0));
    num_vec_clear(&w);
    return s;
  }
  if (strchr(name, '[')) return bind_entry(z, m, name);
  if (has_word(m) && (index = name_of_arc(name)) >= 0) return bind_arc(z, m, index);
  if (is_periodic(m) && (strcmp(name, "z_100") == 0 || strcmp(name, "z_200") == 0))
    return bind_arc(z, m, name[2] == '1' ? Z_1 : Z_2);
  if (has_word(m) && name_of_tangent(name, &index)) return bind_tangent(z, m, index);
  if (m->kind == POINT_FLOW && bind_block(&status, z, m, name)) return status;
  return bind_motion(z, m, name);
}

int exact_motion_positive(struct num_vec *out, struct exact_motion *m) {
  int n = 0, s = SS_OK;
  if (m->attempt.modes) return 0; /* chi and eta are no polynomials then */
  for (int i = P_CHI; i <= P_V; i++) num_exact.set(at(out, n++), at(&m->params, i));
  s |= num_exact.set_d(at(out, n), 1, 0);
  s |= num_exact.sub(at(out, n), at(out, n), at(&m->params, P_CHI), 0);
  n++;
  if (has_word(m) && !m->finite && m->attempt.time == TIME_INSIDE) {
    s |= exact_symbol(at(out, n), m->field, "tau");
    s |= length(at(out, n + 1), m, (int)m->phase);
    s |= num_exact.sub(at(out, n + 1), at(out, n + 1), at(out, n), 0);
    n += 2;
  }
  return s == SS_OK ? n : 0;
}

/* --- What a sentence reads --- */

static void note(int *first, int k) {
  if (k < *first) *first = k;
}

static void note_motion(struct exact_motion *m, const char *argument) {
  int k = name_of_switching_time(argument);
  int end = k >= 0 ? k % 4 + 1 : end_now(m);
  note(&m->first_state, end);
  if (m->finite) note(&m->first_tangent, end);
}

static void note_reads(struct exact_motion *m, const struct tape *t) {
  m->first_state = m->first_tangent = 4;
  for (slong i = 0; has_word(m) && i < t->n_inputs; i++) {
    bool in_x;
    int index, component, primes;
    const char *argument, *name = t->inputs[i];
    if ((index = name_of_arc(name)) >= 0) {
      if (index < 100) note(&m->first_state, index / 4);
    } else if (name_of_tangent(name, &index)) {
      note(&m->first_tangent, index >= 100 ? index - 100 : index / 4);
      if (index >= 100) note(&m->first_state, index - 100);
    } else if (name_of_motion(name, &in_x, &component, &primes, &argument)) {
      note_motion(m, argument);
    } else if (strchr(name, '[')) { /* what a matrix held as unknowns does to the start */
      note(&m->first_state, 0);
    }
  }
}

void exact_motion_init(struct exact_motion *m, const struct exact_attempt *a, const struct point_spec *spec,
                       bool finite, const struct restriction *restriction, const struct tape *reads) {
  *m = (struct exact_motion){
      .attempt = *a, .kind = spec->kind, .phase = spec->phase, .finite = finite, .restriction = restriction};
  m->field = exact_field_new(NULL, 0);
  exact_field_limit(m->field, TERMS);
  exact_field_bind(m->field, exact_motion_bind, m);
  vec_init(&m->frequency, 2);
  vec_init(&m->params, N_PARAMS);
  vec_init(&m->state, 20);
  vec_init(&m->tangent, 20);
  vec_init(&m->shift, 4);
  note_reads(m, reads);
  m->state_status = take_params(m);
}

void exact_motion_clear(struct exact_motion *m) {
  num_vec_clear(&m->shift);
  num_vec_clear(&m->tangent);
  num_vec_clear(&m->state);
  num_vec_clear(&m->params);
  num_vec_clear(&m->frequency);
  exact_field_free(m->field);
}

/* --- The model's matrices --- */

/* The 4x4 derivative of the event-located map of a phase: column by column what it makes of a perturbation. */
static int local_jacobian(struct num_vec *j, struct exact_motion *m, int phase) {
  struct num_vec z, f, col, dt, p, u;
  vec_init(&f, 4);
  vec_init(&col, 4);
  vec_init(&dt, 1);
  vec_init(&p, 16);
  vec_init(&u, 1);
  int s = state(&z, m, phase + 1);
  s |= rate_of(&f, m, phase, &z);
  s |= length(at(&u, 0), m, phase);
  s |= exact_propagator(&p, m, (enum phase)phase, at(&u, 0));
  for (int k = 0; s == SS_OK && k < 4; k++) {
    for (int i = 0; i < 4; i++) num_exact.set(at(&col, i), at(&p, 4 * i + k));
    s = delay(at(&dt, 0), m, phase + 1, &col, &z);
    for (int i = 0; s == SS_OK && i < 4; i++) {
      s = op(num_exact.mul, at(j, 4 * i + k), m, at(&f, i), at(&dt, 0));
      if (s == SS_OK) s = op(num_exact.add, at(j, 4 * i + k), m, at(j, 4 * i + k), at(&col, i));
    }
  }
  num_vec_clear(&u);
  num_vec_clear(&p);
  num_vec_clear(&dt);
  num_vec_clear(&col);
  num_vec_clear(&f);
  return s;
}

static int corner(struct num_vec *out, struct exact_motion *m, int phase) {
  struct num_vec j;
  vec_init(&j, 16);
  int s = local_jacobian(&j, m, phase);
  if (s == SS_OK) s = local_map_corner(out, &local_maps[phase], &j, at(&m->params, P_CHI));
  if (s == SS_OK) s = reduce_all(out, m);
  num_vec_clear(&j);
  return s;
}

static int period_matrix(struct num_vec *out, struct exact_motion *m) {
  struct num_vec p, u;
  vec_init(&p, 16);
  vec_init(&u, 1);
  int s = SS_OK;
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    s = length(at(&u, 0), m, ph);
    if (s == SS_OK) s = exact_propagator(&p, m, (enum phase)ph, at(&u, 0));
    if (ph == 0)
      num_vec_set(out, &p);
    else if (s == SS_OK)
      s = multiply(out, m, &p, out, 4, 4, 4);
  }
  num_vec_clear(&u);
  num_vec_clear(&p);
  return s;
}

/* --- The Jacobian of the period, from its corners --- */

/* Column k of what a corner takes in, as a perturbation. */
static int direction(struct num_vec *v, struct exact_motion *m, int phase, int k) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    enum entering in = local_maps[phase].in[k][i];
    s |= num_exact.set_d(at(v, i), in != STAYS_OUT, 0);
    if (in == ENTERS_BY_CHI) num_exact.set(at(v, i), at(&m->params, P_CHI));
  }
  return s;
}

/* Does the phase carry the perturbations of its corner's columns to those of the next corner's, as the corner says? */
static bool hands_over(struct exact_motion *m, int phase) {
  const struct local_map *map = &local_maps[phase];
  struct num_vec j, c, v, w;
  vec_init(&j, 16);
  vec_init(&c, map->rows * map->cols);
  vec_init(&v, 4);
  vec_init(&w, 4);
  int s = local_jacobian(&j, m, phase);
  if (s == SS_OK) s = corner(&c, m, phase);
  for (int k = 0; s == SS_OK && k < map->cols; k++) {
    s = direction(&v, m, phase, k);
    if (s == SS_OK) s = multiply(&v, m, &j, &v, 4, 4, 1);
    for (int r = 0; s == SS_OK && r < map->rows; r++) {
      s = direction(&w, m, phase + 1, r);
      for (int i = 0; s == SS_OK && i < 4; i++) {
        s = op(num_exact.mul, at(&w, i), m, at(&w, i), at(&c, r * map->cols + k));
        if (s == SS_OK) s = op(num_exact.sub, at(&v, i), m, at(&v, i), at(&w, i));
      }
    }
    for (int i = 0; i < 4; i++)
      if (!exact_is_zero(m->field, at(&v, i))) s |= SS_UNABLE;
  }
  num_vec_clear(&w);
  num_vec_clear(&v);
  num_vec_clear(&c);
  num_vec_clear(&j);
  return s == SS_OK;
}

/* The product of the corners, held as unknowns, once it is known that each phase hands over to the next. */
static int return_jacobian(struct num_vec *out, struct exact_motion *m) {
  struct num_vec c, sum;
  char name[32];
  int s = SS_OK;
  m->used_matrix = true;
  for (int ph = 0; ph + 1 < N_PHASES; ph++)
    if (!hands_over(m, ph)) return SS_UNABLE;
  vec_init(&sum, 6);
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    const struct local_map *map = &local_maps[ph];
    vec_init(&c, map->rows * map->cols);
    for (int i = 0; i < map->rows * map->cols; i++) {
      snprintf(name, sizeof name, "%s[%d,%d]", map->name, i / map->cols + 1, i % map->cols + 1);
      s |= exact_symbol(at(&c, i), m->field, name);
    }
    struct num_vec before = part(&sum, 0, map->cols * 2), after = part(&sum, 0, map->rows * 2);
    if (ph == 0)
      num_vec_set(&after, &c);
    else if (s == SS_OK)
      s = multiply(&after, m, &c, &before, map->rows, map->cols, 2);
    num_vec_clear(&c);
  }
  for (int i = 0; i < 4; i++) num_exact.set(at(out, i), at(&sum, i));
  num_vec_clear(&sum);
  return s;
}

/* Quantities of the parameters alone, as for every number type. */
static int of_params(struct num_vec *out, struct exact_motion *m, const char *name) {
  const struct point p = {.kind = POINT_PARAMS};
  struct values v;
  int s = as_values(&v, m, &p);
  s |= oracle_eval(out, oracle_find(name), &v);
  num_vec_clear(&v.q);
  return s ? s : reduce_all(out, m);
}

/* "dZ_0", "dZ_a", ... "dZ_f": 0 to 4; -1 for another name. */
static int perturbation_named(const char *name) {
  static const char ends_of[] = "0abcf";
  const char *c = strncmp(name, "dZ_", 3) == 0 && name[3] && !name[4] ? strchr(ends_of, name[3]) : NULL;
  return c ? (int)(c - ends_of) : -1;
}

int exact_motion_oracle(struct num_vec *out, struct exact_motion *m, const char *name) {
  static const char *const rational[] = {"K", "K_1", "K_2", "d_01", "d_02"};
  for (size_t i = 0; i < sizeof rational / sizeof *rational; i++)
    if (strcmp(name, rational[i]) == 0) return of_params(out, m, name);
  for (int ph = 0; ph < N_PHASES; ph++) {
    char propagator[16];
    snprintf(propagator, sizeof propagator, "%s(t)", phase_name[ph]);
    if (strcmp(name, local_maps[ph].name) == 0) return corner(out, m, ph);
    if (strcmp(name, propagator) != 0) continue;
    struct num_vec u;
    vec_init(&u, 1);
    int s = exact_symbol(at(&u, 0), m->field, "t");
    if (s == SS_OK) s = exact_propagator(out, m, (enum phase)ph, at(&u, 0));
    num_vec_clear(&u);
    return s;
  }
  if (strcmp(name, "N") == 0) return period_matrix(out, m);
  if (has_word(m) && meeting(name)) {
    struct num_vec z;
    int s = state(&z, m, meeting(name));
    num_vec_set(out, &z);
    return s;
  }
  int end = m->kind == POINT_PATCHED ? perturbation_named(name) : -1;
  if (end >= 0) {
    struct num_vec dz;
    int s = tangent(&dz, m, end);
    num_vec_set(out, &dz);
    return s;
  }
  if (strcmp(name, "J") == 0) return return_jacobian(out, m);
  if (strcmp(name, "omega_1") == 0 || strcmp(name, "omega_2") == 0) {
    m->wants_modes = !m->attempt.modes;
    if (!m->attempt.modes) return SS_UNABLE;
    num_exact.set(at(out, 0), at(&m->frequency, name[6] - '1'));
    return SS_OK;
  }
  return unknown(m, name);
}
