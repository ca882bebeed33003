/* What the commands share: options, messages, where the data is. */
#ifndef STICKSLIP_CLI_H
#define STICKSLIP_CLI_H

#include "stickslip/audit.h"

/* Exit statuses of the contract. */
enum { EXIT_AS_RECORDED = 0, EXIT_DIFFERS = 1, EXIT_USAGE = 2, EXIT_INPUT = 3, EXIT_STRICT = 4, EXIT_INTERNAL = 5 };

enum { DEFAULT_DIGITS = 15, MAX_DIGITS = 100000, MAX_ONLY = 256, MAX_OPERANDS = 64 };

/* Commands as bits, for the table of options. */
enum {
  FOR_VERIFY = 1,
  FOR_ORBIT = 2,
  FOR_JACOBIAN = 4,
  FOR_LIST = 8,
  FOR_CHECK = 16,
  FOR_EXPLAIN = 32,
  FOR_SIMULATE = 64,
  FOR_READINGS = 128,
  FOR_MUTATE = 256,
  FOR_REPAIR = 512,
  FOR_BENCH = 1024,
  FOR_JSON = FOR_ORBIT | FOR_JACOBIAN | FOR_READINGS | FOR_MUTATE | FOR_REPAIR | FOR_BENCH
};

struct options {
  const char *operand[MAX_OPERANDS];
  int n_operands;
  const char *only[MAX_ONLY];
  int n_only;
  const char *paper, *overlay, *out, *at, *method, *layer, *digits, *periods, *samples, *start, *seed, *count, *jobs;
  const char *job;
  bool strict, quiet, json, tape, csv, compare, phases, quick, help;
};

/* Says what is wrong with the command line and returns EXIT_USAGE; fmt holds one %s. */
int usage(const char *fmt, const char *what);
/* Prints the diagnostic and returns EXIT_INPUT. */
int bad_input(const struct diag *d);

/* The words after the command.  Splits lists in place: they live in argv.  An exit status. */
int parse_options(struct options *o, unsigned command, int argc, char **argv);
int parse_digits(slong *digits, const struct options *o);
/* --at orbit:K (as K - 1; the first without --at) or printed. */
int parse_start(slong *orbit, bool *printed, const char *at);

/* The data folder into data. */
bool find_data(struct text *data, struct diag *d);
/* folder/name into out. */
void join_path(struct text *out, const char *folder, const char *name);
/* The paper, the user's overlay, the errata and the controls' damages, by rank. */
bool load_model(struct model *m, const char *data, const struct options *o, struct diag *d);
bool load_claims(struct claims *c, const char *data, const char *folder, const char *kind, struct diag *d);

/* As many of the digits as are known; a ball in which not even the first is: 0. */
void print_known(struct text *out, const arb_struct *x, slong digits);
/* The radius to two digits, rounded up; 0 when it is. */
void print_accuracy(struct text *out, const arb_struct *worst);
/* "orbit:2" or "printed". */
void print_at(struct text *out, const struct jacobian_request *q);
/* The eigenvalues of a 2x2 matrix by GSL, two texts: real numbers, or "a+bi" and "a-bi". */
bool print_eigenvalues(struct text out[2], arb_srcptr j);
/* jacobian --phases */
bool show_phases(const struct options *o, const struct model *m, const struct scene *s,
                 const struct jacobian_request *q, struct diag *d);

/* One function a command; each returns its exit status. */
int run_verify(const struct options *o, const char *data);
int run_orbit(const struct options *o, const char *data);
/* orbit --method paper. */
int run_orbit_paper(const struct options *o, const char *data);
int run_jacobian(const struct options *o, const char *data);
/* simulate --compare, over at most the given time. */
int compare_routes(const struct coulomb_setup *setup, const struct scene *s, long periods, double duration);
/* Says that a simulation ended before it was to; the exit status. */
int ended_early(enum coulomb_end end, const char *route, double t);
int run_list(const struct options *o, const char *data);
int run_check(const struct options *o, const char *data);
int run_simulate(const struct options *o, const char *data);
int run_readings(const struct options *o, const char *data);
int run_explain(const struct options *o, const char *data);
int run_mutate(const struct options *o, const char *data);
int run_repair(const struct options *o, const char *data);
int run_bench(const struct options *o, const char *data);

#endif
