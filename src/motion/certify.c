/* What is proved of a periodic orbit, and at which precision.

   One box is proved once to hold exactly one solution.  Then, at a precision that doubles while anything is undecided,
   the solution is enclosed anew inside that box and everything else is asked of the enclosures: nothing is taken from
   the search but the place to look at.  What two routes decide counts only when they agree. */
#include "certify.h"

#include <math.h>

#include "map_balls.h"
#include "num/solve.h"
#include "orbit_equations.h"
#include "orbit_judge.h"
#include "warm.h"

enum { MAX_STEPS = 100000, BOX_FIRST = -8, BOX_STEP = 3, BOX_TRIES = 60, BOX_SAFETY = 16 };

void dyn_certificate_clear(struct dyn_certificate *z) {
  for (int i = 0; i < N_QUANTITIES; i++) arb_clear(z->box[i]);
  arb_clear(z->box_z10);
  arb_clear(z->box_z20);
}

/* --- The root --- */

/* The orbit's value of a quantity of given.h. */
static arb_srcptr quantity_of(const struct dyn_orbit *o, int i) {
  return i == QUANTITY_E1 ? o->e1 : i == QUANTITY_E2 ? o->e2 : o->t[i - QUANTITY_TA];
}

/* Half widths 2^shift times the quantity's scale: of e1 or e2 the sum of both; of t_b, t_c or t_d itself; of t_a, which
   can be zero, the sum of all times.  On a slow belt t_a is longer than all others by as many powers of ten as V has,
   and as much less certain. */
static void make_box(struct krawczyk *k, const val at[N_QUANTITIES], const struct word_data *d, slong shift) {
  double size[N_QUANTITIES], forces, times = 0;
  for (int i = 0; i < N_QUANTITIES; i++) size[i] = fabs(num_arb.get_d(at[i]));
  forces = size[QUANTITY_E1] + size[QUANTITY_E2];
  for (int i = QUANTITY_TA; i < N_QUANTITIES; i++) times += size[i];
  num_vec_set(&k->box, &k->mid);
  for (int i = 0; i < WORD_FREE; i++) {
    int which = d->unknown[i];
    mag_ptr radius = arb_radref((arb_ptr)num_vec_at(&k->box, i));
    mag_set_d(radius, which < QUANTITY_TA ? forces : which == QUANTITY_TA ? times : size[which]);
    mag_mul_2exp_si(radius, radius, shift);
  }
}

/* Bits by which a box must be narrower where positions and velocities are unknown besides the times: positions are as
   wide as the forces between them over 1 - chi, and where phase C turns slowly its length is as wide as its velocity
   over chi eta. */
static slong bits_of_coordinates(const fmpq *model) {
  NUMBERS(fmpq, gap, stiff);
  fmpq_one(gap);
  fmpq_sub(gap, gap, model + P_CHI);
  fmpq_mul(stiff, model + P_CHI, model + P_ETA);
  slong bits = (slong)fmpz_bits(fmpq_denref(gap)) - (slong)fmpz_bits(fmpq_numref(gap));
  slong slow = (slong)fmpz_bits(fmpq_denref(stiff)) - (slong)fmpz_bits(fmpq_numref(stiff));
  return bits + FLINT_MAX(slow, 0);
}

/* A box around the solution's enclosures s->x, far wider than these, in which it is the only one: the first that
   Krawczyk's operator proves, made narrower so that another program's operator can prove it too. */
static int widen(struct word_root *s, const struct word_data *d, slong prec) {
  struct ball_params m;
  OWNED(krawczyk) k;
  OWNED(num_vec) x;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  word_params(&m, &c, d->model);
  struct word_system w = {&c, &m, d->unknown, calc_mark(&c), {NULL}};
  struct solve_system system = {WORD_FREE, word_values, &w};
  num_vec_init(&x, WORD_FREE, c.ctx);
  krawczyk_init(&k, &system, prec);
  for (int i = 0; i < N_QUANTITIES; i++) w.known[i] = s->x[i]; /* its radius is that of its rounding */
  for (int i = 0; i < WORD_FREE; i++) arb_set(num_vec_at(&x, i), s->x[d->unknown[i]]);
  int status = krawczyk_centre(&k, &x);
  bool proved = false, safe = false;
  slong shift = BOX_FIRST, safety = BOX_SAFETY + bits_of_coordinates(d->model);
  for (int i = 0; i < BOX_TRIES && !safe && !status; i++) {
    shift -= proved ? safety : BOX_STEP;
    make_box(&k, w.known, d, shift);
    krawczyk_apply(&k);
    safe = proved && k.inside;
    proved = k.inside;
  }
  for (int i = 0; i < 2 && safe; i++) arb_set(s->box[d->which[i]], s->x[d->which[i]]);
  for (int i = 0; i < WORD_FREE && safe; i++) arb_swap(s->box[d->unknown[i]], num_vec_at(&k.box, i));
  return safe ? SS_OK : SS_UNABLE;
}

/* z10 and z20 of every solution whose quantities lie in the box, and somewhat more. */
static int box_of_start(struct dyn_certificate *z, const struct word_data *d, slong prec) {
  struct ball_params m;
  struct word w;
  val at[N_QUANTITIES], start[2];
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  word_params(&m, &c, d->model);
  for (int i = 0; i < N_QUANTITIES; i++) at[i] = z->box[i];
  word_make(&w, &c, &m, at);
  val force = calc_sub(&c, at[QUANTITY_E1], calc_mul(&c, m.a, at[QUANTITY_TA])); /* w at the start of the period */
  ball_positions(start, &c, &m, force, w.end);
  arb_set(z->box_z10, start[0]);
  arb_set(z->box_z20, start[1]);
  mag_mul_2exp_si(arb_radref(z->box_z10), arb_radref(z->box_z10), 2);
  mag_mul_2exp_si(arb_radref(z->box_z20), arb_radref(z->box_z20), 2);
  return c.status;
}

/* The box, once and for all. */
static bool prove_box(struct dyn_certificate *z, struct word_root *s, const struct word_data *d, slong prec) {
  if (widen(s, d, prec)) return false;
  for (int i = 0; i < N_QUANTITIES; i++) arb_set(z->box[i], s->box[i]);
  return box_of_start(z, d, prec) == SS_OK;
}

static bool is_inside(const struct dyn_certificate *z, const struct word_data *d, const struct word_root *s,
                      const struct dyn_orbit *o) {
  bool inside = true;
  for (int k = 0; k < WORD_FREE; k++) {
    int i = d->unknown[k];
    inside = inside && arb_contains(z->box[i], s->x[i]) && arb_contains(z->box[i], quantity_of(o, i));
  }
  return inside;
}

/* --- What is asked of the enclosures --- */

static truth both(truth x, truth y) {
  return x == y ? x : TRUTH_UNKNOWN;
}

/* Every condition by both routes.  o: described and judged. */
static void conclude(struct dyn_certificate *z, const struct dyn_question *q, const struct dyn_orbit *o, slong prec) {
  LOCAL(dyn_margins, m);
  bool any = dyn_margins_find(&m, q->model, o, NULL, NULL, prec) == SS_OK;
  z->spent = m.spent;
  z->stable = o->stable;
  z->admissible = TRUTH_TRUE;
  for (int i = 0; i < N_PHASES; i++) z->first[i] = o->first[i];
  for (int i = 0; i < N_CONDITIONS; i++) {
    z->holds[i] = any ? both(o->holds[i], m.at[i].holds) : TRUTH_UNKNOWN;
    z->admissible = truth_and(z->admissible, z->holds[i]);
  }
  arb_srcptr e[2] = {o->e1, o->e2}, least[2] = {o->u_r1_min, o->u_r2_min}, again[2] = {m.u_r1_min, m.u_r2_min};
  for (int i = 0; i < 2; i++) {
    z->u_r[i] =
        any ? both(friction_enough(q->u_r[i], e[i], least[i], prec), friction_enough(q->u_r[i], e[i], again[i], prec))
            : TRUTH_UNKNOWN;
    if (any && !arb_overlaps(least[i], again[i])) z->u_r[i] = TRUTH_UNKNOWN;
    z->admissible = truth_and(z->admissible, z->u_r[i]);
  }
}

static unsigned still_open(const struct dyn_certificate *z) {
  unsigned open = z->stable == TRUTH_UNKNOWN ? OPEN_STABLE : 0;
  for (int i = 0; i < N_PHASES; i++)
    if (z->first[i] != TRUTH_TRUE) open |= (unsigned)OPEN_FIRST << i;
  for (int i = 0; i < 2; i++)
    if (z->u_r[i] == TRUTH_UNKNOWN) open |= (unsigned)OPEN_U_R << i;
  for (int i = 0; i < N_CONDITIONS; i++)
    if (z->holds[i] == TRUTH_UNKNOWN) open |= (unsigned)OPEN_HOLDS << i;
  return open;
}

/* Everything but existence, at one precision. */
static void decide(struct dyn_certificate *z, const struct dyn_question *q, const struct word_root *s, slong prec) {
  OWNED(dyn_orbit) o = {.grazing = false};
  truth domain = TRUTH_UNKNOWN;
  if (word_describe(&o, s, q->model, prec) == SS_OK) word_judge_orbit(&o, &domain, s, q->model, prec, MAX_STEPS);
  z->open = OPEN_DOMAIN;
  if (domain == TRUTH_TRUE) {
    conclude(z, q, &o, prec);
    z->open = still_open(z);
  }
}

void dyn_certify(struct dyn_certificate *z, const struct dyn_question *q, const struct dyn_orbit *orbit) {
  struct word_data d = word_data_of(q->model, q->which, q->value);
  OWNED(word_root) s = {0};
  bool boxed = false;
  z->open = OPEN_ROOT;
  z->spent = false;
  for (slong prec = DYN_CERTIFY_FIRST; prec <= DYN_CERTIFY_LAST && z->open && !z->spent; prec *= 2) {
    z->bits = prec;
    for (int i = 0; i < N_QUANTITIES; i++) arb_set(s.x[i], quantity_of(orbit, i));
    if (word_solve(&s, &d, prec)) continue; /* encloses the solution near the orbit in a box of its own */
    if (!boxed) boxed = prove_box(z, &s, &d, prec);
    if (!boxed) continue;
    if (is_inside(z, &d, &s, orbit))
      decide(z, q, &s, prec);
    else
      z->open = OPEN_SAME;
  }
  z->certified = z->open == 0;
}

/* --- What is told about it --- */

void dyn_orbit_radius(mag_t radius, const struct dyn_orbit *orbit) {
#define WIDEST(name, member, what) mag_max(radius, radius, arb_radref(orbit->member));
  mag_zero(radius);
  DYN_ORBIT_NUMBERS(WIDEST)
#undef WIDEST
}

void dyn_certificate_why(struct text *out, const struct dyn_certificate *z) {
  static const struct {
    unsigned bit;
    const char *what;
  } single[] = {{OPEN_ROOT, "no box is proved to hold exactly one solution"},
                {OPEN_SAME, "the enclosures do not lie in one box of a single solution"},
                {OPEN_DOMAIN, "the signs of the limits and times"},
                {OPEN_STABLE, "the sign of |tr J| - 1"},
                {OPEN_U_R, "u_r1"},
                {OPEN_U_R << 1, "u_r2"}};
  const char *sep = "";
  for (size_t i = 0; i < sizeof single / sizeof *single; i++)
    if (z->open & single[i].bit) {
      text_printf(out, "%s%s", sep, single[i].what);
      sep = ", ";
    }
  for (int i = 0; i < N_PHASES; i++)
    if (z->open & (unsigned)OPEN_FIRST << i) {
      text_printf(out, "%sthe first event of phase %s", sep, phase_name[i]);
      sep = ", ";
    }
  for (int i = 0; i < N_CONDITIONS; i++)
    if (z->open & (unsigned)OPEN_HOLDS << i) {
      text_printf(out, "%s%s", sep, dyn_condition_id[i]);
      sep = ", ";
    }
  if (z->spent)
    text_add(out, " (phase H has too many oscillations to look through)");
  else
    text_printf(out, " (at %ld bits)", (long)z->bits);
}
