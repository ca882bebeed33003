/* The Jacobian of one period by the routes that the audit has, to the digits that are asked for. */
#include <string.h>

#include "audit_impl.h"

const char *const method_name[N_METHODS] = {"analytic", "implicit", "saltation", "fd", "ode"};

enum { ATTEMPTS = 4, GUARD_BITS = 64 };

/* The point that is asked for; false with d set when the scene does not have it. */
static bool find_point(struct point *p, const struct scene *s, const struct jacobian_request *q,
                       struct orbit_cache *cache, struct diag *d) {
  if (!scene_has_forces(s)) {
    diag_set(d, "%s: error: the Jacobian needs a scene that gives e1 and e2", s->path);
    return false;
  }
  if (q->at_printed) {
    if (printed_point(p, s)) {
      if (q->method != METHOD_ANALYTIC) p->kind = POINT_ARC;
      return true;
    }
    diag_set(d, "%s: error: --at printed needs printed z10, z20, t_a, t_b, t_c and t_d", s->path);
    return false;
  }
  slong n = scene_orbits(s, cache)->n;
  p->kind = POINT_ORBIT;
  p->orbit = q->orbit;
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_set(&p->q[Q_CHI + k], &s->value[k]);
  if (q->orbit < n) return true;
  if (n == 0)
    diag_set(d, "%s: error: the scene has no orbit", s->path);
  else
    diag_set(d, "%s: error: there is no orbit %ld; the scene has %ld", s->path, (long)q->orbit + 1, (long)n);
  return false;
}

static int analytic(arb_ptr j, const struct model *m, const struct jacobian_request *q, const struct point *p,
                    slong prec, struct orbit_cache *cache, struct diag *d) {
  arb_ptr v = _arb_vec_init(16);
  int n;
  struct view view = {m, q->layer, NULL, NULL};
  int s = expression_at(v, &n, view, "J", "stability", p, prec, cache, d);
  if (n != 4) s |= SS_UNABLE;
  for (int i = 0; i < 4; i++) arb_set(j + i, v + i);
  _arb_vec_clear(v, 16);
  return s;
}

int jacobian_by_model(arb_ptr j, enum jacobian_method method, const struct point *p, slong prec,
                      struct orbit_cache *cache) {
  struct num_ctx ctx = method == METHOD_FD ? num_ctx_mpfr(prec) : num_ctx_arb(prec);
  struct values v;
  struct num_vec out, err;
  int s = values_init(&v, p, VARIANT_CLOSED, ctx, cache);
  num_vec_init(&out, 4, ctx);
  num_vec_init(&err, 1, ctx);
  if (s == SS_OK && method == METHOD_IMPLICIT) s |= dyn_return_jacobian(&out, &v.params, &v.arc);
  if (s == SS_OK && method == METHOD_SALTATION) s |= dyn_return_jacobian_saltation(&out, &v.params, &v.arc);
  if (s == SS_OK && method == METHOD_FD) {
    double guess[4];
    for (int i = 0; i < 4; i++) guess[i] = ctx.type->get_d(num_vec_at(&v.arc.t, i));
    s |= dyn_return_jacobian_fd(&out, num_vec_at(&err, 0), &v.params, num_vec_at(&v.arc.z, 0), num_vec_at(&v.arc.z, 1),
                                guess);
  }
  for (int i = 0; i < 4; i++) ctx.type->get_arb(j + i, num_vec_at(&out, i));
  if (method == METHOD_FD) {
    arb_t e;
    arb_init(e);
    ctx.type->get_arb(e, num_vec_at(&err, 0));
    for (int i = 0; i < 4; i++) arb_add_error(j + i, e);
    arb_clear(e);
  }
  num_vec_clear(&err);
  num_vec_clear(&out);
  values_clear(&v);
  return s;
}

static bool by_integration(arb_ptr j, const struct scene *s, const struct jacobian_request *q, struct diag *d) {
  struct coulomb_setup setup;
  double value[4], err;
  arb_t e;
  if (!audit_coulomb_setup(&setup, s, q->orbit, q->at_printed, d)) return false;
  if (coulomb_return_jacobian(value, &err, setup.params, setup.start) != SS_OK) {
    diag_set(d, "%s: error: under Coulomb's law nearby motions do not follow the word D-Gamma-H-C", s->path);
    return false;
  }
  arb_init(e);
  arb_set_d(e, err);
  for (int i = 0; i < 4; i++) {
    arb_set_d(j + i, value[i]);
    arb_add_error(j + i, e);
  }
  arb_clear(e);
  return true;
}

static bool precise_enough(arb_srcptr j, slong digits) {
  bool ok = true;
  struct text t;
  text_init(&t);
  for (int i = 0; i < 4; i++) ok = ok && num_print(&t, j + i, digits) == SS_OK;
  text_clear(&t);
  return ok;
}

bool audit_jacobian(arb_ptr j, arb_t trace, arb_t det, const struct model *m, const struct scene *s,
                    const struct jacobian_request *q, struct diag *d) {
  struct orbit_cache *cache = orbit_cache_new();
  struct point p;
  point_init(&p);
  bool ok = find_point(&p, s, q, cache, d);
  slong bits = (slong)((double)q->digits * 3.33) + GUARD_BITS, prec = bits;
  if (q->method == METHOD_FD) prec = 3 * bits / 2; /* central differences keep two thirds of the digits */
  bool good = ok && q->method == METHOD_ODE;
  if (good) ok = by_integration(j, s, q, d);
  for (int i = 0; ok && !good && i < ATTEMPTS; i++, prec += prec / 2) {
    int st = q->method == METHOD_ANALYTIC ? analytic(j, m, q, &p, prec, cache, d)
                                          : jacobian_by_model(j, q->method, &p, prec, cache);
    if (d->set)
      ok = false;
    else
      good = st == SS_OK && precise_enough(j, q->digits);
  }
  if (ok && !good) {
    diag_set(d, "%s: error: the Jacobian cannot be computed to %ld digits there", s->path, (long)q->digits);
    ok = false;
  }
  arb_t a;
  arb_init(a);
  arb_add(trace, j, j + 3, 2 * prec);
  arb_mul(det, j, j + 3, 2 * prec);
  arb_mul(a, j + 1, j + 2, 2 * prec);
  arb_sub(det, det, a, 2 * prec);
  /* J_f J_c J_b is a column and J_a a row, and the model's map before t_a likewise leads to one number */
  if (arb_contains_zero(det)) arb_zero(det);
  arb_clear(a);
  point_clear(&p);
  orbit_cache_free(cache);
  return ok;
}
