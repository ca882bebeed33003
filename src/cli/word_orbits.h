/* What orbit, words and jacobian share on scenes of all kinds: the paper's word, other words, system files. */
#ifndef STICKSLIP_WORD_ORBITS_H
#define STICKSLIP_WORD_ORBITS_H

#include "cli.h"
#include "explore/words.h"
#include "orbit_numbers.h"

/* The working precision for so many digits of a system file's orbits. */
slong system_bits(slong digits);
/* The system of a scene and the orbits of its word, or of any; m and list are to be cleared in any case.  Over a box:
   its parameters may be intervals. */
enum system_search { OF_ITS_WORD, OF_ITS_WORD_OVER_A_BOX, OF_ANY_WORD };
bool find_system_orbits(struct mech *m, struct mech_orbits *list, enum system_search search, const struct scene *s,
                        const char *data, slong digits, struct diag *d);
/* --certificate: false with d set when no orbit is certified; a warning when some are not. */
bool may_write_certificate(const struct scene *s, slong certified, slong n, struct diag *d);
/* The orbits of a scene's other word; false with d set when the scene lacks what they need. */
bool find_word_orbits(struct word_orbits *list, const struct scene *s, slong digits, struct diag *d);
/* What is known of that word, and of the search: members, lines. */
void word_json(struct json *j, const struct scene *s);
void word_text(struct text *out, const struct word_orbits *list, const struct scene *s);
/* One orbit of a system file or of another word as a member of an array. */
void proved_orbit_json(struct json *j, const struct mech_orbit *o, const struct mech *m, const struct scene *s,
                       slong digits);

#endif
