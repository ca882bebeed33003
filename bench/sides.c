/* What a number of digits costs in a claim: both sides of its sentence, enclosed to so many digits at one of its own
   points, orbits and events included.  The verdict itself is found at the precision that decides it, whatever is
   asked. */
#include <stdlib.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "claim/claim.h"
#include "value/sentence.h"

enum { DRAWS = 200, SPARE = 64, ATTEMPTS = 4, SETUP_DIGITS = 15 };

struct bench_sides {
  struct sentence s;
  struct point p;
};

bool bench_close_enough(const struct num_vec *v, long digits) {
  slong bits = (slong)((double)digits * 3.3219281) + 1;
  for (slong i = 0; i < v->len; i++) {
    arb_srcptr x = num_vec_at(v, i);
    bool large = arf_cmpabs_2exp_si(arb_midref(x), 0) > 0;
    if (!arb_is_finite(x)) return false;
    if (large ? arb_rel_accuracy_bits(x) < bits : mag_cmp_2exp_si(arb_radref(x), -bits) > 0) return false;
  }
  return true;
}

bool bench_sides_run(struct bench_sides *b, long digits) {
  slong prec = (slong)((double)digits * 3.3219281) + SPARE;
  bool good = false;
  for (int i = 0; i < ATTEMPTS && !good; i++, prec += prec / 2) {
    struct orbit_cache *cache = orbit_cache_new();
    OWNED(num_vec) lhs, rhs;
    num_vec_init(&lhs, b->s.n, num_ctx_arb(prec));
    num_vec_init(&rhs, b->s.n, num_ctx_arb(prec));
    int status = sentence_values(&lhs, &rhs, &b->s, &b->p, cache);
    good = status == SS_OK && bench_close_enough(&lhs, digits) && bench_close_enough(&rhs, digits);
    orbit_cache_free(cache);
    if (status & SS_DOMAIN) break;
  }
  return good;
}

/* The first of the claim's points at which both sides have values. */
static bool find_point(struct bench_sides *b, const struct claim *c, const struct point_spec *spec) {
  struct sampler s;
  bool found = false;
  sampler_init(&s, c->id, spec);
  for (int i = 0; i < DRAWS && !found; i++) {
    struct orbit_cache *cache = orbit_cache_new();
    sampler_next(&b->p, &s);
    found = point_settle(&b->p, cache) && bench_sides_run(b, SETUP_DIGITS);
    orbit_cache_free(cache);
  }
  return found;
}

struct bench_sides *bench_sides_new(const struct bench_env *env, const struct claim *c) {
  struct diag d = {0};
  struct point_spec spec[8];
  if (!claim_get(c, "points") || (!claim_get(c, "statement") && !claim_get(c, "value"))) return NULL;
  struct judge j = {.model = env->model, .claims = env->claims, .scene = env->scene, .d = &d};
  struct bench_sides *b = ss_malloc(sizeof *b);
  point_init(&b->p);
  bool ok = sentence_from_claim(&b->s, claim_view(env->model, c), c, NULL, 0, &d) &&
            claim_points(spec, COUNT(spec), &j, c) > 0 && find_point(b, c, &spec[0]);
  if (ok) return b;
  bench_sides_free(b);
  return NULL;
}

void bench_sides_free(struct bench_sides *b) {
  sentence_clear(&b->s);
  point_clear(&b->p);
  free(b);
}
