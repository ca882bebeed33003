/* Scenes, and where the data is. */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"

/* --- Data --- */

static char *found;

static void find(void) {
  Dl_info here;
  FREED char *library = dladdr(&found, &here) && here.dli_fname ? realpath(here.dli_fname, NULL) : NULL;
  OWNED(text) folder = {0};
  if (data_folder_find(&folder, library ? library : "")) found = ss_strdup(text_str(&folder));
}

const char *ss_data_folder(void) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, find);
  return found;
}

const char *library_data(const char *data) {
  if (!data) data = ss_data_folder();
  if (!data) library_fail(SS_INPUT, "error: the data folder was not found; set STICKSLIP_DATA to it");
  return data;
}

int ss_scene_names(const char *data, int (*f)(void *self, const char *name), void *self) {
  struct diag d = {0};
  size_t n;
  if (!f) return library_argument(__func__, "no function to tell");
  data = library_data(data);
  if (!data) return SS_INPUT;
  LOCAL(arena, a);
  FREED char **name = scene_names(&n, data, &a, &d);
  int status = name ? SS_OK : library_input(&d);
  for (size_t i = 0; i < n && !status; i++)
    if (!f(self, name[i])) status = library_fail(SS_STOPPED, "%s: stopped by the caller", __func__);
  return status;
}

/* --- Scenes --- */

static char *copy(const char *s) {
  return s ? ss_strdup(s) : NULL;
}

/* What is borrowed of the scene, once it stands still. */
static void borrow(struct ss_scene *z) {
  for (int k = 0; k < N_KEYS; k++) {
    bool one = z->s.given[k] && !z->s.interval[k];
    z->parameter[k] = (struct ss_number){NULL, one ? &z->s.value[k] : NULL};
  }
  z->printed = ss_malloc((z->s.n_printed + 1) * sizeof *z->printed);
  for (size_t i = 0; i < z->s.n_printed; i++) z->printed[i] = (struct ss_number){NULL, &z->s.printed[i].value};
}

/* The scene with these changes, which become its own; NULL, and nothing is taken, on failure. */
static struct ss_scene *make(const char *spec, const char *text, const char *data, char **set, int n_set) {
  struct ss_scene *z = ss_malloc(sizeof *z);
  struct diag d = {0};
  const struct scene_overrides o = {(const char *const *)set, n_set, "--set"};
  bool ok = text ? scene_load_text(&z->s, spec, text, &o, SCENE_OF_ANY_SYSTEM, &d)
                 : scene_load_with(&z->s, spec, data, &o, SCENE_OF_ANY_SYSTEM, &d);
  if (ok && z->s.system)
    diag_set(&d, "%.300s: error: a scene of the system file %.300s; the library takes none, only the program stickslip",
             z->s.path, z->s.system);
  if (!ok || z->s.system) {
    library_input(&d);
    scene_clear(&z->s);
    free(z);
    return NULL;
  }
  z->spec = copy(spec);
  z->text = copy(text);
  z->data = copy(data);
  z->set = set;
  z->n_set = n_set;
  borrow(z);
  return z;
}

int ss_scene_open(ss_scene **out, const char *spec, const char *data) {
  if (!out) return library_argument(__func__, "no place for the scene");
  *out = NULL;
  if (!spec) return library_argument(__func__, "no name");
  data = library_data(data);
  if (data) *out = make(spec, NULL, data, NULL, 0);
  return *out ? SS_OK : SS_INPUT;
}

int ss_scene_read(ss_scene **out, const char *name, const char *text) {
  if (!out) return library_argument(__func__, "no place for the scene");
  *out = NULL;
  if (!name || !text) return library_argument(__func__, "no name or no text");
  *out = make(name, text, NULL, NULL, 0);
  return *out ? SS_OK : SS_INPUT;
}

static void free_set(char **set, int n) {
  for (int i = 0; i < n; i++) free(set[i]);
  free(set);
}

static bool same_name(const char *a, const char *b) {
  size_t n = strcspn(a, "=");
  return n == strcspn(b, "=") && strncmp(a, b, n) == 0;
}

/* The changes so far, those of the same names replaced; but of printed there can be many. */
static char **changes(int *n, const struct ss_scene *s, const char *lines) {
  size_t cap = (size_t)s->n_set + 1;
  for (const char *p = lines; *p; p++) cap += *p == '\n';
  char **set = ss_malloc((cap + 1) * sizeof *set);
  int first = 0;
  *n = 0;
  for (; first < s->n_set; first++) set[(*n)++] = ss_strdup(s->set[first]);
  for (const char *p = lines; *p;) {
    size_t len = strcspn(p, "\n");
    char *line = ss_strndup(p, len);
    int at = 0;
    while (at < first && (same_name(line, "printed=") || !same_name(set[at], line))) at++;
    if (at < first)
      free(set[at]);
    else
      at = (*n)++;
    set[at] = line;
    p += len + (p[len] == '\n');
  }
  return set;
}

int ss_scene_set(ss_scene *s, const char *lines) {
  if (!s || !lines) return library_argument(__func__, "no scene or no line");
  int n;
  char **set = changes(&n, s, lines);
  struct ss_scene *z = make(s->spec, s->text, s->data, set, n);
  if (!z) {
    free_set(set, n);
    return SS_INPUT;
  }
  struct ss_scene old = *s;
  *s = *z;
  *z = old;
  free(s->printed); /* what is borrowed has moved */
  borrow(s);
  ss_scene_free(z);
  return SS_OK;
}

void ss_scene_free(ss_scene *s) {
  if (!s) return;
  scene_clear(&s->s);
  free(s->printed);
  free_set(s->set, s->n_set);
  free(s->spec);
  free(s->text);
  free(s->data);
  free(s);
}

const char *ss_scene_name(const ss_scene *s) {
  return s ? s->s.name : NULL;
}

const char *ss_scene_title(const ss_scene *s) {
  return s ? s->s.title : NULL;
}

const ss_number *ss_scene_parameter(const ss_scene *s, const char *name) {
  for (int k = 0; s && name && k < N_KEYS; k++)
    if (strcmp(scene_key_name[k], name) == 0 && s->parameter[k].exact) return &s->parameter[k];
  return NULL;
}

const ss_number *ss_scene_printed(const ss_scene *s, const char *name) {
  const struct printed_number *p = s && name ? scene_printed(&s->s, name) : NULL;
  return p ? &s->printed[p - s->s.printed] : NULL;
}

int library_point(const struct ss_scene *s, bool papers_word, bool forces) {
  struct diag d = {0};
  if (!scene_one_point(&s->s, &d) || (papers_word && !scene_papers_word(&s->s, &d))) return library_input(&d);
  if (forces && !scene_has_forces(&s->s))
    return library_fail(SS_INPUT, "%.300s: error: a scene that gives e1 and e2 is needed", s->s.path);
  return SS_OK;
}

/* --- Lines in parameter space --- */

int library_range(struct scene_range *r, const struct ss_scene *s, const char *parameter, const char *from,
                  const char *to) {
  struct diag d = {0};
  if (!s || !parameter || !from || !to) return library_fail(SS_ARGUMENT, "no scene, parameter or end of the line");
  r->vary = word_find(parameter, scene_key_name, N_SCENE_PARAMS);
  if (r->vary == N_SCENE_PARAMS)
    return library_fail(SS_ARGUMENT, "chi, eta, V, e1 or e2 varies, not %.100s", parameter);
  int status = library_point(s, true, true);
  if (status) return status;
  if (!scene_constant(r->from, from, strlen(from), parameter, &d) ||
      !scene_constant(r->to, to, strlen(to), parameter, &d))
    return library_input(&d);
  if (!scene_range_in_domain(r) || !scene_range_below_friction(r, &s->s))
    return library_fail(SS_INPUT, "%s: both ends must lie in the domain, and e_i below the u_ri that the scene gives",
                        parameter);
  return SS_OK;
}
