/* Orbits over a box of parameters, by pieces: those that are not cut cover it. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "orbit.h"

/* The first halvings are made in any case: they make the enclosures narrow.  Where a piece around the middle, as narrow
   as so many halvings of the box make it, is not proved, no others are tried. */
enum { HALVINGS = 4, MOST_DEPTH = 16, TRIED = 7 };
/* Those that are kept, those that were cut for them, and the one around the middle. */
enum { MOST_EXAMINED = 2 * MECH_PIECES };

struct piece {
  fmpq *low, *high; /* of each interval */
  int depth;
  size_t parent; /* the piece that was cut for it */
  bool cut, has_middle, proved;
  struct mech_orbit middle; /* the orbit there, if it has one */
  struct mech_orbit over;   /* that of all its points, judged, if proved */
};
struct cover {
  const struct mech_box *box;
  int n; /* intervals */
  struct piece *piece;
  size_t n_pieces, cap;
};

static struct piece *add_piece(struct cover *c, size_t parent, int depth) {
  struct piece *p = SS_PUSH(c->piece, c->n_pieces, c->cap);
  *p = (struct piece){.low = _fmpq_vec_init(c->n), .high = _fmpq_vec_init(c->n), .depth = depth, .parent = parent};
  return p;
}

static void cover_clear(struct cover *c) {
  for (size_t i = 0; i < c->n_pieces; i++) {
    struct piece *p = &c->piece[i];
    _fmpq_vec_clear(p->low, c->n);
    _fmpq_vec_clear(p->high, c->n);
    if (p->has_middle) mech_orbit_clear(&p->middle);
    if (p->proved) mech_orbit_clear(&p->over);
  }
  free(c->piece);
}

/* The orbits at the middle of a piece and over it, from that at its parent's middle. */
static void examine(struct cover *c, size_t i, const struct mech_orbit *start) {
  struct piece *p = &c->piece[i];
  FREED struct mech_given *given = ss_malloc((size_t)c->n * sizeof *given);
  struct diag d = {.set = false};
  OWNED(mech) m;
  const struct mech_given *interval = c->box->m->interval;
  for (int k = 0; k < c->n; k++, interval = interval->next)
    given[k] = (struct mech_given){k + 1 < c->n ? &given[k + 1] : (struct mech_given *)c->box->given,
                                   interval->name,
                                   {p->low[k]},
                                   {p->high[k]},
                                   NULL,
                                   0};
  if (!mech_load_with(&m, c->box->path, given, true, &d)) return;
  struct mech middle = m; /* borrowed */
  middle.n_intervals = 0;
  const struct piece *parent = &c->piece[p->parent];
  const struct mech_orbit *near = parent->has_middle && parent != p ? &parent->middle : start;
  p->has_middle = mech_orbit_beside(&p->middle, &middle, near, c->box->prec) == SS_OK;
  p->proved = p->has_middle && mech_orbit_beside(&p->over, &m, &p->middle, c->box->prec) == SS_OK;
  if (p->proved) mech_orbit_judge(&p->over, &m, c->box->prec);
}

/* --- What holds over the box: the stability, and each fact --- */

static truth truth_of(const struct mech_orbit *o, int i) {
  return i == 0 ? o->stable : o->fact[i - 1].holds;
}

/* Is it proved true on a piece, or false? */
static bool is_somewhere(const struct cover *c, int i, truth t) {
  for (size_t k = 0; k < c->n_pieces; k++)
    if (c->piece[k].proved && truth_of(&c->piece[k].over, i) == t) return true;
  return false;
}

static bool changes(const struct cover *c, int i) {
  return is_somewhere(c, i, TRUTH_TRUE) && is_somewhere(c, i, TRUTH_FALSE);
}

static bool finished(const struct cover *c, const struct piece *p) {
  if (!p->proved || p->depth < HALVINGS) return false;
  for (int i = 0; i <= p->over.n_facts; i++)
    if (truth_of(&p->over, i) == TRUTH_UNKNOWN && !changes(c, i)) return false;
  return true;
}

static void unite(arb_ptr all, arb_srcptr x, slong n, slong prec) {
  for (slong i = 0; i < n; i++) arb_union(all + i, all + i, x + i, prec);
}

static void add_numbers(struct mech_orbit *all, const struct mech_orbit *o, slong prec) {
  unite(all->t, o->t, o->word.n, prec);
  unite(all->state, o->state, (slong)o->word.n * o->states, prec);
  unite(all->period, o->period, 1, prec);
  unite(all->angle, o->angle, 1, prec);
  unite(all->jacobian->entries, o->jacobian->entries, (slong)o->n_free * o->n_free, prec);
  unite(all->box, o->box, o->word.n + o->n_free, prec);
  all->multipliers = all->multipliers && o->multipliers;
  for (int i = 0; i < o->n_free; i++) acb_union(all->multiplier + i, all->multiplier + i, o->multiplier + i, prec);
}

static truth same(truth a, truth b) {
  return a == b ? a : TRUTH_UNKNOWN;
}

/* The union of the pieces that are not cut, all of which are proved. */
static void conclude(struct mech_orbit *o, const struct cover *c) {
  struct mech_orbit *all = ss_malloc(sizeof *all);
  for (size_t k = 0; k < c->n_pieces; k++) {
    struct piece *p = &c->piece[k];
    if (p->cut) continue;
    if (o->pieces++ == 0) {
      *all = p->over; /* taken over */
      all->changes = changes(c, 0);
      for (int i = 0; i < all->n_facts; i++) all->fact[i].changes = changes(c, i + 1);
      p->proved = false;
      continue;
    }
    add_numbers(all, &p->over, c->box->prec);
    all->stable = same(all->stable, p->over.stable);
    for (int i = 0; i < all->n_facts; i++) all->fact[i].holds = same(all->fact[i].holds, p->over.fact[i].holds);
  }
  o->over = all;
}

/* What is known of the orbit at the middle gives way to what holds over the box. */
static void take_truths(struct mech_orbit *o) {
  free(o->fact);
  o->fact = NULL;
  o->n_facts = 0;
  o->own = o->admissible = o->stable = TRUTH_UNKNOWN;
  if (o->over) {
    o->fact = o->over->fact;
    o->n_facts = o->over->n_facts;
    o->over->fact = NULL;
    o->stable = o->over->stable;
    o->changes = o->over->changes;
    mech_orbit_conclude(o);
  }
  o->certified = false;
}

/* --- Pieces --- */

/* The interval that is widest, as a part of its own over the whole box. */
static int widest(const struct cover *c, const struct piece *p) {
  const struct piece *whole = &c->piece[0];
  int best = 0;
  double most = 0;
  for (int k = 0; k < c->n; k++) {
    double part =
        (fmpq_get_d(p->high + k) - fmpq_get_d(p->low + k)) / (fmpq_get_d(whole->high + k) - fmpq_get_d(whole->low + k));
    if (part <= most) continue;
    most = part;
    best = k;
  }
  return best;
}

static void cut(struct cover *c, size_t i) {
  int along = widest(c, &c->piece[i]);
  for (int upper = 0; upper < 2; upper++) {
    struct piece *half = add_piece(c, i, c->piece[i].depth + 1);
    const struct piece *whole = &c->piece[i];
    for (int k = 0; k < c->n; k++) {
      fmpq_set(half->low + k, whole->low + k);
      fmpq_set(half->high + k, whole->high + k);
    }
    fmpq *end = upper ? half->low + along : half->high + along;
    fmpq_add(end, whole->low + along, whole->high + along);
    fmpq_div_2exp(end, end, 1);
  }
  c->piece[i].cut = true;
}

static void add_whole(struct cover *c) {
  struct piece *whole = add_piece(c, 0, 0);
  const struct mech_given *interval = c->box->m->interval;
  for (int k = 0; k < c->n; k++, interval = interval->next) {
    fmpq_set(whole->low + k, interval->low);
    fmpq_set(whole->high + k, interval->high);
  }
}

/* Is a narrow piece around the middle proved? */
static bool proved_at_middle(struct cover *c, const struct mech_orbit *start) {
  struct piece *narrow = add_piece(c, 0, MOST_DEPTH);
  const struct piece *whole = &c->piece[0];
  NUMBERS(fmpq, middle, reach);
  narrow->cut = true; /* others cover it */
  for (int k = 0; k < c->n; k++) {
    fmpq_add(middle, whole->low + k, whole->high + k);
    fmpq_div_2exp(middle, middle, 1);
    fmpq_sub(reach, middle, whole->low + k);
    fmpq_div_2exp(reach, reach, (ulong)(TRIED / c->n));
    fmpq_sub(narrow->low + k, middle, reach);
    fmpq_add(narrow->high + k, middle, reach);
  }
  examine(c, 1, start);
  return c->piece[1].proved;
}

/* false: a piece stays without proof. */
static bool cover(struct cover *c, const struct mech_orbit *start, const struct mech_tell *tell) {
  size_t kept = 0;
  add_whole(c);
  if (!proved_at_middle(c, start)) return false;
  for (size_t i = 0; i < c->n_pieces; i++) { /* the list grows */
    if (c->piece[i].cut) continue;
    examine(c, i, start);
    if (tell->to) tell->to(tell->before + i + 1, tell->of);
    const struct piece *p = &c->piece[i];
    if (!p->has_middle) return false;
    if (!finished(c, p) && p->depth < MOST_DEPTH && kept + (c->n_pieces - i) < MECH_PIECES)
      cut(c, i);
    else if (!p->proved)
      return false;
    else
      kept++;
  }
  return true;
}

void mech_orbits_over(struct mech_orbits *list, const struct mech_box *b) {
  for (int k = 0; k < list->n; k++) {
    struct mech_orbit *o = &list->orbit[k];
    OWNED(cover) c = {.box = b, .n = b->m->n_intervals};
    const struct mech_tell tell = {b->progress, (size_t)k * MOST_EXAMINED, (size_t)list->n * MOST_EXAMINED};
    if (cover(&c, o, &tell))
      conclude(o, &c);
    else
      o->pieces = MECH_UNPROVED;
    take_truths(o);
  }
}
