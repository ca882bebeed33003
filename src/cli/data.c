/* Where the data is, and loading it. */
#include <unistd.h>

#include "cli.h"

bool find_data(struct text *data, struct diag *d) {
  char program[4096];
  ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
  program[n > 0 ? n : 0] = '\0';
  if (data_folder_find(data, program)) return true;
  return diag_set(d, "error: the data folder verify/ was not found; set STICKSLIP_DATA to it");
}

void join_path(struct text *out, const char *folder, const char *name) {
  text_reset(out);
  text_printf(out, "%s/%s", folder, name);
}

bool read_in(struct source *s, const char *folder, const char *name, size_t max, struct diag *d) {
  OWNED(text) path = {0};
  join_path(&path, folder, name);
  return source_read(s, text_str(&path), max, d);
}

bool load_model(struct model *m, const char *data, const struct options *o, struct diag *d) {
  return model_load(m, data, option(o, OPT_PAPER), option(o, OPT_OVERLAY), d);
}

bool load_files(struct paper_files *f, const char *data, const struct options *o, struct diag *d) {
  return paper_files_load(f, data, option(o, OPT_PAPER), option(o, OPT_OVERLAY), d);
}

bool inputs_load(struct inputs *in, const char *data, const struct options *o, struct diag *d) {
  paper_files_init(&in->files);
  return load_scene(&in->scene, "paper", data, o, SCENE_EXACT, d) && load_files(&in->files, data, o, d);
}

void inputs_clear(struct inputs *in) {
  paper_files_clear(&in->files);
  scene_clear(&in->scene);
}
