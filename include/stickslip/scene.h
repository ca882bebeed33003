/* Scenes: a set of exact parameters and what is printed about it.

     title: the paper's numerical example
     chi = 0.8
     eta = 1
     V   = 1
     e1  = 2.7844
     e2  = 0.8587
     printed: t_a = 0.6784

   Parameters are constant expressions (decimals, + - * / ^ and parentheses), kept exact.  Domain: 0 < chi < 1 and
   eta, V, e1, e2 > 0; u_r1 and u_r2, when given, exceed e1 and e2.  A printed line gives a decimal to be tested. */
#ifndef STICKSLIP_SCENE_H
#define STICKSLIP_SCENE_H

#include "stickslip/num.h"
#include "stickslip/text.h"

/* What a scene can set, and what it can print: name in scene files, name in the paper's notation. */
enum scene_key { KEY_CHI, KEY_ETA, KEY_V, KEY_E1, KEY_E2, KEY_U_R1, KEY_U_R2, N_KEYS };
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
  fmpq value[N_KEYS];
  bool given[N_KEYS];
  struct printed_number *printed;
  size_t n_printed, cap_printed;
};

/* spec: a path (when it contains a slash or ends in .scene), else a name in data/scenes. */
bool scene_load(struct scene *s, const char *spec, const char *data, struct diag *d);
void scene_clear(struct scene *s);
/* The printed number of that name, or NULL. */
const struct printed_number *scene_printed(const struct scene *s, const char *name);

#endif
