/* What the commands share: options, messages, where the data is. */
#ifndef STICKSLIP_CLI_H
#define STICKSLIP_CLI_H

#include "report/folder.h"
#include "scene/solved.h"
#include "stickslip/audit.h"
#include "stickslip/certify.h"
#include "stickslip/dynamics.h"
#include "stickslip/json.h"

/* Exit statuses of the contract. */
enum { EXIT_AS_RECORDED = 0, EXIT_DIFFERS = 1, EXIT_USAGE = 2, EXIT_INPUT = 3, EXIT_STRICT = 4, EXIT_INTERNAL = 5 };

enum {
  DEFAULT_DIGITS = 15,
  MAX_DIGITS = 100000,
  MAX_ONLY = 256,
  MAX_OPERANDS = 64,
  MAX_OVER = 2,
  MAX_SET = 64,
  MAX_JOBS = 64
};

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
  FOR_BIFURCATE = 1024,
  FOR_DIFF = 2048,
  FOR_BENCH = 4096,
  FOR_SWEEP = 8192,
  FOR_STABILITY = 16384,
  FOR_WORDS = 32768,
  FOR_PLOT = 65536,
  FOR_REPORT = 131072,
  FOR_JSON = FOR_ORBIT | FOR_JACOBIAN | FOR_READINGS | FOR_MUTATE | FOR_REPAIR | FOR_BIFURCATE | FOR_DIFF | FOR_BENCH |
             FOR_SWEEP | FOR_STABILITY | FOR_LIST | FOR_WORDS,
  FOR_SET = FOR_VERIFY | FOR_ORBIT | FOR_JACOBIAN | FOR_SIMULATE | FOR_READINGS | FOR_EXPLAIN | FOR_BIFURCATE |
            FOR_SWEEP | FOR_REPAIR | FOR_WORDS | FOR_PLOT
};

struct options {
  const char *operand[MAX_OPERANDS];
  int n_operands;
  const char *only[MAX_ONLY];
  int n_only;
  const char *over[MAX_OVER];
  int n_over;
  const char *set[MAX_SET];
  int n_set;
  const char *paper, *overlay, *out, *at, *method, *layer, *digits, *periods, *samples, *start, *seed, *count, *jobs,
      *certificate, *along, *job, *inputs, *peers, *csv_file, *search_every, *after, *timeout, *longest;
  bool strict, quiet, json, tape, receipt, csv, compare, phases, basin, quick, all, resume, plan, scene_keys, help;
};

/* Says what is wrong with the command line and returns EXIT_USAGE; fmt holds one %s. */
int usage(const char *fmt, const char *what);
/* Prints the diagnostic and returns EXIT_INPUT. */
int bad_input(const struct diag *d);

/* The words after the command.  Splits lists in place: they live in argv.  An exit status. */
int parse_options(struct options *o, unsigned command, int argc, char **argv);
int parse_digits(slong *digits, const struct options *o);
/* A whole number from 1 (or 0) to most; false otherwise. */
bool parse_whole(unsigned long long *n, const char *text, bool zero, unsigned long long most);
/* --jobs; all processors (at most 64) when text is NULL. */
int parse_jobs(int *jobs, const char *text);
/* --timeout; 0 when text is NULL. */
int parse_timeout(double *seconds, const char *text);
/* --at orbit:K (as K - 1; the first without --at) or printed. */
int parse_start(slong *orbit, bool *printed, const char *at);

/* What one parameter runs through, exactly. */
struct range {
  fmpq_t from, to;
  int vary;
};
void range_init(struct range *r);
void range_clear(struct range *r);
/* NAME=A:B in len bytes; an exit status, after a message that names the option.  shape: what is said when text has another
   form, with a %s for the option and a %.200s for the text. */
int range_parse(struct range *r, const char *option, const char *shape, const char *text, size_t len);
/* The values must keep u_r above e, as a scene does. */
int range_check_friction(const struct range *r, const struct scene *s, const char *option, const char *text);

/* --- On a terminal --- */

/* Whether standard output is a terminal that shows colours, and NO_COLOR does not ask for none. */
bool terminal_has_colours(void);
/* Its columns; 0 where standard output is no terminal. */
int terminal_width(void);
/* Prints lines, with those that are wider than the terminal broken at blanks; as they are where there is no terminal. */
void terminal_print(const char *s);
enum paint { PAINT_NONE, PAINT_GOOD, PAINT_BAD, PAINT_DOUBT, PAINT_HEAD };
/* The word at the right end of so many columns, with a negative width at the left. */
void paint(struct text *out, bool colours, enum paint p, const char *word, int width);
/* What verify prints last: failures and counts by section; and the line of the contract. */
void verify_tables(const struct audit_result *r);
void verify_line(const struct audit_result *r);

/* The score of the whole study of damages beside a report's folder, when it was made of the same paper, overlay and scene;
   false when there is none. */
bool score_beside(struct mutation_score *s, const char *folder, const struct audit_result *r);
/* Memory that GMP, MPFR, FLINT or GSL cannot have ends the program as the program's own does. */
void own_memory(void);

/* The data folder into data. */
bool find_data(struct text *data, struct diag *d);
/* The scene of that name or path, with what --set changes; box: it may have intervals.  scene_clear it all the same. */
bool load_scene(struct scene *s, const char *spec, const char *data, const struct options *o, bool box, struct diag *d);
/* list --scene-keys */
int list_scene_keys(bool as_json);
/* folder/name into out. */
void join_path(struct text *out, const char *folder, const char *name);
/* The paper or --paper, and --overlay, with what corrects them. */
bool load_model(struct model *m, const char *data, const struct options *o, struct diag *d);

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

/* The largest radius of the orbit's enclosures to two digits, rounded up. */
void print_radius(struct text *out, const struct dyn_orbit *o);
/* true, false or null. */
void json_truth(struct json *j, const char *key, truth t);

/* One function a command; each returns its exit status. */
/* verify --plan. */
int show_plan(const struct model *m, const struct claims *claims, const struct claims *controls, const struct scene *s,
              const struct audit_options *opt, bool json, struct diag *d);
int run_verify(const struct options *o, const char *data);
int run_orbit(const struct options *o, const char *data);
/* orbit --method paper. */
int run_orbit_paper(const struct options *o, const char *data);
/* orbit on a scene with intervals. */
int show_box(const struct options *o, const struct scene *s, slong digits);
int run_jacobian(const struct options *o, const char *data);
/* orbit and jacobian on a scene that names another word than the paper's. */
int run_word_orbit(const struct options *o, const struct scene *s, slong digits, struct diag *d);
int run_word_jacobian(const struct options *o, const struct scene *s, const struct jacobian_request *asked,
                      struct diag *d);
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
int run_bifurcate(const struct options *o, const char *data);
int run_diff(const struct options *o, const char *data);
int run_bench(const struct options *o, const char *data);
int run_sweep(const struct options *o, const char *data);
int run_stability(const struct options *o, const char *data);
int run_plot(const struct options *o, const char *data);
int run_report(const struct options *o, const char *data);
int run_words(const struct options *o, const char *data);

#endif
