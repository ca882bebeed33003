/* Titles made from attributes, kind by kind. */
#include "claim/checks.h"
#include "claim/claim.h"
#include "oracle.h"
#include "title_impl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is longer is said by number. */
enum { MOST_FORMULA = 110, MOST_TITLE = 150, MOST_ARGUMENT = 160, MOST_STATED = 80 };

typedef bool maker(struct text *out, const struct title *t);

static bool missing(const struct title *t) {
  return !t->d->set && claim_mistake(t->c, "", t->d, "a title is missing; the attributes of this kind make none here");
}

/* Of kinds whose titles are the same but for attributes. */
static const char *const sentences[N_KINDS] = {
    [KIND_CLOSURE] = "the printed numbers are those of a periodic solution",
    [KIND_NOTATION] = "{reads} can be read as a formula",
    [KIND_SEQUENCE] = "one period consists of {word}, in this order,",
    [KIND_LAW] = "{equation} gives the friction of the {mass} mass while it slips, while it sticks and where the "
                 "restoring force exceeds its limit",
    [KIND_REPORT] = "the value of tr(J)",
};
static const char limits[] =
    "{equation} gives the friction of the {mass} mass where the restoring force is equal to its limit";

static bool make_sentence(struct text *out, const struct title *t) {
  struct diag unmade = {0};
  const struct title quiet = {t->m, t->c, t->s, &unmade};
  const char *text = claim_get(t->c, "limits") ? limits : sentences[claim_kind(t->c)];
  return title_expand(out, &quiet, text) || missing(t);
}

/* Of which data: those of the paper's example, or of a scene that is not about it. */
static const char *on_data(const struct title *t) {
  return !t->s || scene_is_example(t->s) ? " in the example" : " for the data of this scene";
}

static bool make_of_data(struct text *out, const struct title *t) {
  bool ok = make_sentence(out, t);
  if (ok) text_add(out, on_data(t));
  return ok;
}

/* The record that is the claim's statement, as it is judged; NULL with t->d set. */
static const struct statement_record *its_statement(const struct title *t) {
  const char *id = claim_get(t->c, "statement");
  const struct statement_record *r = title_judged(t, id, strlen(id));
  if (!r) title_no_record(t, "statement", id);
  return r;
}

/* --- Statements --- */

/* u_1 = u_s1 eps, where eps (V - x_1') > 0: each for eps = +1 and -1. */
static bool is_of_signs(const struct statement_record *r) {
  for (int k = 0; k < r->n_stmts; k++)
    if (!r->stmts[k]->range_signs) return false;
  return r->n_stmts > 0;
}

/* What a record states, by its formulas where these take most characters at most; else by its number, or by its first
   formula where the number is not its own.  *verb says that it holds, and is empty for formulas, which say it
   themselves. */
static void stated(struct text *out, const char **verb, const struct title *t, const struct statement_record *r,
                   size_t most) {
  OWNED(text) formulas = {0};
  t->m->system && !is_of_signs(r) ? title_formulas(&formulas, t, r) : title_conditional(&formulas, t, r);
  const char *note = title_note(r, false);
  *verb = note && title_is_plural(note) ? " hold" : " holds";
  if (note)
    text_add(out, note);
  else if (formulas.len <= most || !*r->equation) {
    text_add(out, text_str(&formulas));
    *verb = "";
  } else if (title_owns_number(t, r))
    text_printf(out, "what (%s) states", r->equation);
  else {
    title_first_formula(out, r);
    text_printf(out, " and what follows it in (%s)", r->equation);
    *verb = " hold";
  }
}

static bool make_identity(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  const char *points = claim_points_asked(t->c);
  if (!r) return false;
  const char *verb;
  OWNED(text) where = {0};
  if (claim_says(t->c, "perturbation", "finite")) text_add(&where, " for finite perturbations");
  if (points) title_place(&where, t, points);
  if (!t->m->system) title_domain(&where, t, r);
  if (claim_says(t->c, "own", "-")) text_add(&where, ", with all that it uses corrected");
  size_t most = MOST_TITLE - where.len;
  stated(out, &verb, t, r, most < MOST_FORMULA ? most : MOST_FORMULA);
  text_printf(out, "%s%s", verb, text_str(&where));
  return true;
}

/* The paper's definitions under the claim's number, where it names no statement. */
static bool make_definition(struct text *out, const struct title *t) {
  OWNED(title_list) l = {.n = 0};
  const struct view printed = {t->m, LAYER_PRINTED, NULL, NULL};
  const char *unused;
  for (size_t i = 0; i < t->m->n_records; i++) {
    const struct statement_record *r = &t->m->records[i];
    if (claim_is_about(r, t->c) && view_record(&printed, r->id) == r)
      stated(title_list_next(&l), &unused, t, r, MOST_FORMULA);
  }
  title_list_write(out, &l);
  return l.n > 0 || missing(t);
}

static bool make_matrix(struct text *out, const struct title *t) {
  const char *value = claim_get(t->c, "value");
  if (!value) return missing(t);
  const struct oracle *o = oracle_find(value);
  const char *what = o && t->m->system ? o->what : NULL;
  if (!what && !title_defines(t->m, value, strcspn(value, "("))) return missing(t);
  if (!what) {
    text_printf(out, "%s is the quantity of the system that the paper is about", value);
    return true;
  }
  text_printf(out, "%s is ", value);
  const char *slot = strstr(what, "%s");
  text_add_n(out, what, slot ? (size_t)(slot - what) : strlen(what));
  if (slot) title_phases(out, &o->phase, 1);
  return true;
}

static bool make_sharp(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  struct asked_points at;
  enum phase ranged;
  if (!r) return false;
  if (!claim_next_points(&at, claim_points_asked(t->c))) return missing(t);
  OWNED(text) formulas = {0};
  title_formulas(&formulas, t, r);
  bool one = r->n_stmts == 1 && r->stmts[0]->n_sides == 2;
  text_printf(out, "%s%s becomes an equality at one end of ", one ? "" : "each inequality of ", text_str(&formulas));
  if (!title_range(&ranged, t))
    title_phases_listed(out, at.phase);
  else if (ranged < N_PHASES)
    title_phases(out, &ranged, 1);
  else
    text_add(out, "its range");
  return true;
}

static bool names_friction(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_SYM && strncmp(e->name, "u_r", 3) == 0;
}

/* On an example that gives no u_r1 and u_r2 nothing can be said of them (judge/inequality.c). */
static bool make_inequality(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  if (!r) return false;
  bool friction = false;
  for (int k = 0; k < r->n_stmts && t->m->system; k++)
    friction = friction || stmt_any(r->stmts[k], names_friction, NULL);
  if (friction && *r->equation)
    text_printf(out, "the inequalities of (%s) that do not contain u_r1 or u_r2 hold", r->equation);
  else {
    const char *verb;
    stated(out, &verb, t, r, MOST_FORMULA);
    text_add(out, verb);
  }
  t->m->system ? text_add(out, on_data(t)) : title_domain(out, t, r);
  return true;
}

static bool make_index_range(struct text *out, const struct title *t) {
  const char *letter = claim_get(t->c, "letter"), *range = claim_get(t->c, "range");
  if (!letter || !range) return missing(t);
  char *end;
  long first = strtol(range, &end, 10), last = strtol(end, NULL, 10);
  text_printf(out, "the indices of %s_ij run from %ld to %ld", letter, first, last);
  return true;
}

/* --- Numbers --- */

/* The decimal behind the last relation of a quotation's formula: "2.7844" of "$e_1 = 2.7844$". */
static bool quoted_number(struct text *out, const char *quote) {
  const char *at = quote ? strpbrk(quote, "=<>") : NULL;
  for (const char *p = at; p; p = strpbrk(p + 1, "=<>")) at = p;
  if (!at) return false;
  at += 1 + strspn(at + 1, " ");
  size_t n = strspn(at, "-0123456789.");
  while (n && at[n - 1] == '.') n--;
  text_add_n(out, at, n);
  return n > 0;
}

static bool make_number(struct text *out, const struct title *t) {
  const char *number = claim_get(t->c, "number"), *from = claim_get(t->c, "from"),
             *relation = claim_get(t->c, "relation"), *quote = claim_get(t->c, "quote");
  OWNED(text) formula = {0}, decimal = {0};
  bool ok = number && from && quoted_number(&decimal, quote) && title_formula(&formula, t, "formula");
  if (ok) {
    const struct printed_number *printed = t->s ? scene_printed(t->s, number) : NULL;
    const struct paper_name name = paper_name(number);
    if (relation)
      text_printf(out, "the %s bound %s of %s", *relation == '<' ? "upper" : "lower", text_str(&formula), name.is);
    else
      text_add(out, name.is);
    text_printf(out, "%s%s", relation ? " is " : " = ", printed ? printed->decimal : text_str(&decimal));
    if (!relation && strcmp(name.is, text_str(&formula)) != 0)
      text_printf(out, ", the value of %s", text_str(&formula));
    if (strcmp(from, "orbit") == 0)
      text_printf(out, " on %s's orbit", printed ? scene_data_of(t->s) : "the example");
    else
      text_add(out, " at the printed numbers");
  }
  return ok || t->d->set ||
         claim_mistake(t->c, "", t->d,
                       "a title is missing; that of a number is made from number, from, formula and a quote in which "
                       "the decimal stands behind =, < or >");
}

/* --- Arguments and how many equations there are --- */

/* What holds whatever the other premises say is no part of an equivalence: "..., where z_10 - chi z_20 = ...". */
static bool argue_where(struct text *out, struct title_parts *with, const struct title *t) {
  text_add(out, ", where ");
  with->items = TITLE_EQUATIONS;
  return title_parts_write(out, with, t, "premises");
}

static bool argue(struct text *out, const struct title *t, enum title_detail conclusions, enum title_detail reasons) {
  struct title_parts conclusion = {.detail = conclusions, .one = N_PHASES};
  const char *premises = claim_get(t->c, "premises");
  bool both = claim_says(t->c, "converse", "yes");
  if (!title_parts_scan(&conclusion, t, "conclusion")) return false;
  struct title_parts with = conclusion;
  with.detail = reasons;
  if (!title_parts_scan(&with, t, "premises")) return false;
  conclusion.several = with.several;
  if (!title_parts_write(out, &conclusion, t, "conclusion")) return false;
  size_t length = out->len;
  bool plural = title_is_plural(text_str(out));
  if (premises)
    text_add(out, both     ? plural ? " are equivalent to " : " is equivalent to "
                  : plural ? " follow from "
                           : " follows from ");
  else
    text_add(out, plural ? " hold" : " holds");
  size_t from = out->len;
  bool apart = both && title_has_premises(t, TITLE_EQUATIONS) && title_has_premises(t, TITLE_INEQUALITIES);
  with.items = apart ? TITLE_INEQUALITIES : TITLE_ALL;
  if (premises && !title_parts_write(out, &with, t, "premises")) return false;
  bool same = premises && out->len - from == length && strncmp(text_str(out), text_str(out) + from, length) == 0;
  if (same && reasons == TITLE_FORMULAS) { /* the same formulas at two places of the paper */
    text_reset(out);
    return argue(out, t, conclusions, TITLE_BRIEF);
  }
  if (with.one != N_PHASES && !with.several) {
    text_add(out, " in ");
    title_phases(out, &with.one, 1);
  }
  if (claim_says(t->c, "over", "scene")) text_add(out, on_data(t));
  if (claim_says(t->c, "over", "orbits")) text_add(out, " on every orbit");
  return !apart || argue_where(out, &with, t);
}

/* With as many formulas as there is room for. */
static bool make_argument(struct text *out, const struct title *t) {
  if (!claim_get(t->c, "conclusion")) return missing(t);
  OWNED(text) title = {0};
  bool ok = argue(&title, t, TITLE_FORMULAS, TITLE_FORMULAS);
  for (int both = 0; ok && both < 2 && title.len > MOST_ARGUMENT; both++) {
    text_reset(&title);
    ok = argue(&title, t, both ? TITLE_BRIEF : TITLE_FORMULAS, TITLE_BRIEF);
  }
  if (ok) text_add(out, text_str(&title));
  return ok;
}

static bool make_rank(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  const char *rank = claim_get(t->c, "rank"), *unknowns = claim_get(t->c, "unknowns");
  if (!r) return false;
  if (!rank || !unknowns) return missing(t);
  OWNED(text) name = {0};
  const char *verb;
  if (title_owns_number(t, r))
    title_name(&name, t, r);
  else
    stated(&name, &verb, t, r, MOST_STATED);
  text_printf(out, "%s %s ", text_str(&name), title_is_plural(text_str(&name)) ? "amount to" : "amounts to");
  title_count(out, strtol(rank, NULL, 10));
  text_add(out, strcmp(rank, "1") == 0 ? " equation for " : " functionally independent equations for ");
  title_listed(out, unknowns, ',');
  return true;
}

/* "(45)" or "(45) and (46)": the equation numbers of the records, each once; what one without a number states. */
static bool numbers_of(struct text *out, const struct title *t, const char *list) {
  const struct view v = claim_view(t->m, t->c);
  OWNED(title_list) l = {.n = 0};
  const char *unused;
  char id[64];
  bool ok = true;
  while (ok && (list = claim_next_item(id, sizeof id, list)) != NULL) {
    const struct statement_record *r = view_record(&v, id);
    ok = r != NULL;
    if (ok && *r->equation) text_printf(title_list_next(&l), "(%s)", r->equation);
    if (ok && !*r->equation) stated(title_list_next(&l), &unused, t, r, MOST_STATED);
  }
  title_list_write(out, &l);
  return ok || missing(t);
}

static bool make_defined(struct text *out, const struct title *t) {
  const char *list = claim_get(t->c, "statements");
  if (!list) return missing(t);
  text_add(out, "the expressions in ");
  if (!numbers_of(out, t, list)) return false;
  text_printf(out, " are defined %s",
              claim_says(t->c, "over", "parameters") ? "for all parameters"
              : claim_says(t->c, "over", "orbits")   ? "on every periodic solution"
                                                     : "on every admissible periodic solution");
  return true;
}

static bool make_reach(struct text *out, const struct title *t) {
  const char *absent = claim_get(t->c, "absent");
  struct title_parts p = {.one = N_PHASES};
  if (!claim_get(t->c, "statements") || !absent) return missing(t);
  if (!title_parts_write(out, &p, t, "statements")) return false;
  text_add(out, title_is_plural(text_str(out)) ? " contain none of " : " contains none of ");
  title_listed(out, absent, ',');
  return true;
}

/* "omega t_d" */
static bool range_angle(struct text *out, const struct title *t, enum phase ph) {
  const char *frequency = claim_get(t->c, "frequency");
  if (frequency && !title_formula(out, t, "frequency")) return false;
  text_printf(out, "%s%s", frequency ? " " : "", name_time[ph]);
  return true;
}

/* A formula before a stroke of division: a sum in parentheses. */
static bool range_numerator(struct text *out, const struct title *t, const char *attribute) {
  OWNED(text) s = {0};
  bool ok = title_formula(&s, t, attribute), sum = false;
  int depth = 0;
  for (const char *p = text_str(&s); ok && *p; p++) {
    depth += (*p == '(') - (*p == ')');
    sum = sum || (depth == 0 && (strncmp(p, " + ", 3) == 0 || strncmp(p, " - ", 3) == 0));
  }
  if (ok) text_printf(out, sum ? "(%s)" : "%s", text_str(&s));
  return ok;
}

/* " <= 2 (pi - arctan(odd/(even)))" */
static bool range_limit(struct text *out, const struct title *t) {
  if (!claim_get(t->c, "even")) {
    text_add(out, " <= pi");
    return true;
  }
  text_add(out, " <= 2 (pi - arctan(");
  if (!range_numerator(out, t, "odd")) return false;
  text_add(out, "/(");
  if (!title_formula(out, t, "even")) return false;
  text_add(out, ")))");
  return true;
}

/* Where the condition holds: the premise, and up to which length of the phase. */
static bool range_where(struct text *out, const struct title *t, struct title_parts *p, enum phase ph) {
  bool limited = claim_get(t->c, "odd") != NULL, premise = claim_get(t->c, "premises") != NULL;
  if (!limited && !premise) {
    text_printf(out, " for every %s > 0", name_time[ph]);
    return true;
  }
  text_add(out, " if and only if ");
  if (premise && !title_parts_write(out, p, t, "premises")) return false;
  if (!limited) return true;
  text_add(out, premise ? " and " : "");
  if (!range_angle(out, t, ph)) return false;
  bool rate = claim_get(t->c, "rate") != NULL;
  text_add(out, rate ? " modulo 2 pi" : "");
  if (!range_limit(out, t)) return false;
  if (!rate) return true;
  text_add(out, " and ");
  if (!title_parts_write(out, p, t, "conclusion")) return false;
  text_add(out, " at every maximum before the end");
  return true;
}

/* An overlay may say what a range is about of several phases, or of none. */
static bool make_range(struct text *out, const struct title *t) {
  struct title_parts p = {.one = N_PHASES};
  struct cited at;
  if (!claim_next_cited(&at, claim_get(t->c, "conclusion"))) return missing(t);
  if (!title_parts_scan(&p, t, "conclusion") || !title_parts_write(out, &p, t, "conclusion")) return false;
  if (p.one == N_PHASES && title_judged(t, at.id, strlen(at.id))->rank == RANK_USER) {
    text_add(out, " is a condition on the duration of one phase");
    return true;
  }
  if (p.one == N_PHASES)
    return claim_mistake(t->c, "conclusion", t->d,
                         "a range is of one phase: \"ID Gamma\", or what is said for t in (t_a, t_a + t_b)");
  if (title_moves(t, "conclusion")) {
    text_add(out, " throughout ");
    title_phases(out, &p.one, 1);
  }
  return range_where(out, t, &p, p.one);
}

static bool make_constraints(struct text *out, const struct title *t) {
  struct title_parts p = {.detail = TITLE_NUMBERS, .one = N_PHASES, .several = true};
  if (!claim_get(t->c, "constraints")) return missing(t);
  if (!title_parts_write(out, &p, t, "constraints")) return false;
  text_add(out, " are all the constraints");
  return true;
}

/* "tr(J) < -1 or tr(J) > 1" of -1 < tr(J) < 1. */
static void reversed(struct text *out, const struct statement_record *r) {
  static const char *const other[] = {" is not ", " > ", " > ", " < ", " < "}; /* by relop */
  static const char *const turned[] = {" is not ", " < ", " < ", " > ", " > "};
  const char *sep = "";
  for (int k = 0; k < r->n_stmts; k++)
    for (int i = 0; r->stmts[k]->kind == STMT_RELATION && i + 1 < r->stmts[k]->n_sides; i++, sep = " or ") {
      const struct stmt *s = r->stmts[k];
      bool turn = i == 0 && s->n_sides > 2; /* what lies between two bounds is said first */
      text_add(out, sep);
      expr_plain(out, s->sides[i + turn]);
      text_add(out, (turn ? turned : other)[s->ops[i]]);
      expr_plain(out, s->sides[i + !turn]);
    }
}

static bool make_criterion(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  const char *side = claim_get(t->c, "side");
  if (!r) return false;
  text_add(out, "admissible periodic solutions are ");
  if (!side || strcmp(side, "inside") == 0) {
    text_add(out, "conditionally stable where ");
    title_formulas(out, t, r);
  }
  if (!side) text_add(out, " and ");
  if (!side || strcmp(side, "outside") == 0) {
    bool says_so = side && r->rank != RANK_USER; /* what an overlay says instead may be another thing */
    text_add(out, "unstable where ");
    if (says_so) text_add(out, "an eigenvalue of J is outside the unit circle, that is, ");
    reversed(out, r);
  }
  return true;
}

/* --- What is made of phases --- */

/* "chi = 4/5, e1 = 2" with the paper's e_1. */
static void listed_as_printed(struct text *out, const char *at) {
  OWNED(text) named = {0};
  for (const char *s = at; *s; s++) {
    text_add_char(&named, *s);
    if (*s == 'e' && (s[1] == '1' || s[1] == '2')) text_add_char(&named, '_');
  }
  title_listed(out, text_str(&named), ',');
}

/* "(18) has exactly one solution with positive times and t_c up to 20 in the example". */
static bool make_solutions(struct text *out, const struct title *t) {
  const struct statement_record *r = its_statement(t);
  const char *count = claim_get(t->c, "count"), *every = claim_get(t->c, "every"), *at = claim_get(t->c, "at");
  const char *until = claim_get(t->c, "until"), *kept = claim_get(t->c, "kept");
  OWNED(text) name = {0};
  if (r) title_name(&name, t, r);
  const char *of = text_str(&name), *has = title_is_plural(of) ? "have" : "has";
  if (r && claim_get(t->c, "given")) {
    text_printf(out, "%s %s a solution with ", of, has);
    title_listed(out, claim_get(t->c, "given"), ',');
    if (claim_get(t->c, "constraints")) text_add(out, " that satisfies the constraints of its phases");
    text_printf(out, " for chi, eta and V of %s", t->s ? scene_data_of(t->s) : "the example");
    return true;
  }
  if (!r || (!count && !every)) return missing(t);
  long n = count ? strtol(count, NULL, 10) : 0;
  if (!count) text_printf(out, "every %ssolution of %s", kept ? "admissible " : "", of);
  if (count) text_printf(out, "%s %s %s", of, has, n ? "exactly " : "no");
  if (count && n) title_count(out, n);
  if (count) text_printf(out, "%s %s", kept ? " admissible" : "", n < 2 ? "solution" : "solutions");
  if (!kept) text_printf(out, " with positive times and t_c up to %s", until ? until : "");
  bool first = claim_says(t->c, "every", "first");
  if (every)
    text_add(out, first ? " takes the first roots of the switching functions" : " is a motion under Coulomb's law");
  text_add(out, at ? " at " : on_data(t));
  if (at) listed_as_printed(out, at);
  return true;
}

/* --- Notation --- */

char title_index(const char *formula) {
  for (const char *s = strchr(formula, '_'); s; s = strchr(s + 1, '_'))
    if (s[1] >= 'i' && s[1] <= 'k' && !char_is_word(s[2])) return s[1];
  return 0;
}

/* "the first mass is written in one way", "different symbols stand for a stiffness matrix and the stiffness of a
   spring"; without such a list, of a text that is read, or of an index in it. */
static bool make_notation(struct text *out, const struct title *t) {
  const char *stands_for = claim_get(t->c, "stands-for"), *reads = claim_get(t->c, "reads");
  char index = reads ? title_index(reads) : 0;
  if (!stands_for && index) {
    text_printf(out, "the index %c in ", index);
    return title_expand(out, t, "{reads} has a value");
  }
  if (!stands_for) return make_sentence(out, t);
  OWNED(text) things = {0};
  int n = title_listed(&things, stands_for, ';');
  text_printf(out, n == 1 ? "%s is written in one way" : "different symbols stand for %s", text_str(&things));
  return true;
}

static bool make_scaling(struct text *out, const struct title *t) {
  const char *scaled = claim_get(t->c, "scaled"), *statement = claim_get(t->c, "statement");
  const struct statement_record *r = statement ? its_statement(t) : NULL;
  if (!scaled || (statement && !r)) return missing(t);
  if (r)
    title_name(out, t, r);
  else
    text_add(out, "every formula");
  OWNED(title_list) l = {.n = 0};
  size_t len;
  for (const char *p = list_item(&len, scaled); p; p = list_item(&len, p + len)) {
    struct text *name = title_list_next(&l);
    text_add_n(name, p, len);
    if (p[len - 1] == '_') text_add_char(name, 'i');
  }
  bool lengths = t->m->system; /* else nothing is known of dimensions */
  text_add(out, lengths ? " is dimensionally homogeneous with " : " is homogeneous in ");
  title_list_write(out, &l);
  if (lengths) text_printf(out, " as %s and everything else as pure numbers", l.n == 1 ? "a length" : "lengths");
  return true;
}

/* --- Behaviour --- */

static const char breaks[] =
    "a transition from {transition} occurs where the force on a mass reaches its {limit} friction";

static bool make_behaviour(struct text *out, const struct title *t) {
  const struct behaviour_check *check = claim_check(t->c);
  if (!check) return missing(t);
  return title_expand(out, t, claim_says(t->c, "transition", "stick to slip") ? breaks : check->says);
}

static maker *const makers[N_KINDS] = {
    [KIND_DEFINITION] = make_definition, [KIND_MATRIX] = make_matrix,     [KIND_IDENTITY] = make_identity,
    [KIND_INEQUALITY] = make_inequality, [KIND_SHARP] = make_sharp,       [KIND_INDEX_RANGE] = make_index_range,
    [KIND_NUMBER] = make_number,         [KIND_CLOSURE] = make_sentence,  [KIND_CRITERION] = make_criterion,
    [KIND_BEHAVIOUR] = make_behaviour,   [KIND_ARGUMENT] = make_argument, [KIND_NOTATION] = make_notation,
    [KIND_SCALING] = make_scaling,       [KIND_REACH] = make_reach,       [KIND_RANK] = make_rank,
    [KIND_DEFINED] = make_defined,       [KIND_SEQUENCE] = make_of_data,  [KIND_CONSTRAINTS] = make_constraints,
    [KIND_RANGE] = make_range,           [KIND_LAW] = make_sentence,      [KIND_SOLUTIONS] = make_solutions,
    [KIND_REPORT] = make_of_data,
};

static bool title_made(struct text *out, const struct title *t) {
  enum kind kind = claim_kind(t->c);
  return kind < N_KINDS && makers[kind] ? makers[kind](out, t) : missing(t);
}

/* A title by hand where the attributes make one would be a second statement of what they say. */
static bool is_given_in_vain(const struct title *t) {
  const struct field *given = record_field(t->c->record, "title");
  struct diag unmade = {0};
  OWNED(text) made = {0};
  const struct title quiet = {t->m, t->c, t->s, &unmade};
  bool vain = given && title_made(&made, &quiet);
  if (vain)
    diag_at(t->d, &t->c->file->src, given->key.begin, "%s: its attributes make the title; leave it out", t->c->id);
  return vain;
}

bool titles_check(const struct model *m, const struct claims *claims, struct diag *d) {
  OWNED(text) title = {0};
  bool ok = true;
  for (size_t i = 0; ok && i < claims->n; i++) {
    text_reset(&title);
    const struct title t = {m, &claims->claim[i], NULL, d};
    ok = claim_title(&title, m, &claims->claim[i], NULL, d) && !is_given_in_vain(&t);
  }
  return ok;
}

bool claim_title(struct text *out, const struct model *m, const struct claim *c, const struct scene *s,
                 struct diag *d) {
  const struct title t = {m, c, s, d};
  const struct field *given = record_field(c->record, "title");
  if (given) return title_given(out, &t, given);
  return title_made(out, &t);
}

bool claim_title_records(struct text *out, const struct model *m, const struct claim *c, const char *attribute,
                         struct diag *d) {
  struct title_parts p = {.detail = TITLE_NUMBERS, .one = N_PHASES, .several = true};
  const struct title t = {m, c, NULL, d};
  return title_parts_write(out, &p, &t, attribute);
}
