/* The hypotheses of the theorem of linearized stability (linearized.h), each as one function that says in words what it
   has shown. */
#include "linearized.h"

#include <stdlib.h>

#include "exact_motion_impl.h"
#include "nonzero.h"
#include "num/calc.h"
#include "value/expression.h"

/* --- Each phase ends transversally --- */

/* Is x^2 = q y^2 with q a number times powers of chi, eta and V?  Squares, since y may have omega = sqrt(chi*eta). */
static bool same_but_for_units(const element *x, const element *y, struct exact_motion *m) {
  element *xx = calc_new(&m->c), *yy = calc_new(&m->c);
  return motion_op(num_exact.mul, xx, m, x, x) == SS_OK && motion_op(num_exact.mul, yy, m, y, y) == SS_OK &&
         !exact_is_zero(yy) && exact_ratio_sign(m->field, xx, yy, name_param, P_V + 1) != 0;
}

/* Does the tape divide by x, which then is not zero where the tape has a value? */
static bool divides_by(const struct tape *t, const element *x, struct exact_motion *m) {
  struct tape divisors = *t;
  struct num_vec v;
  divisors.n_outputs = 0;
  divisors.outputs = ss_malloc((size_t)(t->n + 1) * sizeof *divisors.outputs);
  for (slong i = 0; i < t->n; i++)
    if (t->code[i].op == TAPE_div) divisors.outputs[divisors.n_outputs++] = t->code[i].b;
  FREED int *status = ss_malloc((size_t)(t->n + 1) * sizeof *status);
  bool found = false;
  exact_eval_each(&v, status, &m->c, m->field, &divisors, NULL);
  for (slong i = 0; i < v.len && !found; i++) found = status[i] == SS_OK && same_but_for_units(x, num_vec_at(&v, i), m);
  free(divisors.outputs);
  return found;
}

/* The rate at which the phase's switching function passes zero: never zero, or what the paper's matrix divides by. */
static bool ends_transversally(struct text *note, int phase, struct view view) {
  OWNED(tape) t;
  OWNED(exact_motion) m;
  struct num_vec z;
  bool ok = formula_tape(&t, view, local_maps[phase].name, "stability", NULL, 0);
  exact_motion_free(&m, false, 4, &t);
  element *rate = calc_new(&m.c);
  ok = ok && motion_state(&z, &m, phase + 1) == SS_OK &&
       dyn_switching_rate(rate, (enum phase)phase, &m.params, &z) == SS_OK && exact_reduce(rate, m.field) == SS_OK;
  bool always = ok && motion_sign(rate, &m) != 0;
  ok = always || (ok && divides_by(&t, rate, &m));
  if (ok) {
    text_add(note, phase ? ", " : "");
    exact_print(note, m.field, rate);
    text_printf(note, always ? " (never zero)" : " (a denominator of %s)", local_maps[phase].name);
  }
  return ok;
}

static bool all_transversal(struct text *note, struct view view) {
  text_add(note, "(i) the switching functions at the ends of the four phases pass zero at the rates ");
  for (int phase = 0; phase < N_PHASES; phase++)
    if (!ends_transversally(note, phase, view)) return false;
  text_add(note, ", none of which is zero where J has a value, so that the times are analytic functions of the state");
  return true;
}

/* --- No other condition is met with equality --- */

/* Component i of the rate in that phase at switching state k. */
static int rate_at(element *x, struct exact_motion *m, int k, int phase, int i) {
  struct num_vec f = calc_vec(&m->c, 4);
  int s = motion_rate_at(&f, m, k, phase);
  if (s == SS_OK) num_exact.set(x, at(&f, i));
  return s;
}

static bool others_strict(struct text *note) {
  OWNED(exact_motion) m;
  exact_motion_free(&m, false, 4, NULL);
  struct num_vec x = calc_vec(&m.c, 2);
  const char *first = first_mass_is_slower(), *second = second_mass_is_slower();
  int s = rate_at(at(&x, 0), &m, 1, PHASE_GAMMA, DZ_1) | rate_at(at(&x, 1), &m, 2, PHASE_H, DZ_2);
  bool ok = s == SS_OK && motion_sign(at(&x, 0), &m) < 0 && motion_sign(at(&x, 1), &m) < 0 && first && second;
  if (ok) {
    text_add(note,
             "; (ii) every other condition of the phases holds strictly up to their ends, so that neighbours on "
             "z_1' = z_2' = V have the same phases and the return map is analytic: (11) and (16) are strict, a mass "
             "leaves the belt with z_1'' = ");
    exact_print(note, m.field, at(&x, 0));
    text_add(note, " < 0 and z_2'' = ");
    exact_print(note, m.field, at(&x, 1));
    text_printf(note, " < 0, %s, and %s", first, second);
  }
  return ok;
}

/* --- The eigenvalues, and what the criterion says of them --- */

/* By how much step i of the inequalities holds, *weak where it does at the limit too; SS_UNABLE for an equality. */
static int margin(element *z, bool *weak, const struct exact_field *f, const struct sentence *s,
                  const struct num_vec *sides, slong i) {
  const element *left = at(sides, i), *right = at(sides, s->n + i);
  enum relop op = s->ops[i];
  bool less = op == REL_LT || op == REL_LE;
  *weak = op == REL_LE || op == REL_GE;
  return op != REL_EQ && exact_sub(z, f, less ? right : left, less ? left : right) ? SS_OK : SS_UNABLE;
}

/* The two margins are 1 + tr J and 1 - tr J, in either order, or the one margin is their product, each times a number
   and powers of chi, eta and V.  takes_in: whether they hold at tr J = -1, at 1. */
static bool says_inside(bool takes_in[2], struct exact_field *f, const struct sentence *s, const struct num_vec *sides,
                        const element *trace) {
  OWNED(calc) c = exact_calc(f);
  val one = calc_d(&c, 1), above = calc_add(&c, one, trace), below = calc_sub(&c, one, trace);
  element *made[2] = {calc_new(&c), calc_new(&c)};
  bool weak[2] = {false, false};
  if (s->n > 2) return false;
  for (slong i = 0; c.status == SS_OK && i < s->n; i++) c.status = margin(made[i], &weak[i], f, s, sides, i);
  val m[2] = {made[0], made[1]};
  if (s->n == 1) m[1] = calc_div(&c, m[0], above);
  if (s->n == 1) m[0] = above;
  if (s->n == 1) weak[1] = weak[0];
  bool yes = false;
  for (int i = 0; c.status == SS_OK && !yes && i < 2; i++) {
    yes = exact_ratio_sign(f, m[i], above, name_param, P_V + 1) > 0 &&
          exact_ratio_sign(f, m[1 - i], below, name_param, P_V + 1) > 0;
    takes_in[0] = weak[i];
    takes_in[1] = weak[1 - i];
  }
  return yes;
}

static bool eigenvalues_as_said(struct text *note, bool takes_in[2], const struct statement_record *r,
                                struct view view) {
  struct override o[N_PHASES];
  LOCAL(arena, a);
  const struct stmt *between = r->n_stmts == 1 ? stmt_between(&a, r->stmts[0]) : NULL;
  struct statement_record unfolded = *r;
  OWNED(sentence) s;
  struct diag d = {0};
  struct matrix trace, det;
  OWNED(tape) t = {.n = 0};
  int n = 0;
  if (between) unfolded.stmts = &between;
  for (int ph = 0; ph < N_PHASES; ph++) n += oracle_override(&o[n], local_maps[ph].name); /* of the paper's chain */
  bool ok = sentence_from_relations(&s, view, &unfolded, o, n, &d) &&
            elaborate_text(&trace, &s.el, "tr(J)", "tr(J)", "stability", &d) &&
            elaborate_text(&det, &s.el, "det(J)", "det(J)", "stability", &d);
  if (ok) ok = elaboration_tape(&t, &s.el, (const struct expr *const[]){trace.e[0], det.e[0]}, 2, &d);
  if (ok) {
    EXACT_FIELD f = exact_field_new(NULL, 0);
    OWNED(calc) c = exact_calc(f);
    struct num_vec sides, of_chain;
    int status = exact_eval(&sides, &c, f, &s.tape) | exact_eval(&of_chain, &c, f, &t);
    ok = status == SS_OK && exact_is_zero(at(&of_chain, 1)) && says_inside(takes_in, f, &s, &sides, at(&of_chain, 0));
  }
  if (ok)
    text_printf(note,
                "; (iv) det J = 0, so that the eigenvalues of J are 0 and tr J, and the inequalities say |tr J| < 1%s",
                takes_in[0] || takes_in[1] ? ", or = 1, where the theorem says nothing" : "");
  return ok;
}

/* --- All of it --- */

bool linearized_proves(const struct linearized *l) {
  return l->apart && !l->takes_in[0] && !l->takes_in[1];
}

struct linearized linearized_stability(struct judge *j, const struct statement_record *criterion, struct view view) {
  OWNED(text) note = {0};
  const char *missing = NULL;
  struct linearized l = {.apart = false};
  text_add(&note, "by the theorem of linearized stability for a fixed point of a C^1 map, on every admissible periodic "
                  "solution at which J has a value; its hypotheses: ");
  if (!all_transversal(&note, view))
    missing = "that each phase ends transversally";
  else if (!others_strict(&note))
    missing = "that the other conditions are strict";
  else if (!exact_prove_jacobian(j, view).proved)
    missing = "that J is the derivative of the return map";
  else
    text_add(&note,
             "; (iii) J is the derivative of the return map: its factors are those of the four phases, by implicit "
             "differentiation at their events");
  if (!missing && !eigenvalues_as_said(&note, l.takes_in, criterion, view))
    missing = "that the eigenvalues of J are 0 and tr J and that the inequalities say |tr J| < 1";
  l.apart = !missing;
  if (missing) l.takes_in[0] = l.takes_in[1] = false;
  l.note = missing ? result_str(j->out, "not proved, since it is not shown: %s", missing) : result_take(j->out, &note);
  return l;
}
