/* Points: exact data at which a sentence is tried, and the orbits found at them so far. */
#ifndef STICKSLIP_POINT_H
#define STICKSLIP_POINT_H

#include "base/random.h"
#include "model/model.h"
#include "motion/dynamics.h"
#include "scene/scene.h"
#include "tape/tape.h"

/* Precision of the first trial in balls, and where raising it stops; bits. */
enum { FIRST_PREC = 128, LAST_PREC = 1024, FD_PREC = 256 };

enum point_kind {
  POINT_PARAMS,  /* parameters and a time */
  POINT_FLOW,    /* a motion of one phase from an exact state over an exact time */
  POINT_ARC,     /* one pass through the word from an exact state, with its events */
  POINT_ORBIT,   /* a periodic orbit */
  POINT_PRINTED, /* the printed state carried over the printed times, events or not */
  POINT_GIVEN,   /* a periodic orbit of exact t_b and t_c, with the e1 and e2 that it needs, and exact u_r1 and u_r2 */
  POINT_PATCHED, /* any exact state carried by the linear systems of the four phases over any exact times, no events;
                    its perturbations are any numbers, but for the velocities that (25), (30) and (38) leave alone */
  N_POINT_KINDS
};
extern const char *const point_kind_word[N_POINT_KINDS]; /* in claims and receipts; "" for those that neither has */

/* Exact quantities of a point. */
enum {
  Q_CHI,
  Q_ETA,
  Q_V,
  Q_E1,
  Q_E2,
  Q_US1,
  Q_US2,
  Q_X,
  Q_Y,
  Q_LAMBDA,
  Q_T,
  Q_S,  /* arcs: how far into its phase the time t lies, as a fraction */
  Q_Z1, /* start of an arc or a flow: z_1, z_2, z_1', z_2' */
  Q_Z2,
  Q_DZ1,
  Q_DZ2,
  Q_TA, /* POINT_PRINTED, POINT_PATCHED */
  Q_TB,
  Q_TC,
  Q_TD,
  N_Q
};

struct point {
  enum point_kind kind;
  enum phase phase; /* of the time t: POINT_FLOW, and arcs */
  bool admissible;  /* POINT_ORBIT: only orbits that break no condition */
  bool realistic;   /* and u_s1, u_s2 for which each u_ri is 5/4 of what they ask of it, or a little more */
  bool timed;       /* the time t is that of q, on an orbit too, where z at that time is then not known */
  bool finite;      /* arcs: the perturbation is (x, y)/1024, carried by the motion itself, not by its derivative */
  fmpq q[N_Q];
  slong orbit;                   /* POINT_ORBIT, POINT_GIVEN: index in the list of its parameters */
  const struct dyn_orbit *known; /* POINT_GIVEN: that orbit at hand, or NULL to find it through the cache */
  const struct model
      *paper; /* whose own symbols have values there, drawn by this number; NULL: the model's alone have */
  uint64_t draw;
  int special;               /* of the values at which drawn ones are not, these, counted from 1; 0: none */
  const char *at;            /* "NAME=VALUE,...": those of the paper's own symbols that are not drawn; or NULL */
  const struct scene *scene; /* POINT_ORBIT: whose orbits are meant, which need not give e1 and e2; NULL: those of q */
};

/* Whether exact algebra takes a point of the kind as one on a motion over the whole word; and whether the events of the
   motion through such a point are located. */
bool point_has_word(enum point_kind kind);
bool point_has_events(enum point_kind kind);

void point_init(struct point *p);
/* Whether the point is one of the model's, where names are worth what the model says: without a paper, or with one that
   is about its system.  Elsewhere the paper's own symbols alone have values. */
bool point_of_model(const struct point *p);
/* What one of the paper's own symbols is worth there, a number of its domain: as point_set was told, or else drawn. */
void point_own_value(fmpq_t z, const struct point *p, const struct symbol *s);
void point_clear(struct point *p);
/* out, which is another point, becomes p. */
void point_copy(struct point *out, const struct point *p);
/* The exact quantities of points, in the order in which they are written: the texts of points, certificates and --at
   have them from one table. */
struct point_quantity {
  const char *name;   /* in certificates, as the paper writes it */
  const char *key;    /* in texts, and for --at; NULL where it cannot be set */
  int q;              /* which of those above it is */
  unsigned shown;     /* bit for each point_kind in whose texts it stands */
  unsigned certified; /* and in whose certificates it stands */
  unsigned if_read;   /* there only where a sentence reads it */
};
/* From the i-th on the first that --at can set; NULL: there is no other. */
const struct point_quantity *point_settable(size_t *i);
/* From the i-th on the first that the point's certificate has; NULL: there is no other.  read: bit for each quantity
   (Q_CHI, ...) that a sentence reads there. */
const struct point_quantity *point_certified(size_t *i, const struct point *p, unsigned read);
/* From the i-th on the first of the paper's own symbols that has a value there and that one of the tapes reads (NULL:
   whatever is read); NULL: there is no other. */
const struct symbol *point_own(size_t *i, const struct point *p, const struct tape *read, const struct tape *given);
/* "chi = 3/4, eta = 2, ..." with what matters for its kind, and of the paper's own symbols those of point_own. */
void point_print(struct text *out, const struct point *p);
void point_print_read(struct text *out, const struct point *p, const struct tape *read, const struct tape *given);
/* Applies "chi=1/2,V=2" to the point, which keeps the string where its names are the paper's own symbols. */
bool point_set(struct point *p, const char *at, struct diag *d);
/* The value that such a string gives the name; false where it gives none. */
bool point_told(fmpq_t z, const char *at, const char *name);

/* A condition that narrows the domain, tried when a sentence fails on the whole of it. */
struct restriction {
  const char *text; /* "V = 1" */
  int quantity;
  const char *value;
};
extern const struct restriction restrictions[];
extern const int n_restrictions;

/* Orbits found so far, by what is given and precision. */
struct orbit_cache;
struct orbit_cache *orbit_cache_new(void);
void orbit_cache_free(struct orbit_cache *c);
/* From now on lists hold what the search misses too, as those that `orbit` shows: for who is told a number by it. */
void orbit_cache_complete(struct orbit_cache *c);
/* The orbits at five exact parameters, enclosed at prec bits. */
const struct dyn_orbits *orbit_cache_get(struct orbit_cache *c, const fmpq params[N_PARAMS], slong prec);
/* The orbits among which a POINT_ORBIT is one, enclosed for work at prec bits. */
const struct dyn_orbits *point_orbits(const struct point *p, struct orbit_cache *c, slong prec);

/* All solutions at five exact parameters: those of motion/branches.h with t_c up to until or, at until = 0, the orbits
   of the word, as complete.h completes them. */
const struct dyn_orbits *orbit_cache_solutions(struct orbit_cache *c, const fmpq params[N_PARAMS], double until,
                                               slong prec);

/* Where the pool of orbit_pool.h is kept, which dies with the cache. */
struct orbit_pool **orbit_cache_pool(struct orbit_cache *c);

/* The orbit followed in the context of params, which are the orbit's own (followed.h). */
struct followed *orbit_followed(struct orbit_cache *c, const struct dyn_orbit *o, const struct num_vec *params);

/* What the return map and motions do beside an orbit, whatever a sentence says of it (judge/criterion.c). */
struct orbit_slope {
  const struct dyn_orbit *orbit;
  bool have_slope, have_iterates, have_motion;
  int status; /* of the slope */
  double slope, margin;
  int iterates, motion; /* fates */
};
/* What is known so far, at first nothing; lives until another is asked for. */
struct orbit_slope *orbit_cache_slope(struct orbit_cache *c, const struct dyn_orbit *o);

/* Orbits that were met before, so that none is counted twice; full, it lets no new one in. */
struct orbit_set {
  const struct dyn_orbit *at[256];
  int n;
};
bool orbit_is_new(struct orbit_set *set, const struct dyn_orbit *o);

/* Reduces an orbit point's number to one of the orbits there are; false when there is none. */
bool point_settle(struct point *p, struct orbit_cache *c);

/* Which points are meant: what they all have in common, as struct point says it, and how many of them. */
struct point_spec {
  enum point_kind kind;
  enum phase phase;
  bool admissible, realistic, finite;
  long n;
  const struct model *paper;
  const struct restriction *restriction; /* NULL: none */
};
/* A stream of such points at random, seeded from an id. */
struct sampler {
  uint64_t state;
  struct point_spec spec;
};
void sampler_init(struct sampler *s, const char *id, const struct point_spec *spec);
void sampler_next(struct point *p, struct sampler *s);
/* The k-th point (from 0) at which what holds elsewhere may not: equal parameters, V = 1, small and large ones, and
   small and large friction, at most of which there is an admissible orbit; false beyond the last.  *meant: the
   restriction, if there is one, is kept. */
bool sampler_special(struct point *p, bool *meant, struct sampler *s, int k);

/* The point at the scene's own parameters that is like p in everything else; false when the scene has no orbit. */
bool scene_point(struct point *out, const struct point *p, const struct scene *s, struct orbit_cache *cache);

#endif
