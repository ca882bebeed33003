/* The sources of everything that was loaded are still there; a changed text is read with the others of its part. */
#include "material.h"

#include "value/title.h"

#include <stdlib.h>
#include <string.h>

static void add_file(struct material *m, enum material_part part, enum rank rank, const struct record_file *f) {
  m->file[m->n++] = (struct material_file){part, rank, path_base(f->src.name), f};
}

void material_init(struct material *m, const struct audit_data *data, const struct scene *scene) {
  *m = (struct material){.data = *data, .scene = scene};
  m->file = ss_malloc((data->model->n_files + data->claims->n_files + data->controls->n_files + 1) * sizeof *m->file);
  for (size_t i = 0; i < data->model->n_files; i++)
    add_file(m, PART_EQUATIONS, data->model->ranks[i], data->model->files[i]);
  for (size_t i = 0; i < data->claims->n_files; i++) add_file(m, PART_CLAIMS, RANK_PAPER, data->claims->files[i]);
  for (size_t i = 0; i < data->controls->n_files; i++) add_file(m, PART_CONTROLS, RANK_PAPER, data->controls->files[i]);
  struct source src;
  struct diag d = {0};
  source_from_string(&src, scene->source[0]->name, scene->source[0]->text);
  if (record_file_parse(&m->scene_records, src, &d)) add_file(m, PART_SCENE, RANK_PAPER, &m->scene_records);
}

void material_clear(struct material *m) {
  record_file_clear(&m->scene_records);
  free(m->file);
}

bool file_is_named(const char *file, const char *item) {
  size_t n = strlen(item);
  return strncmp(file, item, n) == 0 && (file[n] == '\0' || file[n] == '.');
}

bool material_check(const struct audit_data *data, struct diag *d) {
  return model_check_tex(data->model, RANK_STABLE, d) && data_check(data, d) &&
         titles_check(data->model, data->claims, d);
}

/* The text of the file, or the changed one in its place. */
static const char *text_of(const struct material *m, size_t i, size_t file, const char *text) {
  return i == file ? text : m->file[i].parsed->src.text;
}

static bool change_claims(struct claims *out, const struct material *m, size_t file, const char *text, struct diag *d) {
  const char *kind = m->file[file].part == PART_CONTROLS ? "control" : "claim";
  bool ok = true;
  for (size_t i = 0; ok && i < m->n; i++)
    if (m->file[i].part == m->file[file].part)
      ok = claims_add_text(out, m->file[i].name, text_of(m, i, file, text), kind, d);
  return ok && (m->file[file].part == PART_CONTROLS || claims_complete(out, m->data.statements, d));
}

static bool change_model(struct model *out, const struct material *m, size_t file, const char *text, struct diag *d) {
  bool ok = true;
  for (size_t i = 0; ok && i < m->n; i++)
    if (m->file[i].part == PART_EQUATIONS)
      ok = model_add_text(out, m->file[i].name, text_of(m, i, file, text), m->file[i].rank, d);
  return ok;
}

bool material_change(struct changed_material *c, const struct material *m, size_t file, const char *text,
                     struct diag *d) {
  *c = (struct changed_material){.data = m->data, .scene = m->scene};
  model_init(&c->own_model);
  switch (m->file[file].part) {
  case PART_EQUATIONS:
    c->data.model = &c->own_model;
    return change_model(&c->own_model, m, file, text, d);
  case PART_CLAIMS:
    c->data.claims = &c->own_claims;
    return change_claims(&c->own_claims, m, file, text, d);
  case PART_CONTROLS:
    c->data.controls = &c->own_claims;
    return change_claims(&c->own_claims, m, file, text, d);
  case PART_SCENE:
    c->scene = &c->own_scene;
    return scene_load_text(&c->own_scene, m->scene->name, text, NULL, false, d);
  }
  return false;
}

void changed_material_clear(struct changed_material *c) {
  if (c->scene == &c->own_scene) scene_clear(&c->own_scene);
  claims_clear(&c->own_claims);
  model_clear(&c->own_model);
}
