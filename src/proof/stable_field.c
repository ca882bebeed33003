/* The field in which two forms of one quantity are compared.  It knows the frequencies of phase H and makes chi and eta
   of them, so that their square roots need no generators; and it knows the half angles over each time, of which the
   stable forms are made where the corrected ones have whole angles.  What is to be shown is then that differences of
   rational functions are zero. */
#include <string.h>

#include "stable_impl.h"

/* omega is the root of omega_1^2 + omega_2^2 - 1, and its product with sqrt(chi) that of (1 - omega_1^2)(omega_2^2 -
   1). */
static void make_parameters(struct stable_field *s) {
  OWNED(calc) c = exact_calc(s->field);
  element *omega = &s->positive[0], *root_chi = &s->positive[1];
  val first = &s->frequency[0], second = &s->frequency[1], one = calc_d(&c, 1), square = calc_mul(&c, first, first);
  val above = calc_sub(&c, calc_mul(&c, second, second), one);
  calc_store(&c, omega, calc_add(&c, square, above));
  c.status |= exact_sqrt(omega, s->field, omega);
  s->g_1 = calc_neg(&s->c, calc_sub(&c, square, one));
  calc_store(&c, root_chi, calc_mul(&c, s->g_1, above));
  c.status |= exact_sqrt(root_chi, s->field, root_chi);
  calc_store(&c, root_chi, calc_div(&c, root_chi, omega));
  calc_store(&c, &s->positive[2], calc_div(&c, omega, root_chi));
  calc_store(&c, &s->positive[3], calc_div(&c, calc_mul(&c, first, second), omega));
  calc_store(&c, &s->positive[4], calc_add(&c, second, first));
  calc_store(&c, &s->positive[5], calc_sub(&c, second, first));
  s->chi = calc_mul(&s->c, root_chi, root_chi);
  s->eta = calc_mul(&s->c, &s->positive[2], &s->positive[2]);
  s->status |= c.status | s->c.status;
}

/* An entry of a part, "rest_2[1,2]", by what it equals in the corrected layer; NULL when it is none. */
static const element *part_entry(const struct stable_field *s, const char *name) {
  for (int i = 0; i < s->n_parts; i++) {
    const struct part_value *p = &s->part[i];
    size_t len = strlen(p->part->name);
    if (strncmp(name, p->part->name, len) != 0 || name[len] != '[') continue;
    int row = name[len + 1] - '1', col = name[len + 3] - '1';
    return num_vec_at(&p->value, row * p->part->cols + col);
  }
  return NULL;
}

static int bind(element *z, struct exact_field *f, const char *name, void *stable) {
  const struct stable_field *s = stable;
  const element *known = strcmp(name, "chi") == 0        ? s->chi
                         : strcmp(name, "eta") == 0      ? s->eta
                         : strcmp(name, "g_1[1,1]") == 0 ? s->g_1
                                                         : part_entry(s, name);
  if (!known) return exact_symbol(z, f, name);
  num_exact.set(z, known);
  return SS_OK;
}

static element *new_elements(struct calc *c, slong n) {
  const struct num_vec v = calc_vec(c, n);
  return num_vec_at(&v, 0);
}

void stable_field_make(struct stable_field *s, slong parts) {
  *s = (struct stable_field){.field = exact_field_new(NULL, 0)};
  exact_field_limit(s->field, STABLE_TERMS);
  s->c = exact_calc(s->field);
  s->frequency = new_elements(&s->c, 2);
  s->positive = new_elements(&s->c, N_POSITIVE);
  s->status = exact_symbol(&s->frequency[0], s->field, "omega_1") | exact_symbol(&s->frequency[1], s->field, "omega_2");
  make_parameters(s);
  exact_field_bind(s->field, bind, s);
  exact_field_roots(s->field, s->frequency, 2);
  exact_field_positive(s->field, s->positive, N_POSITIVE, N_POSITIVE);
  exact_field_angles(s->field, parts);
}

void stable_field_clear(struct stable_field *s) {
  calc_clear(&s->c);
  exact_field_free(s->field);
}
