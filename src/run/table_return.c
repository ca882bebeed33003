/* The one-dimensional return map r -> r' of the word (r = z_2 - z_1 at the end of the global stick phase), as a table:
   the whole map about its fixed points, the same closer to the orbit, the fixed points with their slopes, and the
   iterates of a start.

   Events are found in double precision and r' is then enclosed near them, so that its printed digits are known.  A
   piece of the map ends where an event jumps to another root. */
#include <math.h>

#include "motion/return_map.h"
#include "tables.h"
#include "value/printed.h"

enum { DECIMALS = 6, GRID = 240, STEPS = 40 };

/* r over which the map is tabulated, a multiple of 10^-places. */
struct window {
  fmpq_t low, high;
};

bool table_go_on(arb_t r, mag_t error, const struct num_vec *returned) {
  NUMBERS(mag, slope);
  arb_get_mag(slope, num_vec_at(returned, RETURN_SLOPE));
  mag_mul(error, error, slope);
  mag_mul_2exp_si(slope, error, -4); /* the slope is not quite the same beside r */
  mag_add(error, error, slope);
  mag_add(error, error, arb_radref((arb_ptr)num_vec_at(returned, RETURN_R)));
  arb_get_mid_arb(r, num_vec_at(returned, RETURN_R));
  return mag_cmp_2exp_si(error, -40) < 0;
}

struct return_table {
  const struct table_source *s;
  struct text body;
  struct num_vec r, out; /* one r; what dyn_return_near says of it */
  double t[N_PHASES];    /* the events there */
};

/* One application, into t->out. */
static bool step(struct return_table *t) {
  struct dyn_return d;
  double r = num_arb.get_d(num_vec_at(&t->r, 0));
  if (dyn_return_map(&d, t->s->near, r) != SS_OK || d.grazing) return false;
  for (int i = 0; i < N_PHASES; i++) t->t[i] = d.t[i];
  return dyn_return_near(&t->out, &t->s->params, num_vec_at(&t->r, 0), d.t) == SS_OK;
}

static void add_row(struct return_table *t, const char *curve, long piece) {
  text_printf(&t->body, "%s\t%ld", curve, piece);
  table_number(&t->body, num_vec_at(&t->r, 0), DECIMALS);
  table_number(&t->body, num_vec_at(&t->out, RETURN_R), DECIMALS);
  table_number(&t->body, num_vec_at(&t->out, RETURN_SLOPE), DECIMALS);
  text_add_char(&t->body, '\n');
}

/* An event has moved further than it can from one r of the grid to the next unless it has become another one: a good
   part of the shortest half period. */
static bool jumped(const struct return_table *t, const double before[N_PHASES]) {
  double most = 0.5 / sqrt(1 + t->s->near[P_CHI] * t->s->near[P_ETA]);
  return fabs(t->t[PHASE_H] - before[PHASE_H]) > most || fabs(t->t[PHASE_GAMMA] - before[PHASE_GAMMA]) > most;
}

static void add_map(struct return_table *t, const char *curve, const struct window *w) {
  double before[N_PHASES] = {0};
  bool going = false;
  long piece = 0;
  NUMBERS(fmpq, r, range);
  fmpq_sub(range, w->high, w->low);
  for (long k = 0; k <= GRID; k++) {
    fmpq_set_si(r, k, GRID);
    fmpq_mul(r, r, range);
    fmpq_add(r, r, w->low);
    arb_set_fmpq(num_vec_at(&t->r, 0), r, FIRST_PREC);
    bool there = step(t);
    if (there && (!going || jumped(t, before))) piece++;
    if (there) add_row(t, curve, piece);
    going = there;
    for (int i = 0; i < N_PHASES; i++) before[i] = t->t[i];
  }
}

/* From low to high, widened to decimals of a hundredth of their distance or less, and cut off at `end`. */
static void window_set(struct window *w, double low, double high, double end) {
  NUMBERS(fmpz, unit, n);
  fmpz_one(unit);
  for (double u = 1; u * 100 > high - low; u /= 10) fmpz_mul_ui(unit, unit, 10);
  double scale = fmpz_get_d(unit);
  fmpz_set_d(n, floor(low * scale));
  fmpq_set_fmpz_frac(w->low, n, unit);
  fmpz_set_d(n, high < end ? ceil(high * scale) : floor(end * scale));
  fmpq_set_fmpz_frac(w->high, n, unit);
}

static void add_fixed_points(struct return_table *t) {
  const struct dyn_orbits *list = t->s->list;
  for (slong k = 0; k < list->n; k++) {
    const struct dyn_orbit *o = &list->orbit[k];
    text_printf(&t->body, "%s\t%ld", o->admissible == TRUTH_TRUE ? "orbit" : "formal", (long)k + 1);
    arb_sub(num_vec_at(&t->r, 0), o->z20, o->z10, FIRST_PREC);
    table_number(&t->body, num_vec_at(&t->r, 0), DECIMALS);
    table_number(&t->body, num_vec_at(&t->r, 0), DECIMALS);
    table_number(&t->body, o->trace, DECIMALS);
    text_add_char(&t->body, '\n');
  }
}

/* The start: as printed, else 1/64 V beside the orbit. */
static void set_start(struct return_table *t) {
  arb_ptr r = num_vec_at(&t->r, 0);
  if (t->s->printed[0]) {
    NUMBERS(fmpq, z);
    fmpq_sub(z, &t->s->printed[1]->value, &t->s->printed[0]->value);
    arb_set_fmpq(r, z, FIRST_PREC);
  } else {
    arb_mul_2exp_si(r, num_vec_at(&t->s->params, P_V), -6);
    arb_add(r, r, t->s->orbit->z20, FIRST_PREC);
    arb_sub(r, r, t->s->orbit->z10, FIRST_PREC);
  }
}

/* The largest distance from centre of the iterates. */
static double add_iterates(struct return_table *t, double centre) {
  double most = 0;
  NUMBERS(mag, error);
  set_start(t);
  for (long n = 0; n < STEPS; n++) {
    most = fmax(most, fabs(num_arb.get_d(num_vec_at(&t->r, 0)) - centre));
    if (!step(t)) break;
    add_row(t, "iterate", n);
    if (!table_go_on(num_vec_at(&t->r, 0), error, &t->out)) break;
  }
  return most;
}

static void add_curves(struct return_table *t) {
  const struct dyn_orbits *list = t->s->list;
  double end = t->s->near[P_E2] / t->s->near[P_CHI]; /* phase Gamma begins below */
  double centre = orbit_r(t->s->orbit), low = centre, high = centre;
  add_fixed_points(t);
  double reach = add_iterates(t, centre);
  for (slong k = 0; k < list->n; k++) {
    low = fmin(low, orbit_r(&list->orbit[k]));
    high = fmax(high, orbit_r(&list->orbit[k]));
  }
  double span = fmax(high - low, fmax(8 * reach, t->s->near[P_V] / 4));
  struct window w;
  fmpq_init(w.low);
  fmpq_init(w.high);
  window_set(&w, low - 0.3 * span, high + 0.3 * span, end);
  add_map(t, "map", &w);
  window_set(&w, centre - 1.5 * reach, centre + 1.5 * reach, end);
  add_map(t, "near", &w);
  fmpq_clear(w.high);
  fmpq_clear(w.low);
}

void table_of_return_map(struct table_source *s) {
  struct return_table t = {.s = s};
  num_vec_init(&t.r, 1, s->params.ctx);
  num_vec_init(&t.out, N_RETURN, s->params.ctx);
  text_printf(
      &t.body,
      "# The return map of the word: r = z_2 - z_1 at the end of the global stick phase, r' one period later, and "
      "the slope dr'/dr.\n"
      "# curve map, near: the map, over all fixed points and close to %s, in "
      "pieces; orbit, formal: fixed points by number, formal where a condition is broken, with tr J as slope;\n"
      "# iterate: from the printed start (from beside the orbit where none is printed), by number.  r and r' "
      "are lengths in the unit of the positions.\n"
      "curve\tpiece\tr\tr'\tslope\n",
      usual_orbit_text(s->j, "orbit"));
  add_curves(&t);
  table_finish(s->j->out, "return-map.tsv", &t.body);
  num_vec_clear(&t.out);
  num_vec_clear(&t.r);
}
