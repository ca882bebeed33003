/* A system printed: one walk over its matrices, in two notations. */
#include "describe.h"

#include <stdlib.h>
#include <string.h>

#include "orbit.h"

struct printer {
  struct text *out;
  const struct mech *m;
  bool latex;
  slong digits;
};

/* --- Linear forms --- */

/* |q| as a factor: nothing for 1. */
static void add_factor(const struct printer *p, const fmpq_t q) {
  NUMBERS(fmpq, size);
  fmpq_abs(size, q);
  if (!fmpq_is_one(size)) {
    if (p->latex && !fmpz_is_one(fmpq_denref(size))) {
      text_add(p->out, "\\frac{");
      num_print_fixed(p->out, fmpq_numref(size), 0);
      text_add(p->out, "}{");
      num_print_fixed(p->out, fmpq_denref(size), 0);
      text_add(p->out, "} ");
    } else {
      num_print_q(p->out, size);
      text_add_char(p->out, ' ');
    }
  }
}

/* The frequency of an order, then t. */
static void add_angle(const struct printer *p, int order) {
  NUMBERS(fmpq, frequency);
  fmpq_mul_si(frequency, p->m->frequency, order);
  add_factor(p, frequency);
  text_add_char(p->out, 't');
}

static void add_state(const struct printer *p, int j) {
  if (j >= 2 * p->m->n) {
    int pair = j - 2 * p->m->n;
    text_printf(p->out, "%s%s(", p->latex ? "\\" : "", pair % 2 == 0 ? "cos" : "sin");
    add_angle(p, p->m->order[pair / 2]);
    text_add_char(p->out, ')');
    return;
  }
  bool rate = j >= p->m->n;
  int i = rate ? j - p->m->n : j;
  text_printf(p->out, p->latex ? "x_{%d}%s" : "x_%d%s", i + 1, rate ? "'" : "");
}

static void add_constant(const struct printer *p, const fmpq_t q) {
  if (fmpq_is_pm1(q))
    text_add_char(p->out, '1');
  else
    add_factor(p, q);
  while (p->out->len && p->out->data[p->out->len - 1] == ' ') p->out->data[--p->out->len] = '\0';
}

/* row y, y as in mech.h. */
static void add_form(const struct printer *p, const fmpq *row) {
  int one = p->m->states;
  bool any = false;
  for (int j = 0; j <= one; j++) {
    if (fmpq_is_zero(row + j)) continue;
    bool minus = fmpq_sgn(row + j) < 0;
    text_add(p->out, any ? minus ? " - " : " + " : minus ? "-" : "");
    any = true;
    if (j == one) {
      add_constant(p, row + j);
      continue;
    }
    add_factor(p, row + j);
    add_state(p, j);
  }
  if (!any) text_add_char(p->out, '0');
}

/* --- The parts --- */

static void begin_line(const struct printer *p, const char *name) {
  if (p->latex)
    text_printf(p->out, "\\text{%s: } & ", name);
  else
    text_printf(p->out, "  %-10s ", name);
}

static void end_line(const struct printer *p) {
  text_add(p->out, p->latex ? " \\\\\n" : "\n");
}

static void heading(const struct printer *p, const char *what) {
  if (p->latex)
    text_printf(p->out, "\\text{%s} & \\\\\n", what);
  else
    text_printf(p->out, "%s\n", what);
}

/* f_i = K x + C x' less the loads, as the condition "f_i - r_i" has it. */
static void add_forces(const struct printer *p) {
  const struct mech *m = p->m;
  SIZED(fmpq_mat, row, 1, m->states + 1);
  heading(p, "Equations of motion");
  for (int i = 0; i < m->n; i++) {
    const struct mech_mass *mass = &m->mass[i];
    mech_condition(row, m, i, 's', MECH_BREAKS_SLOWER);
    fmpq_zero(fmpq_mat_entry(row, 0, m->states));
    begin_line(p, mass->name);
    add_factor(p, mass->inertia);
    text_printf(p->out, p->latex ? "x_{%d}'' = " : "x_%d'' = ", i + 1);
    if (mass->rubbed) text_printf(p->out, p->latex ? "u_{%d} - f_{%d}, \\quad " : "u_%d - f_%d, ", i + 1, i + 1);
    if (!mass->rubbed) text_printf(p->out, p->latex ? "-f_{%d}, \\quad " : "-f_%d, ", i + 1);
    text_printf(p->out, p->latex ? "f_{%d} = " : "f_%d = ", i + 1);
    add_form(p, fmpq_mat_entry(row, 0, 0));
    end_line(p);
  }
}

static void add_frictions(const struct printer *p) {
  heading(
      p,
      "Friction, and where it changes: a mass that sticks breaks loose, one that slips reaches its surface's velocity");
  for (int i = 0; i < p->m->n; i++) {
    const struct mech_mass *mass = &p->m->mass[i];
    begin_line(p, mass->name);
    if (!mass->rubbed) {
      text_add(p->out, p->latex ? "\\text{none}" : "none");
      end_line(p);
      continue;
    }
    const char *u = p->latex ? "|u_{%d}| \\le " : "|u_%d| <= ",
               *slips = p->latex ? ", \\quad u_{%d} = \\pm " : ", u_%d = +-";
    text_printf(p->out, u, i + 1);
    add_constant(p, mass->limit);
    text_printf(p->out, slips, i + 1);
    add_constant(p, mass->sliding);
    text_printf(p->out, p->latex ? "; \\quad |f_{%d}| = " : "; |f_%d| = ", i + 1);
    add_constant(p, mass->limit);
    text_printf(p->out, p->latex ? ", \\quad x_{%d}' = " : ", x_%d' = ", i + 1);
    if (fmpq_sgn(mass->surface) < 0) text_add_char(p->out, '-');
    if (fmpq_is_zero(mass->surface))
      text_add_char(p->out, '0');
    else
      add_constant(p, mass->surface);
    end_line(p);
  }
}

/* x_1 <= 2, x_1' -> -1/2 x_1' */
static void add_stop(const struct printer *p, int i, bool above) {
  const struct mech_stop *stop = &p->m->mass[i].stop[above];
  begin_line(p, stop->name);
  add_state(p, i);
  text_add(p->out, p->latex ? above ? " \\le " : " \\ge " : above ? " <= " : " >= ");
  num_print_q(p->out, stop->position);
  text_add(p->out, p->latex ? ", \\quad " : ", ");
  add_state(p, p->m->n + i);
  text_add(p->out, p->latex ? " \\to " : " -> ");
  if (fmpq_is_zero(stop->restitution)) {
    text_add_char(p->out, '0');
  } else {
    text_add_char(p->out, '-');
    add_factor(p, stop->restitution);
    add_state(p, p->m->n + i);
  }
  end_line(p);
}

static void add_obstacles(const struct printer *p) {
  bool any = false;
  for (int i = 0; i < p->m->n; i++)
    for (int s = 0; s < 2; s++) {
      if (!p->m->mass[i].stop[s].given) continue;
      if (!any) heading(p, "Obstacles, and the velocity of a mass that reaches them");
      any = true;
      add_stop(p, i, s);
    }
}

static int by_imaginary(const void *a, const void *b) {
  int c = arf_cmp(arb_midref(acb_imagref((acb_srcptr)a)), arb_midref(acb_imagref((acb_srcptr)b)));
  return c ? c : arf_cmp(arb_midref(acb_realref((acb_srcptr)a)), arb_midref(acb_realref((acb_srcptr)b)));
}

static void add_eigenvalue(const struct printer *p, acb_srcptr z) {
  if (p->m->n_dampers > 0) {
    num_print_ball(p->out, acb_realref(z), p->digits);
    if (arb_is_zero(acb_imagref(z))) return;
    text_add(p->out, p->latex ? " \\pm i \\, " : " +- i ");
  }
  num_print_ball(p->out, acb_imagref(z), p->digits);
}

/* Of the first-order system, those in the upper half plane: +-i w without dampers. */
static void add_modes(const struct printer *p) {
  const struct mech *m = p->m;
  slong side = m->states + 1, moving = 2 * m->n, prec = 4 * p->digits + 64;
  char phase[MECH_MASSES + 1] = "";
  for (int i = 0; i < m->n; i++) phase[i] = '.';
  arb_mat_t states;
  SIZED(arb_mat, a, side, side);
  SIZED(fmpq_mat, rate, side, side);
  acb_ptr z = _acb_vec_init(moving);
  mech_rate(rate, m, phase);
  arb_mat_set_fmpq_mat(a, rate, prec);
  arb_mat_window_init(states, a, 0, 0, moving, moving);
  bool ok = mech_eigenvalues(z, states, prec);
  heading(p, m->n_dampers > 0 ? "Eigenvalues while every mass slips or is free"
                              : "Natural frequencies while every mass slips or is free");
  begin_line(p, "");
  qsort(z, (size_t)moving, sizeof *z, by_imaginary);
  bool any = false;
  for (slong i = 0; ok && i < moving; i++) {
    if (arb_is_negative(acb_imagref(z + i))) continue;
    text_add(p->out, any ? ", " : "");
    add_eigenvalue(p, z + i);
    any = true;
  }
  if (!ok) text_add(p->out, p->latex ? "\\text{not told apart}" : "not told apart");
  end_line(p);
  _acb_vec_clear(z, moving);
  arb_mat_window_clear(states);
}

void mech_describe(struct text *out, const struct mech *m, bool latex, slong digits) {
  const struct printer p = {out, m, latex, digits};
  if (latex)
    text_add(out, "\\begin{aligned}\n");
  else
    text_printf(out, "%s: %d mass%s, %d spring%s, %d damper%s, %d load%s\n", *m->title ? m->title : "a system", m->n,
                m->n == 1 ? "" : "es", m->n_springs, m->n_springs == 1 ? "" : "s", m->n_dampers,
                m->n_dampers == 1 ? "" : "s", m->n_loads, m->n_loads == 1 ? "" : "s");
  add_forces(&p);
  add_frictions(&p);
  add_obstacles(&p);
  add_modes(&p);
  if (latex) text_add(out, "\\end{aligned}\n");
}

void mech_names_print(struct text *out, const struct mech *m) {
  char counted[16];
  bool same = true;
  for (int i = 0; i < m->n; i++) {
    snprintf(counted, sizeof counted, "m%d", i + 1);
    same = same && strcmp(m->mass[i].name, counted) == 0;
  }
  for (int i = 0; i < m->n && !same; i++) text_printf(out, "%s%s", i ? ", " : "masses in order: ", m->mass[i].name);
  if (!same) text_add_char(out, '\n');
}
