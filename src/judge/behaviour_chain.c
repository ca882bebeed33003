/* "Even in the case of multi degrees of freedom": periodic motions of longer chains, patched from the solutions of
   their phases and proved, and the same by direct integration. */
#include <math.h>
#include <string.h>

#include "behaviour.h"
#include "claim/claim.h"
#include "mech/orbit.h"
#include "mech/walk.h"
#include "verdict.h"

enum { PREC = 128, MOST_SYSTEMS = 16 };

/* The data folder that a claim's file stands in, folder/claims/x.claim. */
static void data_folder(struct text *out, const struct claim *c) {
  OWNED(text) claims = {0};
  path_folder(&claims, c->file->src.name);
  path_folder(out, text_str(&claims));
}

/* Integrated over a period from the start of the orbit, does the system pass the same phases at the same times, and
   come back?  An event at the very start, where a mass is just at its limit, is that of the phase before. */
static bool integration_follows(const struct mech *m, const struct mech_orbit *o) {
  static const double tolerance = 1e-6;
  OWNED(mech_motion) x;
  double start[MECH_STATES], t = 0;
  int k = 0;
  for (int i = 0; i < o->states; i++) start[i] = arf_get_d(arb_midref(o->state + i), ARF_RND_NEAR);
  struct mech_plan plan = {.duration = arf_get_d(arb_midref(o->period), ARF_RND_NEAR), .most = 3 * MECH_PHASES};
  int status = mech_simulate(&x, MECH_INTEGRATED, m, start, &plan);
  bool same = status == SS_OK;
  for (int i = 1; same && i < x.n_moments; i++) {
    if (x.moment[i].t < tolerance) continue;
    t += arf_get_d(arb_midref(o->t + k++), ARF_RND_NEAR);
    same = k <= o->word.n && strcmp(x.moment[i].phase, o->word.phase[k % o->word.n]) == 0 &&
           fabs(x.moment[i].t - t) < tolerance;
  }
  for (int i = 0; same && i < o->states; i++) same = fabs(x.z[i] - start[i]) < tolerance * (1 + fabs(start[i]));
  return same && k >= o->word.n - 1;
}

struct chains {
  long n, proved, followed;
  struct text words;
};

/* "3 masses, (--s --- ...), period 9.13": of a proved orbit. */
static void note_orbit(struct chains *c, const struct mech_orbit *o) {
  text_printf(&c->words, "%s%d masses, (", c->words.len ? "; " : "", o->n);
  mech_word_print(&c->words, &o->word);
  text_printf(&c->words, "), period %.6g", arf_get_d(arb_midref(o->period), ARF_RND_NEAR));
}

/* More than two masses, each tied to its neighbours and the first one to the ground, nothing else acting but
   friction. */
static bool is_longer_chain(const struct mech *m) {
  bool chain = m->n > 2 && m->n_springs == m->n && m->n_dampers == 0 && m->n_loads == 0;
  for (int i = 0; chain && i < m->n; i++) {
    const int *end = m->spring[i].end;
    chain = ((end[0] == i - 1 && end[1] == i) || (end[0] == i && end[1] == i - 1)) && m->mass[i].rubbed &&
            !m->mass[i].stop[0].given && !m->mass[i].stop[1].given;
  }
  return chain;
}

static void try_chain(struct chains *c, const struct mech *m, const struct mech_word *w) {
  OWNED(mech_orbits) list;
  mech_orbits_find(&list, m, w->n ? w : NULL, true, PREC, NULL);
  int k = 0;
  while (k < list.n && !mech_orbit_is_motion(&list.orbit[k])) k++;
  c->n++;
  if (k < list.n) {
    c->proved++;
    c->followed += integration_follows(m, &list.orbit[k]);
    note_orbit(c, &list.orbit[k]);
  }
}

static bool read_chain(struct chains *c, const char *name, const char *data, const struct behaviour *b) {
  OWNED(scene) s;
  if (!scene_load_with(&s, name, data, NULL, SCENE_OF_ANY_SYSTEM, b->j->d)) return false;
  if (!s.system) return claim_error(b->j, b->c, "systems", "a scene that names no system file");
  OWNED(mech) m;
  struct mech_word w;
  bool ok =
      scene_load_system(&m, &w, &s, data, false, b->j->d) &&
      (is_longer_chain(&m) || claim_error(b->j, b->c, "systems", "a system that is no chain of more than two masses"));
  if (ok) try_chain(c, &m, &w);
  return ok;
}

bool behaviour_patching(struct behaviour *b) {
  char name[MOST_SYSTEMS][CLAIM_NAME];
  struct chains c = {.n = 0};
  OWNED(text) data = {0};
  int n = claim_names_listed(name, MOST_SYSTEMS, claim_get(b->c, "systems"));
  if (n == 0) return claim_error(b->j, b->c, "check", "systems of more masses are missing: systems: NAME, NAME");
  bool ok = true;
  data_folder(&data, b->c);
  for (int i = 0; ok && i < n; i++) {
    for (int k = 0; k < i; k++)
      if (strcmp(name[i], name[k]) == 0) ok = claim_error(b->j, b->c, "systems", "a system stands here twice");
    ok = ok && read_chain(&c, name[i], text_str(&data), b);
  }
  if (ok) {
    struct route_result w[2];
    w[0] = behaviour_route(
        b, counted_route("system", true, c.proved, 0, c.n - c.proved), NULL,
        result_str(b->j->out,
                   "periodic motions patched from matrix exponentials, with enclosed times and states, each event "
                   "proved to be the first and Coulomb's law to hold along each phase, for %ld of %ld chains that were "
                   "chosen: %s. In each phase a chain of any length obeys linear equations; that the patched "
                   "solutions meet, and that no other event comes first, is shown for these chains alone",
                   c.proved, c.n, text_str(&c.words)));
    w[1] = behaviour_route(b, counted_route("integration", false, c.followed, 0, c.n - c.followed), NULL,
                           result_str(b->j->out,
                                      "GSL's direct integration passes through the same phases at the same times, and "
                                      "returns to its start, within a millionth, for %ld of the %ld",
                                      c.followed, c.n));
    b->f->verdict = verdict_of(w, 2, false);
  }
  text_clear(&c.words);
  return ok;
}
