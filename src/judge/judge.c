/* One claim: it is judged with its own text as printed and everything it uses corrected; a refuted one is
   judged again as corrected and under restrictions; every control beside it must be noticed.  run.c says which are. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "proof/exact_proof.h"
#include "route/routes.h"
#include "scene/orbit_pool.h"
#include "stickslip/work.h"

enum {
  PHASES = 1U << WORK_PHASE_D | 1U << WORK_PHASE_GAMMA | 1U << WORK_PHASE_H | 1U << WORK_PHASE_C,
  SCENE = 1U << WORK_SCENE_ORBITS,
  OTHER = 1U << WORK_OTHER_ORBITS,
  POOL = 1U << WORK_ORBIT_POOL,
  MOTION = 1U << WORK_SIMULATION,
  ALGEBRA = 1U << WORK_ALGEBRA
};

/* name, judge, tried at points, asked when, of the scene alone, parts besides its points', in balls */
static const struct claim_kind kinds[] = {
    {"definition", judge_definition, false, ASKED_EARLY, false, 0, false},
    {"matrix", judge_points, true, ASKED_EARLY, false, SCENE | ALGEBRA, true},
    {"identity", judge_points, true, ASKED_EARLY, false, SCENE | ALGEBRA, true},
    {"threshold", judge_threshold, false, ASKED_EARLY, false, 0, true},
    {"sharp", judge_sharp, false, ASKED_EARLY, false, ALGEBRA, true},
    {"inequality", judge_inequality, false, ASKED_EARLY, true, PHASES | SCENE, true},
    {"index-range", judge_index_range, false, ASKED_EARLY, false, 0, false},
    {"number", judge_number, false, ASKED_EARLY, true, PHASES | SCENE, true},
    {"closure", judge_closure, false, ASKED_EARLY, true, PHASES | SCENE, true},
    {"criterion", judge_criterion, false, ASKED_LATE, false, PHASES | SCENE | OTHER | MOTION, true},
    {"behaviour", judge_behaviour, false, ASKED_NEVER, false, PHASES | SCENE | OTHER | MOTION, true},
    {"report", judge_report, false, ASKED_NEVER, false, PHASES | SCENE, true},
    {"argument", judge_argument, false, ASKED_LATE, false, PHASES | SCENE | OTHER | POOL | ALGEBRA, true},
    {"notation", judge_notation, false, ASKED_EARLY, false, 0, false},
    {"scaling", judge_scaling, false, ASKED_LATE, false, 0, false},
    {"reach", judge_reach, false, ASKED_LATE, false, 0, false},
    {"rank", judge_rank, false, ASKED_LATE, false, PHASES | OTHER | ALGEBRA, true},
    {"constraints", judge_constraints, false, ASKED_LATE, false, PHASES | SCENE | OTHER | POOL | MOTION, true},
    {"sequence", judge_sequence, false, ASKED_LATE, true, PHASES | SCENE | OTHER | MOTION, true},
    {"existence", judge_existence, false, ASKED_NEVER, true, PHASES | SCENE, true},
    {"law", judge_law, false, ASKED_EARLY, false, MOTION, true},
    {"outside", judge_outside, false, ASKED_NEVER, false, 0, false}};

static const struct claim_kind *kind_named(const char *name) {
  for (size_t i = 0; name && i < sizeof kinds / sizeof *kinds; i++)
    if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
  return NULL;
}

const struct claim_kind *claim_kind_of(const struct claim *c) {
  return kind_named(claim_get(c, "kind"));
}

kind_fn claim_kind(const char *name) {
  const struct claim_kind *k = kind_named(name);
  return k ? k->judge : NULL;
}

bool claim_tried_at_points(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  return k && k->tried_at_points;
}

enum asked claim_asked(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  return k ? k->asked : ASKED_EARLY;
}

/* --- The result record --- */

void audit_result_init(struct audit_result *r) {
  *r = (struct audit_result){.n_findings = 0};
  arena_init(&r->arena);
}

struct result_pages {
  struct result_pages *next;
  void *at;
  size_t size;
};

void result_keep_pages(struct audit_result *r, void *pages, size_t size) {
  struct result_pages *p = ss_malloc(sizeof *p);
  *p = (struct result_pages){r->pages, pages, size};
  r->pages = p;
}

void audit_result_clear(struct audit_result *r) {
  free(r->findings);
  free(r->consequences);
  free(r->skipped);
  free(r->controls);
  free(r->pairs);
  free(r->long_runs);
  free(r->values);
  free(r->precision);
  free(r->spent);
  while (r->pages) {
    struct result_pages *p = r->pages;
    r->pages = p->next;
    munmap(p->at, p->size);
    free(p);
  }
  free(r->tables);
  arena_clear(&r->arena);
}

const char *result_str(struct audit_result *r, const char *fmt, ...) {
  va_list ap, again;
  va_start(ap, fmt);
  va_copy(again, ap);
  int n = vsnprintf(NULL, 0, fmt, ap);
  va_end(ap);
  char *s = arena_alloc(&r->arena, (size_t)(n > 0 ? n : 0) + 1);
  vsnprintf(s, (size_t)n + 1, fmt, again);
  va_end(again);
  return s;
}

const struct consequence *audit_result_consequence(const struct audit_result *r, const char *failure) {
  for (size_t i = 0; i < r->n_consequences; i++)
    if (strcmp(r->consequences[i].failure, failure) == 0) return &r->consequences[i];
  return NULL;
}

void audit_result_count(const struct audit_result *r, long count[N_VERDICTS]) {
  long total = 0;
  for (int i = 0; i < N_VERDICTS; i++) count[i] = 0;
  for (size_t i = 0; i < r->n_findings; i++) count[r->findings[i].verdict]++;
  for (int i = 0; i < N_VERDICTS; i++) total += count[i];
  if (total != (long)r->n_findings) abort();
}

long audit_result_unexpected(const struct audit_result *r) {
  long n = 0;
  for (size_t i = 0; i < r->n_findings; i++)
    n += r->findings[i].recorded != N_VERDICTS && r->findings[i].recorded != r->findings[i].verdict;
  for (size_t i = 0; i < r->n_controls; i++) n += !r->controls[i].noticed;
  for (size_t i = 0; i < r->n_pairs; i++) n += !r->pairs[i].within;
  for (size_t i = 0; i < r->n_long_runs; i++) n += !r->long_runs[i].obeys || !r->long_runs[i].displaced;
  return n;
}

/* --- Corrections --- */

bool erratum_is_about(const struct statement_record *r, const struct claim *c, bool by_statement) {
  const char *statement = claim_get(c, "statement"), *equation = claim_get(c, "equation");
  if (r->rank != RANK_ERRATA) return false;
  if (by_statement) return statement && strcmp(r->id, statement) == 0;
  return strcmp(r->record->kind_name, "define") == 0 && equation && strcmp(r->equation, equation) == 0;
}

bool erratum_text(struct text *out, const struct model *m, const struct claim *c) {
  const char *sep = "";
  bool found = false;
  for (int pass = 0; pass < 2 && !found; pass++)
    for (size_t i = 0; i < m->n_records; i++) {
      const struct statement_record *r = &m->records[i];
      if (!erratum_is_about(r, c, pass == 0)) continue;
      for (int k = 0; k < r->n_stmts; k++) {
        text_add(out, sep);
        stmt_print(out, r->stmts[k]);
        sep = "; ";
      }
      found = true;
    }
  return found;
}

bool judge_correction(struct finding *f, struct judge *j, const struct claim *c, kind_fn kind) {
  struct text t;
  text_init(&t);
  bool ok = true;
  if (erratum_text(&t, j->model, c)) {
    struct finding again = *f;
    again.evidence = NULL;
    again.n_evidence = 0;
    ok = kind(&again, j, c, (struct view){j->model, LAYER_CORRECTED, NULL, NULL});
    f->correction = result_str(j->out, "%s", text_str(&t));
    f->correction_verdict = again.verdict;
    erratum_typeset(f, j, c);
    for (int i = 0; ok && i < again.n_evidence; i++) {
      struct evidence *e = finding_add(f, j->out);
      *e = again.evidence[i];
    }
  }
  text_clear(&t);
  return ok;
}

/* --- One claim --- */

bool claim_is_about(const struct statement_record *r, const struct claim *c) {
  const char *statement = claim_get(c, "statement"), *value = claim_get(c, "value"),
             *equation = claim_get(c, "equation");
  if (r->rank > RANK_USER) return false;
  if (statement) return strcmp(r->id, statement) == 0;
  return value && equation && strcmp(r->record->kind_name, "define") == 0 && strcmp(r->equation, equation) == 0;
}

/* The paper's own text, and beside it the formula as it was parsed, so that the transcription can be checked by eye. */
static void quote_and_formula(struct finding *f, struct judge *j, const struct claim *c) {
  const char *quote = claim_get(c, "quote");
  struct text tex, parsed;
  text_init(&tex);
  text_init(&parsed);
  for (size_t i = 0; i < j->model->n_records; i++) {
    const struct statement_record *r = &j->model->records[i];
    if (!claim_is_about(r, c)) continue;
    if (*r->tex) text_printf(&tex, "%s$%s$", tex.len ? " " : "", r->tex);
    for (int k = 0; k < r->n_stmts; k++) {
      text_add(&parsed, parsed.len ? ", \\quad " : "");
      stmt_latex(&parsed, r->stmts[k]);
    }
  }
  if (quote)
    f->quote = result_str(j->out, "%s", quote);
  else if (tex.len)
    f->quote = result_str(j->out, "%s", text_str(&tex));
  if (parsed.len) f->printed = result_str(j->out, "%s", text_str(&parsed));
  text_clear(&parsed);
  text_clear(&tex);
}

static const char *copy(struct audit_result *out, const char *s) {
  return s ? result_str(out, "%s", s) : NULL;
}

enum verdict claim_recorded(const struct claim *c, const struct scene *s) {
  const char *record = claim_get(c, "record"), *only = claim_get(c, "record-scene");
  return record && (!only || scene_is(s, only)) ? verdict_parse(record) : N_VERDICTS;
}

bool finding_describe(struct finding *f, struct judge *j, const struct claim *c) {
  struct audit_result *out = j->out;
  *f = (struct finding){.id = copy(out, c->id),
                        .equation = copy(out, claim_get(c, "equation")),
                        .section = copy(out, claim_get(c, "section")),
                        .title = copy(out, claim_get(c, "title")),
                        .verdict = VERDICT_UNKNOWN,
                        .recorded = N_VERDICTS};
  if (!f->title) return claim_error(j, c, "title", "the attribute title is missing");
  quote_and_formula(f, j, c);
  if (!c->control && j->dependences && !dependences_list(f, j, c)) return false;
  f->reproduce = result_str(out, "stickslip verify %s --only %s", j->scene->command, c->id);
  const char *record = claim_get(c, "record");
  if (record && verdict_parse(record) == N_VERDICTS) return claim_error(j, c, "record", "not a verdict");
  f->recorded = claim_recorded(c, j->scene);
  return true;
}

static bool known_fault(const char *s) {
  static const char *const faults[] = {"notation", "formula", "number", "argument"};
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
    if (strcmp(faults[i], s) == 0) return true;
  return false;
}

/* Does the diagnostic point into a file that counts as the paper's text? */
static bool about_paper(const struct judge *j) {
  for (size_t i = 0; i < j->model->n_records; i++) {
    const struct statement_record *r = &j->model->records[i];
    size_t n = strlen(r->src->name);
    if (r->rank <= RANK_USER && strncmp(j->d->message, r->src->name, n) == 0 && j->d->message[n] == ':') return true;
  }
  return false;
}

/* A sentence that cannot be read (an undefined symbol, a wrong shape) is refuted by the diagnostic itself; one that the
   claim, a control or an erratum spoils is an error of ours. */
static bool notation_fault(struct finding *f, struct judge *j) {
  if (j->claim_at_fault || !about_paper(j)) return false;
  struct evidence *e = finding_add(f, j->out);
  e->route = "diagnostic";
  e->layer = "own text printed, the rest corrected";
  e->result = "differs";
  e->trials = 1;
  e->note = result_str(j->out, "%s", j->d->message);
  f->verdict = VERDICT_REFUTED;
  f->fault = "notation";
  diag_init(j->d);
  return true;
}

struct view claim_view(const struct model *m, const struct claim *c) {
  return (struct view){m, LAYER_CORRECTED, claim_own(c), NULL};
}

bool judge_verdict(struct finding *f, struct judge *j, const struct claim *c) {
  const struct claim_kind *kind = claim_kind_of(c);
  if (!kind) return claim_error(j, c, "kind", "unknown kind of claim");
  return finding_describe(f, j, c) && (kind->judge(f, j, c, claim_view(j->model, c)) || notation_fault(f, j));
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
  const struct claim_kind *k = claim_kind_of(c);
  if (f.verdict == VERDICT_REFUTED) {
    const char *fault = claim_get(c, "fault");
    if (!f.fault) f.fault = copy(j->out, fault ? fault : "formula");
    if (!known_fault(f.fault)) return claim_error(j, c, "fault", "one of notation, formula, number, argument");
    if (!f.correction && k->tried_at_points && !judge_correction(&f, j, c, k->judge)) return false;
  }
  struct audit_result *out = j->out;
  out->findings = ss_grow(out->findings, out->n_findings, &out->cap_findings, sizeof f);
  if (f.verdict == VERDICT_SUPPORTED && j->effort == EFFORT_FULL && route_is_asked(j->scene, "exact"))
    finding_why_not(&f, out, c);
  size_t at = out->n_findings++;
  out->findings[at] = f;
  bool readable = f.n_evidence == 0 || strcmp(f.evidence[0].route, "diagnostic") != 0;
  if (f.verdict != VERDICT_REFUTED || !k->tried_at_points || !readable) return true;
  return judge_restrictions(j, c, claim_view(j->model, c), &f) && take_condition(out, at);
}

/* --- Controls --- */

void audit_leave_out(struct audit_result *out, const char *what, const char *why) {
  out->skipped = ss_grow(out->skipped, out->n_skipped, &out->cap_skipped, sizeof *out->skipped);
  out->skipped[out->n_skipped++] = (struct skipped_work){what, why};
}

const struct claim *claim_named(const struct claims *claims, const char *id) {
  for (size_t i = 0; id && i < claims->n; i++)
    if (strcmp(claims->claim[i].id, id) == 0) return &claims->claim[i];
  return NULL;
}

void audit_control(struct audit_result *out, const char *id, const char *claim, enum verdict verdict) {
  out->controls = ss_grow(out->controls, out->n_controls, &out->cap_controls, sizeof *out->controls);
  out->controls[out->n_controls++] = (struct control_result){id, claim, verdict, verdict == VERDICT_REFUTED};
}

static bool is_found(const struct audit_result *out, const char *id, enum verdict verdict) {
  for (size_t i = 0; i < out->n_findings; i++)
    if (strcmp(out->findings[i].id, id) == 0) return out->findings[i].verdict == verdict;
  return false;
}

/* A control is its claim with a part of it made wrong: formulas by an overlay that bears the control's id, attributes by
   those of the control's own record. */
bool judge_control(struct judge *j, const struct claim *control, const struct claim *claim) {
  struct claim c = *claim;
  c.control = control->record;
  const struct claim_kind *k = claim_kind_of(&c);
  struct finding f;
  if (!k || !finding_describe(&f, j, &c)) return false;
  struct view view = {j->model, LAYER_CORRECTED, NULL, control->id};
  struct audit_result *out = j->out;
  j->effort = EFFORT_VERDICT;
  bool readable = k->judge(&f, j, &c, view);
  j->effort = EFFORT_FULL;
  if (!readable) {
    if (!notation_fault(&f, j)) return false;
    audit_leave_out(out, result_str(out, "control %s", control->id), "the paper's text that it damages cannot be read");
    return true;
  }
  if (f.verdict == VERDICT_SKIPPED) return true;
  bool narrowed = j->scene->asked.routes.n > 0;
  if (f.verdict == VERDICT_UNKNOWN && narrowed) {
    audit_leave_out(out, result_str(out, "control %s", control->id), "undecided by the routes that the scene asks for");
    return true;
  }
  if (f.verdict == VERDICT_UNKNOWN && is_found(out, claim->id, VERDICT_UNKNOWN)) {
    audit_leave_out(out, result_str(out, "control %s", control->id), "its claim is undecided here without damage");
    return true;
  }
  bool off_record = f.recorded == N_VERDICTS; /* whether the claim holds in this scene was not known */
  if (f.verdict != VERDICT_REFUTED && off_record && is_found(out, claim->id, VERDICT_REFUTED)) {
    audit_leave_out(out, result_str(out, "control %s", control->id), "its claim does not hold here without damage");
    return true;
  }
  audit_control(out, copy(out, control->id), copy(out, claim->id), f.verdict);
  return true;
}
