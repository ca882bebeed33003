/* The orbits of a scene or of a set of parameters, searched once for each precision that is asked for. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/work.h"
#include "followed.h"
#include "motion/branches.h"
#include "motion/complete.h"
#include "orbit_pool.h"
#include "orbits.h"
#include "printed.h"

/* chi, eta, V and two of e1 ... t_d decide which orbits there are. */
enum { N_DATA = KEY_TD + 1 };

/* What is given exactly, by scene_key; a value that is not given is not looked at. */
struct data {
  const fmpq *value;
  const bool *given;
};

int orbits_given_pair(enum dyn_quantity which[2], fmpq value[2], const fmpq *from, const bool *given) {
  int n = 0;
  for (int k = KEY_E1; k <= KEY_TD && n < 2; k++) {
    if (!given[k]) continue;
    which[n] = (enum dyn_quantity)(QUANTITY_E1 + (k - KEY_E1));
    value[n++] = from[k]; /* neither changed nor cleared */
  }
  return n;
}

/* A search counts as this: its steps in double precision need not be the same in number everywhere. */
enum { UNITS_OF_SEARCH = 15000, UNITS_OF_GIVEN = 2000 };

static int find_orbits(struct dyn_orbits *list, struct data data, slong prec) {
  enum dyn_quantity which[2];
  fmpq value[2];
  work_add(data.given[KEY_E1] && data.given[KEY_E2] ? UNITS_OF_SEARCH : UNITS_OF_GIVEN);
  if (orbits_given_pair(which, value, data.value, data.given) == 2)
    return dyn_orbits_given(list, data.value + KEY_CHI, which, value, prec, NULL);
  *list = (struct dyn_orbits){.n = 0}; /* a box of parameters has no orbits of its own */
  return SS_OK;
}

int audit_orbits(struct dyn_orbits *list, const struct scene *s, slong prec) {
  return find_orbits(list, (struct data){s->value, s->given}, prec);
}

static void complete_orbits(struct dyn_orbits *list, struct data data, slong prec) {
  enum dyn_quantity which[2];
  fmpq value[2];
  if (orbits_given_pair(which, value, data.value, data.given) < 2) return;
  dyn_given_complete(list, data.value + KEY_CHI, which, value, prec);
}

void audit_orbits_complete(struct dyn_orbits *list, const struct scene *s, slong prec) {
  complete_orbits(list, (struct data){s->value, s->given}, prec);
}

/* --- Found once --- */

enum { ORBITS_ALONE = -1 }; /* in the place of a bound of t_c: not all solutions, but the orbits that are found */

struct cached {
  fmpq value[N_DATA];
  bool given[N_DATA];
  double until; /* of all solutions, a bound of t_c; 0: those that are orbits */
  slong prec;
  struct dyn_orbits list;
  bool added_nothing; /* the search for what the first one misses */
};
struct orbit_cache {
  bool completes;
  struct cached **item;
  size_t n, cap;
  struct followed **followed;
  size_t n_followed, cap_followed;
  struct orbit_slope *slope;
  size_t n_slopes, cap_slopes;
  struct orbit_pool *pool;
};

struct orbit_cache *orbit_cache_new(void) {
  struct orbit_cache *c = ss_malloc(sizeof *c);
  *c = (struct orbit_cache){.n = 0};
  return c;
}

void orbit_cache_complete(struct orbit_cache *c) {
  c->completes = true;
}

void orbit_cache_free(struct orbit_cache *c) {
  for (size_t i = 0; i < c->n; i++) {
    for (int k = 0; k < N_DATA; k++) fmpq_clear(&c->item[i]->value[k]);
    dyn_orbits_clear(&c->item[i]->list);
    free(c->item[i]);
  }
  for (size_t i = 0; i < c->n_followed; i++) followed_free(c->followed[i]);
  orbit_pool_free(c->pool);
  free(c->slope);
  free(c->followed);
  free(c->item);
  free(c);
}

static bool is_of(const struct cached *e, struct data data) {
  for (int k = 0; k < N_DATA; k++) {
    if (e->given[k] != data.given[k]) return false;
    if (e->given[k] && !fmpq_equal(&e->value[k], &data.value[k])) return false;
  }
  return true;
}

/* The proof that a list is complete is in double precision, and may use up its whole budget: where it has added nothing
   to a list of as many orbits, it adds nothing to them enclosed to other digits. */
static bool completed_before(struct dyn_orbits *list, const struct orbit_cache *c, struct data data) {
  for (size_t i = 0; i < c->n; i++) {
    const struct cached *e = c->item[i];
    if (&e->list == list || !e->added_nothing || e->list.n != list->n || !is_of(e, data)) continue;
    list->complete = e->list.complete;
    list->gap = e->list.gap;
    memcpy(list->gap_at, e->list.gap_at, sizeof list->gap_at);
    list->t_c_max = e->list.t_c_max;
    return true;
  }
  return false;
}

static void list_orbits(struct cached *e, const struct orbit_cache *c, struct data data) {
  find_orbits(&e->list, data, e->prec);
  slong found = e->list.n;
  e->added_nothing = c->completes && completed_before(&e->list, c, data);
  if (c->completes && !e->added_nothing) {
    complete_orbits(&e->list, data, e->prec);
    e->added_nothing = e->list.n == found;
  }
}

static void list_solutions(struct cached *e) {
  if (e->until > 0) {
    dyn_branches_find(&e->list, e->value, e->until, e->prec, DYN_CELLS);
  } else {
    dyn_orbits_find(&e->list, e->value, e->prec, &dyn_limits_default);
    dyn_orbits_complete(&e->list, e->value, e->prec, DYN_CELLS);
  }
}

static const struct dyn_orbits *list_of(struct orbit_cache *c, struct data data, double until, slong prec) {
  for (size_t i = 0; i < c->n; i++)
    if (c->item[i]->prec == prec && c->item[i]->until == until && is_of(c->item[i], data)) return &c->item[i]->list;
  struct cached *e = ss_malloc(sizeof *e);
  *e = (struct cached){.until = until, .prec = prec};
  *SS_PUSH(c->item, c->n, c->cap) = e;
  for (int k = 0; k < N_DATA; k++) {
    e->given[k] = data.given[k];
    if (e->given[k]) fmpq_set(&e->value[k], &data.value[k]);
  }
  if (until == ORBITS_ALONE)
    list_orbits(e, c, data);
  else
    list_solutions(e);
  return &e->list;
}

static const bool forces[N_DATA] = {true, true, true, true, true};

const struct dyn_orbits *orbit_cache_get(struct orbit_cache *c, const fmpq params[N_PARAMS], slong prec) {
  return list_of(c, (struct data){params, forces}, ORBITS_ALONE, prec);
}

/* At exact chi, eta, V with exact t_b and t_c. */
static const struct dyn_orbits *orbits_of_times(struct orbit_cache *c, const fmpq q[N_Q], slong prec) {
  static const bool times[N_DATA] = {
      [KEY_CHI] = true, [KEY_ETA] = true, [KEY_V] = true, [KEY_TB] = true, [KEY_TC] = true};
  const fmpq value[N_DATA] = {[KEY_CHI] = q[Q_CHI],
                              [KEY_ETA] = q[Q_ETA],
                              [KEY_V] = q[Q_V],
                              [KEY_TB] = q[Q_TB],
                              [KEY_TC] = q[Q_TC]}; /* borrowed */
  return list_of(c, (struct data){value, times}, ORBITS_ALONE, prec);
}

/* One enclosure serves every precision up to FD_PREC, so that an orbit is searched once. */
static slong orbit_prec(slong prec) {
  return (prec > FD_PREC ? prec : FD_PREC) + 64;
}

const struct dyn_orbits *point_orbits(const struct point *p, struct orbit_cache *c, slong prec) {
  work_touch(p->scene ? WORK_SCENE_ORBITS : WORK_OTHER_ORBITS);
  if (p->kind == POINT_GIVEN) return orbits_of_times(c, p->q, orbit_prec(prec));
  if (!p->scene) return orbit_cache_get(c, p->q, orbit_prec(prec));
  return list_of(c, (struct data){p->scene->value, p->scene->given}, ORBITS_ALONE, orbit_prec(prec));
}

const struct dyn_orbits *scene_orbits(const struct scene *s, struct orbit_cache *cache) {
  work_touch(WORK_SCENE_ORBITS);
  return list_of(cache, (struct data){s->value, s->given}, ORBITS_ALONE, orbit_prec(FIRST_PREC));
}

const struct dyn_orbits *orbit_cache_solutions(struct orbit_cache *c, const fmpq params[N_PARAMS], double until,
                                               slong prec) {
  return list_of(c, (struct data){params, forces}, until, prec);
}

struct followed *orbit_followed(struct orbit_cache *c, const struct dyn_orbit *o, const struct num_vec *params) {
  for (size_t i = 0; i < c->n_followed; i++)
    if (followed_is(c->followed[i], o, params->ctx)) return c->followed[i];
  return *SS_PUSH(c->followed, c->n_followed, c->cap_followed) = followed_new(o, params);
}

struct orbit_pool **orbit_cache_pool(struct orbit_cache *c) {
  return &c->pool;
}

struct orbit_slope *orbit_cache_slope(struct orbit_cache *c, const struct dyn_orbit *o) {
  for (size_t i = 0; i < c->n_slopes; i++)
    if (c->slope[i].orbit == o) return &c->slope[i];
  c->slope = ss_grow(c->slope, c->n_slopes, &c->cap_slopes, sizeof *c->slope);
  c->slope[c->n_slopes] = (struct orbit_slope){.orbit = o};
  return &c->slope[c->n_slopes++];
}

bool orbit_is_new(struct orbit_set *set, const struct dyn_orbit *o) {
  for (int i = 0; i < set->n; i++)
    if (set->at[i] == o) return false;
  if (set->n == (int)(sizeof set->at / sizeof *set->at)) return false;
  set->at[set->n++] = o;
  return true;
}
