/* Whether formulas have a value on every periodic solution: what they divide by, invert and take roots of is collected
   from their trees, and each of it is shown to be zero nowhere, or to be zero on some orbit.  The latter follows from a
   family of orbits, one for each value of a parameter and proved so in balls, along which it changes its sign.  Where
   the first mass only touches the belt's velocity a family ends: what is zero there is so on that orbit, which is
   enclosed itself. */
#include <string.h>

#include "behaviour.h"
#include "certificate.h"
#include "explore/box.h"
#include "judge.h"
#include "proof/nonzero.h"
#include "value/expression.h"

struct defined {
  struct behaviour *b;
  struct divisor divisor[MOST_DIVISORS];
  const char *reason[MOST_DIVISORS]; /* why each is zero nowhere; NULL: not shown */
  int n;
  bool admissible;
  struct text shown, zero; /* divisors with reasons; the witness */
};

static bool overlaps(const struct dyn_orbit *a, const struct dyn_orbit *b) {
  return arb_overlaps(a->t[1], b->t[1]) && arb_overlaps(a->t[2], b->t[2]) && arb_overlaps(a->z10, b->z10) &&
         arb_overlaps(a->z20, b->z20);
}

/* The family's member at exact parameters: the only one of all orbits there, proved to be all, that meets the family's
   enclosure; p.orbit is its number. */
static bool find_member(struct point *p, const struct dyn_box_orbit *family, struct judge *j) {
  const struct dyn_orbits *list = orbit_cache_get(j->cache, p->q, FD_PREC);
  slong met = 0;
  p->kind = POINT_ORBIT;
  for (slong i = 0; i < list->n; i++) {
    if (!overlaps(&list->orbit[i], &family->orbit)) continue;
    p->orbit = i;
    met++;
  }
  const struct dyn_orbits *all = orbit_cache_solutions(j->cache, p->q, 0, FD_PREC);
  return met == 1 && all->complete && all->n == list->n;
}

/* The sign of the divisor at one end of the family; 0: unknown. */
static int sign_at(arb_t value, struct point *p, const struct divisor *q, const struct dyn_box_orbit *family,
                   struct behaviour *b) {
  bool known = find_member(p, family, b->j) &&
               expression_number(value, b->view, q->formula, q->section, p, FD_PREC, b->j->cache, b->j->d) == SS_OK;
  return known ? arb_is_positive(value) - arb_is_negative(value) : 0;
}

/* The two members of the family, those of the second under names with "(2)". */
static void certify(struct defined *y, const struct point end[2], const arb_t value[2]) {
  static const char *const second[] = {"e_2 (2)", "z_10 (2)", "z_20 (2)"};
  struct judge *j = y->b->j;
  struct certificate *c = &y->b->f->certificate;
  const struct dyn_orbit *o[2];
  for (int i = 0; i < 2; i++) o[i] = &orbit_cache_get(j->cache, end[i].q, FD_PREC)->orbit[end[i].orbit];
  certify_params(c, j, end[0].q + Q_CHI);
  certify_orbit(c, j, o[0]);
  certificate_add(c, j->out, "value", ball_text(j, value[0], 4));
  certify_exact(c, j, second[0], &end[1].q[Q_E2]);
  certify_ball(c, j, second[1], o[1]->z10);
  certify_ball(c, j, second[2], o[1]->z20);
  certificate_add(c, j->out, "value (2)", ball_text(j, value[1], 4));
}

static bool changes_sign(struct defined *y, const struct divisor *q, const struct dyn_box_orbit *family,
                         struct point end[2]) {
  arb_t value[2];
  int sign[2];
  for (int i = 0; i < 2; i++) {
    arb_init(value[i]);
    sign[i] = sign_at(value[i], &end[i], q, family, y->b);
  }
  bool negative = q->root && (sign[0] < 0 || sign[1] < 0);
  bool changes = negative || (!q->root && sign[0] * sign[1] < 0 && divisor_is_continuous(q, y->b->view, y->admissible));
  if (changes) {
    text_printf(&y->zero, "%s%s is ", y->zero.len ? "; " : "", q->formula);
    for (int i = 0; i < 2; i++) {
      text_printf(&y->zero, "%s%s at ", i ? " and " : "", ball_text(y->b->j, value[i], 4));
      point_print(&y->zero, &end[i]);
    }
    const char *sort = family->orbit.admissible == TRUTH_TRUE ? "admissible " : "";
    if (negative)
      text_printf(&y->zero, ", on %speriodic solutions, and a negative number has no square root", sort);
    else
      text_printf(&y->zero,
                  "; for all data between these there is one %speriodic solution (by Krawczyk's test in interval "
                  "arithmetic over the whole interval), so that the expression is zero for some of them",
                  sort);
    if (y->b->f->certificate.n == 0) certify(y, end, value);
  }
  for (int i = 0; i < 2; i++) arb_clear(value[i]);
  return changes;
}

/* Over each of the orbits that the family may be continued from. */
static bool has_zero(struct defined *y, const struct divisor *q, const struct dyn_box *box, struct point end[2]) {
  for (slong i = 0; i < box->n; i++) {
    const struct dyn_box_orbit *o = &box->at[i];
    bool counts = o->proved && o->word == TRUTH_TRUE && (!y->admissible || o->orbit.admissible == TRUTH_TRUE);
    if (counts && changes_sign(y, q, o, end)) return true;
  }
  return false;
}

/* --- Where the first mass only touches the belt's velocity --- */

static bool is_touch(const struct dyn_bifurcation *t, bool admissible) {
  bool first = t->what == CHANGE_TC && t->crosses;
  for (int ph = 0; ph < N_PHASES; ph++) first = first && t->touch.first[ph] == TRUTH_TRUE;
  return first && (!admissible || t->touch.admissible == TRUTH_TRUE);
}

/* The certificate, and "chi = 1/2, ..., e_2 = 1.10969761218845". */
static void say_where(struct defined *y, const struct family *f, const struct dyn_bifurcation *t) {
  struct judge *j = y->b->j;
  struct certificate c = {.n = 0};
  certify_member(&c, j, f->base.q, f->vary, &t->low, t->prec);
  for (int i = 0; i < c.n; i++)
    text_printf(&y->zero, "%s%s %s %s", i ? ", " : "", c.at[i].name, i == f->vary ? "near" : "=", c.at[i].value);
  certify_orbit(&c, j, &t->touch);
  if (y->b->f->certificate.n == 0) y->b->f->certificate = c;
}

/* The divisor, which is zero there, on the first such orbit of the family. */
static bool touches(struct defined *y, const struct divisor *q, const struct family *f) {
  OWNED(dyn_bifurcations) list;
  bool found = false;
  family_bifurcations(&list, f);
  for (slong i = 0; i < list.n && !found; i++) {
    if (!is_touch(&list.at[i], y->admissible)) continue;
    found = true;
    text_printf(&y->zero, "%s%s is zero on the %speriodic solution with ", y->zero.len ? "; " : "", q->formula,
                list.at[i].touch.admissible == TRUTH_TRUE ? "admissible " : "");
    say_where(y, f, &list.at[i]);
    text_add(&y->zero, ", on which z_1' = V and z_1'' = 0 at the end of the global slip phase and z_1' < V before it "
                       "(by Krawczyk's test in interval arithmetic on the equations of the periodic solution together "
                       "with z_1'' = 0)");
  }
  return found;
}

/* --- Along the family --- */

/* Is it one that may be zero, and is so where the first mass only touches the belt's velocity? */
static bool zero_by_touch(const struct defined *y, int i) {
  return !y->reason[i] && !y->divisor[i].root && zero_at_touch(&y->divisor[i], y->b->view);
}

/* Those whose sign at its two ends tells; the number of them. */
static long zeros_between(struct defined *y, const struct family *f) {
  struct point end[2];
  OWNED(dyn_box) box;
  long zeros = 0;
  for (int i = 0; i < 2; i++) {
    point_init(&end[i]);
    for (int k = 0; k < N_PARAMS; k++) fmpq_set(&end[i].q[k], &f->base.q[k]);
    fmpq_set(&end[i].q[f->vary], (fmpq_cmp(f->from, f->to) < 0) == (i == 0) ? f->from : f->to);
  }
  int s = dyn_box_find(&box, end[0].q, end[1].q, 0);
  for (int i = 0; s == SS_OK && i < y->n; i++)
    if (!y->reason[i] && !zero_by_touch(y, i)) zeros += has_zero(y, &y->divisor[i], &box, end);
  for (int i = 0; i < 2; i++) point_clear(&end[i]);
  return zeros;
}

/* How many of the divisors that may be zero are so on one of its orbits. */
static long zeros_along(struct defined *y, const struct family *f) {
  long zeros = 0;
  bool between = false;
  for (int i = 0; i < y->n; i++) {
    bool touch = zero_by_touch(y, i);
    if (touch) zeros += touches(y, &y->divisor[i], f);
    between = between || (!y->reason[i] && !touch);
  }
  return between ? zeros + zeros_between(y, f) : zeros;
}

static bool look_for_zeros(struct defined *y, long *zeros, const char *at, const char *vary) {
  OWNED(family) f;
  bool ok = family_open(&f, y->b, at, vary);
  if (ok) *zeros = zeros_along(y, &f);
  return ok && !y->b->j->d->set;
}

/* "a, b: reason", of all that are zero nowhere for the reason of divisor i, unless an earlier one has it. */
static void list_alike(struct defined *y, int i) {
  if (!y->reason[i]) return;
  for (int k = 0; k < i; k++)
    if (y->reason[k] && strcmp(y->reason[k], y->reason[i]) == 0) return;
  const char *sep = y->shown.len ? "; " : "";
  for (int k = i; k < y->n; k++) {
    if (!y->reason[k] || strcmp(y->reason[k], y->reason[i]) != 0) continue;
    text_printf(&y->shown, "%s%s", sep, y->divisor[k].formula);
    sep = ", ";
  }
  text_printf(&y->shown, ": %s", y->reason[i]);
}

static void look_for_reasons(struct defined *y, long *open) {
  for (int i = 0; i < y->n; i++) {
    const struct divisor *q = &y->divisor[i];
    y->reason[i] = nonzero_because(q, y->b->view, y->admissible);
    *open += !y->reason[i];
  }
  for (int i = 0; i < y->n; i++) list_alike(y, i);
}

/* "a and b": the divisors of which nothing is shown, or the numbers whose roots are taken; how many. */
static int open_ones(struct text *out, const struct defined *y, bool root) {
  int n = 0;
  for (int i = 0; i < y->n; i++)
    if (!y->reason[i] && y->divisor[i].root == root)
      text_printf(out, "%s%s", n++ ? " and " : "", y->divisor[i].formula);
  return n;
}

static struct route_result zero_route(struct defined *y) {
  struct behaviour *b = y->b;
  const struct route_result differs = {"balls", ROUTE_DIFFERS, true, 1};
  return behaviour_route(b, differs, NULL, result_copy(b->j->out, text_str(&y->zero)));
}

/* "a and b are not zero and c is positive", or "not shown to be nonzero everywhere: a and b; ...". */
static const char *open_text(const struct defined *y, bool condition) {
  static const char *const asked[] = {"not zero", "positive"}, *const unseen[] = {"nonzero", "positive"};
  struct text t = {0};
  for (int root = 0; root < 2; root++) {
    OWNED(text) list = {0};
    int n = open_ones(&list, y, root);
    if (n && condition)
      text_printf(&t, "%s%s %s %s", t.len ? " and " : "", text_str(&list), n > 1 ? "are" : "is", asked[root]);
    else if (n)
      text_printf(&t, "%snot shown to be %s everywhere: %s", t.len ? "; " : "", unseen[root], text_str(&list));
  }
  return result_take(y->b->j->out, &t);
}

static void conclude(struct defined *y, long open, long zeros) {
  struct behaviour *b = y->b;
  for (int i = 0; i < y->n; i++)
    if (!y->reason[i] && zero_everywhere(&y->divisor[i], b->view)) {
      const char *note = result_str(b->j->out, "%s is zero everywhere", y->divisor[i].formula);
      const struct route_result never = exact_route(b->f, b->j->out, ROUTE_DIFFERS, note);
      b->f->verdict = verdict_of(&never, 1, true);
      certificate_add(&b->f->certificate, b->j->out, "divisor", result_copy(b->j->out, y->divisor[i].formula));
      certificate_add(&b->f->certificate, b->j->out, "value", "0");
      return;
    }
  struct route_result w[2] = {{"exact", ROUTE_UNDECIDED, true, 1}};
  int n = 1;
  const char *shown = text_str(&y->shown);
  if (open)
    finding_state(b->f, b->j->out, "exact", layer_name[LAYER_CORRECTED], -1, -1, NULL,
                  result_str(b->j->out, "%s%s%s", open_text(y, false), y->shown.len ? "; shown: " : "", shown));
  else
    w[0] =
        exact_route(b->f, b->j->out, ROUTE_AGREES,
                    result_str(b->j->out, "none of these is zero: %s", y->shown.len ? shown : "there is no divisor"));
  if (zeros) w[n++] = zero_route(y);
  b->f->verdict = verdict_of(w, n, open == 0);
  if (b->f->verdict == VERDICT_REFUTED) b->f->condition = open_text(y, true);
}

static bool read_divisors(struct defined *y, struct judge *j, const struct claim *c, struct view view) {
  char ids[16][32];
  int n = claim_names_listed(ids, 16, claim_get(c, "statements"));
  if (n == 0) return claim_error(j, c, "statements", "the records whose formulas are to have a value");
  y->admissible = claim_over_admissible(c);
  if (!y->admissible && !claim_says(c, "over", "orbits") && !claim_says(c, "over", "parameters"))
    return claim_error(j, c, "over", "admissible, orbits or parameters");
  for (int i = 0; i < n; i++) {
    const struct statement_record *r = view_record(&view, ids[i]);
    if (!r) return claim_error(j, c, "statements", "there is no such record");
    if (!divisors_of(y->divisor, &y->n, &j->out->arena, r, view))
      return claim_error(j, c, "statements", "too many divisors");
  }
  return true;
}

static bool look(struct defined *y, long *open, long *zeros) {
  struct judge *j = y->b->j;
  const struct claim *c = y->b->c;
  const char *at = claim_get(c, "at"), *vary = claim_get(c, "vary");
  bool ok = read_divisors(y, j, c, y->b->view);
  if (ok && !at != !vary) ok = claim_error(j, c, at ? "at" : "vary", "a family has both at and vary");
  if (ok) look_for_reasons(y, open);
  return ok && (*open == 0 || !at || look_for_zeros(y, zeros, at, vary));
}

static void defined_clear(struct defined *y) {
  text_clear(&y->zero);
  text_clear(&y->shown);
}

bool judge_defined(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view, NULL};
  OWNED(defined) y = {.b = &b};
  long open = 0, zeros = 0;
  bool ok = look(&y, &open, &zeros);
  if (ok) conclude(&y, open, zeros);
  return ok;
}
