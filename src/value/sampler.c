/* Points drawn at random, always the same ones for the same id.  The parameters are small fractions, with e1 and e2 in
   units of V so that arcs and orbits are not rare; V = 1 is avoided, since many wrong formulas are right there. */
#include "point.h"

#include <string.h>

/* k/den with k uniform in [lo, hi]. */
static void draw(fmpq *q, uint64_t *state, slong lo, slong hi, ulong den) {
  slong k = lo + (slong)(random_next(state) % (uint64_t)(hi - lo + 1));
  fmpq_set_si(q, k, den);
}

/* Where drawn values never lie: all symbols 1, 0, -1, 1/2, great, small or at an end of their domains; then each at one
   of these.  false where that is none of its domain. */
static bool special_value(fmpq_t z, int k, const struct symbol *s) {
  static const slong values[][2] = {{1, 1}, {0, 1}, {-1, 1}, {1, 2}, {1L << 20, 1}, {1, 1L << 20}};
  enum { N_VALUES = sizeof values / sizeof *values, N_ALL = N_VALUES + 2 };
  uint64_t state = (uint64_t)k ^ random_seed(s->name), i = k < N_ALL ? (uint64_t)k : random_next(&state) % N_ALL;
  if (i < N_VALUES)
    fmpq_set_si(z, values[i][0], (ulong)values[i][1]);
  else
    fmpq_set(z, i == N_VALUES ? s->low.at : s->high.at);
  return symbol_takes(s, z);
}

/* Small fractions: of the way between two bounds, or the distance from one of them or, where there is none, from 0.
   A bound that belongs to the domain is drawn too. */
void point_own_value(fmpq_t z, const struct point *p, const struct symbol *s) {
  enum { PARTS = 64, UNIT = 16, MOST = 128 };
  if (point_told(z, p->at, s->name) || (p->special && special_value(z, p->special - 1, s))) return;
  uint64_t state = p->draw ^ random_seed(s->name);
  bool low = s->low.bounded, high = s->high.bounded;
  if (low && high) {
    NUMBERS(fmpq, span);
    fmpq_sub(span, s->high.at, s->low.at);
    draw(z, &state, !s->low.closed, PARTS - !s->high.closed, PARTS);
    fmpq_mul(z, z, span);
  } else if (low || high) {
    draw(z, &state, !(low ? s->low.closed : s->high.closed), MOST, UNIT);
    if (high) fmpq_neg(z, z);
  } else {
    draw(z, &state, -MOST, MOST, UNIT);
  }
  if (low || high) fmpq_add(z, z, low ? s->low.at : s->high.at);
}

void sampler_init(struct sampler *s, const char *id, const struct point_spec *spec) {
  *s = (struct sampler){random_seed(id), *spec};
}

/* The parameters, with e1 and e2 in units of V, so that orbits and arcs are not rare. */
static void draw_params(struct point *p, uint64_t *st, const struct restriction *restriction) {
  draw(&p->q[Q_CHI], st, 4, 60, 64);
  draw(&p->q[Q_ETA], st, 3, 64, 16);
  draw(&p->q[Q_V], st, 2, 24, 8);
  if (fmpq_is_one(&p->q[Q_V])) fmpq_set_si(&p->q[Q_V], 9, 8);
  if (restriction) {
    num_parse_decimal(&p->q[restriction->quantity], restriction->value, strlen(restriction->value));
  }
  draw(&p->q[Q_E1], st, 4, 40, 8);
  draw(&p->q[Q_E2], st, 2, 24, 16);
  fmpq_mul(&p->q[Q_E1], &p->q[Q_E1], &p->q[Q_V]);
  fmpq_mul(&p->q[Q_E2], &p->q[Q_E2], &p->q[Q_V]);
}

/* An arc starts in the stick phase: w below e1 by V (1 - chi) t_a, and r below e2/chi by a multiple of V. */
static void draw_arc(struct point *p, uint64_t *st) {
  NUMBERS(fmpq, one_chi, w, r, u);
  fmpq_one(one_chi);
  fmpq_sub(one_chi, one_chi, &p->q[Q_CHI]);
  draw(u, st, 1, 24, 8);
  fmpq_mul(u, u, &p->q[Q_V]);
  fmpq_mul(u, u, one_chi);
  fmpq_sub(w, &p->q[Q_E1], u);
  draw(u, st, 4, 40, 8);
  fmpq_mul(u, u, &p->q[Q_V]);
  fmpq_div(r, &p->q[Q_E2], &p->q[Q_CHI]);
  fmpq_sub(r, r, u);
  fmpq_add(&p->q[Q_Z2], w, r);
  fmpq_div(&p->q[Q_Z2], &p->q[Q_Z2], one_chi);
  fmpq_sub(&p->q[Q_Z1], &p->q[Q_Z2], r);
}

/* An inequality along a phase fails first beside an end: less than a quarter of the phase becomes a 1024th. */
static void move_outwards(fmpq_t fraction) {
  NUMBERS(fmpq, quarters);
  fmpq_mul_si(quarters, fraction, 4);
  if (fmpq_cmp_si(quarters, 1) < 0) fmpq_set_si(fraction, 1, 1024);
  if (fmpq_cmp_si(quarters, 3) > 0) fmpq_set_si(fraction, 1023, 1024);
}

/* Parameters at which drawn ones are not: chi = eta = 1/2 and e1 = V; chi eta = 1; e2 = V; e2 > e1; e1 = e2, where no
   admissible orbit is known; chi near 0 with large eta; chi near 1, twice with long t_a and t_c; small eta and large
   e1; large eta; eta = 1; a force on m_1 that begins below -2 e1. */
static const struct {
  slong chi[2], eta[2], e1[2], e2[2];
} special[] = {{{1, 2}, {1, 2}, {1, 1}, {1, 8}},
               {{1, 2}, {2, 1}, {2, 1}, {1, 2}},
               {{1, 2}, {1, 2}, {4, 1}, {1, 1}},
               {{87, 100}, {32, 100}, {121, 225}, {31, 50}},
               {{4, 5}, {1, 1}, {1, 1}, {1, 1}},
               {{1, 1000000}, {400000, 1}, {2, 1}, {1, 4000000}},
               {{999999, 1000000}, {1, 2}, {8, 1}, {1, 100}},
               {{9999, 10000}, {2, 1}, {8, 1}, {1, 100}},
               {{99, 100}, {1, 1}, {20, 1}, {1, 4}},
               {{9, 10}, {1, 1000000}, {1000000000, 1}, {1, 1000}},
               {{1, 2}, {100, 1}, {1, 2}, {1, 100}},
               {{4, 5}, {1, 1}, {14, 5}, {6, 7}},
               {{3, 64}, {55, 8}, {1, 6}, {4, 27}}};
enum { N_SPECIAL = sizeof special / sizeof *special, SIZE_BITS = 40 };

/* Each in three sizes, of which the second is 2^40 and the third 2^-40 times the first, and in the first size with as
   great and as little friction; where friction is neither, u_r1 = u_r2. */
static const struct {
  int lengths, friction;
} size[] = {{0, 0}, {0, SIZE_BITS}, {0, -SIZE_BITS}, {SIZE_BITS, SIZE_BITS}, {-SIZE_BITS, -SIZE_BITS}};
enum { N_SIZES = sizeof size / sizeof *size };

static void times_power_of_two(fmpq_t z, int bits) {
  if (bits < 0)
    fmpq_div_2exp(z, z, (flint_bitcnt_t)-bits);
  else
    fmpq_mul_2exp(z, z, (flint_bitcnt_t)bits);
}

static void take_special(struct point *p, int k) {
  int i = k / N_SIZES, lengths = size[k % N_SIZES].lengths, friction = size[k % N_SIZES].friction;
  fmpq_set_si(&p->q[Q_CHI], special[i].chi[0], (ulong)special[i].chi[1]);
  fmpq_set_si(&p->q[Q_ETA], special[i].eta[0], (ulong)special[i].eta[1]);
  fmpq_one(&p->q[Q_V]);
  fmpq_set_si(&p->q[Q_E1], special[i].e1[0], (ulong)special[i].e1[1]);
  fmpq_set_si(&p->q[Q_E2], special[i].e2[0], (ulong)special[i].e2[1]);
  for (int m = 0; m < 2; m++) {
    fmpq_one(&p->q[Q_US1 + m]);
    if (!friction) fmpq_add(&p->q[Q_US1 + m], &p->q[Q_US1 + m], &p->q[Q_E1 + 1 - m]);
    times_power_of_two(&p->q[Q_US1 + m], friction);
  }
  for (int q = Q_V; q <= Q_US2; q++) times_power_of_two(&p->q[q], lengths);
}

/* The next point; at the k-th special parameters unless k is negative. */
static void next_point(struct point *p, struct sampler *s, int k) {
  enum { POOL = 64 };
  enum point_kind kind = p->kind = s->spec.kind;
  p->phase = s->spec.phase;
  p->finite = s->spec.finite;
  p->admissible = s->spec.admissible;
  p->realistic = s->spec.realistic;
  p->scene = NULL;
  p->paper = s->spec.paper;
  p->special = k + 1;
  p->draw = s->state;
  uint64_t *st = &s->state;
  if (kind == POINT_ORBIT) {
    /* all claims draw their parameter sets from one pool, so that an orbit is searched once */
    uint64_t pool = random_seed("orbits") + random_next(st) % POOL;
    random_next(&pool);
    draw_params(p, &pool, s->spec.restriction);
  } else {
    draw_params(p, st, s->spec.restriction);
  }
  p->orbit = (slong)(random_next(st) % 1000);
  draw(&p->q[Q_US1], st, 1, 40, 8);
  draw(&p->q[Q_US2], st, 1, 40, 8);
  if (k >= 0) take_special(p, k);
  draw(&p->q[Q_X], st, -40, 40, 7);
  draw(&p->q[Q_Y], st, -40, 41, 11);
  draw(&p->q[Q_LAMBDA], st, -40, 40, 9);
  draw(&p->q[Q_T], st, 1, 128, 16);
  draw(&p->q[Q_S], st, 1, 15, 16);
  if (p->admissible) move_outwards(&p->q[Q_S]);
  for (int i = Q_Z1; i <= Q_DZ2; i++) draw(&p->q[i], st, -32, 32, 8);
  if (kind == POINT_ARC) draw_arc(p, st);
  for (int i = Q_TA; kind == POINT_PATCHED && i <= Q_TD; i++) draw(&p->q[i], st, 1, 48, 16);
}

void sampler_next(struct point *p, struct sampler *s) {
  next_point(p, s, -1);
}

bool sampler_special(struct point *p, bool *meant, struct sampler *s, int k) {
  if (k >= N_SPECIAL * N_SIZES) return false;
  const struct restriction *only = s->spec.restriction;
  next_point(p, s, k);
  p->orbit = k;
  *meant = !only || fmpq_is_one(&p->q[only->quantity]);
  return true;
}
