/* Six equations for a periodic orbit, as they stand after the paper's conditions: w = e1 after t_a, chi r = e2 after
   t_b, z_1' = V after t_c, z_2' = V after t_d, and w and r as at the start.  The state (w, r, z_1', z_2') goes through
   the four phases, and with it its derivatives by the unknowns. */
#include <math.h>
#include <string.h>

#include "bench/jobs.h"
#include "bench/yardstick.h"

/* Matrix functions of K: the entries from the values at the two squared frequencies. */
static void function_of(double f[4], const struct yardstick *s, double slow, double fast) {
  f[0] = s->above * slow + s->below * fast;
  f[1] = s->cross * (slow - fast);
  f[2] = s->back * (slow - fast);
  f[3] = s->below * slow + s->above * fast;
}

static void matrix_h(double m[N_Y][N_Y], const struct yardstick *s, double t) {
  double sine[2], cosine[2], c[4], ss[4], ks[4], om0 = s->om[0], om1 = s->om[1];
  for (int i = 0; i < 2; i++) {
    sine[i] = sin(s->om[i] * t);
    cosine[i] = cos(s->om[i] * t);
  }
  function_of(c, s, cosine[0], cosine[1]);
  function_of(ss, s, sine[0] / om0, sine[1] / om1);
  function_of(ks, s, sine[0] * om0, sine[1] * om1);
  double q = s->stiff;
  const double rows[N_Y][N_Y] = {{c[0], q * c[1], ks[0], ks[1]},
                                 {c[2] / q, c[3], ks[2] / q, ks[3] / q},
                                 {-ss[0], -q * ss[1], c[0], c[1]},
                                 {-ss[2], -q * ss[3], c[2], c[3]}};
  memcpy(m, rows, sizeof rows);
}

static void matrix(double m[N_Y][N_Y], const struct yardstick *y, enum phase ph, double t) {
  if (ph == PHASE_H) {
    matrix_h(m, y, t);
    return;
  }
  double chi = y->chi, angle = ph == PHASE_C ? y->omc * t : t;
  double s = ph == PHASE_D ? 0 : sin(angle), c = ph == PHASE_D ? 1 : cos(angle), slow = s / y->omc;
  const double d[N_Y][N_Y] = {{1, 0, t, -chi * t}, {0, 1, -t, t}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const double gamma[N_Y][N_Y] = {
      {c, 0, s, -chi * s}, {1 - c, 1, -s, (1 - chi) * t + chi * s}, {-s, 0, c, chi * (1 - c)}, {0, 0, 0, 1}};
  const double last[N_Y][N_Y] = {{1, chi * (1 - c), (1 - chi) * t + chi * slow, -chi * slow},
                                 {0, c, -slow, slow},
                                 {0, 0, 1, 0},
                                 {0, -y->omc * s, 1 - c, c}};
  memcpy(m, ph == PHASE_D ? d : ph == PHASE_GAMMA ? gamma : last, sizeof d);
}

/* z and, when wanted, its derivatives by the unknowns, through a phase of the given length. */
static void step(double z[N_Y], double dz[N_Y][SIX], bool wanted, const struct yardstick *y, enum phase ph, double t) {
  double m[N_Y][N_Y], from[N_Y], f[N_Y], before[N_Y][SIX];
  matrix(m, y, ph, t);
  memcpy(from, z, sizeof from);
  for (int i = 0; i < N_Y; i++) z[i] = m[i][0] * from[0] + m[i][1] * from[1] + m[i][2] * from[2] + m[i][3] * from[3];
  if (!wanted) return;
  memcpy(before, dz, sizeof before);
  bench_motion_field(f, &(struct bench_motion){.chi = y->chi, .stiff = y->stiff, .phase = ph}, z);
  for (int i = 0; i < N_Y; i++)
    for (int k = 0; k < SIX; k++)
      dz[i][k] = m[i][0] * before[0][k] + m[i][1] * before[1][k] + m[i][2] * before[2][k] + m[i][3] * before[3][k];
  for (int i = 0; i < N_Y; i++) dz[i][2 + ph] += f[i];
}

void bench_six(double f[SIX], double j[SIX * SIX], const double *params, const double x[SIX]) {
  struct yardstick y;
  yardstick_init(&y, params);
  const double start[2] = {x[0] - y.chi * x[1], x[1] - x[0]}, by_start[2][2] = {{1, -y.chi}, {-1, 1}};
  const int watched[N_PHASES] = {Y_W, Y_R, Y_V1, Y_V2};
  const double wanted[N_PHASES] = {params[P_E1], params[P_E2] / y.chi, y.V, y.V};
  double z[N_Y] = {start[0], start[1], y.V, y.V}, dz[N_Y][SIX] = {{1, -y.chi}, {-1, 1}};
  for (int ph = 0; ph < N_PHASES; ph++) {
    step(z, dz, j != NULL, &y, (enum phase)ph, x[2 + ph]);
    f[ph] = z[watched[ph]] - wanted[ph];
    if (j) memcpy(j + SIX * ph, dz[watched[ph]], sizeof dz[0]);
  }
  for (int i = 0; i < 2; i++) {
    f[4 + i] = z[i] - start[i];
    for (int k = 0; j && k < SIX; k++) j[SIX * (4 + i) + k] = dz[i][k] - (k < 2 ? by_start[i][k] : 0);
  }
}
