/* The kinds of claims, a row for each: what a claim of that kind is judged by, and how.

     tried at points  it can be restricted, corrected by an erratum, and refuted with little effort
     asked            when it is asked about a damaged formula
     of scene         it is about the numbers of one scene, unless it has its own (at), and of a box says nothing
     parts            those of work.h that it may need besides what its points are; what needs some works in balls
     fault            the class of its refutations; FAULT_BY_EDIT: what the correction says of it (fault.c)
     controls         the fewest controls on file where there is a claim of the kind
     of model         it is always about the model's system; the others are about what their points are
     own record       it judges a record, which is that of the claim's own id unless statement or value says otherwise
     attributes       that claims of the kind have besides those of all claims

   The judge of a row is a function of judge/judge.h, which alone looks at that column. */
#ifndef STICKSLIP_KINDS_H
#define STICKSLIP_KINDS_H

#include "base/work.h"
#include "claims.h"
#include "record/result.h"

enum {
  NEEDS_PHASES = 1U << WORK_PHASE_D | 1U << WORK_PHASE_GAMMA | 1U << WORK_PHASE_H | 1U << WORK_PHASE_C,
  NEEDS_SCENE = 1U << WORK_SCENE_ORBITS,
  NEEDS_OTHER = 1U << WORK_OTHER_ORBITS,
  NEEDS_POOL = 1U << WORK_ORBIT_POOL,
  NEEDS_MOTION = 1U << WORK_SIMULATION,
  NEEDS_ALGEBRA = 1U << WORK_ALGEBRA
};

/* Asked about a damaged formula at once; after the others, by EFFORT_REFUTE alone; or never, since it simulates and
   reads no formula that others do not read, or asserts nothing. */
enum asked { ASKED_EARLY, ASKED_LATE, ASKED_NEVER };

/* K(name, word in files, judge, tried at points, asked, of scene, parts, fault, controls, of model, own record,
     attributes) */
#define CLAIM_KINDS(K)                                                                                                 \
  K(DEFINITION, "definition", judge_definition, false, ASKED_EARLY, false, 0, FAULT_NOTATION, 0, false, true,          \
    "statement value")                                                                                                 \
  K(MATRIX, "matrix", judge_points, true, ASKED_EARLY, false, NEEDS_SCENE | NEEDS_ALGEBRA, FAULT_BY_EDIT, 1, true,     \
    false, "value points routes oracle perturbation")                                                                  \
  K(IDENTITY, "identity", judge_points, true, ASKED_EARLY, false, NEEDS_SCENE | NEEDS_ALGEBRA, FAULT_BY_EDIT, 1,       \
    false, true, "statement points routes oracle perturbation")                                                        \
  K(SHARP, "sharp", judge_points, true, ASKED_EARLY, false, NEEDS_SCENE | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true,      \
    true, "statement points routes perturbation")                                                                      \
  K(INEQUALITY, "inequality", judge_inequality, false, ASKED_EARLY, true, NEEDS_PHASES | NEEDS_SCENE, FAULT_NUMBER, 1, \
    false, true, "statement points routes")                                                                            \
  K(INDEX_RANGE, "index-range", judge_index_range, false, ASKED_EARLY, false, 0, FAULT_NOTATION, 1, true, true,        \
    "statement letter range repaired-range")                                                                           \
  K(NUMBER, "number", judge_number, false, ASKED_EARLY, true, NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER, FAULT_NUMBER,  \
    1, true, false, "number from formula relation also-printed")                                                       \
  K(CLOSURE, "closure", judge_closure, false, ASKED_EARLY, true, NEEDS_PHASES | NEEDS_SCENE, FAULT_NUMBER, 1, true,    \
    false, "")                                                                                                         \
  K(CRITERION, "criterion", judge_criterion, false, ASKED_LATE, false,                                                 \
    NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER | NEEDS_MOTION | NEEDS_ALGEBRA, FAULT_FORMULA, 1, true, true,             \
    "statement at side")                                                                                               \
  K(BEHAVIOUR, "behaviour", judge_behaviour, false, ASKED_NEVER, false,                                                \
    NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER | NEEDS_MOTION | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true, false,           \
    "check criterion states range transition limit jumps friction at vary systems")                                    \
  K(REPORT, "report", judge_report, false, ASKED_NEVER, false, NEEDS_PHASES | NEEDS_SCENE, FAULT_NUMBER, 0, true,      \
    false, "")                                                                                                         \
  K(ARGUMENT, "argument", judge_argument, false, ASKED_LATE, false,                                                    \
    NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER | NEEDS_POOL | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true, false,             \
    "premises conclusion statement over friction increasing repair converse converse-of")                              \
  K(NOTATION, "notation", judge_notation, false, ASKED_EARLY, false, 0, FAULT_NOTATION, 1, false, false,               \
    "reads repaired repaired-as symbols stands-for found-in")                                                          \
  K(SCALING, "scaling", judge_scaling, false, ASKED_LATE, false, 0, FAULT_BY_EDIT, 1, false, false,                    \
    "scaled statement repaired repaired-as")                                                                           \
  K(REACH, "reach", judge_reach, false, ASKED_LATE, false, 0, FAULT_ARGUMENT, 1, false, false, "statements absent")    \
  K(RANK, "rank", judge_rank, false, ASKED_LATE, false, NEEDS_PHASES | NEEDS_OTHER | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, \
    true, true, "statement unknowns rank")                                                                             \
  K(DEFINED, "defined", judge_defined, false, ASKED_LATE, false, NEEDS_PHASES | NEEDS_OTHER | NEEDS_ALGEBRA,           \
    FAULT_ARGUMENT, 1, true, false, "statements over at vary")                                                         \
  K(CONSTRAINTS, "constraints", judge_constraints, false, ASKED_LATE, false,                                           \
    NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER | NEEDS_POOL | NEEDS_MOTION | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true,     \
    false, "constraints least-first least-second")                                                                     \
  K(SEQUENCE, "sequence", judge_sequence, false, ASKED_LATE, true,                                                     \
    NEEDS_PHASES | NEEDS_SCENE | NEEDS_OTHER | NEEDS_MOTION | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true, false,           \
    "word constraints")                                                                                                \
  K(SOLUTIONS, "solutions", judge_solutions, false, ASKED_NEVER, true,                                                 \
    NEEDS_PHASES | NEEDS_OTHER | NEEDS_MOTION | NEEDS_ALGEBRA, FAULT_ARGUMENT, 1, true, true,                          \
    "statement count every given until kept constraints at")                                                           \
  K(RANGE, "range", judge_range, false, ASKED_LATE, false, NEEDS_PHASES | NEEDS_OTHER | NEEDS_POOL | NEEDS_ALGEBRA,    \
    FAULT_ARGUMENT, 1, true, false, "premises conclusion even odd factor frequency drift rate from")                   \
  K(LAW, "law", judge_law, false, ASKED_EARLY, false, NEEDS_MOTION, FAULT_FORMULA, 1, true, false,                     \
    "mass moves slips sticks breaks heading limits")                                                                   \
  K(OUTSIDE, "outside", judge_outside, false, ASKED_NEVER, false, 0, FAULT_ARGUMENT, 0, false, false, "needs")

enum kind {
#define KIND_ENUM(name, ...) KIND_##name,
  CLAIM_KINDS(KIND_ENUM)
#undef KIND_ENUM
      N_KINDS
};

struct claim_kind {
  const char *word;
  bool tried_at_points;
  enum asked asked;
  bool of_scene;
  unsigned parts;
  enum fault fault;
  int controls;
  bool of_model, own_record;
  const char *attributes;
};
extern const struct claim_kind claim_kinds[N_KINDS];

/* What is said of a claim whose kind is none: all that there are. */
extern const char claim_no_kind[];

/* N_KINDS: its file names none that there is. */
enum kind claim_kind(const struct claim *c);
/* NULL likewise. */
const struct claim_kind *claim_kind_of(const struct claim *c);
bool claim_tried_at_points(const struct claim *c);
/* Does it judge a record, of which its own id says which? */
bool claim_judges_its_id(const struct claim *c);
/* Is it judged of the numbers of one scene: by its kind, unless it has its own, or by its attribute over or check? */
bool claim_of_scene(const struct claim *c);
/* Is it of admissible solutions alone, as one is that may say of which (over) and does not? */
bool claim_over_admissible(const struct claim *c);
/* Where it is tried and by what besides balls, in the words of its attributes points and routes; without these, of a
   matrix params 24 by taylor, gsl and ode, of an identity arcs 12 and orbits 6 by exponential, as a sharp one is, or
   where it has that attribute by oracle, on orbits alone by system too; NULL: its kind is not tried so. */
const char *claim_points_asked(const struct claim *c);
/* One item of the former, "arcs Gamma 12"; n is 0 where it is none. */
struct asked_points {
  char word[16], phase[16]; /* "" for no phase */
  long n;
};
/* The first item of the list; where the rest begins, or NULL where there is none. */
const char *claim_next_points(struct asked_points *out, const char *list);
const char *claim_routes_asked(const struct claim *c);
enum asked claim_asked(const struct claim *c);

#endif
