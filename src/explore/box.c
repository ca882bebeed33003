/* Orbits over a box of parameters, by pieces.

   A piece that is not proved, or on which something is left undecided that no other piece has settled to change, is
   halved along the parameter that moves (t_b, t_c) most.  Some cuts are made in any case: enclosures over a piece grow
   with its width twice, by what the orbit moves and by what balls add to that. */
#include "box.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "curve.h"
#include "motion/orbit_judge.h"
#include "motion/warm.h"

enum { BOX_PREC = 96, MOST_DEPTH = 24 };

struct piece {
  struct tube tube;
  struct dyn_orbit orbit;
  truth word;
  int depth;
  bool proved, cut; /* cut: its halves stand for it */
};

/* Those that are not cut cover the box. */
struct pieces {
  struct piece *at;
  size_t n, cap;
};

static struct piece *pieces_add(struct pieces *list, int depth) {
  struct piece *p = SS_PUSH(list->at, list->n, list->cap);
  *p = (struct piece){.word = TRUTH_UNKNOWN, .depth = depth};
  return p;
}

static void pieces_clear(struct pieces *list) {
  for (size_t i = 0; i < list->n; i++) {
    tube_clear(&list->at[i].tube);
    dyn_orbit_clear(&list->at[i].orbit);
  }
  free(list->at);
}

/* --- Truths over the box. --- */

enum { OF_WORD = N_CONDITIONS, OF_STABILITY, N_TRUTHS };

static truth truth_of(const struct piece *p, int i) {
  return i == OF_WORD ? p->word : i == OF_STABILITY ? p->orbit.stable : p->orbit.holds[i];
}

/* Whether a piece says so. */
static bool is_somewhere(const struct pieces *list, int i, truth t) {
  for (size_t k = 0; k < list->n; k++)
    if (list->at[k].proved && !list->at[k].cut && truth_of(&list->at[k], i) == t) return true;
  return false;
}

static bool changes(const struct pieces *list, int i) {
  return is_somewhere(list, i, TRUTH_TRUE) && is_somewhere(list, i, TRUTH_FALSE);
}

static truth truth_over(const struct pieces *list, int i) {
  if (is_somewhere(list, i, TRUTH_UNKNOWN) || changes(list, i)) return TRUTH_UNKNOWN;
  return is_somewhere(list, i, TRUTH_TRUE) ? TRUTH_TRUE : TRUTH_FALSE;
}

/* --- Pieces. --- */

/* The parameter along which the two unknowns move most over the piece. */
static int widest(const struct tube *t) {
  int best = -1;
  double most = -1;
  for (int i = 0; i < N_PARAMS; i++) {
    if (arb_is_exact(&t->p[i])) continue;
    double size = tube_reach(t, i, BOX_PREC);
    if (best < 0 || size > most) {
      best = i;
      most = size;
    }
  }
  return best;
}

/* One half of a ball, the lower or the upper; together they cover it. */
static void halve(arb_t half, const arb_t whole, bool upper) {
  NUMBERS(arb, end, mid);
  if (upper)
    arb_get_ubound_arf(arb_midref(end), whole, BOX_PREC);
  else
    arb_get_lbound_arf(arb_midref(end), whole, BOX_PREC);
  arb_get_mid_arb(mid, whole);
  arb_union(half, mid, end, BOX_PREC);
}

static void examine(struct piece *p) {
  p->proved = tube_prove(&p->tube, BOX_PREC) == SS_OK && tube_orbit(&p->orbit, &p->word, &p->tube, BOX_PREC) == SS_OK;
  if (p->proved) tube_sharpen(&p->orbit, &p->tube, BOX_PREC);
}

static bool finished(const struct piece *p, const struct pieces *list, int halvings) {
  if (!p->proved || p->depth < halvings) return false;
  for (int i = 0; i < N_TRUTHS; i++)
    if (truth_of(p, i) == TRUTH_UNKNOWN && !changes(list, i)) return false;
  return true;
}

/* Its halves go to the end of the list.  false when it cannot be cut. */
static bool cut(struct pieces *list, size_t place) {
  int along = widest(&list->at[place].tube);
  if (along < 0) return false;
  for (int i = 0; i < 2; i++) {
    struct piece *half = pieces_add(list, list->at[place].depth + 1);
    const struct tube *whole = &list->at[place].tube;
    tube_set(&half->tube, whole);
    halve(&half->tube.p[along], &whole->p[along], i == 1);
  }
  list->at[place].cut = true;
  return true;
}

/* Whether two pieces have a face in common. */
static bool meet(const struct tube *a, const struct tube *b) {
  int across = 0; /* the parameters in which they only touch */
  for (int i = 0; i < N_PARAMS; i++) {
    if (!arb_overlaps(&a->p[i], &b->p[i])) return false;
    double reach = mag_get_d(arb_radref(&a->p[i])) + mag_get_d(arb_radref(&b->p[i]));
    double apart = fabs(num_arb.get_d(&a->p[i]) - num_arb.get_d(&b->p[i]));
    if (!arb_is_exact(&a->p[i]) && apart > reach * (1 - 1e-9)) across++;
  }
  return across <= 1;
}

/* Whether the pieces hold one solution where they meet: at the middle of what they share, inside both boxes. */
static bool joined(const struct tube *a, const struct tube *b) {
  OWNED(tube) both = {.up = a->up};
  for (int i = 0; i < N_PARAMS; i++) {
    if (!arb_intersection(&both.p[i], &a->p[i], &b->p[i], BOX_PREC)) abort(); /* they meet */
    arb_get_mid_arb(&both.p[i], &both.p[i]);
  }
  for (int k = 0; k < 2; k++) arb_set(&both.x[k], &a->x[k]);
  bool same = tube_prove(&both, BOX_PREC) == SS_OK;
  for (int k = 0; k < 2; k++)
    same = same && arb_contains(&a->box[k], &both.x[k]) && arb_contains(&b->box[k], &both.x[k]);
  return same;
}

static bool all_joined(const struct pieces *list) {
  for (size_t i = 0; i < list->n; i++)
    for (size_t k = i + 1; k < list->n; k++) {
      const struct piece *a = &list->at[i], *b = &list->at[k];
      if (!a->cut && !b->cut && meet(&a->tube, &b->tube) && !joined(&a->tube, &b->tube)) return false;
    }
  return true;
}

/* --- The union. --- */

static void unite(struct dyn_orbit *all, struct dyn_orbit *o, bool first) {
  arb_ptr to[ORBIT_BALLS], from[ORBIT_BALLS];
  dyn_orbit_balls(to, all);
  dyn_orbit_balls(from, o);
  for (int i = 0; i < ORBIT_BALLS; i++)
    if (first)
      arb_set(to[i], from[i]);
    else
      arb_union(to[i], to[i], from[i], BOX_PREC);
}

static void conclude(struct dyn_box_orbit *b, const struct pieces *list) {
  bool first = true;
  for (size_t i = 0; i < list->n; i++) {
    if (list->at[i].cut) continue;
    unite(&b->orbit, &list->at[i].orbit, first);
    first = false;
  }
  b->word = truth_over(list, OF_WORD);
  b->orbit.stable = truth_over(list, OF_STABILITY);
  b->stability_changes = changes(list, OF_STABILITY);
  b->orbit.admissible = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS; i++) {
    b->orbit.holds[i] = truth_over(list, i);
    b->changes[i] = changes(list, i);
    b->orbit.admissible = truth_and(b->orbit.admissible, b->orbit.holds[i]);
  }
}

/* Whether the surface goes through the orbit at the middle: Newton's iteration may have ended at another.  Where a
   piece holds the middle and the orbit lies in its box, the orbit is the one solution there. */
static bool passes(const struct pieces *list, const struct dyn_orbit *o, const fmpq middle[N_PARAMS]) {
  for (size_t i = 0; i < list->n; i++) {
    const struct tube *t = &list->at[i].tube;
    bool holds = !list->at[i].cut && t->up == arb_gt(o->z20, o->z10);
    for (int k = 0; k < N_PARAMS; k++) holds = holds && arb_contains_fmpq(&t->p[k], &middle[k]);
    for (int k = 0; k < 2; k++) holds = holds && arb_contains(&t->box[k], o->t[PHASE_GAMMA + k]);
    if (holds) return true;
  }
  return false;
}

/* From the orbit at the middle, which b->orbit is on entry. */
static void continue_over(struct dyn_box_orbit *b, const arb_struct p[N_PARAMS], const fmpq middle[N_PARAMS],
                          int halvings) {
  OWNED(pieces) list = {NULL, 0, 0};
  struct tube *whole = &pieces_add(&list, 0)->tube;
  for (int i = 0; i < N_PARAMS; i++) arb_set(&whole->p[i], &p[i]);
  for (int k = 0; k < 2; k++) arb_set(&whole->x[k], b->orbit.t[PHASE_GAMMA + k]);
  whole->up = arb_gt(b->orbit.z20, b->orbit.z10);
  bool stuck = false;
  for (size_t i = 0; i < list.n; i++) { /* the list grows */
    examine(&list.at[i]);
    bool room = list.at[i].depth < MOST_DEPTH && (size_t)b->pieces + (list.n - i) < DYN_BOX_PIECES;
    if (!finished(&list.at[i], &list, halvings) && room && cut(&list, i)) continue;
    stuck = !list.at[i].proved;
    if (stuck) break;
    b->pieces++;
  }
  b->proved = !stuck && passes(&list, &b->orbit, middle) && all_joined(&list);
  if (b->proved) {
    conclude(b, &list);
    return;
  }
  b->orbit.stable = b->orbit.admissible = TRUTH_UNKNOWN;
  for (int i = 0; i < N_CONDITIONS; i++) b->orbit.holds[i] = TRUTH_UNKNOWN;
}

int dyn_box_find(struct dyn_box *box, const fmpq *low, const fmpq *high, int halvings) {
  struct dyn_orbits list;
  FMPQ_VECTOR(middle, N_PARAMS);
  ARB_VECTOR(p, N_PARAMS);
  NUMBERS(arb, end);
  *box = (struct dyn_box){NULL, 0};
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_add(&middle[i], low + i, high + i);
    fmpq_div_2exp(&middle[i], &middle[i], 1);
    arb_set_fmpq(p + i, low + i, BOX_PREC);
    arb_set_fmpq(end, high + i, BOX_PREC);
    arb_union(p + i, p + i, end, BOX_PREC);
  }
  int status = dyn_orbits_find(&list, middle, BOX_PREC, NULL);
  box->at = ss_malloc(((size_t)list.n + 1) * sizeof *box->at);
  for (slong i = 0; i < list.n; i++) {
    struct dyn_box_orbit *b = &box->at[box->n];
    *b = (struct dyn_box_orbit){.orbit = list.orbit[i], .word = TRUTH_UNKNOWN}; /* taken over */
    continue_over(b, p, middle, halvings);
    box->n++;
  }
  free(list.orbit);
  return status;
}

void dyn_box_clear(struct dyn_box *box) {
  for (slong i = 0; i < box->n; i++) dyn_orbit_clear(&box->at[i].orbit);
  free(box->at);
  *box = (struct dyn_box){NULL, 0};
}
