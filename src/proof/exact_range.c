/* Ranges of conditions by exact algebra, see exact_range.h. */
#include "exact_range.h"

#include "exact_argument.h"
#include "exact_motion_impl.h"

/* --- Signs --- */

/* A product of what is positive on the whole domain, sqrt(chi*eta) among it, and of the fact (or NULL). */
static bool is_product(struct exact_motion *m, val x, val fact) {
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec positive = calc_vec(&c, EXACT_POSITIVE + 1);
  int n = exact_motion_positive(&positive, m);
  val stiff = calc_mul(&c, at(&m->params, P_CHI), at(&m->params, P_ETA));
  c.status |= exact_sqrt(at(&positive, n), m->field, stiff);
  val rest = fact ? calc_div(&c, x, fact) : x;
  return n > 0 && c.status == SS_OK && exact_product_sign(rest, at(&positive, 0), n + 1) > 0;
}

/* Positive for all parameters, e_1 > 0 among them. */
static bool is_positive(struct exact_motion *m, val x) {
  OWNED(calc) c = exact_calc(m->field);
  element *e1 = calc_new(&c);
  c.status |= exact_motion_bind(e1, m->field, "e_1", m);
  return is_product(m, x, NULL) || (c.status == SS_OK && is_product(m, x, e1));
}

/* --- The form --- */

/* On one motion: the margin or minus its rate, the parts, the premise's margin, and x with its sine and cosine. */
struct on_motion {
  struct exact_motion m;
  val margin, part[N_RANGE_PARTS], premise, x, sine, cosine;
};

static val tape_value(struct on_motion *s, const struct tape *t) {
  element *z = calc_new(&s->m.c);
  if (!exact_margin(z, &s->m, t)) s->m.c.status |= SS_UNABLE;
  return z;
}

static void angle(val *x, val *sine, val *cosine, struct on_motion *s, const char *time) {
  element *u = calc_new(&s->m.c), *a = calc_new(&s->m.c), *b = calc_new(&s->m.c);
  s->m.c.status |= exact_symbol(u, s->m.field, time);
  *x = calc_mul(&s->m.c, s->part[RANGE_FREQUENCY], u);
  if (s->m.c.status == SS_OK) s->m.c.status |= exact_sin_cos(a, b, s->m.field, *x);
  *sine = a;
  *cosine = b;
}

static void take_angle(struct on_motion *s, const struct condition *goal, bool from_end) {
  struct calc *c = &s->m.c;
  val x, sine, cosine;
  angle(&s->x, &s->sine, &s->cosine, s, goal->moving && !from_end ? "tau" : name_time[goal->phase]);
  if (!goal->moving || !from_end) return;
  angle(&x, &sine, &cosine, s, "tau");
  val all_sine = s->sine, all_cosine = s->cosine;
  s->x = calc_sub(c, s->x, x);
  s->sine = calc_sub(c, calc_mul(c, all_sine, cosine), calc_mul(c, all_cosine, sine));
  s->cosine = calc_add(c, calc_mul(c, all_cosine, cosine), calc_mul(c, all_sine, sine));
}

static void take_values(struct on_motion *s, const struct condition *goal, const struct range_form *form) {
  struct num_vec v;
  s->margin = tape_value(s, &goal->s.tape);
  if (form->rate) {
    element *rate = calc_new(&s->m.c);
    if (s->m.c.status == SS_OK) s->m.c.status |= exact_derivative(rate, s->m.field, s->margin, "tau");
    s->margin = calc_neg(&s->m.c, rate);
  }
  s->m.c.status |= exact_eval(&v, &s->m.c, s->m.field, form->parts);
  for (int i = 0; i < N_RANGE_PARTS; i++) s->part[i] = at(&v, i);
  s->premise = form->premise ? tape_value(s, &form->premise->s.tape) : NULL;
  take_angle(s, goal, form->from_end);
}

val range_swing(struct calc *c, const val part[N_RANGE_PARTS], val x, val sine, val cosine) {
  val even = calc_mul(c, part[RANGE_EVEN], calc_sub(c, calc_d(c, 1), cosine)), odd = calc_mul(c, part[RANGE_ODD], sine);
  val drift = calc_mul(c, part[RANGE_DRIFT], calc_sub(c, x, sine));
  return calc_mul(c, part[RANGE_FACTOR], calc_add(c, even, calc_add(c, odd, drift)));
}

static bool swings(struct on_motion *s, const struct range_form *form, val level) {
  if (form->there[RANGE_DRIFT] || !exact_is_zero(level)) return false;
  if (form->premise && (form->there[RANGE_EVEN] || !form->premise->strict)) return false;
  return form->premise ? is_product(&s->m, s->part[RANGE_ODD], s->premise)
                       : is_positive(&s->m, s->part[RANGE_ODD]) &&
                             (!form->there[RANGE_EVEN] || is_positive(&s->m, s->part[RANGE_EVEN]));
}

/* Where the form has no part but the level the premise says just what the condition says; beside parts that are zero at
   the end of an open interval, and positive inside, the level may be zero. */
static bool stays(struct on_motion *s, const struct condition *goal, const struct range_form *form, val level) {
  bool grows = form->there[RANGE_DRIFT];
  if (form->there[RANGE_EVEN] && !grows) return false;
  for (int i = RANGE_EVEN; i < N_RANGE_PARTS; i++)
    if (form->there[i] && !is_positive(&s->m, s->part[i])) return false;
  if (!form->premise) return grows && exact_is_zero(level);
  return is_product(&s->m, level, s->premise) &&
         (grows ? goal->moving && !form->premise->strict : form->premise->strict);
}

static bool says(struct on_motion *s, const struct condition *goal, const struct range_form *form, val level) {
  bool ok = s->m.c.status == SS_OK && is_product(&s->m, s->part[RANGE_FREQUENCY], NULL) &&
            is_product(&s->m, s->part[RANGE_FACTOR], NULL);
  return ok && (form->there[RANGE_ODD] ? swings(s, form, level) : stays(s, goal, form, level));
}

/* How many times faster than the form the margin changes, where that is positive for all parameters; else NULL. */
static val multiple(struct on_motion *s, const struct condition *goal, val swing) {
  struct calc *c = &s->m.c;
  const char *time = goal->moving ? "tau" : name_time[goal->phase];
  element *fast = calc_new(c), *slow = calc_new(c);
  if (c->status != SS_OK || exact_derivative(fast, s->m.field, s->margin, time) != SS_OK ||
      exact_derivative(slow, s->m.field, swing, time) != SS_OK || exact_is_zero(slow))
    return NULL;
  val times = calc_div(c, fast, slow);
  return c->status == SS_OK && is_product(&s->m, times, NULL) ? times : NULL;
}

/* scaled: only a positive multiple of the form. */
static bool holds_on(bool *scaled, const struct condition *goal, const struct range_form *form, int anchor) {
  struct on_motion s = {.margin = NULL};
  exact_orbit_init(&s.m, goal->phase, anchor, TIME_INSIDE, false);
  take_values(&s, goal, form);
  val swing = range_swing(&s.m.c, s.part, s.x, s.sine, s.cosine), times = NULL;
  bool ok = says(&s, goal, form, calc_sub(&s.m.c, s.margin, swing));
  if (!ok) times = multiple(&s, goal, swing);
  if (times) ok = says(&s, goal, form, calc_sub(&s.m.c, calc_div(&s.m.c, s.margin, times), swing));
  *scaled = times != NULL;
  exact_motion_clear(&s.m);
  return ok;
}

static bool ends_at_zero(const struct condition *goal, int anchor) {
  OWNED(exact_motion) m;
  exact_orbit_init(&m, goal->phase, anchor, TIME_END, false);
  element *margin = calc_new(&m.c);
  return exact_margin(margin, &m, &goal->s.tape) && exact_is_zero(margin);
}

bool exact_range(bool *scaled, const struct condition *goal, const struct range_form *form) {
  bool ok = false, ends = !form->rate;
  if (goal->equality || !goal->strict || (form->there[RANGE_ODD] && !goal->moving)) return false;
  if (form->rate && (form->from_end || !form->there[RANGE_ODD])) return false;
  for (int anchor = 4; anchor >= ANCHOR_BACK; anchor--) {
    ok = ok || holds_on(scaled, goal, form, anchor);
    ends = ends || ends_at_zero(goal, anchor);
  }
  return ok && ends;
}
