/* The jobs and the studies, each in the order in which they are done. */
#include "bench/jobs.h"
#include "bench/study.h"

const struct bench_job *const bench_jobs[] = {&bench_propagator, &bench_map, &bench_jacobian, &bench_orbit};
const int n_bench_jobs = COUNT(bench_jobs);

const struct study *const bench_studies[] = {&study_stiff, &study_smooth, &study_procedure, &study_scenes,
                                             &study_systems};
const int n_bench_studies = COUNT(bench_studies);
