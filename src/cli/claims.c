/* stickslip list and check: the claims and the files they come from. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "value/title.h"

/* Each with its title; one that cannot be read is an error, and the others are listed all the same. */
static int list_scenes(const char *data) {
  LOCAL(arena, a);
  struct diag d = {0};
  size_t n;
  FREED char **name = scene_names(&n, data, &a, &d);
  int status = name ? EXIT_AS_RECORDED : bad_input(&d);
  struct text out = {0};
  for (size_t i = 0; i < n; i++) {
    OWNED(scene) s;
    diag_init(&d);
    if (scene_load_with(&s, name[i], data, NULL, SCENE_OF_ANY_SYSTEM, &d))
      text_printf(&out, "%-18s %s\n", s.name, s.title ? s.title : "");
    else
      status = bad_input(&d);
  }
  terminal_print(&out);
  return status;
}

static void list_row(struct text *out, const char *id, const struct claim *c, const char *record, const char *title) {
  text_printf(out, "%-18s %-12s %-11s %s", id, claim_get(c, "kind"), or_dash(record), title);
}

bool list_claim(struct text *out, const struct model *m, const struct claim *c, struct diag *d) {
  OWNED(text) title = {0};
  struct made_claim made;
  bool ok = claim_title(&title, m, c, NULL, d);
  list_row(out, c->id, c, claim_get(c, "record"), text_str(&title));
  text_add_char(out, '\n');
  for (const char *p = claim_get(c, "restricted"); (p = claim_next_made(&made, p)) != NULL;) {
    list_row(out, made.id, c, made.record, text_str(&title));
    text_printf(out, ", when %s\n", made.condition);
  }
  return ok;
}

int run_list(const struct options *o, const char *data, struct diag *d) {
  bool keys = option(o, OPT_SCENE_KEYS);
  if (keys && o->operands.n) return usage("list --scene-keys takes no operand, not %.200s", o->operands.word[0]);
  if (keys) return list_scene_keys(o);
  if (option(o, OPT_JSON)) return usage("list writes JSON with --scene-keys only");
  if (o->operands.n == 1 && strcmp(o->operands.word[0], "scenes") == 0) return list_scenes(data);
  if (o->operands.n) return usage("list takes no operand but scenes, not %.200s", o->operands.word[0]);
  LOCAL(model, m);
  OWNED(claims) c = {.n = 0};
  bool ok = load_model(&m, data, o, d) && claims_load(&c, data, "claims", "claim", d) && claims_complete(&c, NULL, d);
  OWNED(text) out = {0};
  for (size_t i = 0; ok && i < c.n; i++) ok = list_claim(&out, &m, &c.claim[i], d);
  if (ok) terminal_print(&out);
  return EXIT_AS_RECORDED;
}

int run_check(const struct options *o, const char *data, struct diag *none) {
  (void)none; /* each file has its own */
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < o->operands.n; i++) {
    struct diag d = {0};
    if (audit_check_file(o->operands.word[i], data, &d))
      printf("%s: ok\n", o->operands.word[i]);
    else
      status = bad_input(&d);
  }
  return status;
}
