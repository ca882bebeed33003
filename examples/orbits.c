/* Prints the periodic orbits at the paper's data, from the library alone:
     cc -o orbits orbits.c $(pkg-config --cflags --libs stickslip) */
#include <stdio.h>

#include <stickslip/dynamics.h>

int main(void) {
  static const char *const decimal[N_PARAMS] = {"0.8", "1", "1", "2.7844", "0.8587"}; /* chi eta V e1 e2 */
  fmpq params[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) {
    size_t len = 0;
    while (decimal[i][len]) len++;
    fmpq_init(&params[i]);
    if (num_parse_decimal(&params[i], decimal[i], len) != SS_OK) return 1;
  }
  struct dyn_orbits list;
  int status = dyn_orbits_find(&list, params, 128, &dyn_limits_default);
  for (slong i = 0; i < list.n; i++) {
    struct text t;
    text_init(&t);
    num_print(&t, list.orbit[i].period, 20);
    text_add(&t, " ");
    num_print(&t, list.orbit[i].trace, 20);
    printf("period and multiplier: %s\n", text_str(&t));
    text_clear(&t);
  }
  dyn_orbits_clear(&list);
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(&params[i]);
  flint_cleanup();
  return status == SS_OK ? 0 : 1;
}
