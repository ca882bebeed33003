/* Friction laws without a jump, with a slope s at the speed of the belt, for the equations of motion (1):

     tanh       u_i = u_si tanh x                                       x = s (V - x_i')/V
     stribeck   u_i = tanh x (u_si + rise_i exp(-(x/10)^2))             as wide as the slope: 10/s
     wide       u_i = tanh x (u_si + rise_i exp(-x^2/s))                wider than it: 1/sqrt(s)

   rise_i is such that the largest value of u_i is u_ri.  As s grows, tanh tends to Coulomb's law (2) with u_ri = u_si,
   stribeck and wide to that with the u_ri given.  State: w, r, p = x_1' - V, q = x_2' - V. */
#ifndef STICKSLIP_BENCH_SMOOTH_H
#define STICKSLIP_BENCH_SMOOTH_H

#include "bench/stepper.h"
#include "motion/dynamics.h"

enum smooth_law { LAW_TANH, LAW_STRIBECK, LAW_WIDE, N_LAWS };
extern const char *const smooth_law_name[N_LAWS];
enum { S_W, S_R, S_P, S_Q };

struct smooth {
  double chi, eta, V, slope, width; /* width of the static part in x */
  double sliding[2], rise[2];
  double level; /* the section: q falls through it */
};

/* params: chi, eta, V, e1, e2; u_si = u_ri - e_i.  The level is left to the caller. */
void smooth_init(struct smooth *m, enum smooth_law law, double slope, const double params[N_PARAMS],
                 const double static_limit[2]);
/* u_i at the speed V + p, and its derivative by p. */
double smooth_friction(double *rate, const struct smooth *m, int mass, double p);
/* The system with tolerances: absolute ones of the speeds are small enough to see the creep, which is about V/s.  No
   step is longer than longest, lest a passage of the section be stepped over. */
struct stepper_system smooth_system(const struct smooth *m, double tolerance, double longest);

/* What is met on the way from one passage of the section to the next. */
struct smooth_passage {
  double time;
  long steps;
  double nearest; /* the least of the larger one of |p| and |q|: how nearly both masses stick */
  double creep;   /* |p| or |q|, the larger one, at the end of the first step that passes the time creep_at */
};
/* How it is gone. */
struct smooth_way {
  const struct smooth *m;
  struct stepper *stepper;
  double creep_at, longest;
  long most_steps;
};
/* From y on the section to the next passage, y there.  SS_DOMAIN when there is none within longest, SS_UNABLE when the
   integrator fails or takes more than most_steps. */
int smooth_return(struct smooth_passage *s, double y[STEPPER_SIZE], const struct smooth_way *way);

#endif
