/* The orbits along a line of parameters (family.h): what the files family*.c have in common.

   family_axis    values on a line
   family_member  one orbit: what double precision says of it, what balls say
   family_level   orbits followed from the points around, many at a time
   family         anchors, and what stands between them */
#ifndef STICKSLIP_FAMILY_IMPL_H
#define STICKSLIP_FAMILY_IMPL_H

#include "family.h"
#include "motion/warm.h"

/* Columns as dyn_orbits_batch reads and writes them, of cap lanes each; zeros: no lanes. */
struct family_lanes {
  slong cap;
  double *params[N_PARAMS], *guess[2], *out[N_DYN_OUT];
  unsigned *violations;
  int *status;
};
/* One line at work: parameters in double and exactly, the varied one being set by family_move. */
struct family_line {
  const struct dyn_family_request *q;
  fmpq exact[N_PARAMS];
  double params[N_PARAMS], u_r[2];
  slong at; /* of family_move; -1 before */
  struct family_lanes lanes;
  struct dyn_family *f;
};
/* Sets the varied parameter to the i-th value. */
void family_move(struct family_line *l, slong i);

/* Completes what the warm start gave for the point at hand: stability and static friction, and in balls what is
   open. */
void family_judge(struct dyn_member *m, struct family_line *l);
/* The orbit near guess at the point at hand, in double precision if that is able; false when there is none to be
   had. */
bool family_solve(struct dyn_member *m, struct family_line *l, const double guess[2], bool up);
/* Every orbit at the point at hand, appended to the family. */
void family_search(struct family_line *l, struct dyn_family_point *p);
/* Appends members of the point, by increasing z10. */
void family_add(struct dyn_family *f, struct dyn_family_point *p, struct dyn_member *m, slong n);

/* How far two orbits are from each other. */
double family_apart(const struct dyn_member *a, const struct dyn_member *b);
/* Whether two orbits can be of one branch: along it phase C ends at a maximum or at a minimum throughout, and the
   multiplier stays on one side of 1, where two orbits merge. */
bool family_akin(const struct dyn_member *a, const struct dyn_member *b);
/* Whether two orbits of one point are one within what double precision can tell. */
bool family_same(const struct dyn_member *a, const struct dyn_member *b);

/* --- family_level.c --- */

/* Orbits between two anchors: row k is one orbit, its column i the point first + i. */
struct strand {
  struct family_line *line;
  slong first, last, rows;
  struct dyn_member *m;
};
static inline struct dyn_member *family_at(const struct strand *s, slong row, slong point) {
  return &s->m[row * (s->last - s->first + 1) + point - s->first];
}
/* Follows every orbit to the points first + h, first + 3 h, ..., those at multiples of 2 h being there.  -1, or a point
   at which an orbit was lost, the middle one of them. */
slong family_level(struct strand *s, slong h);
/* Room for n lanes at least.  Where it has to grow, every lane gets these parameters; the caller sets the one that
   varies from lane to lane, and guess. */
void family_lanes_room(struct family_lanes *a, slong n, const double params[N_PARAMS]);
void family_lanes_clear(struct family_lanes *a);
/* The orbits of the first n. */
void family_lanes_run(struct family_lanes *a, slong n);

#endif
