/* What holds on every motion and may be put in when two models are compared, and matrices that may be held as
   unknowns. */
#ifndef STICKSLIP_POWER_FACTS_H
#define STICKSLIP_POWER_FACTS_H

#include "mutants.h"
#include "tape/exact.h"

enum { MOST_FACTS = 64 };

/* A definition that can be held as a matrix of unknowns where it does not read what is damaged: products of such
   matrices can be compared where their entries written out are too large. */
struct opaque {
  struct override name;
  struct model_use use;
};

struct facts {
  struct exact_fact fact[MOST_FACTS];
  int n;
  bool unused;
  struct tape velocity, zero; /* V, 0 */
  struct tape sign[2];        /* -1, 1: what a sign such as eps may be */
  struct opaque *opaque;
  size_t n_opaque, cap_opaque;
};

/* The facts that hold where a claim is tried, at most MOST_FACTS; c NULL: the statement itself, wherever it is read. */
int facts_collect(struct exact_fact *out, const struct facts *f, const struct claim *c);
/* The matrices held as unknowns that do not read the target. */
enum { MOST_UNKNOWNS = 32 };
int facts_unknowns(struct override out[MOST_UNKNOWNS], const struct facts *f, const struct target *t);

#endif
