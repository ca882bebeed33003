/* The result record: what an audit has found, with every string in its own arena. */
#include "result.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "finding.h"

#define VERDICT_STRING(upper, lower) #lower,
const char *const verdict_name[N_VERDICTS] = {VERDICTS(VERDICT_STRING)};

const char *const claimant_name[N_CLAIMANTS] = {"paper", "suite"};
const char *const severity_name[N_SEVERITIES] = {"substance", "remark", "notation"};
const char *const fault_name[N_FAULTS] = {"notation", "formula", "number", "argument"};

enum severity severity_parse(const char *name) {
  return (enum severity)word_find(name, severity_name, N_SEVERITIES);
}

void audit_result_init(struct audit_result *r) {
  *r = (struct audit_result){.n_findings = 0};
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
#define FREE(type, name) free(r->name);
  RESULT_LISTS(FREE)
#undef FREE
  while (r->pages) {
    FREED struct result_pages *p = r->pages;
    r->pages = p->next;
    munmap(p->at, p->size);
  }
  arena_clear(&r->arena);
}

const char *result_str(struct audit_result *r, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *s = arena_vprintf(&r->arena, fmt, ap);
  va_end(ap);
  return s;
}

const char *result_copy(struct audit_result *r, const char *s) {
  return s ? arena_strdup(&r->arena, s) : NULL;
}

const char *result_take(struct audit_result *r, struct text *t) {
  return text_take(&r->arena, t);
}

const struct finding *audit_result_finding(const struct audit_result *r, const char *id) {
  for (size_t i = 0; i < r->n_findings; i++)
    if (strcmp(r->findings[i].id, id) == 0) return &r->findings[i];
  return NULL;
}

const struct root_cause *audit_result_root(const struct audit_result *r, const char *id) {
  for (size_t i = 0; i < r->n_roots; i++)
    if (strcmp(r->roots[i].id, id) == 0) return &r->roots[i];
  return NULL;
}

size_t audit_result_roots(const struct audit_result *r, enum severity severity) {
  size_t n = 0;
  for (size_t i = 0; i < r->n_roots; i++) n += r->roots[i].severity == severity;
  return n;
}

const struct consequence *audit_result_consequence(const struct audit_result *r, const char *failure) {
  for (size_t i = 0; i < r->n_consequences; i++)
    if (strcmp(r->consequences[i].failure, failure) == 0) return &r->consequences[i];
  return NULL;
}

long audit_result_count(long count[N_VERDICTS], const struct audit_result *r, enum claimant of) {
  long total = 0;
  for (int i = 0; i < N_VERDICTS; i++) count[i] = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    if (r->findings[i].of != of) continue;
    count[r->findings[i].verdict]++;
    total++;
  }
  return total;
}

bool finding_unexpected(const struct finding *f) {
  return f->recorded != N_VERDICTS && f->recorded != f->verdict;
}

bool long_result_fails(const struct long_result *l) {
  return !l->obeys || !l->displaced;
}

bool finding_miscorrected(const struct finding *f) {
  if (!f->correction) return false;
  if (f->recorded == N_VERDICTS || f->correction_verdict == VERDICT_REFUTED)
    return f->correction_verdict == VERDICT_REFUTED;
  return f->correction_recorded ? f->correction_verdict != VERDICT_UNKNOWN : !verdict_passes(f->correction_verdict);
}

bool control_is_far(const struct control_result *c) {
  return c->near && c->distance && strtod(c->distance, NULL) > 1.0001 * strtod(c->near, NULL);
}

long audit_result_unexpected(const struct audit_result *r) {
  long n = 0;
  for (size_t i = 0; i < r->n_findings; i++)
    n += finding_unexpected(&r->findings[i]) + finding_miscorrected(&r->findings[i]);
  for (size_t i = 0; i < r->n_controls; i++) n += !r->controls[i].noticed || control_is_far(&r->controls[i]);
  for (size_t i = 0; i < r->n_pairs; i++) n += !r->pairs[i].within;
  for (size_t i = 0; i < r->n_long_runs; i++) n += long_result_fails(&r->long_runs[i]);
  return n;
}

void audit_leave_out(struct audit_result *out, const char *what, const char *why) {
  *SS_PUSH(out->skipped, out->n_skipped, out->cap_skipped) = (struct skipped_work){what, why};
}

void audit_finding(struct audit_result *out, const struct finding *f) {
  *SS_PUSH(out->findings, out->n_findings, out->cap_findings) = *f;
}

void audit_control(struct audit_result *out, const char *id, const char *claim, enum verdict verdict) {
  *SS_PUSH(out->controls, out->n_controls, out->cap_controls) =
      (struct control_result){id, claim, verdict, verdict == VERDICT_REFUTED, NULL, NULL};
}

enum verdict verdict_parse(const char *name) {
  return (enum verdict)word_find(name, verdict_name, N_VERDICTS);
}

bool verdict_fails(enum verdict v) {
  return v == VERDICT_REFUTED || v == VERDICT_CONDITIONAL;
}

bool verdict_passes(enum verdict v) {
  return v == VERDICT_PROVED || v == VERDICT_SUPPORTED;
}

struct evidence *finding_add(struct finding *f, struct audit_result *out) {
  struct evidence *e = arena_alloc(&out->arena, (size_t)(f->n_evidence + 1) * sizeof *e);
  if (f->n_evidence) memcpy(e, f->evidence, (size_t)f->n_evidence * sizeof *e);
  f->evidence = e;
  e += f->n_evidence++;
  *e = (struct evidence){.bits = -1, .trials = -1, .machine_residual = NAN};
  return e;
}

struct finding finding_again(const struct finding *f) {
  struct finding again = *f;
  again.evidence = NULL;
  again.n_evidence = 0;
  return again;
}

void finding_take_evidence(struct finding *f, struct audit_result *out, const struct finding *again) {
  for (int i = 0; i < again->n_evidence; i++) *finding_add(f, out) = again->evidence[i];
}

bool finding_is_diagnostic(const struct finding *f) {
  return f->n_evidence > 0 && strcmp(f->evidence[0].route, "diagnostic") == 0;
}

void certificate_add(struct certificate *c, struct audit_result *out, const char *name, const char *value) {
  struct named_value *longer = arena_alloc(&out->arena, (size_t)(c->n + 1) * sizeof *longer);
  if (c->n) memcpy(longer, c->at, (size_t)c->n * sizeof *longer);
  longer[c->n++] = (struct named_value){name, value};
  c->at = longer;
}

const char *order_of_magnitude(struct audit_result *r, double log2x) {
  if (isinf(log2x) && log2x < 0) return "0";
  return result_str(r, "1e%d", (int)ceil(log2x * 0.30102999566398120));
}

const char *evidence_where(const struct evidence *e) {
  return e->worst && e->note && strstr(e->note, e->worst) ? NULL : e->worst;
}

static void put(struct finding *f, struct audit_result *out, const char *route, const char *layer, const char *result,
                long bits, long trials, const char *where, const char *note) {
  struct evidence *e = finding_add(f, out);
  e->route = route;
  e->layer = layer;
  e->result = result;
  e->bits = bits;
  e->trials = trials;
  e->worst = where;
  e->note = note;
}

struct route_result finding_add_route(struct finding *f, struct audit_result *out, struct route_result w,
                                      const char *layer, long bits, const char *where, const char *note) {
  static const char *const words[] = {"undecided", "agrees", "differs", "undecided"};
  put(f, out, w.route, layer, words[w.outcome], bits, w.trials, where, note);
  return w;
}

void finding_state(struct finding *f, struct audit_result *out, const char *route, const char *layer, long bits,
                   long trials, const char *where, const char *note) {
  put(f, out, route, layer, "states", bits, trials, where, note);
}
