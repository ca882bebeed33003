/* What the files of the complete search share.

   strip  phase Gamma ends at some t_b of a narrow interval: phase H from there, with bounds for all time
   cell   a strip during a short stretch of phase H: what can be excluded there, what is proved there
   line   t_b and one of e1, e2 given: the zeros along t_c
   sweep  strips marched through phase H until t_c lies behind them: every common zero is collected
   complete.c says from that whether a list of orbits is complete */
#ifndef STICKSLIP_SWEEP_H
#define STICKSLIP_SWEEP_H

#include "disk.h"
#include "motion_impl.h"

/* The parameters as disks.  angle stands for t_b modulo 2 pi; r at the stick phase is base(angle) - k turn after k full
   periods of phase Gamma. */
struct stage {
  struct disk chi, V, a, e1, e2; /* a = (1 - chi) V */
  struct disk span;              /* e2/chi, r at the end of phase Gamma */
  struct disk eta, pull;         /* pull = eta e2 */
  struct disk stiff;             /* chi eta */
  struct disk soft;              /* 1/stiff */
  struct disk omega;             /* its root, the frequency of phase C */
  struct disk rho;               /* hypot(a, e1) */
  struct disk turn;              /* 2 pi a */
  struct disk fall;              /* t*, the angle of a crest of the rise */
  struct disk crest;             /* the height of the first crest */
  struct disk om[2];
  struct disk x[2];       /* root(eta) (x, y): how z_1's velocity and force enter the modes */
  struct disk y[2];       /* (y, -x): how those of z_2 enter, and the modes z_2 */
  struct disk back[2];    /* (x, y)/root(eta): how the modes enter z_1 */
  struct disk force1[2];  /* om back: w from F_i/om_i */
  struct disk force2[2];  /* om y / stiff: r */
  struct disk inverse[2]; /* 1/om */
  arb_t exact[2];         /* om, for sines and cosines */
};
/* false outside what double precision can hold. */
bool stage_init(struct stage *s, const fmpq *params);
void stage_clear(struct stage *s);

/* A time in phase H: an exact number, and the sines and cosines of om t. */
struct clock {
  double t;
  struct disk sine[2], cosine[2];
};
void clock_set(struct clock *c, const struct stage *s, double t);
/* to = c + step, both exact.  step is the time of a clock. */
void clock_turn(struct clock *to, const struct clock *c, const struct clock *step);

/* t - 2 pi k */
struct disk disk_less_turns(arb_srcptr t, double k);

/* Bounds of a function of (angle, t) on a strip for all t: of its derivatives, f by the angle. */
struct bend {
  double f, ff, fff, ft, tt, fft;
};
struct strip {
  double angle, half;       /* midpoint and half width */
  struct disk u, w, pb;     /* at the midpoint: w' = p + a, w, and p at t_b */
  struct disk base;         /* e2/chi - rise */
  struct disk a[2], b[2];   /* the modes: velocity a cos - b sin, force/om = a sin + b cos */
  struct disk da[2], db[2]; /* their derivatives by the angle */
  double most[2];           /* of hypot(a, b), as far as reach */
  struct bend p, q, r;
  bool later; /* some k > 0 can be */
};
/* The strip from low to high; bounds hold as far as reach from its midpoint. */
void strip_make(struct strip *p, const struct stage *s, double low, double high, double reach);
/* The same strip with bounds that hold as far as reach. */
void strip_reach(struct strip *p, const struct stage *s, double reach);
/* p stays below zero for all time. */
bool strip_never(const struct strip *p, const struct stage *s);

/* Which k can be, for each sign of r at the end of phase C: index 1 for r > 0, 0 for r < 0 (zero belongs to both). */
struct turns {
  double from[2], to[2];
};
/* The k for which the energy of phase H suffices; empty ranges when there is none. */
struct turns strip_turns(const struct strip *p, const struct stage *s);
/* The k for which r at the stick phase, base - k turn, is r_end: |r_end| in radius, its signs as told. */
struct turns turns_of(const struct turns *within, const struct stage *s, struct disk base, struct disk radius,
                      bool negative, bool positive);
double turns_count(const struct turns *k);
/* No zero for any time, since even two phases that run freely would not meet the equations. */
bool strip_misses(const struct strip *p, const struct stage *s, const struct turns *k);

/* The motion at the middle of a cell. */
struct cell {
  struct disk p, q, r, w, pf, qf, rf; /* f: derivatives by the angle */
  double early;                       /* half of its length in time */
  bool first;                         /* it starts with phase H */
};
void cell_at(struct cell *c, const struct strip *p, const struct stage *s, const struct clock *t);

/* A common zero, proved to be the only one in the box of half widths room around at; it lies within near. */
struct common {
  double k, at[2], near[2], room[2]; /* pairs: angle, time */
};
enum look { LOOK_CLEAR, LOOK_ZERO, LOOK_OPEN };
/* Whether the cell is proved to hold no zero with any k; or exactly one, which *zero describes.  dir = 1 when p starts
   below zero, -1 when above.  Where the answer is open for one k and no zero was found for another, zero->k is that k,
   else -1. */
enum look cell_look(struct common *zero, const struct cell *c, const struct strip *p, const struct stage *s,
                    const struct turns *k, double dir);
/* The part of the strip, from *low to *high relative to its midpoint, where dir p may still not be positive at the
   cell's middle; false when there is none. */
bool cell_waiting(double *low, double *high, const struct cell *c, const struct strip *p, double dir);
/* Where the wider side of an undecided cell is. */
bool cell_wide_in_angle(const struct cell *c, const struct strip *p);
/* At most two zeros with this k in the box of half widths (angle, time) around the cell's middle, which t is.  The
   strip's bounds must reach as far in the angle. */
bool cell_folds_once(const struct cell *c, const struct strip *p, const struct stage *s, const struct clock *t,
                     double k, const double half[2]);

/* --- The sweep. --- */

/* A zero that is known already, in the box of half widths near around at. */
struct known {
  double k, at[2], near[2];
  bool met; /* by a proof that it and another one are all there is around */
};

enum { SWEEP_LEVELS = 64, SWEEP_LOWEST = 44 }; /* of steps: 2^(index - SWEEP_LOWEST) */

struct sweep {
  struct stage stage;
  struct clock step[SWEEP_LEVELS];
  int level; /* the usual step */
  struct known *known;
  size_t n_known;
  struct common *zeros;
  size_t n, cap;
  long cells, budget;
  bool spent;      /* the budget */
  bool stuck;      /* a cell could not be decided: a double zero, or one nearly so */
  bool crest;      /* t_b at the very crest of the rise could not be excluded */
  double where[2]; /* t_b and t_c of the first cell that was stuck */
};
/* Every common zero of p and H_k, k = 0, 1, ..., with 0 < t_b <= t* and t_c no later than the first root of p: in zeros,
   each once or twice, or among the known ones that were met; unless spent, stuck or crest says that something was left
   open.  false outside what double precision can hold. */
bool sweep_run(struct sweep *s, const fmpq *params, struct known *known, size_t n_known, long budget);
void sweep_clear(struct sweep *s);

/* --- t_b and one of e1, e2 given. --- */

/* A zero t_c, proved to be the only one within room of at; it lies within near of it, and belongs to the value e of the
   unknown one of e1, e2. */
struct line_zero {
  double at, near, room;
  struct disk e;
};
struct line {
  struct line_zero *zeros;
  size_t n, cap;
  long cells;
  bool spent, stuck;
  double where;
};
/* Every t_c in (0, last] at which some positive value of the unknown satisfies both equations, unless spent or stuck.
   params: the element unknown, P_E1 or P_E2, is not looked at.  false outside what double precision can hold. */
bool line_run(struct line *s, const fmpq *params, int unknown, const fmpq *tb, double last, long budget);
void line_clear(struct line *s);

#endif
