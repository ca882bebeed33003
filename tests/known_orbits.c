#include "known_orbits.h"

#include <check.h>
#include <string.h>

#include "rational.h"

static struct known {
  struct table table;
  struct known_set set[KNOWN_SETS];
  int n;
} orbits, later;

static const struct known *read_once(struct known *k, const char *path) {
  if (k->n) return k;
  k->table = table_read(path, ANY_COLUMNS);
  for (int i = 0; i < k->table.n; i++) {
    char *const *row = k->table.row[i];
    if (strcmp(row[0], "set") != 0) {
      k->set[k->n - 1].n++;
      continue;
    }
    ck_assert_int_lt(k->n, KNOWN_SETS);
    const char *const *text = (const char *const *)row + 2;
    struct known_set *s = &k->set[k->n++];
    *s = (struct known_set){.name = row[1], .text = text, rationals(text, N_PARAMS), .orbit = k->table.row + i + 1};
    for (int j = 0; j < N_PARAMS; j++) s->value[j] = fmpq_get_d(s->params + j);
  }
  return k;
}

static const struct known *all(void) {
  return read_once(&orbits, "tests/oracle/orbits.tsv");
}

const struct known_set *known_set(int i) {
  ck_assert_int_eq(all()->n, KNOWN_SETS);
  return &orbits.set[i];
}

const struct known_set *known_set_named(const char *name) {
  for (int i = 0; i < all()->n; i++)
    if (strcmp(orbits.set[i].name, name) == 0) return &orbits.set[i];
  ck_abort_msg("no set %s", name);
}

struct known_orbit known_orbit(int i) {
  int set = 0;
  ck_assert_int_eq(all()->table.n, KNOWN_SETS + KNOWN_ORBITS);
  for (; i >= orbits.set[set].n; set++) i -= orbits.set[set].n;
  return (struct known_orbit){&orbits.set[set], orbits.set[set].orbit[i]};
}

struct known_orbit known_orbit_named(const char *set, int index) {
  const struct known_set *s = known_set_named(set);
  ck_assert_int_lt(index, s->n);
  return (struct known_orbit){s, s->orbit[index]};
}

const struct known_set *later_set(int i) {
  ck_assert_int_lt(i, read_once(&later, "tests/oracle/later.tsv")->n);
  return &later.set[i];
}
