/* Where the data is, and loading it. */
#include <unistd.h>

#include "cli.h"

bool find_data(struct text *data, struct diag *d) {
  char program[4096];
  ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
  program[n > 0 ? n : 0] = '\0';
  if (data_folder_find(data, program)) return true;
  diag_set(d, "error: the data folder verify/ was not found; set STICKSLIP_DATA to it");
  return false;
}

void join_path(struct text *out, const char *folder, const char *name) {
  text_reset(out);
  text_printf(out, "%s/%s", folder, name);
}

bool load_model(struct model *m, const char *data, const struct options *o, struct diag *d) {
  return model_load(m, data, option(o, OPT_PAPER), option(o, OPT_OVERLAY), d);
}
