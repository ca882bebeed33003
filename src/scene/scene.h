/* Scenes: a set of exact parameters, what is printed about it, and what is asked of it.

     title: the paper's numerical example
     chi = 0.8
     eta = 1
     V   = 1
     e1  = 2.7844
     e2  = 0.8587
     printed: t_a = 0.6784
     ask: matrices, section stability

   A scene gives chi, eta, V and any two of e1, e2, t_a, t_b, t_c, t_d; u_r1 and u_r2 if it likes.  Parameters are
   constant expressions (decimals, + - * / ^, parentheses, the exact root of a square, sqrt(4/9)), kept exact; they may
   use the scene's other parameters, e2 = e1/3, in any order but not in a circle.  Domain: 0 < chi < 1, all others
   positive but t_a, which has any sign; u_r1 and u_r2 exceed e1 and e2 where these are given.  A printed line gives a
   decimal to be tested.

   It may name a sequence of phases in place of the paper's (explore/words.h), word: D Gamma H Gamma; then it gives e1
   and e2, or for the word Gamma H C, which is the paper's with a phase D of no length, t_a = 0 and one other of the
   six.

   A scene that gives chi, eta, V, e1 and e2 may give any of them as an interval, e2 = [1.7, 1.9]: then it is a box of
   parameters, and what is said holds for each point of it.

   A scene of another system than the paper's names a system file (mech/mech.h), system: chain3, with a word in that
   system's letters if it likes; then NAME = VALUE, with a constant, stands in place of the file's for a parameter of
   that file.

   Limits: a file of 1 MiB; values as in expr/constant.h, the parameters sharing its depth and work; exponents as in
   expr.h, of four digits; MAX_SCENE_LIST items of a list, MAX_SYSTEM_VALUES values of a system's parameters. */
#ifndef STICKSLIP_SCENE_SCENE_H
#define STICKSLIP_SCENE_SCENE_H

#include "base/text.h"
#include "explore/words.h"
#include "mech/mech.h"
#include "num/num.h"

/* What a scene's line takes. */
enum scene_takes {
  TAKES_TEXT,     /* any text */
  TAKES_VALUE,    /* a constant expression */
  TAKES_INTERVAL, /* the same, or [low, high] */
  TAKES_PRINTED,  /* NAME = DECIMAL; on as many lines as there are names */
  TAKES_CLAIMS,   /* ids and groups of claims, separated by commas */
  TAKES_QUANTITIES /* names of quantities */,
  TAKES_ROUTES, /* names of routes */
  TAKES_WORD,   /* phases, "D Gamma H C" (explore/words.h) */
  TAKES_SYSTEM, /* a path with / or .system, from the scene's folder, or a name in data/systems */
  TAKES_DIGITS, /* 1 to MOST_SCENE_DIGITS */
  TAKES_BUDGET  /* 1 to MOST_SCENE_BUDGET */
};
extern const char *const scene_takes_text[TAKES_BUDGET + 1];

/* What a key of a scene is used by: of the commands that take a scene, those whose answer it can change, and those that
   refuse a scene with it.  Times stand in place of e1 or e2, without which parameters are not exact; jacobian has use
   for the friction in words with a mass faster than the belt. */
#define SCENE_TIMES    "verify, orbit, jacobian, simulate, readings, plot; refused by bifurcate, words, sweep"
#define SCENE_FRICTION "verify, orbit, jacobian, simulate, bifurcate, words, sweep, plot"

/* Every key of a scene: KEY_..., its name, what it takes, what it means, and what it is used by.  The reader, its
   messages, stickslip list --scene-keys and the tests of stickslip-scene(5) and of every command with every key are
   made from this table.  Parameters stand first: they are written "NAME = value", the others "NAME: value". */
#define SCENE_KEYS(K)                                                                                                  \
  K(CHI, "chi", TAKES_INTERVAL, "k_2/(k_1 + k_2), above 0 and below 1", "every command")                               \
  K(ETA, "eta", TAKES_INTERVAL, "m_1/m_2, positive", "every command")                                                  \
  K(V, "V", TAKES_INTERVAL, "the belt's velocity, positive", "every command")                                          \
  K(E1, "e1", TAKES_INTERVAL, "u_r1 - u_s1, positive; one of the six of which two are given", "every command")         \
  K(E2, "e2", TAKES_INTERVAL, "u_r2 - u_s2, positive; one of the six", "every command")                                \
  K(TA, "t_a", TAKES_VALUE, "duration of the stick phase D, of any sign; one of the six", SCENE_TIMES)                 \
  K(TB, "t_b", TAKES_VALUE, "duration of the phase Gamma, positive; one of the six", SCENE_TIMES)                      \
  K(TC, "t_c", TAKES_VALUE, "duration of the slip phase H, positive; one of the six", SCENE_TIMES)                     \
  K(TD, "t_d", TAKES_VALUE, "duration of the phase C, positive; one of the six", SCENE_TIMES)                          \
  K(U_R1, "u_r1", TAKES_VALUE, "static friction of the first mass, above e1", SCENE_FRICTION)                          \
  K(U_R2, "u_r2", TAKES_VALUE, "static friction of the second mass, above e2", SCENE_FRICTION)                         \
  K(WORD, "word", TAKES_WORD, "phases of one period; without it the paper's, D Gamma H C",                             \
    "orbit, jacobian; refused by verify, simulate, bifurcate, readings, sweep, plot")                                  \
  K(SYSTEM, "system", TAKES_SYSTEM, "a system file in place of the paper's two masses",                                \
    "orbit, jacobian, words, simulate, bifurcate, plot; refused by verify, readings, sweep")                           \
  K(TITLE, "title", TAKES_TEXT, "what the scene is, in one line", "verify, list")                                      \
  K(PRINTED, "printed", TAKES_PRINTED, "a number as printed, to be tested, never an input",                            \
    "verify, jacobian, simulate, readings, plot")                                                                      \
  K(ASK, "ask", TAKES_CLAIMS, "claims to judge; without it all of them", "verify")                                     \
  K(VALUES, "values", TAKES_QUANTITIES, "quantities of the paper to give, such as H(t_c)[1,3]", "verify")              \
  K(ROUTES, "routes", TAKES_ROUTES, "routes to take; without it every route", "verify")                                \
  K(DIGITS, "digits", TAKES_DIGITS, "significant digits of the values", "verify")                                      \
  K(BUDGET, "budget", TAKES_BUDGET, "most work for each claim, or for all of words, the same on any machine",          \
    "verify, words")

enum scene_key {
#define SCENE_KEY_NAME(key, name, takes, meaning, used) KEY_##key,
  SCENE_KEYS(SCENE_KEY_NAME)
#undef SCENE_KEY_NAME
      N_SCENE_KEYS
};
enum { N_KEYS = KEY_U_R2 + 1, N_SCENE_PARAMS = KEY_E2 + 1 }; /* parameters; those that can be intervals */
struct scene_key_info {
  const char *name;
  enum scene_takes takes;
  const char *meaning, *used;
};
extern const struct scene_key_info scene_keys[N_SCENE_KEYS];
extern const char *const scene_key_name[N_SCENE_KEYS];

enum { MAX_SCENE_FILE = 1 << 20, MAX_SCENE_LIST = 1000, MAX_SYSTEM_VALUES = 1000, MOST_SCENE_DIGITS = 100000 };
#define MOST_SCENE_BUDGET 1000000000000000000ULL /* 10^18 */

/* What a printed decimal stands for, everywhere the same: the numbers that a scene prints are results of one
   computation, given to one number of decimals, the most that any of them has; digits that a shorter one leaves out
   are zeros.  It stands for every value that is written so, rounded or cut off (value/printed.h): among numbers of
   four decimals 2 is 2.0000, and 2.0053 does not print as 2.  A decimal with an exponent stands by itself. */
struct printed_number {
  char *name, *decimal;
  fmpq value;
  fmpq digit;    /* the unit of its own last digit */
  fmpq unit;     /* that of the last decimal to which it is given */
  bool override; /* not the file's */
};

/* A list as a scene writes it, "eq-27, section 4", each item without spaces at its ends. */
struct scene_list {
  char **item;
  struct span *place; /* of each item in the source */
  size_t n, cap;
  const struct source *source; /* the scene's file or a --set; the scene's own */
};

/* What is asked of a scene; where nothing is, the whole audit. */
struct scene_asked {
  struct scene_list claims;  /* ids of claims, as --only takes them, and groups of claims */
  struct scene_list values;  /* names of the paper's quantities, "trace_J", "H(t_c)[1,3]" */
  struct scene_list routes;  /* names of routes; none: all */
  long digits;               /* of the values; 0: not said */
  unsigned long long budget; /* of work for each claim, in units that no machine changes; 0: none */
};

/* What stands in place of lines of a scene's file, or beside them: texts NAME=VALUE, VALUE as after "NAME =" or
   "NAME:"; an empty VALUE takes the line away.  printed may come more than once; empty, it takes away the file's
   printed lines, and in whatever order they stand, none of the overrides' own. */
struct scene_overrides {
  const char *const *item;
  int n;
  const char *option; /* as diagnostics call them: "--set" */
};

struct scene {
  char *name; /* as outputs show it: its file's, without folder and suffix, and the overrides: "paper --set e2=1/2" */
  char *file; /* its file's alone */
  char *command; /* "stickslip verify" of it, as it was named, with the overrides and the data folder, for a shell */
  char *folder;  /* for its reports */
  char *path, *title;
  bool on_file;          /* it stands in the data folder\'s scenes */
  bool changed;          /* some parameter, printed number or the word is not the file's */
  struct mech_word word; /* n = 0: none is named, the paper's */
  char *system;          /* its name, or its path from the working directory; NULL: the paper's */
  const struct source *system_src;
  size_t system_at; /* the place of the line's value, for diagnostics */
  struct {
    char *text; /* the word of a scene with a system, in that system's letters, or NULL; its place for diagnostics */
    const struct source *src;
    size_t at;
  } system_word;
  struct mech_given *system_value; /* values of the system's parameters in place of its file's */
  struct scene_asked asked;
  fmpq value[N_KEYS]; /* the lower end of an interval */
  bool given[N_KEYS];
  bool interval[N_KEYS];     /* none of those behind N_SCENE_PARAMS is one */
  fmpq high[N_SCENE_PARAMS]; /* of an interval */
  struct printed_number *printed;
  size_t n_printed, cap_printed;
  struct source **source; /* the file and the overrides, for diagnostics that come later */
  size_t n_sources, cap_sources;
};

/* Which scenes are welcome: those of exact parameters and the paper's word; with intervals and other words, too; and
   those of another system, which have no parameters, beside the first kind or all. */
enum scene_welcome { SCENE_EXACT, SCENE_OF_TWO_MASSES, SCENE_EXACT_OR_SYSTEM, SCENE_OF_ANY_SYSTEM };
/* spec: a path (when it contains a slash or ends in .scene), else a name in data/scenes.  o may be NULL. */
bool scene_load_with(struct scene *s, const char *spec, const char *data, const struct scene_overrides *o,
                     enum scene_welcome any, struct diag *d);
/* The same from a text of at most MAX_SCENE_FILE bytes, which stands in no file; name is what it is called. */
bool scene_load_text(struct scene *s, const char *name, const char *text, const struct scene_overrides *o,
                     enum scene_welcome any, struct diag *d);
/* The names of the scenes in the data folder, in alphabetical order, in an array to be freed and an arena; NULL with d
   set when there are none. */
struct arena;
char **scene_names(size_t *n, const char *data, struct arena *a, struct diag *d);
/* The folder for the reports of such a scene, to be freed. */
char *scene_folder(const char *spec, const struct scene_overrides *o);
bool scene_is_box(const struct scene *s);
/* Are its data those of an example in print: does it print numbers, were neither they nor its parameters changed, and
   does it give forces, not times? */
bool scene_is_example(const struct scene *s);
/* Whose its data are, "the example" or "this scene", as sentences call them; and the data, "chi = 4/5, ..., e2 = [1,
   2]". */
const char *scene_data_of(const struct scene *s);
void scene_data_print(struct text *out, const struct scene *s);
/* Is it the example as it is on file, of which the verdicts on record are? */
bool scene_on_record(const struct scene *s);
void scene_clear(struct scene *s);
/* false with d set: there is no orbit of that number, from 0, where n are found. */
bool scene_lacks_orbit(const struct scene *s, slong orbit, slong n, struct diag *d);
/* The data folder, for a program or library in that file ("": unknown): $STICKSLIP_DATA; or verify/ above its build
   folder; or share/stickslip below the prefix that it is installed under; or where it was to be installed.  false:
   there is none. */
bool data_folder_find(struct text *out, const char *file);
#define SYSTEM_SUFFIX ".system"
/* The path of a system file from its path or its name in the data folder. */
void scene_system_path(struct text *out, const char *spec, const char *data);
/* Of a scene with a system: that system, to be cleared in any case, and the scene's word in it, or one of no phases; of
   exact parameters, or box: intervals are welcome. */
bool scene_load_system(struct mech *m, struct mech_word *w, const struct scene *s, const char *data, bool box,
                       struct diag *d);
/* false, with the message for those who cannot take a box, when it is one. */
bool scene_one_point(const struct scene *s, struct diag *d);
/* Is it the paper's solution II, t_a = 0 with the word Gamma-H-C?  It is solved as D-Gamma-H-C and counts as no other
                                                                    word. */
bool scene_solution_ii(const struct scene *s);
/* Does the scene name another word than the paper's? */
bool scene_other_word(const struct scene *s);
/* false, with the message for those who cannot take one, when it does. */
bool scene_papers_word(const struct scene *s, struct diag *d);
/* The same, and solution II is refused too: its three phases ask for less than the paper's four with t_a = 0. */
bool scene_four_phases(const struct scene *s, struct diag *d);
/* Does the scene give e1 and e2, so that its parameters are exact? */
bool scene_has_forces(const struct scene *s);
/* u_r1 and u_r2 where they are given, else NULL. */
void scene_static_friction(const fmpq *u_r[2], const struct scene *s);
/* Whether a mass is faster than the belt in the word, so that both are needed, and the scene does not give them. */
bool scene_lacks_friction(const struct scene *s, const struct mech_word *w);

/* What one of chi, eta, V, e1, e2 runs through, exactly. */
struct scene_range {
  fmpq_t from, to;
  int vary;
};
void scene_range_init(struct scene_range *r);
void scene_range_clear(struct scene_range *r);
/* Whether both ends lie in the parameter's domain; and whether e stays below the u_r that the scene gives, as in a
   scene itself. */
bool scene_range_in_domain(const struct scene_range *r);
bool scene_range_below_friction(const struct scene_range *r, const struct scene *s);
/* A constant expression (len bytes) as scenes have them, but without names, exact; name stands in the diagnostic. */
bool scene_constant(fmpq_t z, const char *text, size_t len, const char *name, struct diag *d);
/* The printed number of that name, or NULL. */
const struct printed_number *scene_printed(const struct scene *s, const char *name);

#endif
