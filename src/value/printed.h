/* Printed numbers as brackets, the points they stand for, and the scene's orbit that is nearest to them. */
#ifndef STICKSLIP_PRINTED_H
#define STICKSLIP_PRINTED_H

#include "claim/judging.h"
#include "point.h"
#include "record/result.h"

/* What the scene gives, else prints, under a key's name; NULL when it does neither. */
const fmpq *scene_number(const struct scene *s, enum scene_key key);
/* The printed z_10 and z_20; false where the scene does not print both. */
bool printed_start(const struct printed_number *z[2], const struct scene *s);
/* The printed state and times of the scene as a point, with what the scene gives in place of what it does not print;
   false when some are neither printed nor given. */
bool printed_point(struct point *out, const struct scene *s);
/* The scene's name and title into the record, and its data where they are not those of an example in print. */
void record_scene(struct audit_result *out, const struct scene *s);
/* Which orbit of the list is meant where nobody says which: the nearest to the scene's printed numbers; without any (or
   without a scene) the first that is admissible, with the static friction that the scene gives, else the first. */
slong usual_orbit(const struct dyn_orbits *list, const struct scene *s);
/* What a text calls the one of the scene's orbits that is meant; noun: "orbit", "periodic solution".  "The orbit
   nearest to the printed numbers" only where some are printed, else "orbit 2 (the first admissible one)". */
const char *usual_orbit_text(struct judge *j, const char *noun);
/* The number of the usual orbit in the list that `orbit` shows. */
slong scene_usual_orbit(const struct scene *s);
/* That orbit, and as a point; NULL and false when the scene has none. */
const struct dyn_orbit *scene_orbit(const struct scene *s, struct orbit_cache *cache);
bool nearest_orbit_point(struct point *out, const struct scene *s, struct orbit_cache *cache);

/* The scene's parameters, in the context of params; e1 and e2 that it does not give are those of its orbit nearest to
   the printed numbers.  Status flags. */
int scene_numbers(struct num_vec *params, struct judge *j);

/* The orbits at the scene's parameters. */
const struct dyn_orbits *scene_orbits(const struct scene *s, struct orbit_cache *cache);

/* The two ways in which a decimal may have been printed. */
enum reading { READ_ROUNDED, READ_TRUNCATED, N_READINGS };
extern const char *const reading_name[N_READINGS];
/* The ends of the bracket of a decimal under a reading. */
void printed_ends(fmpq_t below, fmpq_t above, const struct printed_number *p, enum reading how);
/* Does x print as p?  TRUE under some reading (*how), FALSE under none. */
truth printed_fits(const arb_t x, const struct printed_number *p, enum reading *how);
/* The quantity of a printed point that a printed number is; -1: none. */
int printed_quantity(const char *name);
enum { PRINTED_CORNERS = 1 << 6 };
/* The printed times and start at a printed point between their least and their greatest values under a reading: all at
   the ends of the bits of `corner`, but for one (or NULL) and those that the scene does not print. */
void printed_corner(struct point *p, const struct scene *s, const char *but, enum reading how, bool own_digits,
                    int corner);
/* A ball over every value that prints as p. */
void printed_ball(arb_t x, const struct printed_number *p);
/* A control's attribute "shift", in units of the last decimal, applied to a printed number: *p then points at own,
   which the caller releases. */
bool printed_replace(struct printed_number *own, const struct printed_number **p, const struct claim *c);
void printed_release(struct printed_number *own);
/* The number of decimals to which it is given; 0 where its unit is no decimal place. */
slong printed_decimals(const struct printed_number *p);

/* Why a scene for which scene_has_forces is false has none: also a box, of which an audit keeps no data. */
const char *scene_lacks_forces(const struct scene *s);
/* Marks the claim as skipped, with the reason. */
void finding_skip(struct finding *f, struct judge *j, const char *why);
/* x to n digits, or as a ball when it is not known that well. */
const char *ball_text(struct judge *j, const arb_t x, slong n);
/* The same of x as p/q, and of a point (point_print). */
const char *rational_text(struct judge *j, const fmpq *x);
const char *point_text(struct judge *j, const struct point *p);

#endif
