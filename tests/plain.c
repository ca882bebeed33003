#include "plain.h"

#include <string.h>

void plain_system(real a[16], const struct plain *p, int ph) {
  bool slips1 = ph == PHASE_GAMMA || ph == PHASE_H, slips2 = ph == PHASE_H || ph == PHASE_C;
  for (int i = 0; i < 16; i++) a[i] = 0;
  a[2] = a[7] = 1;
  if (slips1) {
    a[8] = -1;
    a[9] = p->chi;
  }
  if (slips2) {
    a[12] = p->chi * p->eta;
    a[13] = -p->chi * p->eta;
  }
}

void plain_product(real *z, const real *x, const real *y, int m, int n, int p) {
  real w[16];
  for (int i = 0; i < m; i++)
    for (int j = 0; j < p; j++) {
      w[i * p + j] = 0;
      for (int k = 0; k < n; k++) w[i * p + j] += x[i * n + k] * y[k * p + j];
    }
  memcpy(z, w, (size_t)(m * p) * sizeof *z);
}

/* Taylor at t/2^n, squared n times. */
void plain_propagator(real phi[16], const struct plain *p, int ph, real t) {
  enum { TERMS = 24, HALVINGS = 10 };
  real a[16], term[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  plain_system(a, p, ph);
  for (int i = 0; i < 16; i++) a[i] *= t / (1 << HALVINGS);
  memcpy(phi, term, sizeof term);
  for (int k = 1; k <= TERMS; k++) {
    plain_product(term, term, a, 4, 4, 4);
    for (int i = 0; i < 16; i++) phi[i] += term[i] /= k;
  }
  for (int k = 0; k < HALVINGS; k++) plain_product(phi, phi, phi, 4, 4, 4);
}

void plain_flow(real out[4], const struct plain *p, int ph, const real z[4], real t) {
  real phi[16];
  plain_propagator(phi, p, ph, t);
  plain_product(out, phi, z, 4, 4, 1);
}

real plain_switching(const struct plain *p, int ph, const real z[4]) {
  switch (ph) {
  case PHASE_D:
    return z[0] - p->chi * z[1] - p->e1;
  case PHASE_GAMMA:
    return p->chi * (z[1] - z[0]) - p->e2;
  case PHASE_H:
    return z[2] - p->v;
  default:
    return z[3] - p->v;
  }
}

/* Newton with the slope from a central difference. */
real plain_end(real z[4], const struct plain *p, int ph, real t) {
  for (int k = 0; k < 8; k++) {
    real at[4], before[4], after[4], h = 1e-6L;
    plain_flow(at, p, ph, z, t);
    plain_flow(before, p, ph, z, t - h);
    plain_flow(after, p, ph, z, t + h);
    t -= plain_switching(p, ph, at) * 2 * h / (plain_switching(p, ph, after) - plain_switching(p, ph, before));
  }
  plain_flow(z, p, ph, z, t);
  return t;
}

/* Central differences at h and h/2, extrapolated. */
void plain_derivative(real out[4], const struct plain *p, int from, int to, const real z[4], const real dz[4],
                      const real t[4]) {
  real d[2][4];
  for (int k = 0; k < 2; k++) {
    real h = k ? 1e-4L / 2 : 1e-4L, end[2][4];
    for (int side = 0; side < 2; side++) {
      for (int i = 0; i < 4; i++) end[side][i] = z[i] + (side ? h : -h) * dz[i];
      for (int ph = from; ph <= to; ph++) plain_end(end[side], p, ph, t[ph]);
    }
    for (int i = 0; i < 4; i++) d[k][i] = (end[1][i] - end[0][i]) / (2 * h);
  }
  for (int i = 0; i < 4; i++) out[i] = (4 * d[1][i] - d[0][i]) / 3;
}

real real_of(const fmpq_t q) {
  return (real)fmpz_get_d(fmpq_numref(q)) / (real)fmpz_get_d(fmpq_denref(q));
}

struct plain plain_of(const struct point *p) {
  return (struct plain){real_of(&p->q[Q_CHI]), real_of(&p->q[Q_ETA]), real_of(&p->q[Q_V]), real_of(&p->q[Q_E1]),
                        real_of(&p->q[Q_E2])};
}
