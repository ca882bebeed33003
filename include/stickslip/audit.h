/* The audit: claims as data, evidence from independent routes, one table from evidence to verdict.

   A claim file holds records "claim ID" with these attributes:

     equation, section, title, quote   where the claim stands and what it says
     own         the equation number whose text is read as printed; by default that of the claim
     kind        one of the kinds below
     value       (matrix) the name, with its argument, held against the model's quantity of that name
     statement   (identity, inequality, threshold, sharp, criterion) the record of the equation files that is judged
     bound       (threshold) the record whose right-hand sides are the bounds
     points      where: "params N", "flow PHASE N", "arcs [PHASE] N", "orbits [PHASE] N",
                 "admissible [PHASE] N" (orbits that break no condition), "realistic [PHASE] N" (those, with friction a
                 quarter above what they ask), "patched [PHASE] N" (any state, carried by the linear systems of the four
                 phases over any times, and any perturbations), joined by ","; the time t lies in that phase
     perturbation  finite: dZ_0, dZ_a, ... are differences of two motions; else the first order of them
     routes      what is asked besides balls: taylor gsl ode newton saltation fd exponential oracle
     oracle      (route oracle) names whose paper formulas are replaced by the model's matrices
     number, from, formula             (number) the printed number, where its value comes from
     relation    (number) "<" or ">": the number is a bound; else it is a value
     formula     (report) the trace that decides
     fault       the fault class a refutation of this claim has
     depends-on  ids of claims that an argument uses and no formula shows; what the formulas reach is computed
     restricted  "V = 1: supported: eq-10b; ...": verdict on record and id of the claim that is made when this one is
                 refuted on its domain but holds under a restriction
     check       (behaviour) modes, closed-forms, configurations, dimension, linear, switches, jumps, small, fixed-points,
                 linearization, equality, perturb, long-run, patching
     at          (criterion; perturb, equality) "chi = 2/3, eta = 2, V = 1, e1 = 2, e2 = 1/4; ...": parameters to try
     vary        (equality) for each entry of at, "e2 from 3/4 to 1": the parameter along which tr J = -1 is looked for
     side        (criterion) inside or outside: the orbits that the claim speaks of, by the slope of the return map
     range       (dimension) "2 4"; transition (switches) "slip to stick" or "stick to slip", limit u_s or u_r; jumps
                 (linearization) saltation; friction (long-run) "1.25 2", in units of what the orbits need
     premises, conclusion  (argument) records, "eq-52, eq-59#1.2, eq-56 D": #1.2 is the second step of the first statement,
                 D the phase of the time t where the record names none
     over        (argument) admissible (default), orbits, or scene: the orbit nearest to the printed numbers
     friction    (argument) free: u_r1, u_r2 need not exceed e_1, e_2
     increasing  (argument) "h Gamma": the mean value theorem for h(t) in that phase may be used
     repair      (argument) premises that the corrected argument has besides
     converse    (argument) yes: the inequalities among the premises must follow from the conclusion too
     mass, slips, sticks, breaks  (law) "1" or "2", and the statements of (2) for that mass, as in premises: its friction while
                 it slips (eps being the sign of V - x'), while it sticks and where it breaks away
     reads, repaired       (notation) the text as printed, and as it should read, in the language of expr.h
     symbols, stands-for, found-in, repaired  (notation) lists with ";": symbols, what each is said to mean, and the place,
                 "quote" or a record, that prints it
     scaled      (scaling) prefixes of the names that are multiplied; of one statement, or of all; repaired: those of the
                 correction
     statements, absent    (reach) records, and the symbols that they must not contain
     unknowns, rank        (rank) of the statement's equations
     word, conditions      (sequence) phases of one period; inequalities along it
     given, through        (existence) "t_a = 0, t_b = 2" at the scene's chi, eta, V; the phases that lead back to the start
     constraints, least-first, least-second  (constraints) records as in premises; closed forms of the least u_r1, u_r2
     needs       (outside) what a decision would take
     record      the verdict on record; record-scene: the only scene it speaks of

     about       names of definitions that the sentence asserts something of, besides its value; (number) another
                 symbol for the number

   Records "result ID" (section, title, formula) name what the paper derives and a reader uses: each is evaluated with a
   failed formula as printed and as corrected.

   Kinds: definition, matrix, identity, inequality, threshold, sharp (each step of the statement's inequalities becomes an
   equality at one end of the phase that points name), index-range, number, closure, criterion, behaviour, argument,
   notation, scaling, reach, rank, sequence, existence, constraints, law, outside, report.

   What is not done.  Precision rises at a point only while it is undecided there.  A difference in balls decides a claim, yet
   its other points and routes are tried all the same, since the evidence says at how many points it differs and where the
   most; a control, and a damaged formula, of which only the verdict is told, ends where nothing but a refutation can come of
   it.  A route that would add no independence is not asked for: any two of a claim's routes, balls among them, are
   independent by the table of src/route/routes.h (tests/check_plan.c). */
#ifndef STICKSLIP_AUDIT_H
#define STICKSLIP_AUDIT_H

#include "stickslip/coulomb.h"
#include "stickslip/model.h"
#include "stickslip/mutation.h"
#include "stickslip/paper_route.h"
#include "stickslip/result.h"
#include "stickslip/scene.h"
#include "stickslip/stability.h"

struct claim {
  const char *id;
  const struct record *record;
  const struct record_file *file;
  const struct record *control; /* attributes that stand before the record's own; NULL outside controls */
};

struct claims {
  struct record_file **files;
  size_t n_files, cap_files;
  struct claim *claim;
  size_t n, cap;
  struct claim *result; /* of files of claims */
  size_t n_results, cap_results;
};

enum { MAX_CLAIM_FILE = 4 << 20 };

/* Loads every *.claim file of a folder, in the order of their names.  `kind` is the record kind: claim or control. */
bool claims_load(struct claims *c, const char *folder, const char *kind, struct diag *d);
/* Those of a folder of the data folder. */
bool claims_load_data(struct claims *c, const char *data, const char *folder, const char *kind, struct diag *d);
bool claims_add_file(struct claims *c, const char *path, const char *kind, struct diag *d);
void claims_clear(struct claims *c);

/* An attribute of the claim, or NULL. */
const char *claim_get(const struct claim *c, const char *key);
/* Whose text the claim reads as printed: the equation number of its attribute own, else its own, else its id. */
const char *claim_own(const struct claim *c);
/* Does --only with this item select the claim?  eq-27 selects eq-27, eq-27b, eq-27-..., not eq-270. */
bool claim_selected(const char *id, const char *item);
/* Does a scene with this item in its list "ask" ask for the claim?  The item is as above, or a group of claims:
   claim_groups_print names them all, "matrices, section NAME, ...".  Sections have their names in the claim files, or their
   numbers among them, 1 to 8. */
bool claim_asked_for(const struct claim *c, const char *item);
/* Is the item a group, whether or not any claim belongs to it? */
bool claim_group_known(const char *item);
void claim_groups_print(struct text *out);
/* Whether each item that the scene asks for selects some claim and names some quantity; false with d set, at the place in
   the scene's file or option. */
bool scene_check_asked(const struct scene *s, const struct claims *c, const struct model *m, struct diag *d);

/* What pieces of an audit were measured to cost, by a table of tab-separated rows "what, name, units, milliseconds"
   (verify/costs.tsv, made by "stickslip bench --job costs").  It decides which piece comes first and how long the rest may
   take, and nothing else. */
struct cost {
  char what[16], name[48]; /* claim eq-27; control ctl-...; consequence eq-40; study routes */
  double units, ms;
};
struct costs {
  struct cost *row;
  size_t n, cap;
};
/* No file at path: no rows.  false with d set when it cannot be read or is no such table. */
bool costs_load(struct costs *c, const char *path, struct diag *d);
void costs_clear(struct costs *c);
/* The row, or NULL; costs may be NULL. */
const struct cost *cost_of(const struct costs *c, const char *what, const char *name);

/* What an audit or a study of damages is of, as a number in hexadecimal digits: the same for formulas of the paper and its
   overlay that are read alike, and a scene of the same parameters, printed numbers and word; errata, claims and what is
   asked for have no part in it. */
void audit_fingerprint(struct text *out, const struct model *m, const struct scene *s);

struct audit_options {
  const char *const *only;
  int n_only;
  /* Or NULL: pieces that are done, of all that are known so far, and the part of the expected cost that they were. */
  void (*progress)(void *arg, size_t done, size_t total, double share);
  void *arg;
  bool readings; /* search how the printed numbers arose, when claims about them are selected */
  int jobs;      /* processes; 0 and 1: this one alone */
  /* Or NULL: told of each piece, by its names in the table of costs, when this process has done it. */
  void (*ended)(void *arg, const char *what, const char *name, unsigned long long units);
  const struct costs *costs;   /* or NULL */
  double (*seconds_now)(void); /* seconds, for what run.json says of the pieces; or NULL */
};

/* Judges the claims that are selected (by --only and, where the scene asks for some, by the scene: those that both name),
   then the controls that stand beside them; the same bytes for any number of jobs.  A scene's budget is for each claim and
   each control: what runs out of it is unknown.  false with d set when the claim files or the equation files are at
   fault. */
bool audit_run(struct audit_result *out, const struct model *m, const struct claims *claims,
               const struct claims *controls, const struct scene *scene, const struct audit_options *opt,
               struct diag *d);
/* Kills the processes that a run has made; for a signal's handler that ends the program. */
void audit_abandon(void);

/* --- The audit of the audit --- */

struct mutation_options {
  unsigned long long seed;
  long count;              /* mutants drawn, in the order of the files; 0: all */
  int jobs;                /* processes, 1 to 64 */
  const char *const *only; /* equation files or records */
  int n_only;
  void (*progress)(size_t n, size_t of); /* or NULL */
};

/* Damages the formulas of the paper one token at a time (edit.h), each as an overlay of one statement, and asks the claims
   that read it, those with the fewest definitions first, until a verdict changes: that of the claim, of its correction or
   of a restricted claim.  The text damaged is the one that everything reads, the errata's where they correct the paper;
   the printed text that they correct is damaged too and counted apart.  What survives is compared with the original by
   exact algebra, then judged in full.  The result is the same for any number of processes.  false with d set when the
   files are at fault or a process ended early. */
bool audit_mutate(struct mutation_result *out, const struct model *m, const struct claims *claims,
                  const struct scene *scene, const struct mutation_options *opt, struct diag *d);

/* Searches repairs of the refuted claims about formulas (all, or those selected): the claim's printed text with every one
   edit, and where none helps, or the correction on file is not among those that do, with pairs of exchanged names within a
   budget; those with which the claim passes the checks that
   refuted it, the smallest first. */
bool audit_repairs(struct repair_result *out, const struct model *m, const struct claims *claims,
                   const struct scene *scene, const struct audit_options *opt, int jobs, struct diag *d);
/* How the printed numbers of the scene could have arisen: which of them were inputs, exactly as printed, which equations
   were solved and which dropped, how numbers were carried from one formula into the next.  The equations are the paper's,
   (12), (14), (16), (18), (44)-(46), with its matrices in the corrected layer, and in the printed one where that gives
   another motion.  Double precision narrows down, balls decide.  Returns NULL, or why there was nothing to search. */
const char *audit_readings(struct audit_result *out, const struct model *m, const struct scene *s);

/* One claim for a reader: the paper's text, the formula as read (LaTeX), where and how it is tried, its verdict and
   evidence now, both sides in each number type at the scene's parameters changed by at ("chi=1/2,V=2", or NULL), and the
   tape when asked for. */
/* A proof as a Python script that needs SymPy alone, ends with the text of verify/receipt/model.py and prints "ID: proved".
   false with d set when the claim is not proved by exact algebra, neither as printed nor as corrected. */
bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *model_py, struct diag *d);
bool audit_explain(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *at, bool tape, struct diag *d);

/* The orbits of the scene, by increasing z10, from whichever two quantities it gives; flags as dyn_orbits_find and
   dyn_orbits_given return them. */
int audit_orbits(struct dyn_orbits *list, const struct scene *s, slong prec);
/* Decides whether such a list is complete, and adds what it lacks: complete.h. */
void audit_orbits_complete(struct dyn_orbits *list, const struct scene *s, slong prec);

/* --- The paper's own route (44)-(46) at a scene --- */

/* One run of Newton's iteration.  The route may be used after SS_OK; distance is an upper bound of the largest
   difference between its six numbers and those of the nearest of the model's orbits. */
enum { PAPER_START_MOVED = 2 }; /* by how much every time of an orbit is moved for a start, in per cent */
struct paper_orbit {
  slong from; /* the orbit whose times were moved, from 0; -1: the printed times */
  double guess[4];
  int status;
  struct paper_route route;
  slong nearest; /* from 0; -1 when there is none */
  arb_t distance;
};
struct paper_orbits {
  struct paper_orbit *item;
  size_t n, cap;
};
/* From the printed times when the scene prints all four, else from the moved times of each orbit that the model finds.
   Where the scene does not give e1 and e2, those of each of its orbits are taken (the middle of their enclosure) and
   there is one run for each.  false with d set when there is nowhere to start; clear it all the same. */
bool audit_paper_orbits(struct paper_orbits *out, const struct scene *s, slong prec, struct diag *d);
void paper_orbits_clear(struct paper_orbits *p);

/* --- The scene under Coulomb's law --- */

struct coulomb_setup {
  double params[N_COULOMB], start[N_STATE];
  double period;     /* of the orbit; at printed numbers of the first orbit; 0 when there is none */
  double trace;      /* tr J of the orbit; NaN at printed numbers */
  bool own_friction; /* some u_r is ours, 5/4 max(e_i, u_ri_min of the orbits in question), not the scene's */
};
/* orbit counts from 0, as in struct jacobian_request.  false with d set when there is no such orbit, or no printed start. */
bool audit_coulomb_setup(struct coulomb_setup *sim, const struct scene *s, slong orbit, bool printed, struct diag *d);
/* From a start of one's own, "x1,x2,v1,v2" as constant expressions; friction as at printed numbers. */
bool audit_coulomb_setup_from(struct coulomb_setup *sim, const struct scene *s, const char *start, struct diag *d);

/* The tables that pictures of the scene's orbits are drawn from, into out->tables; NULL, or why there are none. */
const char *audit_tables(struct audit_result *out, const struct scene *scene);

/* --- The 2x2 Jacobian of the map (x, y) -> (x_f, y_f) --- */

enum jacobian_method {
  METHOD_ANALYTIC,
  METHOD_IMPLICIT,
  METHOD_SALTATION,
  METHOD_FD,
  METHOD_FD_DOUBLE,
  METHOD_ODE,
  N_METHODS
};
extern const char *const method_name[N_METHODS];
extern const char *const method_accuracy[N_METHODS]; /* what the accuracy of a method consists of, in words */

struct jacobian_request {
  enum jacobian_method method;
  enum layer layer; /* of the paper's chain, METHOD_ANALYTIC */
  bool at_printed;  /* at the scene's printed numbers, else on an orbit */
  slong orbit;      /* from 0, by increasing z10, in the list that `orbit` shows: with what the search alone misses */
  slong digits;
};

/* j (4 balls, row-major), trace and det, good for the digits asked for where the method reaches them; the radius of a ball
   is the accuracy that the method states (differences: an estimate).  METHOD_ANALYTIC: the paper's J_f J_c J_b J_a; at
   printed numbers its states are those at the printed times.  The other methods start at the printed state and locate the
   events.  METHOD_FD_DOUBLE works in double precision, METHOD_ODE integrates (1)-(2); they give the digits they have,
   about eleven and eight, whatever is asked for, and their accuracy holds what rounding the inputs to doubles does.  det is exactly 0 wherever the method proves or confirms it (all that
   precedes t_a is a map to one number).  A scene that does not give e1 and e2 has those of its orbit, at printed numbers
   the printed ones.  false with d set on failure. */
bool audit_jacobian(arb_ptr j, arb_t trace, arb_t det, const struct model *m, const struct scene *s,
                    const struct jacobian_request *q, struct diag *d);
/* trace and det of a 2x2 matrix of balls, det as above. */
void jacobian_invariants(arb_t trace, arb_t det, arb_srcptr j);
/* The largest radius, exactly. */
void jacobian_accuracy(arb_t worst, arb_srcptr x, slong n);

/* The local Jacobians J_a, J_b, J_c, J_f of the phases and J of the period, by every method side by side. */
enum { N_COLUMNS = N_METHODS + 1, N_MATRICES = N_PHASES + 1, MATRIX_MOST = 6 };
struct jacobian_column {
  const char *name, *heading;
  enum jacobian_method method;
  enum layer layer;
};
extern const struct jacobian_column
    jacobian_columns[N_COLUMNS]; /* the paper's chain is there as printed and corrected */
struct jacobian_matrix {
  const char *name, *phase; /* phase: NULL for J */
  int rows, cols;
  bool known[N_COLUMNS];
  arb_ptr entry[N_COLUMNS];             /* row-major balls; the radius is the accuracy */
  bool departs[N_COLUMNS][MATRIX_MOST]; /* disjoint from more than half of the other methods that are known */
};
struct jacobian_phases {
  struct jacobian_matrix matrix[N_MATRICES];
  int known; /* how many matrices of any method */
};
void jacobian_phases_init(struct jacobian_phases *p);
void jacobian_phases_clear(struct jacobian_phases *p);
/* method and layer of the request are not looked at.  At printed numbers the paper's formulas stand at other states than
   the methods that locate events (see audit_jacobian). */
bool audit_phases(struct jacobian_phases *out, const struct model *m, const struct scene *s,
                  const struct jacobian_request *q, struct diag *d);

/* --- Digits --- */

struct stability_options {
  enum layer layer;        /* whose formulas are studied */
  int after;               /* a layer whose formula of the same name is held against each at the worst points; -1 */
  const char *const *only; /* ids of formulas, matrices or records; none: all */
  int n_only;
  bool quick;
  int jobs;                              /* processes, 1 to 64 */
  void (*progress)(size_t n, size_t of); /* or NULL */
};

/* Where the paper's formulas lose digits in double precision, by how many, and why (stability.h).  Everything is the same for
   any number of processes; the last bits of the C library's sines and cosines decide about some of the search's steps.
   false with d set when the files are at fault, nothing is selected or a process ended early. */
bool audit_stability(struct stability_result *out, const struct model *m, const struct stability_options *opt,
                     struct diag *d);
/* The selected formulas at one point, "chi=0x1.8p-1,t=2": value, true value, error, conditioning by each input, cause. */
bool audit_stability_at(struct text *out, const struct model *m, const struct stability_options *opt, const char *at,
                        struct diag *d);

/* Reads a file as what its suffix says, .eq (over the paper's files), .claim or .scene, and checks all that can be checked
   without judging: syntax, names, shapes, attributes. */
bool audit_check_file(const char *path, const char *data, struct diag *d);

#endif
