/* Scenes on the command line: --set, and the table of their keys. */
#include <string.h>

#include "cli.h"

bool load_scene(struct scene *s, const char *spec, const char *data, const struct options *o, enum scene_welcome any,
                struct diag *d) {
  struct scene_overrides set = {o->given[OPT_SET].word, o->given[OPT_SET].n, "--set"};
  return scene_load_with(s, spec, data, &set, any, d);
}

bool scene_needs_forces(const struct scene *s, const char *command, struct diag *d) {
  if (!scene_has_forces(s)) diag_set(d, "%s: error: %s needs a scene that gives e1 and e2", s->path, command);
  return scene_has_forces(s);
}

static void keys_json(struct text *out) {
  struct json j = {.out = out};
  JSON_EACH (&j, NULL, k, N_SCENE_KEYS) {
    JSON_OBJECT(&j, NULL);
    json_string(&j, "name", scene_keys[k].name);
    json_string(&j, "written", k < N_KEYS ? "NAME = value" : "NAME: value");
    json_string(&j, "takes", scene_takes_text[scene_keys[k].takes]);
    json_string(&j, "meaning", scene_keys[k].meaning);
    json_string(&j, "used", scene_keys[k].used);
  }
}

/* A row a key; on a terminal that is too narrow for it the meaning first, and under it what is written and who reads
   it. */
static void keys_text(struct text *out) {
  enum { ROW = 130 };
  int width = terminal_width();
  for (int k = 0; k < N_SCENE_KEYS; k++) {
    const struct scene_key_info *i = &scene_keys[k];
    if (width > 0 && width < ROW)
      text_printf(out, "%s%-*s  %s\n%11s%s; read by: %s\n", i->name, (int)(9 - strlen(i->name)),
                  k < N_KEYS ? " =" : ":", i->meaning, "", scene_takes_text[i->takes], i->used);
    else
      text_printf(out, "%s%-*s %-45s %-60s %s\n", i->name, (int)(9 - strlen(i->name)), k < N_KEYS ? " =" : ":",
                  scene_takes_text[i->takes], i->meaning, i->used);
  }
}

int list_scene_keys(const struct options *o) {
  struct text out = {0};
  (option(o, OPT_JSON) ? keys_json : keys_text)(&out);
  print_found(o, &out);
  return EXIT_AS_RECORDED;
}
