/* The equations of the word in the six quantities e1, e2, t_a, t_b, t_c, t_d, and proofs of their solutions.

   Any two quantities may be known exactly; Krawczyk's operator on the other four proves that a box holds exactly one
   solution. */
#include "orbit_equations.h"
#include "flow.h"
#include "num/solve.h"

struct word_data word_data_of(const fmpq *model, const enum dyn_quantity which[2], const fmpq *value) {
  struct word_data d = {model, value, which, {0}};
  int n = 0;
  for (int i = 0; i < N_QUANTITIES; i++)
    if ((int)which[0] != i && (int)which[1] != i) d.unknown[n++] = i;
  return d;
}

/* After phase H, of which h are the blocks: f = K z, so that v becomes c v - s f, and f becomes c f - n v. */
static struct moving carry(struct calc *c, const struct blocks *h, const struct moving *m) {
  struct moving to;
  for (int i = 0; i < 2; i++) {
    const val *co = h->c + 2 * i, *s = h->s + 2 * i, *n = h->n + 2 * i;
    to.v[i] = calc_sub(c, calc_dot(c, co[0], m->v[0], co[1], m->v[1]), calc_dot(c, s[0], m->f[0], s[1], m->f[1]));
    to.f[i] = calc_sub(c, calc_dot(c, co[0], m->f[0], co[1], m->f[1]), calc_dot(c, n[0], m->v[0], n[1], m->v[1]));
  }
  return to;
}

/* The column of the derivatives when the state at the end of phase H moves by d and r_0 by end. */
static void column(struct word *w, enum dyn_quantity x, struct calc *c, const struct ball_params *m,
                   const struct moving *d, val end) {
  val cosine = w->cosine, sine = w->sine;
  val r = calc_div(c, d->f[1], m->stiff);
  w->j[0][x] = d->v[0];
  w->j[1][x] = calc_sub(c, r, calc_mul(c, end, cosine));
  w->j[2][x] = calc_sub(c, calc_div(c, d->v[1], m->omega), calc_mul(c, end, sine));
  w->j[3][x] = calc_sub(c, d->f[0], calc_mul(c, m->p[P_CHI], calc_sub(c, end, r)));
}

void word_make(struct word *w, struct calc *c, const struct ball_params *m, const val x[N_QUANTITIES]) {
  val e1 = x[QUANTITY_E1], td = x[QUANTITY_TD], V = m->p[P_V], chi = m->p[P_CHI], zero = m->zero;
  struct ball_params limits = *m;
  struct ball_slide g;
  struct blocks h;
  limits.p[P_E1] = e1;
  limits.p[P_E2] = x[QUANTITY_E2];
  ball_slide_make(&g, c, &limits, x[QUANTITY_TB]);
  flow_blocks_h(&h, c, &m->spectrum, x[QUANTITY_TC]);
  calc_sin_cos(c, &w->sine, &w->cosine, calc_mul(c, m->omega, td));
  w->end = g.r;

  struct moving by_e1 = {{calc_neg(c, g.sine), zero}, {g.cosine, zero}}, by_e2 = {{zero, zero}, {zero, m->p[P_ETA]}};
  struct moving at = carry(c, &h, &g.at);
  struct moving by_tc = {
      {calc_neg(c, at.f[0]), calc_neg(c, at.f[1])},
      {calc_sub(c, at.v[0], calc_mul(c, chi, at.v[1])), calc_mul(c, m->stiff, calc_sub(c, at.v[1], at.v[0]))}};
  struct moving end[3] = {carry(c, &h, &by_e1), carry(c, &h, &by_e2), carry(c, &h, &g.by_tb)};
  column(w, QUANTITY_E1, c, m, &end[0], calc_sub(c, g.cosine, m->one));
  column(w, QUANTITY_E2, c, m, &end[1], calc_div(c, m->one, chi));
  column(w, QUANTITY_TB, c, m, &end[2], g.pb);
  column(w, QUANTITY_TC, c, m, &by_tc, zero);
  w->j[3][QUANTITY_E1] = calc_sub(c, w->j[3][QUANTITY_E1], m->one);
  val spin = calc_mul(c, m->omega, w->end);
  val by_td[WORD_FREE] = {zero, calc_mul(c, spin, w->sine), calc_neg(c, calc_mul(c, spin, w->cosine)), m->a};
  for (int i = 0; i < WORD_FREE; i++) {
    w->j[i][QUANTITY_TA] = i == 3 ? m->a : zero;
    w->j[i][QUANTITY_TD] = by_td[i];
  }

  val r = calc_div(c, at.f[1], m->stiff), rest = calc_mul(c, m->a, calc_add(c, x[QUANTITY_TA], td));
  w->e[0] = calc_sub(c, at.v[0], V);
  w->e[1] = calc_sub(c, r, calc_mul(c, w->end, w->cosine));
  w->e[2] = calc_sub(c, calc_div(c, calc_sub(c, at.v[1], V), m->omega), calc_mul(c, w->end, w->sine));
  val back = calc_mul(c, chi, calc_sub(c, w->end, r));
  w->e[3] = calc_sub(c, calc_add(c, at.f[0], calc_sub(c, rest, back)), e1);
}

void word_params(struct ball_params *m, struct calc *c, const fmpq *model) {
  val one = calc_d(c, 1);
  ball_params_with(m, c, model, one, one);
}

int word_values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct word_system *s = self;
  struct word w;
  val at[N_QUANTITIES];
  calc_release(s->c, s->mark);
  s->c->status = SS_OK;
  for (int i = 0; i < N_QUANTITIES; i++) at[i] = s->known[i];
  for (int k = 0; k < WORD_FREE; k++) at[s->unknown[k]] = num_vec_at(x, k);
  word_make(&w, s->c, s->m, at);
  for (int i = 0; i < WORD_FREE; i++) {
    if (f) f[i] = w.e[i];
    for (int k = 0; k < WORD_FREE; k++) j[WORD_FREE * i + k] = w.j[i][s->unknown[k]];
  }
  return s->c->status;
}

bool word_step_is_small(const struct num_vec *x, const struct num_vec *step, const struct word_system *s, slong bits) {
  struct calc *c = s->c;
  val at[N_QUANTITIES], scale[2] = {calc_d(c, 0), calc_d(c, 0)};
  for (int i = 0; i < N_QUANTITIES; i++) at[i] = s->known[i];
  for (int k = 0; k < WORD_FREE; k++) at[s->unknown[k]] = num_vec_at(x, k);
  for (int i = 0; i < N_QUANTITIES; i++) {
    val *sum = &scale[i >= QUANTITY_TA];
    *sum = calc_add(c, *sum, calc_abs(c, at[i]));
  }
  for (int k = 0; k < WORD_FREE; k++)
    if (!newton_is_small(c->ctx.type, num_vec_at(step, k), bits, scale[s->unknown[k] >= QUANTITY_TA])) return false;
  return true;
}

void word_root_clear(struct word_root *s) {
  for (int i = 0; i < N_QUANTITIES; i++) {
    arb_clear(s->x[i]);
    arb_clear(s->box[i]);
  }
}

static enum newton_next settles(const struct num_vec *x, const struct num_vec *step, void *self) {
  const struct word_system *s = self;
  return word_step_is_small(x, step, s, s->c->ctx.prec / 2 + 4) ? NEWTON_LAST : NEWTON_ON;
}

/* What a level of Newton's iteration works on: all quantities, of which the unknown ones move. */
struct refinement {
  struct num_vec *x;
  const struct word_data *q;
};

static int refine_level(slong bits, void *self) {
  const struct refinement *r = self;
  const struct num_type *type = r->x->ctx.type;
  struct ball_params m;
  OWNED(num_vec) free;
  OWNED(calc) c = calc_begin(num_ctx_mpfr(bits));
  word_params(&m, &c, r->q->model);
  struct word_system w = {&c, &m, r->q->unknown, calc_mark(&c), {NULL}};
  struct solve_system system = {WORD_FREE, word_values, &w};
  flow_vals(w.known, r->x, 0, N_QUANTITIES);
  num_vec_init(&free, WORD_FREE, r->x->ctx);
  for (int k = 0; k < WORD_FREE; k++) type->set(num_vec_at(&free, k), w.known[r->q->unknown[k]]);
  int status = newton_run(&free, &system, c.ctx, 40, settles);
  for (int k = 0; k < WORD_FREE; k++) type->swap(num_vec_at(r->x, r->q->unknown[k]), num_vec_at(&free, k));
  return status;
}

static int refine(struct num_vec *x, const struct word_data *q) {
  struct refinement r = {x, q};
  int status = SS_OK;
  for (slong i = 0; i < 2; i++) status |= num_mpfr.set_q(num_vec_at(x, q->which[i]), q->value + i, x->ctx.prec);
  return status ? status : newton_rising(refine_level, &r, x->ctx.prec);
}

static int enclose(struct word_root *s, const struct num_vec *x, const struct word_data *q) {
  struct ball_params m;
  slong prec = x->ctx.prec;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  struct num_vec root = calc_vec(&c, WORD_FREE), box = calc_vec(&c, WORD_FREE);
  word_params(&m, &c, q->model);
  struct word_system w = {&c, &m, q->unknown, calc_mark(&c), {NULL}};
  struct solve_system system = {WORD_FREE, word_values, &w};
  for (int i = 0; i < 2; i++) {
    enum dyn_quantity known = q->which[i];
    arb_set_fmpq(s->x[known], q->value + i, prec);
    arb_set(s->box[known], s->x[known]);
    w.known[known] = s->x[known];
  }
  for (int i = 0; i < WORD_FREE; i++) num_mpfr.get_arb(num_vec_at(&root, i), num_vec_at(x, q->unknown[i]));
  int status = krawczyk_enclose(&root, &box, &system);
  for (int i = 0; i < WORD_FREE && !status; i++) {
    arb_swap(s->x[q->unknown[i]], num_vec_at(&root, i));
    arb_swap(s->box[q->unknown[i]], num_vec_at(&box, i));
  }
  return status;
}

int word_solve(struct word_root *s, const struct word_data *q, slong prec) {
  OWNED(num_vec) x;
  int status = SS_OK;
  num_vec_init(&x, N_QUANTITIES, num_ctx_mpfr(prec));
  for (int i = 0; i < N_QUANTITIES; i++) status |= num_mpfr.set_arb(num_vec_at(&x, i), s->x[i], prec);
  if (!status) status = refine(&x, q);
  if (!status) status = enclose(s, &x, q);
  return status;
}

/* --- Its orbit. --- */

/* The orbit's parameters, e1 and e2 as they came out, and its pass; the sign of r at the stick phase is that in phase C
   too; where enclosures cannot tell it, the direction of phase C will not be proved. */
static void open_root(struct calc *c, struct ball_params *m, struct ball_pass *s, const struct word_root *root,
                      const fmpq *model, slong prec) {
  *c = calc_begin(num_ctx_arb(prec));
  ball_params_with(m, c, model, root->x[QUANTITY_E1], root->x[QUANTITY_E2]);
  ball_pass_slip(s, c, m, root->x[QUANTITY_TB], root->x[QUANTITY_TC]);
  ball_pass_turn(s, c, m, num_arb.get_d(s->r) > 0);
}

int word_describe(struct dyn_orbit *o, const struct word_root *s, const fmpq *model, slong prec) {
  struct ball_params m;
  struct ball_pass at;
  OWNED(calc) c;
  open_root(&c, &m, &at, s, model, prec);
  int status = dyn_orbit_describe(o, &c, &m, &at);
  for (int i = 0; i < N_PHASES; i++) arb_set(o->t[i], s->x[QUANTITY_TA + i]);
  return status;
}

truth word_judge_orbit(struct dyn_orbit *o, truth *domain, const struct word_root *s, const fmpq *model, slong prec,
                       long max_steps) {
  static const enum dyn_quantity positive[] = {QUANTITY_E1, QUANTITY_E2, QUANTITY_TB, QUANTITY_TC, QUANTITY_TD};
  struct ball_params m;
  struct ball_pass at;
  OWNED(calc) c;
  open_root(&c, &m, &at, s, model, prec);
  truth first = dyn_orbit_judge(o, &c, &m, &at, max_steps);
  *domain = num_arb.lt(calc_mul(&c, m.omega, s->x[QUANTITY_TD]), calc_pi(&c));
  for (size_t i = 0; i < sizeof positive / sizeof *positive; i++)
    *domain = truth_and(*domain, num_arb.lt(m.zero, s->x[positive[i]]));
  o->holds[COND_TA] = num_arb.lt(m.zero, s->x[QUANTITY_TA]);
  o->admissible = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS; i++) o->admissible = truth_and(o->admissible, o->holds[i]);
  return first;
}
