/* The interval of r that the return map contracts around a stable orbit.

   t_b stands for r, which falls strictly as t_b grows up to the first crest.  Over a ball of t_b interval Newton
   encloses t_c, and what is known of orbits is known of the pass that starts there: its conditions, and the slope of
   the return map in place of the trace.  A ball that leaves something open is halved.  The half width of the interval
   is found by growing it until the proof fails, then by bisection. */
#include "basin.h"

#include <math.h>

#include "family.h"
#include "motion/map_balls.h"
#include "motion/orbit_judge.h"
#include "motion/return_map_double.h"
#include "motion/warm.h"
#include "num/solve.h"

enum { BASIN_PREC = 96, MOST_DEPTH = 11, BISECTIONS = 8, FINE = 10, CANDIDATES = 16 };

void dyn_basin_init(struct dyn_basin *b) {
  *b = (struct dyn_basin){.proved = false};
  fmpq_init(&b->low);
  fmpq_init(&b->high);
  fmpq_init(&b->fails_at);
}

void dyn_basin_clear(struct dyn_basin *b) {
  fmpq_clear(&b->low);
  fmpq_clear(&b->high);
  fmpq_clear(&b->fails_at);
}

/* The map near one orbit. */
struct field {
  struct calc c;
  struct ball_params m;
  struct return_map_double k;
  const fmpq *u_r[2];
  bool up;
  arb_t r, image;     /* of the orbit; where the pass at hand ends */
  struct dyn_orbit o; /* of the pass at hand */
  truth word;
  double slope; /* greatest so far */
};

static bool field_init(struct field *f, const fmpq *params, const fmpq *const u_r[2], const struct dyn_orbit *orbit) {
  double p[N_PARAMS];
  for (int i = 0; i < 2; i++) f->u_r[i] = u_r[i];
  for (int i = 0; i < N_PARAMS; i++) p[i] = fmpq_get_d(params + i);
  f->c = calc_begin(num_ctx_arb(BASIN_PREC));
  ball_params_init(&f->m, &f->c, params);
  arb_init(f->r);
  arb_init(f->image);
  arb_sub(f->r, orbit->z20, orbit->z10, BASIN_PREC);
  f->up = arb_is_positive(f->r);
  f->o = (struct dyn_orbit){.grazing = false};
  return return_map_double_init(&f->k, p) == SS_OK && !f->c.status;
}

static void field_clear(struct field *f) {
  dyn_orbit_clear(&f->o);
  arb_clear(f->r);
  arb_clear(f->image);
  calc_clear(&f->c);
}

/* --- One ball of t_b. --- */

/* A time t, of phase H after t_b or t_b itself, as the unknown of one equation. */
struct time {
  struct field *f;
  arb_srcptr tb; /* NULL: it is the unknown */
  arb_srcptr r;  /* which is wanted at the stick phase then */
  slong mark;    /* what lies above it in the calc belongs to one evaluation */
};

/* z_1' - V after t in phase H, whose derivative is -w; or r at the stick phase that leads to t_b = t, whose derivative
   is z_1' - V, less that which is wanted. */
static int values(const void **f, const void **j, const struct num_vec *t, void *self) {
  const struct time *of = self;
  struct calc *c = &of->f->c;
  struct ball_pass s;
  calc_release(c, of->mark);
  c->status = SS_OK;
  if (of->tb)
    ball_pass_slip(&s, c, &of->f->m, of->tb, num_vec_at(t, 0));
  else
    ball_pass_slip(&s, c, &of->f->m, num_vec_at(t, 0), of->f->m.one);
  if (f) f[0] = of->tb ? s.pc : calc_sub(c, s.r, of->r);
  j[0] = of->tb ? calc_neg(c, s.wc) : s.pb;
  return c->status;
}

/* The only root near t, for every point of what is given. */
static bool enclose(arb_t t, struct time *of, double near) {
  struct calc *c = &of->f->c;
  const struct solve_system system = {1, values, of};
  struct num_vec x = {num_ctx_arb(BASIN_PREC), 1, (char *)t};
  slong mark = of->mark = calc_mark(c);
  arb_set_d(t, near);
  int status = of->tb ? SS_OK : newton_settle(&x, &system, 60);
  if (!status) status = krawczyk_enclose(&x, NULL, &system);
  c->status = SS_OK;
  calc_release(c, mark);
  return status == SS_OK;
}

/* The only root t_c of z_1' = V near the first one of the midpoint, for every point of tb. */
static bool enclose_tc(arb_t tc, struct field *f, const arb_t tb) {
  struct pass s;
  return_map_double_pass(&s, &f->k, num_arb.get_d(tb), NULL, &dyn_limits_default);
  return s.status == SS_OK && enclose(tc, &(struct time){.f = f, .tb = tb}, s.tc);
}

/* Everything about the passes that start in tb, into f->o and f->word. */
static bool pass_over(struct field *f, const arb_t tb) {
  slong mark = calc_mark(&f->c);
  arb_ptr tc = calc_new(&f->c);
  struct ball_pass s;
  bool ok = enclose_tc(tc, f, tb);
  if (ok) {
    ball_pass_make(&s, &f->c, &f->m, tb, tc, f->up);
    ok = dyn_orbit_describe(&f->o, &f->c, &f->m, &s) == SS_OK;
  }
  if (ok) {
    f->word = dyn_orbit_judge(&f->o, &f->c, &f->m, &s, dyn_limits_default.max_steps);
    arb_set(f->image, s.r_end);
  }
  ok = ok && !f->c.status;
  f->c.status = SS_OK;
  calc_release(&f->c, mark);
  return ok;
}

/* A condition at the pass at hand; after those of every orbit, whether u_r1 and u_r2 are enough. */
static truth condition(const struct field *f, int i) {
  if (i < N_CONDITIONS) return f->o.holds[i];
  int mass = i - N_CONDITIONS;
  return orbit_friction_enough(&f->o, mass, f->u_r[mass], BASIN_PREC);
}

static truth all_conditions(const struct field *f) {
  truth t = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS + 2; i++) t = truth_and(t, condition(f, i));
  return t;
}

/* Whether all passes that start between the two times contract and keep the order. */
static bool contracts(struct field *f, double low, double high, int depth) {
  slong mark = calc_mark(&f->c);
  arb_ptr tb = calc_new(&f->c);
  arb_union(tb, calc_d(&f->c, low), calc_d(&f->c, high), BASIN_PREC);
  bool known = pass_over(f, tb);
  calc_release(&f->c, mark);
  truth order = known ? all_conditions(f) : TRUTH_UNKNOWN;
  if (known && f->word == TRUTH_TRUE && order == TRUTH_TRUE && f->o.stable == TRUTH_TRUE) {
    NUMBERS(arf, most);
    arb_get_abs_ubound_arf(most, f->o.trace, 53);
    f->slope = fmax(f->slope, arf_get_d(most, ARF_RND_UP));
    return true;
  }
  bool broken = known && (f->word == TRUTH_FALSE || order == TRUTH_FALSE || f->o.stable == TRUTH_FALSE);
  double mid = 0.5 * (low + high);
  if (broken || depth == MOST_DEPTH || !(mid > low && mid < high)) return false;
  return contracts(f, low, mid, depth + 1) && contracts(f, mid, high, depth + 1);
}

/* --- An interval of r. --- */

/* The t_b before the first crest at which the stick phase has this r. */
static bool time_of(arb_t tb, struct field *f, const arb_t r) {
  struct calc *c = &f->c;
  double near = return_map_double_time(&f->k, num_arb.get_d(calc_sub(c, calc_div(c, f->m.p[P_E2], f->m.p[P_CHI]), r)));
  return near > 0 && near < f->k.fall && enclose(tb, &(struct time){.f = f, .r = r}, near);
}

static void set_decimal(fmpq_t q, double x, slong places) {
  NUMBERS(arf, scaled);
  arf_set_d(scaled, x);
  fmpz_ui_pow_ui(fmpq_denref(q), 10, (ulong)places);
  arf_mul_fmpz(scaled, scaled, fmpq_denref(q), ARF_PREC_EXACT, ARF_RND_DOWN);
  arf_get_fmpz(fmpq_numref(q), scaled, ARF_RND_NEAR);
  fmpq_canonicalise(q);
}

/* So many decimals that the ends of an interval of this half width are as far from r as it says to 1e-10 of it. */
static slong places_for(double half) {
  slong n = FINE - (slong)floor(log10(half));
  return n > 0 ? n : 0;
}

/* Slopes up to L and L times the farther end within the nearer one: the interval goes into itself. */
static bool goes_inside(const struct field *f, const arb_t low, const arb_t high) {
  ARB_VECTOR(d, 4);
  arb_sub(d, f->r, low, BASIN_PREC);
  arb_sub(d + 1, high, f->r, BASIN_PREC);
  arb_max(d + 2, d, d + 1, BASIN_PREC);
  arb_min(d + 3, d, d + 1, BASIN_PREC);
  arb_set_d(d, f->slope);
  arb_mul(d + 2, d + 2, d, BASIN_PREC);
  return f->slope < 1 && arb_is_positive(d + 3) && arb_lt(d + 2, d + 3);
}

/* The proof for r - half, r + half, which b then holds. */
static bool prove(struct dyn_basin *b, struct field *f, double half) {
  FMPQ_VECTOR(ends, 2);
  double r = num_arb.get_d(f->r);
  ARB_VECTOR(x, 4);
  bool ok = true;
  for (int i = 0; i < 2; i++) {
    set_decimal(ends + i, i ? r + half : r - half, places_for(half));
    arb_set_fmpq(x + i, ends + i, BASIN_PREC);
    ok = ok && time_of(x + 2 + i, f, x + i);
  }
  if (ok) {
    double low = num_arb.get_d(x + 3), high = num_arb.get_d(x + 2); /* r falls as t_b grows */
    f->slope = 0;
    ok = contracts(f, low * (1 - 1e-15), high * (1 + 1e-15), 0) && goes_inside(f, x, x + 1);
  }
  if (ok) {
    b->proved = true;
    b->slope = f->slope;
    fmpq_set(&b->low, ends);
    fmpq_set(&b->high, ends + 1);
  }
  return ok;
}

/* --- A point where it fails. --- */

/* The one condition that is broken for certain, or -1. */
static int broken_condition(const struct field *f) {
  for (int i = 0; i < N_CONDITIONS + 2; i++)
    if (condition(f, i) == TRUTH_FALSE) return i;
  return -1;
}

/* Whether r is too high for m2 to stick, or so low that m1 comes up to the belt's speed in phase Gamma: -1 if
   neither. */
static int out_of_reach(struct field *f, const arb_t r) {
  struct calc *c = &f->c;
  struct ball_pass crest;
  if (arb_ge(r, calc_div(c, f->m.p[P_E2], f->m.p[P_CHI]))) return COND_D_R;
  ball_pass_slip(&crest, c, &f->m, ball_crest(c, &f->m), f->m.one);
  return arb_lt(r, crest.r) ? COND_GAMMA_V1 : -1;
}

/* Whether the way from r breaks a condition, or the map does not contract there. */
static bool fails(struct dyn_basin *b, struct field *f, const arb_t r) {
  slong mark = calc_mark(&f->c);
  NUMBERS(arb, tb, far, start);
  b->why = FAILS_UNKNOWN;
  b->condition = out_of_reach(f, r);
  if (b->condition < 0 && time_of(tb, f, r) && pass_over(f, tb) && f->word == TRUTH_TRUE) {
    b->condition = broken_condition(f);
    arb_sub(far, f->image, f->r, BASIN_PREC);
    arb_abs(far, far);
    arb_sub(start, r, f->r, BASIN_PREC);
    arb_abs(start, start);
    if (f->o.stable == TRUTH_FALSE)
      b->why = FAILS_SLOPE;
    else if (arb_gt(far, start))
      b->why = FAILS_IMAGE;
  }
  if (b->condition >= 0) b->why = FAILS_CONDITION;
  f->c.status = SS_OK;
  calc_release(&f->c, mark);
  return b->why != FAILS_UNKNOWN;
}

/* The nearest point that fails among some on both sides, up to twice as far as the interval reaches. */
static void find_failure(struct dyn_basin *b, struct field *f, double half) {
  NUMBERS(arb, x);
  bool found = false;
  double r = num_arb.get_d(f->r);
  for (int i = 1; i < CANDIDATES && !found; i++)
    for (int side = -1; side <= 1 && !found; side += 2) {
      set_decimal(&b->fails_at, r + side * half * (1 + (double)i / CANDIDATES), places_for(half));
      arb_set_fmpq(x, &b->fails_at, BASIN_PREC);
      found = fails(b, f, x);
    }
}

void dyn_basin_find(struct dyn_basin *b, const fmpq *params, const fmpq *const u_r[2], const struct dyn_orbit *orbit) {
  b->proved = false;
  b->why = FAILS_UNKNOWN;
  if (orbit->stable != TRUTH_TRUE || orbit->admissible != TRUTH_TRUE) return;
  OWNED(field) f;
  if (field_init(&f, params, u_r, orbit)) {
    double scale = fabs(num_arb.get_d(f.r)) + fmpq_get_d(params + P_E2) / fmpq_get_d(params + P_CHI);
    double good = 0, bad = 1e-9 * scale;
    for (; bad < 4 * scale && prove(b, &f, bad); bad *= 4) good = bad;
    for (int i = 0; i < BISECTIONS && good > 0; i++) {
      double mid = sqrt(good * bad);
      *(prove(b, &f, mid) ? &good : &bad) = mid;
    }
    if (good > 0) find_failure(b, &f, good);
  }
}
