/* What the commands on other phase words share. */
#ifndef STICKSLIP_WORD_ORBITS_H
#define STICKSLIP_WORD_ORBITS_H

#include "cli.h"
#include "explore/words.h"
#include "orbit_numbers.h"

enum { WORD_DIGITS = 1000 }; /* the most that these commands take */

/* The working precision for so many digits; of a system file's orbits. */
slong word_bits(slong digits);
slong system_bits(slong digits);
/* The system of a scene and the orbits of its word, or of any; m and list are to be cleared in any case. */
bool find_system_orbits(struct mech *m, struct mech_orbits *list, bool any, const struct scene *s, const char *data,
                        slong digits, struct diag *d);
/* --certificate: false with d set when no orbit is certified; a warning when some are not. */
bool may_write_certificate(const struct scene *s, slong certified, slong n, struct diag *d);
/* Writes the certified ones; the same.  n: the orbits that were found. */
bool write_system_certificate(const char *path, const struct mech_orbits *list, slong n, const struct mech *m,
                              const struct scene *s, struct diag *d);
/* The Jacobian of a return: its rows; the member "J". */
void return_text(struct text *out, const arb_mat_t x, slong digits);
void return_json(struct json *j, const arb_mat_t x, slong digits);
/* --method of such a Jacobian; false with d set where it is of the paper's word alone. */
bool return_route(enum mech_derivative *how, const struct jacobian_request *q, const struct scene *s, struct diag *d);
/* Sets d: it has no value by that method. */
void return_unknown(struct diag *d, const struct jacobian_request *q, const struct scene *s);
/* A word as a string. */
void json_word(struct json *j, const char *key, const struct phase_word *w);
/* One orbit as a member of an array. */
void word_orbit_json(struct json *j, const struct word_orbit *o, slong digits);

#endif
