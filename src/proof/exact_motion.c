/* What the paper's symbols stand for on an exact motion: each name is taken apart (value/names.c) and made of the
   motion's parameters, states and perturbations.  Before anything is made, the names that a sentence reads are looked
   through for the earliest state it needs, since what lies before need not be computed. */
#include <stdio.h>
#include <string.h>

#include "exact_motion_impl.h"
#include "num/calc.h"

/* The last switch before the time t, or at it. */
static int end_now(const struct exact_motion *m) {
  return (int)m->spec.phase + (m->attempt.time == TIME_END);
}

/* The time t: on an arc that of the phases before, of the perturbed motion where there is one, and tau. */
static int time_now(element *z, struct exact_motion *m) {
  if (!has_word(m)) return exact_symbol(z, m->field, "t");
  struct num_vec w = calc_vec(&m->c, 1), dz;
  int s = m->attempt.time == TIME_INSIDE ? exact_symbol(z, m->field, "tau") : num_exact.set_d(z, 0, 0);
  for (int k = 0; s == SS_OK && k < end_now(m); k++) {
    s = motion_length(at(&w, 0), m, k);
    if (s == SS_OK) s = motion_op(num_exact.add, z, m, z, at(&w, 0));
    if (s != SS_OK || !m->spec.finite) continue;
    s = motion_tangent(&dz, m, k + 1);
    if (s == SS_OK) s = motion_op(num_exact.add, z, m, z, at(&m->shift, k));
  }
  return s;
}

/* Z(t) or, for the second derivative, its rate. */
static int state_now(struct num_vec *out, struct exact_motion *m, bool rate) {
  static const char *const start[] = {"z_1(0)", "z_2(0)", "z_1'(0)", "z_2'(0)"};
  if (m->have_now[rate]) *out = m->now[rate];
  if (m->have_now[rate]) return SS_OK;
  struct num_vec p = calc_vec(&m->c, 16), u = calc_vec(&m->c, 1);
  int s = exact_symbol(at(&u, 0), m->field, has_word(m) ? "tau" : "t");
  if (has_word(m) && m->attempt.time != TIME_INSIDE) num_exact.set_d(at(&u, 0), 0, 0);
  if (has_word(m)) s |= motion_perturbed(out, m, end_now(m), m->spec.finite);
  for (int i = 0; !has_word(m) && i < 4; i++) s |= exact_symbol(at(out, i), m->field, start[i]);
  s |= exact_propagator(&p, m, m->spec.phase, at(&u, 0));
  if (s == SS_OK) s = motion_multiply(out, m, &p, out, 4, 4, 1);
  if (s == SS_OK && rate) s = motion_rate(out, m, (int)m->spec.phase, out);
  m->now[rate] = *out;
  m->have_now[rate] = s == SS_OK;
  return s;
}

static int value_of_motion(element *z, struct exact_motion *m, const char *name, const struct motion_name *n) {
  struct num_vec out = calc_vec(&m->c, 4);
  int s = SS_OK, k = name_of_switching_time(n->argument);
  if (m->spec.kind == POINT_FLOW && strcmp(n->argument, "(0)") == 0 && n->primes < 2)
    s = exact_symbol(at(&out, n->component + 2 * n->primes), m->field, name);
  else if (m->spec.kind != POINT_PARAMS && strcmp(n->argument, "(t)") == 0)
    s = state_now(&out, m, n->primes == 2);
  else if (has_word(m) && n->primes < 2 && k >= 0 && (k <= N_PHASES || m->spec.finite))
    s = motion_perturbed(&out, m, k > N_PHASES ? k - N_PHASES : k, k > N_PHASES);
  else
    s = motion_unknown(m, name);
  if (s == SS_OK) num_exact.set(z, at(&out, n->component + (n->primes ? 2 : 0)));
  return s;
}

static int bind_motion(element *z, struct exact_motion *m, const char *name) {
  struct motion_name n;
  if (!name_of_motion(&n, name)) return motion_unknown(m, name);
  int s = value_of_motion(z, m, name, &n);
  if (s != SS_OK || !n.in_x || n.primes) return s;
  struct num_vec d = calc_vec(&m->c, 1);
  s = motion_of_params(&d, m, n.component ? "d_02" : "d_01");
  return s == SS_OK ? motion_op(num_exact.add, z, m, z, at(&d, 0)) : s;
}

static int bind_tangent(element *z, struct exact_motion *m, int index) {
  struct num_vec dz;
  int s = motion_tangent(&dz, m, index >= 100 ? index - 99 : index / 4);
  num_exact.set(z, index >= 100 ? at(&m->shift, index - 100) : at(&dz, index % 4));
  return s;
}

/* omega_3 is the root of an element, and t' is t/omega_3. */
static int block_time(element *z, struct exact_motion *m, struct values *v, bool old_time) {
  int s = springs_square_of_omega_3(z, v);
  if (s == SS_OK) s = exact_sqrt(z, m->field, z);
  if (s == SS_OK && old_time) s = motion_op(num_exact.div, z, m, at(&v->t, 0), z);
  return s;
}

/* The blocks and springs behind (1): value/springs.c.  The friction of a mass that sticks is read off the motion. */
static bool bind_block(int *status, element *z, struct exact_motion *m, const char *name) {
  const struct point p = {.kind = POINT_FLOW, .phase = m->spec.phase};
  struct values v;
  bool old_time = strcmp(name, "t_prime") == 0, known = true;
  int s = motion_as_values(&v, m, &p);
  v.zt = calc_vec(&m->c, N_STATE);
  v.t = calc_vec(&m->c, 1);
  s |= exact_symbol(at(&v.t, 0), m->field, "t");
  if (name[0] == 'u' || name[0] == 'F') s |= state_now(&v.zt, m, false);
  if (old_time || strcmp(name, "omega_3") == 0)
    *status = block_time(z, m, &v, old_time);
  else
    known = springs_bind(status, z, &v, name);
  if (known) *status |= s;
  if (known && *status == SS_OK) *status = exact_reduce(z, m->field);
  return known;
}

static int bind_state(element *z, struct exact_motion *m, int k, int component) {
  struct num_vec v;
  int s = motion_state(&v, m, k);
  num_exact.set(z, at(&v, component));
  return s;
}

static int bind_arc(element *z, struct exact_motion *m, int index) {
  return index >= 100 ? motion_length(z, m, index % 100) : bind_state(z, m, index / 4 % 4, index % 4);
}

/* e_1 and e_2 are known once the states are that decide them. */
static int bind_param(element *z, struct exact_motion *m, int i) {
  struct num_vec v;
  int s = SS_OK, end = i == P_E1 ? 1 : 2;
  if (i >= P_E1 && has_word(m) && m->spec.kind != POINT_PATCHED && m->attempt.anchor < end && m->first_state < end)
    s = motion_state(&v, m, end);
  num_exact.set(z, at(&m->params, i));
  return s;
}

/* N Z_0 = Z_0 on a periodic motion, solved for the column of N that multiplies z_1'. */
static int periodic_entry(element *z, struct exact_motion *m, int row) {
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec v;
  char name[32];
  m->used_matrix = true;
  c.status = motion_state(&v, m, 0);
  val rest = at(&v, row - 1);
  for (int j = 1; c.status == SS_OK && j <= 4; j++) {
    if (j == 3) continue;
    void *entry = calc_new(&c);
    snprintf(name, sizeof name, "N[%d,%d]", row, j);
    c.status = exact_symbol(entry, m->field, name);
    rest = calc_sub(&c, rest, calc_mul(&c, entry, at(&v, j - 1)));
  }
  calc_store(&c, z, calc_div(&c, rest, at(&v, 2)));
  return c.status;
}

/* "J_a[1,2]": a matrix held as unknowns; S_a, S_b, S_c are the motion's states; of the matrix of the period it is known
   what it does to its own start. */
static int bind_entry(element *z, struct exact_motion *m, const char *name) {
  int row, col, end = motion_meeting(name);
  if (has_word(m) && end > 0 && sscanf(name + 3, "[%d,1]", &row) == 1) {
    m->used_matrix = true;
    return bind_state(z, m, end, row - 1);
  }
  if (is_periodic(m) && sscanf(name, "N[%d,%d]", &row, &col) == 2 && col == 3) return periodic_entry(z, m, row);
  return exact_symbol(z, m->field, name);
}

int exact_motion_bind(element *z, struct exact_field *f, const char *name, void *motion) {
  static const char *const free_names[] = {"u_s1", "u_s2", "lambda"};
  struct exact_motion *m = motion;
  int index, status, param = word_find(name, name_param, N_PARAMS);
  bool own = m->spec.paper && model_own_symbol(m->spec.paper, name);
  if (own || strcmp(name, expr_pi) == 0) {
    m->beyond = true;
    return exact_symbol(z, f, name);
  }
  if (m->bare) return motion_unknown(m, name);
  if (param < N_PARAMS) return bind_param(z, m, param);
  if (word_find(name, free_names, 3) < 3) return exact_symbol(z, f, name);
  if (strcmp(name, "t") == 0) return time_now(z, m);
  if (strcmp(name, "u_r1") == 0 || strcmp(name, "u_r2") == 0) {
    struct num_vec w = calc_vec(&m->c, 1);
    int s = bind_param(at(&w, 0), m, name[3] == '1' ? P_E1 : P_E2);
    s |= exact_symbol(z, f, name[3] == '1' ? "u_s1" : "u_s2");
    return s == SS_OK ? motion_op(num_exact.add, z, m, z, at(&w, 0)) : s;
  }
  if (strchr(name, '[')) return bind_entry(z, m, name);
  if (has_word(m) && (index = name_of_arc(name)) >= 0) return bind_arc(z, m, index);
  if (is_periodic(m) && (strcmp(name, "z_100") == 0 || strcmp(name, "z_200") == 0))
    return bind_arc(z, m, name[2] == '1' ? Z_1 : Z_2);
  if (has_word(m) && (index = name_of_tangent(name)) >= 0) return bind_tangent(z, m, index);
  if (m->spec.kind == POINT_FLOW && bind_block(&status, z, m, name)) return status;
  return bind_motion(z, m, name);
}

/* What is positive of the parameters; with modes chi eta = w_1^2 + w_2^2 - 1, chi = (1 - w_1^2)(w_2^2 - 1)/(chi eta)
   and 1 - chi = (w_1 w_2)^2/(chi eta) are products of it. */
static int positive_params(struct num_vec *out, int *n, struct exact_motion *m) {
  OWNED(calc) c = exact_calc(m->field);
  val one = calc_d(&c, 1);
  calc_store(&c, at(out, (*n)++), at(&m->params, P_V));
  if (m->attempt.modes) {
    val w1 = at(&m->frequency, 0), w2 = at(&m->frequency, 1);
    val list[] = {w1,
                  w2,
                  calc_sub(&c, one, w1),
                  calc_add(&c, one, w1),
                  calc_sub(&c, w2, one),
                  calc_add(&c, w2, one),
                  calc_sub(&c, calc_dot(&c, w1, w1, w2, w2), one)};
    for (int i = 0; i < COUNT(list); i++) calc_store(&c, at(out, (*n)++), list[i]);
  } else {
    calc_store(&c, at(out, (*n)++), at(&m->params, P_CHI));
    calc_store(&c, at(out, (*n)++), at(&m->params, P_ETA));
    calc_store(&c, at(out, (*n)++), calc_sub(&c, one, at(&m->params, P_CHI)));
  }
  return c.status;
}

int exact_motion_positive(struct num_vec *out, struct exact_motion *m) {
  int n = 0, s = positive_params(out, &n, m);
  if (has_word(m) && !m->spec.finite && m->attempt.time == TIME_INSIDE) {
    s |= exact_symbol(at(out, n), m->field, "tau");
    s |= motion_length(at(out, n + 1), m, (int)m->spec.phase);
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
  int end = k > N_PHASES ? k - N_PHASES : k >= 0 ? k : end_now(m);
  note(&m->first_state, end);
  if (m->spec.finite) note(&m->first_tangent, end);
}

static void note_reads(struct exact_motion *m, const struct tape *t) {
  m->first_state = m->attempt.anchor == ANCHOR_BACK ? 0 : 4;
  m->first_tangent = 4;
  for (slong i = 0; t && has_word(m) && i < t->n_inputs; i++) {
    int index;
    struct motion_name motion;
    const char *name = t->inputs[i];
    if ((index = name_of_arc(name)) >= 0) {
      if (index < 100) note(&m->first_state, index / 4);
    } else if ((index = name_of_tangent(name)) >= 0) {
      note(&m->first_tangent, index >= 100 ? index - 100 : index / 4);
      if (index >= 100) note(&m->first_state, index - 100);
    } else if (name_of_motion(&motion, name)) {
      note_motion(m, motion.argument);
    } else if (strchr(name, '[')) { /* what a matrix held as unknowns does to the start */
      note(&m->first_state, 0);
    }
  }
}

/* high - low, which is not negative, or is positive. */
static void add_own(struct exact_motion *m, const element *low, const element *high) {
  if (motion_op(num_exact.sub, at(&m->own, m->n_own), m, high, low) == SS_OK) m->n_own++;
}

/* What the domain of a symbol says: the symbol, where that is positive, and how far it is from both ends. */
static void add_domain(struct exact_motion *m, const struct symbol *s, bool strict) {
  OWNED(calc) c = exact_calc(m->field);
  element *x = calc_new(&c);
  if (exact_symbol(x, m->field, s->name) != SS_OK) return;
  if (strict && s->low.bounded && fmpq_sgn(s->low.at) > 0) add_own(m, calc_d(&c, 0), x);
  if (s->low.bounded && s->low.closed != strict) add_own(m, calc_q(&c, s->low.at), x);
  if (s->high.bounded && s->high.closed != strict) add_own(m, x, calc_q(&c, s->high.at));
}

void exact_motion_given(struct exact_motion *m, const struct sentence *s) {
  const struct model *paper = m->spec.paper;
  if (!paper || !paper->n_own) return;
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec side = {.len = 0};
  bool read = m->bare && s->n_given && exact_eval(&side, &c, m->field, &s->given) == SS_OK;
  slong n_given = read ? s->n_given : 0;
  m->own = calc_vec(&m->c, 3 * (slong)paper->n_own + n_given);
  for (int strict = 1; strict >= 0; strict--) {
    for (size_t i = 0; i < paper->n_symbols; i++)
      if (paper->symbols[i].has_domain && tape_input(&s->tape, paper->symbols[i].name) >= 0)
        add_domain(m, &paper->symbols[i], strict);
    for (slong i = 0; i < n_given; i++)
      if (s->given_closed[i] != strict) add_own(m, at(&side, i), at(&side, n_given + i));
    if (strict) m->n_strict = m->n_own;
  }
  exact_field_positive(m->field, at(&m->own, 0), m->n_own, m->n_strict);
}

void exact_motion_init(struct exact_motion *m, const struct exact_attempt *a, const struct point_spec *spec,
                       const struct tape *reads) {
  exact_motion_begin(m, a, spec);
  exact_field_bind(m->field, exact_motion_bind, m);
  note_reads(m, reads);
}
