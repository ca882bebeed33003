/* Quotations against texts: what counts and what does not, written out by hand; a paper of the test's own
   (tests/another), whose every token is damaged; and the paper itself, where a copy is there: STICKSLIP_PAPER_TEXT, or
   the only text in ../shared/paper. */
#include <glob.h>

#include "quote/quote.h"
#include "test.h"

static bool same(const char *a, const char *b) {
  OWNED(quote_tokens) x = {.n = 0}, y = {.n = 0};
  quote_tokens_read(&x, a, strlen(a));
  quote_tokens_read(&y, b, strlen(b));
  bool ok = x.n == y.n;
  for (size_t i = 0; ok && i < x.n; i++) ok = quote_token_same(&x.token[i], &y.token[i]);
  return ok;
}

TABLE(like, "tests/cases/quotes_same.tsv", 2);
enum { ONE, OTHER }; /* its columns */

TEST_EACH(what_does_not_count, like.n) {
  char *const *row = like.row[_i];
  ck_assert_msg(same(row[ONE], row[OTHER]), "%s is not %s", row[ONE], row[OTHER]);
}

TABLE(unlike, "tests/cases/quotes_different.tsv", 2);
enum { LEFT, RIGHT }; /* its columns */

TEST_EACH(what_counts, unlike.n) {
  char *const *row = unlike.row[_i];
  ck_assert_msg(!same(row[LEFT], row[RIGHT]), "%s is %s", row[LEFT], row[RIGHT]);
}

/* --- A data folder against a text --- */

struct stand {
  struct model model;
  struct claims claims, statements;
  struct quotations quotations;
  struct paper_text paper;
};

static bool stand_open(struct stand *s, const char *data, const char *path, struct diag *d) {
  const char *paper = formatted("%s/paper", data);
  *s = (struct stand){.claims = {.n = 0}};
  diag_init(d);
  model_init(&s->model);
  return paper_text_read(&s->paper, path, d) && model_add_folder(&s->model, paper, RANK_PAPER, d) &&
         claims_load(&s->claims, data, "claims", "claim", d) &&
         claims_load(&s->statements, data, "paper", "statement", d) &&
         quotations_collect(&s->quotations, &(struct audit_data){&s->model, &s->claims, NULL, &s->statements, NULL},
                            d) &&
         quotations_add_scenes(&s->quotations, &s->claims, data, d);
}

static void stand_clear(struct stand *s) {
  quotations_clear(&s->quotations);
  claims_clear(&s->statements);
  claims_clear(&s->claims);
  model_clear(&s->model);
  paper_text_clear(&s->paper);
}

static void stand_open_sound(struct stand *s, const char *data, const char *path) {
  goes_well(stand_open(s, data, path, &d));
  quotations_compare(&s->quotations, &s->paper.tokens);
}

static bool all_found(const struct stand *s) {
  LOCAL(text, out);
  return quotations_report(&out, &s->quotations, &s->paper);
}

/* Whether the quotation has a piece over the token with that index. */
static bool lies_over(const struct quotations *q, const struct quotation *item, size_t token) {
  for (size_t k = 0; k < item->n; k++) {
    const struct quote_piece *p = &q->piece[item->first + k];
    if (p->place - 1 <= token && token < p->place - 1 + p->tokens.n) return true;
  }
  return false;
}

/* Each token of the text changed, every `step`-th: exactly the quotations over it are not found. */
static void damage_tokens(struct stand *s, size_t step) {
  size_t noticed = 0;
  for (size_t i = 0; i < s->paper.tokens.n; i += step) {
    const struct quote_token kept = s->paper.tokens.token[i];
    s->paper.tokens.token[i] = (struct quote_token){"\x01", 1};
    quotations_compare(&s->quotations, &s->paper.tokens);
    for (size_t k = 0; k < s->quotations.n; k++) {
      const struct quotation *item = &s->quotations.item[k];
      bool over = lies_over(&s->quotations, item, i);
      ck_assert_msg(quotation_found(&s->quotations, item) == !over, "%s at token %zu", item->id, i + 1);
      noticed += over;
    }
    s->paper.tokens.token[i] = kept;
  }
  ck_assert_uint_gt(noticed, 0);
}

/* A token taken out: what ends before it is found, what begins behind it stands one earlier, what lies over it is
   nowhere to be found at its place. */
static void take_token_out(struct stand *s, size_t i) {
  struct quotations *q = &s->quotations;
  const struct quote_token kept = s->paper.tokens.token[i];
  memmove(s->paper.tokens.token + i, s->paper.tokens.token + i + 1, (--s->paper.tokens.n - i) * sizeof kept);
  for (size_t k = 0; k < s->paper.tokens.n_tags; k++)
    s->paper.tokens.tag[k].behind -= s->paper.tokens.tag[k].behind > i;
  quotations_compare(q, &s->paper.tokens);
  for (size_t k = 0; k < q->n_pieces; k++) {
    const struct quote_piece *p = &q->piece[k];
    if (p->place - 1 + p->tokens.n <= i) ck_assert_int_eq(p->outcome, QUOTE_FOUND);
    if (p->place - 1 > i) {
      ck_assert_int_eq(p->outcome, QUOTE_ELSEWHERE);
      ck_assert_uint_eq(p->elsewhere, p->place - 1);
    }
    if (p->place - 1 <= i && i < p->place - 1 + p->tokens.n) ck_assert_int_ne(p->outcome, QUOTE_FOUND);
  }
  memmove(s->paper.tokens.token + i + 1, s->paper.tokens.token + i, (s->paper.tokens.n++ - i) * sizeof kept);
  s->paper.tokens.token[i] = kept;
  for (size_t k = 0; k < s->paper.tokens.n_tags; k++)
    s->paper.tokens.tag[k].behind += s->paper.tokens.tag[k].behind >= i + 1;
}

/* The number of each equation changed: some record's, and only of that equation, is noticed. */
static void damage_numbers(struct stand *s) {
  for (size_t i = 0; i < s->paper.tokens.n_tags; i++) {
    const struct quote_token kept = s->paper.tokens.tag[i].number;
    size_t noticed = 0;
    s->paper.tokens.tag[i].number = (struct quote_token){"999", 3};
    quotations_compare(&s->quotations, &s->paper.tokens);
    for (size_t k = 0; k < s->quotations.n; k++) {
      const struct quotation *item = &s->quotations.item[k];
      if (quotation_found(&s->quotations, item)) continue;
      noticed++;
      ck_assert(strlen(item->equation) == kept.len && memcmp(item->equation, kept.s, kept.len) == 0);
    }
    ck_assert_msg(noticed > 0, "the number (%.*s)", (int)kept.len, kept.s);
    s->paper.tokens.tag[i].number = kept;
  }
}

/* The digest is that of the model, and of a program of its own. */
static void check_digest(const char *path, const struct stand *s) {
  char digest[QUOTE_DIGEST], *found = shell_said("$Y tests/oracle/quotes.py '%s'", path);
  found[strcspn(found, "\n")] = '\0';
  quote_tokens_digest(digest, &s->paper.tokens);
  ck_assert_str_eq(digest, found);
  ck_assert_str_eq(s->model.paper_text, digest);
  free(found);
}

static const char note[] = "tests/another/note.md";

TEST(the_note_is_quoted) {
  OWNED(stand) s;
  stand_open_sound(&s, "tests/another", note);
  ck_assert_uint_eq(s.quotations.n, 7);
  ck_assert(all_found(&s));
  check_digest(note, &s);
  damage_tokens(&s, 1);
  damage_numbers(&s);
  for (size_t i = 0; i < s.paper.tokens.n; i++) take_token_out(&s, i);
  quotations_compare(&s.quotations, &s.paper.tokens);
  ck_assert(all_found(&s));
}

/* --- Bytes --- */

/* Texts of the greatest length that are all of one kind are answered in seconds. */
TEST(large_texts) {
  static const char *const unit[] = {
      "\\begin{", "\\begin{pmatrix}", "\\end{aligned}", "\\quad (", "\\quad(1)$$", "Z(t) = ", "$",
      "*",        "A note on two "};
  for (size_t i = 0; i < COUNT(unit); i++) {
    LOCAL(text, all);
    OWNED(stand) s;
    text_add(&all, "x"); /* a text has a token */
    while (all.len + strlen(unit[i]) <= MAX_QUOTED_TEXT) text_add(&all, unit[i]);
    scratch_open();
    stand_open_sound(&s, "tests/another", scratch_put("text", text_str(&all)));
    ck_assert(!all_found(&s));
    scratch_close();
  }
}

/* --- The paper --- */

/* A copy of the paper's text; NULL when none is there. */
static const char *text_of_the_paper(void) {
  static char path[4096];
  const char *named = getenv("STICKSLIP_PAPER_TEXT");
  glob_t g = {.gl_pathc = 0};
  path[0] = '\0';
  if (named)
    snprintf(path, sizeof path, "%s", named);
  else if (glob("../shared/paper/*.txt", 0, NULL, &g) == 0 && g.gl_pathc == 1)
    snprintf(path, sizeof path, "%s", g.gl_pathv[0]);
  globfree(&g);
  return *path ? path : NULL;
}

TEST(the_paper_is_quoted) {
  const char *path = text_of_the_paper();
  if (!path) {
    printf("quotes: not held against the paper: ../shared/paper has no text, and STICKSLIP_PAPER_TEXT names none\n");
    return;
  }
  OWNED(stand) s;
  stand_open_sound(&s, "verify", path);
  LOCAL(text, out);
  bool ok = quotations_report(&out, &s.quotations, &s.paper);
  ck_assert_msg(ok, "%s", text_str(&out));
  printf("quotes: %s", text_str(&out));
  check_digest(path, &s);
}

TEST(the_paper_is_damaged) {
  const char *path = text_of_the_paper();
  if (!path) return;
  OWNED(stand) s;
  stand_open_sound(&s, "verify", path);
  damage_tokens(&s, 5);
  for (size_t i = 0; i < s.paper.tokens.n; i += 997) take_token_out(&s, i);
}
