/* The measuring: inputs, truth, errors, times.

   Inputs are points of a low-discrepancy sequence, so that they are the same in every run and spread over the domain;
   those at which the map does not exist, or is badly conditioned, are passed over.  Before a call the outputs are set
   to NaN, so that a method which returns nothing cannot live on what was there; a method that reports no step, or that
   is not right in one digit, has failed whatever its time.  Times are of all inputs in turn, since one input again and
   again teaches the branch predictor the answer. */
#include "bench/bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/arena.h"

const char *const bench_kind_name[] = {"", "bits", "tolerance", "step", "digits"};

static const double BATCH = 1e-3; /* seconds */
enum { SPARE_BITS = 192, MOVE_BITS = 80, MOST_TRIES = 4000, MOST_BATCHES = 25, TRUE_DIGITS = 60 };

double bench_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* --- Inputs with their truth. --- */

struct sample {
  double x[BENCH_IN], hint[BENCH_HINT];
  struct num_vec in, out, given; /* balls */
  arb_ptr scale;                 /* of each output, exact */
  double floor;
};

static void sample_init(struct sample *s, const struct bench_job *job, slong prec) {
  struct num_ctx ctx = num_ctx_arb(prec);
  num_vec_init(&s->in, job->n_in, ctx);
  num_vec_init(&s->out, job->n_out, ctx);
  num_vec_init(&s->given, job->n_given, ctx);
  s->scale = _arb_vec_init(job->n_out);
}

static void sample_clear(struct sample *s, const struct bench_job *job) {
  num_vec_clear(&s->in);
  num_vec_clear(&s->out);
  num_vec_clear(&s->given);
  _arb_vec_clear(s->scale, job->n_out);
}

/* Each output's scale: the largest midpoint of its group.  false when it is zero. */
static bool set_scales(struct sample *s, const struct bench_job *job) {
  bool good = true;
  for (int i = 0; i < job->n_out; i++) {
    for (int k = 0; k < job->n_out; k++) {
      arf_srcptr mid = arb_midref((arb_srcptr)num_vec_at(&s->out, k));
      if (job->group[k] == job->group[i] && arf_cmpabs(mid, arb_midref(s->scale + i)) > 0)
        arf_abs(arb_midref(s->scale + i), mid);
    }
    good = good && !arb_is_zero(s->scale + i) && arb_is_finite(s->scale + i);
  }
  return good;
}

static double log10_of(const mag_t x) {
  if (mag_is_zero(x)) return -INFINITY;
  return log10((double)MAG_MAN(x)) + log10(2) * (double)(fmpz_get_si(MAG_EXPREF(x)) - MAG_BITS);
}

/* log10 of |got - true| / scale at most, the radius of a ball included: errors of multiprecision are below what a
   double can be. */
static double error_of(arb_srcptr got, const struct sample *s, int i) {
  NUMBERS(arb, diff);
  NUMBERS(mag, most);
  slong prec = s->out.ctx.prec;
  arb_sub(diff, got, num_vec_at(&s->out, i), prec);
  arb_div(diff, diff, s->scale + i, 64);
  arb_get_mag(most, diff);
  return log10_of(most);
}

/* The sum over the inputs of what moving one by 2^-53 of itself does to the outputs, the worst of them. */
static int set_floor(struct sample *s, const struct bench_job *job) {
  OWNED(num_vec) moved, out, given;
  double sum[BENCH_OUT] = {0}, hint[BENCH_HINT];
  int status = SS_OK;
  num_vec_init(&moved, job->n_in, s->in.ctx);
  num_vec_init(&out, job->n_out, s->in.ctx);
  num_vec_init(&given, job->n_given, s->in.ctx);
  for (int k = 0; k < job->n_in && !status; k++) {
    num_vec_set(&moved, &s->in);
    arb_ptr x = num_vec_at(&moved, k);
    NUMBERS(arb, shift);
    arb_mul_2exp_si(shift, x, -MOVE_BITS);
    arb_add(x, x, shift, s->in.ctx.prec);
    status = job->truth(&out, &given, hint, &moved, s->hint);
    for (int i = 0; i < job->n_out && !status; i++)
      sum[i] += ldexp(pow(10, error_of(num_vec_at(&out, i), s, i)), MOVE_BITS - 53);
  }
  s->floor = 0;
  for (int i = 0; i < job->n_out; i++) s->floor = fmax(s->floor, sum[i]);
  return status;
}

/* Point n of the sequence: fractional parts of multiples of square roots of primes. */
static void sequence(double *u, long n) {
  static const double prime[BENCH_IN] = {2, 3, 5, 7, 11, 13, 17, 19};
  for (int i = 0; i < BENCH_IN; i++) {
    double whole, x = (double)(n + 1) * sqrt(prime[i]);
    u[i] = modf(x, &whole);
  }
}

static bool sample_take(struct sample *s, const struct bench_job *job, long n) {
  double u[BENCH_IN];
  sequence(u, n);
  job->place(s->x, u);
  for (int i = 0; i < job->n_in; i++) {
    if (!isfinite(s->x[i])) return false;
    arb_set_d(num_vec_at(&s->in, i), s->x[i]);
  }
  _arb_vec_zero(s->scale, job->n_out);
  if (job->truth(&s->out, &s->given, s->hint, &s->in, NULL) || !set_scales(s, job) || set_floor(s, job)) return false;
  return s->floor < ldexp(job->worst_condition, -53);
}

/* --- One method at one setting. --- */

struct trial {
  const struct bench_job *job;
  const struct bench_method *m;
  const struct sample *sample;
  int n;
  struct bench_case *in; /* the same in the method's arithmetic */
  struct num_ctx ctx;
  struct num_vec out;
  void *self;
  long failed; /* timed calls */
};

/* Of a job, a method and samples; false when the method cannot be set up. */
static bool trial_open(struct trial *t, double setting, const struct bench_env *env) {
  const struct bench_job *job = t->job;
  const struct sample *s = t->sample;
  struct num_ctx ctx = t->ctx = bench_context(t->m, setting);
  t->in = ss_malloc((size_t)t->n * sizeof *t->in);
  num_vec_init(&t->out, job->n_out, ctx);
  for (int i = 0; i < t->n; i++) {
    struct bench_case *c = &t->in[i];
    *c = (struct bench_case){.x = s[i].x, .hint = s[i].hint};
    num_vec_init(&c->in, job->n_in, ctx);
    num_vec_init(&c->given, job->n_given, ctx);
    for (int k = 0; k < job->n_in; k++) ctx.type->set_arb(num_vec_at(&c->in, k), num_vec_at(&s[i].in, k), ctx.prec);
    for (int k = 0; k < job->n_given; k++)
      ctx.type->set_arb(num_vec_at(&c->given, k), num_vec_at(&s[i].given, k), ctx.prec);
  }
  if (t->m->open) t->self = t->m->open(t->m, setting, env);
  return !t->m->open || t->self;
}

static void trial_close(struct trial *t) {
  if (t->m->close && t->self) t->m->close(t->self);
  for (int i = 0; i < t->n; i++) {
    num_vec_clear(&t->in[i].in);
    num_vec_clear(&t->in[i].given);
  }
  free(t->in);
  num_vec_clear(&t->out);
}

static int by_size(const void *x, const void *y) {
  double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

double bench_median(double *x, int n) {
  qsort(x, (size_t)n, sizeof *x, by_size);
  return n == 0 ? NAN : n % 2 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

/* The error of one call, or why it failed. */
static const char *judge(double *error, const struct trial *t, int i, int status, long steps) {
  NUMBERS(arb, got);
  const char *failure = NULL;
  bool untrue = false; /* a ball does not hold the true value */
  *error = -INFINITY;
  for (int k = 0; k < t->job->n_out && !failure; k++) {
    t->ctx.type->get_arb(got, num_vec_at(&t->out, k));
    if (status)
      failure = status & SS_DOMAIN ? "says that there is no value" : "gives up";
    else if (!arb_is_finite(got))
      failure = "returned nothing";
    else if (t->ctx.type->rigorous && !arb_overlaps(got, num_vec_at(&t->sample[i].out, k)))
      untrue = true;
    if (!failure) *error = fmax(*error, error_of(got, &t->sample[i], k));
  }
  if (failure) return failure;
  if (steps <= 0) return "took no step";
  if (untrue) return "a ball without the true value";
  return *error < log10(0.5) ? NULL : "not one digit right";
}

/* Every input once, for the errors; stops when the calls have taken `seconds`. */
static void first_pass(struct bench_row *row, struct trial *t, double seconds) {
  double *error = ss_malloc((size_t)t->n * sizeof *error), spent = 0;
  int n = 0;
  for (int i = 0; i < t->n && (i == 0 || spent < seconds); i++) {
    for (int k = 0; k < t->job->n_out; k++) t->ctx.type->set_d(num_vec_at(&t->out, k), NAN, t->ctx.prec);
    long steps = 0;
    double begin = bench_now(), e;
    int status = t->m->run(t->self, &t->out, &steps, &t->in[i]);
    spent += bench_now() - begin;
    const char *failure = judge(&e, t, i, status, steps);
    row->cases++;
    row->steps += (double)steps;
    if (failure) {
      row->failures++;
      row->failure = failure;
    } else {
      row->worst = fmax(row->worst, e);
      error[n++] = e;
    }
  }
  row->capped = row->cases < t->n;
  row->steps /= row->cases;
  row->median = bench_median(error, n);
  free(error);
}

/* --- Times. ---

   A batch goes through a stretch of the inputs, and through all of them again and again if they take less than a
   millisecond together.  Slow methods have many stretches, each timed on its own and the times added: on a machine that
   is shared, a stretch of a millisecond is now and then left in peace, a whole pass of a slow method never. */

struct stretch {
  int from, to;
  long repeats;
  double second[MOST_BATCHES];
};

/* Adds to t->failed: what was right once has to be so each time. */
static double run_stretch(struct trial *t, const struct stretch *s) {
  const struct bench_method *m = t->m;
  long steps = 0;
  double begin = bench_now();
  for (long r = 0; r < s->repeats; r++)
    for (int i = s->from; i < s->to; i++) t->failed += m->run(t->self, &t->out, &steps, &t->in[i]) != SS_OK;
  return bench_now() - begin;
}

/* The inputs in stretches of a millisecond at least, by the times of a warm pass; returns how long a round takes. */
static double cut(struct stretch *s, int *n, struct trial *t, int cases) {
  double all = 0, piece = 0;
  *n = 0;
  for (int i = 0, from = 0; i < cases; i++) {
    piece += run_stretch(t, &(struct stretch){i, i + 1, 1, {0}});
    if (piece < BATCH && i + 1 < cases) continue;
    s[(*n)++] = (struct stretch){from, i + 1, 1, {0}};
    all += piece;
    piece = 0;
    from = i + 1;
  }
  if (*n > 1 || all >= BATCH) return all;
  do { /* calls one by one are slower than in a row, since the clock is read between them */
    all = run_stretch(t, s);
    if (all < BATCH) s->repeats *= 2;
  } while (all < BATCH);
  return all;
}

static void take_times(struct bench_row *row, struct trial *t, bool quick) {
  FREED struct stretch *s = ss_malloc((size_t)row->cases * sizeof *s);
  int n;
  double round = cut(s, &n, t, row->cases), budget = quick ? 0.012 : 0.4, least = 0, median = 0;
  row->batches = (int)fmin(fmax(budget / round, quick ? 2 : 3), quick ? 5 : MOST_BATCHES);
  for (int b = 0; b < row->batches; b++)
    for (int k = 0; k < n; k++) s[k].second[b] = run_stretch(t, &s[k]);
  for (int k = 0; k < n; k++) {
    double middle = bench_median(s[k].second, row->batches); /* sorts */
    least += s[k].second[0] / (double)s[k].repeats;
    median += middle / (double)s[k].repeats;
  }
  row->least_ns = 1e9 * least / row->cases;
  row->median_ns = 1e9 * median / row->cases;
  row->calls = s->repeats * row->cases * row->batches;
  if (t->failed) {
    row->failure = "fails when it is timed";
    row->worst = row->least_ns = row->median_ns = NAN;
  }
}

static void run_setting(struct bench_table *t, const struct bench_method *m, double setting, const struct sample *s,
                        const struct bench_env *env) {
  struct trial trial = {.job = t->job, .m = m, .sample = s, .n = t->cases};
  struct bench_row row = {.setting = setting, .worst = -INFINITY, .least_ns = NAN, .median_ns = NAN};
  if (!trial_open(&trial, setting, env)) {
    row.failure = "cannot be set up";
    row.worst = row.median = NAN;
  } else {
    first_pass(&row, &trial, t->quick ? 0.1 : 1);
    if (row.failure)
      row.worst = NAN;
    else
      take_times(&row, &trial, t->quick);
  }
  trial_close(&trial);
  bench_add_row(t, m, &row);
}

static const double *settings_of(int *n, const struct bench_method *m, bool quick) {
  bool few = quick && m->quick;
  *n = m->kind == SET_NONE ? 0 : few ? m->n_quick : m->n;
  return few ? m->quick : m->settings;
}

static void run_method(struct bench_table *t, const struct bench_method *m, const struct sample *s,
                       const struct bench_env *env) {
  static const struct bench_row nothing = {
      .failure = "not installed", .setting = NAN, .worst = NAN, .median = NAN, .least_ns = NAN, .median_ns = NAN};
  int n;
  const double *setting = settings_of(&n, m, t->quick);
  if (m->absent) {
    bench_add_row(t, m, &nothing);
    return;
  }
  if (m->kind == SET_NONE) run_setting(t, m, NAN, s, env);
  for (int k = 0; k < n; k++) run_setting(t, m, setting[k], s, env);
}

/* --- The job. --- */

static slong truth_bits(const struct bench_job *job, bool quick) {
  slong most = 64;
  for (int i = 0; i < job->n_methods; i++) {
    const struct bench_method *m = &job->methods[i];
    int n;
    const double *setting = settings_of(&n, m, quick);
    if (m->bits > most) most = m->bits;
    for (int k = 0; m->kind == SET_BITS && k < n; k++)
      if ((slong)setting[k] > most) most = (slong)setting[k];
  }
  return most + SPARE_BITS;
}

static double accuracy(const struct sample *s, const struct bench_job *job) {
  double least = INFINITY;
  for (int i = 0; i < job->n_out; i++) {
    double e = error_of(num_vec_at(&s->out, i), s, i); /* the midpoint goes, twice the radius stays */
    least = fmin(least, isfinite(e) ? -e : log10(2) * (double)s->out.ctx.prec);
  }
  return least;
}

/* --- The samples of a job. --- */

struct samples {
  struct sample *s;
  int n, wanted; /* taken */
};

static void samples_take(struct samples *a, const struct bench_job *job, slong prec, int wanted) {
  *a = (struct samples){ss_malloc((size_t)wanted * sizeof *a->s), 0, wanted};
  for (int i = 0; i < wanted; i++) sample_init(&a->s[i], job, prec);
  for (long n = 0; n < MOST_TRIES && a->n < wanted; n++) a->n += sample_take(&a->s[a->n], job, n);
}

static void samples_clear(struct samples *a, const struct bench_job *job) {
  for (int i = 0; i < a->wanted; i++) sample_clear(&a->s[i], job);
  free(a->s);
}

bool bench_run(struct bench_table *t, const struct bench_job *job, const struct bench_env *env, bool quick) {
  struct samples a;
  samples_take(&a, job, truth_bits(job, quick), quick ? job->n_quick : job->n_cases);
  *t = (struct bench_table){.job = job, .quick = quick, .truth_digits = INFINITY, .cases = a.n};
  for (int i = 0; i < a.n; i++) {
    t->floor = fmax(t->floor, a.s[i].floor);
    t->truth_digits = fmin(t->truth_digits, accuracy(&a.s[i], job));
  }
  bool good = a.n == a.wanted && t->truth_digits >= TRUE_DIGITS;
  for (int i = 0; i < job->n_methods && good; i++) run_method(t, &job->methods[i], a.s, env);
  samples_clear(&a, job);
  return good;
}

bool bench_inputs(struct text *out, const struct bench_job *job, bool quick) {
  struct samples a;
  samples_take(&a, job, 64 + SPARE_BITS, quick ? job->n_quick : job->n_cases);
  bool good = a.n == a.wanted;
  for (int i = 0; i < job->n_in + job->n_out; i++)
    text_printf(out, "%s%d%s", i < job->n_in ? "in" : "out", i < job->n_in ? i + 1 : i - job->n_in + 1,
                i + 1 < job->n_in + job->n_out ? "\t" : "\n");
  for (int k = 0; k < a.n; k++) {
    for (int i = 0; i < job->n_in; i++) text_printf(out, "%.17g\t", a.s[k].x[i]);
    for (int i = 0; i < job->n_out; i++) {
      good = !num_print(out, num_vec_at(&a.s[k].out, i), TRUE_DIGITS) && good;
      text_add(out, i + 1 < job->n_out ? "\t" : "\n");
    }
  }
  samples_clear(&a, job);
  return good;
}

bool bench_keep_busy(const struct bench_job *job, const struct bench_method *m, double setting,
                     const struct bench_env *env, double seconds, bool (*begin)(void), void (*end)(void)) {
  struct samples a;
  long steps = 0;
  samples_take(&a, job, bench_context(m, setting).prec + SPARE_BITS, job->n_quick);
  struct trial t = {.job = job, .m = m, .sample = a.s, .n = a.n};
  bool ready = trial_open(&t, setting, env) && a.n > 0 && begin();
  double until = bench_now() + seconds;
  do
    for (int i = 0; i < a.n && ready; i++) m->run(t.self, &t.out, &steps, &t.in[i]);
  while (ready && bench_now() < until);
  if (ready) end();
  trial_close(&t);
  samples_clear(&a, job);
  return ready;
}

static double repeat(void (*f)(void *), void *arg, long n) {
  double begin = bench_now();
  for (long i = 0; i < n; i++) f(arg);
  return bench_now() - begin;
}

double bench_time(void (*f)(void *), void *arg) {
  enum { BATCHES = 7 };
  long n = 1;
  while (repeat(f, arg, n) < BATCH) n *= 2;
  double least = INFINITY;
  for (int b = 0; b < BATCHES; b++) least = fmin(least, repeat(f, arg, n));
  return 1e9 * least / (double)n;
}
