/* Lines in the space of parameters. */
#include "scene.h"

void scene_range_init(struct scene_range *r) {
  fmpq_init(r->from);
  fmpq_init(r->to);
}

void scene_range_clear(struct scene_range *r) {
  fmpq_clear(r->from);
  fmpq_clear(r->to);
}

static bool in_domain(const fmpq_t x, int vary) {
  return fmpq_sgn(x) > 0 && (vary != P_CHI || fmpq_cmp_si(x, 1) < 0);
}

bool scene_range_in_domain(const struct scene_range *r) {
  return in_domain(r->from, r->vary) && in_domain(r->to, r->vary);
}

bool scene_range_below_friction(const struct scene_range *r, const struct scene *s) {
  int key = r->vary == P_E1 ? KEY_U_R1 : r->vary == P_E2 ? KEY_U_R2 : -1;
  if (key < 0 || !s->given[key]) return true;
  return fmpq_cmp(r->from, &s->value[key]) < 0 && fmpq_cmp(r->to, &s->value[key]) < 0;
}
