/* Arguments: does the conclusion follow from the premises?

   First an exact proof is looked for (proof/combination.h).  Then a counterexample: an orbit on which the premises hold
   and the conclusion fails, searched for in double over the pool of orbits and from the most promising of them by
   coordinate steps, with u_r1 and u_r2 as close to what the premises still allow as the grid of the search permits; it
   counts only when enclosures along the whole of each phase prove the premises and refute the conclusion at exact
   parameters. */

#include "argument.h"
#include "proof/combination.h"
#include "proof/exact_argument.h"
#include "value/title.h"

/* --- Evidence --- */

const char *argument_unbound(const struct argument *a) {
  const char *name = NULL;
  for (int part = 0; part < N_PARTS; part++)
    for (int k = 0; k < a->part[part].n && !name; k++) name = a->part[part].at[k].unbound;
  return name ? result_str(
                    a->j->out,
                    "%s has no value here: a periodic solution gives values to the parameters, to z_i, x_i, z_i' and "
                    "x_i' at the times t, 0, t_a, t_a + t_b, ..., to their next two derivatives at t, and to what "
                    "formulas make of them",
                    name)
              : NULL;
}

static const char *place_in_phase(struct argument *a, double where) {
  if (where <= 0 || where >= 1) return where <= 0 ? "at its very beginning" : "at its very end";
  if (where == 0.5) return "at its middle";
  return result_str(a->j->out, "after the fraction %.10g of it", where);
}

const char *argument_moment(struct argument *a, const struct condition *c, const char *between, double where) {
  if (!c->moving) return "";
  return result_str(a->j->out, " in the %s phase%s%s", phase_words[c->phase], between, place_in_phase(a, where));
}

void argument_add_routes(struct route_result w[2], struct finding *f, struct argument *a,
                         const struct answers decided[2], const char *where, const char *note) {
  w[0] =
      finding_add_route(f, a->j->out, answers_route("balls", true, &decided[0]), "corrected", FIRST_PREC, where, note);
  w[1] = finding_add_route(f, a->j->out, answers_route("exponential", false, &decided[1]), "corrected", FIRST_PREC,
                           NULL, NULL);
}

static struct combination as_combination(struct argument *a, struct view view) {
  return (struct combination){a->j, a->c, &a->part[PREMISES], &a->part[CONCLUSION], a->admissible, !a->free_friction,
                              view};
}

static bool add_proof(struct route_result *w, struct finding *f, struct argument *a, struct view view) {
  OWNED(text) t = {0};
  struct combination q = as_combination(a, view);
  bool proved = certificate_find(&t, NULL, &q);
  if (proved) {
    *w = (struct route_result){"algebra", ROUTE_AGREES, true, a->part[CONCLUSION].n};
    finding_add_route(f, a->j->out, *w, "corrected", -1, NULL, result_take(a->j->out, &t));
  }
  return proved;
}

/* Does the condition hold on every motion that the argument speaks of, so that nobody need name it? */
static bool holds_anyway(const struct argument *a, const struct condition *c) {
  const struct conditions none = {.n = 0};
  return (c->equality || (c->moving && a->admissible)) && exact_argument(c, &none);
}

/* Is a premise an equation that may hold at some moments of its phase alone?  The search asks it of all. */
static bool at_moments(const struct argument *a) {
  bool some = false;
  for (int k = 0; k < a->part[PREMISES].n; k++) {
    const struct condition *c = &a->part[PREMISES].at[k];
    some = some || (c->equality && c->moving && !holds_anyway(a, c));
  }
  return some;
}

/* Proof and search in one direction; proof_alone: what is proved is not tried besides. */
static enum verdict judge_direction(struct finding *f, struct argument *a, struct view view, bool proof_alone) {
  struct route_result w[3];
  struct argument_tally t = {.certificate = NULL};
  int n = 0;
  bool proved = add_proof(&w[0], f, a, view);
  n += proved;
  if (a->j->d->set || (proved && proof_alone)) return verdict_of(w, n, true);
  argument_search(&t, a, proved);
  const char *unbound = argument_unbound(a);
  bool premises = a->part[PREMISES].n > 0;
  const char *note =
      t.certificate ? t.certificate
      : unbound     ? unbound
      : a->tried == 0
          ? result_str(a->j->out, "no periodic solution was found on which %s%s",
                       premises ? "the premises hold" : "both sides have values",
                       at_moments(a) ? " throughout their phases" : "")
          : result_str(a->j->out,
                       "there is no counterexample among %ld periodic solutions%s; the nearest to failing were %s",
                       a->tried, premises ? " on which the premises hold" : "",
                       t.decided[0].of[TRUTH_UNKNOWN] ? "not all decided"
                       : answers_given(&t.decided[0]) ? "decided rigorously"
                                                      : "not decided, since the premises are not");
  argument_add_routes(w + n, f, a, t.decided, t.nearest, note);
  if (t.certificate) f->certificate = t.certified;
  if (!proved || (a->tried == 0 && !at_moments(a)))
    return verdict_of(w, n + 2, proved); /* what never applies is not proved */
  for (int k = 0; k < 2; k++) {          /* what balls leave open a proof does not */
    t.decided[k].of[TRUTH_UNKNOWN] = 0;
    if (answers_given(&t.decided[k])) w[n++] = answers_route(k ? "exponential" : "balls", !k, &t.decided[k]);
  }
  return verdict_of(w, n, proved);
}

/* The argument turned round: what is an equation among the premises stays one. */
static struct argument converse_of(const struct argument *a) {
  struct argument b = *a;
  const struct conditions *p = &a->part[PREMISES], *q = &a->part[CONCLUSION];
  b.tried = 0;
  b.part[CONCLUSION].n = 0;
  b.part[PREMISES] = *q;
  for (int k = 0; k < p->n; k++) {
    struct conditions *to = &b.part[p->at[k].equality ? PREMISES : CONCLUSION];
    if (to->n < MAX_CONDITIONS) to->at[to->n++] = p->at[k];
  }
  return b;
}

/* A conclusion with > may fail where a premise with >= is an equality; points lie beside that, proofs do without. */
static void leave_open_at_equality(struct finding *f, const struct argument *a) {
  if (f->verdict == VERDICT_SUPPORTED && conditions_admit_equality(&a->part[PREMISES]) &&
      conditions_any_strict(&a->part[CONCLUSION]))
    verdict_leave_open(f, a->j->out, "not decided where a premise holds with equality, as <= and >= admit");
}

/* Both directions, when the claim says so, are worth what the weaker one is. */
static void judge_everywhere(struct finding *f, struct argument *a, struct view view) {
  static const int weakness[N_VERDICTS] = {[VERDICT_SUPPORTED] = 1, [VERDICT_UNKNOWN] = 2, [VERDICT_REFUTED] = 3};
  bool little = a->j->effort == EFFORT_REFUTE;
  f->verdict = judge_direction(f, a, view, little);
  leave_open_at_equality(f, a);
  if (!a->converse || a->j->d->set) return;
  enum verdict forwards = f->verdict;
  struct argument b = converse_of(a); /* its conditions are borrowed */
  f->verdict = judge_direction(f, &b, view, true);
  leave_open_at_equality(f, &b);
  if (weakness[forwards] >= weakness[f->verdict]) f->verdict = forwards;
}

/* What a friction force must exceed on an orbit: e, or the least that the inequalities allow. */
static const char *friction_needed(struct judge *j, int i, const struct dyn_orbit *o) {
  arb_srcptr e = i ? o->e2 : o->e1, least = i ? o->u_r2_min : o->u_r1_min;
  if (!arb_ge(e, least)) return result_str(j->out, "u_r%d > %s", i + 1, ball_text(j, least, 6));
  return result_str(j->out, "u_r%d > e_%d", i + 1, i + 1);
}

/* What the friction forces must exceed on the scene's orbit, whatever the argument says. */
static void describe_effect(struct finding *f, struct argument *a) {
  const struct dyn_orbit *o = scene_orbit(a->j->scene, a->j->cache);
  const char *on = o ? usual_orbit_text(a->j, "periodic solution") : NULL;
  if (o && o->admissible == TRUTH_FALSE)
    f->effect = result_str(a->j->out, "On %s not all inequalities hold, whatever u_r1 and u_r2 are.", on);
  else if (o)
    f->effect = result_str(a->j->out, "On %s all inequalities together hold if and only if %s and %s, rounded.", on,
                           friction_needed(a->j, 0, o), friction_needed(a->j, 1, o));
}

/* Whether the conclusion of an argument over all orbits holds on those of the scene. */
static void describe_scene(struct finding *f, struct argument *a) {
  const struct dyn_orbits *list = scene_orbits(a->j->scene, a->j->cache);
  LOCAL(point, p);
  struct text t = {0};
  for (slong i = 0; i < list->n && nearest_orbit_point(&p, a->j->scene, a->j->cache); i++) {
    struct argument_decision d = {.where = 0};
    arb_init(d.value);
    p.orbit = i;
    argument_decide(&d, NULL, a, &p, NULL);
    text_printf(&t, "%son periodic solution %ld of %s: %s", i ? "; " : "", (long)i + 1, scene_data_of(a->j->scene),
                d.conclusion == TRUTH_TRUE    ? "holds"
                : d.conclusion == TRUTH_FALSE ? result_str(a->j->out, "%s fails", a->part[CONCLUSION].at[d.failed].text)
                                              : "undecided");
    arb_clear(d.value);
  }
  if (t.len) f->effect = result_take(a->j->out, &t);
}

/* --- The kind --- */

static bool argument_read(struct argument *a, struct judge *j, const struct claim *c, struct view view) {
  *a = (struct argument){.j = j, .c = c};
  a->admissible = claim_over_admissible(c);
  if (!a->admissible && !claim_says(c, "over", "orbits") && !claim_says(c, "over", "scene"))
    return claim_error(j, c, "over", "one of admissible, orbits, scene");
  if (!judge_switch(&a->converse, j, c, "converse", "yes")) return false;
  if (!judge_switch(&a->free_friction, j, c, "friction", "free")) return false;
  if (!conditions_read(&a->part[PREMISES], j, c, "premises", view)) return false;
  if (!conditions_read(&a->part[CONCLUSION], j, c, "conclusion", view)) return false;
  if (a->part[CONCLUSION].n == 0) return claim_error(j, c, "kind", "the attribute conclusion is missing");
  for (int part = 0; part < N_PARTS; part++)
    a->uses_friction = a->uses_friction || conditions_use_friction(&a->part[part]);
  return true;
}

/* The argument with the premises of the attribute repair added, which are its condition where they save it. */
static bool judge_repair(struct finding *f, struct argument *a, struct view view) {
  const char *repair = claim_get(a->c, "repair");
  if (!repair) return true;
  struct conditions more = {.n = 0};
  bool ok = conditions_read(&more, a->j, a->c, "repair", view);
  if (ok && a->part[PREMISES].n + more.n > MAX_CONDITIONS)
    ok = claim_error(a->j, a->c, "repair", "too many conditions");
  for (int k = 0; ok && k < more.n; k++) a->part[PREMISES].at[a->part[PREMISES].n++] = more.at[k];
  struct finding again = finding_again(f);
  a->tried = 0;
  if (ok) judge_everywhere(&again, a, view);
  OWNED(text) t = {0};
  for (int k = 0; ok && k < more.n; k++) {
    const struct condition *c = &more.at[k];
    if (holds_anyway(a, c)) continue;
    text_add(&t, t.len ? "; " : "");
    if (c->equation) text_printf(&t, "(%s) ", c->equation);
    text_add(&t, c->text);
    if (c->moving) text_printf(&t, " in the %s phase", phase_words[c->phase]);
  }
  if (ok) {
    f->verdict = verdict_under_condition(f->verdict, again.verdict);
    f->condition = f->verdict == VERDICT_CONDITIONAL ? result_copy(a->j->out, text_str(&t)) : NULL;
    f->correction = result_str(a->j->out, "with the further premise %s", text_str(&t));
    f->correction_verdict = again.verdict;
  }
  if (ok) finding_take_evidence(f, a->j->out, &again);
  if (!ok) conditions_clear(&more); /* else they belong to the premises */
  return ok;
}

bool argument_receipt(struct text *out, struct judge *j, const struct claim *c) {
  struct argument a;
  struct view view = claim_view(j->model, c);
  bool ok = argument_read(&a, j, c, view), proved = ok && !claim_says(c, "over", "scene");
  struct argument b = converse_of(&a); /* its conditions are borrowed */
  OWNED(text) words = {0};
  for (int back = 0; proved && back < (a.converse ? 2 : 1); back++) {
    struct combination q = as_combination(back ? &b : &a, view);
    proved = certificate_find(&words, out, &q);
  }
  if (ok && !proved && !j->d->set)
    diag_set(j->d, "error: %.200s is not proved by a positive combination of its premises", c->id);
  for (int part = 0; part < N_PARTS; part++) conditions_clear(&a.part[part]);
  return proved;
}

bool judge_argument(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct argument a;
  bool ok = argument_read(&a, j, c, view);
  if (ok && claim_says(c, "over", "scene")) {
    argument_at_scene(f, &a);
    leave_open_at_equality(f, &a);
  } else if (ok) {
    judge_everywhere(f, &a, view);
  }
  ok = ok && !j->d->set;
  if (ok && f->verdict == VERDICT_REFUTED && !view.control && j->effort == EFFORT_FULL) {
    if (a.uses_friction)
      describe_effect(f, &a);
    else
      describe_scene(f, &a);
  }
  if (ok && (f->verdict == VERDICT_REFUTED || j->effort == EFFORT_REFUTE) && !view.control)
    ok = judge_repair(f, &a, view);
  for (int part = 0; part < N_PARTS; part++) conditions_clear(&a.part[part]);
  return ok;
}
