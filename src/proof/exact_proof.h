/* Proofs by exact algebra of what claims say. */
#ifndef STICKSLIP_PROOF_EXACT_PROOF_H
#define STICKSLIP_PROOF_EXACT_PROOF_H

#include "exact_motion.h"
#include "record/result.h"

enum { EXACT_SPECS = 4, EXACT_UNKNOWNS = 8, EXACT_PARTS = 24 };

/* What is to be proved: a claim's sentence, or a value of which a proof makes use. */
struct exact_question {
  const struct claim *c; /* NULL: value */
  const char *value, *section;
  struct point_spec spec[EXACT_SPECS];
  int n_specs;
  bool sharp; /* each step is an equality at one end of the phase */
};

/* A sentence that was proved at one kind of point: with which matrices as unknowns, and by which attempt each entry. */
struct exact_part {
  const struct exact_question *question;
  struct override unknown[EXACT_UNKNOWNS];
  int n_unknowns;
  struct point_spec spec;
  slong n;
  const bool *equal; /* which entries are proved because both sides are equal */
  const struct exact_attempt *by;
};

struct exact_proof {
  bool proved;                        /* on the claim's whole domain, wherever both sides are defined */
  const char *note;                   /* what was shown equal, and where; when proved */
  const char *why_not;                /* when not */
  const char *differs;                /* a difference and a rational point, where that refutes; else NULL */
  bool level;                         /* a < or > fails, since both sides are equal everywhere */
  const struct restriction *holds_at; /* under which every difference vanishes, by its factors; or NULL */
  const char *field;
  slong largest;
  bool beyond;                         /* with symbols of the paper's own, pi or exponentials */
  bool uses_matrices, by_factors;      /* by_factors: of inequalities */
  bool by_law;                         /* and by what (2) asks of a mass */
  struct exact_part part[EXACT_PARTS]; /* a proof is all of them */
  int n_parts;
};

bool exact_sentence(struct sentence *s, const struct exact_question *q, struct view view, const struct override *o,
                    int n, struct diag *d);
/* The sentence of a claim that is tried at points, under a restriction or (NULL) without. */
struct exact_proof exact_prove(struct judge *j, const struct claim *c, struct view view, const struct restriction *r);

/* That J is the model's on every periodic motion of the word. */
struct exact_proof exact_prove_jacobian(struct judge *j, struct view view);

/* Is the formula proved to have one value in two readings of the paper? */
bool exact_unchanged(struct view first, struct view second, const char *formula, const char *section);
/* As evidence; refuted: another route has refuted the sentence. */
void finding_add_proof(struct finding *f, struct audit_result *out, const struct exact_proof *p, const char *layer,
                       bool refuted);

/* Says why a claim that is supported is not proved, where nothing has said so yet. */
void finding_why_not(struct finding *f, struct audit_result *out, const struct claim *c);

#endif
