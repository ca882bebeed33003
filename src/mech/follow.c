/* Branches of orbits along a line: steps, and the halving of those on which something changes. */
#include "follow.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"

enum { STEPS = 64, FROM_BOTH = 2 * (MECH_SEARCHED + STEPS), MOST_LOOKS = 4000, MOST_TIMES = 2 };
static const double AT_CIRCLE = 1e-3; /* beside a bracket a multiplier that passes the circle is this near to it */

const char *const mech_turn_id[MECH_NO_FURTHER + 1] = {"flip", "fold", "neimark-sacker", "condition", "lost"};

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
  const struct mech *first;   /* the system at the end where the walk begins; NULL: it is not yet read */
  bool backward;              /* from the line's second end */
  bool ended;                 /* the branch, with the last change */
  fmpq_t least, small;        /* the width at which a bracket is narrow enough; one at which neighbours are orbits */
  struct mech_orbits arrived; /* at the end that was walked to */
  size_t before;              /* of what progress counts, what was done from the other end */
  size_t done, branches;      /* steps of all branches from this end; how many branches there are at most */
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
  out->period = num_arb.get_d(s->orbit.period);
}

static void side_copy(struct mech_side *to, const struct mech_side *from) {
  *to = *from;
  fmpq_init(to->at);
  fmpq_set(to->at, from->at);
}

/* --- One step --- */

static bool load(struct mech *m, struct walker *w, const fmpq_t at) {
  const struct mech_given first = {w->l->given, w->l->name, {*at}, {*at}, NULL, 0};
  bool ok = mech_load_with(m, w->l->path, &first, false, w->d);
  if (ok && w->first && mech_other_order(m, w->first))
    ok = diag_set(w->d,
                  "%.300s: error: %s: along the line the loads' frequencies are not always the same multiples of one",
                  w->l->path, mech_other_order(m, w->first));
  if (!ok) fmpq_set(w->f->at, at);
  return ok;
}

/* An orbit of its word, of which everything is decided. */
static bool is_good(const struct station *s) {
  return s->found && s->orbit.certified && s->orbit.own == TRUTH_TRUE;
}

/* The orbit near one at another value, judged.  false: none. */
static bool solve_at(struct station *to, struct walker *w, const struct mech_orbit *near, slong prec) {
  OWNED(mech) m;
  bool found = load(&m, w, to->at) && mech_orbit_beside(&to->orbit, &m, near, prec) == SS_OK;
  if (found) mech_orbit_decide(&to->orbit, &m, prec);
  return found;
}

/* Does the orbit found at `to` lead back to the one that it was found from? */
static bool leads_back(struct walker *w, const struct station *to, const struct station *from, slong prec) {
  OWNED(mech) m;
  struct mech_orbit back;
  bool same = load(&m, w, from->at) && mech_orbit_beside(&back, &m, &to->orbit, prec) == SS_OK;
  if (!same) return false;
  same = mech_orbit_meets(&back, &from->orbit);
  mech_orbit_clear(&back);
  return same;
}

/* The orbit at to->at that the one of `from` becomes, or the solution of its equations that is none of the word.  Near
   another one it takes more digits to be told apart. */
static void reach(struct walker *w, struct station *to, const struct station *from) {
  if (has_stopped(w)) return;
  if (w->l->progress) w->l->progress(w->before + MECH_SEARCHED + w->done / w->branches, FROM_BOTH);
  if (to->found) mech_orbit_clear(&to->orbit);
  w->f->looks++;
  for (slong times = 1; times <= MOST_TIMES; times *= 2) {
    slong prec = times * w->l->prec;
    to->found = solve_at(to, w, &from->orbit, prec);
    if (!to->found) continue;
    if (leads_back(w, to, from, prec) && (is_good(to) || to->orbit.own == TRUTH_FALSE)) return;
    mech_orbit_clear(&to->orbit);
    to->found = false;
  }
}

/* --- Changes --- */

static bool differ(const struct station *a, const struct station *b) {
  if (!is_good(b) || a->orbit.stable != b->orbit.stable || a->orbit.n_facts != b->orbit.n_facts) return true;
  for (int i = 0; i < a->orbit.n_facts; i++)
    if (a->orbit.fact[i].holds != b->orbit.fact[i].holds) return true;
  return false;
}

/* Its multiplier nearest to the unit circle, and how far from that it is. */
static double nearest(acb_srcptr *z, const struct mech_orbit *o) {
  double least = HUGE_VAL;
  NUMBERS(arb, size);
  for (int i = 0; i < o->n_free; i++) {
    acb_abs(size, o->multiplier + i, 64);
    double off = fabs(num_arb.get_d(size) - 1);
    if (!(off < least)) continue;
    least = off;
    *z = o->multiplier + i;
  }
  return least;
}

/* Has it nearly become one that goes round once where it goes twice? */
static bool is_nearly_twice(const struct mech_orbit *o) {
  int half = o->word.n / 2;
  bool same = o->word.n % 2 == 0 && mech_word_goes_through(&o->word, &o->word, half);
  double period = num_arb.get_d(o->period);
  for (int k = 0; same && k < half; k++)
    same = fabs(num_arb.get_d(o->t + k) - num_arb.get_d(o->t + k + half)) < AT_CIRCLE * period;
  return same;
}

static enum mech_turn turn_between(const struct station *a, const struct station *b) {
  acb_srcptr z = NULL;
  if (b->found && (!is_good(b) || a->orbit.stable == b->orbit.stable)) return MECH_CONDITION;
  if (!(nearest(&z, &a->orbit) < AT_CIRCLE)) return b->found ? MECH_CONDITION : MECH_NO_FURTHER;
  if (!arb_is_zero(acb_imagref(z))) return b->found ? MECH_NEIMARK_SACKER : MECH_NO_FURTHER;
  if (!b->found && is_nearly_twice(&a->orbit)) return MECH_FLIP;
  if (!arb_is_negative(acb_realref(z))) return MECH_FOLD;
  return b->found ? MECH_FLIP : MECH_NO_FURTHER;
}

/* Does the condition make it no orbit of its word?  A phase that ends before it begins has but its length to show. */
static bool ends_the_word(const struct mech_orbit *o, const struct mech_fact *fact) {
  if (fact->holds != TRUTH_FALSE || fact->rule == MECH_LENGTH) return fact->holds == TRUTH_FALSE;
  return fact->ends && arb_is_positive(o->t + fact->phase);
}

/* The change between a and b; false where the branch ends with it. */
static bool add_change(struct walker *w, const struct station *a, const struct station *b) {
  struct mech_follow *f = w->f;
  struct mech_change *c = SS_PUSH(f->change, f->n_changes, f->cap_changes);
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

/* Is the bracket not wider than that? */
static bool narrow(const fmpq_t most, const struct station *a, const struct station *b) {
  NUMBERS(fmpq, width);
  fmpq_sub(width, a->at, b->at);
  fmpq_abs(width, width);
  return fmpq_cmp(width, most) <= 0;
}

/* Finds the changes between a, which is good, and b, to which the way from a has been tried; true where the branch goes
   on to b, which may become good by it. */
static bool between(struct walker *w, const struct station *a, struct station *b) {
  if (has_stopped(w) || !differ(a, b)) return !has_stopped(w);
  if (narrow(w->least, a, b)) return add_change(w, a, b);
  FREED struct station *middle = ss_malloc(sizeof *middle); /* many digits are many halvings: not on the stack */
  middle->found = false;
  fmpq_init(middle->at);
  fmpq_add(middle->at, a->at, b->at);
  fmpq_div_2exp(middle->at, middle->at, 1);
  reach(w, middle, a);
  bool on;
  if (!middle->found && b->found && (is_good(b) || narrow(w->small, a, b))) {
    on = add_change(w, a, b); /* just at it something cannot be decided, or a solution not proved */
  } else {
    on = between(w, a, middle);
    if (on && !is_good(b)) reach(w, b, middle);
    on = on && between(w, middle, b);
  }
  station_clear(middle);
  return on;
}

/* --- Branches --- */

static void value_at(fmpq_t out, const struct mech_line *l, int k, bool backward) {
  NUMBERS(fmpq, part);
  fmpq_set_si(part, backward ? STEPS - k : k, STEPS);
  fmpq_sub(out, l->to, l->from);
  fmpq_mul(out, out, part);
  fmpq_add(out, out, l->from);
}

/* Takes over the orbit at the end where the walk began; at the other end it goes to the list of those that arrived. */
static void walk(struct walker *w, struct mech_orbit *start) {
  struct mech_follow *f = w->f;
  struct station here = {.found = true, .orbit = *start};
  fmpq_init(here.at);
  value_at(here.at, w->l, 0, w->backward);
  struct mech_branch *b = SS_PUSH(f->branch, f->n_branches, f->cap_branches);
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
    w->done++;
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
  OWNED(mech) m;
  struct mech_orbits list = {.n = 0};
  w->backward = backward;
  w->before = backward ? FROM_BOTH / 2 : 0;
  const struct mech_tell tell = {w->l->progress, w->before, FROM_BOTH};
  bool ok = load(&m, w, backward ? w->l->to : w->l->from);
  if (ok) mech_orbits_find(&list, &m, word, false, w->l->prec, &tell);
  w->first = &m;
  w->branches = (size_t)list.n;
  for (int i = 0; i < list.n; i++) {
    w->done = (size_t)i * STEPS;
    if (list.orbit[i].own == TRUTH_TRUE && list.orbit[i].certified && !mech_orbits_hold(&w->arrived, &list.orbit[i]))
      walk(w, &list.orbit[i]);
    else
      mech_orbit_clear(&list.orbit[i]);
  }
  free(list.orbit);
  w->first = NULL;
}

bool mech_follow(struct mech_follow *f, const struct mech_line *l, const struct mech_word *w, struct diag *d) {
  *f = (struct mech_follow){.n_changes = 0};
  struct walker walker = {.f = f, .l = l, .d = d};
  fmpq_init(f->at);
  fmpq_init(walker.least);
  fmpq_sub(walker.least, l->from, l->to);
  fmpq_abs(walker.least, walker.least);
  fmpq_init(walker.small);
  fmpq_div_2exp(walker.small, walker.least, 30);
  NUMBERS(fmpz, ten);
  fmpz_ui_pow_ui(ten, 10, (ulong)l->digits);
  fmpq_div_fmpz(walker.least, walker.least, ten);
  for (int backward = 0; backward < 2 && !d->set; backward++) walk_all(&walker, w, backward);
  f->spent = f->looks >= MOST_LOOKS;
  mech_orbits_clear(&walker.arrived);
  fmpq_clear(walker.small);
  fmpq_clear(walker.least);
  return !d->set;
}

void mech_follow_clear(struct mech_follow *f) {
  fmpq_clear(f->at);
  for (int i = 0; i < f->n_changes; i++)
    for (int side = 0; side < 2; side++) fmpq_clear(f->change[i].side[side].at);
  for (int i = 0; i < f->n_branches; i++)
    for (int side = 0; side < 2; side++) fmpq_clear(f->branch[i].end[side].at);
  free(f->change);
  free(f->branch);
}
