/* Figures of curves, and those of the jobs: error against time and steps, and what verdicts cost.

   Error against time has two panels: what double precision can reach, and what lies beyond, where the axis is the
   logarithm of the digits, since all doubles would be one line there.  The dotted line is what rounding the inputs
   costs: in double nothing can be expected below it. */
#include "bench/figure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"

void figure_curve(struct figure *f, const char *name) {
  struct figure_curve *c = SS_PUSH(f->curve, f->n_curves, f->cap_curves);
  *c = (struct figure_curve){.name = name};
  snprintf(c->class, sizeof c->class, "k%zu", f->n_curves - 1);
}

void figure_point(struct figure *f, int panel, double x, double y) {
  if (!isfinite(x) || !isfinite(y)) return;
  *SS_PUSH(f->point, f->n_points, f->cap_points) = (struct figure_point){f->n_curves - 1, panel, x, y};
  f->curve[f->n_curves - 1].drawn = true;
}

static void draw_panel(struct plot *p, const struct figure *f, int panel, double top) {
  const struct figure_panel *q = &f->panel[panel];
  bool given = q->low < q->high;
  p->left = panel * p->width / f->panels + PLOT_LEFT;
  p->right = (panel + 1) * p->width / f->panels - PLOT_RIGHT;
  p->exponents = q->exponents;
  plot_forget(p);
  for (size_t i = 0; i < f->n_points; i++) {
    const struct figure_point *at = &f->point[i];
    if (at->panel != panel || (given && !(at->y >= q->low && at->y <= q->high))) continue;
    plot_hold(&p->low[0], &p->high[0], at->x);
    plot_hold(&p->low[1], &p->high[1], at->y);
  }
  for (int axis = 0; axis < 2; axis++) {
    p->power[axis] = q->power[axis];
    plot_widen(p, axis, 0.05, 0.05);
  }
  if (given) {
    p->low[1] = q->low;
    p->high[1] = q->high;
  }
  plot_panel(p, top, 330, q->x, q->y);
  if (f->limit != 0 && panel == 0) plot_line(p, "aid", p->low[0], f->limit, p->high[0], f->limit);
  for (size_t k = 0; k < f->n_curves; k++) {
    for (size_t i = 0; i < f->n_points; i++)
      if (f->point[i].curve == k && f->point[i].panel == panel)
        plot_point(p, f->curve[k].class, f->point[i].x, f->point[i].y);
    plot_end(p);
  }
  plot_free(p);
}

void figure_svg(struct text *out, struct figure *f) {
  OWNED(text) drawn = {0}, told = {0};
  struct plot p = plot_begin(&drawn, f->id, f->panels == 1 ? 620 : 820);
  const char *(*key)[2] = ss_malloc((f->n_curves + 1) * sizeof *key);
  int n = 0;
  if (f->limit != 0) {
    key[n][0] = "aid";
    key[n++][1] = "limit of rounded inputs";
  }
  for (size_t k = 0; k < f->n_curves; k++) {
    if (!f->curve[k].drawn) continue;
    key[n][0] = f->curve[k].class;
    key[n++][1] = f->curve[k].name;
  }
  text_add(&told, "Curves, whose numbers are in the table: ");
  for (int i = 0; i < n; i++) text_printf(&told, "%s%s", i ? ", " : "", key[i][1]);
  text_add(&drawn, "<style>@media screen and (prefers-color-scheme: dark) { .plot .curve[color] { filter: "
                   "invert(1) hue-rotate(180deg); } }</style>\n");
  double top = plot_key(&p, (const char *const(*)[2])key, n) + 22;
  for (int i = 0; i < f->panels; i++) draw_panel(&p, f, i, top);
  plot_svg(out, &p, f->title, text_str(&told), true);
  free(key);
  free(f->curve);
  free(f->point);
}

/* --- Error against time, and against steps. --- */

static const double beyond = -16.5; /* log10 of an error that no double has */

static bool plotted(const struct bench_row *r) {
  return !r->failure && isfinite(r->worst);
}

/* Differences in double, of which the second figure is. */
static bool in_double(const struct bench_method *m) {
  return m->kind == SET_STEP && m->type == &num_double;
}

bool bench_has_steps(const struct bench_table *t) {
  bool any = false;
  for (int i = 0; i < t->n; i++) any = any || (in_double(t->row[i].method) && plotted(&t->row[i]));
  return any;
}

/* A curve for each method that has a point anywhere, so that it looks alike in both figures. */
static void add_method(struct figure *f, const struct bench_table *t, const struct bench_method *m, bool steps) {
  bool any = false;
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    if (r->method != m || !plotted(r)) continue;
    if (!any) figure_curve(f, m->id);
    any = true;
    if (steps && in_double(m)) figure_point(f, 0, log10(r->setting), r->worst);
    if (steps) continue;
    figure_point(f, 0, log10(r->least_ns) - 9, r->worst);
    if (r->worst >= beyond) continue;
    figure_point(f, 1, log10(r->least_ns) - 9, -log10(-r->worst));
    f->panels = 2;
  }
}

void bench_figure(struct text *out, const struct bench_table *t, bool steps) {
  static const double exponents[] = {20, 30, 50, 100, 200, 300, 500, 1000, 2000, 0};
  const char *x = steps ? "step" : "least time of one call, seconds";
  struct figure f = {.id = t->job->id, .title = t->job->title, .panels = 1, .limit = log10(t->floor)};
  f.panel[0] = (struct figure_panel){.x = x, .y = "worst error", .power = {true, true}, .low = -18, .high = 1};
  f.panel[1] =
      (struct figure_panel){.x = x, .y = "worst error, beyond double", .power = {true, true}, .exponents = exponents};
  for (int k = 0; k < t->n_methods; k++) add_method(&f, t, t->method[k], steps);
  figure_svg(out, &f);
}

/* --- What verdicts cost. --- */

void bench_verdicts_figure(struct text *out, const struct bench_verdicts *v) {
  static const char *const x[] = {"digits", "points swept, periods simulated, claims judged together"};
  struct figure f = {.id = "verdicts", .title = "What verdicts cost", .panels = 2};
  for (int i = 0; i < 2; i++)
    f.panel[i] = (struct figure_panel){.x = x[i], .y = "least time, seconds", .power = {true, true}};
  for (int kind = 0; kind < WORK_CLAIM; kind++) {
    figure_curve(&f, bench_work_name[kind]);
    for (size_t i = 0; i < v->n; i++)
      if ((int)v->work[i].kind == kind && v->work[i].good)
        figure_point(&f, kind >= WORK_SWEEP, log10((double)v->work[i].size), log10(v->work[i].seconds));
  }
  figure_svg(out, &f);
}
