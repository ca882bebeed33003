/* One orbit, and all orbits at one point.

   The warm start says what double precision can tell.  Where it leaves something open, or a margin is narrow, the orbit
   is enclosed in balls at the exact parameters, and these decide; orbits that the warm start does not take (later than
   the first crest, or beside a fold) are enclosed from the start. */
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "family_impl.h"
#include "motion/orbit_judge.h"
#include "motion/search.h"

enum { PREC = 64 };
static const double narrow = 1e-6; /* of |trace| - 1, and of a static friction over its bound */

const char *const dyn_family_status_name[N_FAMILY_STATUS] = {
    [FAMILY_OK] = "ok",         [FAMILY_UNDECIDED] = "undecided",
    [FAMILY_FOLD] = "fold",     [FAMILY_CONVERGENCE] = "no convergence",
    [FAMILY_BUDGET] = "budget", [FAMILY_RANGE] = "range"};

truth dyn_member_admissible(const struct dyn_member *m) {
  return m->violations ? TRUTH_FALSE : m->unsure || m->word != TRUTH_TRUE ? TRUTH_UNKNOWN : TRUTH_TRUE;
}

void family_move(struct family_line *l, slong i) {
  l->at = i;
  l->params[l->q->axis->vary] = dyn_axis_d(l->q->axis, i);
}

static double crest(const struct family_line *l) {
  return gamma_crest((1 - l->params[P_CHI]) * l->params[P_V], l->params[P_E1]);
}

double family_apart(const struct dyn_member *a, const struct dyn_member *b) {
  return fabs(a->out[DYN_OUT_TB] - b->out[DYN_OUT_TB]) + fabs(a->out[DYN_OUT_TC] - b->out[DYN_OUT_TC]);
}

bool family_akin(const struct dyn_member *a, const struct dyn_member *b) {
  return a->up == b->up && (a->out[DYN_OUT_TRACE] < 1) == (b->out[DYN_OUT_TRACE] < 1);
}

bool family_same(const struct dyn_member *a, const struct dyn_member *b) {
  return a->up == b->up && family_apart(a, b) <= 1e-6 * (a->out[DYN_OUT_TB] + a->out[DYN_OUT_TC]);
}

/* --- In balls. --- */

static void set_bit(struct dyn_member *m, int bit, truth holds) {
  if (holds == TRUTH_FALSE) m->violations |= 1U << bit;
  if (holds == TRUTH_UNKNOWN) m->unsure |= 1U << bit;
}

static void from_balls(struct dyn_member *m, const struct dyn_orbit *o, const struct family_line *l) {
  *m = (struct dyn_member){.stable = o->stable, .word = TRUTH_TRUE, .up = o->holds[COND_C_V2] == TRUTH_FALSE};
  for (int i = 0; i < N_DYN_OUT; i++) m->out[i] = num_arb.get_d(dyn_orbit_output(o, (enum dyn_output)i));
  for (int i = 0; i < N_CONDITIONS; i++) set_bit(m, i, o->holds[i]);
  for (int i = 0; i < N_PHASES; i++) m->word = truth_and(m->word, o->first[i]);
  for (int i = 0; i < 2; i++) set_bit(m, MEMBER_U_R + i, orbit_friction_enough(o, i, l->q->u_r[i], 4 * PREC));
}

static void exact_here(struct family_line *l) {
  dyn_axis_q(&l->exact[l->q->axis->vary], l->q->axis, l->at);
}

/* The orbit near guess, proved to be one of the word. */
static bool enclose(struct dyn_member *m, struct family_line *l, const double guess[2], bool up) {
  OWNED(dyn_orbit) o;
  struct dyn_place at = {guess[0], guess[1], up};
  truth first;
  exact_here(l);
  bool ok = dyn_orbit_near(&o, &first, l->exact, at, PREC, NULL) == SS_OK;
  ok = ok && first == TRUTH_TRUE;
  if (ok) from_balls(m, &o, l);
  return ok;
}

/* --- In double precision. --- */

void family_judge(struct dyn_member *m, struct family_line *l) {
  double size = fabs(m->out[DYN_OUT_TRACE]);
  bool open = m->unsure != 0 || fabs(size - 1) <= narrow;
  m->stable = size < 1 ? TRUTH_TRUE : TRUTH_FALSE;
  m->word = TRUTH_TRUE;
  m->up = m->violations >> COND_C_V2 & 1;
  for (int i = 0; i < 2; i++) {
    if (!l->q->u_r[i]) continue;
    double over = l->u_r[i] - m->out[i ? DYN_OUT_U2 : DYN_OUT_U1];
    if (over < 0) m->violations |= 1U << (MEMBER_U_R + i);
    open |= fabs(over) <= narrow * l->u_r[i];
  }
  if (!open) return;
  struct dyn_member sure;
  double guess[2] = {m->out[DYN_OUT_TB], m->out[DYN_OUT_TC]};
  if (enclose(&sure, l, guess, m->up)) {
    *m = sure;
    return;
  }
  m->stable = TRUTH_UNKNOWN;
  for (int i = 0; i < 2; i++)
    if (l->q->u_r[i]) m->unsure |= 1U << (MEMBER_U_R + i);
  m->violations &= ~m->unsure;
}

/* The phase C of the warm start's orbit may turn the other way; then it is another orbit. */
bool family_solve(struct dyn_member *m, struct family_line *l, const double guess[2], bool up) {
  if (guess[0] < crest(l) && dyn_orbit_warm(m->out, &m->violations, &m->unsure, l->params, guess) == SS_OK) {
    family_judge(m, l);
    return m->up == up;
  }
  return enclose(m, l, guess, up);
}

/* --- All orbits of a point. --- */

static void sort_by_z10(struct dyn_member *m, slong n) {
  for (slong i = 1; i < n; i++)
    for (slong k = i; k > 0 && m[k].out[DYN_OUT_Z10] < m[k - 1].out[DYN_OUT_Z10]; k--) {
      struct dyn_member t = m[k];
      m[k] = m[k - 1];
      m[k - 1] = t;
    }
}

static bool is_open(const struct dyn_member *m) {
  return m->word != TRUTH_TRUE || m->stable == TRUTH_UNKNOWN || m->unsure != 0;
}

void family_add(struct dyn_family *f, struct dyn_family_point *p, struct dyn_member *m, slong n) {
  sort_by_z10(m, n);
  p->first = (slong)f->n_members;
  p->n = n;
  for (slong i = 0; i < n; i++) {
    *SS_PUSH(f->member, f->n_members, f->cap_members) = m[i];
    if (is_open(&m[i]) && p->status == FAMILY_OK) p->status = FAMILY_UNDECIDED;
  }
}

static bool wanted(const struct family_line *l, double tb) {
  return l->q->late || tb < crest(l);
}

/* Newton's iteration from a zero of the search can only polish it. */
static bool is_near(const struct dyn_member *m, const double zero[2]) {
  double off = fabs(m->out[DYN_OUT_TB] - zero[0]) + fabs(m->out[DYN_OUT_TC] - zero[1]);
  return off <= 1e-6 * (zero[0] + zero[1]);
}

/* Each zero of the search by a warm start; false where that is not enough to be sure of the list. */
static bool list_warm(struct dyn_member *m, slong *n, struct family_line *l, const struct search *s) {
  *n = 0;
  for (size_t i = 0; i < s->n; i++) {
    const struct zero *z = &s->zeros[i];
    double guess[2] = {z->at.tb, z->at.tc};
    if (z->fold) return false;
    if (!wanted(l, z->at.tb)) continue;
    if (!family_solve(&m[*n], l, guess, z->at.up) || !is_near(&m[*n], guess)) return false;
    for (slong k = 0; k < *n; k++)
      if (family_same(&m[k], &m[*n])) return false;
    ++*n;
  }
  return true;
}

/* The same in balls throughout. */
static struct dyn_member *list_balls(slong *n, enum dyn_family_status *status, struct family_line *l,
                                     const struct search *s) {
  OWNED(dyn_orbits) list;
  bool fold = false;
  exact_here(l);
  int found = dyn_orbits_find(&list, l->exact, PREC, NULL);
  for (size_t i = 0; i < s->n; i++) fold |= s->zeros[i].fold;
  if (found && !s->cut) *status = fold ? FAMILY_FOLD : FAMILY_CONVERGENCE;
  struct dyn_member *m = ss_malloc(((size_t)list.n + 1) * sizeof *m);
  *n = 0;
  for (slong i = 0; i < list.n; i++)
    if (wanted(l, list.orbit[i].guess[1])) from_balls(&m[(*n)++], &list.orbit[i], l);
  return m;
}

void family_search(struct family_line *l, struct dyn_family_point *p) {
  OWNED(search) s;
  *p = (struct dyn_family_point){.x = l->params[l->q->axis->vary], .status = FAMILY_OK};
  l->f->searched++;
  if (search_run(&s, l->params, l->q->late, true, &dyn_limits_default)) {
    p->status = FAMILY_RANGE;
    return;
  }
  slong n;
  if (s.cut) p->status = FAMILY_BUDGET;
  struct dyn_member *m = ss_malloc((s.n + 1) * sizeof *m);
  if (!list_warm(m, &n, l, &s)) {
    free(m);
    m = list_balls(&n, &p->status, l, &s);
  }
  family_add(l->f, p, m, n);
  free(m);
}
