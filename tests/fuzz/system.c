/* A system file and a word of its phases, from any bytes: the file up to the first NUL byte, the word behind it.  Laws:
   refused with a message or taken without one; what was taken is physical and described; a word prints as text that
   reads as the same word; a short motion ends, with numbers or a reason. */
#include "mech/describe.h"
#include "mech/walk.h"

#include <math.h>
#include <string.h>

#include "fuzz.h"

static void check_masses(const struct mech *m) {
  fuzz_law(m->n >= 1 && m->n <= MECH_MASSES, "there are masses, and not too many");
  for (int i = 0; i < m->n; i++) {
    const struct mech_mass *mass = &m->mass[i];
    fuzz_law(fmpq_sgn(mass->inertia) > 0, "an inertia is positive");
    fuzz_law(!mass->rubbed || fmpq_cmp(mass->limit, mass->sliding) >= 0,
             "static friction is not below sliding friction");
    fuzz_law(mass->name[0] != '\0' && strlen(mass->name) < MECH_NAME, "a mass has a name");
  }
}

static void check_description(const struct mech *m) {
  LOCAL(text, t);
  for (int latex = 0; latex < 2; latex++) {
    text_reset(&t);
    mech_describe(&t, m, latex, 6);
    fuzz_law(t.len > 0, "a system is described");
  }
}

static void check_word(const struct mech *m, const char *word) {
  struct mech_word w, again;
  LOCAL(text, t);
  size_t at;
  const char *why;
  if (!mech_word_parse(&w, &at, &why, word, m)) {
    fuzz_law(why != NULL && at <= strlen(word), "a word is taken, or there is a reason and its place");
    return;
  }
  mech_word_print(&t, &w);
  fuzz_law(mech_word_parse(&again, &at, &why, text_str(&t), m), "a word that is printed can be read");
  fuzz_law(mech_word_turned(&w, &again) == 0, "it is the same word");
}

static void check_motion(const struct mech *m) {
  double start[MECH_STATES] = {0};
  OWNED(mech_motion) x;
  const struct mech_plan plan = {.duration = 10, .most = 20, .looks = 500};
  if (m->n_loads) start[2 * m->n] = 1; /* the cosine of their angle */
  int status = mech_simulate(&x, MECH_PATCHED, m, start, &plan);
  fuzz_law((status == 0) == (status != SS_DOMAIN && x.end == MECH_DONE),
           "a motion is at its end, or there is a reason");
  for (int i = 0; i < 2 * m->n && status == 0; i++) fuzz_law(isfinite(x.z[i]), "its end is finite");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const uint8_t *nul = memchr(data, '\0', size);
  size_t file = nul ? (size_t)(nul - data) : size;
  struct source src;
  LOCAL(text, word);
  struct diag d = {0};
  if (!fuzz_source(&src, data, file)) return 0;
  OWNED(mech) m;
  if (nul) text_add_n(&word, (const char *)nul + 1, size - file - 1);
  bool ok = mech_read(&m, src, NULL, true, &d);
  fuzz_law(ok != d.set, "a system is taken, or there is a message");
  if (ok) {
    check_masses(&m);
    check_description(&m);
    check_word(&m, text_str(&word));
    check_motion(&m);
  }
  return 0;
}
