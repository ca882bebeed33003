/* How the paper's names are built: "z'_1b" is a component of the state Z_b, "dt_a" a change of a time, "x_2''(t)" a
   motion with its primes and its argument.  Only the words are read here; what they are worth is symbols.c, and over
   exact algebra proof/exact_motion.c. */
#include "names.h"

#include <string.h>

#include "base/text.h"

const char *const name_param[N_PARAMS] = {"chi", "eta", "V", "e_1", "e_2"};
const char *const name_time[N_PHASES] = {"t_a", "t_b", "t_c", "t_d"};
const char *const name_meeting[N_PHASES - 1] = {"S_a", "S_b", "S_c"};
const char *const name_of_point[N_OF_POINT] = {"u_s1", "u_s2", "x", "y", "lambda"};
const char *const name_shift[N_PHASES] = {"dt_a", "dt_b", "dt_c", "dt_d"};
const char *const name_switching[N_PHASES + 1] = {"0", "t_a", "t_a + t_b", "t_a + t_b + t_c", "t_a + t_b + t_c + t_d"};
const char *const name_state[N_PHASES + 1][N_STATE] = {{"z_10", "z_20", "z'_10", "z'_20"},
                                                       {"z_1a", "z_2a", "z'_1a", "z'_2a"},
                                                       {"z_1b", "z_2b", "z'_1b", "z'_2b"},
                                                       {"z_1c", "z_2c", "z'_1c", "z'_2c"},
                                                       {"z_1f", "z_2f", "z'_1f", "z'_2f"}};
const char *const name_tangent[N_PHASES + 1][N_STATE] = {{"x", "y", "u", "v"},
                                                         {"x_a", "y_a", "u_a", "v_a"},
                                                         {"x_b", "y_b", "u_b", "v_b"},
                                                         {"x_c", "y_c", "u_c", "v_c"},
                                                         {"x_f", "y_f", "u_f", "v_f"}};

/* The place in a list of states, or 100 and the place in one of times; -1 for another name. */
static int place_of(const char *name, const char *const *states, int n, const char *const *times) {
  int state = word_find(name, states, n), time = word_find(name, times, N_PHASES);
  return state < n ? state : time < N_PHASES ? 100 + time : -1;
}

int name_of_arc(const char *name) {
  return place_of(name, name_state[0], N_PHASES * N_STATE, name_time);
}

int name_of_tangent(const char *name) {
  return place_of(name, name_tangent[0], (N_PHASES + 1) * N_STATE, name_shift);
}

int name_of_propagator(const char *name) {
  size_t len = strcspn(name, "(");
  for (int ph = 0; ph < N_PHASES; ph++)
    if (word_is(name, len, phase_name[ph]) && strcmp(name + len, "(t)") == 0) return ph;
  return -1;
}

bool name_of_motion(struct motion_name *out, const char *name) {
  if ((name[0] != 'z' && name[0] != 'x') || name[1] != '_' || (name[2] != '1' && name[2] != '2')) return false;
  int primes = (int)strspn(name + 3, "'");
  *out = (struct motion_name){name[0] == 'x', name[2] - '1', primes, name + 3 + primes};
  return *out->argument == '(' && primes <= 2;
}

bool name_is_free(const char *name) {
  struct motion_name n;
  bool alone = strcmp(name, "u_s1") == 0 || strcmp(name, "u_s2") == 0 || strcmp(name, "lambda") == 0;
  return alone || name_of_tangent(name) >= 0 || (name_of_motion(&n, name) && n.in_x && !n.primes);
}

bool name_goes_with_time(const char *name) {
  struct motion_name n;
  return strcmp(name, "t") == 0 || (name_of_motion(&n, name) && strcmp(n.argument, "(t)") == 0);
}

/* Which of the eight lengths and their changes a sum in parentheses has, each once, as bits; 0 says nothing; -1 where
   it has something else, or is no such sum. */
static int terms_of(const char *sum) {
  int bits = 0;
  if (*sum != '(') return -1;
  for (const char *p = sum + 1; *p; p++) {
    size_t n = strcspn(p, " )");
    int bit = 0;
    for (int k = 0; k < N_PHASES; k++) {
      if (word_is(p, n, name_time[k])) bit = 1 << k;
      if (word_is(p, n, name_shift[k])) bit = 1 << (N_PHASES + k);
    }
    if (bits & bit || (!bit && !word_is(p, n, "0"))) return -1;
    bits |= bit;
    p += n;
    if (strcmp(p, ")") == 0) return bits;
    if (strncmp(p, " + ", 3) != 0) return -1;
    p += 2;
  }
  return -1;
}

int name_of_lengths(const char *argument) {
  int bits = terms_of(argument);
  return bits >> N_PHASES ? -1 : bits;
}

int name_of_switching_time(const char *argument) {
  enum { ALL = (1 << N_PHASES) - 1 };
  int bits = terms_of(argument), phases = 0;
  if (bits < 0) return -1;
  int times = bits & ALL, shifts = bits >> N_PHASES;
  while (times >> phases & 1) phases++;
  if (times != (1 << phases) - 1 || (shifts && shifts != times)) return -1;
  return phases + (shifts ? N_PHASES : 0);
}

static bool reads(const struct expr *e, const char *as) {
  OWNED(text) t = {0};
  expr_print(&t, e);
  return strcmp(text_str(&t), as) == 0;
}

enum phase name_of_span(enum phase *last, const struct stmt *s) {
  bool closed = s->lo_closed || s->hi_closed, equations = true;
  for (int k = 0; k + 1 < s->n_sides; k++) equations = equations && s->ops[k] == REL_EQ;
  for (int i = 0; s->range_hi && (!closed || equations) && i < N_PHASES; i++)
    for (int k = i; reads(s->range_lo, name_switching[i]) && k < N_PHASES; k++) {
      *last = (enum phase)k;
      if (reads(s->range_hi, name_switching[k + 1])) return (enum phase)i;
    }
  return N_PHASES;
}

enum phase name_of_range(const struct stmt *s) {
  enum phase last, first = name_of_span(&last, s);
  return first < N_PHASES && first == last ? first : N_PHASES;
}
