/* What the files of the search over readings share: the equations as data, their values, solving them. */
#ifndef STICKSLIP_READINGS_IMPL_H
#define STICKSLIP_READINGS_IMPL_H

#include "model/model.h"
#include "num/calc.h"
#include "record/result.h"
#include "scene/scene.h"
#include "value/solved.h"

/* The quantities of a printed example: the first of an orbit's numbers (value/solved.h), which have their names. */
enum { X_Z10, X_Z20, X_TA, X_TB, X_TC, X_TD, X_E1, X_E2, N_X };

/* The equations of the paper, and two forms of them. */
enum { EQ_12, EQ_14, EQ_16, EQ_V2, EQ_Z1, EQ_Z2, EQ_W, EQ_R, EQ_F1, EQ_F2, EQ_G1, EQ_G2, N_EQ };
/* As (12), (14), (16) and (18) state them; as bits. */
enum { EQUATIONS_OF_PAPER = 1U << EQ_12 | 1U << EQ_14 | 1U << EQ_16 | 1U << EQ_V2 | 1U << EQ_Z1 | 1U << EQ_Z2 };
/* The bases in which the periodicity conditions (16), (18) can be taken. */
enum basis { BASIS_PAPER, BASIS_FORCES, BASIS_SOLVED };

struct equation {
  const char *text;
  unsigned of;     /* the quantities it contains, as bits */
  int end;         /* the state it speaks of: 1 to 4 for Z_a, Z_b, Z_c, Z_f; 0: a row solved for z_0 */
  int one[4];      /* its left side is the sum of (one + with_chi chi) times the entries of that state */
  int with_chi[4]; /* (end 0: one[0] is the block, 0 positions, 1 velocities, one[1] the row) */
  int right;       /* its right side: the index of a quantity, RIGHT_V or RIGHT_START (the same of Z_0) */
};
enum { RIGHT_V = -1, RIGHT_START = -2 };
extern const struct equation equations[N_EQ];

/* A way to choose which of the periodicity conditions hold. */
struct form {
  enum basis basis;
  unsigned held, all; /* of the basis, as bits of EQ_... */
};
enum { MAX_FORMS = 64 };
/* Every one, none twice; their number. */
int forms_list(struct form forms[MAX_FORMS]);

/* --- Where the propagators come from: the paper's formulas as a view shows them, or the suite's own model. --- */

struct formulas {
  bool own_model;
  struct elaboration el;
  struct tape tape;
  int input[16]; /* what the tape's inputs are: 0, 1, 2 for chi, eta, V, then 3 + X_... */
};
/* false when the matrices D to C cannot be read there or hang on anything else; to be cleared all the same. */
bool formulas_read(struct formulas *f, struct view v);
void formulas_own(struct formulas *f);
void formulas_clear(struct formulas *f);

/* A motion over one period from given positions: five states and their derivatives by z10, z20, t_a, t_b, t_c, t_d. */
struct motion {
  struct num_vec state[5], tangent[5];
};

/* The equations in one number type: values and derivatives by the eight quantities at x. */
enum { KEPT_VALUES = 8 };
struct tape_values {
  struct num_vec in, out;
  long used; /* when; 0: there are none */
};
/* Solved blocks of equations, remembered: many readings share them. */
struct memo {
  struct memo_entry *entry;
  size_t n, cap;
};
void memo_clear(struct memo *m);
struct system {
  struct num_ctx ctx;
  struct calc c; /* whose vectors the next ones are */
  const struct formulas *formulas;
  struct num_vec model;                 /* chi, eta, V */
  struct num_vec x;                     /* N_X: set before each evaluation */
  struct tape_values kept[KEPT_VALUES]; /* of the places where the tape was asked last */
  long used;
  struct num_vec p[4], dp[4]; /* D, Gamma, H, C at their times, and their derivatives */
  struct motion own, from_solved;
  struct num_vec value, slope; /* N_EQ; N_EQ by N_X */
  struct memo memo;
};
void system_init(struct system *s, const struct formulas *f, const struct scene *scene, struct num_ctx ctx);
void system_clear(struct system *s);
/* The equations whose bits are set. */
int system_eval(struct system *s, unsigned eqs);
/* p and dp alone. */
int system_propagators(struct system *s);

/* --- Solving some equations for as many quantities, the others fixed --- */

/* Newton's iteration in double precision from x, in place.  false when it does not converge within 12 steps, or some
   unknown leaves start by more than 1 + |start|. */
bool readings_newton(double x[N_X], struct system *s, unsigned eqs, unsigned unknown);
/* Balls around the solution near the middles of x, the other entries of which may be balls: proved (Krawczyk's
   operator) to hold exactly one solution for each value of those.  s is one of num_arb. */
bool readings_enclose(arb_ptr x, struct system *s, unsigned eqs, unsigned unknown);
/* d(unknown)/d(known) at x (N_X by N_X; rows of unknowns and columns of known quantities are set), and
   d(unknown)/d(right side of an equation) (N_X by N_EQ).  Either may be NULL. */
bool readings_slopes(arb_ptr by_known, arb_ptr by_equation, struct system *s, arb_srcptr x, unsigned eqs,
                     unsigned unknown);

int bits_count(unsigned mask);

/* --- One reading --- */

/* How a number gets from one formula into the next. */
enum carry { CARRY_EXACT, CARRY_PRINTED, CARRY_3, CARRY_2, N_CARRIES };
extern const char *const carry_text[N_CARRIES];

/* Why a reading assumes much or little. */
enum assumption { ASSUME_INPUT, ASSUME_DATA, ASSUME_ZEROS, ASSUME_FORM, ASSUME_CARRY, ASSUME_MIXED, N_ASSUMPTIONS };

enum { N_BOUNDS = 2, N_PRINTED = N_X + N_BOUNDS, MAX_BLOCKS = 8 };

/* Equations solved together, in their order. */
struct block {
  unsigned eqs, unknown;
};

struct candidate {
  enum layer layer;
  struct form form;
  unsigned eqs, unknown; /* all that hold; all that are computed */
  enum carry carry;
  struct block block[MAX_BLOCKS];
  int n_blocks;
  int dropped, assumed[N_ASSUMPTIONS], digits;
  double x[N_X];
  long serial;
};

/* What is printed, ready for use. */
struct example {
  const struct scene *scene;
  const struct printed_number *printed[N_PRINTED]; /* bounds may be NULL */
  unsigned data;                                   /* what the paper names as data */
  double value[N_X], unit[N_PRINTED];
  fmpq fed[N_CARRIES][N_X]; /* the printed value as it enters the next formula */
  int digits[N_X], missing[N_X];
};
/* NULL, or what the scene lacks. */
const char *example_init(struct example *e, const struct scene *s);
void example_clear(struct example *e);

/* (53) from eight balls. */
void readings_bounds(arb_ptr bound, arb_srcptr x, const struct scene *s);

/* The enclosures of all eight quantities and the bounds (x has N_PRINTED) under a reading; false when they cannot be
   proved. */
bool candidate_enclose(arb_ptr x, const struct candidate *c, struct system *s, const struct example *e);

/* Fills *list (malloc) with the readings that drop the given number of equations and give every printed number; *tried
   counts readings, *undetermined those whose equations cannot determine what they compute. */
void readings_search(struct candidate **list, size_t *n, long *tried, long *undetermined, int dropped, struct system *s,
                     enum layer layer, const struct example *e);
/* The order of the ranks. */
int candidate_compare(const void *a, const void *b);

/* --- The record --- */

void reading_describe(struct example_reading *r, struct audit_result *out, const struct candidate *c, arb_srcptr x,
                      const struct example *e, struct system *s);
/* How far the results are from those of the whole procedure. */
void reading_shifts(struct example_reading *r, struct audit_result *out, const struct candidate *c, arb_srcptr x,
                    const struct example *e, struct system *s, struct system *search);
/* The whole procedure, nothing dropped: from the scene's data, and from any two printed numbers.  search is the system
   in double precision, s in balls. */
void readings_procedure(struct readings *r, struct audit_result *out, const struct example *e, struct system *s,
                        struct system *search);
void readings_pairs(struct readings *r, struct audit_result *out, const struct example *e, struct system *s,
                    struct system *search);

#endif
