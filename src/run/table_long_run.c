/* How far a motion is from a periodic orbit, period by period: what lies beside an orbit by 1/1000, carried by the
   return map in balls, and what Coulomb's law makes of the printed start, by closed forms in MPFR. */
#include <math.h>

#include "motion/coulomb.h"
#include "motion/return_map.h"
#include "num/calc.h"
#include "tables.h"
#include "value/coulomb_setup.h"
#include "value/printed.h"

enum { DECIMALS = 4, MOST_PERIODS = 120, COULOMB_PERIODS = 120 };

/* |r - r of the orbit| as a power of ten. */
static void add_row(struct text *out, const char *run, long number, long n, const arb_t distance) {
  NUMBERS(arb, log);
  arb_abs(log, distance);
  arb_log_base_ui(log, log, 10, FIRST_PREC);
  text_add(out, run);
  if (number) text_printf(out, " %ld", number);
  text_printf(out, "\t%ld", n);
  table_number(out, log, DECIMALS);
  text_add_char(out, '\n');
}

static void add_beside(struct text *body, const struct table_source *s, slong k) {
  const struct dyn_orbit *o = &s->list->orbit[k];
  OWNED(num_vec) out;
  struct dyn_return d;
  NUMBERS(mag, error);
  ARB_VECTOR(v, 3); /* the orbit's r, the motion's, their distance */
  num_vec_init(&out, N_RETURN, s->params.ctx);
  arb_sub(v, o->z20, o->z10, FIRST_PREC);
  arb_set_ui(v + 2, 1000);
  arb_inv(v + 2, v + 2, FIRST_PREC);
  arb_add(v + 1, v, v + 2, FIRST_PREC);
  for (long n = 0; n <= MOST_PERIODS; n++) {
    add_row(body, o->admissible == TRUTH_TRUE ? "orbit" : "formal", (long)k + 1, n, v + 2);
    double off = fabs(num_arb.get_d(v + 2));
    if (off > 0.1 || off < 1e-9) break;
    if (dyn_return_map(&d, s->near, num_arb.get_d(v + 1)) != SS_OK ||
        dyn_return_near(&out, &s->params, v + 1, d.t) != SS_OK || !table_go_on(v + 1, error, &out))
      break;
    arb_sub(v + 2, v + 1, v, FIRST_PREC);
  }
}

/* The motion from the printed start, told at every return to the global stick phase. */
struct listener {
  struct text *body;
  arb_t shift; /* from r as a difference of x to its distance from the orbit's r */
  long n;
};

static void tell(struct listener *l, const void *x_1, const void *x_2) {
  NUMBERS(arb, a, b);
  num_mpfr.get_arb(a, x_1);
  num_mpfr.get_arb(b, x_2);
  arb_sub(b, b, a, FIRST_PREC);
  arb_add(b, b, l->shift, FIRST_PREC);
  add_row(l->body, "printed", 0, l->n++, b);
}

static bool listen(void *self, const struct coulomb_event *e) {
  if (e->returns) tell(self, num_vec_at(e->at.exact, 1), num_vec_at(e->at.exact, 2));
  return true;
}

static void add_printed(struct text *body, const struct table_source *s) {
  struct coulomb_setup sim;
  if (!audit_coulomb_setup(&sim, s->j->scene, 0, true, s->j->d)) {
    diag_init(s->j->d);
    return;
  }
  struct listener l = {.body = body};
  struct coulomb_sink sink = {&l, listen, NULL};
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result result;
  OWNED(calc) c = calc_begin(num_ctx_mpfr(FIRST_PREC));
  struct num_vec p = calc_vec(&c, N_COULOMB), x = calc_vec(&c, N_STATE);
  for (int i = 0; i < N_COULOMB; i++) num_mpfr.set_d(num_vec_at(&p, i), sim.params[i], FIRST_PREC);
  for (int i = 0; i < N_STATE; i++) num_mpfr.set_d(num_vec_at(&x, i), sim.start[i], FIRST_PREC);
  ARB_VECTOR(at, 2);
  arb_init(l.shift); /* z10 - z20 and x_2 - x_1 at the start belong together */
  for (int i = 0; i < 2; i++) {
    arb_set_d(at + i, sim.start[i]);
    arb_set_fmpq(l.shift, &s->printed[i]->value, FIRST_PREC);
    arb_sub(at + i, at + i, l.shift, FIRST_PREC);
    arb_add(at + i, at + i, i ? s->orbit->z20 : s->orbit->z10, FIRST_PREC);
  }
  arb_sub(l.shift, at, at + 1, FIRST_PREC);
  tell(&l, num_vec_at(&x, 0), num_vec_at(&x, 1));
  plan.returns = COULOMB_PERIODS;
  plan.duration = 4 * COULOMB_PERIODS * sim.period;
  coulomb_simulate_exact(&result, &p, &x, &plan, &sink);
  arb_clear(l.shift);
}

void table_of_long_runs(struct table_source *s) {
  struct text body = {0};
  text_printf(
      &body,
      "# How far from a periodic orbit, period by period: log10 of |r - r*|, r = z_2 - z_1 at the end of the global "
      "stick phase, r* that of the orbit.\n"
      "# run orbit K, formal K: 1/1000 beside orbit K, by the return map (formal: an orbit that breaks a "
      "condition)%s\n",
      s->printed[0] ? ";" : ".");
  if (s->printed[0])
    text_printf(
        &body,
        "# printed: the motion of the printed start under Coulomb's law, at every return to the stick phase, from "
        "%s.\n",
        usual_orbit_text(s->j, "orbit"));
  text_add(&body, "run\tn\tlog10\n");
  for (slong k = 0; k < s->list->n; k++) add_beside(&body, s, k);
  if (s->printed[0]) add_printed(&body, s);
  table_finish(s->j->out, "long-run.tsv", &body);
}
