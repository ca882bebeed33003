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

static bool read_text(struct source *src, struct quote_tokens *text, const char *path, struct diag *d) {
  if (!source_read(src, path, MAX_QUOTED_TEXT, d)) return false;
  quote_tokens_read(text, src->text, src->len);
  if (text->n == 0) diag_set(d, "%.300s: error: an empty text", path);
  return text->n > 0;
}

static bool load(struct quotations *q, struct model *m, struct claims *c, const char *data, struct diag *d) {
  struct text path;
  text_init(&path);
  join_path(&path, data, "paper");
  bool ok = model_add_folder(m, text_str(&path), RANK_PAPER, d) && claims_load_data(c, data, "claims", "claim", d) &&
            quotations_collect(q, m, c, data, d);
  text_clear(&path);
  return ok;
}

int run_quotes(const struct options *o, const char *data) {
  if (o->operands.n != 1) return usage("quotes takes one %s, a text of the paper", "FILE");
  struct diag d;
  struct source src = {.text = NULL};
  struct quote_tokens text = {.n = 0};
  struct quotations q = {.n = 0};
  struct model m;
  struct claims c = {.n = 0};
  struct text out;
  diag_init(&d);
  model_init(&m);
  text_init(&out);
  int status = EXIT_AS_RECORDED;
  if (!read_text(&src, &text, o->operands.word[0], &d) || !load(&q, &m, &c, data, &d)) {
    status = bad_input(&d);
  } else {
    quotations_compare(&q, &text);
    say_digest(&out, &text, m.paper_text);
    if (!quotations_report(&out, &q, &text, &src)) status = EXIT_DIFFERS;
    fputs(text_str(&out), stdout);
  }
  text_clear(&out);
  quotations_clear(&q);
  claims_clear(&c);
  model_clear(&m);
  quote_tokens_clear(&text);
  source_clear(&src);
  return status;
}
