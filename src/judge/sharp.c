/* Inequalities without slack: each step of the record is an equality at the start or at the end of the phase that the
   claim's points name.  An inequality that is true and weaker than it could be passes every check of its truth, and
   fails this one. */
#include "judge.h"
#include "num/calc.h"
#include "proof/exact_proof.h"

/* What a route saw: points at which every step becomes an equality, at which some step stays apart, and neither. */
struct tally {
  struct answers reached;
  const char *where; /* of the first that stays apart */
};

/* TRUE for each step whose sides overlap, enclosed narrowly, with the time t at this end of the phase; FALSE when they
   are disjoint. */
static int steps_at(truth *holds, struct sentence *s, struct point *p, slong end, enum variant variant,
                    struct orbit_cache *cache) {
  struct calc c = calc_begin(num_ctx_arb(FIRST_PREC));
  struct num_vec lhs = calc_vec(&c, s->n), rhs = calc_vec(&c, s->n);
  fmpq_set_si(&p->q[Q_S], end, 1);
  int status = sentence_values(&lhs, &rhs, s, p, variant, cache);
  arb_t d;
  arb_init(d);
  for (slong i = 0; i < s->n; i++) {
    holds[i] = TRUTH_UNKNOWN;
    if (status != SS_OK) continue;
    arb_sub(d, num_vec_at(&lhs, i), num_vec_at(&rhs, i), FIRST_PREC);
    if (!arb_contains_zero(d))
      holds[i] = TRUTH_FALSE;
    else if (mag_cmp_2exp_si(arb_radref(d), -FIRST_PREC / 2) < 0)
      holds[i] = TRUTH_TRUE;
  }
  arb_clear(d);
  calc_clear(&c);
  return status;
}

static void try_point(struct tally *t, struct sentence *s, struct point *p, enum variant variant, struct judge *j) {
  enum { MAX = 16 };
  truth at[2][MAX], all = TRUTH_TRUE;
  if (s->n > MAX) return;
  for (int end = 0; end < 2; end++)
    if (steps_at(at[end], s, p, end, variant, j->cache) != SS_OK) return;
  for (slong i = 0; i < s->n; i++) all = truth_and(all, truth_or(at[0][i], at[1][i]));
  t->reached.of[all]++;
  if (all == TRUTH_FALSE && !t->where) t->where = point_text(j, p);
}

static void run_route(struct tally *t, struct judge *j, const struct claim *c, struct sentence *s,
                      const struct point_spec *spec, enum variant variant) {
  enum { DRAWS_PER_POINT = 8 };
  struct sampler sampler;
  struct point p;
  sampler_init(&sampler, c->id, spec);
  point_init(&p);
  for (long draws = 0; answers_given(&t->reached) < spec->n && draws < DRAWS_PER_POINT * spec->n; draws++) {
    if (j->effort == EFFORT_REFUTE && t->reached.of[TRUTH_FALSE]) break;
    sampler_next(&p, &sampler);
    if (point_settle(&p, j->cache)) try_point(t, s, &p, variant, j);
  }
  point_clear(&p);
}

static struct route_result conclude(struct finding *f, struct judge *j, const struct tally *t, const char *route,
                                    bool decisive) {
  long trials = answers_given(&t->reached), apart = t->reached.of[TRUTH_FALSE];
  const char *note = trials ? "each step becomes an equality at one end of the phase" : "no accepted point";
  if (apart)
    note = result_str(j->out, "at %ld of %ld points some step stays apart at both ends of the phase", apart, trials);
  return finding_add_route(f, j->out, answers_route(route, decisive, &t->reached), "corrected", FIRST_PREC, t->where,
                           note);
}

bool judge_sharp(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *id = claim_get(c, "statement");
  struct point_spec spec;
  struct sentence s;
  if (!id) return claim_error(j, c, "kind", "the attribute statement is missing");
  const struct statement_record *r = claim_record(view, c, "statement", id, j->d);
  if (!r) return false;
  int n = claim_points(&spec, 1, j, c);
  if (n < 0) return false;
  if (spec.kind != POINT_ORBIT && spec.kind != POINT_ARC)
    return claim_error(j, c, "points", "the time lies in a phase of arcs or orbits");
  bool ok = sentence_from_relations(&s, view, r, NULL, 0, j->d);
  struct route_result w[2];
  struct tally t[2] = {{.where = NULL}, {.where = NULL}};
  n = j->effort == EFFORT_REFUTE ? 1 : 2;
  for (int i = 0; ok && i < n; i++) {
    run_route(&t[i], j, c, &s, &spec, i ? VARIANT_EXPONENTIAL : VARIANT_CLOSED);
    w[i] = conclude(f, j, &t[i], i ? "exponential" : "balls", i == 0);
  }
  struct exact_proof proof = {.proved = false};
  if (ok && j->effort == EFFORT_FULL && t[0].reached.of[TRUTH_FALSE] == 0) {
    proof = exact_prove(j, c, view, NULL);
    finding_add_proof(f, j->out, &proof, layer_name[LAYER_CORRECTED], false);
  }
  if (ok) f->verdict = verdict_of(w, n, proof.proved);
  sentence_clear(&s);
  return ok;
}
