/* Where along e2 the paper's orbit is stable: its multiplier at a thousand values, and those between which it passes
   -1.
     cc -o sweep sweep.c $(pkg-config --cflags --libs stickslip) */
#include <stdio.h>
#include <stickslip.h>

/* The orbit that breaks no condition, at the value before. */
struct before {
  double e2, multiplier;
};

static int look(void *self, const ss_swept *row) {
  struct before *before = self;
  double multiplier = row->out[SS_OUT_TRACE];
  if (row->admissible != SS_TRUE) return 1;
  if (before->multiplier < -1 && multiplier >= -1)
    printf("stable from e2 between %.15g and %.15g on\n", before->e2, row->x);
  before->e2 = row->x;
  before->multiplier = multiplier;
  return 1;
}

int main(void) {
  ss_scene *scene;
  struct before before = {0, 0};
  if (ss_scene_open(&scene, "paper", NULL) || ss_sweep(scene, "e2", "1.7", "2", 1001, 0, look, &before)) {
    fprintf(stderr, "%s\n", ss_error());
    return 1;
  }
  printf("at e2 = %.15g its multiplier is %.12f\n", before.e2, before.multiplier);
  ss_scene_free(scene);
  return 0;
}
