/* stickslip check: reads a file as its suffix says and reports the first thing wrong with it. */
#include "audit.h"
#include "claim/claim.h"
#include "value/title.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool has_suffix(const char *path, const char *suffix) {
  size_t n = strlen(path), k = strlen(suffix);
  return n > k && strcmp(path + n - k, suffix) == 0;
}

/* --- Whose file it is --- */

static bool holds_paper(const char *folder) {
  struct text path;
  struct arena a;
  struct diag none;
  size_t n = 0;
  text_init(&path);
  arena_init(&a);
  diag_init(&none);
  text_printf(&path, "%s/paper", folder);
  free(folder_files(&n, text_str(&path), ".eq", &a, &none));
  arena_clear(&a);
  text_clear(&path);
  return n > 0;
}

/* The data folder that a file stands in, itself or in its paper/, claims/, controls/ or scenes/; false: in none. */
static bool data_around(struct text *out, const char *path) {
  static const char *const parts[] = {"paper", "claims", "controls", "scenes"};
  char here[4096];
  struct text folder;
  text_init(&folder);
  if (strchr(path, '/') || !getcwd(here, sizeof here))
    path_folder(&folder, path);
  else
    text_add(&folder, here);
  if (word_find(path_base(text_str(&folder)), parts, 4) < 4)
    path_folder(out, text_str(&folder));
  else
    text_printf(out, "%s", text_str(&folder));
  text_clear(&folder);
  return holds_paper(text_str(out));
}

/* --- Equations --- */

/* The title that an equation file gives its paper, or NULL; the file is to be cleared. */
static const char *title_in(struct record_file *f, const char *path) {
  struct source src;
  struct diag later;
  diag_init(&later);
  *f = (struct record_file){.n_records = 0};
  if (!source_read(&src, path, MAX_CLAIM_FILE, &later)) return NULL;
  return record_file_parse(f, src, &later) ? record_get(&f->records[0], "paper") : NULL;
}

/* Each record of a file of controls is seen alone, as in an audit. */
static bool check_controls(const struct model *m, struct diag *d) {
  const struct record_file *f = m->files[m->n_files - 1];
  bool ok = true;
  for (size_t i = 1; ok && i < f->n_records; i++)
    ok = view_check((struct view){m, LAYER_CORRECTED, NULL, f->records[i].id_name}, d);
  return ok;
}

static bool check_read(struct model *m, enum rank rank, struct diag *d) {
  return model_check_tex(m, rank, d) && view_check((struct view){m, LAYER_PRINTED, NULL, NULL}, d);
}

/* A file that bears the title of another paper than the data folder's is all that is known of that paper. */
static bool check_alone(bool *alone, const char *path, const char *folder, struct diag *d) {
  struct model m;
  struct record_file f;
  const char *title = title_in(&f, path);
  model_init(&m);
  bool ok = !title || model_add_folder(&m, folder, RANK_PAPER, d);
  *alone = ok && title && !(m.paper && strcmp(m.paper, title) == 0);
  model_clear(&m);
  record_file_clear(&f);
  if (!*alone) return ok;
  model_init(&m);
  ok = model_add_file(&m, path, RANK_PAPER, d) && check_read(&m, RANK_PAPER, d);
  model_clear(&m);
  return ok;
}

/* An equation file is read over the paper's own, so that it may use their names.  A file of controls damages one name
   several times over; its records bear ids that begin with ctl-. */
static bool check_over(const char *path, const char *folder, struct diag *d) {
  struct model m;
  model_init(&m);
  bool ok = model_add_folder(&m, folder, RANK_PAPER, d) && model_add_file(&m, path, RANK_CONTROL, d);
  const struct record_file *f = ok ? m.files[m.n_files - 1] : NULL;
  bool controls = f && f->n_records > 1 && strncmp(f->records[1].id_name, "ctl-", 4) == 0;
  if (ok && controls) ok = check_controls(&m, d);
  model_clear(&m);
  if (ok && !controls) {
    model_init(&m);
    ok = model_add_folder(&m, folder, RANK_PAPER, d) && model_add_file(&m, path, RANK_USER, d) &&
         check_read(&m, RANK_USER, d);
    model_clear(&m);
  }
  return ok;
}

static bool check_equations(const char *path, const char *data, struct diag *d) {
  struct text folder;
  bool alone;
  text_init(&folder);
  text_printf(&folder, "%s/paper", data);
  bool ok = check_alone(&alone, path, text_str(&folder), d) && (alone || check_over(path, text_str(&folder), d));
  text_clear(&folder);
  return ok;
}

/* --- Claims, statements, roots, scenes --- */

static bool has_file(const struct claims *c, const char *path) {
  for (size_t i = 0; i < c->n_files; i++)
    if (strcmp(c->files[i]->src.name, path) == 0) return true;
  return false;
}

/* The rules of each claim; where the file is one of the data folder, those of all claims together. */
static bool check_rules(const struct claims *own, bool control, const char *path, const char *data, struct diag *d) {
  struct model m;
  struct claims claims = {.n = 0}, controls = {.n = 0};
  model_init(&m);
  bool ok = model_load(&m, data, NULL, NULL, d);
  ok = ok && (control || titles_check(&m, own, d));
  for (size_t i = 0; ok && !control && i < own->n; i++) ok = claim_keeps_rules(&m, &own->claim[i], d);
  ok = ok && claims_load_around(&claims, data, "claims", "claim", control ? NULL : path, d) &&
       claims_load_around(&controls, data, "controls", "control", control ? path : NULL, d);
  bool stands = has_file(control ? &controls : &claims, path);
  ok = ok && (!stands || claims_keep_rules(&m, &claims, &controls, d));
  claims_clear(&controls);
  claims_clear(&claims);
  model_clear(&m);
  return ok;
}

/* A file holds claims and results, or controls; its first record says which. */
static bool check_claims(const char *path, const char *data, struct diag *d) {
  struct claims c = {.n = 0};
  struct source src;
  if (!source_read(&src, path, MAX_CLAIM_FILE, d)) return false;
  struct record_file f;
  bool ok = record_file_parse(&f, src, d);
  bool control = ok && f.n_records > 1 && strcmp(f.records[1].kind_name, "control") == 0;
  record_file_clear(&f);
  ok = ok && claims_add_file(&c, path, control ? "control" : "claim", d);
  ok = ok && claims_check(&c, control, d) && (c.n == 0 || check_rules(&c, control, path, data, d));
  claims_clear(&c);
  return ok;
}

/* By itself; where it bears the name of the data folder's own, beside the claims there. */
static bool check_statements(const char *path, const char *data, struct diag *d) {
  struct model m;
  struct claims own = {.n = 0}, all = {.n = 0}, claims = {.n = 0};
  model_init(&m);
  bool ok = claims_add_file(&own, path, "statement", d);
  for (size_t i = 0; ok && i < own.n; i++) ok = statement_check(&own.claim[i], d);
  ok = ok && claims_load_around(&all, data, "paper", "statement", path, d);
  if (ok && has_file(&all, path))
    ok = model_load(&m, data, NULL, NULL, d) && claims_load(&claims, data, "claims", "claim", d) &&
         statements_keep_rules(&m, &claims, &all, d);
  claims_clear(&claims);
  claims_clear(&all);
  claims_clear(&own);
  model_clear(&m);
  return ok;
}

/* By itself; where it bears the name of the data folder's own, beside the claims there. */
static bool check_roots(const char *path, const char *data, struct diag *d) {
  struct claims own = {.n = 0}, all = {.n = 0}, claims = {.n = 0};
  bool ok = claims_add_file(&own, path, "root", d);
  for (size_t i = 0; ok && i < own.n; i++) ok = root_check(&own.claim[i], d);
  ok = ok && claims_load_around(&all, data, "claims", "root", path, d);
  if (ok && has_file(&all, path))
    ok = claims_load(&claims, data, "claims", "claim", d) && roots_keep_rules(&claims, &all, d);
  claims_clear(&claims);
  claims_clear(&all);
  claims_clear(&own);
  return ok;
}

/* The claims and the quantities that a scene asks for are looked up where it asks for any. */
static bool check_asked(const struct scene *s, const char *data, struct diag *d) {
  if (!s->asked.claims.n && !s->asked.values.n) return true;
  struct model m;
  struct claims c = {.n = 0};
  struct text paper;
  text_init(&paper);
  model_init(&m);
  text_printf(&paper, "%s/paper", data);
  bool ok = claims_load(&c, data, "claims", "claim", d) && model_add_folder(&m, text_str(&paper), RANK_PAPER, d) &&
            scene_check_asked(s, &c, &m, d);
  model_clear(&m);
  claims_clear(&c);
  text_clear(&paper);
  return ok;
}

static bool check_scene(const char *path, const char *data, struct diag *d) {
  struct scene s;
  bool ok = scene_load_with(&s, path, data, NULL, SCENE_OF_ANY_SYSTEM, d);
  if (ok && s.system) {
    struct mech m;
    struct mech_word w;
    ok = scene_load_system(&m, &w, &s, data, d);
    mech_clear(&m);
  } else {
    ok = ok && check_asked(&s, data, d);
  }
  scene_clear(&s);
  return ok;
}

static bool check_system(const char *path, struct diag *d) {
  struct mech m;
  bool ok = mech_load(&m, path, d);
  mech_clear(&m);
  return ok;
}

static bool check_by_suffix(const char *path, const char *data, struct diag *d) {
  if (has_suffix(path, ".eq")) return check_equations(path, data, d);
  if (has_suffix(path, ".claim")) return check_claims(path, data, d);
  if (has_suffix(path, ".scene")) return check_scene(path, data, d);
  if (has_suffix(path, ".statements")) return check_statements(path, data, d);
  if (has_suffix(path, ".roots")) return check_roots(path, data, d);
  if (has_suffix(path, ".system")) return check_system(path, d);
  diag_set(d, "%s: error: not a kind of file that can be checked; .eq, .claim, .scene, .system, .statements or .roots",
           path);
  return false;
}

bool audit_check_file(const char *path, const char *data, struct diag *d) {
  struct text around;
  text_init(&around);
  bool stands = data_around(&around, path);
  bool ok = check_by_suffix(path, stands ? text_str(&around) : data, d);
  text_clear(&around);
  return ok;
}
