/* The equations of the word in the six quantities e1, e2, t_a, t_b, t_c, t_d, and proofs of their solutions.

   With z_1' = V and z_2' = V where they must be, phase C turns (r, q/omega) by omega t_d into (r_0, 0): the four equations
   of given.h.  Any two quantities may be known exactly; Krawczyk's operator on the other four proves that a box holds
   exactly one solution. */
#include "motion_impl.h"

/* cos(sqrt(K) t), sin(sqrt(K) t)/sqrt(K) and sqrt(K) sin(sqrt(K) t): velocities v and forces f = (w, chi eta r) become
   c v - s f and c f + n v. */
struct slip_blocks {
  val c[4], s[4], n[4];
};

static void blocks_at(struct slip_blocks *h, struct calc *c, const struct spectrum *s, val t) {
  val sine[2], cosine[2], slow[2], fast[2];
  for (int i = 0; i < 2; i++) {
    calc_sin_cos(c, &sine[i], &cosine[i], calc_mul(c, s->om[i], t));
    slow[i] = calc_div(c, sine[i], s->om[i]);
    fast[i] = calc_mul(c, sine[i], s->om[i]);
  }
  flow_function(h->c, c, s, cosine[0], cosine[1]);
  flow_function(h->s, c, s, slow[0], slow[1]);
  flow_function(h->n, c, s, fast[0], fast[1]);
}

/* Velocities and forces after phase H. */
struct moving {
  val v[2], f[2];
};

static struct moving carry(struct calc *c, const struct slip_blocks *h, const struct moving *m) {
  struct moving to;
  for (int i = 0; i < 2; i++) {
    const val *co = h->c + 2 * i, *s = h->s + 2 * i, *n = h->n + 2 * i;
    to.v[i] = calc_sub(c, calc_dot(c, co[0], m->v[0], co[1], m->v[1]), calc_dot(c, s[0], m->f[0], s[1], m->f[1]));
    to.f[i] = calc_add(c, calc_dot(c, co[0], m->f[0], co[1], m->f[1]), calc_dot(c, n[0], m->v[0], n[1], m->v[1]));
  }
  return to;
}

/* The column of the derivatives when the state at the end of phase H moves by d and r_0 by end. */
static void column(struct word *w, enum dyn_quantity x, struct calc *c, const struct ball_params *m,
                   const struct moving *d, val end, val cosine, val sine) {
  val r = calc_div(c, d->f[1], m->stiff);
  w->j[0][x] = d->v[0];
  w->j[1][x] = calc_sub(c, r, calc_mul(c, end, cosine));
  w->j[2][x] = calc_sub(c, calc_div(c, d->v[1], m->omega), calc_mul(c, end, sine));
  w->j[3][x] = calc_sub(c, d->f[0], calc_mul(c, m->p[P_CHI], calc_sub(c, end, r)));
}

void word_make(struct word *w, struct calc *c, const struct ball_params *m, const val x[N_QUANTITIES]) {
  val e1 = x[QUANTITY_E1], e2 = x[QUANTITY_E2], tb = x[QUANTITY_TB], td = x[QUANTITY_TD], V = m->p[P_V];
  val chi = m->p[P_CHI], eta = m->p[P_ETA], zero = m->zero, s, co, sine, cosine;
  struct slip_blocks h;
  blocks_at(&h, c, &m->spectrum, x[QUANTITY_TC]);
  calc_sin_cos(c, &s, &co, tb);
  calc_sin_cos(c, &sine, &cosine, calc_mul(c, m->omega, td));
  val wb = calc_dot(c, e1, co, m->a, s), dwb = calc_sub(c, calc_mul(c, m->a, co), calc_mul(c, e1, s));
  val pb = calc_sub(c, dwb, m->a), rise = calc_add(c, calc_sub(c, calc_mul(c, m->a, tb), wb), e1);
  w->end = calc_sub(c, calc_div(c, e2, chi), rise);

  struct moving b = {{calc_add(c, V, pb), V}, {wb, calc_mul(c, eta, e2)}}, at = carry(c, &h, &b);
  struct moving by_e1 = {{calc_neg(c, s), zero}, {co, zero}}, by_e2 = {{zero, zero}, {zero, eta}};
  struct moving by_tb = {{calc_neg(c, wb), zero}, {dwb, zero}};
  struct moving by_tc = {
      {calc_neg(c, at.f[0]), calc_neg(c, at.f[1])},
      {calc_sub(c, at.v[0], calc_mul(c, chi, at.v[1])), calc_mul(c, m->stiff, calc_sub(c, at.v[1], at.v[0]))}};
  struct moving end[3] = {carry(c, &h, &by_e1), carry(c, &h, &by_e2), carry(c, &h, &by_tb)};
  column(w, QUANTITY_E1, c, m, &end[0], calc_sub(c, co, m->one), cosine, sine);
  column(w, QUANTITY_E2, c, m, &end[1], calc_div(c, m->one, chi), cosine, sine);
  column(w, QUANTITY_TB, c, m, &end[2], pb, cosine, sine);
  column(w, QUANTITY_TC, c, m, &by_tc, zero, cosine, sine);
  w->j[3][QUANTITY_E1] = calc_sub(c, w->j[3][QUANTITY_E1], m->one);
  val spin = calc_mul(c, m->omega, w->end);
  val by_td[WORD_FREE] = {zero, calc_mul(c, spin, sine), calc_neg(c, calc_mul(c, spin, cosine)), m->a};
  for (int i = 0; i < WORD_FREE; i++) {
    w->j[i][QUANTITY_TA] = i == 3 ? m->a : zero;
    w->j[i][QUANTITY_TD] = by_td[i];
  }

  val r = calc_div(c, at.f[1], m->stiff), rest = calc_mul(c, m->a, calc_add(c, x[QUANTITY_TA], td));
  w->e[0] = calc_sub(c, at.v[0], V);
  w->e[1] = calc_sub(c, r, calc_mul(c, w->end, cosine));
  w->e[2] = calc_sub(c, calc_div(c, calc_sub(c, at.v[1], V), m->omega), calc_mul(c, w->end, sine));
  val back = calc_mul(c, chi, calc_sub(c, w->end, r));
  w->e[3] = calc_sub(c, calc_add(c, at.f[0], calc_sub(c, rest, back)), e1);
}

void word_params(struct ball_params *m, struct calc *c, const fmpq *model) {
  val one = calc_d(c, 1), p[N_PARAMS] = {calc_q(c, model), calc_q(c, model + 1), calc_q(c, model + 2), one, one};
  ball_params_make(m, c, p);
}

/* step receives the solution of j step = e in the unknowns. */
static int solve_step(struct num_vec *step, const struct word *w, const int unknown[WORD_FREE]) {
  struct num_vec a;
  num_vec_init(&a, WORD_FREE * WORD_FREE, step->ctx);
  for (slong i = 0; i < WORD_FREE; i++) {
    step->ctx.type->set(num_vec_at(step, i), w->e[i]);
    for (slong k = 0; k < WORD_FREE; k++) step->ctx.type->set(num_vec_at(&a, i * WORD_FREE + k), w->j[i][unknown[k]]);
  }
  int status = num_mat_solve(step, &a, step, WORD_FREE, 1);
  num_vec_clear(&a);
  return status;
}

/* What a step of an unknown is measured by: all times for a time, both limits for a limit. */
static val measure(struct calc *c, const val x[N_QUANTITIES], int which) {
  val sum = calc_d(c, 0);
  bool time = which >= QUANTITY_TA;
  for (int i = time ? QUANTITY_TA : 0; i < (time ? N_QUANTITIES : QUANTITY_TA); i++)
    sum = calc_add(c, sum, calc_abs(c, x[i]));
  return sum;
}

int word_newton(bool *settled, struct num_vec *x, struct calc *c, const struct ball_params *m,
                const int unknown[WORD_FREE], slong bits) {
  struct word w;
  struct num_vec step;
  val at[N_QUANTITIES];
  slong mark = calc_mark(c);
  num_vec_init(&step, WORD_FREE, c->ctx);
  flow_vals(at, x, 0, N_QUANTITIES);
  word_make(&w, c, m, at);
  int status = c->status ? c->status : solve_step(&step, &w, unknown);
  val small = calc_two_to(c, -bits);
  *settled = !status;
  for (slong k = 0; k < WORD_FREE && !status; k++) {
    void *u = num_vec_at(x, unknown[k]);
    const void *s = num_vec_at(&step, k);
    if (calc_lt(c, calc_mul(c, small, measure(c, at, unknown[k])), calc_abs(c, s))) *settled = false;
    status |= c->ctx.type->sub(u, u, s, c->ctx.prec);
  }
  calc_release(c, mark);
  num_vec_clear(&step);
  return status;
}

void word_root_init(struct word_root *s) {
  for (int i = 0; i < N_QUANTITIES; i++) {
    arb_init(s->x[i]);
    arb_init(s->box[i]);
  }
}

void word_root_clear(struct word_root *s) {
  for (int i = 0; i < N_QUANTITIES; i++) {
    arb_clear(s->x[i]);
    arb_clear(s->box[i]);
  }
}

int word_refine(struct num_vec *x, const struct word_data *q) {
  slong ladder[FLINT_BITS], n = 0, prec = x->ctx.prec;
  int status = SS_OK;
  for (slong i = 0; i < 2; i++) status |= num_mpfr.set_q(num_vec_at(x, q->which[i]), q->value + i, prec);
  for (slong bits = prec; bits > 192; bits = bits / 2 + 24) ladder[n++] = bits;
  ladder[n++] = FLINT_MIN(prec, 192);
  while (n > 0 && !status) {
    struct calc c;
    struct ball_params m;
    bool settled = false;
    calc_init(&c, num_ctx_mpfr(ladder[--n]));
    word_params(&m, &c, q->model);
    for (int i = 0; i < 40 && !settled && !status; i++)
      status |= word_newton(&settled, x, &c, &m, q->unknown, c.ctx.prec / 2 + 4);
    if (!settled) status |= SS_UNABLE;
    calc_clear(&c);
  }
  return status;
}

int word_precondition(struct num_vec *y, struct num_vec *step, const struct word *w, const int unknown[WORD_FREE]) {
  struct num_vec a;
  int status = SS_OK;
  num_vec_init(&a, WORD_FREE * WORD_FREE, y->ctx);
  for (slong i = 0; i < WORD_FREE; i++)
    for (slong k = 0; k < WORD_FREE; k++) {
      arb_get_mid_arb(num_vec_at(&a, i * WORD_FREE + k), w->j[i][unknown[k]]);
      arb_set_si(num_vec_at(y, i * WORD_FREE + k), i == k);
    }
  status |= num_mat_solve(y, &a, y, WORD_FREE, WORD_FREE);
  for (slong i = 0; i < WORD_FREE * WORD_FREE; i++) arb_get_mid_arb(num_vec_at(y, i), num_vec_at(y, i));
  for (slong i = 0; i < WORD_FREE; i++) num_arb.set(num_vec_at(&a, i), w->e[i]);
  struct num_vec e = {a.ctx, WORD_FREE, a.data};
  status |= num_mat_mul(step, y, &e, WORD_FREE, WORD_FREE, 1);
  num_vec_clear(&a);
  return status;
}

bool word_krawczyk(struct word_root *s, struct calc *c, const struct ball_params *m, const val mid[WORD_FREE],
                   const struct num_vec *y, const struct num_vec *step, const int unknown[WORD_FREE]) {
  struct word w;
  val at[N_QUANTITIES];
  bool inside = true;
  for (int i = 0; i < N_QUANTITIES; i++) at[i] = s->box[i];
  word_make(&w, c, m, at);
  for (int i = 0; i < WORD_FREE; i++) {
    val image = calc_sub(c, mid[i], num_vec_at(step, i));
    for (int l = 0; l < WORD_FREE; l++) {
      val rest = calc_d(c, i == l);
      for (int k = 0; k < WORD_FREE; k++)
        rest = calc_sub(c, rest, calc_mul(c, num_vec_at(y, i * WORD_FREE + k), w.j[k][unknown[l]]));
      image = calc_add(c, image, calc_mul(c, rest, calc_sub(c, s->box[unknown[l]], mid[l])));
    }
    arb_set(s->x[unknown[i]], image);
    inside = inside && arb_contains_interior(s->box[unknown[i]], image);
  }
  return inside && !c->status;
}

int word_enclose(struct word_root *s, const struct num_vec *x, const struct word_data *q) {
  struct calc c;
  struct ball_params m;
  struct word w;
  struct num_vec y, step;
  val at[N_QUANTITIES], mid[WORD_FREE];
  slong prec = x->ctx.prec;
  calc_init(&c, num_ctx_arb(prec));
  word_params(&m, &c, q->model);
  num_vec_init(&y, WORD_FREE * WORD_FREE, c.ctx);
  num_vec_init(&step, WORD_FREE, c.ctx);
  for (slong i = 0; i < N_QUANTITIES; i++) {
    arb_ptr point = calc_new(&c);
    num_mpfr.get_arb(point, num_vec_at(x, i));
    at[i] = point;
  }
  for (int i = 0; i < 2; i++) {
    arb_set_fmpq(s->x[q->which[i]], q->value + i, prec);
    arb_set(s->box[q->which[i]], s->x[q->which[i]]);
    at[q->which[i]] = s->x[q->which[i]];
  }
  word_make(&w, &c, &m, at);
  int status = c.status | word_precondition(&y, &step, &w, q->unknown);
  for (slong i = 0; i < WORD_FREE; i++) {
    arb_ptr box = s->box[q->unknown[i]];
    mid[i] = at[q->unknown[i]];
    arb_set(box, mid[i]);
    arb_get_mag(arb_radref(box), num_vec_at(&step, i));
    mag_mul_2exp_si(arb_radref(box), arb_radref(box), 3);
  }
  bool proved = false;
  for (int i = 0; i < 10 && !proved && !status; i++) {
    slong mark = calc_mark(&c);
    c.status = SS_OK;
    proved = word_krawczyk(s, &c, &m, mid, &y, &step, q->unknown);
    calc_release(&c, mark);
    for (int k = 0; k < WORD_FREE && !proved; k++)
      mag_mul_2exp_si(arb_radref(s->box[q->unknown[k]]), arb_radref(s->box[q->unknown[k]]), 3);
  }
  num_vec_clear(&y);
  num_vec_clear(&step);
  calc_clear(&c);
  return proved ? SS_OK : SS_UNABLE;
}
