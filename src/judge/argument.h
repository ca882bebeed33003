/* What the files of the judge of arguments share: an argument as it was read, and the search for a counterexample. */
#ifndef STICKSLIP_JUDGE_ARGUMENT_H
#define STICKSLIP_JUDGE_ARGUMENT_H

#include "certificate.h"
#include "proof/condition.h"

enum { PREMISES, CONCLUSION, N_PARTS };

struct argument {
  struct judge *j;
  const struct claim *c;
  struct conditions part[N_PARTS];
  bool admissible;    /* only orbits that break none of the model's conditions */
  bool free_friction; /* u_s1 and u_s2 need not be positive, so u_r1 and u_r2 are free */
  bool uses_friction;
  bool converse; /* the premises must follow from the conclusion too */
  long tried;    /* orbits on which the premises hold, as far as double precision tells */
};

/* --- argument.c --- */

/* As evidence: how often each answer was given, by balls, which decide and are explained, and by exponentials. */
void argument_add_routes(struct route_result w[2], struct finding *f, struct argument *a,
                         const struct answers decided[2], const char *where, const char *note);

/* Which name in a condition has no value, and what has one; NULL: all have. */
const char *argument_unbound(const struct argument *a);

/* The data of verify/receipt/argument.py; false with j->d set when the argument is not proved everywhere. */
bool argument_receipt(struct text *out, struct judge *j, const struct claim *c);

/* " in the global stick phase, at its middle", with what is to stand between phase and place; "" of a condition that
   holds at no time. */
const char *argument_moment(struct argument *a, const struct condition *c, const char *between, double where);

/* --- argument_scene.c --- */

/* The argument at the scene's orbit nearest to the printed numbers, for every friction that the premises allow. */
void argument_at_scene(struct finding *f, struct argument *a);

/* --- argument_search.c --- */

/* What enclosures say at a point. */
struct argument_decision {
  truth premises, conclusion, by_exponentials;
  int failed; /* the condition of the conclusion */
  double where;
  arb_t value;
};
/* What the search found: how often each answer, the text of an orbit that refutes, of the one that comes nearest. */
struct argument_tally {
  struct answers decided[2]; /* balls, exponential */
  const char *certificate, *nearest;
  struct certificate certified; /* of the first of these orbits */
};

/* The least margin of the conclusion where the premises hold, else infinity, with u_r as close to what they allow as
   the grid permits. */
double argument_least_margin(fmpq u_r[2], struct argument *a, const struct point *at, double belt, const double e[2]);
/* Enclosed along whole phases at the point, and what is decided, by balls and by exponentials, counted where the
   premises hold (or NULL).  o is the orbit of a POINT_GIVEN, whose friction counts as a premise; else NULL.  d->value
   is the caller's to init and clear. */
void argument_decide(struct argument_decision *d, struct answers decided[2], struct argument *a, const struct point *p,
                     const struct dyn_orbit *o);
/* Which condition fails, where along its phase, and its margin there: the end of a certificate. */
void argument_certify(struct certificate *c, struct argument *a, const struct argument_decision *d);
/* Where there is a proof already, the search only checks it, on few orbits; with little effort there are few too, and
   nothing goes downhill. */
void argument_search(struct argument_tally *t, struct argument *a, bool proved);

#endif
