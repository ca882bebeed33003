/* Maps: the digits that the worst formulas lose over the two inputs that matter most to each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/crew.h"
#include "stability_impl.h"

enum { SCALE = 16, LOOKS = 17 };

struct map_plan {
  size_t formula;
  slong x, y; /* inputs */
  double at[DIGITS_INPUTS];
};
struct map_work {
  struct digits_study *st;
  struct map_plan plan[MAPS];
};
struct map_line {
  float lost[STABILITY_MAP], after[STABILITY_MAP];
};

/* Input k at s, from -SCALE to SCALE: 10^s with its sign; chi/(1 - chi) = 10^s. */
static double map_value(const struct digits_formula *f, slong k, double s, double was) {
  if (f->input[k] == INPUT_CHI) return fmin(1 / (1 + pow(10, -s)), 1 - 0x1p-53);
  return copysign(pow(10, s), was);
}

static double map_scale(int i, int n) {
  return SCALE * (2.0 * i / (n - 1) - 1);
}

static double lost_at(struct digits_bench *w, const double *x) {
  struct digits_loss r = digits_measure(w, x, -1);
  return r.kind == DIGITS_LOST ? r.formula : r.kind == DIGITS_FAILED ? (double)INFINITY : (double)NAN;
}

/* By how much the loss changes along an input. */
static double swing(struct digits_bench *w, const double *at, slong k) {
  double x[DIGITS_INPUTS], low = INFINITY, high = -INFINITY;
  if (w->f->input[k] == INPUT_SIGN) return -1;
  for (int i = 0; i < LOOKS; i++) {
    memcpy(x, at, sizeof x);
    x[k] = map_value(w->f, k, map_scale(i, LOOKS), at[k]);
    double lost = lost_at(w, x);
    if (!isfinite(lost)) continue;
    low = fmin(low, lost);
    high = fmax(high, lost);
  }
  return high >= low ? high - low : -1;
}

static void choose_inputs(struct map_plan *p, struct digits_formula *f) {
  OWNED(digits_bench) w;
  double best = -2, second = -2;
  digits_bench_init(&w, f);
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    double s = swing(&w, p->at, k);
    if (s > best) {
      p->y = p->x;
      second = best;
      p->x = k;
      best = s;
    } else if (s > second) {
      p->y = k;
      second = s;
    }
  }
}

/* The worst formulas, one of each record, that have two inputs and a loss of their own. */
static int plan_maps(struct map_work *mw, const struct digits_found *found) {
  struct digits_study *st = mw->st;
  const struct stability_result *r = st->out;
  int n = 0;
  while (n < MAPS) {
    long best = -1;
    for (int i = 0; i < r->n_formulas; i++) {
      long at = r->formula[i].worst;
      bool taken = at < 0 || !r->row[at].at_fault || st->formula[i]->tape.n_inputs < 2 || st->formula[i]->n > 1;
      for (int k = 0; k < n; k++)
        taken = taken || strcmp(st->formula[mw->plan[k].formula]->record, st->formula[i]->record) == 0;
      if (!taken && (best < 0 || r->row[at].formula_lost > r->row[best].formula_lost)) best = at;
    }
    if (best < 0) break;
    struct map_plan *p = &mw->plan[n++];
    *p = (struct map_plan){.formula = (size_t)r->row[best].formula, .x = 0, .y = 1};
    memcpy(p->at, found[best].x, sizeof p->at);
    choose_inputs(p, st->formula[p->formula]);
  }
  return n;
}

static void map_item(void *result, size_t i, void *arg) {
  struct map_work *mw = arg;
  struct map_plan *p = &mw->plan[i / STABILITY_MAP];
  struct map_line *line = result;
  struct digits_formula *f = mw->st->formula[p->formula], *g = mw->st->after[p->formula];
  struct digits_bench w, v;
  double x[DIGITS_INPUTS], y[DIGITS_INPUTS] = {0};
  digits_bench_init(&w, f);
  if (g) digits_bench_init(&v, g);
  memcpy(x, p->at, sizeof x);
  x[p->y] = map_value(f, p->y, map_scale((int)(i % STABILITY_MAP), STABILITY_MAP), p->at[p->y]);
  for (int k = 0; k < STABILITY_MAP; k++) {
    x[p->x] = map_value(f, p->x, map_scale(k, STABILITY_MAP), p->at[p->x]);
    line->lost[k] = (float)lost_at(&w, x);
    if (g) digits_inputs(y, g, f, x);
    line->after[k] = g ? (float)lost_at(&v, y) : NAN;
  }
  digits_bench_clear(&w);
  if (g) digits_bench_clear(&v);
}

static const char *input_name(struct digits_study *st, const struct digits_formula *f, slong k) {
  return arena_strdup(&st->out->arena, f->tape.inputs[k]);
}

static void describe_map(struct stability_map *z, struct digits_study *st, const struct map_plan *p,
                         const struct map_line *line) {
  const struct digits_formula *f = st->formula[p->formula];
  struct text t = {0};
  for (slong k = 0; k < f->tape.n_inputs; k++)
    if (k != p->x && k != p->y) text_printf(&t, "%s%s=%a", t.len ? "," : "", f->tape.inputs[k], p->at[k]);
  z->formula = (int)p->formula;
  z->x = input_name(st, f, p->x);
  z->y = input_name(st, f, p->y);
  z->at = text_take(&st->out->arena, &t);
  for (int i = 0; i < STABILITY_MAP; i++) {
    z->x_at[i] = z->y_at[i] = map_scale(i, STABILITY_MAP);
    for (int k = 0; k < STABILITY_MAP; k++) {
      z->lost[i][k] = (double)line[i].lost[k];
      z->after[i][k] = (double)line[i].after[k];
    }
  }
}

bool digits_draw_maps(struct digits_study *st, const struct digits_found *found, const struct stability_options *opt,
                      struct crew_tally *tally, struct diag *d) {
  struct map_work mw = {.st = st};
  struct stability_result *r = st->out;
  int n = plan_maps(&mw, found);
  if (n == 0) return true;
  FREED struct map_line *line = ss_malloc((size_t)(n * STABILITY_MAP) * sizeof *line);
  bool ok = crew_results(line, sizeof *line, (size_t)(n * STABILITY_MAP), opt->jobs, map_item, &mw, tally, d);
  r->map = arena_alloc(&r->arena, (size_t)n * sizeof *r->map);
  for (int i = 0; ok && i < n; i++) describe_map(&r->map[i], st, &mw.plan[i], line + i * STABILITY_MAP);
  r->n_maps = ok ? n : 0;
  return ok;
}
