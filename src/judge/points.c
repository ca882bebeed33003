/* Sentences tried at points: matrices against the model's, equations between the paper's own expressions, inequalities;
   of kind sharp are those that must become equalities at one end of their phase, so that one which is true but weaker
   than it could be is refuted.  Every route sees the same points; the decisive one works in balls. */
#include <math.h>
#include <string.h>

#include "certificate.h"
#include "judge.h"
#include "proof/exact_proof.h"
#include "proof/nonzero.h"
#include "proof/propagator_law.h"
#include "value/expression.h"
#include "value/printed.h"

enum { MAX_ROUTES = 8, MAX_SPECS = 4, DRAWS_PER_POINT = 8 };

/* How a route tries a sentence. */
struct route {
  const char *name;
  enum variant variant;
  const struct num_type *type; /* NULL: balls */
  double log_tol;              /* rounded types: log2 of the tolerance of agreement */
  long most;                   /* trials per kind of point; the decisive route takes all */
};
static const struct route routes[] = {{"balls", VARIANT_CLOSED, NULL, 0, 1000000},
                                      {"oracle", VARIANT_CLOSED, NULL, 0, 1000000},
                                      {"exponential", VARIANT_EXPONENTIAL, NULL, 0, 8},
                                      {"newton", VARIANT_CLOSED, NULL, 0, 1000000},
                                      {"ode", VARIANT_CLOSED, NULL, 0, 8},
                                      {"saltation", VARIANT_SALTATION, NULL, 0, 8},
                                      {"system", VARIANT_SYSTEM, NULL, 0, 4},
                                      {"fd", VARIANT_FD, &num_mpfr, -0.5 * FD_PREC, 4},
                                      {"taylor", VARIANT_CLOSED, &num_mpfr, -200, 8},
                                      {"gsl", VARIANT_CLOSED, &num_double, -30, 8}};

/* What a route has seen so far. */
struct tally {
  const struct route *route;
  struct sentence sentence;
  bool own; /* else it is that of the first route */
  long trials, agrees, differs, undecided, rejected;
  long on_orbits; /* trials that agree on periodic solutions; -1: one differs there */
  long bits;
  double worst_log;
  const char *worst, *certificate;
  struct named_value certified[3]; /* entry, left, right at the first failure */
};

/* What an orbit is that proves a failure: any solution, one with t_a > 0, an admissible one; other points are best. */
enum shown { SHOWS_ANY, SHOWS_FORWARD, SHOWS_MOTION };

/* One claim on its points. */
struct point_trials {
  struct judge *j;
  const struct claim *c;
  struct view view;
  struct tally tally[MAX_ROUTES];
  int n_routes;
  struct override override[MAX_ROUTES]; /* of route oracle, by these names */
  char overridden[MAX_ROUTES][16];
  struct point_spec spec[MAX_SPECS];
  int n_specs;
  struct exact_proof proof;
  bool proof_tried;
  const char *useless;  /* why no point says anything; NULL: there is no such reason */
  bool lacks_value;     /* a name that the model knows, at such points */
  struct point example; /* the first point at which the sentence fails, of those that show most; else the first */
  bool have_example;
  enum shown shows; /* by it */
};

/* --- Reading the claim --- */

/* Names that route oracle replaces, as overrides of the model's shapes. */
static bool read_overrides(int *n, struct point_trials *r) {
  const char *list = claim_get(r->c, "oracle");
  *n = 0;
  if (!list) return claim_error(r->j, r->c, "routes", "route oracle needs the attribute oracle");
  while (*n < MAX_ROUTES && (list = claim_next_item(r->overridden[*n], sizeof *r->overridden, list)) != NULL) {
    if (!oracle_override(&r->override[*n], r->overridden[*n]))
      return claim_error(r->j, r->c, "oracle", "the model has no matrix of that name");
    ++*n;
  }
  return true;
}

static bool build_sentence(struct tally *t, struct point_trials *r) {
  const char *value = claim_get(r->c, "value");
  int n_overrides = 0;
  if (strcmp(t->route->name, "oracle") == 0 && !read_overrides(&n_overrides, r)) return false;
  t->own = t == r->tally || n_overrides > 0;
  if (!t->own) t->sentence = r->tally[0].sentence;
  if (t->own && !sentence_from_claim(&t->sentence, r->view, r->c, r->override, n_overrides, r->j->d)) return false;
  if (strcmp(t->route->name, "newton") == 0) {
    char name[32];
    snprintf(name, sizeof name, "%s newton", value ? value : "");
    t->sentence.oracle = oracle_find(name);
    if (!t->sentence.oracle) return claim_error(r->j, r->c, "routes", "route newton is for K, K_1 and K_2");
  }
  return true;
}

static bool read_routes(struct point_trials *r) {
  char item[32];
  const char *list = claim_routes_asked(r->c);
  r->tally[r->n_routes++] = (struct tally){.route = &routes[0]};
  if (r->j->effort == EFFORT_REFUTE) return true;
  while ((list = claim_next_item(item, sizeof item, list)) != NULL) {
    const struct route *found = NULL;
    for (size_t i = 1; i < sizeof routes / sizeof *routes; i++)
      if (strcmp(routes[i].name, item) == 0) found = &routes[i];
    if (found && (!route_is_asked(r->j->scene, item) || !r->j->model->system)) continue;
    if (!found || r->n_routes == MAX_ROUTES)
      return claim_error(r->j, r->c, "routes", "not a route of this kind of claim");
    r->tally[r->n_routes++] = (struct tally){.route = found};
  }
  return true;
}

/* --- Route ode: the paper's matrix against its own differential equation --- */

/* What the law of the propagator leaves of the matrix p, its derivative and its value at 0, as balls. */
static struct trial try_law(const struct num_vec m[3], const struct num_vec *a) {
  struct trial t = {.outcome = OUTCOME_UNDECIDED, .bits = FIRST_PREC, .log_diff = -INFINITY};
  OWNED(num_vec) rest;
  bool apart = false;
  NUMBERS(mag, bound);
  num_vec_init(&rest, PROPAGATOR_LAW, a->ctx);
  propagator_law(&rest, &m[0], &m[1], &m[2], a);
  for (int k = 0; k < PROPAGATOR_LAW; k++) {
    apart = apart || !arb_contains_zero(num_vec_at(&rest, k));
    arb_get_mag(bound, num_vec_at(&rest, k));
    if (!mag_is_zero(bound)) t.log_diff = fmax(t.log_diff, mag_get_d_log2_approx(bound));
  }
  if (apart)
    t.outcome = OUTCOME_DIFFERS;
  else if (t.log_diff < -0.5 * FIRST_PREC)
    t.outcome = OUTCOME_AGREES;
  return t;
}

/* value is NAME(t), one of the phases' matrices; its derivative is NAME'(t). */
static struct trial try_ode(struct point_trials *r, const char *value, const struct point *p) {
  static const char *const taken[3] = {"(t)", "'(t)", "(0)"};
  struct trial t = {.outcome = OUTCOME_REJECTED, .bits = FIRST_PREC, .log_diff = -INFINITY};
  const char *section = claim_get(r->c, "section");
  int phase = name_of_propagator(value), name = (int)strcspn(value, "("), n = 0, s = SS_OK;
  struct num_vec m[3];
  for (int i = 0; i < 3; i++) {
    char text[64];
    num_vec_init(&m[i], 16, num_ctx_arb(FIRST_PREC));
    snprintf(text, sizeof text, "%.*s%s", name, value, taken[i]);
    s |= expression_at((arb_ptr)(void *)m[i].data, &n, r->view, text, section, p, FIRST_PREC, r->j->cache, r->j->d);
  }
  OWNED(values) v;
  s |= values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), r->j->cache);
  struct num_vec a = calc_vec(&v.c, 16);
  if (s == SS_OK && phase >= 0 && n == 16 && dyn_system(&a, (enum phase)phase, &v.params) == SS_OK) t = try_law(m, &a);
  for (int i = 0; i < 3; i++) num_vec_clear(&m[i]);
  return t;
}

/* --- Trying --- */

static struct trial try_balls(struct point_trials *r, struct tally *t, const struct point *p, enum variant variant) {
  bool at_ends = claim_kind(r->c) == KIND_SHARP;
  return (at_ends ? sentence_try_ends : sentence_try_balls)(&t->sentence, p, variant, r->j->cache);
}

static struct trial try_route(struct point_trials *r, struct tally *t, const struct point *p) {
  const struct route *q = t->route;
  if (strcmp(q->name, "ode") == 0) return try_ode(r, claim_get(r->c, "value"), p);
  if (!q->type) return try_balls(r, t, p, q->variant);
  struct num_ctx ctx = q->type == &num_double ? num_ctx_double() : num_ctx_mpfr(FD_PREC);
  return sentence_try_rounded(&t->sentence, p, q->variant, ctx, q->log_tol, r->j->cache);
}

static const char *where_text(struct judge *j, const struct tally *t, const struct point *p) {
  struct text where = {0};
  point_print_read(&where, p, &t->sentence.tape, &t->sentence.given);
  return result_take(j->out, &where);
}

/* "in entry 2 the left side is 1 and the right side 0"; of a matrix, or a number, and the model's likewise. */
static const char *difference_text(struct point_trials *r, const struct tally *t, const struct trial *tr) {
  struct audit_result *out = r->j->out;
  bool matrix = claim_kind(r->c) == KIND_MATRIX;
  const char *what = !matrix             ? "the left side is"
                     : t->sentence.n > 1 ? "the matrix has"
                                         : result_str(out, "%s is", claim_get(r->c, "value"));
  return result_str(out, "%s%s %s %s %s", sentence_place(out, &t->sentence, tr->entry), what, tr->lhs,
                    matrix ? "instead of" : "and the right side", tr->rhs);
}

/* The first failure of a route. */
static void book_failure(struct point_trials *r, struct tally *t, const struct trial *tr, const struct point *p) {
  struct audit_result *out = r->j->out;
  t->certificate = result_str(out, "%s, at %s%s", difference_text(r, t, tr), where_text(r->j, t, p),
                              certificate_rest(r->j, p, &t->sentence));
  t->certified[0] = (struct named_value){"entry", entry_place(out, t->sentence.n, t->sentence.cols, tr->entry)};
  t->certified[1] = (struct named_value){"left", result_copy(out, tr->lhs)};
  t->certified[2] = (struct named_value){"right", result_copy(out, tr->rhs)};
}

/* No reader likes an orbit that is no motion, or even has t_a <= 0, though it proves a failure as well as another. */
static enum shown shown_by(const struct point_trials *r, const struct point *p) {
  if (p->kind != POINT_ORBIT) return SHOWS_MOTION;
  const struct dyn_orbit *o = &point_orbits(p, r->j->cache, FIRST_PREC)->orbit[p->orbit];
  return o->admissible == TRUTH_TRUE ? SHOWS_MOTION : o->holds[COND_TA] == TRUTH_TRUE ? SHOWS_FORWARD : SHOWS_ANY;
}

static bool shows_more(const struct point_trials *r, const struct point *p) {
  return r->shows < SHOWS_MOTION && shown_by(r, p) > r->shows;
}

/* Does an overlay say anything, of which the claims' files know nothing? */
static bool is_overlaid(const struct model *m) {
  bool any = false;
  for (size_t i = 0; i < m->n_records; i++) any = any || m->records[i].rank == RANK_USER;
  return any;
}

/* Books a trial; false when the claim itself cannot be evaluated. */
static bool book(struct point_trials *r, struct tally *t, const struct trial *tr, const struct point *p) {
  struct audit_result *out = r->j->out;
  if (tr->outcome == OUTCOME_UNBOUND && !(r->j->model->system && values_names(tr->unbound))) {
    const char *model = r->j->model->system ? "the model has no quantity of that name, and " : "";
    r->useless = result_str(out, "%s has no value: %sno \"domain:\" says which numbers it may be", tr->unbound, model);
    return true;
  }
  if (tr->outcome == OUTCOME_UNBOUND) {
    r->lacks_value = true;
    r->useless = result_str(out, "%s has no value at such points", tr->unbound);
    return is_overlaid(r->j->model) || claim_error(r->j, r->c, "points", r->useless);
  }
  if (tr->outcome == OUTCOME_REJECTED) {
    t->rejected++;
    return true;
  }
  const char *where = where_text(r->j, t, p);
  t->trials++;
  t->agrees += tr->outcome == OUTCOME_AGREES;
  t->undecided += tr->outcome == OUTCOME_UNDECIDED;
  if (p->kind == POINT_ORBIT && t->on_orbits >= 0)
    t->on_orbits = tr->outcome == OUTCOME_DIFFERS ? -1 : t->on_orbits + (tr->outcome == OUTCOME_AGREES);
  if (tr->bits > t->bits) t->bits = tr->bits;
  if (tr->outcome == OUTCOME_DIFFERS) {
    bool shown = t->differs++ == 0 || shows_more(r, p);
    if (shown && strcmp(t->route->name, "ode") != 0) book_failure(r, t, tr, p);
  }
  if (t->trials == 1 || tr->log_diff > t->worst_log) {
    t->worst_log = tr->log_diff;
    t->worst = where;
  }
  return true;
}

static bool try_point(bool *accepted, struct point_trials *r, const struct point *p, long nth) {
  struct tally *first = &r->tally[0];
  long before = first->trials, failures = first->differs;
  for (int i = 0; i < r->n_routes; i++) {
    struct tally *t = &r->tally[i];
    bool fails = i > 0 && first->differs > failures; /* then a route that found no failure yet is asked here too */
    if (i > 0 && nth >= t->route->most && !(fails && t->differs == 0)) continue;
    struct trial tr = try_route(r, t, p);
    if (r->j->d->set || !book(r, t, &tr, p)) return false;
    if (i == 0 && first->trials == before) break; /* the point is not accepted */
  }
  *accepted = first->trials > before;
  bool fails = first->differs > failures, shown = failures == 0 || shows_more(r, p);
  if (*accepted && (!r->have_example || (fails && shown))) {
    point_copy(&r->example, p);
    r->have_example = true;
    r->shows = shown_by(r, p);
  }
  return true;
}

static bool has_inequality(const struct sentence *s) {
  bool any = false;
  for (slong i = 0; i < s->n; i++) any = any || s->ops[i] != REL_EQ;
  return any;
}

/* Inequalities between numbers: where no symbol stands in them, the enclosures of one point decide all. */
static bool is_of_numbers(const struct sentence *s) {
  bool all = !s->oracle && s->n_given == 0;
  for (slong i = 0; i < s->tape.n_inputs; i++) all = all && strcmp(s->tape.inputs[i], "pi") == 0;
  for (slong i = 0; i < s->n; i++) all = all && s->ops[i] != REL_EQ;
  return all;
}

/* A proof is tried once a point has not refuted the sentence; then a quarter of the points is left to speak for the
   transcription of the model's side.  What has no proof may fail on a part of the domain alone, an equation by the sign
   of what is under a root. */
static long points_wanted(struct point_trials *r, const struct point_spec *spec, long done) {
  bool wants_proof =
      (r->j->effort == EFFORT_FULL || r->j->effort == EFFORT_DIFFERENCE) && route_is_asked(r->j->scene, "exact");
  if (done == 1 && wants_proof && !r->proof_tried && !r->tally[0].differs) {
    r->proof_tried = true;
    r->proof = exact_prove(r->j, r->c, r->view, spec->restriction);
  }
  if (r->proof.proved) return (spec->n + 3) / 4;
  bool more = has_inequality(&r->tally[0].sentence) || !r->tally[0].differs;
  return (r->j->effort == EFFORT_FULL && more ? 8 : 1) * spec->n;
}

/* Nothing that further points could say is asked for. */
static bool enough(const struct point_trials *r) {
  if (r->useless) return true;
  enum effort effort = r->j->effort;
  bool settled = effort != EFFORT_FULL && r->tally[0].differs > 0;
  for (int i = 1; i < r->n_routes && effort == EFFORT_VERDICT; i++) /* the others must not agree everywhere */
    settled = settled && r->tally[i].differs + r->tally[i].undecided > 0;
  return settled;
}

/* What nothing proves or refutes may fail where drawn points never lie: an inequality, and what a paper says of its own
   symbols. */
static bool wants_special(const struct point_trials *r, const struct point_spec *spec) {
  bool asked = r->j->effort == EFFORT_FULL || spec->restriction;
  return asked && (has_inequality(&r->tally[0].sentence) || !r->j->model->system) && !r->proof.proved &&
         !r->tally[0].differs;
}

static bool try_spec(struct point_trials *r, const struct point_spec *spec) {
  struct sampler s;
  LOCAL(point, p);
  char seed[128];
  snprintf(seed, sizeof seed, "%s%s", r->c->id, spec->restriction ? spec->restriction->text : "");
  sampler_init(&s, seed, spec);
  bool ok = true;
  long done = 0, draws = 0, wanted;
  while (ok && done < (wanted = points_wanted(r, spec, done)) && draws++ < DRAWS_PER_POINT * wanted && !enough(r)) {
    bool accepted = false;
    sampler_next(&p, &s);
    if (point_settle(&p, r->j->cache)) ok = try_point(&accepted, r, &p, done);
    done += accepted;
  }
  bool meant = false;
  for (int k = 0; ok && !enough(r) && wants_special(r, spec) && sampler_special(&p, &meant, &s, k); k++) {
    bool accepted = false;
    if (meant && point_settle(&p, r->j->cache)) ok = try_point(&accepted, r, &p, done);
  }
  return ok;
}

/* --- Summing up --- */

static const char *layer_of(const struct point_trials *r) {
  return r->view.layer == LAYER_CORRECTED && r->view.own ? "own text printed, the rest corrected"
                                                         : layer_name[r->view.layer];
}

static void add_evidence(struct finding *f, struct point_trials *r, const struct tally *t, struct route_result w) {
  struct audit_result *out = r->j->out;
  bool is_double = t->route->type == &num_double;
  finding_add_route(f, out, w, layer_of(r), is_double ? 53 : t->bits, is_double ? NULL : t->worst, NULL);
  struct evidence *e = &f->evidence[f->n_evidence - 1];
  if (is_double && t->trials) e->machine_residual = exp2(t->worst_log);
  if (t->trials && !(t->differs && isinf(t->worst_log))) /* of inequalities alone: they have none */
    e->residual = is_double ? (t->differs ? "above 1e-5" : "below 1e-9") : order_of_magnitude(out, t->worst_log);
  struct text note = {0};
  const bool system = r->j->model->system;
  if (t->trials == 0 && t->rejected)
    text_printf(&note, "none of %ld points could be used%s", t->rejected,
                system ? "" : ": a side has no value, or a range is left");
  else if (t->trials == 0)
    text_add(&note, "no point could be used");
  if (t->differs && t->certificate && !is_double)
    text_printf(&note, "%s at %ld of %ld points; %s",
                has_inequality(&r->tally[0].sentence) ? "it fails" : "the sides differ", t->differs, t->trials,
                t->certificate);
  if (t->trials && t->rejected)
    text_printf(&note, "%s%ld further point%s %s", note.len ? "; " : "", t->rejected, plural_s(t->rejected),
                system ? "could not be used" : "of the domains left out, where a side has no value or a range is left");
  if (note.len) e->note = result_take(out, &note);
}

/* Of what has no value at any point: the first quantity given by a polynomial that has no positive root. */
static void state_rootless(struct finding *f, struct point_trials *r) {
  const struct elaboration *el = &r->tally[0].sentence.el;
  struct sampler sampler;
  LOCAL(point, p);
  sampler_init(&sampler, r->c->id, &r->spec[0]);
  sampler_next(&p, &sampler);
  for (size_t i = 0; i < el->n_roots && point_settle(&p, r->j->cache); i++) {
    OWNED(tape) t;
    OWNED(num_vec) root;
    bool known;
    const char *name = el->roots[i].name;
    OWNED(text) where = {0};
    name = result_str(r->j->out, "%.*s", (int)strcspn(name, "@"), name);
    num_vec_init(&root, 1, num_ctx_arb(FIRST_PREC));
    if (!formula_tape(&t, r->view, name, claim_section(r->c), NULL, 0) ||
        tape_at_point(&root, &known, &t, &p, r->j->cache) != SS_DOMAIN)
      continue;
    point_print_read(&where, &p, &t, &t);
    finding_state(f, r->j->out, "balls", layer_of(r), -1, 0, NULL,
                  result_str(r->j->out, "the polynomial of which %s is a root has no positive root at %s", name,
                             text_str(&where)));
    return;
  }
}

/* Of what has no value at any point: the first that it divides by, of those that are zero on every motion. */
static void state_zero(struct finding *f, struct point_trials *r) {
  struct audit_result *out = r->j->out;
  struct divisor divisor[MOST_DIVISORS];
  const char *id = claim_get(r->c, "statement");
  const struct statement_record *record = view_record(&r->view, id ? id : r->c->id);
  int n = 0;
  if (!record || !r->j->model->system || !divisors_of(divisor, &n, &out->arena, record, r->view)) return;
  int i = 0;
  while (i < n && !zero_everywhere(&divisor[i], r->view)) i++;
  if (i < n)
    finding_state(f, out, "exact", layer_of(r), -1, 0, NULL,
                  result_str(out, "%s, by which it divides, is zero everywhere", divisor[i].formula));
}

/* That the model's matrices make true what the paper's formulas for them do not. */
static const char *holds_with_model(struct point_trials *r) {
  struct text t = {0};
  int n = 0;
  while (n < MAX_ROUTES && *r->overridden[n]) n++;
  text_add(&t, "it holds with the model's ");
  for (int i = 0; i < n; i++) text_printf(&t, "%s%s", list_joint(i, n, " and "), r->overridden[i]);
  text_printf(&t, ", and not with what the paper's formulas give for %s", n > 1 ? "them" : "it");
  return result_take(r->j->out, &t);
}

static void conclude(struct finding *f, struct point_trials *r) {
  struct route_result w[MAX_ROUTES + 1];
  int n = 0;
  bool settled = r->proof.proved || r->proof.level;
  const char *fixed = r->tally[0].differs ? r->tally[0].sentence.fixes : NULL;
  if (fixed && !r->useless)
    r->useless = result_str(r->j->out,
                            "it is false for some values of its symbols: either it says what %s is (then write it as "
                            "\"define\", or put the value in) or %s is misprinted",
                            fixed, fixed);
  if (r->useless) {
    f->verdict = VERDICT_UNKNOWN;
    finding_state(f, r->j->out, "none", layer_of(r), -1, 0, NULL, r->useless);
    return;
  }
  for (int i = 0; i < r->n_routes; i++) {
    const struct tally *t = &r->tally[i];
    struct route_result said = counted_route(t->route->name, i == 0, t->agrees, t->differs, t->undecided);
    add_evidence(f, r, t, said);
    if (!settled || said.outcome != ROUTE_UNDECIDED) w[n++] = said; /* what enclosures leave open a proof does not */
  }
  if (settled) w[n++] = (struct route_result){"exact", r->proof.proved ? ROUTE_AGREES : ROUTE_DIFFERS, true, 1};
  if (r->tally[0].trials == 0 && r->j->effort == EFFORT_FULL) state_zero(f, r);
  if (r->tally[0].trials == 0 && r->j->effort == EFFORT_FULL) state_rootless(f, r);
  bool of_numbers = is_of_numbers(&r->tally[0].sentence);
  if (!of_numbers) finding_add_proof(f, r->j->out, &r->proof, layer_of(r), r->tally[0].differs > 0);
  f->verdict = verdict_of(w, n, r->proof.proved || of_numbers);
  for (int i = 1; i < r->n_routes && f->verdict == VERDICT_UNKNOWN && r->tally[0].differs; i++)
    if (strcmp(r->tally[i].route->name, "oracle") == 0 && r->tally[i].agrees && !r->tally[i].differs)
      finding_state(f, r->j->out, "none", layer_of(r), -1, 0, NULL, holds_with_model(r));
  if (r->proof.differs && verdict_passes(f->verdict))
    verdict_leave_open(f, r->j->out, "enclosures do not show the difference that exact algebra finds");
}

static bool run_init(struct point_trials *r, struct judge *j, const struct claim *c, struct view view,
                     const struct restriction *restriction, bool at_orbits) {
  *r = (struct point_trials){.j = j, .c = c, .view = view};
  point_init(&r->example);
  r->n_specs = claim_points(r->spec, MAX_SPECS, j, c);
  if (at_orbits && r->n_specs > 0) {
    r->spec[0].kind = POINT_ORBIT;
    r->n_specs = 1;
  }
  for (int i = 0; i < r->n_specs; i++) {
    r->spec[i].restriction = restriction;
    bool has_ends = r->spec[i].kind == POINT_ORBIT || r->spec[i].kind == POINT_ARC;
    if (claim_kind(c) == KIND_SHARP && !has_ends)
      return claim_error(j, c, "points", "the time lies in a phase of arcs or orbits");
  }
  if (r->n_specs < 0 || !read_routes(r)) return false;
  for (int i = 0; i < r->n_routes; i++)
    if (strcmp(r->tally[i].route->name, "ode") != 0 && !build_sentence(&r->tally[i], r)) return false;
  return true;
}

static void run_clear(struct point_trials *r) {
  for (int i = 0; i < r->n_routes; i++)
    if (r->tally[i].own) sentence_clear(&r->tally[i].sentence);
  point_clear(&r->example);
}

static bool try_all(struct point_trials *r, struct judge *j, const struct claim *c, struct view view,
                    const struct restriction *restriction, bool at_orbits) {
  bool ok = run_init(r, j, c, view, restriction, at_orbits);
  for (int i = 0; ok && i < r->n_specs; i++) ok = try_spec(r, &r->spec[i]);
  return ok;
}

/* What has no value at the claim's own points, since an overlay says something else there, may have one on orbits. */
static bool run_all(struct finding *f, struct point_trials *r, struct judge *j, const struct claim *c, struct view view,
                    const struct restriction *restriction) {
  bool ok = try_all(r, j, c, view, restriction, false);
  if (ok && r->lacks_value) {
    run_clear(r);
    ok = try_all(r, j, c, view, restriction, true);
  }
  if (ok) conclude(f, r);
  return ok;
}

/* --- What a refutation means --- */

bool scene_point(struct point *out, const struct point *p, const struct scene *s, struct orbit_cache *cache) {
  point_copy(out, p);
  out->scene = s;
  if (p->kind == POINT_ARC) out->kind = POINT_ORBIT;
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (s->given[k]) fmpq_set(&out->q[Q_CHI + k], &s->value[k]);
  out->orbit = out->kind == POINT_ORBIT && !out->admissible ? usual_orbit(scene_orbits(s, cache), s) : 0;
  return point_settle(out, cache);
}

static void certify(struct finding *f, struct point_trials *r) {
  certify_point(&f->certificate, r->j, &r->example, &r->tally[0].sentence);
  bool several = false; /* phases, of which the claim does not say which it was */
  for (int i = 1; i < r->n_specs; i++) several = several || r->spec[i].phase != r->spec[0].phase;
  if (several) certificate_add(&f->certificate, r->j->out, "phase", phase_name[r->example.phase]);
  for (int i = 0; i < 3; i++) {
    const struct named_value *v = &r->tally[0].certified[i];
    if (v->value && *v->value) certificate_add(&f->certificate, r->j->out, v->name, v->value);
  }
}

/* Whether both sides have the same values at the scene's data with another perturbation and other friction, of one
   draw; where the claim's first points are of another kind it is not said. */
static bool scene_decides(const struct trial *tr, struct point_trials *r) {
  struct sampler sampler;
  LOCAL(point, drawn, p);
  sampler_init(&sampler, "effect", &r->spec[0]);
  sampler_next(&drawn, &sampler);
  bool same = scene_point(&p, &drawn, r->j->scene, r->j->cache);
  if (same) {
    struct trial other = try_balls(r, &r->tally[0], &p, VARIANT_CLOSED);
    same = other.outcome == tr->outcome && strcmp(other.lhs, tr->lhs) == 0 && strcmp(other.rhs, tr->rhs) == 0;
  }
  return same;
}

static void describe_effect(struct finding *f, struct point_trials *r) {
  LOCAL(point, p);
  struct tally *first = &r->tally[0];
  bool have = r->j->model->system && scene_point(&p, &r->example, r->j->scene, r->j->cache);
  if (have) {
    struct trial tr = try_balls(r, first, &p, VARIANT_CLOSED);
    const char *of = scene_data_of(r->j->scene);
    bool usual = p.kind == POINT_ORBIT && !p.admissible;
    bool inequality = has_inequality(&first->sentence);
    if (tr.outcome == OUTCOME_AGREES && (!inequality || (first->sentence.n == 1 && scene_decides(&tr, r))))
      f->effect =
          result_str(r->j->out, "For the data of %s %s.", of, inequality ? "it holds" : "the two sides are equal");
    if (tr.outcome == OUTCOME_DIFFERS && scene_decides(&tr, r))
      f->effect = result_str(r->j->out, "For the data of %s, %s%s%s%s.", of, usual ? "on " : "",
                             usual ? usual_orbit_text(r->j, "periodic solution") : "", usual ? ", " : "",
                             difference_text(r, first, &tr));
  }
}

/* Controls whose routes are "exact" are left to the algebra: a difference with a rational point refutes. */
static bool judge_by_algebra(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct point_trials r = {.j = j, .c = c, .view = view, .proof = exact_prove(j, c, view, NULL)};
  struct route_result w = {"exact",
                           r.proof.proved    ? ROUTE_AGREES
                           : r.proof.differs ? ROUTE_DIFFERS
                                             : ROUTE_UNDECIDED,
                           true, 1};
  finding_add_proof(f, j->out, &r.proof, layer_of(&r), false);
  f->verdict = verdict_of(&w, 1, true);
  return true;
}

/* What is said of several phases is tried at the points of none: it is judged as what follows from nothing on
   admissible solutions, on which each of these phases takes time. */
static bool judge_phases(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  OWNED(claims) made = {.n = 0};
  const char *text = result_str(j->out, "claim %s\n  section: %s\n  kind: argument\n  conclusion: %s\n", c->id,
                                claim_section(c), claim_get(c, "statement"));
  return claims_add_text(&made, "phases", text, "claim", j->d) && judge_argument(f, j, &made.claim[0], view);
}

bool judge_points(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  if (claim_kind(c) == KIND_IDENTITY && claim_spans_phases(j, c)) return judge_phases(f, j, c, view);
  const char *routes_asked = claim_routes_asked(c);
  bool algebra = routes_asked && strcmp(routes_asked, "exact") == 0;
  if (algebra || !route_is_asked(j->scene, "balls")) {
    if (route_is_asked(j->scene, "exact")) return judge_by_algebra(f, j, c, view);
    f->verdict = VERDICT_UNKNOWN; /* nothing that decides is asked for */
    return true;
  }
  enum { SEVERAL = 3 };
  OWNED_CLEARED(run_clear) struct point_trials r;
  bool ok = run_all(f, &r, j, c, view, NULL);
  bool explained = view.own && j->effort == EFFORT_FULL;
  if (ok && f->verdict == VERDICT_REFUTED && explained && r.tally[0].on_orbits >= SEVERAL &&
      !has_inequality(&r.tally[0].sentence))
    verdict_leave_open(f, j->out,
                       "the sides differ on passes that do not close; on the periodic solutions that were tried they "
                       "agree, which is not proved");
  if (ok && f->verdict == VERDICT_REFUTED && explained) {
    describe_effect(f, &r);
    certify(f, &r);
    if (strcmp(view.own, claim_own(c)) == 0 && route_is_asked(j->scene, "exact") && !r.proof.level) {
      r.proof = exact_prove(j, c, view, NULL);
      finding_add_proof(f, j->out, &r.proof, layer_of(&r), true);
    }
  }
  return ok;
}

/* The item "V = 1: supported: eq-10b" of the attribute restricted: the verdict on record and the id of the claim that
   the restriction makes.  Without one, nothing is on record and the id is the claim's with the restriction's text. */
static enum verdict recorded_restriction(const char **id, struct judge *j, const struct claim *c, const char *text) {
  struct made_claim made;
  for (const char *p = claim_get(c, "restricted"); (p = claim_next_made(&made, p)) != NULL;) {
    if (strcmp(made.condition, text) != 0) continue;
    *id = result_copy(j->out, made.id);
    return verdict_parse(made.record);
  }
  struct text t = {0};
  text_printf(&t, "%s-if-", c->id);
  for (; *text; text++)
    if (*text != ' ' && *text != '=') text_add_char(&t, *text);
  *id = result_take(j->out, &t);
  return N_VERDICTS;
}

bool judge_restrictions(struct judge *j, const struct claim *c, struct view view, const struct finding *refuted) {
  bool at_points = j->model->system && !claim_spans_phases(j, c);
  for (int i = 0; at_points && i < n_restrictions; i++) {
    OWNED_CLEARED(run_clear) struct point_trials r;
    struct finding f = finding_again(refuted);
    f.correction = f.effect = f.fault = NULL;
    f.certificate = (struct certificate){.n = 0};
    f.recorded = recorded_restriction(&f.id, j, c, restrictions[i].text);
    struct judge as_wanted = *j; /* unless it is on record, only support counts */
    if (f.recorded == N_VERDICTS) as_wanted.effort = EFFORT_DIFFERENCE;
    bool ok = run_all(&f, &r, &as_wanted, c, view, &restrictions[i]);
    if (ok && f.verdict == VERDICT_REFUTED) certify(&f, &r);
    if (!ok) return false;
    if (f.verdict != VERDICT_SUPPORTED && f.verdict != VERDICT_PROVED && f.recorded == N_VERDICTS) continue;
    f.title = result_str(j->out, "%s, when %s", refuted->title, restrictions[i].text);
    f.condition = restrictions[i].text;
    const char **dep = arena_alloc(&j->out->arena, sizeof *dep);
    dep[0] = refuted->id;
    f.depends_on = dep;
    f.n_depends_on = 1;
    audit_finding(j->out, &f);
  }
  return true;
}
