/* Scenes: a set of exact parameters, and what is printed about it.

     title: the paper's numerical example
     chi = 0.8
     eta = 1
     V   = 1
     e1  = 2.7844
     e2  = 0.8587
     printed: t_a = 0.6784

   A scene gives chi, eta, V and two of e1, e2, t_a, t_b, t_c, t_d; u_r1 and u_r2, the static friction, if it likes.
   Here e_i = u_ri - u_si.  Domain: 0 < chi < 1; all others positive but t_a, which has any sign; u_ri above e_i.
   Values are constant expressions, 0.8 or 4/5 or sqrt(4/9), and kept exact.  A line "word: D Gamma H Gamma" names
   another sequence of phases than the paper's D-Gamma-H-C (words.h); chi, eta, V, e1 and e2 may be intervals, e2 =
   [1.7, 1.9], which audit.h alone takes.  A scene that names a system file is the program's alone, here SS_INPUT.  The
   whole language: stickslip-scene(5). */
#ifndef SS_SCENE_H
#define SS_SCENE_H

#include "number.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ss_scene ss_scene;

/* Where the scenes on file, the paper's equations and the claims are, unless a function is told otherwise:
   $STICKSLIP_DATA; or the folder share/stickslip of the installation that the shared library is in; or the one that the
   library was built for. NULL when there is none.  Looked for once in a process. */
SS_API const char *ss_data_folder(void);
/* Tells f the name of each scene on file, in alphabetical order, until it returns 0 (SS_STOPPED).  data: the data
   folder, NULL for the usual one. */
SS_API int ss_scene_names(const char *data, int (*f)(void *self, const char *name), void *self);

/* From a file: spec is a path when it contains a slash or ends in .scene, else a name in the data folder (NULL: the
   usual one), "paper". */
SS_API int ss_scene_open(ss_scene **out, const char *spec, const char *data);
/* From a text of at most 1 MiB in the language of scene files; name is what messages and certificates call it. */
SS_API int ss_scene_read(ss_scene **out, const char *name, const char *text);
/* One line anew, "e2=1/2", "word=D Gamma H C", "printed=t_a = 0.6784"; "t_a=" takes a line away.  The scene has to be
   whole after each; after a failure it is what it was.  To exchange e2 for t_a, say both at once, "e2=\nt_a=1/2". */
SS_API int ss_scene_set(ss_scene *s, const char *lines);
SS_API void ss_scene_free(ss_scene *s);

/* "paper", and after ss_scene_set "paper --set e2=1/2". */
SS_API const char *ss_scene_name(const ss_scene *s);
/* "" without one. */
SS_API const char *ss_scene_title(const ss_scene *s);
/* chi, eta, V, e1, e2, t_a, t_b, t_c, t_d, u_r1, u_r2: the exact value; NULL where the scene does not give it, or gives
   an interval. */
SS_API const ss_number *ss_scene_parameter(const ss_scene *s, const char *name);
/* The number that is printed under that name, exactly as printed; NULL where none is. */
SS_API const ss_number *ss_scene_printed(const ss_scene *s, const char *name);

#ifdef __cplusplus
}
#endif

#endif
