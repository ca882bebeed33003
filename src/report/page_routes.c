/* How independent the routes are: for each quantity every two routes against each other, with what both rest on; then
   the long runs and the statements made wrong on purpose. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "escape.h"
#include "html.h"
#include "names.h"
#include "sections.h"

/* --- What is shared, numbered --- */

struct parts {
  const char **s; /* a part and its length; it is not terminated */
  size_t *len, n, cap, cap_len;
};

/* The length of the first part of a list: up to a comma outside parentheses. */
static size_t part_length(const char *s) {
  int depth = 0;
  size_t n = 0;
  for (; s[n]; n++) {
    depth += (s[n] == '(') - (s[n] == ')');
    if (depth <= 0 && s[n] == ',') break;
  }
  return n;
}

static size_t part_index(struct parts *list, const char *s, size_t len) {
  for (size_t i = 0; i < list->n; i++)
    if (list->len[i] == len && memcmp(list->s[i], s, len) == 0) return i;
  list->s = ss_grow(list->s, list->n, &list->cap, sizeof *list->s);
  list->len = ss_grow(list->len, list->n, &list->cap_len, sizeof *list->len);
  list->s[list->n] = s;
  list->len[list->n] = len;
  return list->n++;
}

static bool shares_nothing(const struct route_pair *pair) {
  return !pair->shared || !*pair->shared || strcmp(pair->shared, "nothing") == 0;
}

/* The numbers of what the pair shares, to the page when it is given. */
static void each_part(struct parts *list, const struct route_pair *pair, struct text *out) {
  if (shares_nothing(pair)) return;
  const char *sep = "";
  for (const char *s = pair->shared; *s;) {
    size_t n = part_length(s), k = part_index(list, s, n);
    if (out) text_printf(out, "%s%zu", sep, k + 1);
    sep = ", ";
    s += n;
    s += strspn(s, ", ");
  }
}

static void add_parts(const struct page *p, const struct parts *list) {
  if (!list->n) return;
  text_add(p->out, "<p>What two routes can have in common, besides the equations of motion and the point:</p>\n<ol>\n");
  for (size_t i = 0; i < list->n; i++) {
    text_add(p->out, "<li>");
    escape_html_n(p->out, list->s[i], list->len[i]);
    text_add(p->out, "</li>\n");
  }
  text_add(p->out, "</ol>\n");
}

/* --- One matrix a quantity --- */

static const struct route_pair *pair_of(const struct audit_result *r, const char *quantity, const char *a,
                                        const char *b) {
  for (size_t i = 0; i < r->n_pairs; i++) {
    const struct route_pair *q = &r->pairs[i];
    bool names = (strcmp(q->first, a) == 0 && strcmp(q->second, b) == 0) ||
                 (strcmp(q->first, b) == 0 && strcmp(q->second, a) == 0);
    if (names && strcmp(q->quantity, quantity) == 0) return q;
  }
  return NULL;
}

static void add_cell(const struct page *p, const struct route_pair *pair, struct parts *parts) {
  if (!pair) {
    text_add(p->out, "<td class=\"none\">not compared</td>");
    return;
  }
  text_add(p->out, shares_nothing(pair) ? "<td class=\"free\">nothing shared" : "<td>shared: ");
  each_part(parts, pair, p->out);
  text_add(p->out, "<br />");
  if (!pair->within) text_add(p->out, "<strong>beyond</strong> ");
  html_prose(p->out, pair->largest ? pair->largest : pair->within ? "within" : "-");
  if (!pair->largest || !pair->within) {
    text_add_char(p->out, ' ');
    html_prose(p->out, pair->stated);
  }
  text_printf(p->out, "<br /><small>%ld compared</small></td>", pair->comparisons);
}

static void add_matrix(const struct page *p, const char *quantity, struct parts *parts) {
  struct names routes = {.n = 0};
  for (size_t i = 0; i < p->r->n_pairs; i++)
    if (strcmp(p->r->pairs[i].quantity, quantity) == 0) {
      names_index(&routes, p->r->pairs[i].first);
      names_index(&routes, p->r->pairs[i].second);
    }
  text_add(p->out, "<div class=\"wide\"><table class=\"matrix\">\n<caption>Two routes to: ");
  escape_html(p->out, quantity);
  text_add(p->out, "</caption>\n<thead><tr><th scope=\"col\">route</th>");
  for (size_t k = 1; k < routes.n; k++) {
    text_add(p->out, "<th scope=\"col\">");
    escape_html(p->out, routes.name[k]);
    text_add(p->out, "</th>");
  }
  text_add(p->out, "</tr></thead>\n<tbody>\n");
  for (size_t i = 0; i + 1 < routes.n; i++) {
    text_add(p->out, "<tr><th scope=\"row\">");
    escape_html(p->out, routes.name[i]);
    text_add(p->out, "</th>");
    for (size_t k = 1; k < routes.n; k++)
      if (k <= i)
        text_add(p->out, "<td class=\"none\"></td>");
      else
        add_cell(p, pair_of(p->r, quantity, routes.name[i], routes.name[k]), parts);
    text_add(p->out, "</tr>\n");
  }
  page_end_table(p);
  free(routes.name);
}

static bool first_of_its_quantity(const struct audit_result *r, size_t i) {
  for (size_t k = 0; k < i; k++)
    if (strcmp(r->pairs[k].quantity, r->pairs[i].quantity) == 0) return false;
  return true;
}

static void add_matrices(const struct page *p) {
  const struct audit_result *r = p->r;
  struct parts parts = {.n = 0};
  if (!r->n_pairs) {
    text_add(p->out, "<p>The routes were not held against each other in this run.</p>\n");
    return;
  }
  for (size_t i = 0; i < r->n_pairs; i++) each_part(&parts, &r->pairs[i], NULL);
  add_parts(p, &parts);
  text_add(
      p->out,
      "<p>A cell of the tables below stands for two routes. It says what both rest on, by the numbers of this "
      "list; then their largest disagreement, relative to max(1, largest entry), as the power of ten above it, or, "
      "after \"within\", the accuracy that they kept to, where the figure is not the same on every machine.</p>\n");
  for (size_t i = 0; i < r->n_pairs; i++)
    if (first_of_its_quantity(r, i)) add_matrix(p, r->pairs[i].quantity, &parts);
  free(parts.s);
  free(parts.len);
}

/* --- Long runs, controls --- */

static void add_independence(const struct page *p) {
  if (!p->r->n_independence) return;
  text_add(p->out, "<details><summary>What each route does and rests on</summary>\n<ul>\n");
  for (int i = 0; i < p->r->n_independence; i++) {
    text_add(p->out, "<li>");
    escape_html(p->out, p->r->independence[i]);
    text_add(p->out, "</li>\n");
  }
  text_add(p->out, "</ul></details>\n");
}

static const struct column runs[] = {{"orbit", false},
                                     {"tr J", true},
                                     {"periods", true},
                                     {"a difference of 2 to the -52 is 1e-6 after", false},
                                     {"routes part at that rate", false},
                                     {"a displacement grows at that rate", false}};

static void add_long_runs(const struct page *p) {
  if (!p->r->n_long_runs) return;
  text_add(p->out,
           "<h3>Long runs</h3>\n<p>Integration and closed forms, both in double precision, beside closed forms in "
           "multiprecision, from one start on the orbit. What separates them must grow or shrink each period as "
           "the multiplier of the orbit says.</p>\n");
  page_begin_table(p, "stack", "Runs over many periods", runs, sizeof runs / sizeof *runs);
  for (size_t i = 0; i < p->r->n_long_runs; i++) {
    const struct long_result *l = &p->r->long_runs[i];
    text_add(p->out, "<tr><th scope=\"row\">");
    html_prose(p->out, l->orbit);
    text_add(p->out, "</th>");
    page_cell(p, &runs[1]);
    html_prose(p->out, l->multiplier);
    text_add(p->out, "</td>");
    page_cell(p, &runs[2]);
    text_printf(p->out, "%ld</td>", l->periods);
    page_cell(p, &runs[3]);
    html_prose(p->out, l->expected);
    text_add(p->out, "</td>");
    page_cell(p, &runs[4]);
    text_printf(p->out, "%s</td>", l->obeys ? "yes" : "<strong>NO</strong>");
    page_cell(p, &runs[5]);
    text_printf(p->out, "%s</td></tr>\n", l->displaced ? "yes" : "<strong>NO</strong>");
  }
  page_end_table(p);
}

static void add_controls(const struct page *p) {
  const struct audit_result *r = p->r;
  if (!r->n_controls) return;
  text_add(p->out,
           "<h3 id=\"s-controls\">Statements made wrong on purpose</h3>\n<p>Each is a claim, or a check of the "
           "audit itself, with one part made wrong, and must be refuted in every "
           "run.</p>\n<details><summary>The controls</summary>\n<div class=\"wide\"><table "
           "class=\"narrow\">\n<caption>Controls and what they damage</caption>\n<thead><tr>"
           "<th scope=\"col\">control</th><th scope=\"col\">damages</th><th scope=\"col\">verdict</th>"
           "<th scope=\"col\">noticed</th><th scope=\"col\">by how much it is wrong</th></tr></thead>\n<tbody>\n");
  for (size_t i = 0; i < r->n_controls; i++) {
    text_add(p->out, "<tr><th scope=\"row\">");
    html_code(p->out, r->controls[i].id);
    text_add(p->out, "</th><td>");
    if (r->controls[i].claim) page_claim(p, r->controls[i].claim);
    text_add(p->out, "</td><td>");
    page_verdict(p, r->controls[i].verdict);
    text_printf(p->out, "</td><td>%s</td><td>%s</td></tr>\n", r->controls[i].noticed ? "yes" : "<strong>NO</strong>",
                r->controls[i].distance ? r->controls[i].distance : "");
  }
  text_add(p->out, "</tbody></table></div></details>\n");
}

void page_routes(const struct page *p) {
  page_begin_section(p, "routes", "How independent the routes are");
  add_matrices(p);
  add_independence(p);
  add_long_runs(p);
  add_controls(p);
  text_add(p->out, "</section>\n");
}
