/* From evidence to verdict, in one place.  Nothing else in the program assigns a verdict to a claim that was tried. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "route/routes.h"

#define VERDICT_STRING(upper, lower) #lower,
const char *const verdict_name[N_VERDICTS] = {VERDICTS(VERDICT_STRING)};

enum verdict verdict_parse(const char *name) {
  int i = 0;
  while (i < N_VERDICTS && strcmp(verdict_name[i], name) != 0) i++;
  return (enum verdict)i;
}

bool verdict_fails(enum verdict v) {
  return v == VERDICT_REFUTED || v == VERDICT_CONDITIONAL;
}

int independent_routes(const struct route_result *w, int n) {
  int count = 0;
  for (int i = 0; i < n; i++) {
    if (w[i].outcome != ROUTE_AGREES) continue;
    bool fresh = true;
    for (int k = 0; k < i; k++)
      if (w[k].outcome == ROUTE_AGREES && !routes_independent(w[k].route, w[i].route)) fresh = false;
    count += fresh;
  }
  return count;
}

/*  decisive route | other routes            | whole domain enclosed | verdict
    ---------------+-------------------------+-----------------------+----------
    differs        | none agrees             | -                     | refuted
    differs        | one agrees              | -                     | unknown (the oracles contradict each other)
    agrees         | none differs, undecided | yes                   | proved
    agrees         | two independent agree   | no                    | supported
    anything else                                                    | unknown                                      */
enum verdict verdict_of(const struct route_result *w, int n, bool whole_domain) {
  bool certificate = false, agrees = false, agrees_besides = false, differs_besides = false, undecided = false;
  for (int i = 0; i < n; i++) {
    if (w[i].trials == 0)
      undecided = true;
    else if (w[i].outcome == ROUTE_DIFFERS)
      *(w[i].decisive ? &certificate : &differs_besides) = true;
    else if (w[i].outcome == ROUTE_AGREES)
      *(w[i].decisive ? &agrees : &agrees_besides) = true;
    else
      undecided = true;
  }
  if (certificate) return agrees_besides ? VERDICT_UNKNOWN : VERDICT_REFUTED;
  if (!agrees || differs_besides || undecided) return VERDICT_UNKNOWN;
  if (whole_domain) return VERDICT_PROVED;
  return independent_routes(w, n) >= 2 ? VERDICT_SUPPORTED : VERDICT_UNKNOWN;
}

/*  on the whole domain | under a condition | verdict
    --------------------+-------------------+------------
    refuted             | proved            | conditional
    anything else                           | that of the whole domain */
enum verdict verdict_under_condition(enum verdict whole, enum verdict under) {
  return whole == VERDICT_REFUTED && under == VERDICT_PROVED ? VERDICT_CONDITIONAL : whole;
}

struct evidence *finding_add(struct finding *f, struct audit_result *out) {
  struct evidence *e = arena_alloc(&out->arena, (size_t)(f->n_evidence + 1) * sizeof *e);
  if (f->n_evidence) memcpy(e, f->evidence, (size_t)f->n_evidence * sizeof *e);
  f->evidence = e;
  e += f->n_evidence++;
  *e = (struct evidence){.bits = -1, .trials = -1, .machine_residual = NAN};
  return e;
}

static struct evidence *put(struct finding *f, struct audit_result *out, const char *route, const char *layer,
                            const char *result, long bits, long trials, const char *where, const char *note) {
  struct evidence *e = finding_add(f, out);
  e->route = route;
  e->layer = layer;
  e->result = result;
  e->bits = bits;
  e->trials = trials;
  e->worst = where;
  e->note = note;
  return e;
}

struct evidence *finding_add_route(struct finding *f, struct audit_result *out, struct route_result w,
                                   const char *layer, long bits, const char *where, const char *note) {
  static const char *const words[] = {"undecided", "agrees", "differs", "undecided"};
  return put(f, out, w.route, layer, words[w.outcome], bits, w.trials, where, note);
}

void finding_state(struct finding *f, struct audit_result *out, const char *route, const char *layer, long bits,
                   long trials, const char *where, const char *note) {
  put(f, out, route, layer, "states", bits, trials, where, note);
}

const char *order_of_magnitude(struct audit_result *r, double log2x) {
  if (isinf(log2x) && log2x < 0) return "0";
  return result_str(r, "1e%d", (int)ceil(log2x * 0.30102999566398120));
}
