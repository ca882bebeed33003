/* What the parts of the study of digits share: formulas ready to be run, regions, what is lost at a point, and why. */
#ifndef STICKSLIP_STABILITY_IMPL_H
#define STICKSLIP_STABILITY_IMPL_H

#include "base/crew.h"
#include "base/random.h"
#include "digits.h"
#include "proof/stable_forms.h"
#include "record/stability_result.h"

/* Inputs of a formula, at most; coordinates of a search: two for an input, and those of a region. */
enum { DIGITS_INPUTS = 32, DIGITS_SPARE = 6, DIGITS_COORDINATES = 2 * DIGITS_INPUTS + DIGITS_SPARE };

/* What an input is, by its name: how far it may go, and whether it has a sign. */
enum input_class { INPUT_CHI, INPUT_ETA, INPUT_V, INPUT_FORCE, INPUT_TIME, INPUT_STATE, INPUT_SIGN, N_INPUT_CLASSES };

/* --- The formulas of a layer (set.c) --- */

struct digits_name {
  const struct expr *e;
  const char *name;
};

/* A scalar and where it is written. */
struct digits_source {
  const struct expr *e;
  const char *id; /* of the record in which it is written */
};

struct digits_kernel;

struct digits_formula {
  const char *id, *also, *record, *equation, *section, *text;
  slong n; /* entries */
  const struct expr **entry;
  struct tape tape;         /* every node is an output */
  slong *out;               /* the entries' nodes */
  const struct expr **node; /* the scalar of each node */
  enum input_class *input;  /* of each input */
  struct tape slopes;       /* derivative of entry i by input k at i n_inputs + k; made when first asked for */
  bool have_slopes;
  const struct digits_kernel *kernel; /* a function of the program instead: the tape holds the inputs' names alone */
  slong first;                        /* of its results, the first that is an entry */
};

/* The formulas of one layer: every definition and every side of a statement that computes something, entry by entry,
   and their matrices.  Formulas that are the same but for the names of their inputs are there once. */
struct digits_set {
  struct arena arena;
  struct elaboration el;
  struct digits_formula *formula;
  size_t n, cap;
  struct digits_name *name; /* of subexpressions that the paper names */
  size_t n_names, cap_names;
  struct digits_source *place; /* the first of a scalar counts */
  size_t n_places, cap_places;
};

bool digits_set_make(struct digits_set *s, const struct model *m, enum layer layer, struct diag *d);
void digits_set_clear(struct digits_set *s);
/* Does the operand select the formula: its id or that of its matrix, one of its other names, its record? */
bool digits_selected(const struct digits_formula *f, const char *operand);
/* Of a matrix that is there as a whole too, or of a function's results? */
bool digits_is_entry(const struct digits_formula *f);
struct digits_formula *digits_find(const struct digits_set *s, const char *id);
/* What the set of another layer has under the formula's name, where that is another formula; NULL elsewhere, and for a
   function of the program. */
struct digits_formula *digits_other(const struct digits_set *s, const struct digits_formula *f);
/* What an entry of the matrix of that id and size is called, in the set's arena: M[1,2], v[3], the id of a number. */
const char *digits_entry_id(struct digits_set *s, const char *id, int rows, int cols, int k);
/* A formula that stands in none of them, from its text as it is seen from a section; strings are borrowed.  To be
   cleared by itself where that succeeds. */
bool digits_formula_of(struct digits_formula *f, struct digits_set *s, const char *id, const char *text,
                       const char *section, struct diag *d);
/* A tape of one scalar of the set's elaboration, as text seen from a section; false when the text has no meaning
   there. */
bool digits_tape_of(struct tape *t, struct digits_set *s, const char *text, const char *section);

/* --- One formula (formula.c) --- */

enum input_class digits_class_of(const char *name);
/* Makes the tape from the entries; values of a motion, z_1(t), become inputs. */
bool digits_formula_make(struct digits_formula *f, struct digits_set *s, struct diag *d);
/* The same formula of the set, every entry under rounded(); to be cleared by itself where that succeeds. */
bool digits_formula_rounded(struct digits_formula *z, struct digits_set *s, const struct digits_formula *f,
                            struct diag *d);
void digits_formula_clear(struct digits_formula *f);
/* Does it round anything at all? */
bool digits_formula_computes(const struct digits_formula *f);
/* The same but for the names of inputs, which must be of one kind. */
bool digits_formula_same(const struct digits_formula *a, const struct digits_formula *b);
/* The inputs of g that have the names of f's at x; the others keep what y holds. */
void digits_inputs(double *y, const struct digits_formula *g, const struct digits_formula *f, const double *x);
/* chi=0x1.8p-3,... */
void digits_print_point(struct text *out, const struct digits_formula *f, const double *x);

/* --- Its derivatives (slopes.c) --- */

/* Makes f->slopes. */
bool digits_slopes(struct digits_formula *f, struct digits_set *s, struct diag *d);

/* --- In the paper's notation (notation.c) --- */

/* The node: subexpressions that have a name in the paper by that name (whole: the node itself too), factors 1 and terms
   0 of matrix products left out, what is deep as f(what it is made of). */
void digits_print_node(struct text *out, struct digits_set *s, const struct digits_formula *f, slong node, bool whole);

/* --- Where nodes are written (place.c) --- */

void digits_note_definition(struct digits_set *s, const struct definition *def);
void digits_note_record(struct digits_set *s, const struct statement_record *r);
/* The id of the record in which the node is written, or what it is part of; NULL where it is written nowhere. */
const char *digits_record_of(const struct digits_set *s, const struct digits_formula *f, slong node);

/* --- The program's own functions (kernel.c) --- */

/* Adds each function's results one by one and together. */
void digits_enrol_kernels(struct digits_set *s);
int digits_kernel_run(struct num_vec *out, const struct digits_formula *f, const struct num_vec *in);
double digits_kernel_condition(const struct digits_formula *f, const struct num_vec *in, double size);

/* Takes a point of a region to one at which the function can have a value; false where there is none. */
bool digits_kernel_place(double *x, const struct digits_formula *f);

/* --- The orbit from a guess (warm.c): the state is t_b, t_c, the point chi, eta, V, e_1, e_2, t_b, t_c --- */

int digits_warm_run(struct num_vec *out, const struct num_vec *params, const struct num_vec *state);
bool digits_warm_place(double *x);

/* --- One point (measure.c) --- */

enum digits_kind {
  DIGITS_LOST,      /* the losses have a meaning */
  DIGITS_FAILED,    /* no value, though a double holds the true one */
  DIGITS_OUTSIDE,   /* no true value, or none that a double holds */
  DIGITS_ZERO,      /* the true value is zero, or cannot be told from it */
  DIGITS_UNDECIDED, /* not known well enough at the highest precision */
  DIGITS_LESS       /* no more than was asked about is lost, so that no more was computed */
};

struct digits_loss {
  enum digits_kind kind;
  double error;     /* log2 of the relative error in units of 2^-53 */
  double condition; /* log2 of the condition number */
  double moved;     /* log2 of the same with differences for derivatives; -inf where it is not needed */
  double predicted; /* log2 of the error predicted, in the same units; NaN: a failure */
  double observed, problem, formula; /* digits */
  double excess;                     /* formula, not cut off at all digits */
  bool sign_lost;
};

/* Registers for one formula. */
struct digits_bench {
  struct digits_formula *f;
  struct num_vec x, d;  /* inputs and nodes in double */
  struct num_vec bx, b; /* the same in balls */
  struct num_vec adjoint;
  int *d_flags, *b_flags;
  slong prec;
};
void digits_bench_init(struct digits_bench *w, struct digits_formula *f);
void digits_bench_clear(struct digits_bench *w);
/* log2 of an upper bound of |x|, to many digits; -inf for zero. */
double digits_log2(arb_srcptr x);
double digits_log2_mag(const mag_t x);
/* What is lost at x.  Where the excess cannot be more than `floor` digits, nothing but that is computed. */
struct digits_loss digits_measure(struct digits_bench *w, const double *x, double floor);
/* log2 of the condition number by the inputs [from, to) from the symbolic derivatives, after digits_measure at the same
   point; NaN where they have no value there. */
double digits_condition(struct digits_bench *w, slong from, slong to);

/* --- Why (cause.c) --- */

/* What rounding in every node does to entry `which` to first order, from the true values alone: log2 of the error
   predicted relative to 2^size, in units of 2^-53, and log2 of what the inputs' roundings would do.  Fills
   w->adjoint. */
struct digits_effect {
  double predicted, condition;
  bool known; /* to three digits, where the inputs matter at all */
};
struct digits_effect digits_adjoint(struct digits_bench *w, slong which, double size);
/* log2 of what roundings of all nodes at w->prec bits, and the radii of the inputs, do to entry `which`, in units of
   2^-prec of its value: how many bits it loses.  Fills w->adjoint. */
double digits_amplification(struct digits_bench *w, slong which);
/* Does the rule predict that no value comes out? */
bool digits_predicts_failure(const struct digits_bench *w);

struct digits_cause {
  enum loss_cause cause;
  slong node;
  double grows; /* log2 */
};
/* Of the point measured last. */
struct digits_cause digits_explain(struct digits_bench *w);
struct digits_cause digits_explain_failure(struct digits_bench *w);
/* Has underflow spoiled the finite value, so that it explains the error? */
bool digits_underflows(struct digits_bench *w, const struct digits_loss *r, double size);

/* --- Nearness to failure (nearness.c) --- */

enum digits_nearness { NEARNESS_OVER, NEARNESS_UNDER, NEARNESS_DIVISOR, N_NEARNESSES };
/* Of the point measured last: each grows towards a failure of its kind, which comes at about 1; -inf where there is no
   node that can fail so, and for a function of the program. */
void digits_nearness(double strain[N_NEARNESSES], struct digits_bench *w);
/* The largest |log2| of an input, of 1 - chi too: how far the point is from ordinary numbers. */
double digits_extreme(const struct digits_formula *f, const double *x);

/* --- Regions (region.c) --- */

extern const struct stability_region digits_region[];
extern const int n_digits_regions;
/* How many times as many points a region wants: one without a shape of its own holds what the others do not aim at. */
int digits_region_width(int region);
struct digits_place; /* a region made ready for a formula */
/* NULL when the region says nothing of the formula's inputs. */
struct digits_place *digits_place_new(int region, struct digits_bench *w, struct digits_set *s);
void digits_place_free(struct digits_place *p);
/* The coordinates that the point depends on; how many. */
int digits_coordinates(int which[DIGITS_COORDINATES], const struct digits_place *p);
/* The point of coordinates u, all in [0, 1); false when there is none. */
bool digits_point(double *x, struct digits_place *p, const double *u);

/* --- The search (search.c) --- */

struct digits_effort {
  int samples, steps,
      agreement; /* agreement: points of each region at which layers are held against each other in balls */
};
/* What one search has found; plain bytes, since it crosses a pipe. */
struct digits_found {
  bool found, failed, slopes_differ, slopes;
  int points, outside, undecided, zero, failures;
  struct digits_loss loss, after; /* at the witness */
  struct digits_loss after_worst; /* of the other layer where it loses most by itself, by a climb of its own */
  bool after_found;
  int after_failures, after_short, after_rounded;
  struct digits_cause why, failure;
  double failure_size; /* log2 of the true value of the failure's node; NaN where none is named */
  double x[DIGITS_INPUTS], failure_x[DIGITS_INPUTS], after_x[DIGITS_INPUTS];
  int confusion[N_LOSS_BINS][N_LOSS_BINS];
};
/* The worst point of a formula in a region; `after` is the same formula in another layer and `rounded` that under
   rounded(), or both are NULL. */
void digits_search(struct digits_found *out, struct digits_formula *f, struct digits_set *s,
                   struct digits_formula *after, struct digits_formula *rounded, int region,
                   struct digits_effort effort);

/* --- The stable form's value beside the corrected one's (agree.c) --- */

struct digits_pair {
  struct digits_formula *corrected, *stable;
};
/* Every formula that is another one in the stable layer, a matrix as a whole, by its name; and the stable layer's parts
   that are proved equal to something of the corrected one. */
struct digits_pairs {
  struct digits_set corrected, stable;
  struct digits_formula *part; /* of both layers, one after the other */
  size_t n_parts;
  struct digits_pair *pair;
  size_t n, cap;
};
/* To be cleared whether it succeeds or not. */
bool digits_pairs_make(struct digits_pairs *p, const struct model *m, const struct stable_proofs *proofs,
                       struct diag *d);
void digits_pairs_clear(struct digits_pairs *p);

/* Of one pair over all regions, `samples` points in each; plain bytes. */
struct digits_agreement {
  long points;             /* at which every entry of the corrected form has a finite value */
  long outside, undecided; /* undecided: of those, enclosures meet and are too wide to tell more */
  long lost, differ;       /* an entry of the stable form has no value at the highest precision; another one */
  int region;              /* of the first of these, and where */
  double x[DIGITS_INPUTS];
};
void digits_agree(struct digits_agreement *out, struct digits_pairs *p, size_t pair, int samples);

/* --- What replaces a formula (replace.c) --- */

/* The records of the stable layer that make the formula, joined by ", ", of those that have proofs
   (proof/stable_forms.h); whether all of them are proved. */
bool digits_replacement(struct text *out, const struct model *m, const struct stable_proofs *p,
                        const struct digits_formula *f);

/* --- The study (study.c) --- */

struct digits_study {
  struct digits_set set, other; /* other: of the layer held against it */
  bool have_other;
  const struct model *model;
  struct stable_proofs proofs; /* of the stable layer, when it is the other one */
  struct digits_pairs pairs;   /* then too */
  bool have_proofs, have_pairs;
  struct digits_formula **formula, **after; /* after: NULL where the other layer has the same formula or none */
  struct digits_formula *rounded;           /* of after[i], where there is one */
  size_t n;
  struct digits_effort effort;
  struct stability_result *out;
};
/* The formulas that the options ask for; to be closed whether it succeeds or not. */
bool digits_study_open(struct digits_study *st, const struct model *m, const struct stability_options *opt,
                       struct diag *d);
void digits_study_close(struct digits_study *st);

/* --- In words (describe.c); strings go to the arena of st->out --- */

void digits_describe_formula(struct stability_formula *z, struct digits_study *st, const struct digits_formula *f);
void digits_describe_replacement(struct stability_formula *z, struct digits_study *st,
                                 const struct digits_formula *after);
void digits_describe_row(struct stability_row *z, struct digits_study *st, int formula, int region,
                         const struct digits_found *found);

void digits_describe_pair(struct stability_pair *z, struct digits_study *st, size_t pair,
                          const struct digits_agreement *found);

/* --- Maps (map.c) --- */

/* Of the worst formulas, at most MAPS, around the points found[i], where i is the row of their worst. */
enum { MAPS = 4 };
bool digits_draw_maps(struct digits_study *st, const struct digits_found *found, const struct stability_options *opt,
                      struct crew_tally *tally, struct diag *d);

#endif
