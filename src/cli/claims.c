/* stickslip list, check and explain: the claims and the files they come from. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "proof/receipt.h"
#include "value/title.h"

/* Each with its title; one that cannot be read is an error, and the others are listed all the same. */
static int list_scenes(const char *data) {
  struct arena a;
  struct diag d;
  size_t n;
  arena_init(&a);
  diag_init(&d);
  char **name = scene_names(&n, data, &a, &d);
  int status = name ? EXIT_AS_RECORDED : bad_input(&d);
  struct text out;
  text_init(&out);
  for (size_t i = 0; i < n; i++) {
    struct scene s;
    diag_init(&d);
    if (scene_load_with(&s, name[i], data, NULL, SCENE_OF_ANY_SYSTEM, &d))
      text_printf(&out, "%-18s %s\n", s.name, s.title ? s.title : "");
    else
      status = bad_input(&d);
    scene_clear(&s);
  }
  terminal_print(text_str(&out));
  text_clear(&out);
  free(name);
  arena_clear(&a);
  return status;
}

int run_list(const struct options *o, const char *data) {
  bool keys = option(o, OPT_SCENE_KEYS), as_json = option(o, OPT_JSON);
  if (keys && o->operands.n) return usage("list --scene-keys takes no operand, not %.200s", o->operands.word[0]);
  if (keys) return list_scene_keys(as_json);
  if (as_json) return usage("list writes JSON with %s only", "--scene-keys");
  if (o->operands.n == 1 && strcmp(o->operands.word[0], "scenes") == 0) return list_scenes(data);
  if (o->operands.n) return usage("list takes no operand but scenes, not %.200s", o->operands.word[0]);
  struct diag d;
  struct model m;
  struct claims c = {.n = 0};
  diag_init(&d);
  model_init(&m);
  bool ok = load_model(&m, data, o, &d) && claims_load_data(&c, data, "claims", "claim", &d);
  struct text out;
  text_init(&out);
  for (size_t i = 0; ok && i < c.n; i++) {
    const char *record = claim_get(&c.claim[i], "record");
    text_printf(&out, "%-18s %-12s %-11s ", c.claim[i].id, claim_get(&c.claim[i], "kind"), record ? record : "-");
    ok = claim_title(&out, &m, &c.claim[i], &d);
    text_add_char(&out, '\n');
  }
  if (ok) terminal_print(text_str(&out));
  text_clear(&out);
  claims_clear(&c);
  model_clear(&m);
  return ok ? EXIT_AS_RECORDED : bad_input(&d);
}

int run_check(const struct options *o, const char *data) {
  if (o->operands.n == 0) return usage("check takes at least one %s", "FILE");
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < o->operands.n; i++) {
    struct diag d;
    diag_init(&d);
    if (audit_check_file(o->operands.word[i], data, &d))
      printf("%s: ok\n", o->operands.word[i]);
    else
      status = bad_input(&d);
  }
  return status;
}

static bool print_receipt(struct text *out, const struct model *m, const struct claims *c, const struct scene *s,
                          const char *id, const char *data, struct diag *d) {
  enum { MAX_SCRIPT = 1 << 20 };
  struct text path;
  struct source src;
  text_init(&path);
  join_path(&path, data, "receipt/model.py");
  bool ok = source_read(&src, text_str(&path), MAX_SCRIPT, d);
  text_clear(&path);
  if (!ok) return false;
  ok = audit_receipt(out, m, c, s, id, src.text, d);
  source_clear(&src);
  return ok;
}

int run_explain(const struct options *o, const char *data) {
  const char *at = option(o, OPT_AT);
  bool receipt = option(o, OPT_RECEIPT), tape = option(o, OPT_TAPE);
  if (o->operands.n != 1) return usage("explain takes one %s", "claim id");
  if (receipt && (at || tape)) return usage("--receipt stands alone, not with %s", at ? "--at" : "--tape");
  struct diag d;
  struct model m;
  struct scene s;
  struct claims c = {.n = 0};
  struct text out;
  diag_init(&d);
  model_init(&m);
  text_init(&out);
  bool ok = load_scene(&s, "paper", data, o, SCENE_EXACT, &d) && load_model(&m, data, o, &d) &&
            claims_load_data(&c, data, "claims", "claim", &d) &&
            (receipt ? print_receipt(&out, &m, &c, &s, o->operands.word[0], data, &d)
                     : audit_explain(&out, &m, &c, &s, o->operands.word[0], at, tape, &d));
  int status = ok ? EXIT_AS_RECORDED : bad_input(&d);
  if (ok && receipt)
    fputs(text_str(&out), stdout);
  else if (ok)
    terminal_print(text_str(&out));
  text_clear(&out);
  claims_clear(&c);
  model_clear(&m);
  scene_clear(&s);
  return status;
}
