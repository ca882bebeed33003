/* The orbits of a scene as the command and the library give them: to so many digits, proved, the list held against the
   search for completeness. */
#ifndef STICKSLIP_VALUE_SOLVED_H
#define STICKSLIP_VALUE_SOLVED_H

#include "motion/certify.h"
#include "orbits.h"

/* The numbers of an orbit in the order of the contract; the last two are the bounds of static friction. */
enum { ORBIT_NUMBERS = 12 };
const char *orbit_number_name(int i);
const char *orbit_number_meaning(int i);
arb_srcptr orbit_number(const struct dyn_orbit *o, int i);
/* The value that the scene gives exactly under a number's name, or NULL: its decimal may be a tie, which no ball
   decides. */
const fmpq *scene_given_number(const struct scene *s, int i);

/* A list with the proof of each orbit; what a proof decides of an orbit stands in the orbit too. */
struct solved {
  struct dyn_orbits list;
  struct dyn_certificate *proof;
  int found; /* of the search, before the list was held against the one for completeness */
};
/* false: some number of an orbit could not be enclosed to so many digits.  Solution II is judged as the three phases
   that it is.  Clear it all the same. */
bool solved_find(struct solved *z, const struct scene *s, slong digits);
/* The proofs of a list that is there, likewise. */
void solved_prove(struct solved *z, const struct scene *s);
void solved_clear(struct solved *z);
/* How many are certified; and appends their certificates (mech/two_masses.h) for the checker. */
slong solved_certified(const struct solved *z);
void solved_certificates(struct text *out, const struct solved *z, const struct scene *s);

/* The same for another word that is open (phase_word_fate) and does not lack friction (scene_lacks_friction): its
   orbits, by a few simulations and a search; a status.  And the working precision for so many digits. */
int solved_word(struct word_orbits *list, const struct mech_word *w, const struct scene *s, slong digits);
slong solved_word_bits(slong digits);

/* Orbits with t_a = 0 and their proofs, judged as orbits of the three phases Gamma-H-C. */
void judge_three_phases(struct dyn_orbits *list, struct dyn_certificate *proof);
/* Whether one of them has that condition or margin (margins.h): it is not of phase D. */
bool three_phases_have(int margin);

/* Whether the orbit fulfils every condition, those on the static friction that the scene gives among them: u[0],
   u[1] where u is not NULL. */
truth orbit_admissible(truth u[2], const struct scene *s, const struct dyn_orbit *o);
/* All of these conditions in one list, those of the static friction last, by the names u_r1 and u_r2; and whether an
   orbit breaks one, with the u of orbit_admissible. */
enum { ORBIT_CONDITIONS = N_CONDITIONS + 2 };
const char *orbit_condition_name(int i);
bool orbit_breaks(const struct dyn_orbit *o, const truth u[2], int i);

#endif
