/* Claims about what the masses do: kind behaviour.  Each claim names a check (attribute "check"); each check runs
   motions under Coulomb's law by both routes of coulomb.h, or asks the return map, and gives its routes' words to the
   table. */
#ifndef STICKSLIP_BEHAVIOUR_H
#define STICKSLIP_BEHAVIOUR_H

#include "claim/checks.h"
#include "claim/judging.h"
#include "explore/bifurcate.h"
#include "model/model.h"
#include "num/calc.h"
#include "record/finding.h"
#include "value/coulomb_setup.h"
#include "value/point.h"
#include "verdict.h"

struct friction;

/* A claim being judged by simulation. */
struct behaviour {
  struct finding *f;
  struct judge *j;
  const struct claim *c;
  struct view view;
  const struct friction
      *law; /* (1) and (2) as the paper states them (friction.h); NULL for a check that rests on neither */
};
/* --- Motions --- */

enum motion_route { BY_INTEGRATION, BY_CLOSED_FORMS, N_MOTION_ROUTES };

/* What one route tells of a motion.  Rows are the samples, when the plan asks for any. */
struct trajectory {
  int status;
  struct coulomb_result result;
  struct coulomb_log log;
  struct coulomb_row *row;
  size_t n_rows, cap_rows;
};
struct trajectory motion_simulate(enum motion_route route, const struct coulomb_setup *m,
                                  const struct coulomb_plan *plan);
void trajectory_clear(struct trajectory *t);
/* The same events within a millionth of the state, with no flat contact that rounding could turn. */
bool trajectories_agree(const struct trajectory *a, const struct trajectory *b);

/* The nine pairs of modes by their letters, the paper's four phases first. */
enum { N_MODE_PAIRS = N_MODES * N_MODES };
extern const char mode_letters[N_MODE_PAIRS + 1]; /* "DGHCghcXx" */
int mode_index(const enum coulomb_mode mode[2]);

/* "chi = ..., u_r2 = ...; --start x1,x2,v1,v2": a scene's lines and the option of stickslip simulate. */
const char *motion_text(struct behaviour *b, const struct coulomb_setup *m);

/* r = z_2 - z_1 at its start. */
double orbit_r(const struct dyn_orbit *o);
/* r where the word is passed once from the orbit's positions, z_2 being moved by that; near: about its times. */
val orbit_passed(struct calc *c, const struct num_vec *params, const struct dyn_orbit *o, val by,
                 const double near[N_PHASES]);
/* Beside an orbit with that r at its start, from r (1 + part): is the return map, iterated in double, back within half
   of that distance (1), twice as far away or without the word (-1), or neither within the steps (0)? */
int return_map_fate(const fmpq params[N_PARAMS], double r, double part, long steps);
/* The motion from x_2 moved by |r| part at the start of the orbit, integrated: how far its r is from the orbit's after
   so many returns, in units of that distance; NaN when it does not return so often. */
double motion_distance(const struct point *params, const struct dyn_orbit *o, double part, long returns);

/* The orbits that a claim draws, each once, but for those at which an event is a mere touch. */
struct orbit_walk {
  struct sampler sampler;
  struct orbit_cache *cache;
  struct orbit_set met;
  struct point p; /* the parameters of the orbit */
  int draws;      /* that are left */
  bool in_turn;   /* every other one is asked to be admissible */
};
void orbit_walk_begin(struct orbit_walk *w, struct behaviour *b, bool admissible, int draws);
/* NULL after the last draw. */
const struct dyn_orbit *orbit_walk_next(struct orbit_walk *w);
void orbit_walk_clear(struct orbit_walk *w);

/* --- Evidence --- */

/* The stable admissible orbit of the claim's own parameters, which p becomes; NULL with d set. */
const struct dyn_orbit *behaviour_stable_orbit(struct point *p, struct behaviour *b);
/* A route's word, with evidence that says it; where and note may be NULL. */
struct route_result behaviour_route(struct behaviour *b, struct route_result w, const char *where, const char *note);
/* Both routes' words on the same motions, of which the integration's decides, and is explained. */
void behaviour_routes(struct route_result w[N_MOTION_ROUTES], struct behaviour *b,
                      const enum route_outcome outcome[N_MOTION_ROUTES], long trials, const char *where,
                      const char *note);

/* Who watches a motion; trajectory[] are both routes' accounts, which are the same. */
typedef void (*watch_fn)(void *self, const struct coulomb_setup *m,
                         const struct trajectory trajectory[N_MOTION_ROUTES]);
struct watched {
  long motions, apart; /* accepted; left out, since rounding could turn them */
};
/* Parameters of which one runs from one value to another. */
struct family {
  fmpq_t from, to;
  int vary; /* P_... */
  struct point base;
};
/* "chi = 2/3, ..." with "e2 from 3/4 to 1", both up to a semicolon; false with j->d set.  Clear it in either case. */
bool family_open(struct family *f, struct behaviour *b, const char *at, const char *vary);
void family_clear(struct family *f);
/* Where orbits change along it, to 18 digits. */
void family_bifurcations(struct dyn_bifurcations *list, const struct family *f);
/* Of a criterion that takes tr J = -1 in, by the families of the claim that is said of what it leaves out: are the
   orbits there stable? */
struct linearized;
bool equality_of_criterion(struct behaviour *b, const struct linearized *theorem);
/* Random motions from starts anywhere, sampled. */
struct watched behaviour_watch(struct behaviour *b, watch_fn fn, void *self);
/* The words of both routes by what each counted, and the verdict: with that of the proof (friction.h), unless it has
   decided nothing. */
void behaviour_conclude(struct behaviour *b, const struct answers said[N_MOTION_ROUTES], long trials, const char *note,
                        const struct route_result *proof);

/* false with j->d set when the claim cannot be read. */
#define BEHAVIOUR_CHECK(name, ...) bool behaviour_##name(struct behaviour *b);
BEHAVIOUR_CHECKS(BEHAVIOUR_CHECK)
#undef BEHAVIOUR_CHECK

#endif
