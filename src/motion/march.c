/* Strips of t_b marched through phase H until every t_c lies behind them.

   Looked for are the orbits, the common zeros of p = z_1' - V and of the return's equation (cell.c).  A strip advances
   cell by cell.  A cell is passed once it is proved to hold no zero, or one; else the step is halved, or the strip is.
   The part of a strip on which p is proved positive has met its first root, since p starts below zero, and is cut off:
   this is what bounds t_c.  A strip that no time brings to a zero (strip_never, strip_turns, strip_misses) is done with
   as well, and where the frequencies of phase H are in a simple ratio also one that has been followed through a period:
   what p does later it has done before. */
#include "march.h"
#include "num/pi.h"
#include "strip.h"
#include "turns.h"

#include <stdlib.h>

#include "base/work.h"

/* Of work: a cell; those that are looked at before any is counted, more than usual parameters ask for. */
enum { UNITS_OF_CELL = 3, FREE_CELLS = 1 << 17 };

enum {
  STRIPS = 32,   /* at the start */
  FINEST = 26,   /* halvings of a step or of a strip, after which a cell is stuck */
  CROSSING = 18, /* halvings of a strip whose middle has crossed */
  FOLDS = 6,     /* ... from which on an open cell is held against two known zeros */
};

/* What changes from strip to strip. */
struct front {
  struct clock now;
  int level;
  double check; /* the time of the next look at free phases */
  double dir;
};

/* Whether om_1 : om_0 = p : q: of om^2 the sum is 1 + chi eta and the product chi eta (1 - chi), so that
   p^2 q^2 (1 + chi eta)^2 = (p^2 + q^2)^2 chi eta (1 - chi). */
static bool is_ratio(const fmpq *params, slong p, slong q) {
  NUMBERS(fmpq, sum, product, gap);
  fmpq_mul(product, params + P_CHI, params + P_ETA);
  fmpq_add_si(sum, product, 1);
  fmpq_mul(sum, sum, sum);
  fmpq_mul_si(sum, sum, p * p * q * q);
  fmpq_sub_si(gap, params + P_CHI, 1);
  fmpq_neg(gap, gap);
  fmpq_mul(product, product, gap);
  fmpq_mul_si(product, product, (p * p + q * q) * (p * p + q * q));
  return fmpq_equal(sum, product);
}

static double period_of(const struct disk_params *g, const fmpq *params) {
  enum { MOST = 16 };
  double ratio = g->om[1].mid / g->om[0].mid;
  for (slong q = 1; q <= MOST && ratio < MOST; q++) {
    double p = nearbyint(ratio * (double)q);
    if (fabs(ratio * (double)q - p) < 1e-9 * p && is_ratio(params, (slong)p, q))
      return 2 * PI * (double)q / disk_low(g->om[0]) * (1 + 0x1p-40);
  }
  return INFINITY;
}

static void advance(struct march *s, double low, double high, struct front m);

static void halve(struct march *s, const struct strip *p, const struct front *m) {
  advance(s, p->angle - p->half, p->angle, *m);
  advance(s, p->angle, p->angle + p->half, *m);
}

static void note_stuck(struct march *s, const struct strip *p, const struct common *open, double t, double dir) {
  if (dir < 0) s->crest = true;
  if (s->stuck) return;
  s->stuck = true;
  s->where[0] = p->angle + 2 * PI * fmax(open->k, 0);
  s->where[1] = t;
}

/* Two known zeros with the k that is open, and a proof that there are no more around them and the cell. */
static bool folded(struct march *s, const struct cell *c, const struct clock *t, double k) {
  const struct strip *p = c->strip;
  for (size_t j = 1; j < s->n_known; j++)
    for (size_t i = 0; i < j; i++) {
      struct known *two[2] = {&s->known[i], &s->known[j]};
      const double middle[2] = {p->angle, t->t}, size[2] = {p->half, c->early};
      double half[2];
      bool apart = false;
      for (int l = 0; l < 2; l++) {
        half[l] = size[l];
        for (int z = 0; z < 2; z++) half[l] = fmax(half[l], fabs(two[z]->at[l].mid - middle[l]) + two[z]->at[l].rad);
        half[l] *= 1 + 0x1p-20;
        const struct disk a = two[0]->at[l], b = two[1]->at[l];
        apart = apart || fabs(a.mid - b.mid) > (a.rad + b.rad) * (1 + 0x1p-20);
      }
      if (two[0]->k != k || two[1]->k != k || !apart || half[0] > ldexp(s->params.fall.mid, -FOLDS)) continue;
      /* the taller, the easier for the curve to stay inside */
      half[1] = fmax(half[1], 4 * half[0] * fabs(c->pf.mid / c->w.mid));
      if (!cell_folds_once(c, t, k, half)) continue;
      two[0]->met = two[1]->met = true;
      return true;
    }
  return false;
}

/* The cell around middle, known zeros and their folds taken in; what was proved or is stuck is noted.  LOOK_OPEN: to be
   divided. */
static enum look examine(struct march *s, struct cell *c, const struct strip *p, const struct turns *k,
                         const struct front *m, const struct clock *middle) {
  const struct disk_params *g = &s->params;
  struct common zero;
  cell_at(c, p, middle);
  c->early = s->step[m->level - 1].t;
  c->first = m->now.t == 0;
  enum look seen = cell_look(&zero, c, k, m->dir);
  if (seen == LOOK_OPEN && m->dir > 0 && zero.k >= 0 && p->half < ldexp(g->fall.mid, -FOLDS) &&
      folded(s, c, middle, zero.k))
    return LOOK_CLEAR;
  bool finest = p->half <= ldexp(g->fall.mid, -FINEST) && m->level <= s->level - FINEST;
  if (seen == LOOK_OPEN && !finest) return LOOK_OPEN;
  if (seen == LOOK_ZERO && m->dir > 0)
    commons_add(&s->zeros, zero, p, middle->t);
  else if (seen != LOOK_CLEAR)
    note_stuck(s, p, &zero, middle->t, m->dir);
  return LOOK_CLEAR;
}

/* One strip from the time m.now on. */
static void advance(struct march *s, double low, double high, struct front m) {
  const struct disk_params *g = &s->params;
  double finest = ldexp(g->fall.mid, -FINEST), unhurried = ldexp(g->fall.mid, -CROSSING), from, to;
  struct clock middle;
  struct strip p;
  struct cell c;
  strip_make(&p, g, low, high, high - low);
  struct turns k = strip_turns(&p, false);
  while (turns_count(&k) != 0 && (m.dir < 0 || !strip_never(&p))) { /* else no zero on the strip at any time */
    if (s->cells++ >= s->budget) {
      s->spent = true;
      return;
    }
    if (s->cells % FREE_CELLS == 0) work_add((unsigned long long)FREE_CELLS * UNITS_OF_CELL);
    const struct clock *half = &s->step[m.level - 1];
    clock_turn(&middle, &m.now, half);
    bool part = false; /* the strip into halves */
    if (examine(s, &c, &p, &k, &m, &middle) == LOOK_OPEN) {
      part = p.half > finest && (m.level <= s->level - FINEST || cell_wide_in_angle(&c));
      if (!part) {
        m.level--;
        continue;
      }
    } else {
      if (!cell_waiting(&from, &to, &c, m.dir)) return;
      bool less = to - from < 1.5 * p.half;
      part = !less && m.dir * c.p.mid > c.p.rad && p.half > unhurried;
      if (less) {
        strip_make(&p, g, p.angle + from, p.angle + to, to - from);
        k = strip_turns(&p, false);
      }
    }
    if (!part) {
      clock_turn(&m.now, &middle, half);
      if (m.now.sine[0].rad + m.now.sine[1].rad > 1e-13) clock_set(&m.now, g, m.now.t);
      if (m.now.t > s->period) return;
      if (m.level < s->level && fmod(m.now.t, 2 * s->step[m.level].t) == 0) m.level++;
      if (m.now.t <= m.check) continue;
      if (strip_misses(&p, &k)) return;
      m.check *= 2;
      part = p.half > unhurried;
    }
    if (part) {
      halve(s, &p, &m);
      return;
    }
  }
}

bool march_run(struct march *s, const fmpq *params, struct known *known, size_t n_known, long budget) {
  *s = (struct march){.budget = budget, .known = known, .n_known = n_known};
  int power;
  if (!disk_params_init(&s->params, params)) return false;
  s->period = period_of(&s->params, params);
  frexp(s->params.om[1].mid, &power);
  s->level = MARCH_LOWEST - power - 1;
  if (s->level + 1 >= MARCH_LEVELS || s->level <= FINEST + 1) return false;
  for (int i = 0; i <= s->level; i++) clock_set(&s->step[i], &s->params, ldexp(1, i - MARCH_LOWEST));
  struct front m = {.level = s->level, .check = 12 / s->params.om[0].mid, .dir = 1};
  clock_set(&m.now, &s->params, 0);
  double fall = disk_high(s->params.fall);
  for (int i = 0; i < STRIPS; i++) advance(s, fall * i / STRIPS, i + 1 < STRIPS ? fall * (i + 1) / STRIPS : fall, m);
  /* at the crest itself p starts at zero, with p' = e1 > 0: its first root is where it falls through zero */
  m.dir = -1;
  advance(s, disk_low(s->params.fall), fall, m);
  return true;
}

void march_clear(struct march *s) {
  disk_params_clear(&s->params);
  free(s->zeros.at);
}
