/* The return map of the word in double precision, with t_b as its argument: phases Gamma, H and C, of which t_b alone
   fixes where they start, by the formulas of slip.h. */
#ifndef STICKSLIP_RETURN_MAP_DOUBLE_H
#define STICKSLIP_RETURN_MAP_DOUBLE_H

#include "num/pi.h"
#include "slip.h"
#include "trig_sum.h"

/* t*: the first time in phase Gamma at which m1 would reach the belt's speed, where the rise of chi r has its first
   crest. */
static inline double gamma_crest(double a, double e1) {
  return PI + 2 * atan2(a, e1);
}

struct return_map_double {
  struct slip slip;
  double rho;  /* hypot(a, e1) */
  double fall; /* t* */
  double rise; /* a record of chi r that falls into a later period begins this long after its start */
};
/* One pass from t_b: the defect is r at the end minus the r at the stick phase that leads to this t_b. */
struct pass {
  int status; /* SS_OK, or that of the search for t_c */
  double tb, tc;
  double r, r_end;      /* at the stick phase; at the end */
  double defect, slope; /* slope: d defect / d t_b */
  double wc, rc, qc;    /* state at the end of phase H */
  double dtc, dqc;      /* d t_c / d t_b, d q_c / d t_b */
  double pb;            /* z_1' - V at t_b: d r / d t_b */
  double safe;          /* t_c does not jump while t_b moves by less than about this */
  bool grazing;
  long steps;
};
/* SS_DOMAIN outside the domain of dynamics.h.  rise is left to return_map_double_records: few need it, and it takes an
   iteration. */
int return_map_double_init(struct return_map_double *k, const double params[N_PARAMS]);
void return_map_double_records(struct return_map_double *k);
/* How far chi r / chi has risen t after the start of phase Gamma. */
double return_map_double_rise(const struct return_map_double *k, double t);
/* The first time at which it has risen by g > 0. */
double return_map_double_time(const struct return_map_double *k, double g);
/* The largest |r| that phase C can end with. */
double return_map_double_reach(const struct return_map_double *k);
/* near: NULL, or a pass with a t_c close by that neither grazes nor jumps on the way from there to tb: t_c is followed
   from it, and safe is what it leaves. */
void return_map_double_pass(struct pass *s, const struct return_map_double *k, double tb, const struct pass *near,
                            const struct dyn_limits *lim);
/* The last phase and the next stick phase: t_d and t_a. */
void return_map_double_times(double *ta, double *td, const struct return_map_double *k, const struct pass *s);

#endif
