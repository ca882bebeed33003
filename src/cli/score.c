/* What stands beside a report and is shown with it: the score of the study of damages, from the mutation.json that
   stickslip mutate --out leaves in a folder next to the report's. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

/* A count that the object holds under the key, or -1. */
static long member_count(const struct json_value *v, const char *key) {
  const struct json_value *m = json_member(v, key);
  char *end;
  if (!m || m->kind != JSON_KIND_NUMBER) return -1;
  long n = strtol(m->text, &end, 10);
  return *end || n < 0 || n > 1000000000 ? -1 : n;
}

/* Only a study of every damage of what the audit read, in its scene, is a score. */
static bool read_score(struct mutation_score *s, const struct json_value *root, const struct audit_result *r) {
  static const struct {
    const char *key;
    size_t at;
  } of[] = {{"counted", offsetof(struct mutation_score, counted)},
            {"noticed", offsetof(struct mutation_score, noticed)},
            {"formulas", offsetof(struct mutation_score, formulas)},
            {"equivalent", offsetof(struct mutation_score, equivalent)},
            {"on_motions", offsetof(struct mutation_score, on_motions)},
            {"needs_text", offsetof(struct mutation_score, needs_text)},
            {"errata", offsetof(struct mutation_score, errata)}};
  const struct json_value *score = json_member(root, "score");
  const char *schema = json_text(root, "schema"), *scene = json_text(root, "scene"),
             *subject = json_text(root, "subject");
  bool ok = schema && strcmp(schema, "stickslip-mutation-2") == 0 && scene && strcmp(scene, r->scene) == 0 && subject &&
            r->subject && strcmp(subject, r->subject) == 0;
  ok =
      ok && score && member_count(root, "tried") > 0 && member_count(root, "tried") == member_count(root, "population");
  for (size_t i = 0; ok && i < sizeof of / sizeof *of; i++) {
    long n = member_count(score, of[i].key);
    memcpy((char *)s + of[i].at, &n, sizeof n);
    ok = n >= 0;
  }
  return ok;
}

bool score_beside(struct mutation_score *s, const char *folder, const struct audit_result *r) {
  enum { LARGEST = 1 << 26 };
  struct text path;
  struct source src;
  struct arena a;
  struct json_value root;
  struct diag d;
  diag_init(&d);
  text_init(&path);
  arena_init(&a);
  join_path(&path, folder, "../mutation/mutation.json");
  bool there = access(text_str(&path), R_OK) == 0;
  bool ok = there && source_read(&src, text_str(&path), LARGEST, &d);
  if (ok) {
    ok = json_parse(&root, &a, &src, &d) && read_score(s, &root, r);
    source_clear(&src);
  }
  if (d.set) fprintf(stderr, "stickslip: warning: %s\n", d.message);
  arena_clear(&a);
  text_clear(&path);
  return ok;
}
