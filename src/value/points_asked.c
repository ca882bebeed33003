/* Where a claim is tried: its attribute "points". */
#include "claim/claim.h"
#include "names.h"
#include "sentence.h"
#include <string.h>

static bool read_spec(struct point_spec *s, const struct asked_points *at) {
  int ph = *at->phase ? word_find(at->phase, phase_name, N_PHASES) : PHASE_D;
  *s = (struct point_spec){.phase = (enum phase)ph, .n = at->n};
  s->realistic = strcmp(at->word, "realistic") == 0;
  s->admissible = s->realistic || strcmp(at->word, "admissible") == 0;
  int kind = s->admissible ? POINT_ORBIT : word_find(at->word, point_kind_word, N_POINT_KINDS);
  s->kind = (enum point_kind)kind;
  return kind < N_POINT_KINDS && ph < N_PHASES && s->n > 0;
}

static const struct statement_record *its_record(struct judge *j, const struct claim *c) {
  const char *id = claim_get(c, "statement");
  struct view view = claim_view(j->model, c);
  view.control = c->control ? c->control->id_name : NULL;
  return id && j->model && j->model->system ? view_record(&view, id) : NULL;
}

bool claim_spans_phases(struct judge *j, const struct claim *c) {
  const struct statement_record *r = its_record(j, c);
  enum phase one = N_PHASES;
  bool several = false;
  for (int k = 0; r && k < r->n_stmts; k++) {
    const struct stmt *st = r->stmts[k];
    if (!st->range_hi || st->range_signs) continue;
    enum phase last, first = name_of_span(&last, st);
    if (first == N_PHASES) return false;
    several = several || first != last || (one != N_PHASES && one != first);
    one = first;
  }
  return several && claim_is_altered(j->model, c);
}

static bool is_time(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_SYM && name_goes_with_time(e->name);
}

/* Is a statement of the time t said of no range? */
static bool any_at_large(const struct statement_record *r) {
  bool any = false;
  for (int k = 0; k < r->n_stmts; k++)
    any = any || (r->stmts[k]->kind == STMT_RELATION && !r->stmts[k]->range_hi && stmt_any(r->stmts[k], is_time, NULL));
  return any;
}

/* A range of the time t must be the phase at whose points the claim is tried; of an overlay's text it says which that
   is, where nothing beside it is said without one, which may be meant of the claim's own phase. */
static bool ranges_are_met(struct point_spec *spec, int n, struct judge *j, const struct claim *c) {
  const struct statement_record *r = its_record(j, c);
  for (int k = 0; r && k < r->n_stmts; k++) {
    const struct stmt *st = r->stmts[k];
    if (!st->range_hi || st->range_signs) continue;
    enum phase said = name_of_range(st);
    for (int i = 0; i < n; i++) {
      if (spec[i].kind == POINT_PARAMS || said == spec[i].phase) continue;
      if (!claim_is_altered(j->model, c))
        return claim_error(j, c, "points", "the statement's range is not the phase of these points, without its ends");
      bool at_large = any_at_large(r);
      if (said == N_PHASES || at_large) {
        diag_beyond(j->d);
        return diag_at(j->d, r->src, st->range_lo->span.begin,
                       at_large ? "this range is said of one statement at the time t, and not of another beside it"
                                : "this range is no phase of the motion without its ends, nor several in a row");
      }
      spec[i].phase = said;
    }
  }
  return true;
}

int claim_points(struct point_spec *spec, int max, struct judge *j, const struct claim *c) {
  const char *list = claim_points_asked(c);
  struct asked_points at;
  int n = 0;
  bool ok = list || claim_error(j, c, "kind", "the attribute points is missing");
  while (ok && (list = claim_next_points(&at, list)) != NULL)
    ok = (n < max && read_spec(&spec[n++], &at)) ||
         claim_error(j, c, "points",
                     "points read \"params N\", \"flow PHASE N\", \"arcs [PHASE] N\", \"orbits [PHASE] N\" "
                     "or \"admissible [PHASE] N\"");
  for (int i = 0; ok && i < n; i++) {
    spec[i].finite = claim_says(c, "perturbation", "finite");
    spec[i].paper = j->model;
  }
  return ok && ranges_are_met(spec, n, j, c) ? n : -1;
}
