/* A claim being judged: what every judge is given. */
#ifndef STICKSLIP_JUDGING_H
#define STICKSLIP_JUDGING_H

#include "claims.h"

struct dependences;
struct orbit_cache;

/* EFFORT_REFUTE: the decisive route alone, up to its first difference; a verdict other than refuted means nothing then
   (of arguments, scaling, ranks, criteria and reach proved is reliable, too).
   EFFORT_VERDICT: all routes, up to the point from which on the verdict can be nothing but refuted; the evidence means
   nothing then.  EFFORT_DIFFERENCE: all routes, up to the first difference of the decisive one.  Kinds that know them
   are done sooner; others may pass over them. */
enum effort { EFFORT_FULL, EFFORT_REFUTE, EFFORT_VERDICT, EFFORT_DIFFERENCE };

struct judge {
  struct audit_result *out;
  const struct model *model;
  const struct claims *claims;
  struct dependences *dependences; /* of these claims; NULL where no finding is described */
  const struct scene *scene;
  struct orbit_cache *cache;
  struct diag *d;
  bool claim_at_fault; /* the diagnostic is about the claim file, not about a formula */
  enum effort effort;
  const char *instead; /* a corrected text, in the place of one that the claim's file names; or NULL */
  const bool *touched; /* by record of the model: what may say something else than it did; NULL: everything may */
};

/* An error of the claim's file, at the attribute, or at the claim's name where it has none of that name: false with d
   set. */
bool claim_mistake(const struct claim *c, const char *attribute, struct diag *d, const char *fmt, ...) SS_PRINTF(4, 5);
/* false, with the error at the first line that is no attribute of the list. */
bool claim_has_only(const struct claim *c, const char *const *known, int n, struct diag *d, const char *says);
/* The same of a claim that is being judged: false with j->d set. */
bool claim_error(struct judge *j, const struct claim *c, const char *attribute, const char *what);

#endif
