/* The routes and what each of them uses: one table for the evidence, the report and the study that holds routes against
   each other.

   A route is a way to one kind of quantity, and its means are what it uses itself besides the equations of motion.
   What two routes share is what both use, or use through the located events that they start from.  They are independent
   of each other when each uses some means that the other does not. */
#ifndef STICKSLIP_RECORD_ROUTES_H
#define STICKSLIP_RECORD_ROUTES_H

#include "base/text.h"
#include "result.h"
#define ROUTE_MEANS(X)                                                                                                 \
  X(PAPER, "the paper's formulas")                                                                                     \
  X(SYMBOLIC, "symbolic differentiation")                                                                              \
  X(SYSTEM, "the first-order system of a phase")                                                                       \
  X(EXPONENTIAL, "Arb's matrix exponential")                                                                           \
  X(TAYLOR, "the suite's Taylor series")                                                                               \
  X(GSL, "GSL's matrix exponential")                                                                                   \
  X(MODES, "the modes of the global slip phase")                                                                       \
  X(FLOW, "the closed-form flow in (w, r)")                                                                            \
  X(ENDS, "the conditions that end the phases")                                                                        \
  X(SEARCH, "the search for first events in double")                                                                   \
  X(EVENTS, "the events located with the closed-form flow")                                                            \
  X(IMPLICIT, "implicit differentiation at the events")                                                                \
  X(SALTATION, "saltation matrices")                                                                                   \
  X(DIFFERENCES, "central differences")                                                                                \
  X(COULOMB, "Coulomb's law in x")                                                                                     \
  X(CURVES, "closed forms in every pair of modes")                                                                     \
  X(INTEGRATOR, "GSL's integrator")                                                                                    \
  X(RETURN_MAP, "the one-dimensional return map in double")                                                            \
  X(MATRICES, "the model's matrices in place of the paper's")                                                          \
  X(SPRINGS, "the springs and masses of Fig. 1")                                                                       \
  X(SHOOTING, "one set of equations for times and states together")                                                    \
  X(ALGEBRA, "exact algebra over the symbols")

enum route_mean {
#define MEAN_BIT(name, text) BIT_##name,
  ROUTE_MEANS(MEAN_BIT)
#undef MEAN_BIT
      N_MEANS
};
enum {
#define MEAN_MASK(name, text) MEANS_##name = 1 << BIT_##name,
  ROUTE_MEANS(MEAN_MASK)
#undef MEAN_MASK
};

/* Kinds of quantities.  The first four are held against each other by the study. */
enum route_quantity {
  QUANTITY_PROPAGATOR,
  QUANTITY_RATE,
  QUANTITY_EVENTS,
  QUANTITY_JACOBIAN,
  N_STUDIED,
  QUANTITY_STIFFNESS = N_STUDIED,
  QUANTITY_SENTENCE,
  QUANTITY_FATE,
  QUANTITY_MOTION,
  N_ROUTE_QUANTITIES
};
extern const char *const route_quantity_name[N_ROUTE_QUANTITIES];

/* Rows of the table; those of one quantity stand together. */
enum route_row {
  ROUTE_P_PAPER,
  ROUTE_P_EXPONENTIAL,
  ROUTE_P_CLOSED,
  ROUTE_P_TAYLOR,
  ROUTE_P_GSL,
  ROUTE_R_PAPER,
  ROUTE_R_ODE,
  ROUTE_E_CLOSED,
  ROUTE_E_EXPONENTIAL,
  ROUTE_E_SIMULATION,
  ROUTE_E_INTEGRATION,
  ROUTE_E_SYSTEM,
  ROUTE_J_PAPER,
  ROUTE_J_IMPLICIT,
  ROUTE_J_SALTATION,
  ROUTE_J_FD,
  ROUTE_J_INTEGRATION,
  ROUTE_J_SYSTEM,
  ROUTE_K_SYSTEM,
  ROUTE_K_NEWTON,
  ROUTE_S_PAPER,
  ROUTE_S_ORACLE,
  ROUTE_S_ALGEBRA,
  ROUTE_F_BALLS,
  ROUTE_F_ITERATION,
  ROUTE_F_INTEGRATION,
  ROUTE_M_INTEGRATION,
  ROUTE_M_MOTION,
  N_ROUTE_ROWS
};

struct route_info {
  enum route_quantity quantity;
  const char *name;     /* within its quantity */
  const char *evidence; /* how evidence calls it; NULL when no claim asks for it */
  const char *does;
  unsigned means;
  int digits; /* stated accuracy, relative to max(1, scale): 10^-digits; 0 outside of the study */
  bool exact; /* the same on every machine: balls, and MPFR that no result in double precision can reach */
};
extern const struct route_info route_table[N_ROUTE_ROWS];

/* Whether evidence calls a route so. */
bool route_is_known(const char *name);
/* What evidence calls that row's, where it is the first row of that name, so that a walk has each name once; else
   NULL. */
const char *route_first_called(int row);
/* Whether two routes, by their names in evidence, are independent of each other.  Aborts on a name that no row
   bears. */
bool routes_independent(const char *a, const char *b);
/* What both use, themselves or through the located events. */
unsigned route_means_shared(const struct route_info *a, const struct route_info *b);
/* The means of a mask, joined by ", "; "nothing" for none. */
void route_means_print(struct text *out, unsigned means);
/* One sentence for each row of the table, into out->independence. */
void routes_describe(struct audit_result *out);

#endif
