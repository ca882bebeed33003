/* A scene that asks for some routes only: what is said without the others, and that they are missing. */
#include "judge.h"
#include <string.h>

bool route_is_asked(const struct scene *s, const char *route) {
  for (size_t i = 0; s && i < s->asked.routes.n; i++)
    if (strcmp(s->asked.routes.item[i], route) == 0) return true;
  return !s || s->asked.routes.n == 0;
}

static void add_missing(struct text *names, const char *route) {
  char name[ROUTE_NAME + 2];
  snprintf(name, sizeof name, ", %.*s", ROUTE_NAME - 1, route);
  if (!strstr(text_str(names), name)) text_add(names, name);
}

int claim_routes(char name[MOST_CLAIM_ROUTES][ROUTE_NAME], const struct claim *c) {
  const char *list = claim_routes_asked(c);
  int n = 0;
  size_t len;
  if (!claim_tried_at_points(c)) return 0;
  if (!list || strcmp(list, "exact") != 0) {
    snprintf(name[n++], ROUTE_NAME, "balls");
    for (const char *s = list_item(&len, list); s && n < MOST_CLAIM_ROUTES - 1; s = list_item(&len, s + len))
      snprintf(name[n++], ROUTE_NAME, "%.*s", (int)(len < ROUTE_NAME ? len : ROUTE_NAME - 1), s);
  }
  snprintf(name[n++], ROUTE_NAME, "exact");
  return n;
}

/* What the claim file asks for and the scene does not. */
static void missing_of_claim(struct text *names, const struct judge *j, const struct claim *c) {
  char name[MOST_CLAIM_ROUTES][ROUTE_NAME];
  int n = claim_routes(name, c);
  for (int i = 0; i < n; i++)
    if (!route_is_asked(j->scene, name[i])) add_missing(names, name[i]);
}

/* Verdicts that nothing was tried for; diagnostics of what cannot be read need no route. */
static bool needs_no_route(const struct finding *f) {
  return f->verdict == VERDICT_DEFINITION || f->verdict == VERDICT_SKIPPED || finding_is_diagnostic(f);
}

void keep_asked_routes(struct finding *f, struct judge *j, const struct claim *c) {
  OWNED(text) missing = {0};
  int kept = 0;
  if (!j->scene || j->scene->asked.routes.n == 0 || needs_no_route(f)) return;
  missing_of_claim(&missing, j, c);
  for (int i = 0; i < f->n_evidence; i++) {
    if (route_is_asked(j->scene, f->evidence[i].route)) {
      f->evidence[kept++] = f->evidence[i];
      continue;
    }
    add_missing(&missing, f->evidence[i].route);
    f->verdict = VERDICT_UNKNOWN;
  }
  if (kept < f->n_evidence) f->correction = f->effect = f->fault = f->condition = NULL;
  f->n_evidence = kept;
  if (missing.len) {
    finding_state(f, j->out, "none", layer_name[LAYER_CORRECTED], -1, -1, NULL,
                  result_str(j->out, "without %s, which the scene does not ask for", text_str(&missing) + 2));
    f->recorded = N_VERDICTS; /* the record is of all routes */
  }
}
