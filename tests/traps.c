#include "traps.h"

#include <stdlib.h>
#include <string.h>

#include "report/audit_shape.h"
#include "scratch.h"

struct filling {
  struct arena *arena;
  const struct table *traps;
  const char **id; /* of the claims, which hold their traps */
};

static void fill(const struct filling *f, char *record, const struct shape *shape, int k);

static void set_count(char *record, const struct member *m, size_t n) {
  int few = (int)n;
  if (m->cap_at)
    memcpy(record + m->n_at, &n, sizeof n);
  else
    memcpy(record + m->n_at, &few, sizeof few);
}

/* The i-th member of the record says the k-th trap. */
static void fill_member(const struct filling *f, char *record, const struct member *m, int i, int k) {
  char *at = record + m->at;
  const int all = f->traps->n, turn = i + k, n = m->cap_at ? all : m->most ? m->most : turn % 3 > 0;
  const long one = 1;
  const bool odd = turn % 2;
  const int word = m->n_words ? turn % (m->n_words + (m->need != MEMBER_NEEDED)) : 1;
  const void *pointer = *f->traps->row[k];
  switch (m->kind) {
  case MEMBER_STRING:
    if (m->need == MEMBER_NEEDED || turn % 4) memcpy(at, &pointer, sizeof pointer);
    break;
  case MEMBER_LONG:
    memcpy(at, &one, sizeof one);
    break;
  case MEMBER_BOOL:
    memcpy(at, &odd, sizeof odd);
    break;
  case MEMBER_INT:
  case MEMBER_WORD:
    memcpy(at, &word, sizeof word);
    break;
  case MEMBER_STRINGS:
    pointer = f->id + k + 1;
    memcpy(at, &pointer, sizeof pointer);
    set_count(record, m, (size_t)(all - k - 1));
    break;
  case MEMBER_RECORD:
  case MEMBER_RECORDS:
    if (!m->most) {
      size_t size = (size_t)n * m->of->size;
      char *made = m->cap_at ? calloc(1, size) : arena_alloc(f->arena, m->kind == MEMBER_RECORD ? m->of->size : size);
      memcpy(at, &made, sizeof made);
      at = made;
    }
    if (m->kind == MEMBER_RECORDS) set_count(record, m, (size_t)n);
    for (int j = 0; j < (m->kind == MEMBER_RECORD ? 1 : n); j++)
      fill(f, at + (size_t)j * m->of->size, m->of, m->cap_at ? j : k);
    break;
  case MEMBER_PART:
    fill(f, at, m->of, k);
    break;
  case MEMBER_TOLD:
    break;
  }
}

static void fill(const struct filling *f, char *record, const struct shape *shape, int k) {
  if (shape->blank) memcpy(record, shape->blank, shape->size);
  for (int i = 0; i < shape->n; i++) fill_member(f, record, &shape->member[i], i, k);
}

void traps_record(struct audit_result *r, const struct table *traps) {
  static const char *const faults[] = {"number", "formula", "notation", "argument", NULL};
  audit_result_init(r);
  const struct filling f = {&r->arena, traps, arena_alloc(&r->arena, (size_t)traps->n * sizeof *f.id)};
  for (int k = 0; k < traps->n; k++) f.id[k] = result_str(r, "%s%d%.100s", k % 3 ? "" : "eq-", k, *traps->row[k]);
  fill(&f, (char *)r, &audit_shape, 0);
  for (int k = 0; k < traps->n; k++) {
    r->findings[k].id = r->roots[k].id = r->consequences[k].failure = r->controls[k].claim = r->pairs[k].shared =
        f.id[k];
    if (k % 2 == 0) r->findings[k].fault = faults[k % 5];
    if (k % 2 && r->findings[k].n_evidence) ((struct evidence *)r->findings[k].evidence)->result = "differs";
    r->roots[k].claims = f.id + k;
    r->roots[k].n_claims = 1;
    r->roots[k].severity = (enum severity)(N_SEVERITIES * k / traps->n);
  }
  r->n_tables = 0; /* which are beside the page */
}
