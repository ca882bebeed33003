/* The equations of a periodic solution as data: the switching conditions (12) and (14), and the periodicity conditions
   (16), (18) in three bases.  (16) and the return of z'_1 are one equation, since phase C leaves z'_1 alone; so six
   equations are independent, two switching and four periodicity conditions.

   The bases: the conditions one by one as (16) and (18) state them; the positions in the combinations that are the
   restoring forces; and solved for z_0 as in (44)-(46), by the positions (F) or by the velocities (G), where row i of
   (45) says that F and G give the same z_i0. */
#include "readings_impl.h"

const char *const carry_text[N_CARRIES] = {"full precision", "as printed", "rounded to 3 decimals",
                                           "rounded to 2 decimals"};

enum {
  Z = 1U << X_Z10 | 1U << X_Z20,
  A = Z | 1U << X_TA,
  B = A | 1U << X_TB,
  C = B | 1U << X_TC,
  F = C | 1U << X_TD,
  TIMES = F & ~Z
};

const struct equation equations[N_EQ] = {
    [EQ_12] = {"(12) z_1a - chi z_2a = e_1", A | 1U << X_E1, 1, {1}, {0, -1}, X_E1},
    [EQ_14] = {"(14) chi (z_2b - z_1b) = e_2", B | 1U << X_E2, 2, {0}, {-1, 1}, X_E2},
    [EQ_16] = {"(16) z'_1c = V, the return of z'_1 in (18)", C, 3, {0, 0, 1, 0}, {0}, RIGHT_V},
    [EQ_V2] = {"(18) z'_2 returns", F, 4, {0, 0, 0, 1}, {0}, RIGHT_V},
    [EQ_Z1] = {"(18) z_1 returns", F, 4, {1}, {0}, RIGHT_START},
    [EQ_Z2] = {"(18) z_2 returns", F, 4, {0, 1}, {0}, RIGHT_START},
    [EQ_W] = {"(18) z_1 - chi z_2 returns", F, 4, {1}, {0, -1}, RIGHT_START},
    [EQ_R] = {"(18) z_2 - z_1 returns", F, 4, {-1, 1}, {0}, RIGHT_START},
    [EQ_F1] = {"(46), row 1: z_10 = -[(N_1 - I)^-1 N_2 z'_0]_1", TIMES | 1U << X_Z10, 0, {0, 0}, {0}, X_Z10},
    [EQ_F2] = {"(46), row 2: z_20 = -[(N_1 - I)^-1 N_2 z'_0]_2", TIMES | 1U << X_Z20, 0, {0, 1}, {0}, X_Z20},
    [EQ_G1] =
        {"(44), velocities, row 1: z_10 = -[N_3^-1 (N_4 - I) z'_0]_1", TIMES | 1U << X_Z10, 0, {1, 0}, {0}, X_Z10},
    [EQ_G2] =
        {"(44), velocities, row 2: z_20 = -[N_3^-1 (N_4 - I) z'_0]_2", TIMES | 1U << X_Z20, 0, {1, 1}, {0}, X_Z20},
};

int bits_count(unsigned mask) {
  int n = 0;
  for (; mask; mask &= mask - 1) n++;
  return n;
}

static int add_forms(struct form *forms, int n, enum basis basis, const int eq[4]) {
  unsigned all = 0;
  for (int i = 0; i < 4; i++) all |= 1U << eq[i];
  for (unsigned m = 0; m < 16; m++) {
    unsigned held = 0;
    for (int i = 0; i < 4; i++)
      if (m >> i & 1) held |= 1U << eq[i];
    unsigned first = m & 3, second = m >> 2; /* the two pairs of the basis */
    /* A basis other than the paper's own gives something new only where a pair of it is neither whole nor missing. */
    bool one_force = first == 1 || first == 2;
    bool mixed = !((first == 0 || first == 3) && (second == 0 || second == 3));
    if (basis == BASIS_PAPER || (basis == BASIS_FORCES ? one_force : mixed))
      forms[n++] = (struct form){basis, held, all};
  }
  return n;
}

int forms_list(struct form forms[MAX_FORMS]) {
  static const int paper[4] = {EQ_Z1, EQ_Z2, EQ_16, EQ_V2}, forces[4] = {EQ_W, EQ_R, EQ_16, EQ_V2},
                   solved[4] = {EQ_F1, EQ_F2, EQ_G1, EQ_G2};
  int n = add_forms(forms, 0, BASIS_PAPER, paper);
  n = add_forms(forms, n, BASIS_FORCES, forces);
  return add_forms(forms, n, BASIS_SOLVED, solved);
}
