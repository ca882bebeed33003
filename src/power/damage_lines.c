/* Damages of the lines of claims and controls: items of lists, words of a few, lines left out. */
#include <stdio.h>
#include <string.h>

#include "damages_impl.h"
#include "record/result.h"
#include "record/routes.h"

/* --- Lists between commas --- */

enum { MAX_ITEMS = 64 };
struct items {
  struct span item[MAX_ITEMS];
  int n;
};

static void read_items(struct items *l, const struct maker *k) {
  struct span v = k->field->value;
  l->n = 0;
  for (size_t i = v.begin; i < v.end && l->n < MAX_ITEMS;) {
    size_t begin = i, end;
    while (i < v.end && k->text[i] != ',') i++;
    end = i++;
    while (begin < end && strchr(" \n", k->text[begin])) begin++;
    while (end > begin && strchr(" \n", k->text[end - 1])) end--;
    l->item[l->n++] = (struct span){begin, end};
  }
}

static void drop_items(struct maker *k, const struct items *l) {
  for (int i = 0; i < l->n && l->n > 1; i++)
    if (i + 1 < l->n)
      maker_put(k, l->item[i].begin, l->item[i + 1].begin, "");
    else
      maker_put(k, l->item[i - 1].end, l->item[i].end, "");
}

void damage_order(struct maker *k) {
  struct items l;
  OWNED(text) t = {0};
  read_items(&l, k);
  for (int i = 0; i + 1 < l.n; i++) {
    struct span a = l.item[i], b = l.item[i + 1];
    text_reset(&t);
    text_add_n(&t, k->text + b.begin, b.end - b.begin);
    text_add(&t, ", ");
    text_add_n(&t, k->text + a.begin, a.end - a.begin);
    maker_add(k, a.begin, b.end, text_str(&t), t.len, "the order of the list has no meaning");
  }
}

/* --- Neighbours --- */

/* The record of the paper after the one of that name, or NULL. */
static const char *next_record(const struct model *m, const char *name, size_t n) {
  for (size_t i = 0; i + 1 < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (r->rank == RANK_PAPER && m->records[i + 1].rank == RANK_PAPER && word_is(name, n, r->id))
      return m->records[i + 1].id;
  }
  return NULL;
}

/* "eq-52#1.2 D" becomes "eq-53#1.2 D". */
static void rename_items(struct maker *k, const struct items *l) {
  for (int i = 0; i < l->n; i++) {
    size_t begin = l->item[i].begin, n = strcspn(k->text + begin, "#, \n");
    const char *next = next_record(k->m->data.model, k->text + begin, n);
    if (next) maker_put(k, begin, begin + n, next);
  }
}

/* Another step: the digits behind "#". */
static void renumber_items(struct maker *k, const struct items *l) {
  for (int i = 0; i < l->n; i++) {
    bool step = false;
    for (size_t at = l->item[i].begin; at < l->item[i].end; at++) {
      step = step || k->text[at] == '#';
      char other = k->text[at] == '1' ? '2' : '1';
      if (step && char_is_digit(k->text[at])) maker_add(k, at, at + 1, &other, 1, NULL);
    }
  }
}

/* --- Arguments --- */

void damage_citations(struct maker *k) {
  struct items l;
  read_items(&l, k);
  drop_items(k, &l);
  rename_items(k, &l);
  renumber_items(k, &l);
}

/* What is to be concluded is a premise too. */
void damage_premises(struct maker *k) {
  const struct field *conclusion = record_field(k->record, "conclusion");
  if (!conclusion) return;
  OWNED(text) t = {0};
  text_printf(&t, ", %.*s", (int)strcspn(conclusion->text, ","), conclusion->text);
  maker_put(k, k->field->value.end, k->field->value.end, text_str(&t));
}

/* --- Where and how it is tried --- */

static const char other_phase[] = "D:Gamma, Gamma:H, H:C, C:D";
static const char other_points[] =
    "params:flow D, flow:arcs, arcs|orbits, admissible:orbits, realistic:admissible, patched:arcs";
/* Each becomes the next, the last one the first. */
static const char *const routes[] = {"exponential", "taylor", "gsl", "ode", "newton", "fd", "saltation", "oracle"};
enum { ROUTE_LENGTH = 32, N_ROUTES = sizeof routes / sizeof *routes };

static void cut_to_one(struct maker *k, const struct items *l) {
  for (int i = 0; i < l->n; i++) {
    size_t at = l->item[i].end;
    while (at > l->item[i].begin && char_is_digit(k->text[at - 1])) at--;
    if (at < l->item[i].end) maker_put(k, at, l->item[i].end, "1");
  }
}

void damage_points(struct maker *k) {
  struct items l;
  read_items(&l, k);
  drop_items(k, &l);
  cut_to_one(k, &l);
  maker_exchange(k, other_points);
}

/* With the route exchanged any two, balls among them, are independent as they were (claims.h). */
static bool is_as_independent(const struct maker *k, const struct items *l, const char *was, const char *now) {
  bool independent = routes_independent(now, "balls");
  for (int i = 0; independent && i < l->n; i++) {
    char other[ROUTE_LENGTH];
    snprintf(other, sizeof other, "%.*s", (int)(l->item[i].end - l->item[i].begin), k->text + l->item[i].begin);
    bool known = word_find(other, routes, N_ROUTES) < N_ROUTES;
    independent = strcmp(other, was) == 0 || (known && routes_independent(now, other));
  }
  return independent;
}

void damage_routes(struct maker *k) {
  struct items l;
  read_items(&l, k);
  drop_items(k, &l);
  if (l.n == 1) maker_delete(k);
  for (int e = 0; e < N_ROUTES; e++) {
    const char *was = routes[e], *now = routes[(e + 1) % N_ROUTES];
    char exchange[2 * ROUTE_LENGTH];
    snprintf(exchange, sizeof exchange, "%s:%s", was, now);
    k->excuse = is_as_independent(k, &l, was, now) ? "a route that is as independent of the others" : NULL;
    maker_exchange(k, exchange);
  }
}

void damage_one_of(struct maker *k) {
  maker_exchange(k, ">|<, orbit|printed, scene:orbits, inside|outside, slip to stick|stick to slip");
}

void damage_parameters(struct maker *k) {
  k->excuse = "other parameters to try, of which the claim does not speak";
  maker_digits(k);
}

void damage_phases(struct maker *k) {
  maker_exchange(k, other_phase);
}

/* --- Restrictions --- */

void damage_restriction(struct maker *k) {
  maker_exchange(k, "V|eta, proved|supported");
}

/* --- Controls --- */

static const char still_wrong[] = "the control is wrong all the same, and refuted";

void damage_control_claim(struct maker *k) {
  const struct claims *c = k->m->data.claims;
  for (size_t i = 0; i + 1 < c->n; i++)
    if (strcmp(c->claim[i].id, k->field->text) == 0)
      maker_put(k, k->field->value.begin, k->field->value.end, c->claim[i + 1].id);
}

/* Of what is wrong, by an attribute of the claim that the control has otherwise. */
void damage_control_line(struct maker *k) {
  const char *key = k->field->key_name;
  if (strcmp(key, "claim") == 0) return;
  k->excuse = strcmp(key, "near") != 0 && strcmp(key, "of") != 0 ? still_wrong : NULL;
  maker_digits(k);
  maker_exchange(k, other_phase);
  k->excuse = NULL;
  maker_delete(k);
}

/* The size of what is wrong; its sign; another entry. */
void damage_control_formula(struct maker *k) {
  k->excuse = still_wrong;
  maker_digits(k);
  maker_signs(k);
}
