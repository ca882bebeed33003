/* The suite's own model, derived from the equations of motion (1) and Coulomb's law (2) alone.

   Nothing here reads the paper's formulas.  With z = x - d (d the equilibrium under both sliding forces) the state is
   Z = (z_1, z_2, z_1', z_2').  The phases of the word D-Gamma-H-C:

     phase        sticking    slipping    equations of motion                              ends when
     PHASE_D      m1, m2      -           z_1'' = 0, z_2'' = 0                             z_1 - chi z_2 = e1
     PHASE_GAMMA  m2          m1          z_1'' = -(z_1 - chi z_2), z_2'' = 0              chi (z_2 - z_1) = e2
     PHASE_H      -           m1, m2      z_1'' = -(z_1 - chi z_2),
                                          z_2'' = -chi eta (z_2 - z_1)                     z_1' = V
     PHASE_C      m1          m2          z_1'' = 0, z_2'' = -chi eta (z_2 - z_1)          z_2' = V

   Accurate coordinates: w = z_1 - chi z_2 and r = z_2 - z_1 (the restoring forces are w and chi r), p = z_1' - V,
   q = z_2' - V; z_1 = (w + chi r)/(1 - chi), z_2 = (w + r)/(1 - chi).

   An orbit of the word solves the six equations with t_b, t_c, t_d the first positive roots of their own switching
   functions and t_a of any sign.  A switching function that is zero at the start of its phase does not count as a root
   there; it starts with the sign of its first derivative that is not zero.

   Everything but the double-precision search works over any rigorous or rounded number type: values are num_vec in one
   context, and the flags of status.h are returned.  Domain everywhere: 0 < chi < 1, eta > 0, V > 0, e1 > 0, e2 > 0. */
#ifndef STICKSLIP_MOTION_DYNAMICS_H
#define STICKSLIP_MOTION_DYNAMICS_H

#include <math.h>

#include "num/num.h"

enum phase { PHASE_D, PHASE_GAMMA, PHASE_H, PHASE_C, N_PHASES };
extern const char *const phase_name[N_PHASES]; /* "D", "Gamma", "H", "C" */
extern const int phase_slips[N_PHASES][2];     /* 1 for a mass that slips in the phase, 0 for one that sticks */

/* Parameters in a context: elements chi, eta, V, e1, e2 in this order. */
enum { P_CHI, P_ETA, P_V, P_E1, P_E2, N_PARAMS };
/* Whether the first n of them are positive, and chi below 1. */
bool dyn_in_domain(const fmpq *params, int n);
/* The same of all of them, which are finite too; without a branch, for lanes. */
static inline bool dyn_in_domain_d(const double params[N_PARAMS]) {
  bool in = params[P_CHI] < 1;
  for (int i = 0; i < N_PARAMS; i++) in &= (params[i] > 0) & (params[i] < INFINITY);
  return in;
}
/* State: elements z_1, z_2, z_1', z_2'. */
enum { Z_1, Z_2, DZ_1, DZ_2, N_STATE };

/* --- Propagators: the 4x4 matrix P with Z(t) = P Z(0), as the matrix exponential of the first-order system. --- */

/* The matrix A of Z' = A Z (16 elements, row-major). */
int dyn_system(struct num_vec *a, enum phase ph, const struct num_vec *params);
/* exp(A t).  double: GSL, measured within 3e-14 (1 + |A t|) of the largest entry; dyn_flow is ten to a thousand times
   closer.  mpfr: Taylor series with scaling and squaring, with enough guard bits that each entry is within 2^(4-prec)
   of the largest entry.  arb: Arb's own exponential.  a and t are in the context of p. */
int dyn_propagator(struct num_vec *p, enum phase ph, const struct num_vec *params, const void *t);

/* --- Closed form in (w, r), with the suite's own modal analysis. ---

   In double precision these, and dyn_local_jacobian and dyn_return_jacobian, are worked out in balls and rounded once:
   each number is within 2^-53 of itself, whatever the point.  SS_UNABLE where one is not zero and outside the range of
   normal doubles, or not known at 4096 bits.  A call takes some microseconds. */

/* Z after time t in the phase.  out may alias in. */
int dyn_flow(struct num_vec *out, enum phase ph, const struct num_vec *params, const struct num_vec *in, const void *t);
/* The matrix of that map, 16 elements. */
int dyn_flow_matrix(struct num_vec *p, enum phase ph, const struct num_vec *params, const void *t);
/* The phase's switching function (zero at its end): w - e1, chi r - e2, p, q. */
int dyn_switching(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *z);
/* Its gradient, which is constant, applied to v: what it changes by where the state changes by v. */
int dyn_switching_along(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *v);
/* Its derivative along the phase's own motion. */
int dyn_switching_rate(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *z);

/* --- Events. --- */

/* Limits of the searches; a search that reaches one answers SS_UNABLE. */
struct dyn_limits {
  double t_max;   /* longest phase looked at; default 1000 */
  long max_steps; /* steps of one first-root search; default 100000 */
};
extern const struct dyn_limits dyn_limits_default;

/* The root near t0, in the context of t: Newton in mpfr (working precision doubled up to prec); in balls an enclosure
   proved to hold exactly one root (Krawczyk's operator), SS_UNABLE when that fails. */
int dyn_event(void *t, enum phase ph, const struct num_vec *params, const struct num_vec *in, double t0);

/* One pass through the word from the positions (z10, z20) at the start of the stick phase, velocities V. */
struct dyn_arc {
  struct num_vec t; /* t_a, t_b, t_c, t_d */
  struct num_vec z; /* 5 states of 4: Z_0, Z_a, Z_b, Z_c, Z_f, row by row */
};
void dyn_arc_init(struct dyn_arc *a, struct num_ctx ctx);
void dyn_arc_clear(struct dyn_arc *a);
/* One of the states, by its row, as a vector that borrows the elements: the start of that phase, the end of the one
   before. */
struct num_vec dyn_arc_state(const struct dyn_arc *a, slong row);
/* guess: four times near which the events are taken, or NULL to find first events in double precision, from forces and
   velocities formed in the arc's own type.  An arc in double rounds its positions after each phase, which near chi = 1
   are 1/(1 - chi) times as large as what moves them: its later events are those of a start that has moved by that
   rounding. */
int dyn_arc_run(struct dyn_arc *a, const struct num_vec *params, const void *z10, const void *z20,
                const double guess[4]);

/* --- Derivatives of event-located maps. --- */

/* The 4x4 derivative of Z_start -> Z_end of one phase that starts at in and ends at its event at t: implicit
   differentiation, (I - f n^T / (n.f)) exp(A t), f the vector field and n the gradient of the switching function at the
   end.  SS_DOMAIN at an exactly grazing end. */
int dyn_local_jacobian(struct num_vec *j, enum phase ph, const struct num_vec *params, const struct num_vec *in,
                       const void *t);
/* The same column by column as central differences of the event-located map at step h = 2^(-prec/3) times the scale of
   the state, in mpfr.  err (one element, or NULL): an estimate of the truncation (from a second step) plus rounding
   error of the worst entry. */
int dyn_local_jacobian_fd(struct num_vec *j, void *err, enum phase ph, const struct num_vec *params,
                          const struct num_vec *in, double t0);
/* The 2x2 derivative of (z10, z20) -> (z1f, z2f) along an arc: the product of the four local ones, and by central
   differences of the whole map.  From a start in double precision: the events are found there, the pass and its
   derivative made in balls near them and rounded once, so that each entry is within 2^-53 of itself; some tens of
   microseconds.  guess may be NULL, as in dyn_arc_run. */
int dyn_return_jacobian(struct num_vec *j, const struct num_vec *params, const struct dyn_arc *arc);
int dyn_return_jacobian_from(double j[4], const double params[N_PARAMS], const double start[2], const double guess[4]);
/* The Taylor polynomial, n coefficients in ascending order, of the return map of r alone at the arc's start: c[0] is r
   at the arc's end, c[1] the slope (the trace of the return Jacobian), and so on, at most JET_MOST.  In balls: params
   and arc are of num_arb, and c encloses the coefficients at every point of the arc's enclosures. */
enum { JET_MOST = 6 };
int dyn_return_jet(arb_ptr c, slong n, const struct num_vec *params, const struct dyn_arc *arc);
int dyn_return_jacobian_fd(struct num_vec *j, void *err, const struct num_vec *params, const void *z10, const void *z20,
                           const double guess[4]);

/* The same two from saltation matrices: vector fields and matrix exponentials, no derivative of an event. */
int dyn_local_jacobian_saltation(struct num_vec *j, enum phase ph, const struct num_vec *params,
                                 const struct num_vec *in, const void *t);
int dyn_return_jacobian_saltation(struct num_vec *j, const struct num_vec *params, const struct dyn_arc *arc);
/* One phase, from a state of N_STATE numbers, which lasts about t. */
struct dyn_stretch {
  enum phase phase;
  const double *start;
  double t;
};
/* The same two by central differences in double precision, extrapolated from two steps; the step is chosen by the least
   estimated error.  The local one gives its derivatives along n_dir directions at the start, N_STATE numbers for each;
   err (or NULL) has an element for each direction, and one, of the worst entry, for the whole map: truncation (from the
   change between steps, about 15 times too large) plus rounding (from measured noise). */
int dyn_local_differences_d(double *out, double *err, const double params[N_PARAMS], const struct dyn_stretch *of,
                            const double (*dir)[N_STATE], int n_dir);
int dyn_return_jacobian_d(double j[4], double *err, const double params[N_PARAMS], const double start[2],
                          const double guess[4]);

/* The eigenvalues of a real 2x2 matrix by GSL's QR iteration, by increasing real part, then imaginary part. */
int dyn_eigenvalues_d(double re[2], double im[2], const double m[4]);

/* --- Periodic orbits of the word at given chi, eta, V, e1, e2. --- */

/* The conditions that a realistic orbit must fulfil besides the six equations: name, id, phase. */
#define DYN_CONDITIONS(C)                                                                                              \
  C(TA, "t_a", PHASE_D)                /* t_a > 0                         (51) */                                      \
  C(GAMMA_V1, "gamma_v1", PHASE_GAMMA) /* z_1' < V while m1 slips         (57) */                                      \
  C(H_V1, "h_v1", PHASE_H)             /* z_1' < V just after t_b              */                                      \
  C(H_V2, "h_v2", PHASE_H)             /* z_2' < V                             */                                      \
  C(C_V2, "c_v2", PHASE_C)             /* z_2' < V                        (59) */                                      \
  C(C_W, "c_w", PHASE_C)               /* z_1 - chi z_2 < e1              (59) */                                      \
  C(D_R, "d_r", PHASE_D)               /* chi (z_2 - z_1) < e2            (54) */                                      \
  C(GAMMA_R, "gamma_r", PHASE_GAMMA)   /* chi (z_2 - z_1) < e2 before t_b (57) */
#define CONDITION(name, id, phase) COND_##name,
enum { DYN_CONDITIONS(CONDITION) N_CONDITIONS };
#undef CONDITION
extern const char *const dyn_condition_id[N_CONDITIONS];

struct dyn_orbit {
  arb_t z10, z20, t[4], e1, e2, period, trace;
  arb_t margin; /* |trace| - 1 */
  truth stable; /* |trace| < 1 */
  truth holds[N_CONDITIONS];
  truth admissible;      /* all of them */
  truth first[N_PHASES]; /* the phase ends at the first root of its switching function */
  arb_t u_r1_min, u_r2_min;
  double guess[4]; /* the times in double precision */
  bool grazing;    /* some event is double, or two coincide, within double precision */
};
/* Whether the static friction is more than the least that an orbit needs, and than the excess e_i = u_ri - u_si, so
   that there is sliding friction; some is where it is not given. */
truth friction_enough(const fmpq *u_r, const arb_t excess, const arb_t least, slong prec);
/* That of mass 0 or 1 on the orbit. */
truth orbit_friction_enough(const struct dyn_orbit *o, int mass, const fmpq *u_r, slong prec);
/* Its numbers in the order in which outputs show them: the name there, the member, what it is. */
#define DYN_ORBIT_NUMBERS(N)                                                                                           \
  N("z10", z10, "position of m_1 where the global stick phase begins")                                                 \
  N("z20", z20, "position of m_2 there")                                                                               \
  N("t_a", t[0], "duration of the global stick phase, D")                                                              \
  N("t_b", t[1], "of the slip-stick phase, Gamma")                                                                     \
  N("t_c", t[2], "of the global slip phase, H")                                                                        \
  N("t_d", t[3], "of the stick-slip phase, C")                                                                         \
  N("e1", e1, "static less sliding friction of m_1")                                                                   \
  N("e2", e2, "static less sliding friction of m_2")                                                                   \
  N("period", period, "t_a + t_b + t_c + t_d")                                                                         \
  N("trace", trace, "tr J: the multiplier of a small displacement over one period")                                    \
  N("u_r1_min", u_r1_min, "least static friction that holds m_1 where it sticks; besides, u_r1 > e1")                  \
  N("u_r2_min", u_r2_min, "the same of m_2; besides, u_r2 > e2")

struct dyn_orbits {
  struct dyn_orbit *orbit;
  slong n;
  bool complete;    /* proved exhaustive: complete.h */
  long evaluations; /* of the return map, in the search */
  slong bits;       /* the largest working precision that was planned */
  long raises;      /* how often, over all orbits, it was not enough and was raised */
  int gap;          /* why it is not complete: enum dyn_gap of complete.h */
  double gap_at[2]; /* t_b and t_c near which something was left open */
  double t_c_max;   /* complete: with t_c up to this; 0 when t_c needs no bound */
  long cells;       /* of that proof */
};

/* Every orbit that the search finds, by increasing z10, each enclosed with relative radius below 2^-prec where the
   conditioning allows (the working precision is raised up to four times; beyond 512 bits it is planned from what the
   orbit loses at a low one).  The search is one in t_b (search.c) and ends where the energy of phase H cannot supply
   the r that is needed.  SS_UNABLE, with a list that is valid as far as it goes, when the search ran out of its budget
   of steps (hard parameters, after about half a second) or when a zero could not be told from a double one even at 16
   times the precision.  lim may be NULL. */
int dyn_orbits_find(struct dyn_orbits *list, const fmpq *params, slong prec, const struct dyn_limits *lim);
void dyn_orbits_clear(struct dyn_orbits *list);

/* The one-dimensional return map in double precision: r at the end of phase C from r at the stick phase, and its slope
   (slope and t may be NULL).  In plain double precision, for guesses: return_map.h says what it errs by, and has one
   that does not. */
int dyn_return_map_d(double *r_out, double *slope, double t[4], const double params[N_PARAMS], double r);

/* A gsl_error_handler_t for code that looks at what GSL returns.  Memory that ran out ends the program (arena.h), since
   GSL does not look itself whether it got any. */
void dyn_gsl_quiet(const char *reason, const char *file, int line, int number);

#endif
