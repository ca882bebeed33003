/* The search: every form of the periodicity conditions, every choice of equations that hold, every choice of inputs
   that leaves as many unknowns as equations, and ways to carry numbers from one formula into the next.

   Double precision only narrows the list down, with a margin of a hundredth of the last printed digit; what is said of
   a reading is proved in balls afterwards. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "readings_impl.h"
#include "value/point.h"

/* --- Equations in an order in which they can be solved --- */

/* The quantities that equations contain. */
static unsigned contents(unsigned eqs) {
  unsigned of = 0;
  for (int i = 0; i < N_EQ; i++)
    if (eqs >> i & 1) of |= equations[i].of;
  return of;
}

/* The smallest set of equations with as many unknowns; 0 when there is none, or when some set has fewer. */
static unsigned smallest_block(unsigned eqs, unsigned unknown) {
  unsigned best = 0;
  for (unsigned m = eqs; m; m = (m - 1) & eqs) {
    int spare = bits_count(contents(m) & unknown) - bits_count(m);
    if (spare < 0) return 0;
    if (spare == 0 &&
        (best == 0 || bits_count(m) < bits_count(best) || (bits_count(m) == bits_count(best) && m < best)))
      best = m;
  }
  return best;
}

/* false when the equations cannot determine the unknowns, whatever their coefficients. */
static bool order_blocks(struct candidate *c) {
  unsigned eqs = c->eqs, unknown = c->unknown;
  for (c->n_blocks = 0; eqs; c->n_blocks++) {
    unsigned m = smallest_block(eqs, unknown);
    if (!m) return false;
    struct block b = {m, contents(m) & unknown};
    c->block[c->n_blocks] = b;
    eqs &= ~m;
    unknown &= ~b.unknown;
  }
  return unknown == 0;
}

/* --- Solved blocks, remembered --- */

struct memo_entry {
  unsigned long key; /* 0: free */
  bool solved;
  double x[N_X];
  arb_ptr enclosed; /* N_X; or NULL, in double precision */
};

void memo_clear(struct memo *m) {
  for (size_t i = 0; i < m->cap; i++)
    if (m->entry[i].enclosed) _arb_vec_clear(m->entry[i].enclosed, N_X);
  free(m->entry);
}

static struct memo_entry *memo_find(struct memo *m, unsigned long key) {
  if (2 * (m->n + 1) > m->cap) {
    struct memo old = *m;
    m->cap = old.cap ? 2 * old.cap : 1024;
    m->n = 0;
    m->entry = ss_malloc(m->cap * sizeof *m->entry);
    memset(m->entry, 0, m->cap * sizeof *m->entry);
    for (size_t i = 0; i < old.cap; i++)
      if (old.entry[i].key) *memo_find(m, old.entry[i].key) = old.entry[i];
    free(old.entry);
  }
  size_t at = key * 2654435761UL % m->cap;
  while (m->entry[at].key && m->entry[at].key != key) at = (at + 1) % m->cap;
  m->n += m->entry[at].key == 0;
  return &m->entry[at];
}

/* That of a block with everything else as printed, but for what is taken from the blocks before it.  Added where it is
   new: its key is still 0. */
static struct memo_entry *remembered(unsigned long *key, struct system *s, const struct block *b, enum carry carry,
                                     unsigned before) {
  enum { CARRY_BITS = 2 };
  unsigned taken = contents(b->eqs) & before;
  *key = carry > CARRY_PRINTED ? taken : 0;
  *key = *key << CARRY_BITS | (unsigned long)(taken ? carry : CARRY_PRINTED);
  *key = *key << N_X | b->unknown;
  *key = *key << N_EQ | b->eqs;
  return memo_find(&s->memo, *key);
}

/* Solves it, from x. */
static bool solve_block(double x[N_X], struct system *s, const struct block *b, enum carry carry, unsigned before) {
  unsigned long key;
  struct memo_entry *e = remembered(&key, s, b, carry, before);
  if (e->key == 0) {
    e->key = key;
    memcpy(e->x, x, sizeof e->x);
    e->solved = readings_newton(e->x, s, b->eqs, b->unknown);
  }
  for (int i = 0; e->solved && i < N_X; i++)
    if (b->unknown >> i & 1) x[i] = e->x[i];
  return e->solved;
}

/* Encloses its solution, near x. */
static bool enclose_block(arb_ptr x, struct system *s, const struct block *b, enum carry carry, unsigned before) {
  unsigned long key;
  struct memo_entry *e = remembered(&key, s, b, carry, before);
  if (e->key == 0) {
    e->key = key;
    e->enclosed = _arb_vec_init(N_X);
    _arb_vec_set(e->enclosed, x, N_X);
    e->solved = readings_enclose(e->enclosed, s, b->eqs, b->unknown);
  }
  for (int i = 0; e->solved && i < N_X; i++)
    if (b->unknown >> i & 1) arb_set(x + i, e->enclosed + i);
  return e->solved;
}

/* --- What a solution gives of the printed numbers --- */

struct conventions {
  int not_rounded, not_truncated; /* numbers that fit in one way only */
};

/* Does x print as p in some way? */
static bool gives(struct conventions *v, double x, const struct printed_number *p, double unit) {
  double off = (x - fmpq_get_d(&p->value)) / unit, slack = 0.01;
  if (p->decimal[0] == '-') off = -off;
  bool rounded = fabs(off) <= 0.5 + slack, truncated = off >= -slack && off <= 1 + slack;
  v->not_rounded += truncated && !rounded;
  v->not_truncated += rounded && !truncated;
  return rounded || truncated;
}

/* Does it give everything that is not an input: the solution itself, and what is fed into the bounds? */
static bool gives_all(struct candidate *c, const struct example *e) {
  enum { PREC = FIRST_PREC };
  struct conventions v = {0, 0};
  for (int i = 0; i < N_X; i++)
    if (c->unknown >> i & 1 && !gives(&v, c->x[i], e->printed[i], e->unit[i])) return false;
  ARB_VECTOR(x, N_X + N_BOUNDS);
  for (int i = 0; i < N_X; i++) {
    if (c->carry == CARRY_EXACT)
      arb_set_d(x + i, c->x[i]);
    else
      arb_set_fmpq(x + i, &e->fed[c->unknown >> i & 1 ? c->carry : CARRY_PRINTED][i], PREC);
  }
  readings_bounds(x + N_X, x, e->scene);
  for (int i = N_X; i < N_PRINTED; i++)
    if (e->printed[i] && !gives(&v, num_arb.get_d(x + i), e->printed[i], e->unit[i])) return false;
  c->assumed[ASSUME_MIXED] = v.not_rounded < v.not_truncated ? v.not_rounded : v.not_truncated;
  return true;
}

static void count_assumptions(struct candidate *c, const struct example *e) {
  unsigned all = (1U << N_X) - 1, inputs = all & ~c->unknown;
  c->assumed[ASSUME_INPUT] = bits_count(inputs & ~e->data);
  c->assumed[ASSUME_DATA] = bits_count(c->unknown & e->data);
  c->assumed[ASSUME_ZEROS] = c->digits = 0;
  for (int i = 0; i < N_X; i++) {
    if (!(c->unknown >> i & 1)) continue;
    c->assumed[ASSUME_ZEROS] += e->missing[i];
    c->digits += e->digits[i];
  }
  c->assumed[ASSUME_FORM] = c->form.basis == BASIS_FORCES;
  c->assumed[ASSUME_CARRY] = c->carry != CARRY_EXACT;
}

int candidate_compare(const void *a, const void *b) {
  const struct candidate *x = a, *y = b;
  int sx = 0, sy = 0;
  for (int i = 0; i < N_ASSUMPTIONS; i++) {
    sx += x->assumed[i];
    sy += y->assumed[i];
  }
  if (x->dropped != y->dropped) return x->dropped < y->dropped ? -1 : 1;
  if (sx != sy) return sx < sy ? -1 : 1;
  if (x->digits != y->digits) return x->digits > y->digits ? -1 : 1;
  if (x->layer != y->layer) return x->layer < y->layer ? -1 : 1;
  return x->serial < y->serial ? -1 : x->serial > y->serial;
}

/* --- The loops --- */

struct search {
  struct candidate *list;
  size_t n, cap;
  long tried, undetermined;
  struct system *s;
  const struct example *e;
};

/* Whether rounding in between changes anything that the coarser precision before it did not. */
static bool carry_matters(const struct candidate *c, const struct example *e) {
  unsigned earlier = 0;
  for (int b = 0; b < c->n_blocks; b++) {
    unsigned used = contents(c->block[b].eqs) & earlier;
    for (int i = 0; i < N_X; i++)
      if (used >> i & 1 && (c->carry == CARRY_PRINTED || !fmpq_equal(&e->fed[c->carry][i], &e->fed[c->carry - 1][i])))
        return true;
    earlier |= c->block[b].unknown;
  }
  return false;
}

static bool solve_candidate(struct candidate *c, struct search *q) {
  bool ok = true;
  if (c->carry == CARRY_EXACT) {
    memcpy(c->x, q->e->value, sizeof c->x);
    struct block whole = {c->eqs, c->unknown};
    return solve_block(c->x, q->s, &whole, CARRY_PRINTED, 0);
  }
  unsigned before = 0;
  memcpy(c->x, q->e->value, sizeof c->x);
  for (int b = 0; ok && b < c->n_blocks; b++) {
    double x[N_X];
    memcpy(x, q->e->value, sizeof x);
    for (int i = 0; i < N_X; i++)
      if (before >> i & 1) x[i] = fmpq_get_d(&q->e->fed[c->carry][i]);
    ok = solve_block(x, q->s, &c->block[b], c->carry, before);
    for (int i = 0; i < N_X; i++)
      if (c->block[b].unknown >> i & 1) c->x[i] = x[i];
    before |= c->block[b].unknown;
  }
  return ok;
}

static void try_carries(struct search *q, struct candidate *c) {
  for (int k = 0; k < N_CARRIES; k++) {
    c->carry = (enum carry)k;
    if (k != CARRY_EXACT && !carry_matters(c, q->e)) continue;
    c->serial = q->tried++;
    if (!solve_candidate(c, q) || !gives_all(c, q->e)) continue;
    count_assumptions(c, q->e);
    *SS_PUSH(q->list, q->n, q->cap) = *c;
  }
}

static void try_inputs(struct search *q, struct candidate *c) {
  for (unsigned unknown = 0; unknown < 1U << N_X; unknown++) {
    if (bits_count(unknown) != bits_count(c->eqs)) continue;
    c->unknown = unknown;
    if (order_blocks(c)) {
      try_carries(q, c);
    } else {
      q->tried++;
      q->undetermined++;
    }
  }
}

void readings_search(struct candidate **list, size_t *n, long *tried, long *undetermined, int dropped, struct system *s,
                     enum layer layer, const struct example *e) {
  struct search q = {.list = NULL, .s = s, .e = e};
  struct form forms[MAX_FORMS];
  int n_forms = forms_list(forms);
  for (unsigned switches = 0; switches < 4; switches++)
    for (int k = 0; k < n_forms; k++) {
      struct candidate c = {.layer = layer, .form = forms[k], .dropped = dropped};
      c.eqs = forms[k].held | (switches & 1) << EQ_12 | (switches >> 1) << EQ_14;
      if (6 - bits_count(c.eqs) == dropped) try_inputs(&q, &c);
    }
  *list = q.list;
  *n = q.n;
  *tried = q.tried;
  *undetermined = q.undetermined;
}

/* --- Proof --- */

bool candidate_enclose(arb_ptr x, const struct candidate *c, struct system *s, const struct example *e) {
  enum { PREC = FIRST_PREC };
  ARB_VECTOR(in, N_X);
  bool ok = true;
  struct block whole = {c->eqs, c->unknown};
  bool joint = c->carry == CARRY_EXACT;
  unsigned before = 0;
  for (int i = 0; i < N_X; i++) arb_set_fmpq(x + i, &e->printed[i]->value, PREC);
  for (int b = 0; ok && b < (joint ? 1 : c->n_blocks); b++) {
    const struct block *k = joint ? &whole : &c->block[b];
    for (int i = 0; i < N_X; i++) {
      if (k->unknown >> i & 1)
        arb_set_d(in + i, c->x[i]);
      else
        arb_set_fmpq(in + i, &e->fed[before >> i & 1 ? c->carry : CARRY_PRINTED][i], PREC);
    }
    ok = enclose_block(in, s, k, c->carry, before);
    for (int i = 0; i < N_X; i++)
      if (k->unknown >> i & 1) arb_set(x + i, in + i);
    before |= k->unknown;
  }
  for (int i = 0; i < N_X; i++) {
    arb_set(in + i, x + i);
    if (!joint && c->unknown >> i & 1) arb_set_fmpq(in + i, &e->fed[c->carry][i], PREC);
  }
  readings_bounds(x + N_X, in, e->scene);
  return ok;
}
