/* Where the data is, and loading it. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli.h"

static bool is_folder(const char *path) {
  struct stat st;
  return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

/* $STICKSLIP_DATA, or verify/ above the build folder that the program stands in, or the installed folder: beside the
   program's own, else where it was to be installed. */
bool find_data(struct text *data, struct diag *d) {
  static const struct {
    int up; /* folders above the program's own */
    const char *name;
  } beside[] = {{1, "verify"}, {2, "verify"}, {1, "share/stickslip"}};
  const char *env = getenv("STICKSLIP_DATA");
  char exe[4096];
  ssize_t n = readlink("/proc/self/exe", exe, sizeof exe - 1);
  text_reset(data);
  if (env) {
    text_add(data, env);
    return true;
  }
  for (size_t i = 0; n > 0 && i < sizeof beside / sizeof *beside; i++) {
    size_t end = (size_t)n;
    for (int up = -1; up < beside[i].up; up++)
      while (end > 0 && exe[--end] != '/') continue;
    text_reset(data);
    text_printf(data, "%.*s/%s", (int)end, exe, beside[i].name);
    if (is_folder(text_str(data))) return true;
  }
  text_reset(data);
  text_add(data, STICKSLIP_DATADIR);
  if (is_folder(text_str(data))) return true;
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
