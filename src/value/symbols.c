/* The values of the paper's symbols at a point: each name is taken apart and looked up in the values that were made for
   the point.  A name that has no value there, as a state of an orbit has none at bare parameters, is told from one
   whose value could not be computed. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "num/calc.h"
#include "values_impl.h"

static bool has_arc(const struct values *v) {
  return v->point->kind >= POINT_ARC;
}

/* A value of the arc's states or times by its name in the paper. */
static const void *arc_symbol(const struct values *v, const char *name) {
  int at = name_of_arc(name);
  if (at >= 0) return at >= 100 ? num_vec_at(&v->arc.t, at - 100) : num_vec_at(&v->arc.z, at);
  if (v->point->kind == POINT_ARC) return NULL; /* of the periodic solution */
  if (strcmp(name, "z_100") == 0) return num_vec_at(&v->arc.z, 0);
  if (strcmp(name, "z_200") == 0) return num_vec_at(&v->arc.z, 1);
  return NULL;
}

static const void *exact_symbol(struct values *v, const char *name) {
  int param = word_find(name, name_param, N_PARAMS), other = word_find(name, name_of_point, N_OF_POINT);
  if (param < N_PARAMS) return values_exact(v, Q_CHI + param);
  if (other < N_OF_POINT) return values_exact(v, Q_US1 + other);
  if (strcmp(name, "t") == 0)
    return v->point->kind == POINT_PARAMS || v->point->timed ? values_exact(v, Q_T) : num_vec_at(&v->t, 0);
  return NULL;
}

/* The motion at a sum of lengths of phases, in whichever phase it is then: t_b after its start still in the stick phase
   where t_b < t_a. */
static int state_after(struct num_vec *z, struct values *v, int lengths) {
  OWNED(calc) c = calc_begin(v->ctx);
  val rest = calc_d(&c, 0), zero = calc_d(&c, 0);
  for (int k = 0; k < N_PHASES; k++)
    if (lengths >> k & 1) rest = calc_add(&c, rest, num_vec_at(&v->arc.t, k));
  for (int k = 0; k < N_PHASES && c.status == SS_OK; k++) {
    val length = num_vec_at(&v->arc.t, k);
    truth within = v->ctx.type->lt(rest, length);
    const struct num_vec from = dyn_arc_state(&v->arc, k);
    if (!calc_lt(&c, zero, length) || within == TRUTH_UNKNOWN) return SS_UNABLE;
    if (within == TRUTH_TRUE) return dyn_flow(z, (enum phase)k, &v->params, &from, rest);
    rest = calc_sub(&c, rest, length);
  }
  return c.status | SS_UNABLE;
}

/* z at one of the times that the paper's sentences name: flows at 0 and t, arcs at 0, t and the switching times.  At
   the perturbed switching times the motion is the perturbed one; it has a value only where there is one. */
static int motion_value(void *z, bool *known, struct values *v, const struct motion_name *n) {
  const struct num_type *t = v->ctx.type;
  const int primes = n->primes, coordinate = n->component + 2 * primes; /* of the state */
  *known = true;
  if (v->point->kind == POINT_FLOW && strcmp(n->argument, "(0)") == 0 && primes < 2) {
    t->set(z, num_vec_at(&v->q, Q_Z1 + coordinate));
    return SS_OK;
  }
  if (v->point->kind != POINT_PARAMS && !v->point->timed && strcmp(n->argument, "(t)") == 0) {
    int s = values_time(v);
    t->set(z, primes == 2 ? num_vec_at(&v->azt, n->component + 2) : num_vec_at(&v->zt, coordinate));
    return s;
  }
  int k = name_of_switching_time(n->argument), lengths = name_of_lengths(n->argument);
  if (has_arc(v) && primes < 2 && k >= 0 && (k <= N_PHASES || v->point->finite)) {
    const struct dyn_arc *arc = k > N_PHASES ? &v->perturbed : &v->arc;
    t->set(z, num_vec_at(&arc->z, N_STATE * (k > N_PHASES ? k - N_PHASES : k) + coordinate));
    return SS_OK;
  }
  if (has_arc(v) && primes < 2 && lengths > 0) {
    struct num_vec at = calc_vec(&v->c, N_STATE);
    int s = state_after(&at, v, lengths);
    t->set(z, num_vec_at(&at, coordinate));
    return s;
  }
  *known = false;
  return SS_UNABLE;
}

/* x = z + d, so velocities and accelerations agree. */
static int bind_motion(void *z, bool *known, struct values *v, const struct motion_name *n) {
  int s = motion_value(z, known, v, n);
  if (s || !n->in_x || n->primes) return s;
  OWNED(num_vec) d;
  num_vec_init(&d, 1, v->ctx);
  s |= oracle_eval(&d, oracle_find(n->component ? "d_02" : "d_01"), v);
  s |= v->ctx.type->add(z, z, num_vec_at(&d, 0), v->ctx.prec);
  return s;
}

/* Made once for all of its entries. */
static const struct oracle_matrix *oracle_matrix(struct values *v, const struct oracle *o) {
  for (size_t i = 0; i < v->n_matrices; i++)
    if (v->matrices[i].of == o) return &v->matrices[i];
  struct oracle_matrix *m = SS_PUSH(v->matrices, v->n_matrices, v->cap_matrices);
  m->of = o;
  m->entry = calc_vec(&v->c, o->rows * o->cols);
  m->status = oracle_eval(&m->entry, o, v);
  return m;
}

/* "J_a[1,2]": an entry of one of the model's matrices. */
static int bind_entry(void *z, bool *known, struct values *v, const char *name, const char *bracket) {
  char base[32];
  size_t n = (size_t)(bracket - name);
  *known = false;
  if (n >= sizeof base) return SS_UNABLE;
  memcpy(base, name, n);
  base[n] = '\0';
  const struct oracle *o = oracle_find(base);
  int i = atoi(bracket + 1), j = atoi(strchr(bracket, ',') + 1);
  if (!o || i > o->rows || j > o->cols) return SS_UNABLE;
  *known = true;
  const struct oracle_matrix *m = oracle_matrix(v, o);
  v->ctx.type->set(z, num_vec_at(&m->entry, (i - 1) * o->cols + j - 1));
  return m->status;
}

static int bind_own(void *z, struct values *v, const struct symbol *own) {
  NUMBERS(fmpq, x);
  point_own_value(x, v->point, own);
  return v->ctx.type->set_q(z, x, v->ctx.prec);
}

bool values_names(const char *name) {
  static const char *const more[] = {"u_r1", "u_r2", "t", "z_100", "z_200"};
  enum { N_MORE = sizeof more / sizeof *more };
  struct motion_name motion;
  return word_find(name, name_param, N_PARAMS) < N_PARAMS || word_find(name, name_of_point, N_OF_POINT) < N_OF_POINT ||
         word_find(name, more, N_MORE) < N_MORE || name_of_arc(name) >= 0 || name_of_tangent(name) >= 0 ||
         springs_names(name) || name_of_motion(&motion, name) || strchr(name, '[');
}

int values_bind(void *z, bool *known, struct values *v, const char *name) {
  const struct num_type *t = v->ctx.type;
  *known = true;
  if (strcmp(name, expr_pi) == 0) return t->pi(z, v->ctx.prec);
  const struct symbol *own = v->point->paper ? model_own_symbol(v->point->paper, name) : NULL;
  if (own) return bind_own(z, v, own);
  if (!point_of_model(v->point)) {
    *known = false;
    return SS_UNABLE;
  }
  int status = strcmp(name, "t") == 0 && !v->point->timed ? values_time(v) : SS_OK;
  const void *p = exact_symbol(v, name);
  if (!p && has_arc(v)) p = arc_symbol(v, name);
  if (p) {
    t->set(z, p);
    return status;
  }
  if (strcmp(name, "u_r1") == 0) return t->add(z, values_exact(v, Q_US1), values_exact(v, Q_E1), v->ctx.prec);
  if (strcmp(name, "u_r2") == 0) return t->add(z, values_exact(v, Q_US2), values_exact(v, Q_E2), v->ctx.prec);
  int index = name_of_tangent(name);
  if (has_arc(v) && index >= 0) {
    int s = values_tangents(v);
    v->tangent_read |= 1U << index % 80; /* dt_a, of index 100, has bit 20 */
    t->set(z, index >= 100 ? num_vec_at(&v->dt, index - 100) : num_vec_at(&v->tangent, index));
    return s;
  }
  if (springs_bind(&status, z, v, name)) return status;
  struct motion_name motion;
  const char *bracket = strchr(name, '[');
  if (bracket) return bind_entry(z, known, v, name, bracket);
  if (name_of_motion(&motion, name)) return bind_motion(z, known, v, &motion);
  *known = false;
  return SS_UNABLE;
}

int values_bind_inputs(struct num_vec *in, const char **unbound, struct values *v, const struct tape *t) {
  int s = SS_OK;
  *unbound = NULL;
  for (slong i = 0; s == SS_OK && i < t->n_inputs; i++) {
    bool known;
    s |= values_bind(num_vec_at(in, i), &known, v, t->inputs[i]);
    if (!known) *unbound = t->inputs[i];
  }
  return s;
}

int values_eval(struct num_vec *out, const char **unbound, struct values *v, const struct tape *t) {
  struct num_vec in = calc_vec(&v->c, t->n_inputs);
  int s = values_bind_inputs(&in, unbound, v, t);
  return s == SS_OK ? tape_eval(out, NULL, t, &in) : s;
}
