/* Bifurcations along a line: orbits are searched for at many values of the parameter, their curves are followed both
   ways, and what changes on the way is narrowed down and proved.

   At a fold, at a grazing t_c and at the end of phase H the curve turns back: there Krawczyk's operator proves the zero
   of the three equations (curve.c).  Near such a zero the parameter is p_0 + p'' s^2/2 along the tangent s, which tells
   the side on which orbits exist and gives the two beside it.  Any other change is proved along the parameter: one tube
   of orbits reaches over the whole bracket, and the function that vanishes has opposite signs on the orbits at its two
   ends. */
#include "bifurcate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "curve.h"
#include "family.h"
#include "motion/orbit_judge.h"
#include "motion/warm.h"

enum {
  START_PREC = 64,
  TRACE_PREC = 128,
  MOST_EVALUATIONS = 2000000, /* of the return map, in all searches together */
  MOST_CUT_SHORT = 6,         /* searches that ran into their limits, half a second each or more */
  MOST_STEPS = 40000,         /* along all curves together */
  MOST_CHANGES = 2000,
  ATTEMPTS = 6,
  NARROWER = 3
};

/* --- Records. --- */

static void bifurcation_init(struct dyn_bifurcation *b, const struct crossing *c, slong branch) {
  *b = (struct dyn_bifurcation){.what = c->what, .branch = branch, .word = TRUTH_UNKNOWN};
  fmpq_init(&b->low);
  fmpq_init(&b->high);
  arb_set_d(b->tb, c->x[1]);
  arb_set_d(b->tc, c->x[2]);
  arb_indeterminate(b->trace);
  arb_indeterminate(b->third);
}

static void bifurcation_clear(struct dyn_bifurcation *b) {
  fmpq_clear(&b->low);
  fmpq_clear(&b->high);
  arb_ptr all[] = {b->tb, b->tc, b->trace, b->third};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  dyn_orbit_clear(&b->touch);
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2; k++) dyn_orbit_clear(&b->beside[i].orbit[k]);
}

/* The decimals of so many digits around p, a little apart from p. */
static void bracket(struct dyn_bifurcation *b, const arb_t p) {
  slong prec = b->prec;
  NUMBERS(arb, scaled);
  NUMBERS(fmpz, k, ten);
  NUMBERS(fmpq, unit);
  slong places = b->digits - 1 - (slong)floor(log10(num_arb.get_d(p)));
  fmpz_ui_pow_ui(ten, 10, (ulong)labs(places));
  fmpq_set_fmpz(unit, ten);
  if (places > 0) fmpq_inv(unit, unit);
  arb_div_fmpz(scaled, p, ten, prec + 64);
  if (places > 0) arb_mul_fmpz(scaled, p, ten, prec + 64);
  arf_get_fmpz(k, arb_midref(scaled), ARF_RND_FLOOR);
  arb_sub_fmpz(scaled, scaled, k, prec + 64);
  double part = num_arb.get_d(scaled);
  fmpz_sub_si(k, k, part < 1e-6 ? 1 : 0);
  fmpq_mul_fmpz(&b->low, unit, k);
  fmpz_add_si(k, k, part < 1e-6 || part > 1 - 1e-6 ? 2 : 1);
  fmpq_mul_fmpz(&b->high, unit, k);
}

/* --- Proof along the parameter. --- */

/* A tube of the curve's orbits around x = (parameter, t_b, t_c), not proved yet. */
static void tube_at(struct tube *t, const struct curve *b, arb_srcptr x) {
  for (int i = 0; i < N_PARAMS; i++) arb_set(&t->p[i], i == b->line->vary ? x : &b->p[i]);
  for (int k = 0; k < 2; k++) arb_set(&t->x[k], x + 1 + k);
  t->up = b->up;
}

static int tube_on(struct tube *t, const struct curve *b, arb_srcptr x) {
  tube_at(t, b, x);
  return tube_prove(t, b->prec);
}

/* The function over the tube, with the time of a touch; *rate: its slope along the curve. */
static int function_on(arb_t value, arb_t rate, arb_t time, const struct tube *t, const struct curve *b,
                       enum dyn_change what) {
  OWNED(view) v;
  ARB_VECTOR(x, 3);
  arb_set(x, &t->p[b->line->vary]);
  for (int k = 0; k < 2; k++) arb_set(x + 1 + k, &t->x[k]);
  int status = view_open(&v, b, x);
  if (!status) status = view_touch(time, &v, what, true);
  val f = status ? NULL : view_change(&v, what, time);
  if (!f || v.c.status) status |= SS_UNABLE;
  if (!status) {
    arb_set(value, dual_value(f));
    if (rate) status = curve_rate(rate, &v, f);
  }
  return status;
}

static void add_beside(struct dyn_beside *s, const struct tube *t, slong prec) {
  int n = s->n;
  if (tube_orbit(&s->orbit[n], &s->word[n], t, prec)) return;
  if (arb_is_nonpositive(&t->x[0]) || arb_is_nonpositive(&t->x[1])) s->word[n] = TRUTH_FALSE;
  s->n++;
}

static bool turns(enum dyn_change what) {
  return what == CHANGE_FOLD || what == CHANGE_TC || what == CHANGE_GAMMA_V1;
}

/* c_2^2 + c_3 of the return map over the tube. */
static void third_order(arb_t third, const struct tube *t, slong prec) {
  val p[N_PARAMS];
  OWNED(dyn_arc) arc;
  ARB_VECTOR(c, 4);
  OWNED(calc) calc = calc_begin(num_ctx_arb(prec));
  for (int i = 0; i < N_PARAMS; i++) p[i] = &t->p[i];
  const struct num_vec params = calc_vec_of(&calc, p, N_PARAMS);
  dyn_arc_init(&arc, calc.ctx);
  num_arb.set(num_vec_at(&arc.t, PHASE_GAMMA), &t->x[0]);
  num_arb.set(num_vec_at(&arc.t, PHASE_H), &t->x[1]);
  arb_set_si(num_vec_at(&arc.z, N_PHASES * N_STATE + Z_2), t->up ? 1 : -1); /* the sign of r at the end is all */
  if (dyn_return_jet(c, 4, &params, &arc) == SS_OK) {
    arb_mul(third, c + 2, c + 2, prec);
    arb_add(third, third, c + 3, prec);
  }
}

/* The signs at the ends: 1, -1, or 0 when one is not decided.  The ends' orbits and touches lie in those of the
   tube. */
static void sign_at_ends(int sign[2], struct dyn_bifurcation *b, const struct tube *t, const struct curve *curve,
                         const arb_t time) {
  const fmpq *end[2] = {&b->low, &b->high};
  OWNED(tube) e = {.up = false};
  arb_ptr all = _arb_vec_init(5), x = all, when = all + 3, value = all + 4;
  for (int k = 0; k < 2; k++) arb_set(x + 1 + k, &t->x[k]);
  for (int i = 0; i < 2; i++) {
    sign[i] = 0;
    b->beside[i].n = 0;
    arb_set_fmpq(x, end[i], curve->prec);
    if (tube_on(&e, curve, x)) continue;
    if (!arb_contains(&t->box[0], &e.x[0]) || !arb_contains(&t->box[1], &e.x[1])) continue;
    add_beside(&b->beside[i], &e, curve->prec);
    arb_get_mid_arb(when, time);
    if (function_on(value, NULL, when, &e, curve, b->what) || !arb_contains(time, when)) continue;
    sign[i] = arb_is_positive(value) - arb_is_negative(value);
  }
  _arb_vec_clear(all, 5);
}

/* From x, and the time of a touch behind it. */
static void prove_along(struct dyn_bifurcation *b, const struct curve *curve, arb_srcptr from) {
  OWNED(tube) t = {.up = false};
  OWNED(dyn_orbit) whole = {.grazing = false};
  int sign[2] = {0, 0};
  slong prec = curve->prec;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  arb_ptr all = _arb_vec_init(6), x = all, time = all + 3, value = all + 4, rate = all + 5;
  _arb_vec_set(all, from, 4);
  arb_union(x, calc_q(&c, &b->low), calc_q(&c, &b->high), prec);
  if (tube_on(&t, curve, x) == SS_OK && function_on(value, NULL, time, &t, curve, b->what) == SS_OK) {
    bool monotone = function_on(value, rate, time, &t, curve, b->what) == SS_OK && !arb_contains_zero(rate);
    sign_at_ends(sign, b, &t, curve, time);
    b->crosses = sign[0] * sign[1] < 0;
    b->unique = b->crosses && monotone;
    b->sense = b->what == CHANGE_FLIP ? sign[0] : sign[1]; /* z_1' < V at t_b, by which tr J + 1 was multiplied */
    arb_set(b->tb, &t.x[0]);
    arb_set(b->tc, &t.x[1]);
    if (tube_orbit(&whole, &b->word, &t, prec) == SS_OK) arb_set(b->trace, whole.trace);
    if (b->what == CHANGE_FLIP) third_order(b->third, &t, prec);
  }
  _arb_vec_clear(all, 6);
}

/* --- Where the curve turns back. --- */

/* The orbit at a proved zero of z_1'' at t_c. */
static void judge_touch(struct dyn_orbit *o, const struct curve *curve, arb_srcptr x) {
  OWNED(tube) t = {.up = false};
  truth word;
  tube_at(&t, curve, x);
  if (tube_orbit(o, &word, &t, curve->prec) == SS_OK) o->first[PHASE_H] = tube_touches(&t, curve->prec);
}

/* The tangent at a proved zero x, its first component being 0 there, and p'' along it. */
static int turning(arb_ptr tangent, arb_t bend, const struct curve *curve, enum dyn_change what, arb_srcptr x) {
  OWNED(view) v;
  slong prec = curve->prec;
  int status = view_open(&v, curve, x);
  const val f = v.s.pc, g = v.s.defect;
  bool graze = what == CHANGE_TC; /* d p / d s is z_1'' at t_c times d defect / d t_b */
  val moving = graze ? v.s.wc : v.s.defect_tb, other = graze ? v.s.defect_tb : v.s.wc;
  arb_zero(bend);
  for (int k = 1; k < 3 && !status; k++) { /* the cross product of the gradients of f and g */
    int one = (k + 1) % 3, two = (k + 2) % 3;
    arb_mul(tangent + k, view_slope(&v, f, one), view_slope(&v, g, two), prec);
    arb_submul(tangent + k, view_slope(&v, f, two), view_slope(&v, g, one), prec);
    arb_addmul(bend, tangent + k, view_slope(&v, moving, k), prec);
  }
  if (!status) arb_mul(bend, bend, dual_value(other), prec);
  return status;
}

/* The orbits at the end of the bracket where there are two. */
static void pair_beside(struct dyn_bifurcation *b, const struct curve *curve, arb_srcptr x, arb_srcptr tangent,
                        const arb_t bend) {
  slong prec = curve->prec;
  int side = b->sense > 0 ? 1 : 0;
  struct dyn_beside *out = &b->beside[side];
  struct tube t[2] = {{.up = false}};
  bool ok[2];
  arb_ptr all = _arb_vec_init(4), guess = all, s = all + 3;
  arb_set_fmpq(guess, side ? &b->high : &b->low, prec);
  arb_sub(s, guess, x, prec);
  arb_mul_2exp_si(s, s, 1);
  arb_div(s, s, bend, prec);
  arb_get_mid_arb(s, s);
  arb_sqrt(s, s, prec);
  for (int i = 0; i < 2; i++) {
    for (int k = 1; k < 3; k++) {
      arb_set(guess + k, x + k);
      (i ? arb_submul : arb_addmul)(guess + k, s, tangent + k, prec);
    }
    ok[i] = tube_on(&t[i], curve, guess) == SS_OK;
  }
  bool apart = !arb_overlaps(&t[0].x[0], &t[1].x[0]) || !arb_overlaps(&t[0].x[1], &t[1].x[1]);
  out->n = 0;
  for (int i = 0; i < 2; i++) {
    int n = out->n;
    if (ok[0] && ok[1] && apart) add_beside(out, &t[i], prec);
    if (out->n > n && b->what != CHANGE_FOLD && out->word[n] == TRUTH_FALSE) out->n = n; /* the sheet beyond */
    tube_clear(&t[i]);
  }
  _arb_vec_clear(all, 4);
}

static void prove_turning(struct dyn_bifurcation *b, const struct curve *curve, arb_srcptr from) {
  OWNED(calc) c = calc_begin(num_ctx_arb(curve->prec));
  ARB_VECTOR(x, 3);
  ARB_VECTOR(tangent, 3);
  arb_ptr bend = calc_new(&c);
  _arb_vec_set(x, from, 3);
  bool ok =
      curve_prove_zero(x, curve, b->what) == SS_OK && arb_lt(calc_q(&c, &b->low), x) && arb_lt(x, calc_q(&c, &b->high));
  b->crosses = b->unique = ok;
  if (ok) {
    arb_set(b->tb, x + 1);
    arb_set(b->tc, x + 2);
    if (b->what == CHANGE_FOLD) arb_one(b->trace);
    if (b->what == CHANGE_TC) judge_touch(&b->touch, curve, x);
  }
  if (ok && turning(tangent, bend, curve, b->what, x) == SS_OK && !arb_contains_zero(bend)) {
    b->sense = arb_is_positive(bend) ? 1 : -1;
    pair_beside(b, curve, x, tangent, bend);
  }
}

/* --- One change. --- */

static bool settled(const struct dyn_bifurcation *b) {
  bool ends = b->what >= CHANGE_H_V1;
  if (turns(b->what)) return b->unique && b->sense && b->beside[b->sense > 0].n > 0;
  return b->unique && b->beside[0].n && b->beside[1].n && (ends || b->word == TRUTH_TRUE);
}

/* The line, and what is known of it so far. */
struct line {
  struct dyn_bifurcations *list;
  size_t cap, cap_branches, cap_spots;
  const struct dyn_line *of;
  double low, high;
  slong digits;
  struct start *start;
  slong n_starts, steps;
};

/* A bracket over which no proof succeeds is narrowed, and the precision raised: it has the digits of the bracket
   and twice as many again, since conditions at its ends may be as small as the square of its width. */
static void prove_change(struct dyn_bifurcation *b, const struct line *l, bool up, const struct crossing *c) {
  ARB_VECTOR(x, 4);
  for (int k = 0; k < 3; k++) arb_set_d(x + k, c->x[k]);
  arb_set_d(x + 3, c->time);
  for (int i = 0; i < ATTEMPTS && !settled(b); i++) {
    OWNED(curve) curve;
    b->digits = l->digits + NARROWER * i;
    b->prec = (slong)((double)b->digits * 3 * 3.33) + 96 * (i + 1);
    curve_init(&curve, l->of, up, c->x[1], b->prec);
    bool ok = curve_newton(x, x + 3, &curve, b->what) == SS_OK && arb_is_positive(x);
    if (ok) bracket(b, x);
    if (ok && turns(b->what))
      prove_turning(b, &curve, x);
    else if (ok)
      prove_along(b, &curve, x);
    if (!ok) break;
  }
}

/* Whether w's height in phase C matters at this change: a greater one elsewhere may have broken the condition
   before. */
static bool matters(const struct dyn_bifurcation *b) {
  if (b->what != CHANGE_C_W_START && b->what != CHANGE_C_W_HILL) return true;
  truth t[2];
  for (int i = 0; i < 2; i++) t[i] = b->beside[i].n ? b->beside[i].orbit[0].holds[COND_C_W] : TRUTH_UNKNOWN;
  return t[0] == TRUTH_UNKNOWN || t[1] == TRUTH_UNKNOWN || t[0] != t[1];
}

static void add_change(struct line *l, bool up, const struct crossing *c, double place) {
  struct dyn_bifurcations *list = l->list;
  list->at = ss_grow(list->at, (size_t)list->n, &l->cap, sizeof *list->at);
  struct dyn_bifurcation *b = &list->at[list->n];
  bifurcation_init(b, c, list->n_branches);
  b->place = place;
  prove_change(b, l, up, c);
  if (matters(b))
    list->n++;
  else
    bifurcation_clear(b);
}

/* --- Following. --- */

/* An orbit found by a search at one value of the parameter; done when a branch has passed it. */
struct start {
  double x[3];
  bool up, done;
};

static void mark_starts(struct line *l, const struct trace *t, const struct spot *a, const struct spot *b) {
  for (slong i = 0; i < l->n_starts; i++) {
    struct start *s = &l->start[i];
    if (!s->done && s->up == t->curve->up && trace_passes(t, a, b, s->x)) s->done = true;
  }
}

static void add_spot(struct line *l, const double x[3], double place) {
  struct dyn_bifurcations *list = l->list;
  *SS_PUSH(list->spot, list->n_spots, l->cap_spots) = (struct dyn_spot){list->n_branches, place, {x[0], x[1], x[2]}};
}

/* One direction from a start; the end of the branch goes to place `end` of it.  false when the curve is closed. */
static bool follow(struct line *l, struct dyn_branch *br, int end, const struct curve *curve,
                   const struct start *from) {
  struct trace t;
  double *last = end ? br->to : br->from;
  br->end[end] = END_LOST;
  for (int k = 0; k < 3; k++) last[k] = from->x[k];
  if (!trace_start(&t, curve, from->x, l->low, l->high, end ? 1 : -1)) return true;
  struct spot first = t.now;
  for (slong i = 0; l->steps < MOST_STEPS && l->list->n < MOST_CHANGES; i++, l->steps++) {
    struct spot before = t.now;
    struct crossing c[N_CHANGES];
    if ((before.x[0] <= l->low && before.tangent[0] < 0) || (before.x[0] >= l->high && before.tangent[0] > 0)) {
      br->end[end] = END_OF_LINE;
      return true;
    }
    int n;
    if (!trace_step(&t)) return true;
    if (!trace_crossings(c, &n, &l->list->missed, &t, &before, &t.now)) return true;
    bool ended = false;
    for (int k = 0; k < n && !ended; k++) {
      double place = (double)i + (k + 1.0) / (n + 1.0);
      add_change(l, curve->up, &c[k], end ? place : -place);
      br->span[0] = fmin(br->span[0], c[k].x[0]); /* a fold is beyond the steps beside it */
      br->span[1] = fmax(br->span[1], c[k].x[0]);
      ended = c[k].what >= CHANGE_H_V1;
      if (!ended) continue;
      br->end[end] = END_CHANGE;
      br->change[end] = c[k].what;
      for (int m = 0; m < 3; m++) t.now.x[m] = c[k].x[m];
    }
    mark_starts(l, &t, &before, &t.now);
    for (int k = 0; k < 3; k++) last[k] = t.now.x[k];
    br->span[0] = fmin(br->span[0], last[0]);
    br->span[1] = fmax(br->span[1], last[0]);
    if (ended) return true;
    add_spot(l, last, end ? (double)i + 1 : -(double)i - 1);
    if (i > 3 && trace_passes(&t, &before, &t.now, first.x)) {
      br->end[0] = br->end[1] = END_CLOSED;
      for (int k = 0; k < 3; k++) br->from[k] = last[k];
      return false;
    }
  }
  return true;
}

static void follow_branch(struct line *l, const struct start *from) {
  struct dyn_bifurcations *list = l->list;
  OWNED(curve) curve;
  list->branch = ss_grow(list->branch, (size_t)list->n_branches, &l->cap_branches, sizeof *list->branch);
  struct dyn_branch *br = &list->branch[list->n_branches];
  *br = (struct dyn_branch){.span = {from->x[0], from->x[0]}, .up = from->up};
  curve_init(&curve, l->of, from->up, from->x[1], TRACE_PREC);
  add_spot(l, from->x, 0);
  if (follow(l, br, 1, &curve, from)) follow(l, br, 0, &curve, from);
  list->n_branches++;
}

/* --- The line. --- */

/* The orbits at the i-th value.  *evaluations counts on. */
static int find_starts(struct line *l, size_t *cap, long *evaluations, const struct dyn_axis *axis, slong i) {
  OWNED(dyn_orbits) orbits;
  fmpq at[N_PARAMS];
  int vary = l->of->vary;
  memcpy(at, l->of->params, sizeof at); /* borrowed, but for that which varies */
  fmpq_init(&at[vary]);
  dyn_axis_q(&at[vary], axis, i);
  int status = dyn_orbits_find(&orbits, at, START_PREC, NULL);
  for (slong k = 0; k < orbits.n; k++) {
    const struct dyn_orbit *o = &orbits.orbit[k];
    *SS_PUSH(l->start, l->n_starts, *cap) =
        (struct start){{fmpq_get_d(&at[vary]), o->guess[PHASE_GAMMA], o->guess[PHASE_H]},
                       num_arb.get_d(o->z20) > num_arb.get_d(o->z10),
                       false};
  }
  *evaluations += orbits.evaluations;
  fmpq_clear(&at[vary]);
  return status;
}

/* Spread over the line from the first few on, since hard parameters may use up what is allowed. */
static int find_all_starts(struct line *l, const struct dyn_axis *axis) {
  size_t cap = 0;
  long evaluations = 0, cut_short = 0;
  slong n = axis->n, stride = n / 3 + 1;
  while (n_gcd((ulong)stride, (ulong)n) != 1) stride++;
  for (slong i = 0; i < n; i++) {
    if (evaluations > MOST_EVALUATIONS || cut_short > MOST_CUT_SHORT) return SS_UNABLE;
    if (find_starts(l, &cap, &evaluations, axis, i * stride % n)) cut_short++;
  }
  return cut_short ? SS_UNABLE : SS_OK;
}

static int by_value(const void *x, const void *y) {
  const struct dyn_bifurcation *a = x, *b = y;
  int c = fmpq_cmp(&a->low, &b->low);
  return c ? c : (a->branch > b->branch) - (a->branch < b->branch);
}

int dyn_bifurcations_find(struct dyn_bifurcations *list, const struct dyn_line *line, slong digits, slong starts) {
  *list = (struct dyn_bifurcations){.n = 0};
  struct line l = {.list = list, .of = line, .digits = digits};
  double ends[2] = {fmpq_get_d(line->from), fmpq_get_d(line->to)};
  l.low = fmin(ends[0], ends[1]);
  l.high = fmax(ends[0], ends[1]);
  if (!(l.low > 0 && l.low < l.high) || (line->vary == P_CHI && l.high >= 1)) return SS_DOMAIN;
  OWNED(dyn_axis) axis;
  dyn_axis_init(&axis, line->vary, line->from, line->to, starts);
  int status = find_all_starts(&l, &axis);
  for (slong i = 0; i < l.n_starts; i++)
    if (!l.start[i].done) follow_branch(&l, &l.start[i]);
  for (slong i = 0; i < list->n_branches; i++)
    for (int k = 0; k < 2; k++)
      if (list->branch[i].end[k] == END_LOST) status |= SS_UNABLE;
  if (list->n > 1) qsort(list->at, (size_t)list->n, sizeof *list->at, by_value);
  free(l.start);
  return status;
}

void dyn_bifurcations_clear(struct dyn_bifurcations *list) {
  for (slong i = 0; i < list->n; i++) bifurcation_clear(&list->at[i]);
  free(list->at);
  free(list->spot);
  free(list->branch);
  *list = (struct dyn_bifurcations){.n = 0};
}
