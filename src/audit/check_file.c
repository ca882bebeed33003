/* stickslip check: reads a file as its suffix says and reports the first thing wrong with it. */
#include <string.h>

#include "audit_impl.h"

static bool has_suffix(const char *path, const char *suffix) {
  size_t n = strlen(path), k = strlen(suffix);
  return n > k && strcmp(path + n - k, suffix) == 0;
}

/* An equation file is read over the paper's own, so that it may use their names. */
static bool check_equations(const char *path, const char *data, struct diag *d) {
  struct model m;
  struct text folder;
  text_init(&folder);
  text_printf(&folder, "%s/paper", data);
  model_init(&m);
  bool ok = model_add_folder(&m, text_str(&folder), RANK_PAPER, d) && model_add_file(&m, path, RANK_USER, d) &&
            view_check((struct view){&m, LAYER_PRINTED, NULL, NULL}, d);
  model_clear(&m);
  text_clear(&folder);
  return ok;
}

static bool check_claims(const char *path, struct diag *d) {
  struct claims c = {.n = 0};
  bool ok = claims_add_file(&c, path, "claim", d);
  for (size_t i = 0; ok && i < c.n; i++) {
    const char *record = claim_get(&c.claim[i], "record");
    if (!claim_get(&c.claim[i], "kind") || !claim_get(&c.claim[i], "title")) {
      diag_at(d, &c.claim[i].file->src, c.claim[i].record->id.begin, "%s: a claim has a kind and a title",
              c.claim[i].id);
      ok = false;
    } else if (record && verdict_parse(record) == N_VERDICTS) {
      diag_at(d, &c.claim[i].file->src, record_field(c.claim[i].record, "record")->value.begin, "not a verdict");
      ok = false;
    }
  }
  claims_clear(&c);
  return ok;
}

bool audit_check_file(const char *path, const char *data, struct diag *d) {
  if (has_suffix(path, ".eq")) return check_equations(path, data, d);
  if (has_suffix(path, ".claim")) return check_claims(path, d);
  if (has_suffix(path, ".scene")) {
    struct scene s;
    bool ok = scene_load(&s, path, data, d);
    scene_clear(&s);
    return ok;
  }
  diag_set(d, "%s: error: not a kind of file that can be checked; .eq, .claim or .scene", path);
  return false;
}
