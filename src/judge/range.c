/* For how long a phase a condition holds throughout it: the closed form of its margin (proof/exact_range.h) proves the
   range for all parameters.  Beside that, over the pool of orbits, in balls: the margin is of that form, and the
   condition holds along the whole phase just where the range says. */
#include <math.h>

#include "certificate.h"
#include "judge.h"
#include "num/calc.h"
#include "proof/exact_range.h"
#include "value/expression.h"
#include "value/orbit_pool.h"

enum { LENGTH = N_RANGE_PARTS, N_NUMBERS, EACH = 4, MOST = 100, FRACTIONS = 4 };

struct range {
  struct judge *j;
  const struct claim *c;
  struct view view;
  struct conditions goal, premise;
  struct expression parts; /* and, behind them, the length of the phase */
  struct range_form form;
  bool uses_friction;                 /* the premise */
  bool proved, scaled;                /* scaled: of a multiple of the form */
  long same[2], late[2], other, open; /* orbits where the condition fails, holds; late: of rate, x > 2 pi */
  long unlike;                        /* of the open ones, those on which the margin is not of the form */
  const char *where;                  /* the first of the others */
  struct certificate certificate;     /* there */
};

/* --- Reading --- */

static const char *const part_attribute[N_RANGE_PARTS] = {"frequency", "factor", "even", "odd", "drift"};

/* "[omega; 1; 0; omega*(z_10 - z_20); 0; t_d]" */
static bool read_parts(struct range *r) {
  OWNED(text) t = {0};
  for (int i = 0; i < N_RANGE_PARTS; i++) {
    const char *formula = claim_get(r->c, part_attribute[i]);
    r->form.there[i] = formula != NULL;
    text_printf(&t, "%s%s; ", i ? "" : "[", formula ? formula : i <= RANGE_FACTOR ? "1" : "0");
  }
  text_printf(&t, "%s]", name_time[r->goal.at[0].phase]);
  bool ok = expression_open(&r->parts, r->view, text_str(&t), claim_get(r->c, "section"), r->j->d);
  if (ok && r->parts.n != N_NUMBERS)
    ok = claim_error(r->j, r->c, "kind", "frequency, factor, even, odd and drift are one number each");
  r->form.parts = &r->parts.tape;
  return ok;
}

static bool read_range(struct range *r) {
  if (!conditions_read(&r->goal, r->j, r->c, "conclusion", r->view)) return false;
  if (!conditions_read(&r->premise, r->j, r->c, "premises", r->view)) return false;
  if (r->goal.n != 1 || r->premise.n > 1)
    return claim_error(r->j, r->c, "conclusion", "one condition, with one premise or none");
  r->form = (struct range_form){.premise = r->premise.n ? &r->premise.at[0] : NULL};
  return judge_switch(&r->form.from_end, r->j, r->c, "from", "end") &&
         judge_switch(&r->form.rate, r->j, r->c, "rate", "yes") && read_parts(r);
}

static void range_clear(struct range *r) {
  expression_clear(&r->parts);
  conditions_clear(&r->premise);
  conditions_clear(&r->goal);
}

/* --- One orbit in balls --- */

static bool numbers_at(arb_ptr v, struct range *r, const struct point *p) {
  return expression_value(v, &r->parts, p, FIRST_PREC, r->j->cache) == SS_OK;
}

/* even (x - sin x) + odd (1 - cos x) */
static val integral(struct calc *c, arb_srcptr v, val x) {
  val sine, cosine;
  calc_sin_cos(c, &sine, &cosine, x);
  return calc_add(c, calc_mul(c, v + RANGE_EVEN, calc_sub(c, x, sine)),
                  calc_mul(c, v + RANGE_ODD, calc_sub(c, calc_d(c, 1), cosine)));
}

/* 2 (pi - arctan(odd/even)) - x of the whole phase; of rate, with x modulo 2 pi, and how far the integral at its end
   lies over its last crest.  Returns how many crests it has had. */
static slong distances(val *limit, val *above, struct calc *c, arb_srcptr v, bool rate) {
  val pi = calc_pi(c), two = calc_d(c, 2), turn = calc_mul(c, two, pi);
  val x = calc_mul(c, v + RANGE_FREQUENCY, v + LENGTH), most = pi;
  slong k = rate ? (slong)floor(num_arb.get_d(x) / num_arb.get_d(turn)) : 0;
  if (!arb_is_zero(v + RANGE_EVEN)) /* pi - arctan(odd/even) = arg(-even + i odd), pi/2 without even */
    most = calc_mul(c, two, calc_atan2(c, v + RANGE_ODD, calc_neg(c, v + RANGE_EVEN)));
  val crest = calc_add(c, most, calc_mul(c, turn, calc_d(c, (double)(k - 1))));
  *above = calc_sub(c, integral(c, v, x), integral(c, v, crest));
  *limit = calc_sub(c, most, calc_sub(c, x, calc_mul(c, turn, calc_d(c, (double)k))));
  return k;
}

/* What the range says of the phase, and whether it has had a crest. */
static truth expected(bool *late, struct range *r, arb_srcptr v, const struct point *p) {
  truth holds = conditions_hold(&r->premise, p, r->j->cache);
  *late = false;
  if (!r->form.there[RANGE_ODD]) return holds;
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  val limit, above;
  *late = distances(&limit, &above, &c, v, r->form.rate) > 0;
  holds = truth_and(holds, truth_not(num_ball_positive(calc_neg(&c, limit))));
  if (*late) holds = truth_and(holds, truth_not(num_ball_positive(calc_neg(&c, above))));
  return holds;
}

/* The form at that part of the phase, without its level. */
static val form_at(struct calc *c, const struct range *r, arb_srcptr v, slong k) {
  val x = calc_mul(c, v + RANGE_FREQUENCY, v + LENGTH), sine, cosine, part[N_RANGE_PARTS];
  if (r->goal.at[0].moving) x = calc_mul(c, x, calc_div_ui(c, calc_d(c, (double)k), FRACTIONS));
  calc_sin_cos(c, &sine, &cosine, x);
  for (int i = 0; i < N_RANGE_PARTS; i++) part[i] = v + i;
  return range_swing(c, part, x, sine, cosine);
}

/* The margin with the time t at that part of the phase; NULL where it has no value. */
static val margin_at(struct calc *c, struct range *r, struct point *p, slong k) {
  struct num_vec out = calc_vec(c, 1);
  bool known;
  p->phase = r->goal.at[0].phase;
  fmpq_set_si(&p->q[Q_S], k, FRACTIONS);
  bool ok = tape_at_point(&out, &known, &r->goal.at[0].s.tape, p, r->j->cache) == SS_OK && known;
  return ok ? num_vec_at(&out, 0) : NULL;
}

/* The margin less the form: the same at two parts of the phase, and zero without a premise. */
static truth is_of_form(struct range *r, arb_srcptr v, struct point *p) {
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  val level[2] = {NULL, NULL};
  for (slong k = 1; k <= 2; k++) {
    val margin = margin_at(&c, r, p, k);
    if (!margin) break;
    level[k - 1] = calc_sub(&c, margin, form_at(&c, r, v, r->form.from_end ? FRACTIONS - k : k));
  }
  truth holds = level[1] ? TRUTH_TRUE : TRUTH_UNKNOWN;
  bool any_level = r->premise.n && !r->form.there[RANGE_ODD];
  if (holds == TRUTH_TRUE && !arb_contains_zero(any_level ? calc_sub(&c, level[0], level[1]) : level[0]))
    holds = TRUTH_FALSE;
  return holds;
}

/* The static friction a little above (side 1) or below what the premise asks. */
static void choose_friction(struct range *r, struct point *p, const struct dyn_orbit *o, int side) {
  enum { GRID = 1024 };
  struct sampled s[MAX_CONDITIONS];
  for (int i = 0; i < 2; i++) fmpq_set_si(&p->q[Q_US1 + i], 1 << 20, 1);
  if (!r->premise.n || conditions_sample(s, &r->premise, p, r->j->cache) != SS_OK) return;
  for (int i = 0; i < 2; i++) {
    if (!(s[0].slope[i] > 0.01)) continue;
    double least = -s[0].least / s[0].slope[i] * fmpq_get_d(&p->q[Q_V]) + num_arb.get_d(i ? o->e2 : o->e1);
    double k = ceil(least * (1 + (side ? 1 : -1) / 32.0) * GRID);
    if (fabs(k) < 1e15) fmpq_set_si(&p->q[Q_US1 + i], (slong)k, GRID);
  }
}

/* Another form may have the same range, as twice the margin has, so that it refutes nothing. */
static void book(struct range *r, truth form, truth said, truth found, bool late, const struct point *p,
                 const struct dyn_orbit *o) {
  bool known = said != TRUTH_UNKNOWN && found != TRUTH_UNKNOWN;
  if (known && said != found) {
    if (r->other++ == 0) {
      r->where = point_text(r->j, p);
      certify_drawn(&r->certificate, r->j, p, o, r->uses_friction ? 1U << Q_US1 | 1U << Q_US2 : 0);
      certificate_add(&r->certificate, r->j->out, "condition", found == TRUTH_TRUE ? "holds" : "fails");
    }
  } else if (!known || form != TRUTH_TRUE) {
    r->open++;
    r->unlike += form == TRUTH_FALSE;
  } else {
    ++*(late ? &r->late[found] : &r->same[found]);
  }
}

/* Whether enough like it have been tried, where there is a proof already. */
static bool is_enough(const struct range *r, truth said, bool late) {
  return r->proved && said != TRUTH_UNKNOWN && (late ? r->late : r->same)[said] >= EACH;
}

static void try_orbit(struct range *r, const struct pool_item *item, slong index, int side) {
  LOCAL(point, p);
  bool late;
  ARB_VECTOR(v, N_NUMBERS);
  const struct dyn_orbit *o = &item->list.orbit[index];
  pool_point(&p, item, index);
  choose_friction(r, &p, o, side);
  if (!o->grazing && numbers_at(v, r, &p)) {
    truth said = expected(&late, r, v, &p);
    if (!is_enough(r, said, late)) {
      p.known = NULL; /* enclosed as narrowly as asked for */
      truth form = r->form.rate || (r->proved && r->scaled) ? TRUTH_TRUE
                   : numbers_at(v, r, &p)                   ? is_of_form(r, v, &p)
                                                            : TRUTH_UNKNOWN;
      said = expected(&late, r, v, &p);
      truth found = conditions_hold(&r->goal, &p, r->j->cache);
      book(r, form, said, found, late, &p, o);
    }
  }
}

static void by_balls(struct range *r) {
  struct orbit_pool pool = orbit_pool_get(r->j);
  long tried = 0;
  for (size_t i = 0; i < pool.n && tried < MOST && !(r->other && r->j->effort != EFFORT_FULL); i++)
    for (slong k = 0; k < pool.item[i]->list.n; k++, tried++)
      for (int side = 0; side < 1 + r->uses_friction; side++) try_orbit(r, pool.item[i], k, side);
}

/* --- The kind --- */

static const char *describe(struct range *r) {
  struct text t = {0};
  text_printf(&t, "the condition holds on %ld orbits and fails on %ld, as stated", r->same[1], r->same[0]);
  if (r->other) text_printf(&t, "; on %ld it is not as stated", r->other);
  if (r->open) text_printf(&t, "; on %ld it is undecided", r->open);
  if (r->unlike) text_printf(&t, "; on %ld the margin is not what even, odd and drift make of it", r->unlike);
  if (r->form.rate)
    text_printf(&t, "; where the phase takes more than 2 pi, it holds on %ld and fails on %ld, as stated", r->late[1],
                r->late[0]);
  return result_take(r->j->out, &t);
}

/* An attribute as it stands in a product; NULL where there is none. */
static const char *factor_text(const struct range *r, const char *name) {
  const char *formula = claim_get(r->c, name);
  return formula && strchr(formula, ' ') ? result_str(r->j->out, "(%s)", formula) : formula;
}

static void add_part(struct text *t, size_t from, const char *formula, const char *of_x) {
  if (formula) text_printf(t, "%s%s*%s", t->len > from ? " + " : "", formula, of_x);
}

/* "chi*(e_1*(1 - cos(x)) + ...), x being omega times the time to the end of the phase" */
static void form_text(struct text *t, const struct range *r) {
  const char *factor = factor_text(r, "factor"), *frequency = factor_text(r, "frequency");
  if (factor) text_printf(t, "%s*(", factor);
  size_t from = t->len;
  add_part(t, from, factor_text(r, "even"), "(1 - cos(x))");
  add_part(t, from, factor_text(r, "odd"), "sin(x)");
  add_part(t, from, factor_text(r, "drift"), "(x - sin(x))");
  text_add(t, factor ? "), x being " : ", x being ");
  if (frequency) text_printf(t, "%s times ", frequency);
  text_add(t, !r->goal.at[0].moving ? "the duration of the phase"
              : r->form.from_end    ? "the time to the end of the phase"
                                    : "the time since the phase began");
}

/* What was shown, on motions computed from the first-order systems. */
static const char *proof_note(const struct range *r) {
  struct text t = {0};
  const char *even = factor_text(r, "even"), *odd = factor_text(r, "odd");
  text_add(&t, "on motions computed from the first-order systems ");
  if (r->scaled) text_add(&t, "but for a factor that is positive for all parameters ");
  if (!r->form.there[RANGE_ODD] && !r->form.there[RANGE_DRIFT]) {
    text_add(&t, "the margin is the premise's times a factor that is positive for all parameters");
  } else if (!r->form.there[RANGE_ODD]) {
    text_add(&t, r->premise.n ? "the margin is a positive multiple of the premise's plus " : "the margin is ");
    form_text(&t, r);
    text_add(&t, ", which is zero for x = 0 and positive for x > 0");
  } else {
    text_add(&t,
             r->form.rate ? "the margin is zero at the end of the phase, and minus its rate is " : "the margin is ");
    form_text(&t, r);
    if (r->form.there[RANGE_EVEN])
      text_printf(&t,
                  "; by half angles that is positive up to x = 2*(pi - arctan(%s/(%s))), and negative from there to "
                  "2*pi",
                  odd, claim_get(r->c, "even"));
    else
      text_add(&t, "; the sine is positive up to pi, and negative from there to 2*pi");
    if (r->form.rate && r->form.there[RANGE_EVEN])
      text_printf(&t,
                  ", so that its integral, a multiple of %s*(x - sin(x)) + %s*(1 - cos(x)), has maxima, each greater "
                  "than the one before, at x = 2*(k*pi - a), a = arctan(%s/(%s)), k = 1, 2, ..., where that is "
                  "2*(%s*(k*pi - a) + %s)",
                  even, odd, odd, claim_get(r->c, "even"), even, odd);
  }
  return result_take(r->j->out, &t);
}

static void conclude(struct finding *f, struct range *r) {
  long as_said = r->same[0] + r->same[1] + r->late[0] + r->late[1];
  struct route_result w = counted_route("balls", true, as_said, r->other, r->open);
  finding_add_route(f, r->j->out, w, layer_name[LAYER_CORRECTED], FIRST_PREC, r->where, describe(r));
  if (r->proved || !r->other)
    exact_route(f, r->j->out, r->proved ? ROUTE_AGREES : ROUTE_UNDECIDED,
                r->proved ? proof_note(r) : "that the two say the same, at equality too, is not shown");
  f->verdict = verdict_of(&w, 1, r->proved);
  if (f->verdict == VERDICT_REFUTED) f->certificate = r->certificate;
}

bool judge_range(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  OWNED(range) r = {.j = j, .c = c, .view = view};
  bool ok = read_range(&r);
  r.uses_friction = ok && conditions_use_friction(&r.premise);
  if (ok) {
    r.proved = exact_range(&r.scaled, &r.goal.at[0], &r.form);
    by_balls(&r);
    conclude(f, &r);
  }
  return ok && !j->d->set;
}
