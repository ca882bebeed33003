/* The table of bench/peers/peers.py: methods of other systems, measured by them on the inputs of bench_inputs.  What it
   says is taken as it is where it can be a measurement, and refused with its place where it cannot. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"

enum {
  AT_JOB,
  AT_METHOD,
  AT_TITLE,
  AT_ARITHMETIC,
  AT_KIND,
  AT_SETTING,
  AT_BARE,
  AT_STATE,
  AT_INPUTS,
  AT_FAILURES,
  AT_WORST,
  AT_MEDIAN,
  AT_LEAST_NS,
  AT_MEDIAN_NS,
  N_FIELDS
};
static const char head[] = "job\tmethod\ttitle\tarithmetic\tkind\tsetting\tbare\tstate\tinputs\tfailures\terror_worst\t"
                           "error_median\tns_least\tns_median";
enum { MOST_TEXT = 200, MOST_PEERS = 10000 };
static const size_t most_file = 1 << 22;

/* A line as it is read: its fields, in the arena. */
struct line {
  const struct source *src;
  size_t begin, end;
  const char *field[N_FIELDS];
  size_t at[N_FIELDS];
};

static bool refuse(const struct line *l, int column, const char *what, struct diag *d) {
  return diag_at(d, l->src, l->at[column], "%s", what);
}

static bool split(struct line *l, struct arena *a, struct diag *d) {
  size_t from = l->begin;
  int n = 0;
  for (size_t i = l->begin; i <= l->end; i++) {
    if (i < l->end && l->src->text[i] != '\t') continue;
    if (n == N_FIELDS || i - from > MOST_TEXT) break;
    l->at[n] = from;
    l->field[n++] = arena_strndup(a, l->src->text + from, i - from);
    from = i + 1;
  }
  if (n == N_FIELDS && from == l->end + 1) return true;
  return diag_at(d, l->src, l->begin, "a row has %d fields of at most %d characters", N_FIELDS, MOST_TEXT);
}

/* A plain word: it will stand in tables, in figures and in JSON. */
static bool plain(const char *s) {
  static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 _-+.,:;()^/";
  return *s && strspn(s, letters) == strlen(s);
}

static bool positive(double *x, const char *s) {
  char *end;
  *x = strtod(s, &end);
  return *s >= '0' && *s <= '9' && !*end && isfinite(*x) && *x > 0;
}

static bool count(int *x, const char *s) {
  char *end;
  long n = strtol(s, &end, 10);
  *x = (int)n;
  return *s >= '0' && *s <= '9' && !*end && n <= 1000000;
}

static bool read_names(struct bench_peer *p, const struct line *l, struct diag *d) {
  struct bench_method *m = &p->method;
  for (int i = AT_METHOD; i <= AT_ARITHMETIC; i++)
    if (!plain(l->field[i])) return refuse(l, i, "letters, digits and spaces are expected here", d);
  for (int i = 0; i < n_bench_jobs; i++)
    if (strcmp(bench_jobs[i]->id, l->field[AT_JOB]) == 0) p->job = bench_jobs[i];
  if (!p->job) return refuse(l, AT_JOB, "there is no such job", d);
  *m = (struct bench_method){l->field[AT_METHOD], l->field[AT_TITLE], .arithmetic = l->field[AT_ARITHMETIC]};
  if (bench_method_of(p->job, m->id)) return refuse(l, AT_METHOD, "the job has a method of this name", d);
  int kind = word_find(l->field[AT_KIND], bench_kind_name, N_SETS);
  if (kind == N_SETS) return refuse(l, AT_KIND, "bits, tolerance, step, digits or nothing is expected here", d);
  m->kind = (enum bench_kind)kind;
  m->bare = strcmp(l->field[AT_BARE], "yes") == 0;
  if (!m->bare && strcmp(l->field[AT_BARE], "no") != 0) return refuse(l, AT_BARE, "yes or no is expected here", d);
  p->row.setting = NAN;
  if (m->kind != SET_NONE && !positive(&p->row.setting, l->field[AT_SETTING]))
    return refuse(l, AT_SETTING, "a positive number is expected here", d);
  return true;
}

/* Errors and times of what succeeded; a failure has none. */
static bool read_measured(struct bench_row *r, const struct line *l, struct diag *d) {
  double *value[] = {&r->worst, &r->median, &r->least_ns, &r->median_ns};
  for (int i = AT_WORST; i < N_FIELDS; i++) {
    double x = NAN;
    if (!r->failure && !positive(&x, l->field[i])) return refuse(l, i, "a positive number is expected here", d);
    if (r->failure && strcmp(l->field[i], "-") != 0) return refuse(l, i, "a failure has neither error nor time", d);
    *value[i - AT_WORST] = i <= AT_MEDIAN ? log10(x) : x;
  }
  if (!r->failure && !(r->worst < log10(0.5))) return refuse(l, AT_WORST, "not one digit is right: a failure", d);
  if (r->median > r->worst) return refuse(l, AT_MEDIAN, "the median is above the worst", d);
  return true;
}

static bool read_row(struct bench_peer *p, const struct line *l, struct diag *d) {
  static const char failed[] = "failed: ";
  struct bench_row *r = &p->row;
  const char *state = l->field[AT_STATE];
  *p = (struct bench_peer){.job = NULL};
  if (!read_names(p, l, d)) return false;
  if (!count(&r->cases, l->field[AT_INPUTS])) return refuse(l, AT_INPUTS, "a number of inputs is expected here", d);
  if (!count(&r->failures, l->field[AT_FAILURES]) || r->failures > r->cases)
    return refuse(l, AT_FAILURES, "a number of inputs is expected here", d);
  if (strncmp(state, failed, strlen(failed)) == 0 && plain(state + strlen(failed)))
    r->failure = state + strlen(failed);
  else if (strcmp(state, "not installed") == 0)
    r->failure = state;
  else if (strcmp(state, "ok") != 0)
    return refuse(l, AT_STATE, "ok, not installed or failed: ... is expected here", d);
  if (!r->failure && (r->cases == 0 || r->failures > 0)) return refuse(l, AT_FAILURES, "this is not ok", d);
  r->steps = NAN;
  return read_measured(r, l, d);
}

static bool read_line(struct bench_peers *p, bool *headed, struct line *l, struct diag *d) {
  const char *s = l->src->text + l->begin;
  size_t len = l->end - l->begin;
  if (len > 2 && s[0] == '#' && s[1] == ' ' && len < MOST_TEXT) {
    text_add_n(&p->versions, s + 2, len - 2);
    text_add_char(&p->versions, '\n');
    return true;
  }
  if (!*headed) {
    *headed = len == strlen(head) && strncmp(s, head, len) == 0;
    if (!*headed) diag_at(d, l->src, l->begin, "this is no table of bench/peers/peers.py");
    return *headed;
  }
  if (p->n == MOST_PEERS) return diag_at(d, l->src, l->begin, "more than %d rows", MOST_PEERS);
  return split(l, &p->arena, d) && read_row(SS_PUSH(p->peer, p->n, p->cap), l, d);
}

bool bench_peers_read(struct bench_peers *p, const char *path, struct diag *d) {
  OWNED(source) src;
  *p = (struct bench_peers){.n = 0};
  if (!source_read(&src, path, most_file, d)) return false;
  bool ok = true, headed = false;
  for (size_t at = 0; at < src.len && ok;) {
    struct line l = {.src = &src, .begin = at, .end = at + strcspn(src.text + at, "\n")};
    ok = read_line(p, &headed, &l, d);
    at = l.end + 1;
  }
  if (ok && !headed) diag_set(d, "%s: error: this is no table of bench/peers/peers.py", path);
  return ok && headed;
}

void bench_peers_clear(struct bench_peers *p) {
  arena_clear(&p->arena);
  text_clear(&p->versions);
  free(p->peer);
  *p = (struct bench_peers){.n = 0};
}

void bench_peers_add(struct bench_table *t, const struct bench_peers *p) {
  for (size_t i = 0; i < p->n; i++) {
    struct bench_row row = p->peer[i].row;
    row.capped = !row.failure && row.cases < t->cases;
    if (p->peer[i].job == t->job) bench_add_row(t, &p->peer[i].method, &row);
  }
}
