/* The paper's names: every list of them stands in names.c and nowhere else.  Those of the phases are phase_name
   (motion/dynamics.h), those of a scene's keys, in which e_1 is e1, scene_key_name (scene/scene.h). */
#ifndef STICKSLIP_VALUE_NAMES_H
#define STICKSLIP_VALUE_NAMES_H

#include "expr/expr.h"
#include "motion/dynamics.h"

extern const char *const name_param[N_PARAMS];              /* "chi", "eta", "V", "e_1", "e_2" */
extern const char *const name_time[N_PHASES];               /* "t_a" ... "t_d" */
extern const char *const name_shift[N_PHASES];              /* "dt_a" ... "dt_d": changes of the times */
extern const char *const name_switching[N_PHASES + 1];      /* "0", "t_a", "t_a + t_b", ... */
extern const char *const name_state[N_PHASES + 1][N_STATE]; /* of Z_0, Z_a, Z_b, Z_c and Z_f: "z_10" ... "z'_2f" */
extern const char
    *const name_tangent[N_PHASES + 1][N_STATE];      /* of dZ_0 ... dZ_f: "x", "y", "u", "v", "x_a" ... "v_f" */
extern const char *const name_meeting[N_PHASES - 1]; /* "S_a", "S_b", "S_c": the states in which phases meet */
enum { N_OF_POINT = 5 };
extern const char *const name_of_point[N_OF_POINT]; /* in the order of Q_US1, ...: "u_s1", "u_s2", "x", "y", "lambda" */

/* What the paper's names stand for.  "z_10" ... "z'_2c": 4 times the state (Z_0, Z_a, Z_b, Z_c) plus the component;
   "t_a" ... "t_d": 100 and more; -1 for another name. */
int name_of_arc(const char *name);
/* "x", "x_a" ... "v_f", "u" and "v": likewise; "dt_a" ... "dt_d": 100 and more. */
int name_of_tangent(const char *name);
/* "D(t)" ... "C(t)", the propagators of the phases: 0 to 3; -1 for another name. */
int name_of_propagator(const char *name);
/* "z_1''(t)", "x_2(t_a + dt_a)". */
struct motion_name {
  bool in_x;
  int component, primes;
  const char *argument; /* with its parentheses */
};
bool name_of_motion(struct motion_name *out, const char *name);
/* What no scene gives, and no solution fixes: the friction of sliding, positions in x, which are z and what it makes,
   perturbations, the unknown of the characteristic equation. */
bool name_is_free(const char *name);
/* t, and what is worth something at the time t. */
bool name_goes_with_time(const char *name);
/* "(0)", "(t_a)", "(t_a + t_b)", ...: 0 to 4, which is also the number of the state there; at the perturbed times
   "(t_a + dt_a)", ... 5 to 8; -1 for another argument.  The terms may stand in any order. */
int name_of_switching_time(const char *argument);
/* "(t_b + t_c)": the lengths of phases in a sum of them, as bits; -1 for another argument. */
int name_of_lengths(const char *argument);
/* The phase that lasts just as long as the statement's range, "(t_a, t_a + t_b)"; N_PHASES: none. */
enum phase name_of_range(const struct stmt *s);
/* The first and the last of the phases, one or several, that together last just as long; N_PHASES: there are none. */
enum phase name_of_span(enum phase *last, const struct stmt *s);

#endif
