/* The one table of the routes, and what follows from it.  That a route rests on something stands here once; that two
   share it, and whether their agreement counts twice, is computed. */
#include "routes.h"

#include <stdlib.h>
#include <string.h>

const char *const route_quantity_name[N_ROUTE_QUANTITIES] = {"propagator D, Gamma, H, C",
                                                             "derivative of a propagator",
                                                             "times and states of the events",
                                                             "return Jacobian",
                                                             "stiffness matrix",
                                                             "sentence about matrices",
                                                             "fate of points beside an orbit",
                                                             "motions of every kind"};

static const char *const mean_text[N_MEANS] = {
#define MEAN_TEXT(name, text) text,
    ROUTE_MEANS(MEAN_TEXT)
#undef MEAN_TEXT
};

const struct route_info route_table[N_ROUTE_ROWS] = {
    [ROUTE_P_PAPER] = {QUANTITY_PROPAGATOR, "paper", NULL, "the paper's corrected formulas on a tape of balls",
                       MEANS_PAPER, 60, true},
    [ROUTE_P_EXPONENTIAL] = {QUANTITY_PROPAGATOR, "exponential", "balls", "the matrix exponential by Arb",
                             MEANS_SYSTEM | MEANS_EXPONENTIAL, 60, true},
    [ROUTE_P_CLOSED] = {QUANTITY_PROPAGATOR, "closed form", NULL, "the suite's own closed forms in balls",
                        MEANS_MODES | MEANS_FLOW, 60, true},
    [ROUTE_P_TAYLOR] = {QUANTITY_PROPAGATOR, "taylor", "taylor", "the matrix exponential as a Taylor series in MPFR",
                        MEANS_SYSTEM | MEANS_TAYLOR, 60, true},
    [ROUTE_P_GSL] = {QUANTITY_PROPAGATOR, "gsl", "gsl", "the matrix exponential by GSL in double",
                     MEANS_SYSTEM | MEANS_GSL, 9, false},
    [ROUTE_R_PAPER] = {QUANTITY_RATE, "paper", "balls",
                       "the derivative of the paper's corrected matrix, and its value at 0",
                       MEANS_PAPER | MEANS_SYMBOLIC, 60, true},
    [ROUTE_R_ODE] = {QUANTITY_RATE, "ode", "ode", "what the defining equation P' = A P, P(0) = I makes of that matrix",
                     MEANS_PAPER | MEANS_SYSTEM, 60, true},
    [ROUTE_E_CLOSED] = {QUANTITY_EVENTS, "closed form", "balls",
                        "the closed-form flow from event to event, each proved to be one root",
                        MEANS_MODES | MEANS_FLOW | MEANS_ENDS | MEANS_SEARCH | MEANS_EVENTS, 50, true},
    [ROUTE_E_EXPONENTIAL] = {QUANTITY_EVENTS, "exponential", "exponential",
                             "the states carried by Arb's matrix exponential over the located times",
                             MEANS_SYSTEM | MEANS_EXPONENTIAL | MEANS_EVENTS, 50, true},
    [ROUTE_E_SIMULATION] = {QUANTITY_EVENTS, "simulation", NULL,
                            "Coulomb's law in the coordinates x, closed forms in each pair of modes, in MPFR",
                            MEANS_COULOMB | MEANS_CURVES | MEANS_MODES | MEANS_SEARCH, 50, false},
    [ROUTE_E_INTEGRATION] = {QUANTITY_EVENTS, "integration", NULL,
                             "Coulomb's law in the coordinates x, integrated by GSL's rk8pd in double",
                             MEANS_COULOMB | MEANS_INTEGRATOR, 9, false},
    [ROUTE_E_SYSTEM] = {QUANTITY_EVENTS, "system", "system",
                        "the orbit of two masses, two springs and a belt by the engine for any system, in balls",
                        MEANS_SPRINGS | MEANS_EXPONENTIAL | MEANS_SHOOTING, 50, false},
    [ROUTE_J_PAPER] = {QUANTITY_JACOBIAN, "paper", NULL,
                       "the paper's corrected chain J_f J_c J_b J_a on a tape of balls", MEANS_PAPER | MEANS_EVENTS, 50,
                       true},
    [ROUTE_J_IMPLICIT] = {QUANTITY_JACOBIAN, "implicit", "balls", "implicit differentiation at each event, in balls",
                          MEANS_MODES | MEANS_FLOW | MEANS_ENDS | MEANS_EVENTS | MEANS_IMPLICIT, 50, true},
    [ROUTE_J_SALTATION] = {QUANTITY_JACOBIAN, "saltation", "saltation",
                           "matrix exponentials and saltation matrices from the vector fields, in balls",
                           MEANS_SYSTEM | MEANS_EXPONENTIAL | MEANS_ENDS | MEANS_EVENTS | MEANS_SALTATION, 50, true},
    [ROUTE_J_FD] = {QUANTITY_JACOBIAN, "fd", "fd", "central differences of the event-located map in MPFR",
                    MEANS_MODES | MEANS_FLOW | MEANS_ENDS | MEANS_DIFFERENCES, 40, true},
    [ROUTE_J_INTEGRATION] = {QUANTITY_JACOBIAN, "integration", NULL,
                             "extrapolated central differences of GSL's integration in the coordinates x",
                             MEANS_COULOMB | MEANS_INTEGRATOR | MEANS_DIFFERENCES, 5, false},
    [ROUTE_J_SYSTEM] = {QUANTITY_JACOBIAN, "system", "system",
                        "the first return of that orbit by the engine for any system, in balls",
                        MEANS_SPRINGS | MEANS_EXPONENTIAL | MEANS_SHOOTING | MEANS_IMPLICIT, 50, false},
    [ROUTE_K_SYSTEM] = {QUANTITY_STIFFNESS, "system", "balls", "the stiffness read off the first-order system",
                        MEANS_SYSTEM, 0, true},
    [ROUTE_K_NEWTON] = {QUANTITY_STIFFNESS, "newton", "newton", "the stiffness by Newton's law", MEANS_SPRINGS, 0,
                        true},
    [ROUTE_S_PAPER] = {QUANTITY_SENTENCE, "paper", "balls", "the sentence with the paper's matrices", MEANS_PAPER, 0,
                       true},
    [ROUTE_S_ORACLE] = {QUANTITY_SENTENCE, "oracle", "oracle", "the sentence with the model's matrices", MEANS_MATRICES,
                        0, true},
    [ROUTE_S_ALGEBRA] = {QUANTITY_SENTENCE, "algebra", "algebra",
                         "identities of rational functions over the paper's symbols, decided exactly",
                         MEANS_PAPER | MEANS_ALGEBRA, 0, true},
    [ROUTE_F_BALLS] = {QUANTITY_FATE, "multiplier", "balls", "tr J, in balls",
                       MEANS_MODES | MEANS_FLOW | MEANS_ENDS | MEANS_EVENTS | MEANS_IMPLICIT, 0, true},
    [ROUTE_F_ITERATION] = {QUANTITY_FATE, "iteration", "iteration", "the return map iterated from beside the orbit",
                           MEANS_RETURN_MAP, 0, false},
    [ROUTE_F_INTEGRATION] = {QUANTITY_FATE, "integration", "integration",
                             "the motion from beside the orbit, integrated by GSL in x",
                             MEANS_COULOMB | MEANS_INTEGRATOR, 0, false},
    [ROUTE_M_INTEGRATION] = {QUANTITY_MOTION, "integration", "integration", "Coulomb's law in x, integrated by GSL",
                             MEANS_COULOMB | MEANS_INTEGRATOR, 0, false},
    [ROUTE_M_MOTION] = {QUANTITY_MOTION, "motion", "motion",
                        "Coulomb's law in x, closed forms in each of the nine pairs of modes, in double",
                        MEANS_COULOMB | MEANS_CURVES | MEANS_MODES | MEANS_SEARCH, 0, false},
};

static bool is_called(const struct route_info *r, const char *name) {
  return r->evidence && strcmp(r->evidence, name) == 0;
}

bool route_is_known(const char *name) {
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    if (is_called(&route_table[i], name)) return true;
  return false;
}

const char *route_first_called(int row) {
  const char *name = route_table[row].evidence;
  for (int k = 0; k < row && name; k++)
    if (is_called(&route_table[k], name)) return NULL;
  return name;
}

bool routes_independent(const char *a, const char *b) {
  if (!route_is_known(a) || !route_is_known(b)) abort();
  if (strcmp(a, b) == 0) return false;
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    for (int k = 0; k < N_ROUTE_ROWS; k++) {
      const struct route_info *r = &route_table[i], *s = &route_table[k];
      if (!is_called(r, a) || !is_called(s, b) || r->quantity != s->quantity) continue;
      if ((r->means & ~s->means) == 0 || (s->means & ~r->means) == 0) return false;
    }
  return true;
}

/* The located events rest on the flow that they were located with. */
static unsigned with_events(unsigned means) {
  return means & MEANS_EVENTS ? means | MEANS_MODES | MEANS_FLOW | MEANS_ENDS : means;
}

unsigned route_means_shared(const struct route_info *a, const struct route_info *b) {
  return with_events(a->means) & with_events(b->means);
}

void route_means_print(struct text *out, unsigned means) {
  const char *sep = "";
  for (int i = 0; i < N_MEANS; i++) {
    if (!(means >> i & 1U)) continue;
    text_printf(out, "%s%s", sep, mean_text[i]);
    sep = ", ";
  }
  if (means == 0) text_add(out, "nothing");
}

void routes_describe(struct audit_result *out) {
  const char **line = arena_alloc(&out->arena, N_ROUTE_ROWS * sizeof *line);
  OWNED(text) t = {0};
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    const struct route_info *r = &route_table[i];
    text_reset(&t);
    text_printf(&t, "%s, %s", route_quantity_name[r->quantity], r->name);
    if (r->evidence && strcmp(r->evidence, r->name) != 0) text_printf(&t, " (in evidence: %s)", r->evidence);
    text_printf(&t, ": %s; rests on ", r->does);
    route_means_print(&t, r->means);
    line[i] = result_copy(out, text_str(&t));
  }
  out->independence = line;
  out->n_independence = N_ROUTE_ROWS;
}
