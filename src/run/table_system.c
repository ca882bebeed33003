/* The orbits of a system file, sampled: what their phase planes are drawn from.  A phase is sampled at equal times, its
   ends included, in balls. */
#include "tables.h"

enum { DECIMALS = 6 };

static void add_row(struct text *out, const char *what, const struct mech *m, const char *phase, const char *mark,
                    arb_srcptr time, const arb_mat_t y) {
  text_printf(out, "%s\t%s\t%s", what, phase, mark);
  table_number(out, time, DECIMALS);
  for (int k = 0; k < 2 * m->n; k++) table_number(out, arb_mat_entry(y, k % 2 * m->n + k / 2, 0), DECIMALS);
  text_add_char(out, '\n');
}

static void add_phase(struct text *out, const char *what, const struct mech *m, const struct mech_orbit *o, int k,
                      arb_t time) {
  slong side = m->states + 1;
  NUMBERS(arb, step);
  SIZED(fmpq_mat, exact, side, side);
  SIZED(arb_mat, flow, side, side);
  SIZED(arb_mat, y, side, 1);
  double share = arf_get_d(arb_midref(o->t + k), ARF_RND_NEAR) / arf_get_d(arb_midref(o->period), ARF_RND_NEAR);
  slong n = table_pieces(share);
  arb_div_si(step, o->t + k, n, FIRST_PREC);
  mech_rate(exact, m, o->word.phase[k]);
  arb_mat_set_fmpq_mat(flow, exact, FIRST_PREC);
  arb_mat_scalar_mul_arb(flow, flow, step, FIRST_PREC);
  arb_mat_exp(flow, flow, FIRST_PREC);
  for (int i = 0; i < m->states; i++) arb_set(arb_mat_entry(y, i, 0), o->state + k * o->states + i);
  arb_one(arb_mat_entry(y, m->states, 0));
  for (slong i = 0; i <= n; i++) {
    add_row(out, what, m, o->word.phase[k], i ? "-" : "o", time, y);
    if (i == n) break;
    arb_mat_mul(y, flow, y, FIRST_PREC);
    arb_add(time, time, step, FIRST_PREC);
  }
}

/* The velocities of the surfaces, or the places of the obstacles on one side. */
static void add_limits(struct text *out, const char *what, const struct mech *m) {
  NUMBERS(arb, x);
  text_printf(out, "%s\t-\t-\t-", what);
  for (int i = 0; i < m->n; i++) {
    const struct mech_mass *mass = &m->mass[i];
    bool surface = what[0] == 's';
    const struct mech_stop *stop = &mass->stop[what[0] == 'a'];
    arb_set_fmpq(x, surface ? mass->surface : stop->position, FIRST_PREC);
    for (int k = 0; k < 2; k++)
      table_number(out, (surface ? k && mass->rubbed : !k && stop->given) ? x : NULL, DECIMALS);
  }
  text_add_char(out, '\n');
}

void table_of_system(struct audit_result *out, const struct mech *m, const struct mech_orbits *list) {
  struct text t = {0};
  NUMBERS(arb, time);
  text_add(&t, "# Phase planes of the orbits of a system.\n"
               "# what orbit K: the K-th orbit, and what keeps it from being a motion for certain, its phases in "
               "order, mark o where one begins; surface: the velocities of the "
               "surfaces; above, below: the places of the obstacles.  All in the units of the system "
               "file.\nwhat\tphase\tmark\tt");
  for (int i = 1; i <= m->n; i++) text_printf(&t, "\tx_%d\tx'_%d", i, i);
  text_add_char(&t, '\n');
  for (int k = 0; k < list->n; k++) {
    const struct mech_orbit *o = &list->orbit[k];
    char what[48];
    snprintf(what, sizeof what, "orbit %d%s", k + 1,
             !o->certified                  ? " is not certified"
             : o->admissible == TRUTH_FALSE ? " breaks Coulomb's law"
                                            : "");
    arb_zero(time);
    for (int ph = 0; ph < o->word.n; ph++) add_phase(&t, what, m, o, ph, time);
  }
  static const char *const limits[] = {"surface", "above", "below"};
  for (int i = 0; i < 3; i++) add_limits(&t, limits[i], m);
  table_finish(out, "phase-planes.tsv", &t);
}
