/* Motions of one period, sampled: the paper's figures 3 and 4, and how far the conditions of an orbit are from failing.

   Two motions are held side by side: the orbit nearest to the printed numbers, and what the printed start itself leads
   to, its decimals taken exactly and its events located.  A phase is sampled at equal times, its ends included; the
   marks O, a, b, c, d are the figures' names of those ends. */
#include <math.h>

#include "num/calc.h"
#include "tables.h"
#include "value/followed.h"
#include "value/printed.h"

enum { DECIMALS = 6 };

struct motion_tables {
  struct text history, portrait, margins;
  struct text *animation; /* this alone is made where it is not NULL */
};

/* How many pieces a phase is cut into. */
static slong pieces(const struct dyn_arc *arc, int ph) {
  double t = fabs(num_arb.get_d(num_vec_at(&arc->t, ph))), sum = 0;
  for (int i = 0; i < N_PHASES; i++) sum += fabs(num_arb.get_d(num_vec_at(&arc->t, i)));
  return table_pieces(t / sum);
}

/* What pulls on the masses: w = z_1 - chi z_2 and chi r. */
static void set_pulls(val pull[2], struct calc *c, const struct table_source *s, const struct num_vec *z) {
  val chi = num_vec_at(&s->params, P_CHI), z1 = num_vec_at(z, Z_1), z2 = num_vec_at(z, Z_2);
  pull[0] = calc_sub(c, z1, calc_mul(c, chi, z2));
  pull[1] = calc_mul(c, calc_sub(c, z2, z1), chi);
}

static void add_state(struct text *out, const struct num_vec *z) {
  for (int i = 0; i < N_STATE; i++) table_number(out, num_vec_at(z, (i % 2) * 2 + i / 2), DECIMALS);
}

/* A row of the animation: the state, the pulls, and e_i for a mass that sticks. */
static void add_frame(struct text *out, const struct table_source *s, enum phase ph, const char *mark, const arb_t time,
                      const struct num_vec *z) {
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  val pull[2];
  set_pulls(pull, &c, s, z);
  text_printf(out, "%s\t%s", phase_name[ph], mark);
  table_number(out, time, DECIMALS);
  add_state(out, z);
  for (int i = 0; i < 2; i++) table_number(out, pull[i], DECIMALS);
  for (int i = 0; i < 2; i++) table_number(out, phase_slips[ph][i] ? NULL : num_vec_at(&s->params, P_E1 + i), DECIMALS);
  text_add_char(out, '\n');
}

/* What a condition leaves: V - z_i' of a mass that slips, e_i less its pull of one that sticks; "-" for the others. */
static void add_margins(struct text *out, const struct table_source *s, enum phase ph, const struct num_vec *z) {
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  val pull[2], belt = num_vec_at(&s->params, P_V);
  set_pulls(pull, &c, s, z);
  for (int i = 0; i < 2; i++)
    table_number(out, phase_slips[ph][i] ? calc_sub(&c, belt, num_vec_at(z, DZ_1 + i)) : NULL, DECIMALS);
  for (int i = 0; i < 2; i++)
    table_number(out, phase_slips[ph][i] ? NULL : calc_sub(&c, num_vec_at(&s->params, P_E1 + i), pull[i]), DECIMALS);
}

static void add_row(struct motion_tables *t, const struct table_source *s, const char *motion, enum phase ph,
                    const char *mark, const arb_t time, const struct num_vec *z) {
  if (t->animation) {
    add_frame(t->animation, s, ph, mark, time, z);
    return;
  }
  text_printf(&t->history, "%s\t%s\t%s", motion, phase_name[ph], mark);
  table_number(&t->history, time, DECIMALS);
  for (int i = 0; i < 2; i++) table_number(&t->history, num_vec_at(z, i), DECIMALS);
  text_printf(&t->portrait, "%s\t%s\t%s", motion, phase_name[ph], mark);
  add_state(&t->portrait, z);
  text_add_char(&t->history, '\n');
  text_add_char(&t->portrait, '\n');
  if (motion[0] != 'o') return; /* conditions are those of the orbit */
  text_add(&t->margins, phase_name[ph]);
  table_number(&t->margins, time, DECIMALS);
  add_margins(&t->margins, s, ph, z);
  text_add_char(&t->margins, '\n');
}

static void add_phase(struct motion_tables *t, const struct table_source *s, const char *motion, enum phase ph,
                      const struct dyn_arc *arc, const arb_t begin) {
  static const char *const end_mark[N_PHASES] = {"a", "b", "c", "d"};
  const struct num_vec start = dyn_arc_state(arc, ph);
  OWNED(num_vec) z;
  NUMBERS(arb, time, into);
  num_vec_init(&z, N_STATE, arc->z.ctx);
  slong n = pieces(arc, (int)ph);
  for (slong k = 0; k <= n; k++) {
    const char *mark = k == n ? end_mark[ph] : k == 0 && ph == PHASE_D ? "O" : "-";
    arb_mul_si(into, num_vec_at(&arc->t, ph), k, FIRST_PREC);
    arb_div_si(into, into, n, FIRST_PREC);
    arb_add(time, begin, into, FIRST_PREC);
    if (dyn_flow(&z, ph, &s->params, &start, into) == SS_OK) add_row(t, s, motion, ph, mark, time, &z);
  }
}

static void add_motion(struct motion_tables *t, const struct table_source *s, const char *motion,
                       const struct dyn_arc *arc) {
  NUMBERS(arb, begin);
  for (int ph = 0; ph < N_PHASES; ph++) {
    add_phase(t, s, motion, (enum phase)ph, arc, begin);
    arb_add(begin, begin, num_vec_at(&arc->t, ph), FIRST_PREC);
  }
}

/* From the printed start, taken exactly, to the end of the fourth phase. */
static int run_printed(struct dyn_arc *arc, const struct table_source *s) {
  ARB_VECTOR(z, 2);
  for (int i = 0; i < 2; i++) arb_set_fmpq(z + i, &s->printed[i]->value, FIRST_PREC);
  return dyn_arc_run(arc, &s->params, z, z + 1, NULL);
}

static void add_headings(struct motion_tables *t, const struct table_source *s) {
  static const char marks[] =
      "# phase D, Gamma, H, C; mark O a b c d: the ends of phases as the figures name them.  " TABLE_UNITS "\n";
  const char *motions =
      result_str(s->j->out, "# motion orbit: %s%s.\n%s", usual_orbit_text(s->j, "periodic orbit"),
                 s->printed[0] ? "; printed: what the printed start (z10, z20), taken exactly, leads to" : "", marks);
  text_printf(&t->history, "# Time history of the masses (figure 3).\n%smotion\tphase\tmark\tt\tz_1\tz_2\n", motions);
  text_printf(&t->portrait, "# Phase plots of the system (figure 4).\n%smotion\tphase\tmark\tz_1\tz'_1\tz_2\tz'_2\n",
              motions);
  text_add(
      &t->margins,
      "# What the conditions of the word leave along the orbit; each must stay positive inside its phase, and is 0 "
      "where a phase begins or ends with it.\n"
      "# Slipping: V - z'_i (the mass does not overrun the belt).  Sticking: e_1 - w with w = z_1 - chi z_2, e_2 - "
      "chi r with r = z_2 - z_1.  " TABLE_UNITS "\n"
      "phase\tt\tV-z'_1\tV-z'_2\te_1-w\te_2-chi*r\n");
}

void tables_of_motion(struct table_source *s) {
  struct motion_tables t = {.animation = NULL};
  const struct followed *of = orbit_followed(s->j->cache, s->orbit, &s->params);
  OWNED(dyn_arc) arc;
  dyn_arc_init(&arc, s->params.ctx);
  add_headings(&t, s);
  if (of->status == SS_OK) add_motion(&t, s, "orbit", &of->arc);
  if (s->printed[0] && run_printed(&arc, s) == SS_OK) add_motion(&t, s, "printed", &arc);
  table_finish(s->j->out, "figure-3.tsv", &t.history);
  table_finish(s->j->out, "figure-4.tsv", &t.portrait);
  table_finish(s->j->out, "margins.tsv", &t.margins);
}

bool table_of_animation(struct audit_result *out, const struct table_source *s) {
  struct text body = {0};
  struct motion_tables t = {.animation = &body};
  const struct followed *of = orbit_followed(s->j->cache, s->orbit, &s->params);
  text_add(&body,
           "# One period of an orbit, from the beginning of the global stick phase.\n"
           "# phase D, Gamma, H, C; mark O a b c d: the ends of phases as figure 3 names them; pull_1 = z_1 - chi z_2 "
           "and pull_2 = chi (z_2 - z_1): what the springs pull with against the motion of the belt, less sliding "
           "friction; limit_i: e_i while the mass sticks, which it does until its pull is as large.  " TABLE_UNITS "\n"
           "phase\tmark\tt\tz_1\tz'_1\tz_2\tz'_2\tpull_1\tpull_2\tlimit_1\tlimit_2\n");
  bool ok = of->status == SS_OK;
  if (ok) add_motion(&t, s, "orbit", &of->arc);
  table_finish(out, "animation.tsv", &body);
  return ok;
}
