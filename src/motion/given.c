/* Orbits from any two of e1, e2, t_a, t_b, t_c, t_d.

   given_search.c finds in double precision where the four equations hold with the given values; here each such place is
   refined, enclosed in balls and judged. */
#include "given.h"

#include <stdlib.h>

#include "base/arena.h"
#include "given_search.h"
#include "num/solve.h"
#include "orbit_judge.h"

const char *const dyn_quantity_id[N_QUANTITIES] = {"e1", "e2", "t_a", "t_b", "t_c", "t_d"};
const struct dyn_limits dyn_given_limits = {200, 100000};

enum { RAISES = 4 }; /* of the precision */

/* --- Refinement and proof. --- */

/* A seed's solution. */
struct solution {
  struct word_root root;
  const struct seed *seed;
  const struct given_problem *q;
};

static int solve(void *self, slong prec) {
  struct solution *s = self;
  for (int i = 0; i < N_QUANTITIES; i++) arb_set_d(s->root.x[i], s->seed->x[i]);
  return word_solve(&s->root, &s->q->data, prec);
}

static int describe(struct dyn_orbit *o, void *self, slong prec) {
  const struct solution *s = self;
  return word_describe(o, &s->root, s->q->data.model, prec);
}

/* Its conditions.  Returns whether e1 and e2 are positive and the events proved to be the first ones. */
static truth judge(struct dyn_orbit *o, void *self, slong prec) {
  const struct solution *s = self;
  truth domain, first = word_judge_orbit(o, &domain, &s->root, s->q->data.model, prec, s->q->lim.max_steps);
  return truth_and(domain, first);
}

/* --- The list. --- */

/* The precision is raised where a solution cannot be told from another one yet. */
static int settle(struct solution *s, slong work) {
  int status = SS_UNABLE;
  for (int i = 0; i <= RAISES && status; i++) status = solve(s, work << i);
  return status;
}

static int collect(struct dyn_orbits *list, const struct seeds *seeds, const struct given_problem *q, slong prec) {
  FREED struct solution *found = ss_malloc((seeds->n + 1) * sizeof *found);
  size_t n = 0;
  int status = SS_OK;
  list->orbit = ss_malloc((seeds->n + 1) * sizeof *list->orbit);
  for (size_t i = 0; i < seeds->n; i++) {
    struct solution *s = &found[n];
    *s = (struct solution){.seed = &seeds->seed[i], .q = q};
    const struct orbit_source source = {s, solve, describe, judge};
    slong work = orbit_planned_bits(&source, prec);
    int failed = settle(s, work);
    bool known = false;
    for (size_t k = 0; k < n && !failed && !known; k++)
      known = krawczyk_same(found[k].root.x, found[k].root.box, s->root.x, s->root.box, N_QUANTITIES);
    status |= failed;
    if (failed || known) {
      word_root_clear(&s->root);
      continue;
    }
    status |= orbit_list_add(list, &source, work, prec);
    list->bits = FLINT_MAX(list->bits, work);
    n++;
  }
  for (size_t k = 0; k < n; k++) word_root_clear(&found[k].root);
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, dyn_orbits_by_z10);
  return status;
}

static int problem_init(struct given_problem *q, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                        const struct dyn_limits *lim) {
  if (which[0] == which[1]) return SS_DOMAIN;
  *q = (struct given_problem){.data = word_data_of(model, which, value), .lim = lim ? *lim : dyn_given_limits};
  double p[N_PARAMS] = {fmpq_get_d(model), fmpq_get_d(model + 1), fmpq_get_d(model + 2), 1, 1};
  if (!dyn_in_domain(model, 3)) return SS_DOMAIN;
  for (int i = 0; i < 2; i++) {
    if (which[i] != QUANTITY_TA && fmpq_sgn(value + i) <= 0) return SS_DOMAIN;
    q->target[i] = fmpq_get_d(value + i);
    if (which[i] == QUANTITY_E1) p[P_E1] = q->target[i];
  }
  if (return_map_double_init(&q->k, p)) return SS_UNABLE; /* in the domain, but not in that of double precision */
  return_map_double_records(&q->k);
  return SS_OK;
}

/* e1 and e2 are given: the search of dynamics.h. */
static int find_by_limits(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2],
                          const fmpq *value, slong prec, const struct dyn_limits *lim) {
  fmpq params[N_PARAMS];
  int first = which[0] == QUANTITY_E1 ? 0 : 1;
  for (int i = 0; i < 3; i++) params[i] = model[i]; /* borrowed */
  params[P_E1] = value[first];
  params[P_E2] = value[1 - first];
  return dyn_orbits_find(list, params, prec, lim);
}

int dyn_orbits_given(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                     slong prec, const struct dyn_limits *lim) {
  struct given_problem q;
  *list = (struct dyn_orbits){.n = 0};
  int status = problem_init(&q, model, which, value, lim);
  if (status) return status;
  if (given_problem_knows(&q, QUANTITY_E1) && given_problem_knows(&q, QUANTITY_E2))
    return find_by_limits(list, model, which, value, prec, lim);
  struct seeds seeds;
  status = given_search(&seeds, &q);
  status |= collect(list, &seeds, &q, prec);
  list->evaluations = seeds.evaluations;
  free(seeds.seed);
  return status;
}
