/* The stability criterion: against the fate of points beside orbits, and what it says about the scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "audit_impl.h"

/* Does the return map, iterated in double from beside its fixed point, come back (+1), leave (-1), or neither (0)? */
static int iterate(const double params[N_PARAMS], double r0) {
  enum { STEPS = 400 };
  double delta = 1e-4 * fmax(1.0, fabs(r0)), r = r0 + delta;
  for (int i = 0; i < STEPS; i++) {
    double t[4], next;
    if (dyn_return_map_d(&next, NULL, t, params, r, &dyn_limits_default) != SS_OK) return -1;
    r = next;
    if (fabs(r - r0) < 0.01 * delta) return 1;
    if (fabs(r - r0) > 10 * delta) return -1;
  }
  return 0;
}

static void criterion_at(long count[6], struct judge *j, struct view view, const char *trace, const struct point *p) {
  const struct dyn_orbit *o = &orbit_cache_get(j->cache, p->q, FD_PREC + 64)->orbit[p->orbit];
  if (o->grazing) return;
  arb_ptr tr = _arb_vec_init(16);
  int n;
  if (expression_at(tr, &n, view, trace, "stability", p, FIRST_PREC, j->cache, j->d) == SS_OK && n == 1) {
    count[arb_overlaps(tr, o->trace) ? 0 : 1]++;
    arb_t m;
    arb_init(m);
    arb_abs(m, tr);
    arb_sub_si(m, m, 1, FIRST_PREC);
    double params[N_PARAMS], margin = arf_get_d(arb_midref(m), ARF_RND_NEAR);
    for (int i = 0; i < N_PARAMS; i++) params[i] = fmpq_get_d(&p->q[i]);
    double r0 = arf_get_d(arb_midref(o->z20), ARF_RND_NEAR) - arf_get_d(arb_midref(o->z10), ARF_RND_NEAR);
    if (fabs(margin) > 0.05) { /* nearer to 1 the iteration is too slow to tell */
      int fate = iterate(params, r0);
      count[fate == 0 ? 4 : (fate > 0) == (margin < 0) ? 2 : 3]++;
      if (margin < 0) count[5]++;
    }
    arb_clear(m);
  }
  _arb_vec_clear(tr, 16);
}

bool judge_criterion(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  enum { ORBITS = 24, DRAWS = 200 };
  const char *trace = claim_get(c, "formula");
  if (!trace) return claim_error(j, c, "kind", "the attribute formula is missing");
  struct sampler s;
  struct point p;
  long count[6] = {0}; /* traces overlap, differ; fate as said, against, undecided; stable orbits among them */
  sampler_init(&s, c->id, POINT_ORBIT, PHASE_D, NULL);
  point_init(&p);
  for (int i = 0; i < DRAWS && count[2] + count[3] < ORBITS; i++) {
    sampler_next(&p, &s);
    if (point_settle(&p, j->cache)) criterion_at(count, j, view, trace, &p);
  }
  point_clear(&p);
  struct route_word w[2] = {{"balls",
                             count[1]   ? SAYS_DIFFERS
                             : count[0] ? SAYS_AGREES
                                        : SAYS_NOTHING,
                             true, count[0] + count[1]},
                            {"iteration",
                             count[3]   ? SAYS_DIFFERS
                             : count[4] ? SAYS_UNDECIDED
                             : count[2] ? SAYS_AGREES
                                        : SAYS_NOTHING,
                             false, count[2] + count[3] + count[4]}};
  static const char *const words[] = {"undecided", "agrees", "differs", "undecided"};
  struct evidence *e = finding_add(f, j->out);
  e->route = "balls";
  e->layer = layer_name[view.layer];
  e->result = words[w[0].says];
  e->bits = FIRST_PREC;
  e->trials = w[0].trials;
  e->note = result_str(j->out, "tr J of the paper's chain against the slope of the return map: %ld agree, %ld differ",
                       count[0], count[1]);
  e = finding_add(f, j->out);
  e->route = "iteration";
  e->layer = "model";
  e->result = words[w[1].says];
  e->bits = 53;
  e->trials = w[1].trials;
  e->note = result_str(j->out,
                       "from beside the orbit the iterates come back where |tr J| < 1 (%ld orbits) and leave "
                       "elsewhere: %ld as said, %ld against, %ld undecided",
                       count[5], count[2], count[3], count[4]);
  f->verdict = verdict_of(w, 2, false);
  return !j->d->set;
}

/* What the criterion says about the scene; the paper draws no conclusion, so nothing is judged. */
bool judge_report(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *trace = claim_get(c, "formula");
  if (!trace) return claim_error(j, c, "kind", "the attribute formula is missing");
  const struct dyn_orbits *list = scene_orbits(j->scene, j->cache);
  static const char *const said[] = {"unstable", "conditionally stable", "undecided"};
  for (slong i = 0; i < list->n; i++) {
    const struct dyn_orbit *o = &list->orbit[i];
    finding_state(f, j->out, "model", FD_PREC,
                  result_str(j->out, "orbit %ld of %ld found: t_a = %s, t_b = %s, t_c = %s, t_d = %s", (long)i + 1,
                             (long)list->n, ball_text(j, o->t[0], 6), ball_text(j, o->t[1], 6),
                             ball_text(j, o->t[2], 6), ball_text(j, o->t[3], 6)),
                  result_str(j->out, "tr J = %s: %s by the criterion; %s", ball_text(j, o->trace, 8), said[o->stable],
                             o->admissible == TRUTH_TRUE    ? "admissible"
                             : o->admissible == TRUTH_FALSE ? "not admissible"
                                                            : "admissibility undecided"));
  }
  struct point p;
  point_init(&p);
  for (int layer = 0; printed_point(&p, j->scene) && layer < N_LAYERS; layer++) {
    struct view v = {view.model, (enum layer)layer, NULL, view.control};
    arb_ptr tr = _arb_vec_init(16);
    int n;
    if (expression_at(tr, &n, v, trace, "stability", &p, FIRST_PREC, j->cache, j->d) == SS_OK) {
      finding_state(f, j->out, layer_name[layer], FIRST_PREC, "the printed numbers, taken exactly",
                    result_str(j->out, "the paper's chain gives tr J = %s", ball_text(j, tr, 8)));
    }
    _arb_vec_clear(tr, 16);
  }
  point_clear(&p);
  f->verdict = VERDICT_DEFINITION;
  return !j->d->set;
}
