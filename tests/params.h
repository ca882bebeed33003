/* Sets of the model's parameters: the paper's, drawn at random, outside the domain, and as text. */
#ifndef STICKSLIP_TESTS_PARAMS_H
#define STICKSLIP_TESTS_PARAMS_H

#include "motion/dynamics.h"
#include "rng.h"

/* Those of the paper's example. */
extern const double example[N_PARAMS];
extern const char *const example_text[N_PARAMS];

/* Between which two numbers chi is drawn evenly, and the logarithms of eta, V, e1/V and e2/V. */
struct param_ranges {
  double chi[2], eta[2], V[2], e1[2], e2[2];
};
void params_draw(double p[N_PARAMS], struct rng *r, const struct param_ranges *in);
/* A chi as near as 1e-4 to 0, or 1e-5 to 1; an eta from 1e-3 to 1e3. */
void params_to_edges(double p[N_PARAMS], struct rng *r, bool chi_small);
/* Any of a size, or of several: numbers from 1e-310 to 1e308, chi at most 1e-8. */
double size_draw(struct rng *r);
void params_draw_sizes(double p[N_PARAMS], struct rng *r);

/* The k-th set of the example with one parameter that no motion has; false behind the last. */
bool params_outside(double p[N_PARAMS], int k);

/* Valid until the next call. */
const char *params_shown(const double p[N_PARAMS]);

/* Exact parameters of which one, whose text is not read, goes from an end to the other.  To be cleared. */
struct param_line {
  fmpq *params, *from, *to;
  int vary;
};
struct param_line param_line_of(const char *const params[N_PARAMS], int vary, const char *from, const char *to);
void param_line_clear(struct param_line *l);

/* The orbits of exact parameters; fails the test where the search does.  To be cleared. */
struct dyn_orbits orbits_of(const fmpq *params, slong prec);

#endif
