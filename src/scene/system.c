/* The system file that a scene names, its word in that system, and values of that file's parameters. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"
#include "scene_impl.h"

/* --- Values of parameters --- */

/* The place of the link to the value of that name, or to the end of the list. */
static struct mech_given **find(struct scene *s, const char *name, size_t len) {
  struct mech_given **at = &s->system_value;
  while (*at && (strlen((*at)->name) != len || strncmp((*at)->name, name, len) != 0)) at = &(*at)->next;
  return at;
}

static void take_out(struct mech_given **at) {
  struct mech_given *v = *at;
  *at = v->next;
  v->next = NULL;
  mech_given_free(v);
}

bool scene_system_take(struct scene *s, const char *name, size_t len) {
  struct mech_given **at = find(s, name, len);
  if (!*at) return false;
  take_out(at);
  return true;
}

void scene_system_clear(struct scene *s) {
  mech_given_free(s->system_value);
}

bool scene_system_give(struct scene *s, const struct mech_given *line, const struct expr *e, const struct source *file,
                       struct diag *d) {
  int depth = 0, n = 1;
  size_t work = 0;
  struct constant c = {.src = line->src, .d = d, .depth = &depth, .work = &work};
  struct mech_given **at = find(s, line->name, strlen(line->name)), *v;
  if (*at && (line->src == file || (*at)->src != file))
    return diag_at(d, line->src, line->place, "%s is given twice; leave one of the lines out", line->name);
  for (v = s->system_value; v; v = v->next) n++;
  if (n > MAX_SYSTEM_VALUES)
    return diag_at(d, line->src, line->place, "more than %d values of a system's parameters", MAX_SYSTEM_VALUES);
  if (*at) take_out(at);
  v = ss_malloc(sizeof *v);
  *v = *line;
  v->next = s->system_value;
  v->name = ss_strdup(line->name);
  fmpq_init(v->low);
  fmpq_init(v->high);
  s->system_value = v;
  return constant_interval(v->low, v->high, &c, e);
}

/* --- The system --- */

void scene_system_path(struct text *out, const char *spec, const char *data) {
  if (scene_spec_is_path(spec, SYSTEM_SUFFIX))
    text_add(out, spec);
  else
    text_printf(out, "%s/systems/%s%s", data, spec, SYSTEM_SUFFIX);
}

bool scene_load_system(struct mech *m, struct mech_word *w, const struct scene *s, const char *data, bool box,
                       struct diag *d) {
  OWNED(text) path = {0};
  size_t at;
  const char *why;
  scene_system_path(&path, s->system, data);
  bool ok = access(text_str(&path), F_OK) == 0;
  if (ok) {
    ok = mech_load_with(m, text_str(&path), s->system_value, box, d);
  } else {
    int err = errno;
    bool named = !scene_spec_is_path(s->system, SYSTEM_SUFFIX);
    diag_at(d, s->system_src, s->system_at, "%s: %s%s", text_str(&path), strerror(err),
            named ? "; the path of a file of one's own has a / or ends in .system" : "");
    mech_init(m);
  }
  w->n = 0;
  if (!ok || !s->system_word.text || mech_word_parse(w, &at, &why, s->system_word.text, m)) return ok;
  return diag_at(d, s->system_word.src, s->system_word.at + at, "%s", why);
}
