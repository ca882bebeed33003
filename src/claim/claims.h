/* Claims as data.

   A claim file holds records "claim ID" with these attributes:

     equation, section   where the claim stands: the equation, where its id does not have it (base/record.h); the
                 section, where the file does not say it before its first record
     title       (outside, and where the other attributes make none) what it says, in words; value/title.h says how
                 titles are made, and what stands in braces in one that is given
     quote, place   what the paper says, to the letter, and where in its text (quote/quote.h); or "quote: statement" for
                 the words of the statement that names the claim (claim.h)
     own         the equation number whose text is read as printed; by default that of the claim
     kind        one of the kinds below
     value       (matrix) the name, with its argument, held against the model's quantity of that name
     statement   (identity, inequality, sharp, criterion, rank, index-range, solutions, definition) the record of the
                 equation files that is judged; without it that of the claim's id
     points      where: "params N", "flow PHASE N", "arcs [PHASE] N", "orbits [PHASE] N",
                 "admissible [PHASE] N" (orbits that break no condition), "realistic [PHASE] N" (those, with friction
                 1/4 or 1/1024 above what they need), "patched [PHASE] N" (any state, carried by the linear systems of
                 the four phases over any times, and any perturbations), joined by ","; the time t lies in that phase,
                 which a range of the statement must be, its ends left out; an inequality that is not proved is tried at
                 eight times as many points, and at parameters that are equal, small and large
     perturbation  finite: dZ_0, dZ_a, ... are differences of two motions; else the first order of them
     routes      what is asked besides balls: taylor gsl ode newton saltation system fd exponential oracle; without
                 points or routes those of kinds.h
     oracle      (route oracle) names whose paper formulas are replaced by the model's matrices
     number, from, formula             (number) the printed number, where its value comes from
     relation    (number) "<" or ">": the number is a bound; else it is a value
     formula     (report) the trace that decides; (number, result) "eq-53#2": what that statement sets beside a
                 symbol
     few         why the claim asks for fewer points or routes than its kind does (kinds.h)
     depends-on  ids of claims that an argument uses and no formula shows; what the formulas reach is computed
     restricted  "V = 1: supported: eq-10b; ...": verdict on record and id of the claim that is made when this one is
                 refuted on its domain but holds under a restriction
     check       (behaviour) one of checks.h
     at          (criterion; perturb, equality) "chi = 2/3, eta = 2, V = 1, e1 = 2, e2 = 1/4; ...": parameters to try;
                 this list, constraints, slips, sticks and breaks may be "as ID", those of that claim
     vary        (equality) for each entry of at, "e2 from 3/4 to 1": the parameter along which tr J = -1 is looked for
     criterion   (equality) the record of which it says what holds otherwise; where that takes tr J = -1 in, the claims
                 of kind criterion look along these families
     side        (criterion) inside or outside: the orbits that the claim speaks of, by its sentence
     systems     (patching) scenes of systems of more masses, names in the folder of the claim's own data
     states      (dimension, fixed-points) the conditions of the four phases, as in premises
     range       (dimension) "2 4"; transition (switches) "slip to stick" or "stick to slip", limit u_s or u_r; jumps
                 (linearization) saltation; friction (long-run) "1.25 2", in units of what the orbits need
     premises, conclusion  (argument) records, "eq-52, eq-59#1.2, eq-56 D": #1.2 is the second step of the first
                 statement, D the phase of the time t where the record names none; a range over several phases is each
                 of them and the moments between (one that begins with D where t_a > 0 is known); kind range takes one
                 phase
     over        (argument) admissible (default), orbits, or scene: the orbit nearest to the printed numbers
     friction    (argument) free: u_r1, u_r2 need not exceed e_1, e_2
     increasing  (argument) "h Gamma": the mean value theorem for h(t) in that phase may be used
     repair      (argument) further premises with which the conclusion follows: the condition, and the correction; what
                 every motion fulfils, as is proved of equations and of what holds along a phase, is not named
     repaired-as (notation, scaling) the claim that judges the corrected text: a criterion reads it as its statement, a
                 law as its heading or, with ";", as the names of its friction; another scaling knows the degrees
     converse    (argument) yes: the inequalities among the premises must follow from the conclusion too
     converse-of (argument) the claim whose argument this one turns round: neither rests on the other
     mass, slips, sticks, breaks  (law) "1" or "2", and the statements of (2) for that mass, as in premises: its
                 friction while it slips (eps being the sign of V - x'), while it sticks and where it breaks away
     moves       (law) the mass's equation of motion, as in premises, for claims of kind behaviour
     heading     (law) the condition over the branches of a mass that has the belt's velocity
     limits      (law) yes: the states in which the restoring force is equal to its limit, instead of all others
     reads, repaired       (notation) the text as printed, and as it should read, in the language of expr.h
     symbols, stands-for, found-in, repaired  (notation) lists with ";": symbols, what each is said to mean, and, where
                 it is not the quotation for all, the place that prints it, "quote" or a record
     scaled      (scaling) prefixes of the names that are multiplied; of one statement, or of all; repaired: those of
                 the correction
     statements, absent    (reach) records, and the symbols that they must not contain
     statements, over      (defined) records whose quotients, roots, cotangents and inverses must have a value on every
                 admissible (default) or every (orbits) periodic solution, or for all parameters (parameters);
                 at, vary: a family of orbits along which one of the divisors changes its sign, or at whose end z_1'
                 only touches V and it is zero
     unknowns, rank        (rank) of the statement's equations, and how many of them are functionally independent: the
                 rank of their derivative on an open and dense set (not decided where it is smaller on the solutions of
                 the equations themselves, as for x = y with x^2 = y^2, which follows from it)
     frequency, factor, even, odd, drift  (range) formulas of the closed form that the margin of the conclusion has,
                 with premises (one, or none), from (end) and rate (yes), see proof/exact_range.h; without them 1, 1,
                 0, 0, 0
     word        (sequence) phases of one period, along which the constraints hold
     count       (solutions) how many solutions with positive times the statement's equations have; or
     every       (solutions) first: the events of each are first ones; motion: each is a motion under Coulomb's law; or
     given       (solutions) "t_a = 0, t_b = 2" at the scene's chi, eta, V: some solution has these and keeps the
                 constraints
     until       (solutions) t_c up to this; kept: yes, those alone that keep the constraints, whatever their t_c
     constraints  (constraints, solutions, sequence) records as in premises
     least-first, least-second  (constraints) closed forms of the least u_r1, u_r2, or statements as in formula
     needs       (outside) what a decision would take
     record      the verdict on record, of the paper's example where the claim is judged of one scene;
                 correction: unknown, where nothing decides that what errata.eq holds for it is right

     A file of controls begins with "count: N", how many it holds.  A record "control ID" has the claim that it damages,
     attributes in the place of the claim's own, and perhaps

     of          correction: what is damaged is the correction that the claim's file holds, which must be refuted
     near        1e-30: the most by which the damage changes a side of the claim's sentence; it is measured, and the
                 control is decided by the decisive route alone
     shift       (number, closure) units of the last decimal by which the printed number is moved

     For a formula that no control on file damages the program makes one (near.h).

     about       names of definitions that the sentence asserts something of, besides its value; (number) another
                 symbol for the number

   Records "result ID" (section, title, formula) name what the paper derives and a reader uses: each is evaluated with a
   failed formula as printed and as corrected.

   Kinds: definition, matrix, identity, inequality, sharp (each step of the statement's inequalities becomes
   an equality at one end of the phase that points name), index-range, number, closure, criterion, behaviour, argument,
   notation, scaling, reach, rank, defined, sequence, constraints, solutions, range, law, outside,
   report.

   What is not done.  Precision rises at a point only while it is undecided there.  A difference in balls decides a
   claim, yet its other points and routes are tried all the same, since the evidence says at how many points it differs
   and where the most; a control, and a damaged formula, of which only the verdict is told, ends where nothing but a
   refutation can come of it.  A route that would add no independence is not asked for: any two of a claim's routes,
   balls among them, are independent by the table of src/record/routes.h (tests/check_plan.c). */
#ifndef STICKSLIP_CLAIM_CLAIMS_H
#define STICKSLIP_CLAIM_CLAIMS_H

#include "base/record.h"
#include "base/text.h"

struct claim {
  const char *id;
  const struct record *record;
  const struct record_file *file;
  const struct record *control;   /* attributes that stand before the record's own; NULL outside controls */
  const struct record *statement; /* of the paper, the first that names the claim; NULL: none is known */
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

/* Loads every *.claim file of a folder of the data folder, in the order of their names.  kind is that of the records:
   claim, control, statement or root, the last two in files *.statements and *.roots. */
bool claims_load(struct claims *c, const char *data, const char *folder, const char *kind, struct diag *d);
/* The same with the file at `path` (or NULL) read in the place of that of its name, if there is one. */
bool claims_load_around(struct claims *c, const char *data, const char *folder, const char *kind, const char *path,
                        struct diag *d);
bool claims_add_file(struct claims *c, const char *path, const char *kind, struct diag *d);
/* A text that messages call by the name. */
bool claims_add_text(struct claims *c, const char *name, const char *text, const char *kind, struct diag *d);
/* Gives each claim its statement. */
void claims_take_words(struct claims *c, const struct claims *statements);
/* The same, unless there are none (NULL), and the lists that it shares with another; those of a control stand as they
   are. false with d set when that has none. */
bool claims_complete(struct claims *c, const struct claims *statements, struct diag *d);
void claims_clear(struct claims *c);

/* An attribute of the claim, or NULL. */
const char *claim_get(const struct claim *c, const char *key);
/* Whether it has this attribute, with these words. */
bool claim_says(const struct claim *c, const char *key, const char *words);
/* The section whose names it reads; "" without one. */
const char *claim_section(const struct claim *c);
/* Whose text the claim reads as printed: the equation number of its attribute own, else its own, else its id. */
const char *claim_own(const struct claim *c);
/* Does --only with this item select the claim?  eq-27 selects eq-27, eq-27b, eq-27-..., not eq-270. */
bool claim_selected(const char *id, const char *item);
/* Does a scene with this item in its list "ask" ask for the claim?  The item is as above, or a group of claims:
   claim_groups_print names them all, "matrices, section NAME, ...".  Sections have their names in the claim files, or
   their numbers among them, 1 to 8. */
bool claim_asked_for(const struct claim *c, const char *item);
/* Is the item a group, whether or not any claim belongs to it? */
bool claim_group_known(const char *item);
void claim_groups_print(struct text *out);

#endif
