/* Eigenvalues in double precision by GSL's QR iteration, which knows nothing of a vanishing determinant. */
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "dynamics.h"

int dyn_eigenvalues_d(double re[2], double im[2], const double m[4]) {
  double a[4], parts[4];
  for (int i = 0; i < 4; i++) {
    if (!isfinite(m[i])) return SS_UNABLE;
    a[i] = m[i];
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(a, 2, 2);
  gsl_vector_complex_view values = gsl_vector_complex_view_array(parts, 2);
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  gsl_eigen_nonsymm_workspace *w = gsl_eigen_nonsymm_alloc(2);
  int failed = gsl_eigen_nonsymm(&matrix.matrix, &values.vector, w);
  gsl_eigen_nonsymm_free(w);
  gsl_set_error_handler(old);
  if (failed) return SS_UNABLE;
  int first = parts[2] < parts[0] || (parts[2] == parts[0] && parts[3] < parts[1]) ? 1 : 0;
  for (int i = 0; i < 2; i++) {
    re[i] = parts[2 * (i ^ first)];
    im[i] = parts[2 * (i ^ first) + 1];
  }
  return SS_OK;
}
