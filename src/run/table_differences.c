/* The error of tr J by central differences of the return map, against their step: with 53 bits it falls as the square
   of the step until rounding takes over, and rises again; with more bits the turn comes later, or not at all.

   53 bits are those of double precision, but in MPFR, whose roundings are the same on every machine. */
#include <math.h>

#include "num/calc.h"
#include "tables.h"
#include "value/printed.h"

enum { DECIMALS = 3, FIRST_STEP = 3, LAST_STEP = 84 };

static const slong precisions[] = {53, 113, 256};
enum { N_PRECISIONS = sizeof precisions / sizeof *precisions };

/* The orbit and its parameters, enclosed for the most bits of all. */
struct fine {
  const struct dyn_orbit *orbit;
  struct num_vec params;
};

/* r at the end of a period that starts at the orbit's positions, z_2 moved by sign 2^-k; times are the orbit's to some
   digits, from which Newton's iteration goes on. */
static int end_of_period(arb_t r, const struct fine *s, struct num_ctx ctx, int k, int sign) {
  double near[N_PHASES];
  OWNED(calc) c = calc_begin(ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++)
    c.status |= ctx.type->set_arb(num_vec_at(&params, i), num_vec_at(&s->params, i), ctx.prec);
  for (int i = 0; i < N_PHASES; i++) near[i] = ldexp(round(ldexp(s->orbit->guess[i], 20)), -20);
  val end = orbit_passed(&c, &params, s->orbit, calc_d(&c, ldexp(sign, -k)), near);
  if (!c.status) num_mpfr.get_arb(r, end);
  return c.status;
}

/* log10 of the error; indeterminate where there is none to be had. */
static void log_error(arb_t out, const struct fine *s, slong bits, int k) {
  NUMBERS(arb, below);
  int status = end_of_period(out, s, num_ctx_mpfr(bits), k, 1) | end_of_period(below, s, num_ctx_mpfr(bits), k, -1);
  arb_sub(out, out, below, LAST_PREC);
  arb_mul_2exp_si(out, out, k - 1);
  arb_sub(out, out, s->orbit->trace, LAST_PREC);
  arb_abs(out, out);
  if (status || arb_is_zero(out))
    arb_indeterminate(out);
  else
    arb_log_base_ui(out, out, 10, FIRST_PREC);
}

/* What the scene gives, exact but for rounding; e1 and e2 that it does not give are the orbit's. */
static int fine_init(struct fine *f, const struct table_source *s) {
  enum { PREC = FD_PREC + 64 };
  const struct scene *scene = s->j->scene;
  const struct dyn_orbits *list = point_orbits(s->point, s->j->cache, PREC);
  int status = SS_OK;
  num_vec_init(&f->params, N_PARAMS, num_ctx_arb(PREC));
  if (s->point->orbit >= list->n) return SS_UNABLE;
  f->orbit = &list->orbit[s->point->orbit];
  for (int i = 0; i < N_PARAMS; i++)
    if (scene->given[KEY_CHI + i])
      status |= num_arb.set_q(num_vec_at(&f->params, i), &scene->value[KEY_CHI + i], PREC);
    else
      num_arb.set(num_vec_at(&f->params, i), i == P_E1 ? f->orbit->e1 : f->orbit->e2);
  return status;
}

static void add_rows(struct text *body, const struct fine *f) {
  OWNED(text) row = {0};
  NUMBERS(arb, x);
  for (int k = FIRST_STEP; k <= LAST_STEP; k++) {
    arb_set_ui(x, 2);
    arb_log_base_ui(x, x, 10, FIRST_PREC);
    arb_mul_si(x, x, -k, FIRST_PREC);
    table_number(&row, x, DECIMALS);
    for (int i = 0; i < N_PRECISIONS; i++) {
      log_error(x, f, precisions[i], k);
      table_number(&row, x, DECIMALS);
    }
    text_printf(body, "%s\n", text_str(&row) + 1);
    text_reset(&row);
  }
}

void table_of_differences(struct table_source *s) {
  struct text body = {0};
  struct fine f;
  text_printf(&body,
              "# The error of tr J on %s by central differences of the event-located "
              "return map, against their step h.\n"
              "# Columns: log10 of h and of the error with so many bits in every operation; 53 are those of double "
              "precision; - where it is not known or zero.\n"
              "log10_h\tbits_53\tbits_113\tbits_256\n",
              usual_orbit_text(s->j, "orbit"));
  if (fine_init(&f, s) == SS_OK) add_rows(&body, &f);
  num_vec_clear(&f.params);
  table_finish(s->j->out, "differences.tsv", &body);
}
