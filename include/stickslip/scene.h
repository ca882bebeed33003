/* Scenes: a set of exact parameters and what is printed about it.

     title: the paper's numerical example
     chi = 0.8
     eta = 1
     V   = 1
     e1  = 2.7844
     e2  = 0.8587
     printed: t_a = 0.6784

   A scene gives chi, eta, V and any two of e1, e2, t_a, t_b, t_c, t_d; u_r1 and u_r2 if it likes.  Parameters are constant
   expressions (decimals, + - * / ^ and parentheses), kept exact.  Domain: 0 < chi < 1, all others positive but t_a, which
   has any sign; u_r1 and u_r2 exceed e1 and e2 where these are given.  A printed line gives a decimal to be tested.

   A scene that gives chi, eta, V, e1 and e2 may give any of them as an interval, e2 = [1.7, 1.9]: then it is a box of
   parameters, and what is said holds for each point of it. */
#ifndef STICKSLIP_SCENE_H
#define STICKSLIP_SCENE_H

#include "stickslip/num.h"
#include "stickslip/text.h"

/* What a scene can set, and what it can print: name in scene files, name in the paper's notation. */
enum scene_key {
  KEY_CHI,
  KEY_ETA,
  KEY_V,
  KEY_E1, /* from here six, of which two are given */
  KEY_E2,
  KEY_TA,
  KEY_TB,
  KEY_TC,
  KEY_TD,
  KEY_U_R1,
  KEY_U_R2,
  N_KEYS
};
enum { N_SCENE_PARAMS = KEY_E2 + 1 };
extern const char *const scene_key_name[N_KEYS];

/* A decimal as printed, with the two brackets of its last digit. */
struct printed_number {
  char *name, *decimal;
  fmpq value;
  fmpq unit; /* of the last printed digit */
};

struct scene {
  char *name, *path, *title;
  fmpq value[N_KEYS]; /* the lower end of an interval */
  bool given[N_KEYS];
  bool interval[N_SCENE_PARAMS];
  fmpq high[N_SCENE_PARAMS]; /* of an interval */
  struct printed_number *printed;
  size_t n_printed, cap_printed;
};

/* spec: a path (when it contains a slash or ends in .scene), else a name in data/scenes. */
bool scene_load(struct scene *s, const char *spec, const char *data, struct diag *d);
/* The same for those who take a box as well; scene_load refuses it. */
bool scene_load_box(struct scene *s, const char *spec, const char *data, struct diag *d);
bool scene_is_box(const struct scene *s);
void scene_clear(struct scene *s);
/* Does the scene give e1 and e2, so that its parameters are exact? */
bool scene_has_forces(const struct scene *s);
/* A constant expression (len bytes) as scenes have them, exact; name stands in the diagnostic. */
bool scene_constant(fmpq_t z, const char *text, size_t len, const char *name, struct diag *d);
/* The printed number of that name, or NULL. */
const struct printed_number *scene_printed(const struct scene *s, const char *name);

#endif
