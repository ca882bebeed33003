/* Where the data is, and what a scene is called: in outputs, in commands that can be typed, and as a folder. */
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/suggest.h"
#include "scene_impl.h"

bool data_folder_find(struct text *out, const char *file) {
  static const struct {
    int up; /* folders above the file's own */
    const char *name;
  } beside[] = {{1, "verify"}, {2, "verify"}, {1, "share/stickslip"}, {2, "share/stickslip"}};
  const char *env = getenv("STICKSLIP_DATA");
  text_reset(out);
  text_add(out, env ? env : "");
  if (env) return *env;
  for (size_t i = 0; *file && i < sizeof beside / sizeof *beside; i++) {
    size_t end = strlen(file);
    for (int up = -1; up < beside[i].up; up++)
      while (end > 0 && file[--end] != '/') continue;
    text_reset(out);
    text_printf(out, "%.*s/%s", (int)end, file, beside[i].name);
    if (folder_is_there(text_str(out))) return true;
  }
  text_reset(out);
  text_add(out, STICKSLIP_DATADIR);
  return folder_is_there(text_str(out));
}

/* The name of a scene is its file's, without folder and suffix; a folder can bear it. */
static char *name_of(const char *path) {
  char *name = ss_strdup(path_base(path));
  char *dot = strrchr(name, '.');
  if (dot && strcmp(dot, ".scene") == 0 && dot > name) *dot = '\0';
  if (name[0] == '.') name[0] = '_';
  return name;
}

/* The reports of a changed scene have a folder of their own; where its name cannot say how, a number tells it from
   others. */
static void add_folder(struct text *out, const struct scene_overrides *o) {
  enum { LONGEST = 100 };
  uint32_t hash = 2166136261U; /* FNV-1a */
  bool whole = true;
  size_t begin = out->len;
  for (int i = 0; i < o->n; i++) {
    text_add_char(out, '+');
    hash = (hash ^ '+') * 16777619U;
    for (const char *p = o->item[i]; *p; p++) {
      bool kept = (char_is_word(*p) || *p == '=' || *p == '.' || *p == '-') && out->len - begin < LONGEST;
      if (kept) text_add_char(out, *p);
      whole &= kept;
      hash = (hash ^ (unsigned char)*p) * 16777619U;
    }
  }
  if (!whole) text_printf(out, "-%08lx", (unsigned long)hash);
}

/* Whether the file stands in the folder itself, by whatever path it is named. */
static bool stands_in(const char *path, const char *folder) {
  OWNED(text) own = {0};
  struct stat a, b;
  path_folder(&own, path);
  return stat(text_str(&own), &a) == 0 && stat(folder, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* In the order of their names, not of their files': "paper" comes before "paper-times". */
char **scene_names(size_t *n, const char *data, struct arena *a, struct diag *d) {
  static const char suffix[] = ".scene";
  OWNED(text) path = {0};
  text_printf(&path, "%s/scenes", data);
  char **name = folder_files(n, text_str(&path), suffix, a, d);
  for (size_t i = 0; i < *n; i++) {
    name[i] += path.len + 1;
    name[i][strlen(name[i]) - strlen(suffix)] = '\0';
  }
  if (*n) qsort(name, *n, sizeof *name, word_compare);
  return name;
}

char *scene_folder(const char *spec, const struct scene_overrides *o) {
  OWNED(text) folder = {0};
  FREED char *file = name_of(spec);
  text_add(&folder, file);
  if (o && o->n) add_folder(&folder, o);
  return ss_strdup(text_str(&folder));
}

bool scene_spec_is_path(const char *spec, const char *suffix) {
  return strchr(spec, '/') || path_has_suffix(spec, suffix);
}

bool scene_is_there(const struct scene *s, const char *spec, const char *data, struct diag *d) {
  if (scene_spec_is_path(spec, ".scene") || access(s->path, F_OK) == 0) return true;
  int err = errno;
  struct suggestion meant;
  LOCAL(arena, a);
  OWNED(text) says = {0};
  size_t n;
  FREED char **name = scene_names(&n, data, &a, NULL);
  suggest_begin(&meant, spec, strlen(spec));
  for (size_t i = 0; i < n; i++) suggest_try(&meant, name[i]);
  suggest_print(&says, &meant);
  return diag_set(d, "%.300s: error: %s%s", s->path, strerror(err), text_str(&says));
}

void scene_set_names(struct scene *s, const char *spec, const char *data, const struct scene_overrides *o) {
  OWNED(text) path = {0}, suffix = {0}, command = {0}, name = {0}, scenes = {0};
  if (scene_spec_is_path(spec, ".scene"))
    text_add(&path, spec);
  else
    text_printf(&path, "%s/scenes/%s.scene", data, spec);
  s->path = ss_strdup(text_str(&path));
  s->file = name_of(s->path);
  text_printf(&scenes, "%s/scenes", data);
  s->on_file = stands_in(s->path, text_str(&scenes));
  for (int i = 0; o && i < o->n; i++) {
    text_printf(&suffix, " %s ", o->option);
    text_add_quoted(&suffix, o->item[i]);
  }
  if (getenv("STICKSLIP_DATA")) {
    text_add(&command, "STICKSLIP_DATA=");
    text_add_quoted(&command, getenv("STICKSLIP_DATA"));
    text_add_char(&command, ' ');
  }
  text_add(&command, "stickslip verify ");
  text_add_quoted(&command, spec);
  text_add(&command, text_str(&suffix));
  text_printf(&name, "%s%s", s->file, text_str(&suffix));
  s->name = ss_strdup(text_str(&name));
  s->command = ss_strdup(text_str(&command));
  s->folder = scene_folder(spec, o);
}
