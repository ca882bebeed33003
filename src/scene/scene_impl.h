/* What the files that read scenes share. */
#ifndef STICKSLIP_SCENE_IMPL_H
#define STICKSLIP_SCENE_IMPL_H

#include "expr/constant.h"
#include "scene.h"

static inline bool scene_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* name, file, command, folder and path. */
void scene_set_names(struct scene *s, const char *spec, const char *data, const struct scene_overrides *o);

/* Whether the file of a scene that is not named by a path is there; false with d set, with the names that may have been
   meant. */
bool scene_is_there(const struct scene *s, const char *spec, const char *data, struct diag *d);

/* A line NAME = value of a scene of a system, in its file or in an override, which stands in place of the file's.  The
   name is copied, the value is e's. */
bool scene_system_give(struct scene *s, const struct mech_given *line, const struct expr *e, const struct source *file,
                       struct diag *d);
/* Takes the line of that name away; false where there is none. */
bool scene_system_take(struct scene *s, const char *name, size_t len);
void scene_system_clear(struct scene *s);

/* What has a / or ends in that suffix is a path; all else is a name in the data folder. */
bool scene_spec_is_path(const char *spec, const char *suffix);

/* A line of a scene, from its file or an override. */
struct scene_line {
  enum scene_key key;
  const struct source *src;
  struct span value;
  const char *text; /* the value with its lines joined */
};
/* A line `printed`, in place of the file's where an override prints the number again. */
bool scene_printed_add(struct scene *s, const struct scene_line *l, bool override, struct diag *d);
void scene_printed_clear(struct printed_number *p);
/* Once all of them are read: the unit of each, by the rule of struct printed_number. */
void scene_printed_align(struct scene *s);
/* ask, values, routes, digits and budget. */
bool scene_read_asked(struct scene_asked *a, const struct scene_line *l, struct diag *d);
void scene_asked_clear(struct scene_asked *a);
/* An item of the list of values as a tree: a name, a function of an argument, an entry of one of them, a trace or a
   determinant; NULL with d set. */
const struct expr *scene_quantity(struct arena *a, const struct scene_list *list, size_t i, struct diag *d);

/* The first parameter that is an interval; N_SCENE_PARAMS where none is. */
int scene_interval(const struct scene *s);

#endif
