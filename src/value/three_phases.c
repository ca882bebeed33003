/* stickslip orbit on solution II: the word Gamma-H-C, of which t_a = 0 is given.

   It solves the equations of D-Gamma-H-C, but has no phase D: at the end of phase C m_2 comes to stick in the moment in
   which m_1 breaks loose.  So (51) asks nothing of t_a, and w = z_1 - chi z_2 reaches e1 at the end of phase C as it
   must, rising all the time by (60), where z_2' < V.  What (54) says of chi r is still asked: m_2 comes to stick only
   then.

   The return map keeps its slope tr J there.  A small displacement makes either of the two events the first; the
   saltation of m_2's capture sets z_2' - V to zero, that of m_1's break changes z_1' by -e1/w' times the change of w,
   neither heeds what the other changes, so they commute, and tr J is the slope on either side. */
#include "explore/family.h"
#include "motion/certify.h"
#include "solved.h"

bool three_phases_have(int margin) {
  return margin != COND_TA && margin != MARGIN_D_W && margin != MARGIN_D_W_LOW && margin != MARGIN_D_R_LOW;
}

static void judge(truth holds[N_CONDITIONS], truth *all) {
  if (holds[COND_C_V2] == TRUTH_TRUE) holds[COND_C_W] = TRUTH_TRUE;
  holds[COND_TA] = TRUTH_TRUE;
  *all = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS; i++) *all = truth_and(*all, holds[i]);
}

void judge_three_phases(struct dyn_orbits *list, struct dyn_certificate *proof) {
  for (slong i = 0; i < list->n; i++) {
    struct dyn_orbit *o = &list->orbit[i];
    struct dyn_certificate *z = &proof[i];
    judge(o->holds, &o->admissible);
    if (z->open & OPEN_ROOT) continue;
    judge(z->holds, &z->admissible);
    for (int k = 0; k < N_CONDITIONS; k++)
      if (z->holds[k] != TRUTH_UNKNOWN) z->open &= ~((unsigned)OPEN_HOLDS << k);
    z->certified = z->open == 0;
    if (!z->certified) continue;
    o->stable = z->stable;
    judge(z->holds, &o->admissible);
    for (int k = 0; k < N_CONDITIONS; k++) o->holds[k] = z->holds[k];
  }
}
