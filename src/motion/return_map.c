/* The return map of r in double precision.

   t_b: the rise of r in phase Gamma is the same seen backwards from its crest, so only the first half of it is ever
   solved, from a start that is good to some percent.  t_c: slip.c.  For either event the sine and cosine are computed
   once or twice and then turned by each step.  Where this quick way fails, the walk of trig_sum.c finds the events.

   At half of all points terms cancel by more than the promised error, and to tell where that harms an output costs as
   much as forming the output in twice the precision.  So dyn_return_map forms every output anew near the events
   (polish.h), and dyn_return_map_d none. */
#include "return_map.h"

#include <string.h>

#include "num/pi.h"
#include "polish.h"
#include "return_map_double.h"
#include "rounded.h"

enum { MOST_STEPS = 8 };
static const double MOST_CHI = 0x1p4, MOST_ETA = 0x1p3, MOST_SIZE = 0x1p5;
static const double SETTLED = 0x1p-13; /* relative: the error after a step of this size is its fourth power */

/* --- t_b. --- */

struct rise_end {
  double t;
  struct half_angle b;
};

/* The time in (0, 2 pi/3) or (0, fall/2) at which the rise is g > 0.  With y = sin(t/2) it is
   2 e1 y^2 + (4/3) a y^3 (1 + 0.3 y^2 + ...): a start within some percent is y = s (1 + 0.8 z)/(1 + 1.3 z + 0.084 z^2),
   s^2 = g/(2 e1), z = (2/3)(a/e1) s (1 + ...). */
static bool first_half(struct rise_end *x, const struct slip *k, double g) {
  double scale = 0.5 / k->e1, v = g * scale, s = sqrt(v), slope = (4.0 / 3) * k->a * scale;
  double z = slope * s, y = s * (1 + 0.798 * z) / (1 + z * (1.298 + 0.084 * z));
  y = y < 1 ? y : 1;
  double yy = y * y, t = 2 * y * (1 + yy * (1.0 / 6 + yy * (0.075 + yy * 0.12)));
  struct half_angle b = half_angle(t);
  for (int i = 0; i < MOST_STEPS; i++) {
    struct gamma_end at = gamma_at(k, t, b);
    double step = quartic_step(at.rise - g, -at.p, at.w, at.dw);
    t += step;
    if (!(t > 0 && t < 3.5)) return false;
    b = fabs(step) < HALF_ANGLE_NEAR ? half_angle_move(b, step) : half_angle(t);
    if (fabs(step) > SETTLED * t) continue;
    *x = (struct rise_end){t, b};
    return true;
  }
  return false;
}

/* The first time at which the rise is g > 0. */
static bool rise_reaches(struct rise_end *x, const struct slip *k, double g) {
  if (g < 1.2283 * k->a + 1.5 * k->e1) return first_half(x, k, g); /* at 2 pi/3, where it is steep */
  double fall = gamma_crest(k->a, k->e1), top = k->a * fall + 2 * k->e1, turn = 2 * PI * k->a, whole = 0;
  double doubt = SLIP_DOUBT * (top + g);
  if (g > top) whole = ceil((g - top) / turn);
  g -= whole * turn;
  if (!(top - g > doubt && (whole == 0 || g - (top - turn) > doubt))) return false; /* nearly touches a crest */
  bool back = g > 0.5 * top;
  if (!first_half(x, k, back ? top - g : g)) return false;
  if (back) {
    double per = 1 / sqrt(k->a * k->a + k->e1 * k->e1), s = k->a * per, c = k->e1 * per;
    x->t = fall - x->t;
    x->b = (struct half_angle){c * x->b.c + s * x->b.s, c * x->b.s - s * x->b.c};
  }
  x->t += 2 * PI * whole;
  return true;
}

/* --- The map. --- */

static double slope_of(const struct slip_motion *h, const struct stop *x, double r_end) {
  const struct slip *k = h->k;
  struct change d = slip_change(k, &h->g, x->x);
  return k->soft * (x->n.pull * k->soft * d.pull + x->n.q * d.q) / (r_end * h->g.p);
}

/* Nothing has overflowed. */
static bool is_sound(const struct dyn_return *x) {
  bool sound = isfinite(x->r_end) && isfinite(x->t[PHASE_D]);
  for (int i = PHASE_GAMMA; i < N_PHASES; i++) sound = sound && x->t[i] > 0 && isfinite(x->t[i]);
  return sound;
}

static bool fast_map(struct dyn_return *out, const struct slip *k, double g) {
  struct slip_motion h = {.k = k};
  struct rise_end begin;
  struct stop end;
  if (!rise_reaches(&begin, k, g) || begin.t > dyn_limits_default.t_max) return false;
  h.g = gamma_at(k, begin.t, begin.b);
  h.m = slip_modes(k, &h.g);
  if (slip_first_root(&end, &h)) return false;
  double r_end = slip_radius(k, &end.n), td = slip_td(k, &end.n, r_end);
  double behind = slip_behind(k, &h.g, &h.m, end.x, end.t) / k->V;
  double defect = slip_gain(k, &end.n, r_end) + g;
  out->t[PHASE_D] = k->chi * defect / k->a + ((behind - begin.t) - end.t) - td;
  out->t[PHASE_GAMMA] = begin.t;
  out->t[PHASE_H] = end.t;
  out->t[PHASE_C] = td;
  out->r_end = r_end;
  out->slope = slope_of(&h, &end, r_end);
  out->grazing = out->searched = false;
  return is_sound(out);
}

/* Whether the rise touches g at a crest, within rounding. */
static bool touches(const struct return_map_double *k, double g) {
  double crest = return_map_double_rise(k, k->fall), noise = 1e-13 * (g + crest), turn = 2 * PI * k->slip.a;
  double over = g - crest - (g > crest ? turn * nearbyint((g - crest) / turn) : 0);
  return fabs(over) < noise;
}

/* By the walk of trig_sum.c. */
static int slow_map(struct dyn_return *out, const double params[N_PARAMS], double g) {
  struct return_map_double k;
  struct pass s;
  if (return_map_double_init(&k, params)) return SS_DOMAIN;
  double tb = return_map_double_time(&k, g);
  if (!(tb <= dyn_limits_default.t_max)) return SS_UNABLE;
  return_map_double_pass(&s, &k, tb, NULL, &dyn_limits_default);
  if (s.status) return s.status;
  *out = (struct dyn_return){{0, s.tb, s.tc, 0}, s.r_end, s.slope / s.pb + 1, s.grazing || touches(&k, g), true};
  return_map_double_times(&out->t[PHASE_D], &out->t[PHASE_C], &k, &s);
  return is_sound(out) ? SS_OK : SS_UNABLE;
}

/* Whether the parameters are ones for which the roundings on the way have been measured to stay small. */
static bool is_ordinary(const double params[N_PARAMS], double r) {
  double chi = params[P_CHI], eta = params[P_ETA], V = params[P_V];
  const double size[] = {params[P_E1], params[P_E2], fabs(r)};
  bool ordinary = chi >= 1 / MOST_CHI && chi <= 1 - 1 / MOST_CHI && eta >= 1 / MOST_ETA && eta <= MOST_ETA;
  ordinary = ordinary && V >= 0x1p-200 && V <= 0x1p200;
  for (int i = 0; i < 3; i++) ordinary = ordinary && (i == 2 || size[i] >= V / MOST_SIZE) && size[i] <= V * MOST_SIZE;
  return ordinary;
}

static void near_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  const struct num_vec params = calc_vec_of(c, p, N_PARAMS);
  struct num_vec to = calc_vec(c, N_RETURN);
  double guess[N_PHASES] = {0};
  (void)ph, (void)t;
  for (int i = PHASE_GAMMA; i < N_PHASES; i++) guess[i] = num_arb.get_d(in[i]);
  c->status |= rounded_from_guess(dyn_return_near(&to, &params, in[0], guess), c);
  flow_vals(out, &to, 0, N_RETURN);
}

/* Through balls, near the times that are known. */
static int mended(struct dyn_return *x, const double params[N_PARAMS], double r) {
  double in[N_PHASES] = {r, x->t[PHASE_GAMMA], x->t[PHASE_H], x->t[PHASE_C]}, to[N_RETURN], given[N_PARAMS];
  const struct num_ctx d = num_ctx_double();
  struct num_vec out = {d, N_RETURN, (char *)to}, p = {d, N_PARAMS, (char *)given}, from = {d, N_PHASES, (char *)in};
  memcpy(given, params, sizeof given);
  int status = rounded_run(&out, near_formula, PHASE_D, &p, &from, NULL);
  memcpy(x->t, to, sizeof x->t);
  x->r_end = to[RETURN_R];
  x->slope = to[RETURN_SLOPE];
  return status || !is_sound(x) ? SS_UNABLE : SS_OK;
}

/* Velocities and lengths by 2^by; whether none of them rounds. */
static bool scaled(double to[N_PARAMS], double *r_to, const double params[N_PARAMS], double r, int by) {
  static const int of[] = {P_V, P_E1, P_E2};
  bool exact = true;
  memcpy(to, params, N_PARAMS * sizeof *to);
  for (int i = 0; i < 3; i++) {
    to[of[i]] = ldexp(params[of[i]], by);
    exact = exact && isnormal(to[of[i]]);
  }
  *r_to = ldexp(r, by);
  return exact && (r == 0 || isnormal(*r_to));
}

static int map_as_given(struct dyn_return *out, const double params[N_PARAMS], double r) {
  struct slip k;
  if (!slip_init(&k, params)) return SS_DOMAIN;
  if (!isfinite(r)) return SS_UNABLE;
  double g = fma(-k.chi, r, params[P_E2]) / k.chi; /* e2/chi - r, where e2/chi rounded would lose it */
  if (!(g > 0)) return SS_DOMAIN;
  return fast_map(out, &k, g) ? SS_OK : slow_map(out, params, g);
}

/* The times found with velocities and lengths near 1, since their squares are formed. */
static int map_of_any(struct dyn_return *out, const double params[N_PARAMS], double r) {
  double near[N_PARAMS], at;
  int size = params[P_V] > 0 && isfinite(params[P_V]) ? ilogb(params[P_V]) : 0;
  bool exact = scaled(near, &at, params, r, -size);
  int status = exact ? map_as_given(out, near, at) : map_as_given(out, params, r);
  if (!exact) return status ? status : SS_UNABLE;
  if (!status && !out->grazing) status = mended(out, near, at);
  if (status) return status;
  out->r_end = ldexp(out->r_end, size);
  return isnormal(out->r_end) ? SS_OK : SS_UNABLE;
}

/* The events in double precision, and the outputs, but for those that go through balls. */
static int plain_map(struct dyn_return *out, bool *plain, const double params[N_PARAMS], double r) {
  *plain = is_ordinary(params, r);
  if (!*plain) return map_of_any(out, params, r);
  int status = map_as_given(out, params, r);
  if (status || !out->searched) return status;
  *plain = false;
  return out->grazing ? status : mended(out, params, r);
}

int dyn_return_map(struct dyn_return *out, const double params[N_PARAMS], double r) {
  struct dd fine[N_RETURN];
  bool plain;
  int status = plain_map(out, &plain, params, r);
  if (status || !plain) return status;
  if (!polish_map(fine, params, r, out->t[PHASE_GAMMA], out->t[PHASE_H])) return mended(out, params, r);
  for (int i = 0; i < N_PHASES; i++) out->t[i] = fine[RETURN_TA + i].high;
  out->r_end = fine[RETURN_R].high;
  out->slope = fine[RETURN_SLOPE].high;
  return SS_OK;
}

int dyn_return_map_d(double *r_out, double *slope, double t[4], const double params[N_PARAMS], double r) {
  struct dyn_return x;
  bool plain;
  int status = plain_map(&x, &plain, params, r);
  if (status) return status;
  *r_out = x.r_end;
  if (slope) *slope = x.slope;
  if (t) memcpy(t, x.t, sizeof x.t);
  return SS_OK;
}
