/* Branches of orbits along a line: steps, and the halving of those on which something changes. */
#include "follow.h"

#include <stdlib.h>

#include "base/arena.h"

enum { STEPS = 64, MOST_LOOKS = 20000 };

const char *const mech_turn_id[MECH_CONDITION + 1] = {"flip", "fold", "neimark-sacker", "condition"};

/* An orbit at a value of the parameter, or none. */
struct station {
  fmpq_t at;
  bool found;
  struct mech_orbit orbit;
};
struct walker {
  struct mech_follow *f;
  const struct mech_line *l;
  struct diag *d;
  bool backward;              /* from the line's second end */
  bool ended;                 /* the branch, with the last change */
  fmpq_t least;               /* the width at which a bracket is narrow enough */
  struct mech_orbits arrived; /* at the end that was walked to */
};

static bool has_stopped(const struct walker *w) {
  return w->d->set || w->f->looks >= MOST_LOOKS;
}

static void station_clear(struct station *s) {
  if (s->found) mech_orbit_clear(&s->orbit);
  fmpq_clear(s->at);
}

static void side_init(struct mech_side *out, const struct station *s) {
  *out = (struct mech_side){.found = s->found};
  fmpq_init(out->at);
  fmpq_set(out->at, s->at);
  if (!s->found) return;
  out->own = s->orbit.own;
  out->admissible = s->orbit.admissible;
  out->stable = s->orbit.stable;
  out->period = arf_get_d(arb_midref(s->orbit.period), ARF_RND_NEAR);
}

static void side_copy(struct mech_side *to, const struct mech_side *from) {
  *to = *from;
  fmpq_init(to->at);
  fmpq_set(to->at, from->at);
}

/* --- One step --- */

static int solve_near(struct mech_orbit *o, const struct mech *m, const struct mech_orbit *near, slong prec) {
  double t[MECH_PHASES], z[MECH_STATES];
  for (int k = 0; k < near->word.n; k++) t[k] = arf_get_d(arb_midref(near->t + k), ARF_RND_NEAR);
  for (int i = 0; i < near->states; i++) z[i] = arf_get_d(arb_midref(near->state + i), ARF_RND_NEAR);
  return mech_orbit_near(o, m, &near->word, t, z, prec);
}

static bool meet(const struct mech_orbit *a, const struct mech_orbit *b) {
  bool same = true;
  for (int k = 0; k < a->word.n; k++) same = same && arb_overlaps(a->t + k, b->t + k);
  for (int i = 0; i < a->word.n * a->states; i++) same = same && arb_overlaps(a->state + i, b->state + i);
  return same;
}

/* The orbit near one at another value; false: none. */
static bool solve_at(struct mech_orbit *o, struct walker *w, const fmpq_t at, const struct mech_orbit *near,
                     bool judged) {
  struct mech m;
  bool ok = mech_load_at(&m, w->l->path, w->l->name, at, w->d) && solve_near(o, &m, near, w->l->prec) == SS_OK;
  if (ok && judged) mech_orbit_judge(o, &m, w->l->prec);
  mech_clear(&m);
  return ok;
}

/* The orbit at to->at that the one of `from` becomes, if the way back from it leads there. */
static void reach(struct walker *w, struct station *to, const struct station *from) {
  struct mech_orbit back;
  if (has_stopped(w)) return;
  w->f->looks++;
  to->found = solve_at(&to->orbit, w, to->at, &from->orbit, true);
  if (!to->found) return;
  to->found = solve_at(&back, w, from->at, &to->orbit, false);
  if (to->found) {
    to->found = meet(&back, &from->orbit);
    mech_orbit_clear(&back);
  }
  if (!to->found) mech_orbit_clear(&to->orbit);
}

/* --- Changes --- */

static bool differ(const struct station *a, const struct station *b) {
  if (!b->found || a->orbit.stable != b->orbit.stable || a->orbit.n_facts != b->orbit.n_facts) return true;
  for (int i = 0; i < a->orbit.n_facts; i++)
    if (a->orbit.fact[i].holds != b->orbit.fact[i].holds) return true;
  return false;
}

static enum mech_turn turn_between(const struct station *a, const struct station *b) {
  acb_srcptr largest = a->orbit.multiplier;
  if (!b->found) return MECH_FOLD;
  if (a->orbit.stable == b->orbit.stable || b->orbit.own != TRUTH_TRUE) return MECH_CONDITION;
  if (!arb_is_zero(acb_imagref(largest))) return MECH_NEIMARK_SACKER;
  return arb_is_negative(acb_realref(largest)) ? MECH_FLIP : MECH_FOLD;
}

/* Does the condition make it no orbit of its word?  A phase that ends before it begins has but its length to show. */
static bool ends_the_word(const struct mech_orbit *o, const struct mech_fact *fact) {
  if (fact->holds != TRUTH_FALSE || fact->rule == MECH_LENGTH) return fact->holds == TRUTH_FALSE;
  return fact->ends && arb_is_positive(o->t + fact->phase);
}

/* The change between a and b; false where the branch ends with it. */
static bool add_change(struct walker *w, const struct station *a, const struct station *b) {
  struct mech_follow *f = w->f;
  f->change = ss_grow(f->change, (size_t)f->n_changes, &f->cap_changes, sizeof *f->change);
  struct mech_change *c = &f->change[f->n_changes++];
  *c = (struct mech_change){.what = turn_between(a, b), .branch = f->n_branches - 1};
  side_init(&c->side[w->backward], a);
  side_init(&c->side[!w->backward], b);
  w->ended = !b->found || b->orbit.own != TRUTH_TRUE;
  for (int i = 0; b->found && i < b->orbit.n_facts && c->n_facts < MECH_TURNED; i++) {
    const struct mech_fact *fact = &b->orbit.fact[i];
    if (w->ended ? ends_the_word(&b->orbit, fact) : fact->holds != a->orbit.fact[i].holds)
      c->fact[c->n_facts++] = *fact;
  }
  return !w->ended;
}

static bool narrow(const struct walker *w, const struct station *a, const struct station *b) {
  fmpq_t width;
  fmpq_init(width);
  fmpq_sub(width, a->at, b->at);
  fmpq_abs(width, width);
  bool yes = fmpq_cmp(width, w->least) <= 0;
  fmpq_clear(width);
  return yes;
}

/* There is an orbit, and all about it is settled, or at least that its phases are not those of the word. */
static bool is_settled(const struct station *s) {
  return s->found && (s->orbit.certified || s->orbit.own == TRUTH_FALSE);
}

/* Between two settled orbits one that is not: the bracket cannot be made narrower. */
static bool is_open(const struct station *a, const struct station *middle, const struct station *b) {
  return is_settled(a) && is_settled(b) && !is_settled(middle);
}

/* Finds the changes between a, which is found, and b, to which the way from a has been tried; true where the branch
   goes on to b, which may become found by it. */
static bool between(struct walker *w, const struct station *a, struct station *b) {
  struct station middle = {.found = false};
  if (has_stopped(w) || !differ(a, b)) return !has_stopped(w);
  if (narrow(w, a, b)) return add_change(w, a, b);
  fmpq_init(middle.at);
  fmpq_add(middle.at, a->at, b->at);
  fmpq_div_2exp(middle.at, middle.at, 1);
  reach(w, &middle, a);
  bool on;
  if (is_open(a, &middle, b)) {
    on = add_change(w, a, b);
  } else {
    on = between(w, a, &middle);
    if (on && !b->found) reach(w, b, &middle);
    on = on && between(w, &middle, b);
  }
  station_clear(&middle);
  return on;
}

/* --- Branches --- */

static void value_at(fmpq_t out, const struct mech_line *l, int k, bool backward) {
  fmpq_t part;
  fmpq_init(part);
  fmpq_set_si(part, backward ? STEPS - k : k, STEPS);
  fmpq_sub(out, l->to, l->from);
  fmpq_mul(out, out, part);
  fmpq_add(out, out, l->from);
  fmpq_clear(part);
}

/* Takes over the orbit at the end where the walk began; at the other end it goes to the list of those that arrived. */
static void walk(struct walker *w, struct mech_orbit *start) {
  struct mech_follow *f = w->f;
  struct station here = {.found = true, .orbit = *start};
  fmpq_init(here.at);
  value_at(here.at, w->l, 0, w->backward);
  f->branch = ss_grow(f->branch, (size_t)f->n_branches, &f->cap_branches, sizeof *f->branch);
  struct mech_branch *b = &f->branch[f->n_branches++];
  b->word = here.orbit.word;
  side_init(&b->end[w->backward], &here);
  w->ended = false;
  for (int k = 1; k <= STEPS && !w->ended && !has_stopped(w); k++) {
    struct station next = {.found = false};
    fmpq_init(next.at);
    value_at(next.at, w->l, k, w->backward);
    reach(w, &next, &here);
    bool on = between(w, &here, &next);
    station_clear(on ? &here : &next);
    if (on) here = next;
  }
  if (w->ended)
    side_copy(&b->end[!w->backward], &f->change[f->n_changes - 1].side[w->backward]);
  else
    side_init(&b->end[!w->backward], &here);
  if (!w->ended && !has_stopped(w))
    mech_orbits_add(&w->arrived, &here.orbit);
  else
    mech_orbit_clear(&here.orbit);
  fmpq_clear(here.at);
}

/* From each orbit at one end of the line that has not arrived there. */
static void walk_all(struct walker *w, const struct mech_word *word, bool backward) {
  struct mech m;
  struct mech_orbits list = {.n = 0};
  w->backward = backward;
  bool ok = mech_load_at(&m, w->l->path, w->l->name, backward ? w->l->to : w->l->from, w->d);
  if (ok) mech_orbits_find(&list, &m, word, false, w->l->prec);
  mech_clear(&m);
  for (int i = 0; i < list.n; i++) {
    if (list.orbit[i].own == TRUTH_TRUE && !mech_orbits_hold(&w->arrived, &list.orbit[i]))
      walk(w, &list.orbit[i]);
    else
      mech_orbit_clear(&list.orbit[i]);
  }
  free(list.orbit);
}

bool mech_follow(struct mech_follow *f, const struct mech_line *l, const struct mech_word *w, struct diag *d) {
  *f = (struct mech_follow){.n_changes = 0};
  struct walker walker = {.f = f, .l = l, .d = d};
  fmpq_init(walker.least);
  fmpq_sub(walker.least, l->from, l->to);
  fmpq_abs(walker.least, walker.least);
  fmpz_t ten;
  fmpz_init(ten);
  fmpz_ui_pow_ui(ten, 10, (ulong)l->digits);
  fmpq_div_fmpz(walker.least, walker.least, ten);
  fmpz_clear(ten);
  for (int backward = 0; backward < 2 && !d->set; backward++) walk_all(&walker, w, backward);
  f->spent = f->looks >= MOST_LOOKS;
  mech_orbits_clear(&walker.arrived);
  fmpq_clear(walker.least);
  return !d->set;
}

void mech_follow_clear(struct mech_follow *f) {
  for (int i = 0; i < f->n_changes; i++)
    for (int side = 0; side < 2; side++) fmpq_clear(f->change[i].side[side].at);
  for (int i = 0; i < f->n_branches; i++)
    for (int side = 0; side < 2; side++) fmpq_clear(f->branch[i].end[side].at);
  free(f->change);
  free(f->branch);
}
