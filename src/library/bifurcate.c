/* Changes of orbits along a line. */
#include <stdlib.h>

#include "base/arena.h"
#include "explore/bifurcate.h"
#include "library.h"

enum { MOST_DIGITS = 1000, STARTS = 257 };

struct numbers {
  struct ss_number low, high, t_b, t_c, trace;
};

struct ss_changes {
  struct dyn_bifurcations list;
  struct numbers *number;
  bool cut_short;
};

static void borrow(struct ss_changes *c) {
  c->number = ss_malloc((size_t)(c->list.n + 1) * sizeof *c->number);
  for (slong i = 0; i < c->list.n; i++) {
    const struct dyn_bifurcation *b = &c->list.at[i];
    c->number[i] = (struct numbers){{NULL, &b->low}, {NULL, &b->high}, {b->tb, NULL}, {b->tc, NULL}, {b->trace, NULL}};
  }
}

static int find(struct ss_changes *c, const struct scene_range *l, const struct ss_scene *s, size_t digits) {
  struct dyn_line line = {.params = s->s.value, .vary = l->vary, .from = l->from, .to = l->to};
  scene_static_friction(line.u_r, &s->s);
  int status = dyn_bifurcations_find(&c->list, &line, (slong)digits, STARTS);
  c->cut_short = status != SS_OK;
  borrow(c);
  if (!(status & SS_DOMAIN)) return SS_OK;
  return library_fail(SS_INPUT, "ss_changes_find: the ends cannot be told apart or held in double precision");
}

int ss_changes_find(ss_changes **out, const ss_scene *s, const char *parameter, const char *from, const char *to,
                    size_t digits) {
  if (!out) return library_argument(__func__, "no place for the changes");
  *out = NULL;
  int status = library_digits(__func__, digits, MOST_DIGITS);
  if (status) return status;
  LOCAL(scene_range, l);
  status = library_range(&l, s, parameter, from, to);
  if (!status && fmpq_equal(l.from, l.to)) status = library_fail(SS_INPUT, "%s: the ends are equal", __func__);
  if (!status) {
    *out = ss_malloc(sizeof **out);
    status = find(*out, &l, s, digits);
  }
  if (status && *out) {
    ss_changes_free(*out);
    *out = NULL;
  }
  return status;
}

void ss_changes_free(ss_changes *c) {
  if (!c) return;
  free(c->number);
  dyn_bifurcations_clear(&c->list);
  free(c);
}

static const struct dyn_bifurcation *change_of(const struct ss_changes *c, size_t i) {
  return c && i < (size_t)c->list.n ? &c->list.at[i] : NULL;
}

size_t ss_changes_count(const ss_changes *c) {
  return c ? (size_t)c->list.n : 0;
}

size_t ss_changes_missed(const ss_changes *c) {
  return c ? (size_t)c->list.missed : 0;
}

int ss_changes_cut_short(const ss_changes *c) {
  return c && c->cut_short;
}

/* What is asked of change i, and what is said where there is none. */
#define OF_CHANGE(type, function, value, none)                                                                         \
  type function(const ss_changes *c, size_t i) {                                                                       \
    return change_of(c, i) ? (value) : (none);                                                                         \
  }
OF_CHANGE(const char *, ss_change_kind, dyn_change_id[c->list.at[i].what], NULL)
OF_CHANGE(const ss_number *, ss_change_low, &c->number[i].low, NULL)
OF_CHANGE(const ss_number *, ss_change_high, &c->number[i].high, NULL)
OF_CHANGE(const ss_number *, ss_change_t_b, &c->number[i].t_b, NULL)
OF_CHANGE(const ss_number *, ss_change_t_c, &c->number[i].t_c, NULL)
OF_CHANGE(const ss_number *, ss_change_trace, &c->number[i].trace, NULL)
OF_CHANGE(size_t, ss_change_branch, (size_t)c->list.at[i].branch, 0)
OF_CHANGE(int, ss_change_proved, c->list.at[i].crosses, 0)
OF_CHANGE(int, ss_change_unique, c->list.at[i].unique, 0)

/* Orbit k of that side, of those that are not proved to be of another word; NULL beyond. */
static const struct dyn_orbit *beside(const struct ss_changes *c, size_t i, int side, size_t k) {
  const struct dyn_bifurcation *b = change_of(c, i);
  for (int j = 0; b && side >= 0 && side < 2 && j < b->beside[side].n; j++)
    if (b->beside[side].word[j] != TRUTH_FALSE && k-- == 0) return &b->beside[side].orbit[j];
  return NULL;
}

size_t ss_change_orbits(const ss_changes *c, size_t i, int side) {
  size_t n = 0;
  while (beside(c, i, side, n)) n++;
  return n;
}

enum ss_truth ss_change_stable(const ss_changes *c, size_t i, int side, size_t k) {
  const struct dyn_orbit *o = beside(c, i, side, k);
  return o ? (enum ss_truth)o->stable : SS_UNKNOWN;
}

enum ss_truth ss_change_admissible(const ss_changes *c, size_t i, int side, size_t k) {
  const struct dyn_orbit *o = beside(c, i, side, k);
  return o ? (enum ss_truth)o->admissible : SS_UNKNOWN;
}
