/* Krawczyk's operator on the unknowns of a word: with a rounded inverse Y of the derivative at the midpoint m,
   m - Y F(m) + (I - Y F'(X))(X - m) inside X proves that the box X holds exactly one solution, and that it lies there. */
#include "words_impl.h"

enum { MOST_POLISH = 40, MOST_BOXES = 12 };

struct enclosure {
  struct calc c;
  struct word_law m;
  const struct phase_word *w;
  int size;
  struct num_vec y, step; /* the inverse at the midpoint, and the Newton step there */
};

static int derivative(val *f, val *j, struct enclosure *e, const struct num_vec *x) {
  val at[WORD_UNKNOWNS];
  flow_vals(at, x, 0, e->size);
  word_equations(f, j, NULL, &e->c, &e->m, e->w, at);
  return e->c.status;
}

/* y and step at the exact point x. */
static int precondition(struct enclosure *e, const struct num_vec *x) {
  val f[WORD_UNKNOWNS], j[WORD_UNKNOWNS * WORD_UNKNOWNS];
  slong mark = calc_mark(&e->c);
  struct num_vec a;
  int n = e->size, status = derivative(f, j, e, x);
  num_vec_init(&a, n * n, e->c.ctx);
  for (int i = 0; i < n * n; i++) {
    arb_get_mid_arb(num_vec_at(&a, i), j[i]);
    arb_set_si(num_vec_at(&e->y, i), i / n == i % n);
  }
  if (!status) status = num_mat_solve(&e->y, &a, &e->y, n, n);
  for (int i = 0; i < n * n; i++) arb_get_mid_arb(num_vec_at(&e->y, i), num_vec_at(&e->y, i));
  struct num_vec b = {a.ctx, n, a.data};
  for (int i = 0; i < n && !status; i++) arb_set(num_vec_at(&b, i), f[i]);
  if (!status) status = num_mat_mul(&e->step, &e->y, &b, n, n, 1);
  num_vec_clear(&a);
  calc_release(&e->c, mark);
  return status;
}

/* Newton's iteration on midpoints until the steps stop shrinking; then y and step are those at x.  SS_UNABLE when they have
   not stopped, as beside a double solution. */
static int polish(struct enclosure *e, struct num_vec *x) {
  int status = SS_OK;
  mag_t size, before;
  mag_init(size);
  mag_init(before);
  mag_inf(before);
  for (int i = 0; !status; i++) {
    status = i < MOST_POLISH ? precondition(e, x) : SS_UNABLE;
    mag_zero(size);
    for (int k = 0; k < e->size && !status; k++) {
      mag_t s;
      mag_init(s);
      arb_get_mag(s, num_vec_at(&e->step, k));
      mag_max(size, size, s);
      mag_clear(s);
    }
    if (status || mag_cmp(size, before) >= 0) break;
    mag_set(before, size);
    for (int k = 0; k < e->size; k++) {
      arb_ptr z = num_vec_at(x, k);
      arb_sub(z, z, num_vec_at(&e->step, k), e->c.ctx.prec);
      arb_get_mid_arb(z, z);
    }
  }
  mag_clear(size);
  mag_clear(before);
  return status;
}

/* The image of the box; whether it lies inside. */
static bool krawczyk(struct num_vec *image, struct enclosure *e, const struct num_vec *box, const struct num_vec *mid) {
  val f[WORD_UNKNOWNS], j[WORD_UNKNOWNS * WORD_UNKNOWNS];
  struct calc *c = &e->c;
  slong mark = calc_mark(c);
  int n = e->size;
  c->status = SS_OK;
  bool inside = derivative(f, j, e, box) == SS_OK;
  for (int i = 0; i < n && inside; i++) {
    val at = calc_sub(c, num_vec_at(mid, i), num_vec_at(&e->step, i));
    for (int l = 0; l < n; l++) {
      val rest = calc_d(c, i == l);
      for (int k = 0; k < n; k++) rest = calc_sub(c, rest, calc_mul(c, num_vec_at(&e->y, i * n + k), j[k * n + l]));
      at = calc_add(c, at, calc_mul(c, rest, calc_sub(c, num_vec_at(box, l), num_vec_at(mid, l))));
    }
    arb_set(num_vec_at(image, i), at);
    inside = arb_contains_interior(num_vec_at(box, i), at) && !c->status;
  }
  calc_release(c, mark);
  return inside;
}

static bool prove(struct num_vec *x, struct enclosure *e) {
  struct num_vec box, mid;
  bool proved = false;
  num_vec_init(&box, e->size, e->c.ctx);
  num_vec_init(&mid, e->size, e->c.ctx);
  num_vec_set(&mid, x);
  for (int i = 0; i < e->size; i++) {
    arb_ptr b = num_vec_at(&box, i);
    arb_set(b, num_vec_at(&mid, i));
    arb_get_mag(arb_radref(b), num_vec_at(&e->step, i));
    mag_mul_2exp_si(arb_radref(b), arb_radref(b), 2);
    mag_t least; /* a step can be exactly zero */
    mag_init(least);
    arb_get_mag(least, num_vec_at(&mid, i));
    mag_mul_2exp_si(least, least, 8 - e->c.ctx.prec);
    mag_add(arb_radref(b), arb_radref(b), least);
    mag_add_ui_2exp_si(arb_radref(b), arb_radref(b), 1, -4 * e->c.ctx.prec);
    mag_clear(least);
  }
  for (int i = 0; i < MOST_BOXES && !proved; i++) {
    proved = krawczyk(x, e, &box, &mid);
    for (int k = 0; k < e->size && !proved; k++) {
      arb_ptr b = num_vec_at(&box, k);
      mag_mul_2exp_si(arb_radref(b), arb_radref(b), 3);
    }
  }
  num_vec_clear(&box);
  num_vec_clear(&mid);
  return proved;
}

int word_unknowns_enclose(struct num_vec *x, const double *near, const struct phase_word *w, const fmpq *params,
                          const fmpq *const u_r[2]) {
  enum word_coordinate free[WORD_FREE_MOST];
  struct enclosure e = {.w = w, .size = w->n + word_free(free, w)};
  calc_init(&e.c, x->ctx);
  word_law_make(&e.m, &e.c, params, u_r);
  num_vec_init(&e.y, e.size * e.size, x->ctx);
  num_vec_init(&e.step, e.size, x->ctx);
  for (int i = 0; i < e.size; i++) arb_set_d(num_vec_at(x, i), near[i]);
  int status = polish(&e, x);
  if (!status && !prove(x, &e)) status = SS_UNABLE;
  num_vec_clear(&e.step);
  num_vec_clear(&e.y);
  calc_clear(&e.c);
  return status;
}
