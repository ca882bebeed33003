/* The periodic orbit in MPFR: the two equations of the suite's return map, of which t_b and t_c are the unknowns, by
   Newton's iteration; each level has twice the bits of the one before and starts from its result. */
#include "bench/jobs.h"
#include "motion/orbit_judge.h"

enum { FIRST = 96, GUARD = 32, MOST_LEVELS = FLINT_BITS, MOST_STEPS = 30 };

/* The steps of x = (t_b, t_c) at the calc's precision; x has the precision of the result. */
static long level(struct num_vec *x, struct calc *c, const struct ball_params *m, bool up) {
  val small = calc_two_to(c, -c->ctx.prec / 2 - 4);
  slong mark = calc_mark(c);
  for (long n = 1; n <= MOST_STEPS && !c->status; n++) {
    struct ball_pass s;
    bool settled = true;
    ball_pass_make(&s, c, m, num_vec_at(x, 0), num_vec_at(x, 1), up);
    val det = calc_dot(c, s.pc_tb, s.defect_tc, s.wc, s.defect_tb);
    val step[2] = {calc_div(c, calc_dot(c, s.defect_tc, s.pc, s.wc, s.defect), det),
                   calc_div(c, calc_sub(c, calc_mul(c, s.pc_tb, s.defect), calc_mul(c, s.defect_tb, s.pc)), det)};
    for (int i = 0; i < 2; i++) {
      c->status |= num_mpfr.sub(num_vec_at(x, i), num_vec_at(x, i), step[i], x->ctx.prec);
      settled = settled && calc_lt(c, calc_abs(c, step[i]), small);
    }
    calc_release(c, mark);
    if (settled) return n;
  }
  c->status |= SS_UNABLE;
  return MOST_STEPS;
}

static void describe(struct num_vec *out, struct calc *c, const struct ball_params *m, const struct num_vec *x,
                     bool up) {
  struct ball_pass s;
  struct ball_ending e;
  val z[2];
  ball_pass_make(&s, c, m, num_vec_at(x, 0), num_vec_at(x, 1), up);
  ball_ending_make(&e, c, m, &s);
  ball_positions(z, c, m, e.wf, s.r);
  const val all[] = {e.ta, s.tb, s.tc, e.td, z[0], z[1], calc_add(c, calc_div(c, s.defect_tb, s.pb), m->one)};
  for (int i = 0; i < COUNT(all); i++) num_mpfr.set(num_vec_at(out, i), all[i]);
}

int bench_newton_mpfr(struct num_vec *out, long *steps, const double *params, double tb, double tc, bool up) {
  slong ladder[MOST_LEVELS], n = 0, prec = out->ctx.prec + GUARD;
  OWNED(num_vec) x;
  int status = SS_OK;
  for (slong bits = prec; bits > FIRST; bits = bits / 2 + 16) ladder[n++] = bits;
  if (n == 0) ladder[n++] = prec;
  num_vec_init(&x, 2, num_ctx_mpfr(prec));
  status |= num_mpfr.set_d(num_vec_at(&x, 0), tb, prec) | num_mpfr.set_d(num_vec_at(&x, 1), tc, prec);
  *steps = 0;
  while (n > 0 && !status) {
    struct ball_params m;
    val p[N_PARAMS];
    OWNED(calc) c = calc_begin(num_ctx_mpfr(ladder[--n]));
    for (int i = 0; i < N_PARAMS; i++) p[i] = calc_d(&c, params[i]);
    ball_params_make(&m, &c, p);
    *steps += level(&x, &c, &m, up);
    if (n == 0) describe(out, &c, &m, &x, up);
    status |= c.status;
  }
  return status;
}
