/* Certificates: the numbers of a failure under the paper's names, inputs first. */
#include "certificate.h"

#include "value/values.h"

void certify_exact(struct certificate *c, struct judge *j, const char *name, const fmpq *x) {
  certificate_add(c, j->out, name, rational_text(j, x));
}

void certify_ball(struct certificate *c, struct judge *j, const char *name, const arb_t x) {
  certificate_add(c, j->out, name, ball_text(j, x, CERTIFIED_DIGITS));
}

void certify_params(struct certificate *c, struct judge *j, const fmpq *params) {
  for (int k = 0; k < N_PARAMS; k++) certify_exact(c, j, name_param[k], params + k);
}

void certify_member(struct certificate *c, struct judge *j, const fmpq *params, int vary, const fmpq *value,
                    slong prec) {
  NUMBERS(arb, x);
  arb_set_fmpq(x, value, prec);
  for (int k = 0; k < N_PARAMS; k++)
    if (k == vary)
      certify_ball(c, j, name_param[k], x);
    else
      certify_exact(c, j, name_param[k], params + k);
}

void certify_scene(struct certificate *c, struct judge *j) {
  for (int k = KEY_CHI; k <= KEY_E2; k++)
    if (j->scene->given[k]) certify_exact(c, j, name_param[k], &j->scene->value[k]);
}

void certify_orbit(struct certificate *c, struct judge *j, const struct dyn_orbit *o) {
  certify_ball(c, j, name_state[0][Z_1], o->z10);
  certify_ball(c, j, name_state[0][Z_2], o->z20);
  for (int k = 0; k < N_PHASES; k++) certify_ball(c, j, name_time[k], o->t[k]);
}

/* The paper's own symbols, as far as the sentence reads them. */
static void certify_own(struct certificate *c, struct judge *j, const struct point *p, const struct sentence *s) {
  NUMBERS(fmpq, x);
  const struct symbol *own;
  for (size_t i = 0; (own = point_own(&i, p, &s->tape, &s->given)) != NULL; i++) {
    point_own_value(x, p, own);
    certify_exact(c, j, own->name, x);
  }
}

/* Of a finite perturbation, which is (x, y)/1024, x or y as it is. */
static void value_of(fmpq_t x, const struct point *p, const struct point_quantity *row) {
  bool divided = p->finite && (row->q == Q_X || row->q == Q_Y);
  fmpq_div_2exp(x, &p->q[row->q], divided ? 10 : 0);
}

/* The exact quantities of a point; read as of point_certified. */
static void certify_quantities(struct certificate *c, struct judge *j, const struct point *p, unsigned read) {
  NUMBERS(fmpq, x);
  const struct point_quantity *row;
  for (size_t i = 0; (row = point_certified(&i, p, read)) != NULL; i++) {
    value_of(x, p, row);
    certify_exact(c, j, row->name, x);
  }
}

void certify_drawn(struct certificate *c, struct judge *j, const struct point *p, const struct dyn_orbit *o,
                   unsigned read) {
  certify_quantities(c, j, p, read);
  certify_ball(c, j, "e_1", o->e1);
  certify_ball(c, j, "e_2", o->e2);
  certify_ball(c, j, "z_10", o->z10);
  certify_ball(c, j, "z_20", o->z20);
  certify_ball(c, j, "t_a", o->t[PHASE_D]);
  certify_ball(c, j, "t_d", o->t[PHASE_C]);
}

/* The start and the four times of a pass. */
static void certify_pass(struct certificate *c, struct judge *j, const struct dyn_arc *arc) {
  for (int i = 0; i < 2; i++) certify_ball(c, j, name_state[0][i], num_vec_at(&arc->z, i));
  for (int k = 0; k < N_PHASES; k++) certify_ball(c, j, name_time[k], num_vec_at(&arc->t, k));
}

/* The perturbations that were read, but for x and y. */
static void certify_tangents(struct certificate *c, struct judge *j, const struct values *v) {
  enum { N = (N_PHASES + 1) * N_STATE };
  for (int i = 2; i < N; i++)
    if (v->tangent_read >> i & 1U)
      certify_ball(c, j, name_tangent[i / N_STATE][i % N_STATE], num_vec_at(&v->tangent, i));
  for (int k = 0; k < N_PHASES; k++)
    if (v->tangent_read >> (N + k) & 1U) certify_ball(c, j, name_shift[k], num_vec_at(&v->dt, k));
}

/* The values there, of which v knows afterwards what the sentence reads; false where there are none. */
static bool read_values(struct values *v, struct judge *j, const struct point *p, struct sentence *s) {
  bool ok = values_init(v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), j->cache) == SS_OK;
  struct num_vec lhs = calc_vec(&v->c, s->n), rhs = calc_vec(&v->c, s->n);
  if (ok) sentence_evaluate(&lhs, &rhs, NULL, s, v);
  return ok;
}

const char *certificate_rest(struct judge *j, const struct point *p, struct sentence *s) {
  OWNED(values) v;
  struct text t = {0};
  NUMBERS(fmpq, x);
  bool ok = read_values(&v, j, p, s) && point_of_model(p);
  const struct point_quantity *row;
  for (size_t i = 0; ok && (row = point_certified(&i, p, v.read)) != NULL; i++) {
    bool of_start = row->q == Q_X || row->q == Q_Y;
    bool read = v.read >> row->q & 1U || (of_start && (v.have_tangent || p->finite));
    if (row->shown >> p->kind & 1U || !read) continue;
    value_of(x, p, row);
    text_printf(&t, ", %s = ", row->name);
    num_print_q(&t, x);
  }
  if (ok && v.have_t && (p->kind == POINT_ARC || p->kind == POINT_ORBIT))
    text_printf(&t, ", t = %s", ball_text(j, num_vec_at(&v.t, 0), 10));
  return result_take(j->out, &t);
}

void certify_point(struct certificate *c, struct judge *j, const struct point *p, struct sentence *s) {
  OWNED(values) v;
  certify_own(c, j, p, s);
  bool ok = read_values(&v, j, p, s);
  if (point_of_model(p)) certify_quantities(c, j, p, v.read);
  if (ok && (p->kind == POINT_ARC || p->kind == POINT_ORBIT)) certify_pass(c, j, &v.arc);
  if (v.have_t) certify_ball(c, j, "t", num_vec_at(&v.t, 0));
  if (p->kind == POINT_PATCHED) certify_tangents(c, j, &v);
}
