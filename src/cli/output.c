/* The files that a command writes to one folder. */
#include "cli.h"

void output_init(struct output *out, const char *folder) {
  out->folder = folder;
  out->n = 0;
}

void output_clear(struct output *out) {
  for (int i = 0; i < out->n; i++) {
    text_clear(&out->body[i]);
    text_clear(&out->path[i]);
  }
  out->n = 0;
}

struct text *output_add(struct output *out, const char *name) {
  if (out->n == MAX_FILE_ITEMS) abort();
  int i = out->n++;
  text_init(&out->path[i]);
  text_init(&out->body[i]);
  join_path(&out->path[i], out->folder, name);
  return &out->body[i];
}

void output_drop(struct output *out) {
  out->n--;
  text_clear(&out->body[out->n]);
  text_clear(&out->path[out->n]);
}

void output_add_tables(struct output *out, const struct audit_result *r) {
  for (size_t i = 0; i < r->n_tables; i++) text_add(output_add(out, r->tables[i].name), r->tables[i].text);
}

bool output_write(const struct output *out, struct diag *d) {
  struct file_item item[MAX_FILE_ITEMS];
  for (int i = 0; i < out->n; i++)
    item[i] = (struct file_item){text_str(&out->path[i]), text_str(&out->body[i]), out->body[i].len};
  return folder_make(out->folder, d) && files_write(item, out->n, d);
}
