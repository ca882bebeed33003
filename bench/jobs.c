/* The jobs in the order in which they are run. */
#include "bench/jobs.h"

const struct bench_job *const bench_jobs[] = {&bench_propagator, &bench_map, &bench_jacobian, &bench_orbit};
const int n_bench_jobs = sizeof bench_jobs / sizeof *bench_jobs;
