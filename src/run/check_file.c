/* stickslip check: reads a file as its suffix says and reports the first thing wrong with it. */
#include "audit.h"
#include "claim/claim.h"
#include "value/title.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Whose file it is --- */

static bool holds_paper(const char *folder) {
  OWNED(text) path = {0};
  LOCAL(arena, a);
  struct diag none = {0};
  size_t n = 0;
  text_printf(&path, "%s/paper", folder);
  free(folder_files(&n, text_str(&path), ".eq", &a, &none));
  return n > 0;
}

/* The data folder that a file stands in, itself or in its paper/, claims/, controls/ or scenes/; false: in none. */
static bool data_around(struct text *out, const char *path) {
  static const char *const parts[] = {"paper", "claims", "controls", "scenes"};
  char here[4096];
  OWNED(text) folder = {0};
  if (strchr(path, '/') || !getcwd(here, sizeof here))
    path_folder(&folder, path);
  else
    text_add(&folder, here);
  if (word_find(path_base(text_str(&folder)), parts, 4) < 4)
    path_folder(out, text_str(&folder));
  else
    text_printf(out, "%s", text_str(&folder));
  return holds_paper(text_str(out));
}

/* --- Equations --- */

/* The title that an equation file gives its paper, or NULL; the file is to be cleared. */
static const char *title_in(struct record_file *f, const char *path) {
  struct source src;
  struct diag later = {0};
  *f = (struct record_file){.n_records = 0};
  if (!source_read(&src, path, MAX_CLAIM_FILE, &later)) return NULL;
  return record_file_parse(f, src, &later) ? record_get(&f->records[0], "paper") : NULL;
}

/* A file to be checked, and what is loaded to hold it against: the model, the claims of the file itself, and those of
   the data folder, with the file in the place of its namesake. */
struct checked {
  const char *path, *data;
  struct text folder; /* of the paper */
  struct model model;
  struct claims own, all, claims, controls;
  struct diag *d;
};

static void checked_clear(struct checked *x) {
  claims_clear(&x->controls);
  claims_clear(&x->claims);
  claims_clear(&x->all);
  claims_clear(&x->own);
  model_clear(&x->model);
  text_clear(&x->folder);
}

/* Each record of a file of controls is seen alone, as in an audit. */
static bool check_controls(const struct model *m, struct diag *d) {
  const struct record_file *f = m->files[m->n_files - 1];
  bool ok = true;
  for (size_t i = 1; ok && i < f->n_records; i++)
    ok = view_check((struct view){m, LAYER_CORRECTED, NULL, f->records[i].id_name}, d);
  return ok;
}

/* The file as one of that rank, over the paper of the data folder unless it is all there is of its paper. */
static bool load_equations(struct checked *x, bool alone, enum rank rank) {
  model_clear(&x->model);
  model_init(&x->model);
  return (alone || model_add_folder(&x->model, text_str(&x->folder), RANK_PAPER, x->d)) &&
         model_add_file(&x->model, x->path, rank, x->d);
}

static bool check_read(struct checked *x, bool alone, enum rank rank) {
  return load_equations(x, alone, rank) && model_check_tex(&x->model, rank, x->d) &&
         view_check((struct view){&x->model, LAYER_PRINTED, NULL, NULL}, x->d);
}

/* An equation file is read over the paper's own, so that it may use their names.  A file of controls damages one name
   several times over; its records bear ids that begin with ctl-. */
static bool check_over(struct checked *x) {
  if (!load_equations(x, false, RANK_CONTROL)) return false;
  const struct record_file *f = x->model.files[x->model.n_files - 1];
  bool controls = f->n_records > 1 && strncmp(f->records[1].id_name, "ctl-", 4) == 0;
  return controls ? check_controls(&x->model, x->d) : check_read(x, false, RANK_USER);
}

/* A file that bears the title of another paper than the data folder's is all that is known of that paper. */
static bool check_equations(struct checked *x) {
  OWNED(record_file) f;
  const char *title = title_in(&f, x->path);
  bool ok = !title || model_add_folder(&x->model, text_str(&x->folder), RANK_PAPER, x->d);
  bool alone = title && !(x->model.paper && strcmp(x->model.paper, title) == 0);
  return ok && (alone ? check_read(x, true, RANK_PAPER) : check_over(x));
}

/* --- Claims, statements, roots, scenes --- */

static bool load_model(struct checked *x) {
  return model_load(&x->model, x->data, NULL, NULL, x->d);
}

static bool load_claims(struct checked *x) {
  return claims_load(&x->claims, x->data, "claims", "claim", x->d);
}

static bool has_file(const struct claims *c, const char *path) {
  for (size_t i = 0; i < c->n_files; i++)
    if (strcmp(c->files[i]->src.name, path) == 0) return true;
  return false;
}

/* The rules of each claim; where the file is one of the data folder, those of all claims together. */
static bool check_rules(struct checked *x, bool control) {
  bool ok = load_model(x) && claims_load(&x->all, x->data, "paper", "statement", x->d);
  claims_take_words(&x->own, &x->all);
  ok = ok && (control || titles_check(&x->model, &x->own, x->d));
  for (size_t i = 0; ok && !control && i < x->own.n; i++) ok = claim_keeps_rules(&x->model, &x->own.claim[i], x->d);
  ok = ok && claims_load_around(&x->claims, x->data, "claims", "claim", control ? NULL : x->path, x->d) &&
       claims_complete(&x->claims, &x->all, x->d) &&
       claims_load_around(&x->controls, x->data, "controls", "control", control ? x->path : NULL, x->d);
  bool stands = has_file(control ? &x->controls : &x->claims, x->path);
  return ok && (!stands || claims_keep_rules(&x->model, &x->claims, &x->controls, x->d));
}

/* A file holds claims and results, or controls; its first record says which. */
static bool check_claims(struct checked *x) {
  struct source src;
  if (!source_read(&src, x->path, MAX_CLAIM_FILE, x->d)) return false;
  OWNED(record_file) f;
  bool ok = record_file_parse(&f, src, x->d);
  bool control = ok && f.n_records > 1 && strcmp(f.records[1].kind_name, "control") == 0;
  return ok && claims_add_file(&x->own, x->path, control ? "control" : "claim", x->d) &&
         claims_check(&x->own, control, x->d) && (x->own.n == 0 || check_rules(x, control));
}

/* Statements and roots by themselves, then all of the folder where the file bears the name of one of its own. */
static bool check_each(struct checked *x, const char *kind, bool (*check)(const struct claim *c, struct diag *d),
                       const char *folder,
                       bool (*together)(const struct model *m, const struct claims *claims, const struct claims *all,
                                        struct diag *d)) {
  bool ok = claims_add_file(&x->own, x->path, kind, x->d);
  for (size_t i = 0; ok && i < x->own.n; i++) ok = check(&x->own.claim[i], x->d);
  return ok && claims_load_around(&x->all, x->data, folder, kind, x->path, x->d) &&
         (!has_file(&x->all, x->path) ||
          (load_model(x) && load_claims(x) && together(&x->model, &x->claims, &x->all, x->d)));
}

static bool check_statements(struct checked *x) {
  return check_each(x, "statement", statement_check, "paper", statements_keep_rules);
}

static bool check_roots(struct checked *x) {
  return check_each(x, "root", root_check, "claims", roots_keep_rules);
}

/* The claims and the quantities that a scene asks for are looked up where it asks for any. */
static bool check_asked(struct checked *x, const struct scene *s) {
  return (!s->asked.claims.n && !s->asked.values.n) ||
         (load_claims(x) && model_add_folder(&x->model, text_str(&x->folder), RANK_PAPER, x->d) &&
          scene_check_asked(s, &x->claims, &x->model, x->d));
}

static bool check_scene(struct checked *x) {
  OWNED(scene) s;
  if (!scene_load_with(&s, x->path, x->data, NULL, SCENE_OF_ANY_SYSTEM, x->d)) return false;
  if (!s.system) return check_asked(x, &s);
  OWNED(mech) m;
  struct mech_word w;
  return scene_load_system(&m, &w, &s, x->data, true, x->d);
}

static bool check_system(struct checked *x) {
  OWNED(mech) m;
  return mech_load_with(&m, x->path, NULL, true, x->d);
}

bool audit_check_file(const char *path, const char *data, struct diag *d) {
  static const struct {
    const char *suffix;
    bool (*check)(struct checked *x);
  } kinds[] = {{".eq", check_equations},          {".claim", check_claims}, {".scene", check_scene},
               {".statements", check_statements}, {".roots", check_roots},  {".system", check_system}};
  OWNED(text) around = {0};
  OWNED(checked) x = {.path = path, .data = data_around(&around, path) ? text_str(&around) : data, .d = d};
  bool known = false, ok = false;
  text_printf(&x.folder, "%s/paper", x.data);
  model_init(&x.model);
  for (size_t i = 0; !known && i < sizeof kinds / sizeof *kinds; i++) {
    known = path_has_suffix(path, kinds[i].suffix);
    if (known) ok = kinds[i].check(&x);
  }
  if (!known)
    diag_set(d,
             "%s: error: not a kind of file that can be checked; .eq, .claim, .scene, .system, .statements or .roots",
             path);
  return ok;
}
