/* stickslip explain: one claim with all that a reader needs to check it by hand. */
#include <stdlib.h>
#include <string.h>

#include "audit.h"
#include "claim/claim.h"
#include "claim/kinds.h"
#include "judge/certificate.h"
#include "proof/stable_forms.h"
#include "value/printed.h"
#include "value/sentence.h"

static void add_line(struct text *out, const char *label, const char *value) {
  if (value) text_printf(out, "%-11s %s\n", label, value);
}

static void add_verdict(struct text *out, const struct finding *f) {
  char mark = verdict_fails(f->verdict)                                           ? EXPLAIN_BAD
              : f->verdict == VERDICT_UNKNOWN                                     ? EXPLAIN_DOUBT
              : f->verdict == VERDICT_DEFINITION || f->verdict == VERDICT_SKIPPED ? EXPLAIN_PLAIN
                                                                                  : EXPLAIN_GOOD;
  text_printf(out, "%-11s %c%s%c", "verdict", mark, verdict_name[f->verdict], EXPLAIN_END);
  if (f->recorded != N_VERDICTS) text_printf(out, " (on record: %s)", verdict_name[f->recorded]);
  text_add_char(out, '\n');
  add_line(out, "condition", f->condition);
  add_line(out, "fault", f->fault);
  if (f->correction)
    text_printf(out, "%-11s %s (%s)\n", "correction", f->correction, verdict_name[f->correction_verdict]);
  add_line(out, "effect", f->effect);
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    text_printf(out, "%-11s %s, %s: %s", i ? "" : "evidence", e->route, or_dash(e->layer), e->result);
    if (e->trials >= 0) text_printf(out, ", %ld trial%s", e->trials, plural_s(e->trials));
    if (e->residual) text_printf(out, ", residual %s", e->residual);
    if (e->note) text_printf(out, "; %s", e->note);
    if (evidence_where(e) && !e->residual) text_printf(out, "; at %s", e->worst);
    text_add_char(out, '\n');
  }
}

/* --- Both sides at a point --- */

enum { MOST_ENTRIES = 64 };

/* Of each entry, whether its sides are proved to differ there; false, and none, where they have no value. */
static bool find_differences(bool differs[MOST_ENTRIES], struct sentence *s, const struct point *p,
                             struct orbit_cache *cache) {
  OWNED(num_vec) lhs, rhs;
  const struct num_ctx ctx = num_ctx_arb(FIRST_PREC);
  num_vec_init(&lhs, s->n, ctx);
  num_vec_init(&rhs, s->n, ctx);
  bool ok = s->n <= MOST_ENTRIES && sentence_values(&lhs, &rhs, s, p, cache) == SS_OK;
  for (slong i = 0; ok && i < s->n; i++) {
    const void *x = num_vec_at(&lhs, i), *y = num_vec_at(&rhs, i);
    differs[i] = s->ops[i] == REL_EQ ? !arb_overlaps(x, y) : inequality_holds(ctx.type, s->ops[i], x, y) == TRUTH_FALSE;
  }
  return ok;
}

/* One side in one number type: a row of a matrix on each line, what is no matrix on one. */
static void add_side(struct text *out, const struct num_vec *v, int cols, const bool differs[MOST_ENTRIES]) {
  NUMBERS(arb, x);
  for (slong i = 0; i < v->len; i++) {
    bool marked = i < MOST_ENTRIES && differs[i];
    text_add(out, i == 0 ? " " : cols > 1 && i % cols == 0 ? "\n             " : "  ");
    if (marked) text_add_char(out, EXPLAIN_BAD);
    v->ctx.type->get_arb(x, num_vec_at(v, i));
    if (v->ctx.type->rigorous)
      num_print_ball(out, x, 20);
    else if (num_print(out, x, v->ctx.type == &num_double ? 17 : 30) != SS_OK)
      text_add(out, "undefined");
    if (marked) text_printf(out, "*%c", EXPLAIN_END);
  }
  text_add_char(out, '\n');
}

static void add_values(struct text *out, struct sentence *s, const struct point *p, struct orbit_cache *cache) {
  const struct num_ctx types[] = {num_ctx_double(), num_ctx_mpfr(128), num_ctx_arb(128)};
  bool differs[MOST_ENTRIES] = {false}, any = false, equations = true;
  find_differences(differs, s, p, cache);
  for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
    OWNED(num_vec) lhs, rhs;
    num_vec_init(&lhs, s->n, types[i]);
    num_vec_init(&rhs, s->n, types[i]);
    int status = sentence_values(&lhs, &rhs, s, p, cache);
    if (status) {
      text_printf(out, "%-11s %s at this point\n", types[i].type->name,
                  !(status & SS_DOMAIN) ? "cannot be told"
                  : s->n_given          ? "undefined, or outside the formula's range,"
                                        : "undefined");
    } else {
      text_printf(out, "%-6s left ", types[i].type->name);
      add_side(out, &lhs, s->cols, differs);
      text_printf(out, "%-6s right", types[i].type->name);
      add_side(out, &rhs, s->cols, differs);
    }
  }
  for (slong i = 0; i < s->n && i < MOST_ENTRIES; i++) {
    any |= differs[i];
    equations &= !differs[i] || s->ops[i] == REL_EQ;
  }
  if (any) add_line(out, "*", equations ? "the two sides differ here" : "this fails here");
}

/* As the files write it, or what is no formula as it is printed. */
static void add_formulas(struct text *out, const struct model *m, const struct claim *c, const struct finding *f) {
  size_t begin = out->len;
  if (claim_formulas(out, m, c, "            ") > 0)
    memcpy(out->data + begin, "as read", strlen("as read"));
  else
    add_line(out, "as read", f->printed);
}

/* The static friction that was taken for the orbit of a realistic point. */
static void print_friction(struct text *out, const struct point *p) {
  NUMBERS(fmpq, u_r);
  for (int i = 0; i < 2 && p->realistic; i++) {
    fmpq_add(u_r, &p->q[Q_E1 + i], &p->q[Q_US1 + i]);
    text_printf(out, ", u_r%d = ", i + 1);
    num_print_q(out, u_r);
  }
}

/* The first of the claim's points at which both sides have values; where it fails, the first at which it does. */
static void draw_own(struct point *out, struct judge *j, const struct claim *c, struct sentence *s,
                     const struct point_spec *spec, bool fails) {
  enum { MOST_DRAWS = 4096 };
  struct sampler sampler;
  LOCAL(point, p);
  bool have = false, done = false;
  sampler_init(&sampler, c->id, spec);
  for (int i = 0; i < MOST_DRAWS && !done; i++) {
    sampler_next(&p, &sampler);
    enum outcome outcome = sentence_try_balls(s, &p, VARIANT_CLOSED, j->cache).outcome;
    done = fails ? outcome == OUTCOME_DIFFERS : outcome != OUTCOME_REJECTED;
    if (done || (!have && outcome != OUTCOME_REJECTED)) point_copy(out, &p);
    have = have || outcome != OUTCOME_REJECTED;
  }
}

/* The sentence at a point: like the claim's own points, at the scene's parameters, changed by --at. */
static bool explain_point(struct text *out, struct judge *j, const struct claim *c, struct view view, const char *at,
                          bool tape, bool fails) {
  struct point_spec spec[4];
  if (!claim_points_asked(c) || (!j->model->system && claim_kind_of(c)->of_model)) {
    if (at) diag_set(j->d, "error: --at: the claim %s is not tried at points that can be chosen", c->id);
    return !at;
  }
  if (claim_points(spec, 4, j, c) < 1) return false;
  OWNED(sentence) s;
  struct sampler sampler;
  LOCAL(point, drawn, p);
  if (spec[0].kind == POINT_ARC) spec[0].kind = POINT_ORBIT;
  sampler_init(&sampler, c->id, &spec[0]);
  sampler_next(&drawn, &sampler);
  bool ok = sentence_from_claim(&s, view, c, NULL, 0, j->d);
  if (ok && !at && !point_of_model(&drawn)) draw_own(&drawn, j, c, &s, &spec[0], fails);
  scene_point(&p, &drawn, j->scene, j->cache);
  if (at) p.scene = NULL; /* other data than the scene's */
  ok = ok && point_set(&p, at, j->d);
  if (ok && p.kind == POINT_ORBIT)
    p.orbit = p.admissible ? 0 : usual_orbit(point_orbits(&p, j->cache, FIRST_PREC), p.scene);
  if (ok && p.realistic && at && strstr(at, "u_s"))
    ok = diag_set(
        j->d, "error: --at: of a realistic orbit, of which %s speaks, u_s1 and u_s2 follow from what it needs", c->id);
  if (ok && point_settle(&p, j->cache)) {
    OWNED(text) where = {0};
    point_print_read(&where, &p, &s.tape, &s.given);
    print_friction(&where, &p);
    text_add(&where, certificate_rest(j, &p, &s));
    add_line(out, "at", text_str(&where));
    add_values(out, &s, &p, j->cache);
  } else if (ok) {
    add_line(out, "at", p.admissible ? "these parameters have no admissible orbit" : "these parameters have no orbit");
  }
  if (ok && tape) tape_dump(out, &s.tape);
  return ok;
}

bool audit_explain(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *at, bool tape, struct diag *d) {
  const struct claim *c = claim_answering(claims, id);
  if (!c) return claims_unknown(claims, id, d);
  const struct claims no_controls = {.n = 0};
  LOCAL(audit_result, r);
  struct audit_options opt = {.only = &id, .n_only = 1};
  bool ok = audit_run(&r, m, claims, &no_controls, scene, &opt, d);
  const struct finding *f = ok ? audit_result_finding(&r, id) : NULL;
  if (f) {
    text_printf(out, "%s, the claim: %s\n", f->id, f->title);
    add_line(out, "equation", f->equation);
    add_line(out, "section", f->section);
    add_line(out, "paper", f->quote);
    add_formulas(out, m, c, f);
    add_line(out, "kind", claim_get(c, "kind"));
    add_line(out, "tried at", claim_points_asked(c));
    add_verdict(out, f);
    stable_explain(out, m, f->equation, claim_get(c, "statement"));
    struct judge j = {.out = &r, .model = m, .claims = claims, .scene = scene, .cache = orbit_cache_new(), .d = d};
    ok = explain_point(out, &j, c, claim_view(m, c), at, tape, f->verdict == VERDICT_REFUTED);
    orbit_cache_free(j.cache);
  }
  return ok;
}
