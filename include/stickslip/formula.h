/* The paper's formulas: any expression in its notation, typeset, and evaluated in a layer to N digits.

   A layer is one reading of the paper: as printed; as corrected by the errata on file; the corrected formulas in a form
   that keeps its digits in double precision.  Names are the paper's, omega_1, J_c, H(t_c)[1,3], k_3'; an expression may
   be a matrix of at most 16 entries.  The language: stickslip-eq(5). */
#ifndef SS_FORMULA_H
#define SS_FORMULA_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The paper's equations, their corrections, the claims about them and the controls; milliseconds of loading, read only
   after. */
typedef struct ss_paper ss_paper;
/* data: the data folder, NULL for the usual one. */
SS_API int ss_paper_open(ss_paper **out, const char *data);
SS_API void ss_paper_free(ss_paper *p);

enum ss_layer { SS_PRINTED, SS_CORRECTED, SS_STABLE, SS_LAYERS };
/* "printed", "corrected", "stable"; NULL beyond. */
SS_API const char *ss_layer_name(int layer);

typedef struct ss_formula ss_formula;
/* Reads an expression, with every name replaced by what the layer says.  section: where it is read, "" for anywhere,
   since the paper uses some letters twice.  SS_INPUT with the place: an unknown name, a wrong shape, notation that
   could be read in two ways.  The paper has to outlive the formula. */
SS_API int ss_formula_open(ss_formula **out, const ss_paper *p, int layer, const char *text, const char *section);
SS_API void ss_formula_free(ss_formula *f);
SS_API int ss_formula_rows(const ss_formula *f);
SS_API int ss_formula_columns(const ss_formula *f);
/* The expression as it was written, in LaTeX. */
SS_API int ss_formula_latex(char **out, const ss_formula *f);

/* Where a formula is evaluated, or a Jacobian: orbit k of the scene (ss_orbits_find's order) is k, from 0. */
enum ss_place {
  SS_AT_PRINTED = -1,   /* the numbers that the scene prints */
  SS_AT_PARAMETERS = -2 /* chi, eta, V, e1 and e2 alone */
};
/* Evaluates it in balls of rising precision until every entry is known to so many digits (1 to 10000).  at: orbit k, on
   which z_10, t_a, ... are the orbit's, or SS_AT_PARAMETERS.  values: what else has a value there, "t=1/2,lambda=3", or
   NULL; it may name chi, eta, V, e1, e2 in place of the scene's with SS_AT_PARAMETERS.  t, lambda, x, y, u_s1 and u_s2
   have no other value anywhere; u_r1 and u_r2 are e1 + u_s1 and e2 + u_s2.  SS_DOMAIN: it is not defined there.
   SS_UNABLE: so many digits could not be had, as of a value that is zero.  SS_INPUT: some symbol in it has no value
   there. */
SS_API int ss_formula_evaluate(ss_formula *f, const ss_scene *s, long at, const char *values, size_t digits);
/* An entry of the last evaluation, row and column from 0; NULL before one, and beyond. */
SS_API const ss_number *ss_formula_value(const ss_formula *f, int row, int column);

#ifdef __cplusplus
}
#endif

#endif
