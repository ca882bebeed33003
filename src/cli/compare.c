/* stickslip simulate --compare: both routes in double precision beside MPFR, return by return, and whether what
   separates them grows as the orbit's multiplier says. */
#include <math.h>

#include "motion/long_run.h"
#include "simulated.h"

static void print_return(const struct long_run *run, enum long_route k, long i) {
  const struct long_return *r = &run->at[k][i];
  char off[24] = "-";
  if (k != LONG_MPFR) snprintf(off, sizeof off, "%.1e", fmax(r->off, r->late));
  printf("%6ld  %-6s %15.10f %15.10f  %8s ", i + 1, long_route_name[k], r->x[0], r->x[1], off);
  for (size_t e = i > 0 ? run->at[k][i - 1].events : 0; e < r->events; e++) printf(" %.10f", run->log[k].event[e].at.t);
  putchar('\n');
}

static void print_pair(const struct long_run *run, struct long_pair p, double by) {
  struct long_growth g;
  long parted = long_run_parting(run, p, by);
  printf("%s and %s: ", long_route_name[p.a], long_route_name[p.b]);
  if (long_run_length(run, p) == 0)
    printf("they have no return to the global stick phase in common");
  else if (parted)
    printf("apart by more than %g at period %ld", by, parted);
  else
    printf("not apart by more than %g in %ld period%s", by, long_run_length(run, p), plural_s(long_run_length(run, p)));
  if (long_run_growth(&g, run, p))
    printf("; factor %.5f a period from %ld to %ld\n", exp(g.log), g.first, g.last);
  else
    puts("; no growth to measure");
}

/* What the multiplier says, and what a displacement does that is large against rounding. */
static void print_multiplier(const struct coulomb_setup *setup, double duration) {
  struct long_growth g;
  printf("tr J = %.8g: factor %.5f a period expected", setup->trace, fabs(setup->trace));
  if (long_run_displaced(&g, setup->params, setup->start, setup->trace, duration))
    printf("; a displacement of x1 has %.5f from %ld to %ld", exp(g.log), g.first, g.last);
  putchar('\n');
}

int compare_routes(const struct coulomb_setup *setup, const struct scene *s, const char *from, long periods,
                   double duration) {
  enum { BITS = 160, MOST_BITS = 4096 };
  OWNED(long_run) run;
  double bits = isfinite(setup->trace) ? log2(fmax(1, fabs(setup->trace))) * (double)periods : (double)periods;
  slong prec = BITS + (slong)fmin(bits, MOST_BITS);
  int status = EXIT_AS_RECORDED;
  long_run_make(&run, setup->params, setup->start, periods, duration, prec);
  printf("%s, %s: ode (GSL's integration) and closed (closed forms), both in double, from one start beside mpfr (%ld "
         "bits)\n",
         s->name, from, (long)prec);
  printf("%6s  %-6s %15s %15s  %8s  %s\n", "period", "route", "x1", "x2", "off mpfr", "events at");
  for (long i = 0; i < run.n[LONG_MPFR]; i++)
    for (int k = 0; k < N_LONG_ROUTES; k++)
      if (i < run.n[k]) print_return(&run, (enum long_route)k, i);
  for (int k = 0; k < N_LONG_ROUTES; k++)
    if (run.end[k] != COULOMB_DONE)
      status =
          ended_early(coulomb_end_name[run.end[k]], long_route_name[k], run.n[k] > 0 ? run.at[k][run.n[k] - 1].t : 0);
  static const struct long_pair pairs[] = {{LONG_ODE, LONG_CLOSED}, {LONG_ODE, LONG_MPFR}, {LONG_CLOSED, LONG_MPFR}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) print_pair(&run, pairs[i], 1e-6);
  if (isfinite(setup->trace)) print_multiplier(setup, duration);
  return status;
}
