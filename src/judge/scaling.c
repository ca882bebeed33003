/* Scaling: (1)-(2) keep their form when V, the friction forces and all displacements are multiplied by one number,
   times, chi and eta staying as they are; so every formula must be homogeneous.  Degrees are inferred on the trees
   themselves, without values and without the model: terms added must have one degree, arguments of functions none.  A
   formula without degrees is wrong whatever it was to say; the two terms that do not fit are the certificate. */
#include <math.h>
#include <string.h>

#include "base/work.h"
#include "expr/map.h"
#include "judge.h"

enum { UNITS_OF_DEGREE = 4, UNITS_OF_READING = 100 }; /* of work: a node, a record elaborated */

/* A degree, a fraction where there are roots; any: of a literal zero. */
struct degree {
  bool any;
  double of;
};

static bool differ(struct degree a, struct degree b) {
  return !a.any && !b.any && fabs(a.of - b.of) > 1e-9; /* thirds are rounded */
}

struct scaling {
  const char *scaled; /* prefixes of the names of degree 1, separated by blanks or commas */
  const struct elaboration *el;
  struct text *fault;    /* the first one */
  struct expr_map known; /* a scalar is shared by all that contain it: its degree is kept, NaN for any */
};

static bool starts(const char *name, const char *prefixes) {
  size_t n;
  for (const char *p = list_item(&n, prefixes); p; p = list_item(&n, p + n))
    if (strncmp(name, p, n) == 0) return true;
  return false;
}

static const struct expr *shortened(struct expr_pool *p, const struct expr *e) {
  return e->n_args == 2 ? expr_tidy(p, e->kind, shortened(p, e->args[0]), shortened(p, e->args[1])) : e;
}

static void add_shortened(struct text *out, const struct expr *e) {
  OWNED(expr_pool) p = {.n = 0};
  expr_print(out, shortened(&p, e));
}

/* "a (degree 1) is what b (degree 2)"; without b, "a (degree 1) is what". */
static bool complain(struct scaling *s, const char *what, const struct expr *a, struct degree da, const struct expr *b,
                     struct degree db) {
  enum { CLIP = 90 };
  if (s->fault->len) return false;
  OWNED(text) x = {0}, y = {0};
  add_shortened(&x, a);
  if (b) add_shortened(&y, b);
  text_printf(s->fault, "%.*s%s (degree %g) is %s", CLIP, text_str(&x), x.len > CLIP ? "..." : "", da.of, what);
  if (b) text_printf(s->fault, " %.*s%s (degree %g)", CLIP, text_str(&y), y.len > CLIP ? "..." : "", db.of);
  return false;
}

static bool degree_of(struct degree *d, struct scaling *s, const struct expr *e);

/* Of a root of c_0 + c_1 x + ... the one with which all terms have the same degree. */
static bool degree_of_root(struct degree *d, struct scaling *s, const struct tape_root *r) {
  struct degree first = {true, 0}, next;
  *d = (struct degree){true, 0};
  for (int k = 0, from = 0; k < r->n_coeff; k++) {
    if (!degree_of(&next, s, r->coeff[k])) return false;
    if (next.any) continue;
    if (first.any) {
      first = next;
      from = k;
      continue;
    }
    if (d->any) *d = (struct degree){false, (first.of - next.of) / (k - from)};
    struct degree term = {false, next.of + (k - from) * d->of};
    if (!differ(first, term)) continue;
    bool told = s->fault->len > 0;
    complain(s, "a coefficient beside", r->coeff[from], first, r->coeff[k], next);
    if (!told)
      text_printf(s->fault, " of %s^%d, where the terms before need %s of degree %g", r->name, k, r->name, d->of);
    return false;
  }
  return true;
}

static bool degree_of_symbol(struct degree *d, struct scaling *s, const struct expr *e) {
  *d = (struct degree){false, starts(e->name, s->scaled) ? 1 : 0};
  for (size_t i = 0; i < s->el->n_roots; i++)
    if (strcmp(s->el->roots[i].name, e->name) == 0) return degree_of_root(d, s, &s->el->roots[i]);
  return true;
}

static bool degree_of_sum(struct degree *d, struct scaling *s, const struct expr *e) {
  struct degree a, b;
  if (!degree_of(&a, s, e->args[0]) || !degree_of(&b, s, e->args[1])) return false;
  if (differ(a, b)) return complain(s, "added to", e->args[0], a, e->args[1], b);
  *d = a.any ? b : a;
  return true;
}

/* 0, 0.0, 0e5 */
static bool is_zero(const char *decimal) {
  size_t n = strspn(decimal, "0.");
  return decimal[n] == '\0' || decimal[n] == 'e' || decimal[n] == 'E';
}

static bool degree_of_form(struct degree *d, struct scaling *s, const struct expr *e) {
  struct degree b = {false, 0};
  switch (e->kind) {
  case EXPR_NUM:
    *d = (struct degree){is_zero(e->name), 0};
    return true;
  case EXPR_SYM:
    return degree_of_symbol(d, s, e);
  case EXPR_ADD:
  case EXPR_SUB:
  case EXPR_HYPOT:
    return degree_of_sum(d, s, e);
  case EXPR_MUL:
  case EXPR_DIV:
    if (!degree_of(d, s, e->args[0]) || !degree_of(&b, s, e->args[1])) return false;
    d->any = d->any || (e->kind == EXPR_MUL && b.any);
    d->of += e->kind == EXPR_MUL ? b.of : -b.of;
    return true;
  default:
    break;
  }
  if (!degree_of(d, s, e->args[0])) return false;
  if (e->kind == EXPR_POW) d->of *= e->exponent;
  if (e->kind == EXPR_SQRT) d->of /= 2;
  bool function = e->kind == EXPR_SIN || e->kind == EXPR_COS || e->kind == EXPR_COT || e->kind == EXPR_EXP ||
                  e->kind == EXPR_SINC || e->kind == EXPR_STUMPFF;
  if (function || e->kind == EXPR_CALL) {
    if (!d->any && d->of != 0) return complain(s, "the argument of a function", e->args[0], *d, NULL, *d);
    *d = (struct degree){false, e->kind == EXPR_CALL && starts(e->name, s->scaled) ? 1 : 0};
  }
  return true;
}

/* The degree of an elaborated scalar; false with the fault set when it has none. */
static bool degree_of(struct degree *d, struct scaling *s, const struct expr *e) {
  const struct expr_slot *k = expr_map_find(&s->known, e);
  if (k) {
    *d = (struct degree){isnan(k->number), k->number};
    return true;
  }
  work_add(UNITS_OF_DEGREE);
  if (!degree_of_form(d, s, e)) return false;
  expr_map_put(&s->known, e)->number = d->any ? (double)NAN : d->of;
  return true;
}

static bool check_pair(struct scaling *s, const struct expr *a, const struct expr *b, enum relop op) {
  struct degree da, db = {true, 0};
  if (!degree_of(&da, s, a) || (b && !degree_of(&db, s, b))) return false;
  if (b && differ(da, db)) return complain(s, op == REL_EQ ? "set equal to" : "compared with", a, da, b, db);
  return true;
}

/* Is it a statement of the paper in whose place an overlay has another, by its record's id or its name? */
static bool is_overlaid(const struct model *m, const struct statement_record *r, const struct stmt *st) {
  bool overlaid = false;
  for (size_t i = 0; r->rank == RANK_PAPER && i < m->n_records; i++)
    overlaid = overlaid || (m->records[i].rank == RANK_USER && strcmp(m->records[i].id, r->id) == 0);
  for (size_t i = 0; r->rank == RANK_PAPER && (st->kind == STMT_DEFINE || st->kind == STMT_ROOT) && i < m->n_defs; i++)
    overlaid = overlaid || (m->defs[i].rank == RANK_USER && strcmp(m->defs[i].name, st->name) == 0 &&
                            strcmp(m->defs[i].section, r->section) == 0);
  return overlaid;
}

/* Every statement of a record; true also when the fault is set.  false: it cannot be read. */
static bool check_record(struct text *fault, const struct statement_record *r, struct view view, const char *scaled,
                         struct diag *d) {
  OWNED(elaboration) el;
  struct matrix a, b;
  work_add(UNITS_OF_READING);
  elaboration_init(&el, view, NULL, 0);
  struct scaling s = {.scaled = scaled, .el = &el, .fault = fault};
  bool ok = true;
  for (int i = 0; ok && i < r->n_stmts; i++) {
    const struct stmt *st = r->stmts[i];
    if (is_overlaid(view.model, r, st)) continue;
    if (st->kind == STMT_DEFINE) {
      ok = elaborate(&a, &el, st->sides[0], r->src, r->section, d);
      for (int k = 0; ok && k < a.rows * a.cols; k++) check_pair(&s, a.e[k], NULL, REL_EQ);
    }
    if (st->kind == STMT_ROOT) {
      ok = elaborate_text(&a, &el, st->name, st->name, r->section, d);
      if (ok) check_pair(&s, a.e[0], NULL, REL_EQ);
    }
    for (int k = 0; ok && st->kind == STMT_RELATION && k + 1 < st->n_sides; k++) {
      ok = elaborate_sides(&a, &b, &el, st, k, r->src, r->section, d);
      for (int e = 0; ok && e < a.rows * a.cols; e++) check_pair(&s, a.e[e], b.e[e], st->ops[k]);
    }
    const struct expr name = {.kind = EXPR_SYM, .name = st->range_var}, *end[] = {st->range_lo, st->range_hi};
    for (int k = 0; ok && st->range_hi && k < 2; k++) {
      ok = elaborate(&a, &el, end[k], r->src, r->section, d);
      if (ok) check_pair(&s, &name, a.e[0], REL_LT);
    }
  }
  expr_map_clear(&s.known);
  return ok;
}

/* All records of the paper, or the one that is named, each with its own text printed (or corrected: own is false); how
   many can be read. */
static long check_all(struct text *faults, struct judge *j, struct view view, bool own, const char *scaled,
                      const char *only) {
  long checked = 0;
  for (size_t i = 0; i < j->model->n_records; i++) {
    const struct statement_record *r = &j->model->records[i];
    if ((only && strcmp(r->id, only) != 0) || (j->touched && !j->touched[i])) continue;
    if (r->rank > RANK_USER && !(view.control && strcmp(r->record->id_name, view.control) == 0)) continue;
    struct view v = {j->model, LAYER_CORRECTED, own ? r->equation : NULL, view.control};
    const struct statement_record *seen = own ? r : view_record(&v, r->id);
    OWNED(text) fault = {0};
    struct diag unread; /* a text that cannot be read has its own claim */
    diag_init(&unread);
    checked += seen && check_record(&fault, seen, v, scaled, &unread);
    const char *where = *r->equation ? result_str(j->out, "(%s): ", r->equation) : result_str(j->out, "%s: ", r->id);
    if (fault.len && !strstr(text_str(faults), where)) /* once for each number */
      text_printf(faults, "%s%s%s", faults->len ? ". " : "", where, text_str(&fault));
  }
  return checked;
}

/* Of the prefixes "F_ u_": F_i and u_i have the same dimension. */
static const char *names_with_unit(struct judge *j, const char *prefixes) {
  struct text t = {0};
  for (const char *c = prefixes; *c; c++) {
    text_add_n(&t, c, 1);
    if (*c == '_' && (c[1] == ' ' || !c[1])) text_add_char(&t, 'i');
    if (*c == ' ') text_add(&t, "and ");
  }
  text_add(&t, " have the same dimension");
  return result_take(j->out, &t);
}

/* --- A correction of the names that scale --- */

static bool starts_any(const char *names, const char *full) {
  size_t n;
  for (const char *p = list_item(&n, names); p; p = list_item(&n, p + n)) {
    char one[32];
    snprintf(one, sizeof one, "%.*s", (int)(n < sizeof one ? n : sizeof one - 1), p);
    if (!starts(one, full)) return false;
  }
  return true;
}

/* The first symbol of the tree to which the two lists give other degrees. */
static const char *differing(const struct expr *e, const char *list, const char *full) {
  if (e->kind == EXPR_SYM && starts(e->name, list) != starts(e->name, full)) return e->name;
  for (int i = 0; i < e->n_args; i++) {
    const char *name = differing(e->args[i], list, full);
    if (name) return name;
  }
  return NULL;
}

/* What the corrected names say of the record must be what the names of the claim repaired-as, with which every formula
   is homogeneous, say of it.  false with j->d set when there is no such claim. */
static bool check_repaired(struct text *faults, struct judge *j, const struct claim *c, const char *repaired,
                           const struct statement_record *r) {
  const struct claim *by = claim_named(j->claims, claim_get(c, "repaired-as"));
  const char *full = by && claim_kind(by) == KIND_SCALING ? claim_get(by, "scaled") : NULL, *name = NULL;
  if (!full || !r) return claim_error(j, c, "repaired-as", "the correction is judged by another claim of kind scaling");
  if (!starts_any(repaired, full)) text_printf(faults, "%s: not all of %s scale in other formulas", r->id, repaired);
  for (int i = 0; i < r->n_stmts && !name; i++)
    for (int k = 0; k < r->stmts[i]->n_sides && !name; k++) name = differing(r->stmts[i]->sides[k], repaired, full);
  if (name)
    text_printf(faults, "%s%s: %s has another degree in the other formulas", faults->len ? ". " : "", r->id, name);
  return true;
}

bool judge_scaling(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *scaled = claim_get(c, "scaled"), *repaired = claim_get(c, "repaired"), *only = claim_get(c, "statement");
  if (!scaled) return claim_error(j, c, "kind", "the attribute scaled is missing");
  if (only && !view_record(&view, only)) return claim_error(j, c, "statement", "there is no such record");
  OWNED(text) faults = {0};
  const char *printed = NULL; /* what is found in the printed text */
  bool corrected_alone =
      view.control || j->effort == EFFORT_REFUTE; /* controls and mutants damage the corrected text */
  for (int pass = corrected_alone ? 1 : 0; pass < 2; pass++) {
    bool own = pass == 0;
    text_reset(&faults);
    long checked = check_all(&faults, j, view, own, !own && repaired ? repaired : scaled, only);
    if (!own && repaired && claim_get(c, "repaired-as") &&
        !check_repaired(&faults, j, c, repaired, only ? view_record(&view, only) : NULL))
      return false;
    struct route_result w = {"algebra", faults.len ? ROUTE_DIFFERS : ROUTE_AGREES, true, checked};
    finding_add_route(f, j->out, w, own ? "own text printed, the rest corrected" : layer_name[LAYER_CORRECTED], -1,
                      NULL,
                      faults.len ? result_copy(j->out, text_str(&faults))
                      : only     ? "the formula is homogeneous"
                                 : "every formula is homogeneous");
    if (own && faults.len) {
      printed = result_copy(j->out, text_str(&faults));
      certificate_add(&f->certificate, j->out, "degrees", printed);
    }
    if (own || corrected_alone)
      f->verdict = verdict_of(&w, 1, true);
    else if (f->verdict == VERDICT_REFUTED && (repaired || strcmp(printed, text_str(&faults)) != 0)) {
      f->correction =
          repaired ? names_with_unit(j, repaired) : "the same formulas with the corrections proposed in this report";
      f->correction_verdict = verdict_of(&w, 1, true);
    }
    if (f->verdict != VERDICT_REFUTED) break;
  }
  return true;
}
