/* The solution of a word's equations, refined and proved (num/solve.h). */
#include "num/solve.h"
#include "words_impl.h"

enum { MOST_POLISH = 40 };

struct enclosure {
  struct calc c;
  struct word_law m;
  const struct phase_word *w;
  slong mark; /* what lies above it in the calc belongs to one evaluation */
};

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct enclosure *e = self;
  val at[WORD_UNKNOWNS], unread[WORD_UNKNOWNS];
  calc_release(&e->c, e->mark);
  e->c.status = SS_OK;
  flow_vals(at, x, 0, x->len);
  word_equations(f ? f : unread, j, NULL, &e->c, &e->m, e->w, at);
  return e->c.status;
}

int word_unknowns_enclose(struct num_vec *x, const double *near, const struct phase_word *w, const fmpq *params,
                          const fmpq *const u_r[2]) {
  enum word_coordinate free[WORD_FREE_MOST];
  struct enclosure e = {.w = w};
  struct solve_system system = {w->n + word_free(free, w), values, &e};
  struct num_vec at = {x->ctx, system.n, x->data}; /* x may be longer */
  e.c = calc_begin(x->ctx);
  word_law_make(&e.m, &e.c, params, u_r);
  e.mark = calc_mark(&e.c);
  for (slong i = 0; i < system.n; i++) arb_set_d(num_vec_at(&at, i), near[i]);
  int status = newton_settle(&at, &system, MOST_POLISH);
  if (!status) status = krawczyk_enclose(&at, NULL, &system);
  calc_clear(&e.c);
  return status;
}
