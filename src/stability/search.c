/* The worst point of a formula in a region: random coordinates, then a climb from the worst of them.  A step of the
   climb moves one or two coordinates, anywhere or by any power of two down to their last bits; what the formula loses
   decides. The form of the other layer has a climb of its own, in the same coordinates.  So has each way of returning
   no value, by how near the nodes are to it; the worst failure is the one at the least extreme inputs, since there it
   does most harm. */
#include <math.h>
#include <string.h>

#include "base/random.h"
#include "stability_impl.h"

struct search {
  struct digits_bench bench, other, rounded; /* other: the same formula in another layer; that rounded as a whole */
  bool have_other;
  struct digits_place *place;
  struct digits_found *out;
  double u[DIGITS_COORDINATES], other_u[DIGITS_COORDINATES]; /* of the worst points */
  double strain[N_NEARNESSES], strain_u[N_NEARNESSES][DIGITS_COORDINATES];
  double extreme, failure_u[DIGITS_COORDINATES]; /* of the worst failure */
  int n, which[DIGITS_COORDINATES], n_which;     /* coordinates, and those that a step moves */
  uint64_t random;
};

/* Keeps the failure when it is at less extreme inputs than the worst. */
static void keep_failure(struct search *s, const double *x, const double *u) {
  struct digits_found *out = s->out;
  double extreme = digits_extreme(s->bench.f, x);
  if (out->failed && extreme >= s->extreme) return;
  out->failed = true;
  s->extreme = extreme;
  memcpy(out->failure_x, x, sizeof out->failure_x);
  memcpy(s->failure_u, u, sizeof s->failure_u);
}

static void count(struct search *s, const struct digits_loss *r, const double *x, const double *u) {
  struct digits_found *out = s->out;
  out->points += r->kind == DIGITS_LOST || r->kind == DIGITS_FAILED || r->kind == DIGITS_LESS;
  out->outside += r->kind == DIGITS_OUTSIDE;
  out->undecided += r->kind == DIGITS_UNDECIDED;
  out->zero += r->kind == DIGITS_ZERO;
  out->failures += r->kind == DIGITS_FAILED;
  if (r->kind == DIGITS_FAILED) keep_failure(s, x, u);
}

/* Keeps the coordinates when the point measured last is nearer to a failure than any before. */
static void keep_strain(struct search *s, const struct digits_loss *r, const double *u) {
  double strain[N_NEARNESSES];
  if (r->kind != DIGITS_LOST && r->kind != DIGITS_LESS && r->kind != DIGITS_FAILED) return;
  digits_nearness(strain, &s->bench);
  for (int k = 0; k < N_NEARNESSES; k++) {
    if (!(strain[k] > s->strain[k])) continue;
    s->strain[k] = strain[k];
    memcpy(s->strain_u[k], u, sizeof s->strain_u[k]);
  }
}

static void judge_rule(struct digits_found *out, const struct digits_loss *r, const struct digits_bench *w) {
  if (w->f->kernel || (r->kind != DIGITS_LOST && r->kind != DIGITS_FAILED)) return;
  double predicted = r->predicted * log10(2), observed = r->kind == DIGITS_FAILED ? (double)NAN : r->observed;
  out->confusion[loss_bin(predicted)][loss_bin(observed)]++;
}

static bool is_worse(const struct digits_loss *r, const struct digits_loss *than) {
  return r->excess > than->excess || (r->excess == than->excess && r->observed > than->observed);
}

/* The other layer's form at the same point. */
static struct digits_loss measure_other(const struct search *s, struct digits_bench *other, const double *x,
                                        double floor) {
  double y[DIGITS_INPUTS] = {0};
  digits_inputs(y, other->f, s->bench.f, x);
  return digits_measure(other, y, floor);
}

static bool falls_short(const struct digits_loss *r) {
  return r->kind == DIGITS_FAILED || (r->kind == DIGITS_LOST && stability_is_loss(r->formula));
}

/* Measures the other layer there, and keeps the point when it is that one's worst. */
static void try_other(struct search *s, const double *x, const double *u) {
  struct digits_found *out = s->out;
  struct digits_loss r = measure_other(s, &s->other, x, out->after_found ? out->after_worst.excess : -1);
  out->after_failures += r.kind == DIGITS_FAILED;
  if (falls_short(&r)) {
    struct digits_loss once = measure_other(s, &s->rounded, x, -1);
    out->after_short++;
    out->after_rounded += once.kind != DIGITS_LOST || falls_short(&once);
  }
  if (r.kind != DIGITS_LOST || (out->after_found && !is_worse(&r, &out->after_worst))) return;
  out->after_found = true;
  out->after_worst = r;
  memcpy(out->after_x, x, sizeof out->after_x);
  memcpy(s->other_u, u, sizeof s->other_u);
}

/* What a point is tried for: all that can be known of it, what the formula loses there, or whether it has a value. */
enum purpose { FOR_ALL, FOR_LOSS, FOR_FAILURE };

/* Below it a loss is not worth computing. */
static double least_loss(const struct search *s, enum purpose why) {
  if (why == FOR_ALL || (why == FOR_LOSS && !s->out->found)) return -1;
  return why == FOR_LOSS ? s->out->loss.excess : 1;
}

/* Measures the point of these coordinates, and keeps it when it is worse than the worst. */
static void try_point(struct search *s, const double *u, enum purpose why) {
  struct digits_found *out = s->out;
  double x[DIGITS_INPUTS] = {0};
  if (!digits_point(x, s->place, u)) {
    out->outside++;
    return;
  }
  struct digits_loss r = digits_measure(&s->bench, x, least_loss(s, why));
  count(s, &r, x, u);
  if (why != FOR_LOSS) keep_strain(s, &r, u);
  if (why == FOR_ALL) judge_rule(out, &r, &s->bench);
  if (why == FOR_ALL && s->have_other) try_other(s, x, u);
  if (r.kind != DIGITS_LOST || (out->found && !is_worse(&r, &out->loss))) return;
  out->found = true;
  out->loss = r;
  memcpy(out->x, x, sizeof x);
  memcpy(s->u, u, sizeof s->u);
}

static void draw(struct search *s, int samples) {
  double u[DIGITS_COORDINATES] = {0};
  for (int i = 0; i < samples; i++) {
    for (int k = 0; k < s->n; k++) u[k] = random_unit(&s->random);
    try_point(s, u, FOR_ALL);
    if (s->out->zero > 1 && s->out->points == 0) return; /* a formula of zero */
  }
}

static double moved(double u, uint64_t *state) {
  double way = random_unit(state), scale = exp2(-50 * random_unit(state));
  if (way < 0.1) return way < 0.05 ? 0 : 1 - 0x1p-53; /* the ends of a region are in it */
  if (way < 0.3) return random_unit(state);
  double v = u + (way < 0.65 ? scale : -scale);
  return v < 0 ? 0 : v >= 1 ? 1 - 0x1p-53 : v;
}

/* Coordinates beside these. */
static void step(double *u, struct search *s, const double *from) {
  memcpy(u, from, sizeof s->u);
  int coordinates = random_unit(&s->random) < 0.7 ? 1 : 2;
  while (coordinates-- > 0) {
    int k = s->which[(int)(random_unit(&s->random) * s->n_which)];
    u[k] = moved(u[k], &s->random);
  }
}

static void climb(struct search *s, int steps) {
  for (int i = 0; i < steps; i++) {
    double u[DIGITS_COORDINATES];
    step(u, s, s->u);
    try_point(s, u, FOR_LOSS);
  }
}

/* Towards a failure of each kind, then from the worst failure to less extreme inputs. */
static void climb_to_failures(struct search *s, int steps) {
  double u[DIGITS_COORDINATES];
  for (int k = 0; k < N_NEARNESSES; k++)
    for (int i = 0; i < steps && isfinite(s->strain[k]); i++) {
      step(u, s, s->strain_u[k]);
      try_point(s, u, FOR_FAILURE);
    }
  for (int i = 0; i < steps && s->out->failed && !s->bench.f->kernel; i++) {
    step(u, s, s->failure_u);
    try_point(s, u, FOR_FAILURE);
  }
}

static void climb_other(struct search *s, int steps) {
  for (int i = 0; i < steps; i++) {
    double u[DIGITS_COORDINATES], x[DIGITS_INPUTS] = {0};
    step(u, s, s->other_u);
    if (digits_point(x, s->place, u)) try_other(s, x, u);
  }
}

/* --- Numbers that are easier to read --- */

/* x to so many bits. */
static double shortened(double x, int bits) {
  int e;
  double m = frexp(x, &e);
  return ldexp(rint(ldexp(m, bits)), e - bits);
}

/* Replaces each input by one of few bits where the point stays what it is. */
static void simplify(struct search *s, double *x, bool (*same)(struct search *, const double *)) {
  static const int bits[] = {1, 4, 12, 24};
  for (slong k = 0; k < s->bench.f->tape.n_inputs; k++)
    for (size_t i = 0; i < sizeof bits / sizeof *bits; i++) {
      double was = x[k];
      x[k] = shortened(was, bits[i]);
      bool inside = s->bench.f->input[k] != INPUT_CHI || (x[k] > 0 && x[k] < 1);
      if (inside && isfinite(x[k]) && same(s, x)) break;
      x[k] = was;
    }
}

/* No less than a twentieth of a digit is given up. */
static bool is_as_bad(struct search *s, const double *x) {
  struct digits_loss r = digits_measure(&s->bench, x, s->out->loss.excess - 0.05);
  return r.kind == DIGITS_LOST && r.excess >= s->out->loss.excess - 0.05;
}

static bool fails_likewise(struct search *s, const double *x) {
  if (digits_measure(&s->bench, x, -1).kind != DIGITS_FAILED) return false;
  struct digits_cause c = digits_explain_failure(&s->bench);
  return c.cause == s->out->failure.cause && c.node == s->out->failure.node;
}

static void explain_failure(struct search *s) {
  struct digits_found *out = s->out;
  digits_measure(&s->bench, out->failure_x, -1);
  out->failure = digits_explain_failure(&s->bench);
  simplify(s, out->failure_x, fails_likewise);
  digits_measure(&s->bench, out->failure_x, -1);
  slong node = out->failure.node;
  out->failure_size = node < 0 ? (double)NAN : digits_log2(num_vec_at(&s->bench.b, node));
}

/* What is found is measured again, with the condition number from the symbolic derivatives, and explained. */
static void settle(struct search *s, struct digits_set *set) {
  struct digits_found *out = s->out;
  struct diag d = {0};
  out->loss = digits_measure(&s->bench, out->x, -1);
  out->why = digits_explain(&s->bench);
  if (!s->bench.f->kernel && digits_slopes(s->bench.f, set, &d)) {
    double c = digits_condition(&s->bench, 0, s->bench.f->tape.n_inputs);
    out->slopes = !isnan(c);
    out->slopes_differ = fabs(fmax(c, 0) - fmax(out->loss.condition, 0)) > 0.01;
  }
  out->after = (struct digits_loss){.kind = DIGITS_OUTSIDE};
  if (!s->have_other) return;
  out->after = measure_other(s, &s->other, out->x, -1);
  try_other(s, out->x, s->u);
}

void digits_search(struct digits_found *out, struct digits_formula *f, struct digits_set *s,
                   struct digits_formula *after, struct digits_formula *rounded, int region,
                   struct digits_effort effort) {
  struct search q = {.out = out};
  OWNED(text) seed = {0};
  memset(out, 0, sizeof *out);
  for (int k = 0; k < N_NEARNESSES; k++) q.strain[k] = -INFINITY;
  digits_bench_init(&q.bench, f);
  q.have_other = after != NULL;
  if (after) digits_bench_init(&q.other, after);
  if (after) digits_bench_init(&q.rounded, rounded);
  q.place = digits_place_new(region, &q.bench, s);
  if (q.place) {
    text_printf(&seed, "%s in %s", f->id, digits_region[region].id);
    q.random = random_seed(text_str(&seed));
    q.n = (int)(2 * f->tape.n_inputs) + DIGITS_SPARE;
    q.n_which = digits_coordinates(q.which, q.place);
    draw(&q, effort.samples * digits_region_width(region));
    if (out->found) climb(&q, effort.steps);
    climb_to_failures(&q, effort.steps / 2);
    if (out->found && stability_is_loss(out->loss.formula)) simplify(&q, out->x, is_as_bad);
    if (out->failed) explain_failure(&q);
    if (out->after_found) climb_other(&q, effort.steps);
    if (out->found) settle(&q, s);
  }
  digits_place_free(q.place);
  if (after) digits_bench_clear(&q.rounded);
  if (after) digits_bench_clear(&q.other);
  digits_bench_clear(&q.bench);
}
