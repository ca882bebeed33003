/* The studies in the order in which they are made. */
#include "bench/jobs.h"
#include "bench/study.h"

const struct study *const bench_studies[] = {&study_stiff, &study_smooth, &study_procedure, &study_scenes,
                                             &study_systems};
const int n_bench_studies = sizeof bench_studies / sizeof *bench_studies;
