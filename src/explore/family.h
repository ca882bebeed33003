/* The orbits of the word along a line of parameter values, in double precision.

   One of chi, eta, V, e1, e2 takes the values x_i = A + (B - A) i/(n - 1), exact rationals rounded once; the others are
   fixed.  At anchors, the ends of the stretch and every so many points between them, the search of dynamics.h finds
   every orbit that it can; between two anchors each orbit is followed by warm starts, coarse points first and each
   finer one from those around it.  A stretch on which an orbit cannot be followed from one anchor to the next (it ends
   in a fold or at a grazing event, or another begins) is searched at a point inside it and treated as two, down to
   single points if need be: what stands at an anchor is followed or searched for at every point, and never dropped.

   What can be missing: an orbit that the search itself misses, and one whose branch begins and ends between two
   neighbouring anchors.  Anchors at every point exclude the second.  Beside another line anchors can be further apart
   (FAMILY_APART), and a branch that begins and ends between these is missed until a line is searched for itself.

   Whether a condition holds is decided in double precision where its margin is wide, else in balls at the exact
   parameters; what these leave open stays UNKNOWN.  The result depends on the arguments alone. */
#ifndef STICKSLIP_EXPLORE_FAMILY_H
#define STICKSLIP_EXPLORE_FAMILY_H

#include "motion/margins.h"
#include "motion/warm.h"

/* --- Values. --- */

struct dyn_axis {
  int vary; /* one of P_CHI .. P_E2 */
  slong n;
  fmpz_t start, step, den; /* x_i = (start + i step)/den */
  bool small;              /* all of these integers are doubles: in that case also here */
  double begin, by, over;
};
/* n >= 1; both ends are included, and with n = 1 they are the same. */
void dyn_axis_init(struct dyn_axis *a, int vary, const fmpq_t from, const fmpq_t to, slong n);
void dyn_axis_clear(struct dyn_axis *a);
void dyn_axis_q(fmpq_t x, const struct dyn_axis *a, slong i);
double dyn_axis_d(const struct dyn_axis *a, slong i);

/* How long a line may be, and how many points apart its anchors; how far apart they are where nobody says: not too far
   on a line of few points either. */
enum { AXIS_MOST_POINTS = 1000000000, AXIS_MOST_EVERY = 65536 };
slong dyn_axis_usual_every(slong n);
/* A stretch of so many points, a whole number of anchors, can stand for itself: it comes out the same by whomever. */
slong dyn_axis_stretch(slong every);

/* --- Orbits. --- */

/* Bits of violations and unsure: the conditions of dyn_condition_id, then u_r1 and u_r2, the given static friction. */
enum { MEMBER_U_R = N_CONDITIONS };

struct dyn_member {
  double out[N_DYN_OUT];
  unsigned violations, unsure;
  truth stable;
  truth word; /* t_b and t_c are first roots: TRUE or UNKNOWN */
  bool up;    /* phase C ends at a maximum of z_2 - z_1 */
};
truth dyn_member_admissible(const struct dyn_member *m);

enum dyn_family_status {
  FAMILY_OK,
  FAMILY_UNDECIDED,   /* something about one of the orbits is UNKNOWN */
  FAMILY_FOLD,        /* two orbits nearly merge, and could not be told from none */
  FAMILY_CONVERGENCE, /* what the search saw could not be enclosed */
  FAMILY_BUDGET,      /* the search ran out of its budget of steps */
  FAMILY_RANGE,       /* the parameters are in the domain, but not in that of double precision */
  N_FAMILY_STATUS
};
extern const char *const dyn_family_status_name[N_FAMILY_STATUS];

struct dyn_family_point {
  double x;
  slong first, n; /* of the members, by increasing z10 */
  enum dyn_family_status status;
};
struct dyn_family {
  struct dyn_family_point *point;
  slong n_points;
  struct dyn_member *member;
  size_t n_members, cap_members;
  long searched; /* how many searches */
};

/* Which orbits, where. */
struct dyn_family_request {
  const fmpq *params; /* of which params[axis->vary] is not used */
  const struct dyn_axis *axis;
  const fmpq *u_r[2]; /* static friction or NULL */
  slong every;        /* points from one anchor to the next, at least 1; beside a line perhaps more */
  bool late;          /* also orbits with t_b beyond the first crest of phase Gamma, which are never admissible */
  /* The same points of a line close by, or NULL.  Where it changes once at most between two anchors FAMILY_APART times
     as far from each other, and holds as many orbits there as this line, no more are searched for than at these two. */
  const struct dyn_family *beside;
};
enum { FAMILY_APART = 8 };
/* Of so many lines of a plane the first has none beside it: few enough that there is work for several processes. */
static inline slong dyn_lines_abreast(slong lines) {
  return FLINT_MAX(FLINT_MIN(lines / 8, 16), 1);
}

/* The points begin .. end - 1.  SS_DOMAIN when parameters lie outside the domain of dynamics.h. */
int dyn_family_find(struct dyn_family *f, const struct dyn_family_request *q, slong begin, slong end);
void dyn_family_clear(struct dyn_family *f);

#endif
