/* stickslip quotes: every quotation held against a copy of the paper's text. */
#include <string.h>

#include "cli.h"
#include "quote/quote.h"

static void say_digest(struct text *out, const struct quote_tokens *text, const char *on_file) {
  char digest[QUOTE_DIGEST];
  quote_tokens_digest(digest, text);
  text_printf(out, "text: %s", digest);
  if (!on_file)
    text_add(out, "; none is on file\n");
  else if (strcmp(digest, on_file) == 0)
    text_add(out, ", the one on file\n");
  else
    text_printf(out, ", another than the one on file (%s)\n", on_file);
}

struct quoting {
  struct model model;
  struct claims claims, statements;
};

static bool load(struct quotations *q, struct quoting *by, const char *data, struct diag *d) {
  const struct audit_data all = {&by->model, &by->claims, NULL, &by->statements, NULL};
  OWNED(text) path = {0};
  join_path(&path, data, "paper");
  return model_add_folder(&by->model, text_str(&path), RANK_PAPER, d) &&
         claims_load(&by->claims, data, "claims", "claim", d) &&
         claims_load(&by->statements, data, "paper", "statement", d) && quotations_collect(q, &all, d) &&
         quotations_add_scenes(q, &by->claims, data, d);
}

int run_quotes(const struct options *o, const char *data, struct diag *d) {
  OWNED(paper_text) text;
  OWNED(quotations) q = {.n = 0};
  struct quoting by = {.claims = {.n = 0}};
  struct text out = {0};
  model_init(&by.model);
  int status = EXIT_AS_RECORDED;
  if (paper_text_read(&text, o->operands.word[0], d) && load(&q, &by, data, d)) {
    quotations_compare(&q, &text.tokens);
    say_digest(&out, &text.tokens, by.model.paper_text);
    if (!quotations_report(&out, &q, &text)) status = EXIT_DIFFERS;
    print_text(&out);
  }
  claims_clear(&by.statements);
  claims_clear(&by.claims);
  model_clear(&by.model);
  return status;
}
