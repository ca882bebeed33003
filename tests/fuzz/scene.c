/* A scene file and what --set puts in its place, from any bytes: the parts between NUL bytes are the file, then one
   NAME=VALUE each.  Laws: refused with a message or taken without one; what was taken lies in the domain, and nothing
   in it controls a terminal; a word prints as text that reads as the same word. */
#include "scene/scene.h"

#include <string.h>

#include "fuzz.h"

enum { MOST_SETS = 64 };

/* The parts after the first as overrides; how long the first is. */
static size_t split(struct scene_overrides *o, const char *item[MOST_SETS], const char *text, size_t size) {
  size_t first = strlen(text);
  *o = (struct scene_overrides){item, 0, "--set"};
  for (size_t at = first + 1; at < size && o->n < MOST_SETS; at += strlen(text + at) + 1)
    if (strchr(text + at, '=')) item[o->n++] = text + at; /* others never leave the command line */
  return first;
}

static bool harmless(const char *text) {
  size_t n = strlen(text);
  for (size_t i = 0; i < n; i++)
    if ((unsigned char)text[i] < ' ' || text[i] == 0x7F) return false;
  return text_valid_prefix(text, n) == n;
}

static void check_word(const struct scene *s) {
  struct mech_word again;
  LOCAL(text, t);
  size_t at;
  const char *why;
  if (!s->word.n) return;
  phase_word_print(&t, &s->word);
  fuzz_law(phase_word_parse(&again, &at, &why, t.data, t.len), "a word that is printed can be read");
  fuzz_law(mech_word_same(&again, &s->word), "it is the same word");
}

static void check_scene(const struct scene *s) {
  for (int k = 0; k < N_KEYS; k++)
    fuzz_law(k == KEY_TA || !s->given[k] || fmpq_sgn(&s->value[k]) > 0, "what must be positive is");
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    fuzz_law(!s->interval[k] || fmpq_cmp(&s->value[k], &s->high[k]) < 0, "an interval has a width");
  fuzz_law(fmpq_cmp_si(&s->value[KEY_CHI], 1) < 0, "chi is below 1");
  int six = 0;
  for (int k = KEY_E1; k <= KEY_TD; k++) six += s->given[k];
  fuzz_law(six == 2, "two of the six are given");
  fuzz_law(harmless(s->name) && harmless(s->command) && harmless(s->folder), "its names are lines of text");
  fuzz_law(!strchr(s->folder, '/') && s->folder[0] != '.', "its folder is one");
  check_word(s);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const char *item[MOST_SETS];
  struct scene_overrides o;
  LOCAL(text, t);
  OWNED(scene) s;
  struct diag d = {0};
  text_add_n(&t, (const char *)data, size);
  size_t file = split(&o, item, text_str(&t), size);
  bool ok = scene_load_with(&s, fuzz_file(".scene", data, file), "verify", &o, SCENE_OF_TWO_MASSES, &d);
  fuzz_law(ok != d.set, "a scene is taken, or there is a message");
  if (ok) check_scene(&s);
  return 0;
}
