/* The study as a whole: the formulas of a layer, each in each region that says something of its inputs, by processes; then
   what they found in words, and maps of the worst. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stability_impl.h"
#include "workers.h"

const char *const loss_cause_says[N_LOSS_CAUSES] = {
#define CAUSE_SAYS(name, says) says,
    LOSS_CAUSES(CAUSE_SAYS)
#undef CAUSE_SAYS
};

bool loss_cause_fails(enum loss_cause c) {
  return c == CAUSE_OVERFLOW || c == CAUSE_UNDERFLOW || c == CAUSE_ZERO_DIVISOR;
}

const char *const loss_bin_name[N_LOSS_BINS] = {"below 1", "1 to 2",     "2 to 4", "4 to 8",
                                                "8 to 12", "12 or more", "failure"};

int loss_bin(double digits) {
  static const double above[] = {1, 2, 4, 8, 12};
  int n = sizeof above / sizeof *above, i = 0;
  if (isnan(digits)) return N_LOSS_BINS - 1;
  while (i < n && digits >= above[i]) i++;
  return i;
}

void stability_result_init(struct stability_result *r) {
  *r = (struct stability_result){.quick = false};
  arena_init(&r->arena);
}

void stability_result_clear(struct stability_result *r) {
  arena_clear(&r->arena);
}

const struct stability_row *stability_row_at(const struct stability_result *r, int formula, int region) {
  return &r->row[(long)formula * r->n_regions + region];
}

/* --- The formulas asked for --- */

struct study {
  struct digits_set set, other; /* other: of the layer held against it */
  bool have_other;
  const struct model *model;
  struct stable_proofs proofs; /* of the stable layer, when it is the other one */
  bool have_proofs;
  struct digits_formula **formula, **after; /* after: NULL where the other layer has the same formula or none */
  size_t n;
  struct digits_effort effort;
  struct stability_result *out;
};

static bool selected(const struct digits_formula *f, const struct stability_options *opt) {
  bool yes = opt->n_only == 0;
  for (int i = 0; i < opt->n_only; i++) yes = yes || digits_selected(f, opt->only[i]);
  return yes;
}

static bool check_operands(const struct digits_set *s, const struct stability_options *opt, struct diag *d) {
  for (int i = 0; i < opt->n_only; i++) {
    bool any = false;
    for (size_t k = 0; k < s->n; k++) any = any || digits_selected(&s->formula[k], opt->only[i]);
    if (any) continue;
    diag_set(d, "error: no formula %.200s that computes something", opt->only[i]);
    return false;
  }
  return true;
}

static struct digits_formula *in_other_layer(struct study *st, const struct digits_formula *f) {
  if (!st->have_other || f->kernel) return NULL;
  const struct digits_formula *g = digits_find(&st->other, f->id);
  return g && g->n == f->n && !tape_same(&g->tape, &f->tape) ? &st->other.formula[g - st->other.formula] : NULL;
}

static bool study_open(struct study *st, const struct model *m, const struct stability_options *opt, struct diag *d) {
  *st =
      (struct study){.model = m, .effort = opt->quick ? (struct digits_effort){3, 6} : (struct digits_effort){24, 160}};
  bool ok = digits_set_make(&st->set, m, opt->layer, d) && check_operands(&st->set, opt, d);
  st->have_other = opt->after >= 0;
  if (st->have_other) ok = digits_set_make(&st->other, m, (enum layer)opt->after, ok ? d : NULL) && ok;
  st->have_proofs = ok && opt->after == LAYER_STABLE;
  if (st->have_proofs) ok = stable_prove(&st->proofs, m, d);
  st->formula = ss_malloc((st->set.n + 1) * sizeof *st->formula);
  st->after = ss_malloc((st->set.n + 1) * sizeof *st->after);
  for (size_t i = 0; ok && i < st->set.n; i++) {
    if (!selected(&st->set.formula[i], opt)) continue;
    st->formula[st->n] = &st->set.formula[i];
    st->after[st->n] = in_other_layer(st, st->formula[st->n]);
    st->n++;
  }
  return ok;
}

static void study_close(struct study *st) {
  digits_set_clear(&st->set);
  if (st->have_other) digits_set_clear(&st->other);
  if (st->have_proofs) stable_proofs_clear(&st->proofs);
  free(st->formula);
  free(st->after);
}

/* --- Searching --- */

static void search_item(void *result, size_t i, void *arg) {
  struct study *st = arg;
  size_t f = i / (size_t)n_digits_regions, region = i % (size_t)n_digits_regions;
  digits_search(result, st->formula[f], &st->set, st->after[f], (int)region, st->effort);
}

/* --- In words --- */

static const char *kept(struct stability_result *r, struct text *t) {
  const char *s = arena_strndup(&r->arena, text_str(t), t->len);
  text_reset(t);
  return s;
}

static const char *kept_str(struct stability_result *r, const char *s) {
  return arena_strndup(&r->arena, s, strlen(s));
}

static const char *node_text(struct study *st, const struct digits_formula *f, slong node, bool whole) {
  if (f->kernel) return kept_str(st->out, f->record);
  struct text t;
  text_init(&t);
  digits_print_node(&t, &st->set, f, node, whole);
  const char *s = kept(st->out, &t);
  text_clear(&t);
  return s;
}

static const char *point_text(struct study *st, const struct digits_formula *f, const double *x) {
  struct text t;
  text_init(&t);
  digits_print_point(&t, f, x);
  const char *s = kept(st->out, &t);
  text_clear(&t);
  return s;
}

static void describe_formula(struct stability_formula *z, struct study *st, const struct digits_formula *f) {
  struct text t;
  text_init(&t);
  for (slong k = 0; k < f->tape.n_inputs; k++) text_printf(&t, "%s%s", k ? ", " : "", f->tape.inputs[k]);
  *z = (struct stability_formula){.id = kept_str(st->out, f->id),
                                  .also = kept_str(st->out, f->also),
                                  .record = kept_str(st->out, f->record),
                                  .equation = kept_str(st->out, f->equation),
                                  .section = kept_str(st->out, f->section),
                                  .text = kept_str(st->out, f->text),
                                  .inputs = kept(st->out, &t),
                                  .entries = (int)f->n,
                                  .nodes = (int)f->tape.n,
                                  .kernel = f->kernel != NULL,
                                  .worst = -1,
                                  .worst_failure = -1};
  text_clear(&t);
}

static void describe_replacement(struct stability_formula *z, struct study *st, const struct digits_formula *after) {
  struct text t;
  text_init(&t);
  z->proved = digits_replacement(&t, st->model, &st->proofs, after);
  if (t.len) z->replacement = kept(st->out, &t);
  text_clear(&t);
}

static void describe_cause(struct stability_row *z, struct study *st, const struct digits_formula *f,
                           const struct digits_found *found) {
  z->cause = found->why.cause;
  z->node_grows = found->why.grows * log10(2);
  z->node = node_text(st, f, found->why.node, false);
  if (f->kernel) return;
  const struct tape_instr *in = &f->tape.code[found->why.node];
  if (in->op == TAPE_CONST || in->op == TAPE_INPUT || in->op == TAPE_ROOT) return;
  z->left = node_text(st, f, in->a, true);
  if (in->b >= 0) z->right = node_text(st, f, in->b, true);
}

static void describe_row(struct stability_row *z, struct study *st, int formula, int region,
                         const struct digits_found *found) {
  const struct digits_formula *f = st->formula[formula];
  *z = (struct stability_row){.formula = formula,
                              .region = region,
                              .points = found->points,
                              .outside = found->outside,
                              .undecided = found->undecided + found->zero,
                              .failures = found->failures,
                              .found = found->found,
                              .at_fault = found->at_fault || (found->failed && !f->kernel),
                              .after = NAN,
                              .after_most = found->after_found ? found->after_worst.formula : (double)NAN,
                              .after_witness = found->after_found ? point_text(st, f, found->after_x) : NULL,
                              .after_failures = found->after_failures};
  if (found->found) {
    z->error = found->loss.error * log10(2);
    z->observed = found->loss.observed;
    z->problem = found->loss.problem;
    z->formula_lost = found->loss.formula;
    z->predicted = fmin(STABILITY_DIGITS, fmax(0, found->loss.predicted * log10(2)));
    z->witness = point_text(st, f, found->x);
    if (found->after.kind == DIGITS_LOST) z->after = found->after.formula;
    describe_cause(z, st, f, found);
  }
  if (!found->failed) return;
  z->failure = found->failure.cause;
  z->failure_node = node_text(st, f, found->failure.node, false);
  z->failure_witness = point_text(st, f, found->failure_x);
}

/* The worst of all regions, or the first that comes within half a digit of it. */
static void rate(struct stability_formula *f, const struct stability_row *row, long i,
                 const struct digits_found *found) {
  f->points += row[i].points;
  f->zero = f->zero || found->zero > 0;
  if (row[i].found && (f->worst < 0 || row[i].formula_lost > row[f->worst].formula_lost + 0.5)) f->worst = i;
  if (row[i].failures && f->worst_failure < 0) f->worst_failure = i;
}

static void gather(struct study *st, const struct digits_found *found) {
  struct stability_result *r = st->out;
  r->region = digits_region;
  r->n_regions = n_digits_regions;
  r->n_formulas = (int)st->n;
  r->n_rows = (long)st->n * n_digits_regions;
  r->formula = arena_alloc(&r->arena, (st->n + 1) * sizeof *r->formula);
  r->row = arena_alloc(&r->arena, ((size_t)r->n_rows + 1) * sizeof *r->row);
  for (size_t i = 0; i < st->n; i++) {
    describe_formula(&r->formula[i], st, st->formula[i]);
    if (st->after[i] && st->have_proofs) describe_replacement(&r->formula[i], st, st->after[i]);
    for (int k = 0; k < n_digits_regions; k++) {
      long at = (long)i * n_digits_regions + k;
      describe_row(&r->row[at], st, (int)i, k, &found[at]);
      rate(&r->formula[i], r->row, at, &found[at]);
      r->conditions += found[at].slopes;
      r->condition_differs += found[at].slopes_differ;
      for (int a = 0; a < N_LOSS_BINS; a++)
        for (int b = 0; b < N_LOSS_BINS; b++) r->confusion[a][b] += found[at].confusion[a][b];
    }
    r->formula[i].zero = r->formula[i].zero && r->formula[i].points == 0;
  }
}

/* --- Maps --- */

enum { MAPS = 4, SCALE = 16, LOOKS = 17 };

struct map_plan {
  size_t formula;
  slong x, y; /* inputs */
  double at[DIGITS_INPUTS];
};
struct map_work {
  struct study *st;
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
  struct digits_bench w;
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
  digits_bench_clear(&w);
}

/* The worst formulas, one of each record, that have two inputs and a loss of their own. */
static int plan_maps(struct map_work *mw, const struct digits_found *found) {
  struct study *st = mw->st;
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
    for (slong j = 0; g && j < g->tape.n_inputs; j++) {
      slong from = digits_input(&f->tape, g->tape.inputs[j]);
      if (from >= 0) y[j] = x[from];
    }
    line->after[k] = g ? (float)lost_at(&v, y) : NAN;
  }
  digits_bench_clear(&w);
  if (g) digits_bench_clear(&v);
}

static void describe_map(struct stability_map *z, struct study *st, const struct map_plan *p,
                         const struct map_line *line) {
  const struct digits_formula *f = st->formula[p->formula];
  struct text t;
  text_init(&t);
  for (slong k = 0; k < f->tape.n_inputs; k++)
    if (k != p->x && k != p->y) text_printf(&t, "%s%s=%a", t.len ? "," : "", f->tape.inputs[k], p->at[k]);
  z->formula = (int)p->formula;
  z->x = kept_str(st->out, f->tape.inputs[p->x]);
  z->y = kept_str(st->out, f->tape.inputs[p->y]);
  z->at = kept(st->out, &t);
  text_clear(&t);
  for (int i = 0; i < STABILITY_MAP; i++) {
    z->x_at[i] = z->y_at[i] = map_scale(i, STABILITY_MAP);
    for (int k = 0; k < STABILITY_MAP; k++) {
      z->lost[i][k] = (double)line[i].lost[k];
      z->after[i][k] = (double)line[i].after[k];
    }
  }
}

static bool draw_maps(struct study *st, const struct digits_found *found, const struct stability_options *opt,
                      struct diag *d) {
  struct map_work mw = {.st = st};
  struct stability_result *r = st->out;
  int n = plan_maps(&mw, found);
  if (n == 0) return true;
  struct map_line *line = ss_malloc((size_t)(n * STABILITY_MAP) * sizeof *line);
  bool ok = workers_run(line, sizeof *line, (size_t)(n * STABILITY_MAP), opt->jobs, map_item, &mw, opt->progress, d);
  r->map = arena_alloc(&r->arena, (size_t)n * sizeof *r->map);
  for (int i = 0; ok && i < n; i++) describe_map(&r->map[i], st, &mw.plan[i], line + i * STABILITY_MAP);
  r->n_maps = ok ? n : 0;
  free(line);
  return ok;
}

/* --- All --- */

bool audit_stability(struct stability_result *out, const struct model *m, const struct stability_options *opt,
                     struct diag *d) {
  struct study st;
  bool ok = study_open(&st, m, opt, d);
  st.out = out;
  out->layer = layer_name[opt->layer];
  out->after = opt->after >= 0 ? layer_name[opt->after] : NULL;
  out->quick = opt->quick;
  size_t n = st.n * (size_t)n_digits_regions;
  struct digits_found *found = ok ? ss_malloc(n * sizeof *found) : NULL;
  ok = ok && workers_run(found, sizeof *found, n, opt->jobs, search_item, &st, opt->progress, d);
  if (ok) gather(&st, found);
  ok = ok && (opt->quick || draw_maps(&st, found, opt, d));
  free(found);
  study_close(&st);
  return ok;
}

/* --- One point --- */

static bool parse_pair(double *x, slong *k, const struct digits_formula *f, const char *item, size_t len,
                       struct diag *d) {
  const char *equals = memchr(item, '=', len);
  char name[128], number[128], *end;
  if (!equals || equals == item || (size_t)(equals - item) >= sizeof name ||
      len - (size_t)(equals - item) > sizeof number) {
    diag_set(d, "error: --at takes NAME=VALUE,..., not %.*s", (int)(len < 200 ? len : 200), item);
    return false;
  }
  snprintf(name, sizeof name, "%.*s", (int)(equals - item), item);
  snprintf(number, sizeof number, "%.*s", (int)(len - 1 - (size_t)(equals - item)), equals + 1);
  double v = strtod(number, &end);
  bool plain = strspn(number, "+-.0123456789abcdefABCDEFpPxX") == strlen(number);
  if (!plain || end == number || *end || !isfinite(v)) {
    diag_set(d, "error: %s is no finite number that a double holds: %s", name, number);
    return false;
  }
  *k = digits_input(&f->tape, name);
  *x = v;
  return true;
}

/* Fills the inputs of the formula; names that only other formulas have are passed over. */
static bool parse_point(double *x, const struct digits_formula *f, const char *at, struct diag *d) {
  bool have[DIGITS_INPUTS] = {false};
  for (const char *p = at; *p;) {
    size_t len = strcspn(p, ",");
    slong k;
    double v;
    if (!parse_pair(&v, &k, f, p, len, d)) return false;
    if (k >= 0 && have[k]) {
      diag_set(d, "error: %s is given twice", f->tape.inputs[k]);
      return false;
    }
    if (k >= 0) {
      x[k] = v;
      have[k] = true;
    }
    p += len + (p[len] == ',');
  }
  for (slong k = 0; k < f->tape.n_inputs; k++)
    if (!have[k]) {
      diag_set(d, "error: %s is a function of %s, which --at does not give", f->id, f->tape.inputs[k]);
      return false;
    }
  return true;
}

static void print_values(struct text *out, const struct digits_bench *w) {
  const struct digits_formula *f = w->f;
  for (slong k = 0; k < f->n; k++) {
    slong i = f->out[k];
    text_printf(out, "  %-9s", k ? "" : "double");
    if (w->d_flags[i])
      text_add(out, "no value");
    else
      text_printf(out, "%.17g", *(const double *)num_vec_at(&w->d, i));
    text_add(out, "  true ");
    arb_srcptr v = num_vec_at(&w->b, i);
    if (num_print(out, v, 20) != SS_OK) num_print_ball(out, v, 20);
    text_add_char(out, '\n');
  }
}

static void print_conditions(struct text *out, struct digits_bench *w) {
  text_add(out, "  digits that each input's own rounding costs:");
  for (slong k = 0; k < w->f->tape.n_inputs; k++) {
    double c = digits_condition_by(w, k) * log10(2);
    if (isnan(c))
      text_printf(out, " %s unknown", w->f->tape.inputs[k]);
    else
      text_printf(out, " %s %.1f", w->f->tape.inputs[k], fmax(0, c));
  }
  text_add_char(out, '\n');
}

static void print_cause(struct text *out, struct study *st, const struct digits_formula *f, struct digits_cause c) {
  text_printf(out, "  %s, at ", loss_cause_says[c.cause]);
  digits_print_node(out, &st->set, f, c.node, false);
  if (c.grows > 0) text_printf(out, " (a relative error grows by %.1f digits there)", c.grows * log10(2));
  text_add_char(out, '\n');
}

static const char *const kind_says[] = {
    [DIGITS_OUTSIDE] = "it has no value there, or none that a double holds",
    [DIGITS_ZERO] = "its true value is zero there, or cannot be told from zero",
    [DIGITS_UNDECIDED] = "its true value is not known",
};

static bool print_formula(struct text *out, struct study *st, struct digits_formula *f, const char *at,
                          struct diag *d) {
  double x[DIGITS_INPUTS] = {0};
  struct digits_bench w;
  if (!parse_point(x, f, at, d) || (!f->kernel && !digits_slopes(f, &st->set, d))) return false;
  digits_bench_init(&w, f);
  struct digits_loss r = digits_measure(&w, x, -1);
  text_printf(out, "%s: %s\n", f->id, f->text);
  if (r.kind != DIGITS_LOST && r.kind != DIGITS_FAILED) {
    text_printf(out, "  %s\n", kind_says[r.kind]);
  } else {
    print_values(out, &w);
    if (r.kind == DIGITS_LOST) {
      text_printf(out, "  error 10^%.1f units of 2^-53; of %.1f digits lost the problem loses %.1f, the formula %.1f",
                  fmax(-99, r.error * log10(2)), r.observed, r.problem, r.formula);
      if (f->kernel)
        text_add_char(out, '\n');
      else if (isnan(r.predicted))
        text_add(out, "; the rule predicts a failure\n");
      else
        text_printf(out, "; the rule predicts %.1f\n", fmin(STABILITY_DIGITS, fmax(0, r.predicted * log10(2))));
    }
    if (!f->kernel) print_conditions(out, &w);
    if (!f->kernel) print_cause(out, st, f, r.kind == DIGITS_FAILED ? digits_explain_failure(&w) : digits_explain(&w));
  }
  digits_bench_clear(&w);
  return true;
}

bool audit_stability_at(struct text *out, const struct model *m, const struct stability_options *opt, const char *at,
                        struct diag *d) {
  struct study st;
  bool ok = study_open(&st, m, opt, d);
  for (size_t i = 0; ok && i < st.n; i++) ok = print_formula(out, &st, st.formula[i], at, d);
  study_close(&st);
  return ok;
}
