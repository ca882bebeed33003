/* From evidence to verdict, in one place.  Nothing else in the program assigns a verdict to a claim that was tried. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "audit_impl.h"

#define VERDICT_STRING(upper, lower) #lower,
const char *const verdict_name[N_VERDICTS] = {VERDICTS(VERDICT_STRING)};

enum verdict verdict_parse(const char *name) {
  int i = 0;
  while (i < N_VERDICTS && strcmp(verdict_name[i], name) != 0) i++;
  return (enum verdict)i;
}

/* Groups of routes that share their reasoning: two routes of one group count as one.  "balls" holds the paper's formulas
   against the model's closed forms and implicit derivatives. */
static const struct {
  const char *route, *group;
} groups[] = {
    {"balls", "closed form"},      {"oracle", "model matrices"},        {"exponential", "matrix exponential"},
    {"taylor", "taylor series"},   {"gsl", "gsl exponential"},          {"ode", "defining equation"},
    {"fd", "differences"},         {"saltation", "saltation matrices"}, {"newton", "springs and masses"},
    {"iteration", "iterated map"}, {"integration", "gsl integration"},  {"motion", "closed forms of nine modes"}};

const char *const route_independence[] = {
    "balls: the paper's formula on a tape of Arb balls against the suite's own closed forms in (w, r), implicit "
    "differentiation at the located events, and Arb's matrix exponential; decides",
    "fd: central differences of the event-located map in MPFR at 256 bits; shares the flow's closed form with balls, "
    "none "
    "of its derivatives",
    "taylor: matrix exponential by the suite's Taylor series in MPFR at 256 bits; shares the first-order system with "
    "balls",
    "gsl: matrix exponential by GSL in double; shares the first-order system with balls",
    "ode: symbolic derivative of the paper's own matrix put into the linear system, and its value at 0; shares the "
    "first-order system with balls, no exponential",
    "newton: stiffness from the springs and masses of Fig. 1 by Newton's law; shares nothing with the first-order "
    "system",
    "saltation: return Jacobian from vector fields, matrix exponentials and saltation matrices; shares the event times "
    "and "
    "states with balls, no derivative and no closed form",
    "exponential: states carried through the phases by Arb's matrix exponential; shares the event times with balls, "
    "not "
    "the closed forms",
    "oracle: the same sentence with the model's matrices in place of the paper's; shares no formula with the paper",
    "iteration: the return map iterated in double from points beside the orbit; shares no derivative with balls",
    "integration: the equations of motion (1) under Coulomb's law (2) integrated by GSL in x, which knows nothing of "
    "z, "
    "phases or closed forms",
    "motion: the same by closed forms in each of the nine modes, in double; shares with integration the law and the "
    "bookkeeping of events, nothing else"};
const int n_route_independence = sizeof route_independence / sizeof *route_independence;

static const char *group_of(const char *route) {
  for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
    if (strcmp(groups[i].route, route) == 0) return groups[i].group;
  abort();
}

int independent_routes(const struct route_word *w, int n) {
  int count = 0;
  for (int i = 0; i < n; i++) {
    if (w[i].says != SAYS_AGREES) continue;
    bool fresh = true;
    for (int k = 0; k < i; k++)
      if (w[k].says == SAYS_AGREES && strcmp(group_of(w[k].route), group_of(w[i].route)) == 0) fresh = false;
    count += fresh;
  }
  return count;
}

/*  decisive route | other routes            | whole domain enclosed | verdict
    ---------------+-------------------------+-----------------------+----------
    differs        | none agrees             | -                     | refuted
    differs        | one agrees              | -                     | unknown (the oracles contradict each other)
    agrees         | none differs, undecided | yes                   | proved
    agrees         | all agree, two groups   | no                    | supported
    anything else                                                    | unknown                                      */
enum verdict verdict_of(const struct route_word *w, int n, bool whole_domain) {
  bool certificate = false, agrees = false, agrees_besides = false, differs_besides = false, undecided = false;
  for (int i = 0; i < n; i++) {
    if (w[i].trials == 0)
      undecided = true;
    else if (w[i].says == SAYS_DIFFERS)
      *(w[i].decisive ? &certificate : &differs_besides) = true;
    else if (w[i].says == SAYS_AGREES)
      *(w[i].decisive ? &agrees : &agrees_besides) = true;
    else
      undecided = true;
  }
  if (certificate) return agrees_besides ? VERDICT_UNKNOWN : VERDICT_REFUTED;
  if (!agrees || differs_besides || undecided) return VERDICT_UNKNOWN;
  if (whole_domain) return VERDICT_PROVED;
  return independent_routes(w, n) >= 2 ? VERDICT_SUPPORTED : VERDICT_UNKNOWN;
}

struct evidence *finding_add(struct finding *f, struct audit_result *out) {
  struct evidence *e = arena_alloc(&out->arena, (size_t)(f->n_evidence + 1) * sizeof *e);
  if (f->n_evidence) memcpy(e, f->evidence, (size_t)f->n_evidence * sizeof *e);
  f->evidence = e;
  e += f->n_evidence++;
  *e = (struct evidence){.bits = -1, .trials = -1, .machine_residual = NAN};
  return e;
}

void finding_state(struct finding *f, struct audit_result *out, const char *layer, long bits, const char *where,
                   const char *note) {
  struct evidence *e = finding_add(f, out);
  e->route = "balls";
  e->layer = layer;
  e->result = "states";
  e->bits = bits;
  e->trials = 1;
  e->worst = where;
  e->note = note;
}

const char *order_of_magnitude(struct audit_result *r, double log2x) {
  if (isinf(log2x) && log2x < 0) return "0";
  return result_str(r, "1e%d", (int)ceil(log2x * 0.30102999566398120));
}
