/* The ratios that are asked for, each from two rows of one run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/jobs.h"
#include "stickslip/arena.h"

void bench_result_clear(struct bench_result *r) {
  for (int i = 0; i < r->n; i++) bench_table_clear(&r->table[i]);
  free(r->table);
  free(r->ratio);
  *r = (struct bench_result){.n = 0};
}

void bench_ratios(struct bench_result *r) {
  (void)r;
}
