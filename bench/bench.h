/* Error against run time: jobs, the methods that can do them, and the measuring of both.

   A job is a map from a few doubles, taken as exact, to a few numbers, with a truth: balls made by the suite's own
   model in Arb.  A method is any way to that map at one of its settings (a precision, a tolerance, a step).  Its error
   is the largest over the job's inputs and outputs of |got - true| in units of the output's scale; its time is that of
   one call, from batches of calls over all inputs in turn.

   Files: job_*.c hold the jobs with their tables of methods; methods, yardstick, six, newton_mpfr, formula, motion, ode
   and cvode what the methods are made of; harness.c measures, table.c reads off the rows, ratios.c, profile.c,
   verdicts.c and sides.c measure what no row holds, peers.c reads what was measured elsewhere (peers/); report.c,
   pages.c, figure.c and machine.c write.

   Clocks are read here and in the command line, nowhere else; the library knows no time. */
#ifndef STICKSLIP_BENCH_H
#define STICKSLIP_BENCH_H

#include "base/arena.h"
#include "bench/study.h"
#include "claim/claims.h"
#include "num/num.h"

enum { BENCH_IN = 8, BENCH_OUT = 16, BENCH_HINT = 6 };

/* One input as a method sees it.  in and given are in the method's own arithmetic. */
struct bench_case {
  const double *x;      /* the exact inputs */
  struct num_vec in;    /* the same */
  struct num_vec given; /* what the job hands out besides (balls stay balls) */
  const double *hint;   /* rough values for methods that do not search */
};

/* What a method may need from outside. */
struct bench_env {
  const struct model *model;              /* the paper's formulas; NULL: methods that read them fail */
  const struct claims *claims, *controls; /* these and the scene for verdicts alone */
  const struct scene *scene;
  const char *data; /* the folder that holds scenes/; NULL: studies of them fail */
};

enum bench_kind { SET_NONE, SET_BITS, SET_TOLERANCE, SET_STEP, SET_DIGITS, N_SETS };
extern const char *const bench_kind_name[N_SETS]; /* "", "bits", "tolerance", "step", "digits" */

struct bench_method {
  const char *id, *title;
  const struct num_type *type;
  const char *arithmetic; /* of a peer, which has no type here */
  bool bare;              /* takes for granted what others find or check: rough times, the arc, first events */
  bool absent;            /* not installed: has one row, which says so */
  enum bench_kind kind;
  const double *settings; /* n of them; without any the method runs once */
  int n;
  const double *quick; /* those of quick runs; NULL: all */
  int n_quick;
  slong bits;       /* of the arithmetic, unless the setting says it */
  const void *data; /* for open */
  /* State for all calls at one setting, made outside of the timing; NULL: it cannot be had, which is a failure.  Both
     may be NULL for a method without state. */
  void *(*open)(const struct bench_method *m, double setting, const struct bench_env *env);
  void (*close)(void *self);
  /* A status of status.h.  *steps: its work in units of its own (steps, iterations, evaluations); 0 is a failure. */
  int (*run)(void *self, struct num_vec *out, long *steps, const struct bench_case *c);
};

struct bench_job {
  const char *id, *title;
  const char *inputs, *outputs; /* in words */
  int n_in, n_out, n_given;
  int n_cases, n_quick;
  double worst_condition; /* inputs with a larger condition number are not taken */
  const int *group;       /* of each output: outputs of one group have one scale, their largest magnitude */
  /* An input from a point of the unit cube. */
  void (*place)(double *x, const double *u);
  /* In balls, at the precision of out; in: n_in elements, exact or moved by relative 2^-80.  SS_OK or the input is not
     taken.  near: the hints of the unmoved input when it is moved, else NULL; hint: to be set. */
  int (*truth)(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in, const double *near);
  const struct bench_method *methods;
  int n_methods;
};

/* --- Results. --- */

struct bench_row {
  const struct bench_method *method;
  double setting;
  const char *failure;        /* why it counts as failed, or NULL */
  int cases, failures;        /* tried; failed */
  double worst, median;       /* log10 of the error; NAN when failed */
  double least_ns, median_ns; /* of one call */
  double steps;               /* mean */
  long calls;                 /* timed */
  int batches;
  bool capped; /* not all inputs were tried: the method is slow */
  bool front;  /* on the Pareto front */
};
struct bench_table {
  const struct bench_job *job;
  const struct bench_method **method; /* the job's, then the peers' */
  int n_methods;
  struct bench_row *row;
  int n;
  size_t cap;
  int cases;           /* inputs taken */
  double floor;        /* the error that rounding each input to 53 bits can make, at the worst input */
  double truth_digits; /* of the truth, at the worst output */
  bool quick;
};

/* A method in balls and its like in MPFR, at equal true error. */
struct bench_cost {
  const char *plain, *balls;
  double digits, plain_ns, balls_ns;
};

/* Work of the program on the paper's scene.  The size is a number of digits, up to WORK_ALL_SIDES; of points that are
   swept, of a line between e2/2 and 3 e2 or of a square of such lines with e1 changed by up to a quarter; of periods
   simulated; or of claims judged (eq-3 brings eq-3b with it).  WORK_SIDES: both sides of a claim at one of its points;
   WORK_ALL_SIDES: those of all claims together, one that cannot be had left out. */
enum bench_work_kind {
  WORK_ORBITS,
  WORK_JACOBIAN,
  WORK_ALL_SIDES,
  WORK_SWEEP,
  WORK_PLANE,
  WORK_PERIODS,
  WORK_CLAIMS,
  WORK_CLAIM,
  WORK_SIDES
};
extern const char *const bench_work_name[WORK_SIDES + 1]; /* "orbits", "jacobian", "all sides", ... */
struct bench_work {
  enum bench_work_kind kind;
  char id[64]; /* of WORK_CLAIM and WORK_SIDES */
  long size;
  double seconds; /* the least; NAN when it failed */
  bool good;
};
struct bench_verdicts {
  struct bench_work *work;
  size_t n, cap;
  bool quick;
};

/* Where a method spends its time, by samples of the program counter: how much in each library ("stickslip" being the
   program), and in which functions, as far as libraries tell them; the largest first. */
enum { BENCH_PARTS = 6 };
struct bench_part {
  char where[64];
  double share;
};
struct bench_profile {
  const struct bench_method *method; /* NULL: none */
  double setting;
  long samples;
  int n_libraries, n_functions;
  struct bench_part library[BENCH_PARTS], function[BENCH_PARTS];
};

/* A ratio that is asked for. */
struct bench_ratio {
  char name[160];
  double value; /* NAN: not measured */
  double goal;  /* NAN: stated without one */
  bool at_most;
  struct bench_profile profile; /* of what keeps it from its goal */
};
enum bench_outcome { RATIO_MET, RATIO_NOT_MET, RATIO_STATED, RATIO_NOT_MEASURED };
enum bench_outcome bench_outcome(const struct bench_ratio *r);

/* Rows measured elsewhere on the same inputs, bench/peers. */
struct bench_peers {
  struct arena arena;
  struct bench_peer {
    const struct bench_job *job;
    struct bench_method method;
    struct bench_row row;
  } * peer;
  size_t n, cap;
  struct text versions; /* "name: value" lines */
};

struct bench_result {
  struct bench_table *table;
  int n;
  struct bench_ratio *ratio;
  int n_ratios;
  size_t cap_ratios;
  bool quick;
  struct bench_verdicts verdicts; /* empty unless asked for */
  struct study_page *page;
  int n_pages;
  struct bench_peers peers; /* likewise */
};

extern const struct bench_job *const bench_jobs[];
extern const int n_bench_jobs;

/* The job's method of that name; NULL without one. */
const struct bench_method *bench_method_of(const struct bench_job *job, const char *id);
/* Runs the job, every method at every setting.  false when no inputs or no truth could be had. */
bool bench_run(struct bench_table *out, const struct bench_job *job, const struct bench_env *env, bool quick);
void bench_table_clear(struct bench_table *t);
/* The row, or NULL; setting is ignored for methods without one. */
const struct bench_row *bench_find(const struct bench_table *t, const char *method, double setting);

/* The inputs and their truths alone, as TSV: 17 digits, and 60.  false as above. */
bool bench_inputs(struct text *out, const struct bench_job *job, bool quick);
/* The arithmetic of the method at a setting. */
struct num_ctx bench_context(const struct bench_method *m, double setting);
/* Calls the method on a few inputs in turn for the given time, between begin and end; false when it cannot be
   called. */
bool bench_keep_busy(const struct bench_job *job, const struct bench_method *m, double setting,
                     const struct bench_env *env, double seconds, bool (*begin)(void), void (*end)(void));
/* Appends a row; which of them are on the front is decided anew. */
void bench_add_row(struct bench_table *t, const struct bench_method *m, const struct bench_row *row);
/* log10 of the errors that the guide gives a method for. */
extern const int bench_targets[];
extern const int n_bench_targets;
/* The fastest method whose worst error is at most 10^log_error; rigorous: among balls.  Bare methods do not count.
   NULL: none. */
const struct bench_row *bench_best(const struct bench_table *t, double log_error, bool rigorous);

/* Reads the table that bench/peers/peers.py writes; false with d set at the first mistake. */
bool bench_peers_read(struct bench_peers *p, const char *path, struct diag *d);
void bench_peers_clear(struct bench_peers *p);
/* Adds the rows of the table's job, which refer to p. */
void bench_peers_add(struct bench_table *t, const struct bench_peers *p);

enum { BENCH_COSTS = 64 };
/* What proof costs in this job, at most `most` entries; returns their number. */
int bench_costs(struct bench_cost *out, int most, const struct bench_table *t);
/* Times of orbits and Jacobians by digits, of claims one by one and together. */
void bench_verdicts(struct bench_verdicts *v, const struct bench_env *env, bool quick);
void bench_verdicts_clear(struct bench_verdicts *v);

/* The ratios that the tables allow, and those that need measurements of their own. */
void bench_ratios(struct bench_result *r);
/* Profiles what keeps ratios from their goals.  Nothing where the system does not tell the program counter. */
void bench_profiles(struct bench_result *r, const struct bench_env *env);
void bench_result_clear(struct bench_result *r);

/* Seconds since some start. */
double bench_now(void);
/* The time of one call of f in ns, the least of a few batches of at least a millisecond. */
double bench_time(void (*f)(void *), void *arg);
/* NAN of none; sorts x. */
double bench_median(double *x, int n);

/* --- Output; everything said in words comes from the rows. --- */

/* What report.c and pages.c print alike. */
const char *bench_error(char buffer[24], double log);                /* an error from its log10 */
void bench_add_setting(struct text *out, const struct bench_row *r); /* "128", "1e-06"; nothing without one */
void bench_add_state(struct text *out, const struct bench_row *r);   /* "ok", or why not and how often */
const char *bench_outcome_name(enum bench_outcome o);                /* "met", "not met", ... */

void bench_tsv(struct text *out, const struct bench_table *t);
void bench_verdicts_tsv(struct text *out, const struct bench_verdicts *v);
void bench_json(struct text *out, const struct bench_result *r);
/* The page that holds all together; files: it refers to those of the jobs, and to figures. */
void bench_markdown(struct text *out, const struct bench_result *r, bool files);
void bench_job_markdown(struct text *out, const struct bench_table *t, bool files);
/* The page of a study. */
void bench_study_markdown(struct text *out, const struct study_page *page, bool files);
/* Figures, SVG documents: JOB.svg, and JOB-steps.svg when there are methods with steps; verdicts.svg. */
void bench_figure(struct text *out, const struct bench_table *t, bool steps);
bool bench_has_steps(const struct bench_table *t);
void bench_verdicts_figure(struct text *out, const struct bench_verdicts *v);
/* CPU, cores, compiler, libraries, as "name: value" lines. */
void bench_machine(struct text *out, const struct bench_result *r); /* r may be NULL */

#endif
