/* The extreme regions as a table.  A region takes coordinates in [0, 1) to a point, so that a search in the coordinates
   stays in the region; two coordinates for each input place it near 1 in size, and the region moves what it is about.

   Where a region is the neighbourhood of a zero of an expression (a pole of a formula, a grazing end of a phase, tr J =
   1), the zero is looked for along one input by bisection in double precision, and the point is put beside it at a
   distance from half the input down to its last bit. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/calc.h"
#include "stability_impl.h"

/* How a region moves a point. */
enum region_move {
  MOVE_NONE,
  MOVE_POWER,     /* every input of a class, or of a name: 10^(from .. to) */
  MOVE_TOGETHER,  /* the velocities, states and forces by one factor */
  MOVE_UP_TO_1,   /* chi = 1 - 2^-k */
  MOVE_RESONANCE, /* chi = 10^(from .. to) and chi eta beside 1: the frequencies meet */
  MOVE_TO_ZERO,   /* beside a zero of the expression */
  MOVE_CANCEL,    /* beside a zero of a sum or difference of the formula's own */
  MOVE_ANYWHERE   /* every input over its whole range */
};

/* id, what it is, move, class of the inputs, name or expression, its section, decades from, to */
#define REGIONS(X)                                                                                                     \
  X("ordinary", "everything near 1", MOVE_NONE, 0, NULL, NULL, 0, 0)                                                   \
  X("chi-to-0", "chi from 0.1 down to 1e-300", MOVE_POWER, INPUT_CHI, NULL, NULL, -1, -300)                            \
  X("chi-to-1", "1 - chi from 1/2 down to 2^-53", MOVE_UP_TO_1, INPUT_CHI, NULL, NULL, 0, 0)                           \
  X("eta-to-0", "eta down to 1e-300", MOVE_POWER, INPUT_ETA, NULL, NULL, 0, -300)                                      \
  X("eta-to-infinity", "eta up to 1e300", MOVE_POWER, INPUT_ETA, NULL, NULL, 0, 300)                                   \
  X("chi-eta-near-1", "chi*eta beside 1", MOVE_TO_ZERO, 0, "chi*eta - 1", "stability", 0, 0)                           \
  X("chi-to-0-chi-eta-near-1", "chi from 0.1 down to 1e-300, chi*eta beside 1, times up to 1e16", MOVE_RESONANCE, 0,   \
    NULL, NULL, -1, -300)                                                                                              \
  X("V-small", "V down to 1e-300", MOVE_POWER, INPUT_V, NULL, NULL, 0, -300)                                           \
  X("V-large", "V up to 1e300", MOVE_POWER, INPUT_V, NULL, NULL, 0, 300)                                               \
  X("forces-small", "e_1, e_2, u_r1, ... down to 1e-300", MOVE_POWER, INPUT_FORCE, NULL, NULL, 0, -300)                \
  X("forces-large", "e_1, e_2, u_r1, ... up to 1e300", MOVE_POWER, INPUT_FORCE, NULL, NULL, 0, 300)                    \
  X("scale-small", "V, forces and states by one factor down to 1e-300", MOVE_TOGETHER, 0, NULL, NULL, 0, -300)         \
  X("scale-large", "V, forces and states by one factor up to 1e300", MOVE_TOGETHER, 0, NULL, NULL, 0, 300)             \
  X("times-small", "all times down to 1e-300", MOVE_POWER, INPUT_TIME, NULL, NULL, 0, -300)                            \
  X("times-large", "all times up to 1e16", MOVE_POWER, INPUT_TIME, NULL, NULL, 0, 16)                                  \
  X("t_b-to-0", "t_b down to 1e-300", MOVE_POWER, INPUT_TIME, "t_b", NULL, 0, -300)                                    \
  X("omega-t_d-near-0", "t_d down to 1e-300", MOVE_POWER, INPUT_TIME, "t_d", NULL, 0, -300)                            \
  X("omega-t_d-near-pi", "beside a zero of sin(omega*t_d)", MOVE_TO_ZERO, 0, "sin(omega*t_d)", "stability", 0, 0)      \
  X("omega-t_d-near-half-pi", "beside a zero of cos(omega*t_d)", MOVE_TO_ZERO, 0, "cos(omega*t_d)", "stability", 0, 0) \
  X("t-near-multiple-of-pi", "beside a zero of sin(t)", MOVE_TO_ZERO, 0, "sin(t)", "stability", 0, 0)                  \
  X("pole-chi_b", "beside 1 - chi_b = 0: grazing at t_b", MOVE_TO_ZERO, 0, "1 - chi_b", "stability", 0, 0)             \
  X("pole-z_1c", "beside z_1c - chi*z_2c = 0: grazing at t_c", MOVE_TO_ZERO, 0, "z_1c - chi*z_2c", "stability", 0, 0)  \
  X("pole-z_20", "beside z_200 - z_100 = 0: grazing at t_d", MOVE_TO_ZERO, 0, "z_200 - z_100", "stability", 0, 0)      \
  X("z_20-near-z_10", "beside z_20 - z_10 = 0", MOVE_TO_ZERO, 0, "z_20 - z_10", "stability", 0, 0)                     \
  X("N_1-near-I", "beside det(N_1 - I) = 0", MOVE_TO_ZERO, 0, "det(N_1 - I)", "validation", 0, 0)                      \
  X("N_3-near-singular", "beside det(N_3) = 0", MOVE_TO_ZERO, 0, "det(N_3)", "validation", 0, 0)                       \
  X("near-flip", "beside tr(J) = -1", MOVE_TO_ZERO, 0, "tr(J) + 1", "stability", 0, 0)                                 \
  X("near-fold", "beside tr(J) = 1", MOVE_TO_ZERO, 0, "tr(J) - 1", "stability", 0, 0)                                  \
  X("own-zero", "beside a zero of one of the formula's own sums or differences", MOVE_CANCEL, 0, NULL, NULL, 0, 0)     \
  X("anywhere", "every input over its whole range", MOVE_ANYWHERE, 0, NULL, NULL, 0, 0)

static const struct {
  enum region_move move;
  enum input_class class;
  const char *name, *section;
  double from, to;
} region_table[] = {
#define REGION_ROW(id, says, move, class, name, section, from, to)                                                     \
  {move, (enum input_class)(class), name, section, from, to},
    REGIONS(REGION_ROW)
#undef REGION_ROW
};
const struct stability_region digits_region[] = {
#define REGION_WORDS(id, says, move, class, name, section, from, to) {id, says},
    REGIONS(REGION_WORDS)
#undef REGION_WORDS
};
const int n_digits_regions = sizeof digits_region / sizeof *digits_region;

int digits_region_width(int region) {
  return region_table[region].move == MOVE_ANYWHERE ? 8 : 1;
}

struct digits_place {
  int region;
  struct digits_bench *w;
  struct digits_set *s;
  struct tape zero;     /* of the expression whose zero is looked for, of the region or the sum used last */
  const struct tape *t; /* that, or the formula's own; and which output */
  slong node;
  slong input[DIGITS_INPUTS]; /* the formula's input for each of its inputs */
  slong *sum;                 /* for MOVE_CANCEL: nodes */
  slong n_sums;
};

/* --- Readying --- */

static bool has_class(const struct digits_formula *f, enum input_class c) {
  for (slong k = 0; k < f->tape.n_inputs; k++)
    if (f->input[k] == c) return true;
  return false;
}

/* To look for zeros of that output; false where it reads what is no input of the formula. */
static bool aim(struct digits_place *p, const struct tape *t, slong node) {
  bool ok = t->n_inputs <= DIGITS_INPUTS;
  p->t = t;
  p->node = node;
  for (slong k = 0; ok && k < t->n_inputs; k++) {
    p->input[k] = tape_input(&p->w->f->tape, t->inputs[k]);
    ok = p->input[k] >= 0;
  }
  return ok;
}

/* At a sum of the formula's own, alone; but what is rounded once depends on all that is. */
static void aim_at_sum(struct digits_place *p, slong node) {
  const struct digits_formula *f = p->w->f;
  struct diag d = {0};
  bool whole = f->tape.only_under_rounded != NULL;
  tape_clear(&p->zero);
  bool ok = whole || elaboration_tape(&p->zero, &p->s->el, &f->node[node], 1, &d);
  if (!ok || !aim(p, whole ? &f->tape : &p->zero, whole ? node : 0)) abort();
}

static bool ready_sums(struct digits_place *p) {
  const struct tape *t = &p->w->f->tape;
  p->sum = ss_malloc((size_t)t->n * sizeof *p->sum);
  for (slong i = 0; i < t->n; i++)
    if (t->code[i].op == TAPE_add || t->code[i].op == TAPE_sub) p->sum[p->n_sums++] = i;
  return p->n_sums > 0;
}

static bool ready(struct digits_place *p) {
  const struct digits_formula *f = p->w->f;
  const char *name = region_table[p->region].name;
  switch (region_table[p->region].move) {
  case MOVE_NONE:
  case MOVE_ANYWHERE:
    return true;
  case MOVE_POWER:
  case MOVE_UP_TO_1:
    return name ? tape_input(&f->tape, name) >= 0 : has_class(f, region_table[p->region].class);
  case MOVE_RESONANCE:
    return has_class(f, INPUT_CHI) && has_class(f, INPUT_ETA);
  case MOVE_TOGETHER:
    return has_class(f, INPUT_V) || has_class(f, INPUT_FORCE) || has_class(f, INPUT_STATE);
  case MOVE_TO_ZERO:
    return digits_tape_of(&p->zero, p->s, region_table[p->region].name, region_table[p->region].section) &&
           aim(p, &p->zero, 0);
  case MOVE_CANCEL:
    return ready_sums(p);
  }
  abort();
}

struct digits_place *digits_place_new(int region, struct digits_bench *w, struct digits_set *s) {
  struct digits_place *p = ss_malloc(sizeof *p);
  *p = (struct digits_place){.region = region, .w = w, .s = s};
  if (ready(p)) return p;
  digits_place_free(p);
  return NULL;
}

void digits_place_free(struct digits_place *p) {
  if (!p) return;
  tape_clear(&p->zero);
  free(p->sum);
  free(p);
}

/* How many of the region's own coordinates are read. */
static const int own_coordinates[] = {[MOVE_TOGETHER] = 1, [MOVE_UP_TO_1] = 1, [MOVE_RESONANCE] = 4,
                                      [MOVE_TO_ZERO] = 4,  [MOVE_CANCEL] = 5,  [MOVE_ANYWHERE] = 0};

int digits_coordinates(int which[DIGITS_COORDINATES], const struct digits_place *p) {
  const struct digits_formula *f = p->w->f;
  enum region_move move = region_table[p->region].move;
  int n = 0;
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    which[n++] = (int)(2 * k);
    if (f->input[k] == INPUT_STATE || move == MOVE_ANYWHERE) which[n++] = (int)(2 * k + 1);
  }
  for (int i = 0; i < own_coordinates[move]; i++) which[n++] = (int)(2 * f->tape.n_inputs) + i;
  return n;
}

/* --- Points --- */

/* 10^e with e from a to b, half of the coordinate's range for the first sixteen decades. */
static double decades(double u, double a, double b) {
  double near = fabs(b - a) > 16 ? a + copysign(16, b - a) : b;
  double e = u < 0.5 ? a + 2 * u * (near - a) : near + (2 * u - 1) * (b - near);
  return pow(10, e);
}

static double signed_by(double u, double size) {
  return u < 0.5 ? size : -size;
}

static void usual(double *x, const struct digits_formula *f, const double *u) {
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    double size = pow(10, 2 * u[2 * k] - 1);
    x[k] = f->input[k] == INPUT_CHI     ? 0.02 + 0.96 * u[2 * k]
           : f->input[k] == INPUT_SIGN  ? signed_by(u[2 * k], 1)
           : f->input[k] == INPUT_STATE ? signed_by(u[2 * k + 1], size)
                                        : size;
  }
}

static void widest(double *x, const struct digits_formula *f, const double *u) {
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    double a = u[2 * k], b = u[2 * k + 1];
    switch (f->input[k]) {
    case INPUT_CHI:
      x[k] = b < 0.5 ? decades(a, -0.3, -300) : 1 - exp2(-1 - 52 * a);
      break;
    case INPUT_SIGN:
      x[k] = signed_by(a, 1);
      break;
    case INPUT_TIME:
      x[k] = b < 0.5 ? decades(a, 0, -300) : decades(a, 0, 16);
      break;
    default:
      x[k] = fmod(2 * b, 1) < 0.5 ? decades(a, 0, -300) : decades(a, 0, 300);
      if (f->input[k] == INPUT_STATE) x[k] = signed_by(b, x[k]);
    }
  }
}

/* --- Zeros --- */

/* The expression in double at the point, or NaN. */
static double value_at(const struct digits_place *p, const double *x) {
  OWNED(calc) c = calc_begin(num_ctx_double());
  struct num_vec in = calc_vec(&c, p->t->n_inputs), out = calc_vec(&c, p->t->n_outputs);
  for (slong k = 0; k < in.len; k++) *(double *)num_vec_at(&in, k) = x[p->input[k]];
  tape_eval(&out, NULL, p->t, &in);
  return *(const double *)num_vec_at(&out, p->node);
}

static bool allowed(const struct digits_formula *f, slong k, double x) {
  if (f->input[k] == INPUT_CHI) return x > 0 && x < 1;
  return isfinite(x) && x != 0;
}

/* Between a and b the expression changes its sign: to neighbouring doubles. */
static double bisect(const struct digits_place *p, double *x, slong k, double a, double b) {
  x[k] = a;
  bool negative = value_at(p, x) < 0;
  for (int i = 0; i < 60; i++) {
    double m = a + (b - a) / 2;
    if (m == a || m == b) break;
    x[k] = m;
    double v = value_at(p, x);
    if ((v < 0) == negative)
      a = m;
    else
      b = m;
  }
  return b;
}

enum { SCAN = 24, ZEROS_MOST = 2 * SCAN };

/* The zeros along input k, within a factor of 8 up and down; which: a coordinate that chooses one. */
static bool zero_along(double *x, const struct digits_place *p, slong k, double which) {
  const struct digits_formula *f = p->w->f;
  double start = x[k], low[ZEROS_MOST], high[ZEROS_MOST], last = NAN, last_x = NAN;
  int n = 0;
  for (int j = -SCAN; j <= SCAN; j++) {
    x[k] = f->input[k] == INPUT_CHI ? (j + SCAN + 0.5) / (2 * SCAN + 1) : start * exp2(3.0 * j / SCAN);
    double v = value_at(p, x);
    if (isfinite(v) && isfinite(last) && (v < 0) != (last < 0) && n < ZEROS_MOST) {
      low[n] = last_x;
      high[n++] = x[k];
    }
    last = v;
    last_x = x[k];
  }
  x[k] = start;
  if (n == 0) return false;
  int i = (int)(which * n);
  x[k] = bisect(p, x, k, low[i], high[i]);
  return true;
}

/* Looks along the inputs that were asked for, n of them; u: which (the first that has a zero from there on), which
   zero, how far beside it. */
static bool beside_zero(double *x, const struct digits_place *p, slong n, const double *u) {
  const struct digits_formula *f = p->w->f;
  slong first = (slong)(u[0] * (double)n);
  for (slong j = 0; j < n; j++) {
    slong k = (first + j) % n;
    if (region_table[p->region].move == MOVE_TO_ZERO) k = p->input[k];
    if (f->input[k] == INPUT_SIGN || tape_input(p->t, f->tape.inputs[k]) < 0 || !zero_along(x, p, k, u[1])) continue;
    double beside = x[k] * (1 + signed_by(u[3], exp2(-1 - 52 * u[2])));
    if (allowed(f, k, beside)) x[k] = beside;
    return true;
  }
  return false;
}

static bool point_of(double *x, struct digits_place *p, const double *u) {
  const struct digits_formula *f = p->w->f;
  const double *own = u + 2 * f->tape.n_inputs; /* the region's coordinates */
  double from = region_table[p->region].from, to = region_table[p->region].to;
  const char *name = region_table[p->region].name;
  usual(x, f, u);
  switch (region_table[p->region].move) {
  case MOVE_NONE:
    return true;
  case MOVE_ANYWHERE:
    widest(x, f, u);
    return true;
  case MOVE_POWER:
    for (slong k = 0; k < f->tape.n_inputs; k++)
      if (name ? strcmp(f->tape.inputs[k], name) == 0 : f->input[k] == region_table[p->region].class)
        x[k] = copysign(decades(u[2 * k], from, to), x[k]);
    return true;
  case MOVE_TOGETHER:
    for (slong k = 0; k < f->tape.n_inputs; k++)
      if (f->input[k] == INPUT_V || f->input[k] == INPUT_FORCE || f->input[k] == INPUT_STATE)
        x[k] *= decades(own[0], from, to);
    return true;
  case MOVE_UP_TO_1:
    for (slong k = 0; k < f->tape.n_inputs; k++)
      if (f->input[k] == INPUT_CHI) x[k] = 1 - exp2(-1 - 52 * own[0]);
    return true;
  case MOVE_RESONANCE: {
    double chi = decades(own[0], from, to), beside = 1 + signed_by(own[2], exp2(-1 - 52 * own[1]));
    for (slong k = 0; k < f->tape.n_inputs; k++) {
      if (f->input[k] == INPUT_CHI) x[k] = chi;
      if (f->input[k] == INPUT_ETA) x[k] = beside / chi;
      if (f->input[k] == INPUT_TIME && own[3] < 0.5) x[k] = decades(u[2 * k], 0, 16); /* where phases part again */
    }
    return true;
  }
  case MOVE_TO_ZERO:
    return beside_zero(x, p, p->t->n_inputs, own);
  case MOVE_CANCEL:
    aim_at_sum(p, p->sum[(slong)(own[4] * (double)p->n_sums)]);
    return beside_zero(x, p, f->tape.n_inputs, own);
  }
  abort();
}

bool digits_point(double *x, struct digits_place *p, const double *u) {
  return point_of(x, p, u) && digits_kernel_place(x, p->w->f);
}
