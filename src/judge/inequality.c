/* Inequalities at the scene's own numbers.  The domain is one set of exact parameters, so an enclosure that settles it
   is a proof.  Those between a paper's own symbols are tried at points of their domains, where one can be refuted. */
#include <string.h>

#include "base/work.h"
#include "certificate.h"
#include "tape/exact.h"
#include "value/names.h"
#include "value/printed.h"

static const char no_number[] = "what holds along a phase is no inequality of numbers: kind argument, over scene";

static bool goes_with_time(const struct tape *t) {
  bool any = false;
  for (slong i = 0; i < t->n_inputs; i++) any = any || name_goes_with_time(t->inputs[i]);
  return any;
}

/* Are the sides the same function of what they read?  Enclosures do not tell. */
static bool sides_are_one(const struct tape *t) {
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = exact_calc(f);
  struct num_vec side;
  return exact_eval(&side, &c, f, t) == SS_OK && exact_equal(f, num_vec_at(&side, 0), num_vec_at(&side, 1));
}

/* Does side a of the tape stand to side b as the step says?  *unbound: of what no value is known; *finite: both sides
   have values. */
static truth step_holds(const char **unbound, bool *finite, struct judge *j, const struct tape *tape, enum relop op,
                        const struct point *p, slong prec) {
  OWNED(values) v;
  struct num_ctx ctx = num_ctx_arb(prec);
  int s = values_init(&v, p, VARIANT_CLOSED, ctx, j->cache);
  *finite = false;
  struct num_vec in = calc_vec(&v.c, tape->n_inputs), out = calc_vec(&v.c, 2);
  for (slong i = 0; s == SS_OK && i < tape->n_inputs; i++) {
    const char *name = tape->inputs[i];
    bool known, is_u_r = strcmp(name, "u_r1") == 0 || strcmp(name, "u_r2") == 0;
    int key = strcmp(name, "u_r1") == 0 ? KEY_U_R1 : KEY_U_R2;
    if (name_is_free(name) || (is_u_r && !j->scene->given[key])) *unbound = result_copy(j->out, name);
    if (is_u_r)
      s |= ctx.type->set_q(num_vec_at(&in, i), &j->scene->value[key], prec);
    else
      s |= values_bind(num_vec_at(&in, i), &known, &v, name);
  }
  if (s == SS_OK) s |= tape_eval(&out, NULL, tape, &in);
  if (s != SS_OK || *unbound) return TRUTH_UNKNOWN;
  *finite = arb_is_finite(num_vec_at(&out, 0)) && arb_is_finite(num_vec_at(&out, 1));
  return inequality_holds(ctx.type, op, num_vec_at(&out, 0), num_vec_at(&out, 1));
}

/* Do values that are printed as these tell otherwise?  A decimal stands for all of them. */
static bool others_differ(struct judge *j, const struct tape *tape, enum relop op) {
  const char *unbound = NULL;
  bool finite;
  LOCAL(point, p);
  if (!printed_point(&p, j->scene)) return false;
  for (int k = 0; k < N_READINGS * PRINTED_CORNERS; k++) {
    printed_corner(&p, j->scene, NULL, (enum reading)(k / PRINTED_CORNERS), false, k % PRINTED_CORNERS);
    if (step_holds(&unbound, &finite, j, tape, op, &p, FIRST_PREC) != TRUTH_FALSE) return true;
  }
  return false;
}

static bool holds_step(truth *holds, const char **unbound, struct judge *j, const struct claim *c,
                       const struct statement_record *r, const struct stmt *st, int k, struct view view,
                       const struct point *p) {
  OWNED(elaboration) el;
  OWNED(tape) tape = {.n = 0};
  struct matrix a, b;
  elaboration_init(&el, view, NULL, 0);
  bool ok = elaborate_sides(&a, &b, &el, st, k, r->src, r->section, j->d);
  if (ok && a.rows * a.cols != 1) ok = diag_at(j->d, r->src, st->span.begin, "an inequality needs scalars");
  bool first = false, finite = false;
  enum relop op = st->ops[k];
  *holds = TRUTH_UNKNOWN;
  *unbound = NULL;
  ok = ok && elaboration_tape(&tape, &el, (const struct expr *const[]){a.e[0], b.e[0]}, 2, j->d);
  if (ok && goes_with_time(&tape)) ok = claim_error(j, c, "statement", no_number);
  for (slong prec = FIRST_PREC; ok && *holds == TRUTH_UNKNOWN && !*unbound && prec <= LAST_PREC; prec *= 2) {
    *holds = step_holds(unbound, &finite, j, &tape, op, p, prec);
    first = first || (prec == FIRST_PREC && *holds != TRUTH_UNKNOWN);
  }
  if (ok && !*unbound) work_precision_raise(LADDER_INEQUALITY, first);
  if (*holds == TRUTH_FALSE && p->kind == POINT_PRINTED && others_differ(j, &tape, op))
    *holds = TRUTH_UNKNOWN;
  else if (*holds == TRUTH_UNKNOWN && finite && !*unbound && sides_are_one(&tape))
    *holds = op == REL_LT || op == REL_GT ? TRUTH_FALSE : TRUTH_TRUE;
  return ok;
}

/* The scene's data, the printed solution or the orbit, and the step that fails there. */
static void certify(struct finding *f, struct judge *j, const struct point *p, const char *step) {
  struct certificate *c = &f->certificate;
  certify_scene(c, j);
  if (p->kind == POINT_ORBIT) {
    certify_orbit(c, j, scene_orbit(j->scene, j->cache));
  } else {
    for (int i = 0; i < 2; i++) certify_exact(c, j, name_state[0][i], &p->q[Q_Z1 + i]);
    for (int k = 0; k < N_PHASES; k++) certify_exact(c, j, name_time[k], &p->q[Q_TA + k]);
  }
  certificate_add(c, j->out, "fails", result_copy(j->out, step));
}

/* All steps of the record at one point: what it says, and a list of what failed and what could not be tried. */
static bool try_inequalities(struct route_result *w, struct finding *f, struct judge *j, const struct claim *c,
                             const struct statement_record *r, struct view view, const struct point *p,
                             const char *where) {
  OWNED(text) note = {0};
  long tried = 0, failed = 0, unknown = 0;
  bool ok = true;
  for (int i = 0; ok && i < r->n_stmts; i++)
    for (int k = 0; ok && k + 1 < r->stmts[i]->n_sides; k++) {
      truth holds;
      const char *unbound;
      ok = holds_step(&holds, &unbound, j, c, r, r->stmts[i], k, view, p);
      OWNED(text) step = {0};
      stmt_print_step(&step, r->stmts[i], k);
      if (unbound) {
        text_printf(&note, "%s%s was not tried, since %s is not given", note.len ? "; " : "", text_str(&step), unbound);
        f->condition = name_is_free(unbound)
                           ? result_str(j->out, "only for what does not contain %s, which is not given", unbound)
                           : "only for what does not contain u_r1 or u_r2, which are not given";
      } else {
        tried++;
        failed += holds == TRUTH_FALSE;
        unknown += holds == TRUTH_UNKNOWN;
        if (holds == TRUTH_FALSE && f->certificate.n == 0) certify(f, j, p, text_str(&step));
        if (holds != TRUTH_TRUE)
          text_printf(&note, "%s%s: %s", note.len ? "; " : "", text_str(&step),
                      holds == TRUTH_FALSE ? "false" : "undecided");
      }
    }
  *w = (struct route_result){"balls", outcome_of_counts(tried, failed, unknown + !tried), true, tried};
  finding_add_route(f, j->out, *w, layer_name[view.layer], FIRST_PREC, where,
                    note.len ? result_copy(j->out, text_str(&note)) : NULL);
  return ok;
}

bool judge_inequality(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *id = claim_get(c, "statement");
  const struct statement_record *r = id ? view_record(&view, id) : NULL;
  if (r && !j->model->system && record_has_equation(r))
    return claim_error(j, c, "statement",
                       "an equation is judged by kind: identity, and an inequality beside it is its condition");
  if (!j->model->system) return judge_points(f, j, c, view);
  if (!r) return claim_error(j, c, "statement", "there is no such record in the equation files");
  for (int k = 0; k < r->n_stmts; k++)
    if (r->stmts[k]->range_hi) return claim_error(j, c, "statement", no_number);
  LOCAL(point, printed, orbit);
  struct route_result w[2];
  int n = 0;
  bool ok = true;
  if (printed_point(&printed, j->scene))
    ok = try_inequalities(&w[n++], f, j, c, r, view, &printed, "the printed numbers");
  if (ok && nearest_orbit_point(&orbit, j->scene, j->cache))
    ok = try_inequalities(&w[n++], f, j, c, r, view, &orbit, usual_orbit_text(j, "periodic solution"));
  if (ok && n == 0)
    finding_skip(f, j, "the scene prints no solution and has no orbit");
  else if (ok)
    f->verdict = verdict_of(w, n, true);
  if (f->verdict == VERDICT_REFUTED)
    f->condition = NULL; /* whatever could not be tried */
  else
    f->certificate.n = 0;
  return ok;
}
