/* A strip: phase Gamma ends at some t_b of a narrow interval, and phase H from there, in disks, with bounds of its
   derivatives that hold for all time.  With what the strips stand on: the parameters and times as disks. */
#ifndef STICKSLIP_STRIP_H
#define STICKSLIP_STRIP_H

#include "disk.h"
#include "map_balls.h"

/* The parameters as disks.  angle stands for t_b modulo 2 pi; r at the stick phase is base(angle) - k turn after k full
   periods of phase Gamma. */
struct disk_params {
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
bool disk_params_init(struct disk_params *s, const fmpq *params);
void disk_params_clear(struct disk_params *s);

void disk_sin_cos(struct disk *sine, struct disk *cosine, arb_srcptr angle);
/* A time in phase H: an exact number, and the sines and cosines of om t. */
struct clock {
  double t;
  struct disk sine[2], cosine[2];
};
void clock_set(struct clock *c, const struct disk_params *s, double t);
/* to = c + step, both exact.  step is the time of a clock. */
void clock_turn(struct clock *to, const struct clock *c, const struct clock *step);

/* A motion of phase H at a time, from its modes: velocities, w and r. */
struct disk_motion {
  struct disk v[2], w, r;
};
static inline struct disk_motion disk_motion_at(const struct disk_params *s, const struct disk a[2],
                                                const struct disk b[2], const struct clock *t) {
  struct disk v[2], f[2];
  for (int i = 0; i < 2; i++) {
    v[i] = disk_cross(a[i], t->cosine[i], b[i], t->sine[i]);
    f[i] = disk_dot(a[i], t->sine[i], b[i], t->cosine[i]);
  }
  return (struct disk_motion){{disk_dot(s->back[0], v[0], s->back[1], v[1]), disk_dot(s->y[0], v[0], s->y[1], v[1])},
                              disk_dot(s->force1[0], f[0], s->force1[1], f[1]),
                              disk_dot(s->force2[0], f[0], s->force2[1], f[1])};
}

/* The modes a, b of the motion that starts with velocities v1, v2, the force w on z_1 and the pull chi eta r on z_2. */
void disk_modes(struct disk a[2], struct disk b[2], const struct disk_params *s, struct disk v1, struct disk v2,
                struct disk w, struct disk pull);

/* t - 2 pi k */
struct disk disk_less_turns(arb_srcptr t, double k);

/* Bounds of a function of (angle, t) on a strip for all t: of its derivatives, f by the angle. */
struct derivative_bounds {
  double ff, fff, ft, tt, fft;
};
struct strip {
  const struct disk_params *s;
  double angle, half;       /* midpoint and half width */
  struct disk u, w, pb;     /* at the midpoint: w' = p + a, w, and p at t_b */
  struct disk base;         /* e2/chi - rise */
  struct disk a[2], b[2];   /* the modes: velocity a cos - b sin, force/om = a sin + b cos */
  struct disk da[2], db[2]; /* their derivatives by the angle */
  double most[2];           /* of hypot(a, b), as far as reach */
  struct derivative_bounds p, q, r;
  bool later; /* some k > 0 can be */
};
/* The strip from low to high, whose parameters must outlive it; bounds hold as far as reach from its midpoint. */
void strip_make(struct strip *p, const struct disk_params *s, double low, double high, double reach);
/* The same strip with bounds that hold as far as reach. */
void strip_reach(struct strip *p, double reach);
/* p stays below zero for all time. */
bool strip_never(const struct strip *p);

#endif
