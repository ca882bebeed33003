/* The letter: what the paper's authors should know, on two screens; where the data are not an example's in print,
   a summary of the same, which says what they are.  What was read; that the printed numbers are wrong, and how they
   come out; the other errors of substance, with what they change; what holds; where the solution is stable.  Every
   sentence is made of the record, and what stands here is told in full below it. */
#include <stdlib.h>
#include <string.h>

#include "finding.h"
#include "page.h"

/* Up to the end of the first sentence of a text with mathematics between dollar signs. */
static size_t first_sentence(const char *s) {
  bool math = false;
  size_t n = 0;
  for (; s[n]; n++) {
    math ^= s[n] == '$';
    if (!math && s[n] == '.' && s[n + 1] == ' ') return n + 1;
  }
  return n;
}

static void add_first_sentence(const struct page *p, const char *s) {
  OWNED(text) one = {0};
  text_add_n(&one, s, first_sentence(s));
  page_add(p, "%t%.", text_str(&one));
}

/* --- The printed numbers --- */

static bool is_wrong_number(const struct finding *f) {
  return finding_fails(f) && failure_is_number(f);
}

/* That the numbers are wrong. */
static void add_wrong_numbers(const struct page *p, const struct root_cause *root) {
  const struct readings *r = p->r->readings;
  bool rounding = r && r->procedure.n_outputs > 0;
  for (int i = 0; rounding && i < r->procedure.n_outputs; i++)
    rounding = strcmp(r->procedure.output[i].within, "no") == 0;
  text_add(p->out, "<p><strong>");
  add_first_sentence(p, root->wrong);
  text_add(p->out, "</strong>");
  if (rounding) page_add(p, " Rounding of %p does not explain the difference.", r->procedure.inputs);
  page_add(p, " (<a href=\"#r-%a\">More</a>)</p>\n", root->id);
}

/* The name of the number that a claim "num-t_a" is about; the id of another. */
static const char *of_number(const struct finding *f) {
  static const char prefix[] = "num-";
  return f->id + (strncmp(f->id, prefix, sizeof prefix - 1) == 0 ? sizeof prefix - 1 : 0);
}

static const char numbers[] = "number|printed:|so computed:|nearest periodic solution:";

/* A row; n: of the reading, or NULL; f: the claim that the number is wrong, or NULL. */
static void add_number(const struct page *p, const struct reading_number *n, const struct finding *f) {
  const char *value = f ? finding_certified(f, "value") : NULL;
  const char *name = n ? n->name : f ? of_number(f) : "", *printed = f && !n ? finding_certified(f, "printed") : NULL;
  if (f)
    page_add(p, "<tr id=\"f-%a\"><th scope=\"row\"><a href=\"#c-%a\">%p</a></th>", f->id, f->id, name);
  else
    page_add(p, PAGE_ROW "%p</th>", name);
  page_row(p, numbers, "|%p|%p|%p%m", n ? n->printed : printed,
           n ? strcmp(n->how, "input") == 0 ? "exact" : n->value : NULL,
           f            ? value
           : p->r->data ? NULL
                        : "as printed",
           f && !value ? f->correction_latex : NULL);
}

/* The place of the claim's number in the reading; -1 where it has none. */
static int place_in(const struct example_reading *e, const struct finding *f) {
  for (int i = 0; e && i < e->n_numbers; i++)
    if (strcmp(e->number[i].name, of_number(f)) == 0) return i;
  return -1;
}

/* Those of the reading, each with the claim that it is wrong, then what else is wrong. */
static void add_numbers(const struct page *p, const struct example_reading *e) {
  const struct audit_result *r = p->r;
  page_begin_table(p, "few", "The printed numbers of the example", numbers);
  for (int i = 0; e && i < e->n_numbers; i++) {
    size_t k = 0;
    while (k < r->n_findings && !(is_wrong_number(&r->findings[k]) && place_in(e, &r->findings[k]) == i)) k++;
    add_number(p, &e->number[i], k < r->n_findings ? &r->findings[k] : NULL);
  }
  for (size_t k = 0; k < r->n_findings; k++)
    if (is_wrong_number(&r->findings[k]) && place_in(e, &r->findings[k]) < 0) add_number(p, NULL, &r->findings[k]);
  page_end_table(p);
}

static void add_example(const struct page *p) {
  const struct example_reading *e = best_reading(p->r);
  const struct root_cause *root = audit_root_of_numbers(p->r);
  bool any = e != NULL;
  for (size_t i = 0; i < p->r->n_findings; i++) any = any || is_wrong_number(&p->r->findings[i]);
  if (!any) return;
  text_printf(p->out, "<h3>The printed %s</h3>\n<div class=\"beside\">\n<div>\n",
              p->r->data ? "numbers, with the data of this scene" : "example");
  if (root) add_wrong_numbers(p, root);
  if (e) {
    text_add(p->out, "<p>");
    reading_say(HTML(p->out), e);
    text_add(p->out, "</p>\n");
  }
  add_numbers(p, e);
  text_add(p->out, "</div>\n");
  page_picture(p, &picture_portrait, "A bar shows by how much the motion from the printed start does not close.");
  text_add(p->out, "</div>\n");
}

/* --- The errors --- */

/* What there is in all, once. */
static void add_counts(const struct page *p) {
  text_add(p->out, "<p>The audit has found ");
  int kinds = 0, told = 0;
  for (int i = 0; i < N_SEVERITIES; i++) kinds += audit_result_roots(p->r, (enum severity)i) > 0;
  for (int i = 0; i < N_SEVERITIES; i++) {
    size_t n = audit_result_roots(p->r, (enum severity)i);
    if (n) text_printf(p->out, "%s%zu %s", list_joint(told++, kinds, " and "), n, severity_words[i][n != 1]);
  }
  text_add_char(p->out, '.');
}

/* What is wrong, in a sentence, and what it changes; numbered as on the sheet of errata. */
static void add_error(const struct page *p, const struct root_cause *root, int number) {
  text_printf(p->out, "<li value=\"%d\">", number);
  page_add(p, "<a href=\"#r-%a\">%t</a>, %t: ", root->id, root->where, root->title);
  add_first_sentence(p, root->wrong);
  page_add(p, " %t</li>\n", root->consequence);
}

static void add_errors(const struct page *p) {
  const struct root_cause *told = audit_root_of_numbers(p->r);
  if (p->r->n_roots == 0) return;
  text_add(p->out, "<h3>What has to be corrected</h3>\n");
  add_counts(p);
  if (told && audit_result_roots(p->r, SEVERITY_SUBSTANCE) > 1)
    text_add(p->out, " The errors besides the numbers of the example:");
  text_add(p->out, "</p>\n");
  text_add(p->out, "<ol class=\"errors\">\n");
  int n = 0;
  for (size_t i = 0; i < p->r->n_roots; i++) {
    const struct root_cause *root = &p->r->roots[i];
    if (root->severity != SEVERITY_SUBSTANCE) continue;
    n++;
    if (root != told) add_error(p, root, n);
  }
  text_add(p->out, "</ol>\n");
}

/* --- What holds --- */

enum { MOST_EQUATIONS = 1000 };

/* "40" is 40; what is no number of an equation is 0. */
static int equation_number(const struct finding *f) {
  char *end = NULL;
  long n = f->equation && f->of == OF_PAPER ? strtol(f->equation, &end, 10) : 0;
  return n > 0 && n < MOST_EQUATIONS && !*end ? (int)n : 0;
}

/* Whether all that was asked about it holds; false where nothing was asked. */
static bool equation_holds(const struct audit_result *r, int n) {
  bool any = false, all = true;
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (equation_number(f) != n) continue;
    any = any || f->verdict == VERDICT_PROVED;
    all = all && (f->verdict == VERDICT_PROVED || f->verdict == VERDICT_DEFINITION);
  }
  return any && all;
}

/* "(1)-(9), (11)". */
static void add_sound_equations(const struct page *p) {
  bool minor = audit_result_roots(p->r, SEVERITY_REMARK) + audit_result_roots(p->r, SEVERITY_NOTATION) > 0;
  const char *before = minor ? "Apart from the remarks and slips of notation below, all that was examined of "
                             : "All that was examined of ";
  static const char more[] = ", ";
  for (int i = 1, last; i < MOST_EQUATIONS; i = last + 1) {
    last = i;
    if (!equation_holds(p->r, i)) continue;
    while (equation_holds(p->r, last + 1)) last++;
    text_printf(p->out, "%s(%d)", before, i);
    if (last > i) text_printf(p->out, "%s(%d)", last > i + 1 ? "\xe2\x80\x93" : more, last);
    before = more;
  }
  if (before == more) text_add(p->out, " has been proved, with the corrected form of what it uses. ");
}

static void add_what_holds(const struct page *p) {
  long count[N_VERDICTS], total = audit_result_count(count, p->r, OF_PAPER),
                          asserted = total - count[VERDICT_DEFINITION];
  if (asserted == 0) return;
  text_add(p->out, "<h3>What holds</h3>\n<p>");
  add_sound_equations(p);
  verdicts_say(p->out, p->r);
  text_add(p->out, ".</p>\n");
}

/* --- What the paper does not say --- */

static void add_stability(const struct page *p) {
  OWNED(text) words = {0}, range = {0};
  OWNED(rows) t;
  const struct page said = {&words, p->r};
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!f->letter) continue;
    sheet_sentence(HTML(&words), f->letter);
    page_add(&said, " (<a href=\"#c-%a\">More</a>) ", f->id);
  }
  if (rows_read(&t, p->r, picture_along.table)) picture_along.say(&range, &t);
  html_text(&words, text_str(&range), NULL);
  if (words.len == 0) return;
  text_printf(p->out, "<h3>%s</h3>\n<div class=\"beside\">\n<p>%s</p>\n",
              p->r->data ? "Where the solution is stable" : "What the paper does not say: where the solution is stable",
              text_str(&words));
  page_picture(p, &picture_along, "");
  text_add(p->out, "</div>\n");
}

/* --- The letter --- */

static void add_data(const struct page *p) {
  OWNED(text) data = {0};
  audit_data(&data, p->r);
  if (data.len) page_add(p, "<p>%p</p>\n", text_str(&data));
}

void page_letter(const struct page *p) {
  page_begin_section(p, "letter", p->r->data ? "The paper with the data of this scene" : "To the authors");
  page_add(p, "<p>%t", audit_method(p->r));
  if (p->r->paper_source) page_add(p, " <strong>%t</strong>", p->r->paper_source);
  text_add(p->out, "</p>\n");
  add_data(p);
  add_example(p);
  add_errors(p);
  add_what_holds(p);
  add_stability(p);
  text_printf(
      p->out,
      "<p>The <a href=\"#s-findings\">findings</a> follow with corrections and evidence, each with the command that "
      "judges it again; <a href=\"errata.md\">errata.md</a> is the same as a sheet%s. ",
      p->r->data ? "" : " to be sent");
  bool shipped = p->r->model && !p->r->data;
  if (!shipped) page_recheck(p);
  text_printf(p->out,
              "%s repeats the whole audit; what it does not show is said <a "
              "href=\"#s-limits\">at the end</a>.</p>\n</section>\n",
              shipped ? "<code>make deps verify</code> in a copy of the project" : "");
}
