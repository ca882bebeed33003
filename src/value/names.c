/* How the paper's names are built: "z'_1b" is a component of the state Z_b, "dt_a" a change of a time, "x_2''(t)" a
   motion with its primes and its argument.  Only the words are read here; what they are worth is symbols.c, and over
   exact algebra proof/exact_motion.c. */
#include "values.h"

#include <string.h>

int name_of_arc(const char *name) {
  static const struct {
    const char *name;
    int at;
  } table[] = {{"t_a", 100},  {"t_b", 101},  {"t_c", 102}, {"t_d", 103}, {"z_10", 0},   {"z_20", 1},  {"z'_10", 2},
               {"z'_20", 3},  {"z_1a", 4},   {"z_2a", 5},  {"z'_1a", 6}, {"z'_2a", 7},  {"z_1b", 8},  {"z_2b", 9},
               {"z'_1b", 10}, {"z'_2b", 11}, {"z_1c", 12}, {"z_2c", 13}, {"z'_1c", 14}, {"z'_2c", 15}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (strcmp(table[i].name, name) == 0) return table[i].at;
  return -1;
}

bool name_of_tangent(const char *name, int *index) {
  static const char components[] = "xyuv", ends[] = "abcf", times[] = "abcd";
  const char *c = name[0] ? strchr(components, name[0]) : NULL;
  if (c && !name[1]) {
    *index = (int)(c - components);
    return true;
  }
  if (c && name[1] == '_' && name[2] && !name[3] && strchr(ends, name[2])) {
    *index = 4 * (int)(strchr(ends, name[2]) - ends + 1) + (int)(c - components);
    return true;
  }
  if (strncmp(name, "dt_", 3) != 0 || !name[3] || name[4] || !strchr(times, name[3])) return false;
  *index = 100 + (int)(strchr(times, name[3]) - times);
  return true;
}

bool name_of_motion(const char *name, bool *in_x, int *component, int *primes, const char **argument) {
  if ((name[0] != 'z' && name[0] != 'x') || name[1] != '_' || (name[2] != '1' && name[2] != '2')) return false;
  *in_x = name[0] == 'x';
  *component = name[2] - '1';
  const char *p = name + 3;
  for (*primes = 0; *p == '\''; p++) ++*primes;
  *argument = p;
  return *p == '(' && *primes <= 2;
}

int name_of_switching_time(const char *argument) {
  static const char *const times[8] = {"(t_a)",
                                       "(t_a + t_b)",
                                       "(t_a + t_b + t_c)",
                                       "(t_a + t_b + t_c + t_d)",
                                       "(t_a + dt_a)",
                                       "(t_a + dt_a + t_b + dt_b)",
                                       "(t_a + dt_a + t_b + dt_b + t_c + dt_c)",
                                       "(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)"};
  for (int k = 0; k < 8; k++)
    if (strcmp(argument, times[k]) == 0) return k;
  return -1;
}
