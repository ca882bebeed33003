/* What the files of the family share.

   family_axis    values on a line
   family_member  one orbit: what double precision says of it, what balls say
   family         anchors, and what stands between them */
#ifndef STICKSLIP_FAMILY_IMPL_H
#define STICKSLIP_FAMILY_IMPL_H

#include "dyn_impl.h"
#include "stickslip/family.h"

/* One line at work: parameters in double and exactly, the varied one being set by family_move. */
struct family_line {
  const struct dyn_family_request *q;
  fmpq exact[N_PARAMS];
  double params[N_PARAMS], u_r[2];
  double crest; /* the first crest of phase Gamma */
  slong at;     /* of family_move; -1 before */
  struct dyn_family *f;
};
void family_line_init(struct family_line *l, struct dyn_family *f, const struct dyn_family_request *q);
void family_line_clear(struct family_line *l);
/* Sets the varied parameter to the i-th value. */
void family_move(struct family_line *l, slong i);

/* Completes what the warm start gave for the point at hand: stability and static friction, and in balls what is open. */
void family_judge(struct dyn_member *m, struct family_line *l);
/* The orbit near guess at the point at hand, in double precision if that is able; false when there is none to be had. */
bool family_solve(struct dyn_member *m, struct family_line *l, const double guess[2], bool up);
/* Every orbit at the point at hand, appended to the family. */
void family_search(struct family_line *l, struct dyn_family_point *p);
/* Appends members of the point, by increasing z10. */
void family_add(struct dyn_family *f, struct dyn_family_point *p, struct dyn_member *m, slong n);

/* Whether two orbits of one point are one within what double precision can tell. */
bool family_same(const struct dyn_member *a, const struct dyn_member *b);

#endif
