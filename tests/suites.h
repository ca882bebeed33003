/* Every suite of the project, in the order in which the runner calls them. */
#ifndef STICKSLIP_TESTS_SUITES_H
#define STICKSLIP_TESTS_SUITES_H

#include <check.h>

Suite *base_suite(void);
Suite *tex_suite(void);
Suite *num_suite(void);
Suite *solve_suite(void);
Suite *expr_suite(void);
Suite *edit_suite(void);
Suite *tape_suite(void);
Suite *model_suite(void);
Suite *dynamics_suite(void);
Suite *map_suite(void);
Suite *given_suite(void);
Suite *complete_suite(void);
Suite *coulomb_suite(void);
Suite *audit_suite(void);
Suite *plan_suite(void);
Suite *argument_suite(void);
Suite *law_suite(void);
Suite *readings_suite(void);
Suite *jacobian_suite(void);
Suite *behaviour_suite(void);
Suite *routes_suite(void);
Suite *errata_suite(void);
Suite *exact_suite(void);
Suite *stable_suite(void);
Suite *certify_suite(void);
Suite *html_suite(void);
Suite *pictures_suite(void);
Suite *diff_suite(void);
Suite *report_suite(void);
Suite *cli_suite(void);
Suite *terminal_suite(void);
Suite *mutate_suite(void);
Suite *bifurcate_suite(void);
Suite *box_suite(void);
Suite *basin_suite(void);
Suite *sincos_suite(void);
Suite *double_double_suite(void);
Suite *batch_suite(void);
Suite *bench_suite(void);
Suite *stiff_suite(void);
Suite *bench_pages_suite(void);
Suite *return_map_suite(void);
Suite *warm_suite(void);
Suite *sweep_suite(void);
Suite *stability_suite(void);
Suite *scene_suite(void);
Suite *words_suite(void);
Suite *hostile_suite(void);
Suite *messages_suite(void);

#endif
