/* The system file that a scene names, and its word in that system. */
#include <string.h>

#include "scene.h"

/* As scenes are found: a path, or a name in the data folder. */
void scene_system_path(struct text *out, const struct scene *s, const char *data) {
  static const char suffix[] = ".system";
  const char *spec = s->system;
  size_t len = strlen(spec), own = sizeof suffix - 1;
  if (strchr(spec, '/') || (len > own && strcmp(spec + len - own, suffix) == 0))
    text_add(out, spec);
  else
    text_printf(out, "%s/systems/%s%s", data, spec, suffix);
}

bool scene_load_system(struct mech *m, struct mech_word *w, const struct scene *s, const char *data, struct diag *d) {
  struct text path;
  size_t at;
  const char *why;
  text_init(&path);
  scene_system_path(&path, s, data);
  bool ok = mech_load(m, text_str(&path), d);
  text_clear(&path);
  w->n = 0;
  if (!ok || !s->system_word.text || mech_word_parse(w, &at, &why, s->system_word.text, m)) return ok;
  diag_at(d, s->system_word.src, s->system_word.at + at, "%s", why);
  return false;
}
