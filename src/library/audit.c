/* Audits: claims in, findings out. */
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"
#include "report/folder.h"

enum { MOST_ONLY = 1000, MOST_JOBS = 64 };

_Static_assert((int)SS_VERDICTS == N_VERDICTS && (int)SS_DEFINITION == VERDICT_DEFINITION, "the order of the verdicts");

struct ss_audit {
  struct audit_result r;
  struct ss_paper *paper;
};

const char *ss_verdict_name(int verdict) {
  return verdict >= 0 && verdict < N_VERDICTS ? verdict_name[verdict] : NULL;
}

size_t ss_claims_count(const ss_paper *p) {
  return p ? p->files.claims.n : 0;
}

const char *ss_claim_id(const ss_paper *p, size_t i) {
  return i < ss_claims_count(p) ? p->files.claims.claim[i].id : NULL;
}

const char *ss_claim_attribute(const ss_paper *p, size_t i, const char *name) {
  return name && i < ss_claims_count(p) ? claim_get(&p->files.claims.claim[i], name) : NULL;
}

/* --- The run --- */

struct progress {
  void (*tell)(void *self, size_t done, size_t of);
  void *self;
};

static void pass_on(void *arg, size_t done, size_t total, double share) {
  const struct progress *p = arg;
  (void)share;
  p->tell(p->self, done, total);
}

/* Cuts the list up; how many items it has, -1 when one is empty or there are too many. */
static int cut(const char **item, char *list) {
  int n = 0;
  for (char *p = list; p; n++) {
    char *comma = strchr(p, ',');
    if (comma) *comma = '\0';
    if (!*p || n == MOST_ONLY) return -1;
    item[n] = p;
    p = comma ? comma + 1 : NULL;
  }
  return n;
}

static int run(struct ss_audit *a, const struct ss_paper *p, const struct ss_scene *s,
               const struct audit_options *opt) {
  static pthread_mutex_t one = PTHREAD_MUTEX_INITIALIZER; /* processes and their ends are the process's own affair */
  struct diag d = {0};
  bool ok = scene_four_phases(&s->s, &d);
  pthread_mutex_lock(&one);
  ok = ok && audit_run(&a->r, &p->files.model, &p->files.claims, &p->files.controls, &s->s, opt, &d);
  pthread_mutex_unlock(&one);
  return ok ? SS_OK : library_input(&d);
}

int ss_audit_run(ss_audit **out, const ss_paper *p, const ss_scene *s, const char *only, int jobs,
                 void (*progress)(void *self, size_t done, size_t of), void *self) {
  const char *item[MOST_ONLY];
  struct progress passed = {progress, self};
  if (!out) return library_argument(__func__, "no place for the audit");
  *out = NULL;
  if (!p || !s || jobs < 1 || jobs > MOST_JOBS)
    return library_argument(__func__, "no paper or scene, or not 1 to 64 jobs");
  FREED char *list = only ? ss_strdup(only) : NULL;
  struct audit_options opt = {.only = item,
                              .n_only = cut(item, list),
                              .progress = progress ? pass_on : NULL,
                              .arg = &passed,
                              .readings = true,
                              .statements = &p->files.statements,
                              .roots = &p->files.roots,
                              .jobs = jobs};
  struct ss_audit *a = ss_malloc(sizeof *a);
  audit_result_init(&a->r);
  a->paper = (struct ss_paper *)(uintptr_t)p; /* only its count changes */
  atomic_fetch_add(&a->paper->holders, 1);
  int status =
      opt.n_only < 0 ? library_argument(__func__, "ids with commas between, at most 1000") : run(a, p, s, &opt);
  if (status)
    ss_audit_free(a);
  else
    *out = a;
  return status;
}

void ss_audit_free(ss_audit *a) {
  if (!a) return;
  audit_result_clear(&a->r);
  ss_paper_free(a->paper);
  free(a);
}

size_t ss_audit_unexpected(const ss_audit *a) {
  return a ? (size_t)audit_result_unexpected(&a->r) : 0;
}

/* --- Findings --- */

size_t ss_audit_count(const ss_audit *a) {
  return a ? a->r.n_findings : 0;
}

static const struct finding *finding_of(const struct ss_audit *a, size_t i) {
  return i < ss_audit_count(a) ? &a->r.findings[i] : NULL;
}

/* The text at an offset. */
static const char *text_at(const void *of, size_t offset) {
  const char *text;
  memcpy(&text, (const char *)of + offset, sizeof text);
  return text;
}

const char *ss_finding_text(const ss_audit *a, size_t i, int field) {
  static const size_t at[SS_FINDING_FIELDS] = {
      [SS_FINDING_ID] = offsetof(struct finding, id),
      [SS_FINDING_EQUATION] = offsetof(struct finding, equation),
      [SS_FINDING_SECTION] = offsetof(struct finding, section),
      [SS_FINDING_TITLE] = offsetof(struct finding, title),
      [SS_FINDING_QUOTE] = offsetof(struct finding, quote),
      [SS_FINDING_PRINTED] = offsetof(struct finding, printed),
      [SS_FINDING_CONDITION] = offsetof(struct finding, condition),
      [SS_FINDING_FAULT] = offsetof(struct finding, fault),
      [SS_FINDING_CORRECTION] = offsetof(struct finding, correction),
      [SS_FINDING_CORRECTION_LATEX] = offsetof(struct finding, correction_latex),
      [SS_FINDING_EFFECT] = offsetof(struct finding, effect),
      [SS_FINDING_REPRODUCE] = offsetof(struct finding, reproduce),
  };
  const struct finding *f = finding_of(a, i);
  return f && field >= 0 && field < SS_FINDING_FIELDS ? text_at(f, at[field]) : NULL;
}

enum ss_verdict ss_finding_verdict(const ss_audit *a, size_t i) {
  return finding_of(a, i) ? (enum ss_verdict)a->r.findings[i].verdict : SS_VERDICTS;
}

enum ss_verdict ss_finding_recorded(const ss_audit *a, size_t i) {
  return finding_of(a, i) ? (enum ss_verdict)a->r.findings[i].recorded : SS_VERDICTS;
}

enum ss_verdict ss_finding_corrected(const ss_audit *a, size_t i) {
  const struct finding *f = finding_of(a, i);
  return f && f->correction ? (enum ss_verdict)f->correction_verdict : SS_VERDICTS;
}

size_t ss_evidence_count(const ss_audit *a, size_t i) {
  return finding_of(a, i) ? (size_t)a->r.findings[i].n_evidence : 0;
}

static const struct evidence *row_of(const struct ss_audit *a, size_t i, size_t row) {
  return row < ss_evidence_count(a, i) ? &a->r.findings[i].evidence[row] : NULL;
}

const char *ss_evidence_text(const ss_audit *a, size_t i, size_t row, int field) {
  static const size_t at[SS_EVIDENCE_FIELDS] = {
      [SS_EVIDENCE_ROUTE] = offsetof(struct evidence, route),
      [SS_EVIDENCE_LAYER] = offsetof(struct evidence, layer),
      [SS_EVIDENCE_RESULT] = offsetof(struct evidence, result),
      [SS_EVIDENCE_RESIDUAL] = offsetof(struct evidence, residual),
      [SS_EVIDENCE_WORST] = offsetof(struct evidence, worst),
      [SS_EVIDENCE_NOTE] = offsetof(struct evidence, note),
  };
  const struct evidence *e = row_of(a, i, row);
  return e && field >= 0 && field < SS_EVIDENCE_FIELDS ? text_at(e, at[field]) : NULL;
}

long ss_evidence_trials(const ss_audit *a, size_t i, size_t row) {
  return row_of(a, i, row) ? row_of(a, i, row)->trials : -1;
}

long ss_evidence_bits(const ss_audit *a, size_t i, size_t row) {
  return row_of(a, i, row) ? row_of(a, i, row)->bits : -1;
}

/* --- The record --- */

int ss_audit_json(char **out, const ss_audit *a) {
  struct text t = {0};
  if (!out) return library_argument(__func__, "no place for the text");
  *out = NULL;
  if (!a) return library_argument(__func__, "no audit");
  report_json(&t, &a->r);
  *out = library_take(&t);
  return SS_OK;
}

int ss_audit_write(const ss_audit *a, const char *folder) {
  struct diag d = {0};
  if (!a || !folder || !*folder) return library_argument(__func__, "no audit or no folder");
  OWNED(output) out;
  output_init(&out, folder);
  bool ok = output_add_report(&out, &a->r, NULL, &d);
  output_add_tables(&out, &a->r);
  return ok && output_write(&out, &d) ? SS_OK : library_input(&d);
}
