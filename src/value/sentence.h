/* Two sides of a sentence at points. */
#ifndef STICKSLIP_SENTENCE_H
#define STICKSLIP_SENTENCE_H

#include "claim/judging.h"
#include "model/model.h"
#include "oracle.h"
#include "tape/tape.h"
#include "values.h"

/* A sentence ready to be tried: paper's expressions on one or both sides, the model's quantity perhaps on the other.
   It must be cleared whether or not it could be made. */
struct sentence {
  struct elaboration el;
  struct tape tape;
  slong n; /* entries of a side */
  int cols;
  struct sentence_step {
    slong end; /* behind its last entry */
    int cols;
  } * step; /* of the record's relations, of which a chain has several; none where the sentence is of a value */
  size_t n_steps;
  enum relop *ops;             /* of each entry */
  bool sharp;                  /* they are the equalities that inequalities become */
  const struct oracle *oracle; /* the right side, or NULL when it is on the tape */
  struct tape given;           /* of the ranges in which it is said: the lesser sides, then the greater */
  bool *given_closed;          /* of each pair, whether the two may be equal */
  slong n_given;
  const char *fixes; /* in a paper about another system, a symbol that an equation says the value of; NULL: none */
};

/* value = oracle of the same name, which there is, with names in it replaced by the model's quantities. */
bool sentence_from_value(struct sentence *s, struct view v, const char *value, const char *section,
                         const struct override *overrides, int n_overrides, struct diag *d);
/* The record that an attribute of a claim names, which has a relation to be judged; NULL with d set. */
const struct statement_record *claim_record(struct view v, const struct claim *c, const char *attribute, const char *id,
                                            struct diag *d);
bool record_has_equation(const struct statement_record *r);
/* Whether the statement is an inequality beside an equation of the record, or one between symbols and numbers alone
   (r > 2) beside other statements: in a paper about another system it is read as the condition under which they are
   said. */
bool statement_is_condition(const struct model *m, const struct statement_record *r, const struct stmt *s);
/* The entries of a record (every step of its relations, of which there are some), with names replaced by the model's
   quantities.  At a point outside the range of one of them, "for q in (0, 1)", it has no value; where the range is a
   phase of the motion, the points lie in it already. */
bool sentence_from_relations(struct sentence *s, struct view v, const struct statement_record *r,
                             const struct override *overrides, int n_overrides, struct diag *d);
/* What a claim that is tried at points says, by its statement or its value: of a sharp one, the equalities that its
   steps become at the ends of the phase. */
bool sentence_from_claim(struct sentence *s, struct view v, const struct claim *c, const struct override *overrides,
                         int n_overrides, struct diag *d);
/* Whether it can be read, though nothing may be known of its value; false with d set. */
bool sentence_reads(struct view v, const struct claim *c, struct diag *d);
void sentence_clear(struct sentence *s);
enum outcome { OUTCOME_AGREES, OUTCOME_DIFFERS, OUTCOME_UNDECIDED, OUTCOME_REJECTED, OUTCOME_UNBOUND };

struct trial {
  enum outcome outcome;
  int status; /* of a rejected point */
  long bits;
  double log_diff; /* log2 of the largest difference over max(1, scale); -inf for none */
  slong entry;     /* where */
  char lhs[64], rhs[64];
  char unbound[64];
};

/* Both sides (s->n each, in the context of lhs and rhs) in the values of a point, which then know what of it was read;
   t (or NULL) is told of a name without a value.  And at a point, by closed forms. */
int sentence_evaluate(struct num_vec *lhs, struct num_vec *rhs, struct trial *t, struct sentence *s, struct values *v);
int sentence_values(struct num_vec *lhs, struct num_vec *rhs, struct sentence *s, const struct point *p,
                    struct orbit_cache *cache);

/* Both sides in balls, from 128 bits, doubled while undecided up to 1024.  Differs when the balls of an equality are
   disjoint, or those of an inequality are ordered the other way; agrees when every inequality is proved, and the sides
   of every equality overlap and are narrower than 2^(-bits/2) max(1, scale). */
struct trial sentence_try_balls(struct sentence *s, const struct point *p, enum variant variant,
                                struct orbit_cache *cache);
/* The same of equalities, each of which need hold at one end of the point's phase only, in balls of 128 bits. */
struct trial sentence_try_ends(struct sentence *s, const struct point *p, enum variant variant,
                               struct orbit_cache *cache);
/* Two vectors of balls (as long as each other, in one context) as the sides of equalities, decided in the same way at
   their precision alone. */
struct trial balls_compare(const struct num_vec *lhs, const struct num_vec *rhs);
/* In a rounded type: agrees below tol max(1, scale), differs above sqrt(tol) max(1, scale). */
struct trial sentence_try_rounded(struct sentence *s, const struct point *p, enum variant variant, struct num_ctx ctx,
                                  double log_tol, struct orbit_cache *cache);

/* Does x op y hold?  UNKNOWN for an equality. */
truth inequality_holds(const struct num_type *type, enum relop op, const void *x, const void *y);

/* log2 of an upper bound of |x|; -inf for zero. */
double log2_upper(const arb_t x);

/* "[2,3]" for an entry of a matrix, counted from 0 by rows; "2" in a column, "" in a scalar. */
const char *entry_place(struct audit_result *out, slong n, int cols, slong entry);
/* "in entry 2 of the first equation ", "in the second inequality ", "in entry [1,2] "; "" where there is one alone. */
const char *sentence_place(struct audit_result *out, const struct sentence *s, slong entry);

/* Reads the claim's points into at most max specs; the number of them, or -1 with j->d set. */
int claim_points(struct point_spec *spec, int max, struct judge *j, const struct claim *c);
/* Does an overlay say the claim's statements of several phases, or not all of the same one? */
bool claim_spans_phases(struct judge *j, const struct claim *c);

#endif
