/* Where the orbits of the word D-Gamma-H-C change along a line in parameter space, in proved brackets.

     flip                           the multiplier passes -1
     fold                           two orbits merge; tr J = 1
     t_a, h_v2, c_w, u_r1, u_r2     a condition of admissibility becomes an equality
     h_v1, t_c, c_v2, t_b,          an event grazes or a phase vanishes: the branch of orbits ends
     gamma_v1, gamma_r */
#ifndef SS_BIFURCATE_H
#define SS_BIFURCATE_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ss_changes ss_changes;
/* The changes while chi, eta, V, e1 or e2 runs from one end to the other ("0.5", "3"), each in a bracket of about one
   unit of so many significant digits (1 to 1000) of the parameter.  The scene gives e1 and e2.  About a second.  Not
   proved complete: a branch between two of the 257 values searched at can be missing. */
SS_API int ss_changes_find(ss_changes **out, const ss_scene *s, const char *parameter, const char *from, const char *to,
                           size_t digits);
SS_API void ss_changes_free(ss_changes *c);
SS_API size_t ss_changes_count(const ss_changes *c);
/* Sign changes that could not be narrowed down; 1 when a search or a branch ran into its limits. */
SS_API size_t ss_changes_missed(const ss_changes *c);
SS_API int ss_changes_cut_short(const ss_changes *c);

/* Change i, by increasing parameter: its id of the table above; the ends of its bracket, exact; which branch, from
   0. */
SS_API const char *ss_change_kind(const ss_changes *c, size_t i);
SS_API const ss_number *ss_change_low(const ss_changes *c, size_t i);
SS_API const ss_number *ss_change_high(const ss_changes *c, size_t i);
SS_API size_t ss_change_branch(const ss_changes *c, size_t i);
/* 1 when it is proved that the function that changes sign has a zero in the bracket; and that it has no second one
   there. */
SS_API int ss_change_proved(const ss_changes *c, size_t i);
SS_API int ss_change_unique(const ss_changes *c, size_t i);
/* The orbit there: t_b, t_c, and tr J, which can be unknown (infinite radius). */
SS_API const ss_number *ss_change_t_b(const ss_changes *c, size_t i);
SS_API const ss_number *ss_change_t_c(const ss_changes *c, size_t i);
SS_API const ss_number *ss_change_trace(const ss_changes *c, size_t i);
/* The orbits that take part at the lower (side 0) or the upper (side 1) end of the bracket: how many exist, 0 to 2;
   whether orbit k of them is stable, and fulfils every condition but those on u_r1 and u_r2. */
SS_API size_t ss_change_orbits(const ss_changes *c, size_t i, int side);
SS_API enum ss_truth ss_change_stable(const ss_changes *c, size_t i, int side, size_t k);
SS_API enum ss_truth ss_change_admissible(const ss_changes *c, size_t i, int side, size_t k);

#ifdef __cplusplus
}
#endif

#endif
