/* From what is asked for back to what must be computed.  Points say which motions a claim is tried on, its kind what
   else it looks at; the formulas say which matrices; costs are those of the table. */
#include "plan.h"

#include <string.h>

#include "base/work.h"
#include "judge/judge.h"
#include "run.h"

struct planner {
  struct audit_plan *out;
  struct judge judge; /* nothing is judged with it */
  const struct audit_options *opt;
  struct dependences *rests;
  const struct pieces *controls;
  bool box; /* the scene is one */
};

static void add_name(struct planner *pl, struct plan_list *list, const char *name) {
  arena_list_add(&pl->out->arena, &list->item, &list->n, arena_strdup(&pl->out->arena, name));
}

static bool lists(const struct plan_list *l, const char *name) {
  return word_find(name, l->item, l->n) < l->n;
}

/* --- A claim --- */

static void plan_routes(struct planner *pl, struct planned_claim *p, const struct claim *c) {
  char name[MOST_CLAIM_ROUTES][ROUTE_NAME];
  int n = claim_routes(name, c);
  for (int i = 0; i < n; i++)
    if (route_is_asked(pl->judge.scene, name[i])) add_name(pl, &p->routes, name[i]);
}

/* The motions that the points are. */
static unsigned parts_of_points(struct planner *pl, const struct claim *c) {
  enum { MOST = 8 };
  struct point_spec spec[MOST];
  struct diag d = {0};
  unsigned parts = 0;
  pl->judge.d = &d;
  int n = claim_points_asked(c) ? claim_points(spec, MOST, &pl->judge, c) : 0;
  for (int i = 0; i < n; i++) {
    if (spec[i].kind == POINT_FLOW) parts |= 1U << (WORK_PHASE_D + (int)spec[i].phase);
    if (spec[i].kind > POINT_FLOW) parts |= NEEDS_PHASES;
    if (spec[i].kind == POINT_ORBIT) parts |= NEEDS_OTHER;
  }
  return parts;
}

static unsigned parts_of_names(const struct plan_list *matrices) {
  unsigned parts = 0;
  for (int i = 0; i < matrices->n; i++) {
    int ph = name_of_propagator(matrices->item[i]);
    if (ph >= 0) parts |= 1U << (WORK_PHASE_D + ph);
  }
  return parts;
}

/* Definitions that are matrices of the model under the paper's names, functions of the time with their argument. */
static void plan_matrices(struct planner *pl, struct planned_claim *p, size_t a) {
  for (size_t i = 0; i < dependences_n_used(pl->rests, a); i++) {
    char name[64];
    const char *reached = dependences_used(pl->rests, a, i)->name;
    snprintf(name, sizeof name, "%.56s", reached);
    if (!oracle_find(name)) snprintf(name, sizeof name, "%.56s(t)", reached);
    if (oracle_find(name) && !lists(&p->matrices, name)) add_name(pl, &p->matrices, name);
  }
}

/* What judging the claim looks at besides its points; a correction is judged by another claim's judge. */
static unsigned parts_of_kind(struct planned_claim *p, const struct claim *c) {
  const struct claim_kind *kind = c ? claim_kind_of(c) : NULL;
  if (!kind || !kind->parts) return 0;
  p->first_bits = FIRST_PREC;
  p->last_bits = LAST_PREC;
  return kind->parts;
}

static void plan_parts(struct planner *pl, struct planned_claim *p, const struct claim *c) {
  p->first_bits = p->last_bits = 0;
  unsigned parts = parts_of_points(pl, c), own = parts_of_kind(p, c);
  parts |= own | parts_of_kind(p, claim_named(pl->judge.claims, claim_get(c, "repaired-as")));
  if (own & NEEDS_ALGEBRA) parts |= parts_of_names(&p->matrices);
  if (own & NEEDS_ALGEBRA && parts & (NEEDS_OTHER | NEEDS_SCENE) && p->matrices.n) parts |= NEEDS_PHASES;
  if (pl->box) parts &= ~(unsigned)NEEDS_SCENE;
  for (int part = 0; part < WORK_BITS_128; part++)
    if (parts >> part & 1U) add_name(pl, &p->parts, work_part_name[part]);
}

static void add_cost(struct planned_claim *p, const struct cost *c) {
  if (!c) return;
  p->units = (p->units < 0 ? 0 : p->units) + c->units;
  p->ms = (p->ms < 0 ? 0 : p->ms) + c->ms;
}

/* What is about the numbers of one scene has nothing to speak of in a box of parameters, and its controls neither. */
static bool is_left_out(const struct planner *pl, const struct claim *c) {
  return pl->box && claim_of_scene(c);
}

static void plan_claim(struct planner *pl, const struct claim *c) {
  struct planned_claim *p = &pl->out->claim[pl->out->n_claims++];
  *p = (struct planned_claim){
      .id = c->id, .kind = claim_get(c, "kind"), .points = claim_points_asked(c), .units = -1, .ms = -1};
  p->left_out = is_left_out(pl, c);
  if (p->left_out) {
    p->units = p->ms = 0;
    return;
  }
  plan_routes(pl, p, c);
  plan_matrices(pl, p, (size_t)(c - pl->judge.claims->claim));
  plan_parts(pl, p, c);
  add_cost(p, cost_of(pl->opt->costs, "claim", c->id));
  for (size_t i = 0; i < pl->controls->n; i++) {
    if (pl->controls->item[i].claim != c) continue;
    add_name(pl, &p->controls, pl->controls->item[i].name);
    add_cost(p, cost_of(pl->opt->costs, "control", pl->controls->item[i].name));
  }
}

/* --- What is shared --- */

static struct planned_work *add_work(struct planner *pl, const char *what, const struct cost *c) {
  struct planned_work *w = &pl->out->shared[pl->out->n_shared++];
  *w = (struct planned_work){what, 0, c ? c->units : -1, c ? c->ms : -1};
  return w;
}

/* Orbits and pool are paid for by the first claim that needs them. */
static void plan_shared(struct planner *pl, const struct pieces *first) {
  static const int kept[] = {WORK_SCENE_ORBITS, WORK_OTHER_ORBITS, WORK_ORBIT_POOL};
  for (size_t k = 0; k < sizeof kept / sizeof *kept; k++) {
    long n = 0;
    for (int i = 0; i < pl->out->n_claims; i++) n += lists(&pl->out->claim[i].parts, work_part_name[kept[k]]);
    if (n) add_work(pl, work_part_name[kept[k]], NULL)->claims = n;
  }
  for (size_t i = 0; i < first->n; i++) {
    const struct piece *q = &first->item[i];
    bool of_scene = q->kind == PIECE_TABLES || q->kind == PIECE_READINGS || q->kind == PIECE_VALUES;
    if (q->kind != PIECE_CLAIM && !(of_scene && pl->box)) /* a box has no numbers of its own */
      add_work(pl, q->name, cost_of(pl->opt->costs, piece_what[q->kind], q->name));
  }
}

/* --- Consequences --- */

/* The row of the claim, or of another that fails together with it, since a run names the first of those that it
   judges. */
static const struct cost *consequence_cost(const struct planner *pl, const struct claim *c) {
  const struct claims *all = pl->judge.claims;
  for (size_t i = 0; i < all->n; i++) {
    const struct cost *row = cost_of(pl->opt->costs, "consequence", all->claim[i].id);
    if (row && claims_fail_together(&all->claim[i], c)) return row;
  }
  return NULL;
}

static bool fails_on_record(const struct planner *pl, const struct claim *c) {
  return c && !is_left_out(pl, c) && verdict_fails(claim_recorded(&pl->judge, c));
}

/* What fails is not known before it is judged; what fails on record is expected to, and costs what it did: a failure
   without a correction, which has no consequences, has no row either. */
static void plan_consequences(struct planner *pl, const struct pieces *first) {
  for (size_t i = 0; i < first->n; i++) {
    const struct claim *c = first->item[i].claim;
    if (!fails_on_record(pl, c)) continue;
    bool seen = false;
    for (size_t k = 0; k < i && !seen; k++)
      seen = fails_on_record(pl, first->item[k].claim) && claims_fail_together(first->item[k].claim, c);
    const struct cost *row = seen ? NULL : consequence_cost(pl, c);
    if (row) add_work(pl, arena_printf(&pl->out->arena, "consequences of %s", c->id), row);
  }
}

static void add_up(struct audit_plan *out) {
  for (int i = 0; i < out->n_claims; i++) {
    out->units += out->claim[i].units > 0 ? out->claim[i].units : 0;
    out->ms += out->claim[i].ms > 0 ? out->claim[i].ms : 0;
  }
  for (int i = 0; i < out->n_shared; i++) {
    out->units += out->shared[i].units > 0 ? out->shared[i].units : 0;
    out->ms += out->shared[i].ms > 0 ? out->shared[i].ms : 0;
  }
}

bool audit_plan(struct audit_plan *p, const struct model *m, const struct claims *claims, const struct claims *controls,
                const struct scene *scene, const struct audit_options *opt, struct diag *d) {
  OWNED(pieces) first = {.n = 0}, beside = {.n = 0};
  LOCAL(audit_result, nothing);
  *p = (struct audit_plan){.scene = scene->name};
  bool ok = run_check_selection(m, claims, opt, scene, d), box = scene_is_box(scene);
  if (ok) pieces_first(&first, m, claims, scene, opt);
  ok = ok && pieces_controls(&beside, claims, controls, scene, opt, d);
  struct planner pl = {.out = p, .opt = opt, .controls = &beside, .box = box};
  if (ok) {
    pl.rests = dependences_new(m, claims);
    pl.judge = (struct judge){.out = &nothing, .model = m, .claims = claims, .scene = scene};
    p->claim = arena_alloc(&p->arena, (claims->n + 1) * sizeof *p->claim);
    for (size_t i = 0; i < first.n; i++)
      if (first.item[i].kind == PIECE_CLAIM) plan_claim(&pl, first.item[i].claim);
    p->shared = arena_alloc(&p->arena, (2 * first.n + 3) * sizeof *p->shared);
    plan_shared(&pl, &first);
    plan_consequences(&pl, &first);
    add_up(p);
    dependences_free(pl.rests);
  }
  return ok;
}

void audit_plan_clear(struct audit_plan *p) {
  arena_clear(&p->arena);
}
