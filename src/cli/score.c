/* What stands beside a report and is shown with it: the score of the study of damages, from the mutation.json that
   stickslip mutate --out leaves in a folder next to the report's. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "report/mutation.h"

/* A count that the object holds under the key, or -1. */
static long member_count(const struct json_value *v, const char *key) {
  const struct json_value *m = json_member(v, key);
  char *end;
  if (!m || m->kind != JSON_KIND_NUMBER) return -1;
  long n = strtol(m->text, &end, 10);
  return *end || n < 0 || n > 1000000000 ? -1 : n;
}

/* Only a study of every damage of what the audit read, in its scene, is a score. */
static bool read_score(struct mutation_score *s, struct arena *a, const struct json_value *root,
                       const struct source *src, const struct audit_result *r) {
  const struct json_value *score = json_member(root, "score");
  long tried = member_count(root, "tried");
  return json_says(root, "schema", MUTATION_SCHEMA) && json_says(root, "scene", r->scene) &&
         json_says(root, "subject", r->subject) && score && tried > 0 && tried == member_count(root, "population") &&
         shape_read(s, a, &mutation_score_shape, score, src, NULL);
}

bool score_beside(struct mutation_score *s, const char *folder, const struct audit_result *r) {
  enum { LARGEST = 1 << 26 };
  OWNED(text) path = {0};
  OWNED(source) src = {.name = NULL};
  LOCAL(arena, a);
  struct json_value root;
  struct diag d = {0};
  join_path(&path, folder, "../mutation/mutation.json");
  bool there = access(text_str(&path), R_OK) == 0;
  bool ok = there && source_read(&src, text_str(&path), LARGEST, &d) && json_parse(&root, &a, &src, &d) &&
            read_score(s, &a, &root, &src, r);
  if (d.set) fprintf(stderr, "stickslip: warning: %s\n", d.message);
  return ok;
}
