/* From evidence to verdict, in one place: nothing else assigns a verdict to a claim that was tried, but to what cannot
   be read and to the correction of a number. */
#include "verdict.h"
#include "model/model.h"
#include "record/routes.h"

enum route_outcome outcome_of_truth(truth holds) {
  return holds == TRUTH_TRUE ? ROUTE_AGREES : holds == TRUTH_FALSE ? ROUTE_DIFFERS : ROUTE_UNDECIDED;
}

enum route_outcome outcome_of_counts(long agrees, long differs, long undecided) {
  return differs ? ROUTE_DIFFERS : undecided ? ROUTE_UNDECIDED : agrees ? ROUTE_AGREES : ROUTE_NOTHING;
}

long answers_given(const struct answers *a) {
  return a->of[TRUTH_FALSE] + a->of[TRUTH_TRUE] + a->of[TRUTH_UNKNOWN];
}

enum route_outcome answers_outcome(const struct answers *a) {
  return outcome_of_counts(a->of[TRUTH_TRUE], a->of[TRUTH_FALSE], a->of[TRUTH_UNKNOWN]);
}

struct route_result counted_route(const char *route, bool decisive, long agrees, long differs, long undecided) {
  return (struct route_result){route, outcome_of_counts(agrees, differs, undecided), decisive,
                               agrees + differs + undecided};
}

struct route_result answers_route(const char *route, bool decisive, const struct answers *said) {
  return counted_route(route, decisive, said->of[TRUTH_TRUE], said->of[TRUTH_FALSE], said->of[TRUTH_UNKNOWN]);
}

struct route_result exact_route(struct finding *f, struct audit_result *out, enum route_outcome outcome,
                                const char *note) {
  bool decided = outcome == ROUTE_AGREES || outcome == ROUTE_DIFFERS;
  struct evidence *e = finding_add(f, out);
  e->route = "exact";
  e->layer = layer_name[LAYER_CORRECTED];
  e->result = outcome == ROUTE_AGREES ? "proved" : decided ? "differs" : "states";
  e->note = decided ? note : result_str(out, "not proved: %s", note);
  return (struct route_result){"exact", outcome, true, 1};
}

void verdict_leave_open(struct finding *f, struct audit_result *out, const char *why) {
  f->verdict = VERDICT_UNKNOWN;
  finding_state(f, out, "balls", layer_name[LAYER_CORRECTED], -1, 0, NULL, why);
}

/* How many of the routes agree and are pairwise independent by the table of routes.h. */
static int independent_routes(const struct route_result *w, int n) {
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

enum verdict verdict_with_proof(struct route_result *w, int n, const struct route_result *proof) {
  bool proved = proof->outcome == ROUTE_AGREES;
  w[n] = *proof;
  return verdict_of(w, n + (proved || proof->outcome == ROUTE_DIFFERS), proved);
}

/*  on the whole domain | under a condition | verdict
    --------------------+-------------------+------------
    refuted             | proved            | conditional
    anything else                           | that of the whole domain */
enum verdict verdict_under_condition(enum verdict whole, enum verdict under) {
  return whole == VERDICT_REFUTED && under == VERDICT_PROVED ? VERDICT_CONDITIONAL : whole;
}
