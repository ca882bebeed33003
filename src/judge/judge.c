/* One claim: it is judged with its own text as printed and everything it uses corrected; a refuted one is
   judged again as corrected and under restrictions; every control beside it must be noticed.  run.c says which are. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "claim/near.h"
#include "judge.h"
#include "proof/exact_proof.h"
#include "record/routes.h"
#include "value/oracle.h"
#include "value/title.h"
#include "value/values.h"

#define JUDGE(name, word, fn, ...) fn,
static const kind_fn judges[N_KINDS] = {CLAIM_KINDS(JUDGE)};
#undef JUDGE

/* --- What a claim is about --- */

/* Are all its points values of parameters, which the paper's own symbols are? */
static bool at_own_symbols(struct judge *j, const struct claim *c) {
  enum { MOST = 8 };
  struct point_spec spec[MOST];
  int n = claim_points_asked(c) ? claim_points(spec, MOST, j, c) : 0;
  bool own = n > 0;
  for (int i = 0; i < n; i++) own = own && spec[i].kind == POINT_PARAMS;
  return own;
}

/* Is the claim's formula said for either sign of a symbol? */
static bool for_either_sign(struct judge *j, const struct claim *c) {
  const char *id = claim_get(c, "statement");
  const struct view v = {j->model, LAYER_PRINTED, NULL, NULL};
  const struct statement_record *r = id ? view_record(&v, id) : NULL;
  bool any = false;
  for (int k = 0; r && k < r->n_stmts; k++) any = any || r->stmts[k]->range_signs;
  return any;
}

/* Why the program can compute nothing of what the claim is about; NULL where it can. */
static const char *beyond(struct judge *j, const struct claim *c) {
  const char *value = claim_kind(c) == KIND_MATRIX ? claim_get(c, "value") : NULL;
  if (!j->model->system && claim_kind_of(c)->of_model)
    return "claims of this kind are decided for the program's own system alone, and no file of the paper says \"model: "
           "two masses on a belt\"";
  bool at_points = claim_judged_at_points(j->model, c);
  if (!j->model->system && at_points && !at_own_symbols(j, c) && !j->d->set)
    return "its points are motions of two masses on a belt, and no file of the paper says that it is about them; "
           "\"points: params N\" are values of the paper's own symbols";
  if (!j->model->system && at_points && for_either_sign(j, c))
    return "it is said for either sign of a symbol, at which its formula is not tried";
  if (!value || oracle_find(value)) return NULL;
  return result_str(j->out, "the model has no quantity named %s", value);
}

/* What the model gives a value has no domain of the file's; an error. */
static bool names_stay_the_models(struct judge *j) {
  for (size_t i = 0; j->model->system && i < j->model->n_symbols; i++) {
    const struct symbol *s = &j->model->symbols[i];
    if (!s->has_domain || !values_names(s->name)) continue;
    diag_at(j->d, s->src, s->record->id.begin, "%s is the model's, which gives it its domain; leave the line out",
            s->name);
    j->claim_at_fault = true;
    return false;
  }
  return true;
}

/* A claim about what the program does not know is unknown, once it can be read. */
bool judge_subject(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *why = beyond(j, c);
  if (j->d->set || !names_stay_the_models(j)) return false;
  if (!why) return judges[claim_kind(c)](f, j, c, view);
  if (claim_tried_at_points(c) && !sentence_reads(view, c, j->d)) return false;
  f->verdict = VERDICT_UNKNOWN;
  finding_state(f, j->out, "none", layer_name[view.layer], -1, 0, NULL, why);
  return true;
}

/* --- Corrections --- */

/* Judges the sentence again with everything corrected and fills f->correction: of what holds as printed only a
   correction that does not. */
static bool judge_correction(struct finding *f, struct judge *j, const struct claim *c) {
  OWNED(text) t = {0};
  bool ok = true;
  if (erratum_text(&t, j->model, c)) {
    struct finding again = finding_again(f);
    ok = judge_subject(&again, j, c, (struct view){j->model, LAYER_CORRECTED, NULL, NULL});
    if (ok && (f->verdict == VERDICT_REFUTED || again.verdict == VERDICT_REFUTED)) {
      f->correction = result_copy(j->out, text_str(&t));
      f->correction_verdict = again.verdict;
      erratum_typeset(f, j, c);
      finding_take_evidence(f, j->out, &again);
    }
  }
  return ok;
}

/* --- One claim --- */

/* The paper's own text, and beside it the formula as it was parsed, so that the transcription can be checked by eye.
   Of what an overlay replaces its formula alone. */
static void quote_and_formula(struct finding *f, struct judge *j, const struct claim *c) {
  const char *quote = claim_get(c, "quote");
  OWNED(text) tex = {0};
  struct text parsed = {0};
  struct model unnoted = *j->model;
  unnoted.use = NULL;
  struct view v = {&unnoted, LAYER_PRINTED, NULL, NULL};
  for (size_t i = 0; i < j->model->n_records; i++) {
    const struct statement_record *r = &j->model->records[i];
    if (!claim_is_about(r, c) || view_record(&v, r->id) != r) continue;
    bool replaced = false;
    for (int k = 0; k < r->n_stmts; k++) {
      const struct definition seen = view_stated(&v, r, r->stmts[k]);
      bool elsewhere = seen.stmt != r->stmts[k];
      replaced = replaced || elsewhere;
      if (elsewhere && claim_is_about(model_statements(&unnoted, seen.record), c))
        continue; /* comes with that record */
      text_add(&parsed, parsed.len ? ", \\quad " : "");
      stmt_latex(&parsed, seen.stmt);
    }
    if (replaced || !*r->tex) continue;
    if (tex.len) text_add_char(&tex, ' ');
    record_quote(&tex, r, " ... ");
  }
  if (quote)
    f->quote = result_copy(j->out, quote);
  else if (tex.len)
    f->quote = result_copy(j->out, text_str(&tex));
  if (parsed.len) f->printed = result_take(j->out, &parsed);
}

enum verdict claim_recorded(const struct judge *j, const struct claim *c) {
  const char *record = claim_get(c, "record");
  bool of_example = j->model->system && claim_of_scene(c);
  return record && (!of_example || scene_on_record(j->scene)) ? verdict_parse(record) : N_VERDICTS;
}

static bool title(struct finding *f, struct judge *j, const struct claim *c) {
  OWNED(text) t = {0};
  j->claim_at_fault = !claim_title(&t, j->model, c, j->scene, j->d);
  if (!j->claim_at_fault) f->title = result_copy(j->out, text_str(&t));
  return !j->claim_at_fault;
}

bool finding_describe(struct finding *f, struct judge *j, const struct claim *c) {
  struct audit_result *out = j->out;
  *f = (struct finding){.id = result_copy(out, c->id),
                        .equation = result_copy(out, claim_get(c, "equation")),
                        .section = result_copy(out, claim_get(c, "section")),
                        .verdict = VERDICT_UNKNOWN,
                        .recorded = N_VERDICTS};
  if (!title(f, j, c)) return false;
  quote_and_formula(f, j, c);
  if (!c->control && j->dependences && !dependences_list(f, j, c)) return false;
  f->reproduce = result_str(out, "%s%s --only %s --out recheck", j->scene->command, j->model->options, c->id);
  const char *record = claim_get(c, "record");
  if (record && verdict_parse(record) == N_VERDICTS) return claim_error(j, c, "record", "not a verdict");
  f->recorded = claim_recorded(j, c);
  f->correction_recorded = claim_get(c, "correction");
  return true;
}

/* Does the diagnostic point at what the paper prints: a formula beside which its TeX stands, which says the same
   (model_check_tex), or one that is laid over the paper as if it were printed so? */
static bool about_paper(const struct judge *j) {
  for (size_t i = 0; i < j->model->n_records; i++) {
    const struct statement_record *r = &j->model->records[i];
    const struct record *k = r->record;
    bool printed = r->rank == RANK_USER || (r->rank == RANK_PAPER && *r->tex);
    bool inside = j->d->src == r->src && k->n_fields > 0 && j->d->at >= k->kind.begin &&
                  j->d->at <= k->fields[k->n_fields - 1].value.end;
    if (printed && inside) return true;
  }
  return false;
}

/* What the program does not read is unknown. */
static bool not_read(struct finding *f, struct judge *j) {
  if (!j->d->beyond || j->claim_at_fault) return false;
  f->verdict = VERDICT_UNKNOWN;
  finding_state(f, j->out, "none", layer_name[LAYER_PRINTED], -1, 0, NULL, result_copy(j->out, j->d->message));
  diag_init(j->d);
  return true;
}

/* A sentence that cannot be read (matrices that do not fit) is refuted by the diagnostic itself, where that is the
   paper's doing.  What the claim, a control or an erratum spoils is an error of ours, and so is a name that no file
   declares, or two sections apart: that the paper says nowhere what it means is for a claim of kind notation to say. */
static bool notation_fault(struct finding *f, struct judge *j) {
  if (j->claim_at_fault || j->d->undeclared || !about_paper(j)) return false;
  struct route_result w = {"diagnostic", ROUTE_DIFFERS, true, 1};
  finding_add_route(f, j->out, w, "own text printed, the rest corrected", -1, NULL, result_copy(j->out, j->d->message));
  f->verdict = VERDICT_REFUTED;
  f->fault = "notation";
  diag_init(j->d);
  return true;
}

bool judge_verdict(struct finding *f, struct judge *j, const struct claim *c) {
  const struct claim_kind *kind = claim_kind_of(c);
  if (!kind) return claim_error(j, c, "kind", claim_no_kind);
  return finding_describe(f, j, c) &&
         (judge_subject(f, j, c, claim_view(j->model, c)) || not_read(f, j) || notation_fault(f, j));
}

/* The findings after the one at `at` are those of its restrictions. */
static bool take_condition(struct audit_result *out, size_t at) {
  struct finding *f = &out->findings[at];
  for (size_t i = at + 1; i < out->n_findings && f->verdict == VERDICT_REFUTED; i++) {
    f->verdict = verdict_under_condition(f->verdict, out->findings[i].verdict);
    if (f->verdict == VERDICT_CONDITIONAL) f->condition = out->findings[i].condition;
  }
  return true;
}

bool judge_claim(struct judge *j, const struct claim *c) {
  struct finding f;
  if (!judge_verdict(&f, j, c)) return false;
  keep_asked_routes(&f, j, c);
  const char *few = claim_get(c, "few");
  if (few)
    finding_state(&f, j->out, "none", layer_name[LAYER_CORRECTED], -1, -1, NULL,
                  result_str(j->out, "fewer points or routes than its kind asks for: %s", few));
  const struct claim_kind *k = claim_kind_of(c);
  if (f.verdict == VERDICT_REFUTED && f.condition) /* the judge says when it holds */
    f.verdict = verdict_under_condition(f.verdict, VERDICT_PROVED);
  if (!f.fault && (f.verdict == VERDICT_REFUTED || f.verdict == VERDICT_CONDITIONAL))
    f.fault = fault_name[claim_fault(j->model, c)];
  bool again = (f.verdict == VERDICT_REFUTED || verdict_passes(f.verdict)) && claim_judged_at_points(j->model, c) &&
               !f.correction;
  if (again && !judge_correction(&f, j, c)) return false;
  struct audit_result *out = j->out;
  if (f.verdict == VERDICT_SUPPORTED && j->effort == EFFORT_FULL && route_is_asked(j->scene, "exact"))
    finding_why_not(&f, out, c);
  size_t at = out->n_findings;
  audit_finding(out, &f);
  if (f.verdict != VERDICT_REFUTED || !k->tried_at_points || finding_is_diagnostic(&f)) return true;
  return judge_restrictions(j, c, claim_view(j->model, c), &f) && take_condition(out, at);
}

/* --- Controls --- */

static bool is_found(const struct audit_result *out, const char *id, enum verdict verdict) {
  const struct finding *f = audit_result_finding(out, id);
  return f && f->verdict == verdict;
}

/* Was the claim refuted because it cannot be read?  Then its damaged form says nothing. */
static bool is_unreadable(const struct audit_result *out, const struct claim *c) {
  const struct finding *f = audit_result_finding(out, c->id);
  return f && claim_tried_at_points(c) && finding_is_diagnostic(f);
}

/* Of a control that says how near it is; where its claim is not tried at points, that is taken as said, and so it is
   where the program has made the damage itself. */
static bool measure_near(const char **distance, struct judge *j, const struct claim *c, const struct claim *control) {
  const char *near = record_get(control->record, "near");
  double log_distance;
  if (!near) return true;
  if (!isfinite(log2(strtod(near, NULL))))
    return claim_error(j, control, "near", "reads 1e-30: the most that the damage changes");
  *distance = result_copy(j->out, near);
  if (near_made(control) || !control_distance(&log_distance, j, c, control->id)) return true;
  *distance = order_of_magnitude(j->out, log_distance);
  return true;
}

static const char unread[] = "the paper's text that it alters cannot be read";

static bool leave_out(struct audit_result *out, const struct claim *control, const char *why) {
  audit_leave_out(out, result_str(out, "control %s", control->id), why);
  return true;
}

/* Why the verdict on a control tells nothing of how its claim is checked; NULL where it does. */
static const char *says_nothing(const struct judge *j, const struct finding *f, const struct claim *control,
                                const struct claim *claim) {
  bool off_record = f->recorded == N_VERDICTS; /* whether the claim holds in this scene was not known */
  const struct finding *whole = audit_result_finding(j->out, claim->id);
  bool mended = whole && whole->correction && verdict_passes(whole->correction_verdict);
  if (f->verdict == VERDICT_REFUTED)
    return whole && verdict_fails(whole->verdict) && !mended ? "its claim fails without the alteration, too" : NULL;
  if (off_record && is_found(j->out, claim->id, VERDICT_REFUTED))
    return "its claim does not hold here even without the alteration";
  if (f->verdict != VERDICT_UNKNOWN) return NULL;
  if (near_made(control) && f->n_evidence && f->evidence[0].trials < 2) return "fewer than two points could be used";
  if (j->scene->asked.routes.n > 0) return "undecided by the routes that the scene asks for";
  if (is_found(j->out, claim->id, VERDICT_UNKNOWN)) return "its claim is undecided here even without the alteration";
  return record_get(control->record, "near") && j->scene->changed
             ? "an alteration as small as this is not decided at parameters other than those on file"
             : NULL;
}

/* A control is its claim with a part of it made wrong: formulas by an overlay that bears the control's id, attributes
   by those of the control's own record.  One "of: correction" makes the correction wrong that the claim's file holds:
   the claim fails as before, and so must the correction. */
bool judge_control(struct judge *j, const struct claim *control, const struct claim *claim) {
  struct claim c = *claim;
  c.control = control->record;
  const struct claim_kind *k = claim_kind_of(&c);
  struct finding f;
  if (!k || !finding_describe(&f, j, &c)) return false;
  if (is_unreadable(j->out, claim)) return leave_out(j->out, control, unread);
  const char *of = record_get(control->record, "of");
  bool correction = of && strcmp(of, "correction") == 0;
  if (of && !correction) return claim_error(j, control, "of", "\"correction\", or nothing");
  struct view view = {j->model, LAYER_CORRECTED, NULL, control->id};
  if (correction) view = claim_view(j->model, &c);
  struct audit_result *out = j->out;
  j->effort = record_get(control->record, "near") ? EFFORT_REFUTE : EFFORT_VERDICT; /* decided where balls are */
  bool readable = judge_subject(&f, j, &c, view);
  j->effort = EFFORT_FULL;
  if (!readable) {
    if (!not_read(&f, j) && !notation_fault(&f, j)) return false;
    return leave_out(out, control, unread);
  }
  if (f.verdict == VERDICT_SKIPPED) return true;
  if (correction) f.verdict = f.correction ? f.correction_verdict : VERDICT_UNKNOWN;
  const char *why = says_nothing(j, &f, control, claim);
  if (why) return leave_out(out, control, why);
  const char *distance = NULL;
  if (!measure_near(&distance, j, &c, control)) return false;
  audit_control(out, result_copy(out, control->id), result_copy(out, claim->id), f.verdict);
  struct control_result *said = &out->controls[out->n_controls - 1];
  said->near = result_copy(out, record_get(control->record, "near"));
  said->distance = distance;
  return true;
}
