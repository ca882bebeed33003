/* Extreme points are drawn region by region: chi near 0 and 1, eta over 600 decades and where chi eta is near 1, times
   from 2^-1000 to 2^53 and next to multiples of half periods, states with differences that nearly vanish.  All are
   exact doubles. */
#include "stable_points.h"
#include "local.h"
#include "rational.h"
#include "says.h"

#include <check.h>

#include <math.h>
#include <string.h>

/* --- Forms --- */

static void read_value(struct matrix *out, struct elaboration *el, const char *value, const char *section) {
  struct diag d = {0};
  ck_assert_msg(elaborate_text(out, el, value, value, section, &d), "%s: %s", value, d.message);
  ck_assert_int_le(out->rows * out->cols, MOST_ENTRIES);
}

void extreme_form_init(struct extreme_form *f, const struct model *m, enum layer layer, const char *value,
                       const char *called, const char *section) {
  struct matrix v;
  elaboration_init(&f->el, (struct view){m, layer, NULL, NULL}, NULL, 0);
  read_value(&v, &f->el, value, section);
  f->n = v.rows * v.cols;
  goes_well(elaboration_tape(&f->tape, &f->el, v.e, f->n, &d));
  elaboration_init(&f->exact, (struct view){m, LAYER_STABLE, NULL, NULL}, NULL, 0);
  read_value(&v, &f->exact, called, section);
  ck_assert_int_eq(v.rows * v.cols, f->n);
  OWNED(tape) plain;
  goes_well(elaboration_tape(&plain, &f->exact, v.e, f->n, &d));
  ck_assert_int_le(plain.n_inputs, MOST_INPUTS);
  const struct expr *out[MOST_ENTRIES * (1 + MOST_INPUTS)];
  int n = 0;
  for (int i = 0; i < f->n; i++) {
    out[n++] = v.e[i];
    for (slong k = 0; k < plain.n_inputs; k++) out[n++] = expr_diff(&f->exact.pool, v.e[i], plain.inputs[k]);
  }
  goes_well(elaboration_tape(&f->truth, &f->exact, out, n, &d));
  ck_assert_int_eq(f->truth.n_inputs, plain.n_inputs);
  for (slong k = 0; k < plain.n_inputs; k++) ck_assert_str_eq(f->truth.inputs[k], plain.inputs[k]);
}

void extreme_form_clear(struct extreme_form *f) {
  tape_clear(&f->tape);
  tape_clear(&f->truth);
  elaboration_clear(&f->el);
  elaboration_clear(&f->exact);
}

/* --- Points --- */

static double between(struct rng *r, double low, double high) {
  return low + (high - low) * (double)(rng_next(r) >> 11) * 0x1p-53;
}

/* A random mantissa in [1, 2) times 2^e, e uniform. */
static double decades(struct rng *r, double low, double high) {
  return ldexp(between(r, 1, 2), (int)floor(between(r, low, high)));
}

void extreme_point_draw(struct extreme_point *p, uint64_t seed) {
  *p = (struct extreme_point){.rng.state = seed * 0x9e3779b97f4a7c15U};
  struct rng *r = &p->rng;
  switch (rng_between(r, 0, 3)) {
  case 0:
    p->chi = between(r, 0x1p-10, 1 - 0x1p-10);
    break;
  case 1:
    p->chi = decades(r, -60, -1);
    break;
  case 2:
    p->chi = decades(r, -990, -1);
    break;
  default:
    p->chi = 1 - decades(r, -53, -2);
  }
  switch (rng_between(r, 0, 4)) {
  case 0:
    p->eta = decades(r, -4, 4);
    break;
  case 1:
    p->eta = decades(r, -60, 60);
    break;
  case 2:
    p->eta = decades(r, -990, 990);
    break;
  default: /* near chi eta = 1, at distances of every size */
    p->eta = (1 + (rng_next(r) % 2 ? 1 : -1) * decades(r, -54, -1)) / p->chi;
  }
  if (!(p->eta < 0x1p996)) p->eta = 0x1p996;
  p->scale = p->chi < 0x1p-60 || rng_between(r, 0, 3) ? 1 : decades(r, -800, 800);
}

/* The frequencies of the phases, roughly. */
static double rate(const struct extreme_point *p, struct rng *r) {
  double omega = sqrt(p->chi) * sqrt(p->eta), s = sqrt(1 - p->chi), root = sqrt(p->chi);
  double high = (hypot(omega + s, root) + hypot(omega - s, root)) / 2;
  switch (rng_between(r, 0, 4)) {
  case 0:
    return high;
  case 1:
    return omega * (s / high);
  case 2:
    return omega;
  case 3:
    return hypot(omega - s, root);
  default:
    return 1;
  }
}

static double draw_time(const struct extreme_point *p, struct rng *r) {
  double t;
  switch (rng_between(r, 0, 3)) {
  case 0:
    return decades(r, -6, 6);
  case 1:
    return decades(r, -1000, 53);
  case 2:
    t = decades(r, -30, 30) / rate(p, r);
    break;
  default:
    t = (double)(1 + rng_next(r) % (1u << rng_between(r, 1, 20))) * acos(0) / rate(p, r);
    if (rng_next(r) % 2) t *= 1 + decades(r, -53, -4);
  }
  return t > 0 && t < 0x1p53 ? t : 1.5;
}

/* One stream for each name, so that the order of the inputs says nothing. */
static struct rng stream(const struct extreme_point *p, const char *name) {
  struct rng r = p->rng;
  for (const char *c = name; *c; c++) r.state = (r.state ^ (unsigned char)*c) * 0x100000001b3U;
  rng_next(&r);
  return r;
}

static double draw_state(const struct extreme_point *p, const char *name) {
  struct rng r = stream(p, name);
  double z = p->scale * (rng_between(&r, 0, 2) ? between(&r, 0.125, 8) : decades(&r, -60, 60));
  return rng_next(&r) % 2 ? z : -z;
}

/* Beside another value, at a distance of any size. */
static double beside(const struct extreme_point *p, const char *name, double other) {
  struct rng r = stream(p, name);
  if (rng_next(&r) % 2 || fabs(other) < 0x1p-950) return draw_state(p, name);
  return other * (1 + (rng_next(&r) % 2 ? 1 : -1) * decades(&r, -52, -2));
}

static double extreme_value(struct extreme_point *p, const char *name) {
  struct rng r = stream(p, name);
  if (strcmp(name, "chi") == 0) return p->chi;
  if (strcmp(name, "eta") == 0) return p->eta;
  if (strcmp(name, "V") == 0) return p->scale * between(&r, 0.5, 2);
  if (name[0] == 't') return draw_time(p, &r) * (1 + p->shift);
  if (strcmp(name, "z_200") == 0) return beside(p, name, draw_state(p, "z_100"));
  if (strcmp(name, "z_1c") == 0) return beside(p, name, p->chi * draw_state(p, "z_2c"));
  if (strcmp(name, "z_1b") == 0) return beside(p, name, p->chi * draw_state(p, "z_2b"));
  if (strncmp(name, "z'", 2) == 0) return beside(p, name, extreme_value(p, "V"));
  return draw_state(p, name);
}

/* --- Measuring --- */

static void bind(struct num_vec *in, const struct tape *t, const struct extreme_point *p) {
  struct extreme_point q = *p;
  for (slong k = 0; k < t->n_inputs; k++)
    in->ctx.type->set_d(num_vec_at(in, k), extreme_value(&q, t->inputs[k]), in->ctx.prec);
}

/* The truth of entry i to 80 bits and its condition, in one precision; false when that does not tell them. */
static bool told(struct extreme_result *r, arb_t ball, const struct extreme_form *f, const struct num_vec *out,
                 const struct num_vec *in, const int *status, int i) {
  slong at = i * (1 + f->truth.n_inputs);
  NUMBERS(arb, sum, part);
  bool ok = status[at] == SS_OK;
  if (ok) arb_set(ball, num_vec_at(out, at));
  if (ok && arb_is_zero(ball)) return true;
  ok = ok && arb_rel_accuracy_bits(ball) >= 80;
  for (slong k = 0; ok && k < f->truth.n_inputs; k++) {
    ok = status[at + 1 + k] == SS_OK;
    if (!ok) break;
    arb_mul(part, num_vec_at(out, at + 1 + k), num_vec_at(in, k), 64);
    arb_div(part, part, ball, 64);
    arb_abs(part, part);
    arb_add(sum, sum, part, 64);
  }
  if (ok) { /* to a few per cent, or known to be small */
    NUMBERS(mag, most);
    mag_set_d(most, 0.01 * fmax(1, num_arb.get_d(sum)));
    ok = mag_cmp(arb_radref(sum), most) <= 0;
  }
  r->condition[i] = num_arb.get_d(sum);
  return ok;
}

static bool find_truth(struct extreme_result *r, arb_ptr ball, const struct extreme_form *f,
                       const struct extreme_point *p, slong prec) {
  int status[MOST_ENTRIES * (1 + MOST_INPUTS)];
  OWNED(num_vec) in = vec_new(f->truth.n_inputs, num_ctx_arb(prec));
  OWNED(num_vec) out = vec_new(f->truth.n_outputs, num_ctx_arb(prec));
  bind(&in, &f->truth, p);
  tape_eval(&out, status, &f->truth, &in);
  bool all = true;
  for (int i = 0; i < f->n; i++) {
    bool ok = told(r, ball + i, f, &out, &in, status, i);
    if (!ok) arb_indeterminate(ball + i);
    all = all && ok;
  }
  return all;
}

/* The error of a double, in units of what the condition explains; half a dozen of the least doubles are free. */
static double loss_of(double value, int status, const arb_t ball, double condition) {
  if (!arb_is_finite(ball)) return -1;
  NUMBERS(arb, error, unit);
  double size = fabs(num_arb.get_d(ball));
  if (arb_is_zero(ball)) return status == SS_OK && value == 0 ? 0 : -1;
  if (!(size >= 0x1p-1000 && size <= 0x1p1020)) return -1;
  if (condition > 0x1p46) return -1; /* no digit is promised */
  if (status != SS_OK) return INFINITY;
  arb_set_d(error, value);
  arb_sub(error, error, ball, 128);
  arb_abs(error, error);
  arb_set_d(unit, fmax(1, condition));
  arb_mul(unit, unit, ball, 128);
  arb_abs(unit, unit);
  arb_mul_2exp_si(unit, unit, -53);
  arb_div(error, error, unit, 64);
  return arf_get_d(arb_midref(error), ARF_RND_UP);
}

/* Where the slope of an entry is zero, its change within a few units of the last place is not. */
static double condition_nearby(const struct extreme_form *f, const struct extreme_point *p, int i) {
  struct extreme_result r;
  double most = 0;
  BALLS(f->n, ball);
  for (int side = -1; side <= 1; side += 2) {
    struct extreme_point q = *p;
    q.shift = side * 0x1p-50;
    find_truth(&r, ball, f, &q, 2048);
    if (arb_is_finite(ball + i)) most = fmax(most, r.condition[i]);
  }
  return most;
}

void extreme_measure(struct extreme_result *r, struct extreme_form *f, const struct extreme_point *p) {
  enum { PROMISED = 8, HOPELESS = 1000 };
  BALLS(f->n, ball);
  OWNED(num_vec) in = vec_new(f->tape.n_inputs, num_ctx_double()), out = vec_new(f->n, num_ctx_double());
  int status[MOST_ENTRIES];
  for (slong prec = 192; prec <= 20000 && !find_truth(r, ball, f, p, prec); prec *= 3) continue;
  bind(&in, &f->tape, p);
  tape_eval(&out, status, &f->tape, &in);
  for (int i = 0; i < f->n; i++) {
    r->value[i] = num_double.get_d(num_vec_at(&out, i));
    r->truth[i] = num_arb.get_d(ball + i);
    r->loss[i] = loss_of(r->value[i], status[i], ball + i, r->condition[i]);
    if (r->loss[i] <= PROMISED || r->loss[i] > HOPELESS) continue;
    r->condition[i] = fmax(r->condition[i], condition_nearby(f, p, i));
    r->loss[i] = loss_of(r->value[i], status[i], ball + i, r->condition[i]);
  }
}

void extreme_print(struct text *out, const struct extreme_form *f, const struct extreme_point *p) {
  struct extreme_point q = *p;
  for (slong k = 0; k < f->truth.n_inputs; k++)
    text_printf(out, "%s%s=%a", k ? ", " : "", f->truth.inputs[k], extreme_value(&q, f->truth.inputs[k]));
}
