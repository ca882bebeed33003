/* How far a control is from what it damages: both sides of the claim's sentence with and without the damage, at the
   first of its points that has values. */
#include <math.h>

#include "judge.h"
#include "value/sentence.h"

enum { DISTANCE_PREC = 512, DRAWS = 64 };

/* log2 of the largest difference of entries over max(1, the entry). */
static double apart(const struct num_vec *a, const struct num_vec *b, slong n) {
  double most = -INFINITY;
  NUMBERS(arb, d);
  for (slong i = 0; i < n; i++) {
    arb_sub(d, num_vec_at(a, i), num_vec_at(b, i), DISTANCE_PREC);
    if (!arb_is_zero(d)) most = fmax(most, log2_upper(d) - fmax(0, log2_upper(num_vec_at(a, i))));
  }
  return most;
}

/* The two sentences, and both sides of each. */
struct pair {
  struct sentence s[2];
  struct num_vec side[2][2];
};

static bool values_at(double *log_distance, struct pair *q, const struct point *p, struct orbit_cache *cache) {
  slong n = q->s[0].n;
  struct num_ctx ctx = num_ctx_arb(DISTANCE_PREC);
  int s = SS_OK;
  for (int i = 0; i < 4; i++) num_vec_init(&q->side[i / 2][i % 2], n, ctx);
  for (int i = 0; i < 2; i++) s |= sentence_values(&q->side[i][0], &q->side[i][1], &q->s[i], p, cache);
  if (s == SS_OK)
    *log_distance = fmax(apart(&q->side[0][0], &q->side[1][0], n), apart(&q->side[0][1], &q->side[1][1], n));
  for (int i = 0; i < 4; i++) num_vec_clear(&q->side[i / 2][i % 2]);
  return s == SS_OK;
}

bool control_distance(double *log_distance, struct judge *j, const struct claim *c, const char *control) {
  enum { MOST = 8 };
  struct point_spec spec[MOST];
  struct pair q;
  struct sampler sampler;
  bool found = false, made[2];
  if (!claim_tried_at_points(c) || claim_points(spec, MOST, j, c) < 1) return false;
  for (int i = 0; i < 2; i++)
    made[i] = sentence_from_claim(&q.s[i], (struct view){j->model, LAYER_CORRECTED, NULL, i ? control : NULL}, c, NULL,
                                  0, j->d);
  sampler_init(&sampler, c->id, &spec[0]);
  LOCAL(point, p);
  for (int i = 0; made[0] && made[1] && q.s[0].n == q.s[1].n && !found && i < DRAWS; i++) {
    sampler_next(&p, &sampler);
    found = point_settle(&p, j->cache) && values_at(log_distance, &q, &p, j->cache);
  }
  for (int i = 0; i < 2; i++) sentence_clear(&q.s[i]);
  return found;
}
