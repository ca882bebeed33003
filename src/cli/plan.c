/* verify --plan: the plan in words or as JSON; nothing is done and nothing is written. */
#include "run/plan.h"

#include <math.h>

#include "cli.h"

/* A line of its own, indented: what is long would else be broken by the terminal anywhere. */
static void print_list(const char *head, const struct plan_list *l) {
  for (int i = 0; i < l->n; i++) printf("%s%s%s", i ? ", " : "\n    ", i ? "" : head, l->item[i]);
}

static void print_cost(double units, double ms) {
  if (ms < 0)
    printf("cost not measured");
  else
    printf("%.0f units, %.1f ms", units, ms);
}

static void print_claim(const struct planned_claim *c) {
  printf("  %-16s %s", c->id, or_dash(c->kind));
  if (c->left_out) {
    puts("; left out: the scene gives intervals, and this is about one set of parameters");
    return;
  }
  printf("; ");
  print_cost(c->units, c->ms);
  if (c->first_bits) printf("; from %ld to %ld bits", c->first_bits, c->last_bits);
  print_list("routes ", &c->routes);
  if (c->points) printf("\n    points %s", c->points);
  print_list("needs ", &c->parts);
  print_list("matrices ", &c->matrices);
  print_list("controls ", &c->controls);
  printf("\n");
}

static void print_plan(const struct audit_plan *p) {
  printf("%s: %d claim%s\n", p->scene, p->n_claims, plural_s(p->n_claims));
  for (int i = 0; i < p->n_claims; i++) print_claim(&p->claim[i]);
  if (p->n_shared) puts("shared:");
  for (int i = 0; i < p->n_shared; i++) {
    const struct planned_work *w = &p->shared[i];
    printf("  %s", w->what);
    if (w->claims)
      printf(": for %ld claim%s, paid for by the first", w->claims, plural_s(w->claims));
    else
      printf(": "), print_cost(w->units, w->ms);
    printf("\n");
  }
  printf("estimate: %.0f units, %.0f ms in one process, and the consequences of what fails without being on record\n",
         p->units, p->ms);
}

static void write_cost(struct json *j, double units, double ms) {
  json_double(j, "units", "%.0f", units < 0 ? (double)NAN : units);
  json_double(j, "ms", "%.2f", ms < 0 ? (double)NAN : ms);
}

static void write_claim(struct json *j, const struct planned_claim *c) {
  JSON_OBJECT(j, NULL);
  json_string(j, "id", c->id);
  json_string(j, "kind", c->kind);
  json_string(j, "points", c->points);
  json_string_array(j, "routes", c->routes.item, c->routes.n);
  json_string_array(j, "needs", c->parts.item, c->parts.n);
  json_string_array(j, "matrices", c->matrices.item, c->matrices.n);
  json_string_array(j, "controls", c->controls.item, c->controls.n);
  json_bool(j, "left_out", c->left_out);
  json_long(j, "first_bits", c->first_bits);
  json_long(j, "last_bits", c->last_bits);
  write_cost(j, c->units, c->ms);
}

static void write_plan(struct text *out, const struct audit_plan *p) {
  OWNED(json) document = json_document(out, "stickslip-plan-1");
  struct json *j = &document;
  json_string(j, "scene", p->scene);
  JSON_EACH (j, "claims", i, p->n_claims) write_claim(j, &p->claim[i]);
  JSON_EACH (j, "shared", i, p->n_shared) {
    JSON_OBJECT(j, NULL);
    json_string(j, "what", p->shared[i].what);
    json_long(j, "claims", p->shared[i].claims);
    write_cost(j, p->shared[i].units, p->shared[i].ms);
  }
  write_cost(j, p->units, p->ms);
}

int show_plan(const struct model *m, const struct claims *claims, const struct claims *controls, const struct scene *s,
              const struct audit_options *opt, bool json, struct diag *d) {
  OWNED(audit_plan) p;
  struct text out = {0};
  bool ok = audit_plan(&p, m, claims, controls, s, opt, d);
  if (ok && json) {
    write_plan(&out, &p);
    print_text(&out);
  } else if (ok) {
    print_plan(&p);
  }
  return ok ? EXIT_AS_RECORDED : bad_input(d);
}
