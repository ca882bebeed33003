/* The 2x2 Jacobian J of one period, (z10, z20) -> (z1f, z2f), and the local Jacobians of its phases, by several
   methods.

   Its determinant is exactly 0, since all that precedes t_a is a map to one number; its trace is the multiplier. */
#ifndef SS_JACOBIAN_H
#define SS_JACOBIAN_H

#include "formula.h"

#ifdef __cplusplus
extern "C" {
#endif

enum ss_method {
  SS_ANALYTIC,  /* the paper's J_f J_c J_b J_a (26)-(43), in a layer */
  SS_IMPLICIT,  /* implicit differentiation at the events */
  SS_SALTATION, /* saltation matrices between matrix exponentials */
  SS_FD,        /* central differences in multiprecision */
  SS_FD_DOUBLE, /* the same in double precision, about eleven digits */
  SS_ODE,       /* differences of a numerical integration of (1)-(2), about eight digits */
  SS_METHODS
};
/* "analytic", "implicit", "saltation", "fd", "fd-double", "ode"; NULL beyond. */
SS_API const char *ss_method_name(int method);

typedef struct ss_jacobian ss_jacobian;
/* J at orbit `at` from 0, or SS_AT_PRINTED: from the state that the scene prints, the paper's formulas at the printed
   times. layer: of the paper's formulas, for SS_ANALYTIC alone.  The radius of an entry is the accuracy that the method
   states (of differences: an estimate); the first four methods reach the digits asked for (1 to 100000) where the scene
   lets them. SS_INPUT: there is no such orbit or no printed state, the scene names another word, or a method has no
   answer there. */
SS_API int ss_jacobian_find(ss_jacobian **out, const ss_paper *p, const ss_scene *s, int method, int layer, long at,
                            size_t digits);
SS_API void ss_jacobian_free(ss_jacobian *j);
/* Row and column from 0; NULL beyond. */
SS_API const ss_number *ss_jacobian_entry(const ss_jacobian *j, int row, int column);
SS_API const ss_number *ss_jacobian_trace(const ss_jacobian *j);
SS_API const ss_number *ss_jacobian_det(const ss_jacobian *j);

/* Every matrix by every method side by side, so that a wrong entry is located. */
typedef struct ss_phases ss_phases;
enum ss_matrix { SS_J_A, SS_J_B, SS_J_C, SS_J_F, SS_J, SS_MATRICES };
SS_API int ss_phases_find(ss_phases **out, const ss_paper *p, const ss_scene *s, long at, size_t digits);
SS_API void ss_phases_free(ss_phases *z);
/* The columns: the paper's as printed and as corrected, then the other methods; their names, NULL beyond. */
SS_API const char *ss_phases_column(int column);
SS_API int ss_phases_rows(const ss_phases *z, int matrix);
SS_API int ss_phases_columns(const ss_phases *z, int matrix);
/* The entry; NULL where the method has no answer. */
SS_API const ss_number *ss_phases_entry(const ss_phases *z, int matrix, int column, int i, int k);
/* 1 where that entry is disjoint from those of more than half of the other methods. */
SS_API int ss_phases_departs(const ss_phases *z, int matrix, int column, int i, int k);

#ifdef __cplusplus
}
#endif

#endif
