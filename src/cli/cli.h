/* What the commands share: options, messages, where the data is. */
#ifndef STICKSLIP_CLI_H
#define STICKSLIP_CLI_H

#include "base/json.h"
#include "base/suggest.h"
#include "claim/claim.h"
#include "motion/certify.h"
#include "motion/dynamics.h"
#include "report/folder.h"
#include "route/jacobian.h"
#include "run/audit.h"
#include "value/solved.h"

/* Exit statuses of the contract. */
enum { EXIT_AS_RECORDED = 0, EXIT_DIFFERS = 1, EXIT_USAGE = 2, EXIT_INPUT = 3, EXIT_STRICT = 4, EXIT_INTERNAL = 5 };

enum { MAX_OPERANDS = 64, MAX_OVER = 2 };

/* What options take, as macros, since their texts show it too: SHOWN(MAX_JOBS) is "64". */
#define SHOWN(x)           SHOWN_AS_TEXT(x)
#define SHOWN_AS_TEXT(x)   #x
#define MAX_DIGITS         100000
#define DEFAULT_DIGITS     15
#define MAX_PAPER_DIGITS   1000 /* by the paper's own equations */
#define MAX_BRACKET_DIGITS 1000
#define WORD_DIGITS        1000 /* of other words than the paper's, and of other systems */
#define MAX_SWEEP_DIGITS   15   /* of a double */
#define MAX_PERIODS        100000
#define MAX_COMPARED       10000 /* periods */
#define MAX_SAMPLES        1000000
#define DEFAULT_SAMPLES    100
#define MOST_TIME          1000000
#define MOST_SECONDS       10000000 /* of --timeout */
#define MOST_PHASES        8
#define DEFAULT_PHASES     4
#define MAX_COUNT          1000000
#define DEFAULT_COUNT      400
#define MAX_JOBS           64
#define MAX_SET            64
#define MAX_WORDS          256 /* of one option, or operands */

/* --- The command line, by the rows of options.def --- */

struct options;

/* One function a command; each returns its exit status.  What is wrong with its input it leaves in d, which the program
   prints; the status is then EXIT_INPUT, or EXIT_INTERNAL where the command returns that. */
#define COMMAND(name, ...) int run_##name(const struct options *o, const char *data, struct diag *d);
#include "cli/options.def"

enum option {
#define OPTION(id, ...) OPT_##id,
#include "cli/options.def"
  N_OPTIONS
};

struct command {
  const char *name;
  bool data; /* it reads the data folder */
  const char *operands, *purpose, *text, *example[2];
  int (*run)(const struct options *o, const char *data, struct diag *d);
};
extern const struct command command_table[];
extern const int n_commands;

enum option_kind {
  KIND_FLAG,
  KIND_TEXT,
  KIND_LIST,    /* values that hold names between commas */
  KIND_TWICE,   /* one or two values */
  KIND_SETTINGS /* NAME=VALUE, as often as wanted */
};
struct option_row {
  enum option id;
  const char *name, *commands, *value;
  enum option_kind kind;
  const char *text;
};
extern const struct option_row option_table[];
extern const int n_option_rows;
/* Whether the command has the option of this row. */
bool option_belongs(const struct option_row *row, const char *command);

struct words {
  const char *word[MAX_WORDS];
  int n;
};
/* The words of a command line: its operands and what is given for each option. */
struct options {
  struct words operands, given[N_OPTIONS];
};
/* What is given for an option: its value, for a flag the flag itself; NULL where it is not given. */
const char *option(const struct options *o, enum option id);
/* With the dashes. */
const char *option_name(enum option id);

/* Says what is wrong with the command line and returns EXIT_USAGE. */
int usage(const char *fmt, ...) SS_PRINTF(1, 2);
/* The same of a word that is none of those tried, with what may have been meant. */
int usage_unknown(const char *fmt, const struct suggestion *s);
/* Prints the diagnostic and returns EXIT_INPUT. */
int bad_input(const struct diag *d);

/* The words after the command of that name.  Splits lists in place: they live in argv.  An exit status. */
int parse_options(struct options *o, const char *command, int argc, char **argv);
/* Whether they go together, and the operands are those of the command.  An exit status. */
int check_options(const struct options *o, const struct command *c);
/* What follows reads one option, and leaves what it reads into as it is where the option is not given.  A whole number
   from 1 to most; one of n words, by its place.  An exit status, after a message. */
int parse_count(long *count, const struct options *o, enum option id, long most);
int parse_word(int *k, const struct options *o, enum option id, const char *const *list, int n);
/* --digits, to most; DEFAULT_DIGITS without it. */
int parse_digits(slong *digits, const struct options *o, long most);
/* A whole number from 1 (or 0) to most; false otherwise. */
bool parse_whole(unsigned long long *n, const char *text, bool zero, unsigned long long most);
/* --jobs; all processors (at most 64) without it. */
int parse_jobs(int *jobs, const struct options *o);
/* --timeout or --time, from 0.000001 to most; 0 without it. */
int parse_decimal(double *x, const struct options *o, enum option id, long most);
/* --at orbit:K (as K - 1; -1 without --at) or printed. */
int parse_start(slong *orbit, bool *printed, const struct options *o);

/* The command of that name; NULL after a message. */
const struct command *find_command(const char *name);
/* stickslip help, with the words behind it: the overview, the page of a command, or with --table every row of
   options.def, its fields between tabs.  An exit status. */
int help(int argc, char **argv);
/* stickslip COMMAND --help. */
void help_page(const struct command *c);

/* NAME=A:B in len bytes; an exit status, after a message that names the option.  shape: what is said when text has
   another form, with a %s for the option and a %.200s for the text. */
int range_parse(struct scene_range *r, const char *option, const char *shape, const char *text, size_t len);
/* --along, whose ends differ, in double precision too: of one of the paper's parameters, or, with name, of any, which
   is added to it. */
int parse_along(struct scene_range *r, struct text *name, const struct options *o);
/* Says that changes along a line can be missing. */
void warn_missed(const struct scene *s);
/* An exit status, after a message that names the option where scene_range_below_friction says no. */
int range_check_friction(const struct scene_range *r, const struct scene *s, const char *option, const char *text);

/* --- On a terminal --- */

/* Whether standard output is a terminal that shows colours, and NO_COLOR does not ask for none. */
bool terminal_has_colours(void);
/* Its columns; 0 where standard output is no terminal. */
int terminal_width(void);
/* What is len bytes long and begins in the column used, broken at single blanks where the line is wider; it goes on at
   indent.  A longer word stays whole. */
void text_fit(struct text *out, const char *line, size_t len, size_t used, size_t width, size_t indent);
/* How far a command is, on one line of standard error, where that is a terminal; once there is something to judge it
   by, how long the rest takes.  begin: the time runs; show: so many of all, which are the given part of the work;
   count: the same with items that are equal; end: the line is wiped. */
void progress_begin(void);
bool progress_wanted(void);
void progress_show(size_t done, size_t of, double share);
void progress_count(size_t done, size_t of);
void progress_end(void);
/* Prints the text, and clears it. */
void print_text(struct text *t);
/* The same, with lines that are wider than the terminal broken at blanks; as they are where there is no terminal. */
void terminal_print(struct text *t);
/* Lines with the marks of audit_explain as colours, where the terminal has them. */
void terminal_print_marked(const char *s);
/* What a command has found, which is cleared: lines as terminal_print has them, or JSON as it is. */
void print_found(const struct options *o, struct text *found);
enum paint { PAINT_NONE, PAINT_GOOD, PAINT_BAD, PAINT_DOUBT, PAINT_HEAD };
/* The word at the right end of so many columns, with a negative width at the left. */
void paint(struct text *out, bool colours, enum paint p, const char *word, int width);
/* Says where files were written: a folder, or a file; nothing where the standard output is JSON. */
void say_written(const struct options *o, const char *where);
/* What verify prints last: failures, worst first, with what shows and mends them when proofs is true, and counts by
   section; and the line of the contract. */
void verify_tables(const struct audit_result *r, bool proofs);
void verify_line(const struct audit_result *r);

/* --- An end from outside: Ctrl-C, SIGTERM, SIGHUP, or the clock of --timeout (interrupt.c) --- */

/* From here on each of them ends the program with status 5, a message and no process left, wherever it is; a report is
   the old one or the new one, whole, and the message says which.  seconds: of the clock, 0 for none.  false when the
   clock cannot be set. */
bool interrupt_begin(double seconds);
/* Another scene begins. */
void interrupt_next(void);
void interrupt_end(void);

/* --- Files and scenes --- */

/* The score of the whole study of damages beside a report's folder, when it was made of the same paper, overlay and
   scene; false when there is none. */
bool score_beside(struct mutation_score *s, const char *folder, const struct audit_result *r);
/* Memory that GMP, MPFR, FLINT or GSL cannot have ends the program as the program's own does. */
void own_memory(void);

/* The data folder of the running program; false with d set. */
bool find_data(struct text *data, struct diag *d);
/* The scene of that name or path, with what --set changes.  scene_clear it all the same. */
bool load_scene(struct scene *s, const char *spec, const char *data, const struct options *o, enum scene_welcome any,
                struct diag *d);
/* Whether it gives e1 and e2, which the command needs; false with d set. */
bool scene_needs_forces(const struct scene *s, const char *command, struct diag *d);
/* The row of a claim in the list, and those of the claims that its restrictions make, as reports have them; false with
   d set. */
bool list_claim(struct text *out, const struct model *m, const struct claim *c, struct diag *d);
/* list --scene-keys */
int list_scene_keys(const struct options *o);
/* source_read of folder/name. */
bool read_in(struct source *s, const char *folder, const char *name, size_t max, struct diag *d);
/* folder/name into out. */
void join_path(struct text *out, const char *folder, const char *name);
/* What a command on the paper and its scene reads, with what --paper, --overlay and --set change. */
struct inputs {
  struct paper_files files;
  struct scene scene;
};
/* inputs_clear it all the same. */
bool inputs_load(struct inputs *in, const char *data, const struct options *o, struct diag *d);
void inputs_clear(struct inputs *in);
bool load_files(struct paper_files *f, const char *data, const struct options *o, struct diag *d);
/* The paper or --paper, and --overlay, with what corrects them. */
bool load_model(struct model *m, const char *data, const struct options *o, struct diag *d);

/* As many of the digits as are known; a ball in which not even the first is: 0. */
void print_known(struct text *out, const arb_struct *x, slong digits);
/* The same as a member or, without a key, an element; null for NULL. */
void json_number(struct json *j, const char *key, const arb_struct *x, slong digits);
/* An array of n of them. */
void json_numbers(struct json *j, const char *key, arb_srcptr x, slong n, slong digits);
/* An exact number to so many digits. */
void json_rational(struct json *j, const char *key, const fmpq_t q, slong digits);
/* The radius to two digits, rounded up; 0 when it is. */
void print_accuracy(struct text *out, const arb_struct *worst);
/* Raises it to the largest radius of n numbers. */
void radius_raise(mag_t radius, arb_srcptr x, slong n);
/* A radius as an accuracy. */
void print_radius(struct text *out, const mag_t radius);
/* Whether an orbit is certified, and within which radius: the members "certified" and "radius"; a line. */
void proof_json(struct json *j, bool certified, const mag_t radius);
void proof_text(struct text *out, bool certified, const mag_t radius);
/* "orbit:2" or "printed"; the same as the member "at". */
void print_at(struct text *out, const struct jacobian_request *q);
/* The same, with "(not admissible)" where a condition of the motion fails on the scene's orbit. */
void print_orbit_at(struct text *out, const struct jacobian_request *q, const struct scene *s);
void json_at(struct json *j, const struct jacobian_request *q);
/* Begins the object of what is computed with the model at a scene: scene and layer. */
struct json json_of_model(struct text *out, const struct scene *s);
/* The eigenvalues of a 2x2 matrix by GSL, two texts: real numbers, or "a+bi" and "a-bi". */
bool print_eigenvalues(struct text out[2], arb_srcptr j);
/* The same as lines, with what is exact; of: "of J " or "". */
void eigenvalues_text(struct text *out, const char *of, arb_srcptr j, slong digits);
/* jacobian --phases */
void show_phases(const struct options *o, const struct model *m, const struct scene *s,
                 const struct jacobian_request *q, struct diag *d);

/* true, false or null. */
void json_truth(struct json *j, const char *key, truth t);
/* What a truth about stability is called, in the paper's words and in a table; and one about admissibility. */
extern const char *const stability_name[TRUTH_UNKNOWN + 1], *const fate_name[TRUTH_UNKNOWN + 1],
                                                                *const admissibility_name[TRUTH_UNKNOWN + 1];

/* verify --plan. */
int show_plan(const struct model *m, const struct claims *claims, const struct claims *controls, const struct scene *s,
              const struct audit_options *opt, bool json, struct diag *d);
/* orbit --method paper. */
int run_orbit_paper(const struct options *o, const char *data, struct diag *d);
/* orbit on a scene with intervals. */
int show_box(const struct options *o, const struct scene *s, slong digits);
/* orbit and jacobian on a scene that names a system file or another word than the paper's. */
int run_proved_orbit(const struct options *o, const struct scene *s, const char *data, slong digits, struct diag *d);
int run_proved_jacobian(const struct options *o, const struct scene *s, const char *data,
                        const struct jacobian_request *asked, struct diag *d);
/* Along which line bifurcate looks: the member "along"; and how much it has found on it, as a line. */
void along_json(struct json *j, const char *name, const fmpq_t from, const fmpq_t to, slong digits);
void along_text(struct text *out, const struct scene *s, const char *name, const fmpq_t from, const fmpq_t to,
                long changes, long branches);
/* words and bifurcate on a scene that names a system file. */
int run_system_bifurcate(const struct options *o, const struct scene *s, const char *data, slong digits,
                         struct diag *d);
/* longest: of --longest, where it is given. */
int run_system_words(const struct options *o, const struct scene *s, const char *data, int longest, slong digits,
                     struct diag *d);

#endif
