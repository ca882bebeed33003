/* A simulated motion as simulate prints it, of the paper's two masses or of a system file. */
#ifndef STICKSLIP_CLI_SIMULATED_H
#define STICKSLIP_CLI_SIMULATED_H

#include "cli.h"
#include "mech/moments.h"
#include "value/coulomb_setup.h"

struct simulated {
  const char *scene, *system, *at; /* system: NULL for the paper's; at: "orbit:K", "printed", "start" or "search" */
  int n, states;
  const struct mech_motion *main, *other; /* by integration, by closed forms */
};
/* A row of CSV; at: NULL for the heading. */
void csv_line(int n, const struct mech_moment *at);
/* How far both routes agree: of so many events so many are the same. */
void routes_line(long shared, long events, double worst);
/* "ended at t = 7.1 after 3 events: why": of what it counts, with what stands behind; why: NULL where it is done. */
void ended_line(double t, long n, const char *counted, const char *behind, const char *why);
void simulated_json(const struct simulated *run, const char *ended);
/* Says that a simulation ended before it was to; the exit status. */
int ended_early(const char *why, const char *route, double t);

/* --compare, from the start of that name, over at most the given time. */
int compare_routes(const struct coulomb_setup *setup, const struct scene *s, const char *from, long periods,
                   double duration);

/* simulate on a scene that names a system file: from the orbit of that number, counted from 0; time is 0 where it is
   not given. */
struct system_run {
  slong orbit;
  long periods, samples;
  double time;
};
int run_system_simulate(const struct options *o, const struct scene *s, const char *data,
                        const struct system_run *asked, struct diag *d);

#endif
