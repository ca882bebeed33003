/* The periodic orbits at the paper's data with their multipliers in MPFR, to 50 digits.
     cc -o orbit orbit.c $(pkg-config --cflags --libs stickslip) */
#include <stdio.h>
#include <stickslip.h>

static int fail(void) {
  fprintf(stderr, "%s\n", ss_error());
  return 1;
}

int main(void) {
  ss_scene *scene;
  ss_orbits *orbits;
  mpfr_t multiplier;
  if (ss_scene_open(&scene, "paper", NULL)) return fail();
  if (ss_orbits_find(&orbits, scene, 50)) return fail();
  ss_scene_free(scene);
  mpfr_init2(multiplier, 200);
  for (size_t k = 0; k < ss_orbits_count(orbits); k++) {
    ss_number_mpfr(multiplier, ss_orbit_number(orbits, k, SS_TRACE));
    mpfr_printf("orbit %zu: multiplier %.50Rg, %s, %s\n", k + 1, multiplier,
                ss_orbit_stable(orbits, k) == SS_TRUE ? "stable" : "not stable",
                ss_orbit_certified(orbits, k) ? "certified" : "not certified");
  }
  printf("%s\n", ss_orbits_complete(orbits) ? "there is no other" : ss_orbits_gap(orbits));
  mpfr_clear(multiplier);
  ss_orbits_free(orbits);
  ss_cleanup();
  return 0;
}
