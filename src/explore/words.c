/* Words of phases: reading, printing, turning, which phase can follow which, and which words cannot close. */
#include <string.h>

#include "words.h"

const char *const word_fate_name[] = {"open", "impossible", "coincidence", "unclosed", "family"};

enum { N_PAIRS = N_MODES * N_MODES };

/* In the order of canonical words. */
static const struct {
  char letter;
  const char *name, *of_system; /* the phase of a word of src/mech */
  enum coulomb_mode mode[2];
} pairs[N_PAIRS] = {{'D', "D", "ss", {MODE_STICK, MODE_STICK}},     {'G', "Gamma", "-s", {MODE_BELOW, MODE_STICK}},
                    {'H', "H", "--", {MODE_BELOW, MODE_BELOW}},     {'C', "C", "s-", {MODE_STICK, MODE_BELOW}},
                    {'g', "gamma", "+s", {MODE_ABOVE, MODE_STICK}}, {'h', "h", "++", {MODE_ABOVE, MODE_ABOVE}},
                    {'c', "c", "s+", {MODE_STICK, MODE_ABOVE}},     {'X', "X", "-+", {MODE_BELOW, MODE_ABOVE}},
                    {'x', "x", "+-", {MODE_ABOVE, MODE_BELOW}}};

static int rank_of(const enum coulomb_mode mode[2]) {
  int k = 0;
  while (pairs[k].mode[0] != mode[0] || pairs[k].mode[1] != mode[1]) k++;
  return k;
}

const char *phase_word_name(const enum coulomb_mode mode[2]) {
  return pairs[rank_of(mode)].name;
}

const char *phase_name_of_system(const char *phase) {
  int k = 0;
  while (strcmp(pairs[k].of_system, phase) != 0) k++;
  return pairs[k].name;
}

struct mech_word phase_word_of_system(const struct phase_word *w) {
  struct mech_word out = {.n = w->n};
  for (int i = 0; i < w->n; i++) strcpy(out.phase[i], pairs[rank_of(w->mode[i])].of_system);
  return out;
}

/* --- Reading and printing. --- */

static bool complain(size_t *at, const char **why, size_t where, const char *what) {
  *at = where;
  *why = what;
  return false;
}

/* A phase at the beginning of len letters: how many of them it takes, 0 when there is none. */
static size_t phase_at(int *k, const char *text, size_t len) {
  for (*k = 0; *k < N_PAIRS; ++*k)
    if (strlen(pairs[*k].name) == len && strncmp(pairs[*k].name, text, len) == 0) return len;
  for (*k = 0; *k < N_PAIRS; ++*k)
    if (pairs[*k].letter == text[0]) return 1;
  return 0;
}

bool phase_word_parse(struct phase_word *w, size_t *at, const char **why, const char *text, size_t len) {
  w->n = 0;
  bool apart = false; /* a hyphen waits for its phase */
  for (size_t i = 0; i < len;) {
    if (text[i] == ' ' || text[i] == '\t' || text[i] == '-') {
      if (text[i] == '-' && (apart || w->n == 0)) return complain(at, why, i, "a hyphen stands between two phases");
      apart = apart || text[i] == '-';
      i++;
      continue;
    }
    size_t end = i;
    while (end < len && char_is_letter(text[end])) end++;
    bool whole = i == 0 || !char_is_letter(text[i - 1]);
    int k = 0;
    size_t taken = end == i ? 0 : phase_at(&k, text + i, whole ? end - i : 1);
    if (taken == 0) return complain(at, why, i, "the phases are D, Gamma, H, C, gamma, h, c, X and x");
    if (w->n == WORD_MOST) return complain(at, why, i, "a word has at most 12 phases");
    memcpy(w->mode[w->n++], pairs[k].mode, sizeof pairs[k].mode);
    apart = false;
    i += taken;
  }
  if (apart) return complain(at, why, len - 1, "a hyphen stands between two phases");
  return w->n > 0 || complain(at, why, 0, "a word has at least one phase");
}

void phase_word_print(struct text *out, const struct phase_word *w) {
  for (int i = 0; i < w->n; i++) text_printf(out, "%s%s", i ? "-" : "", phase_word_name(w->mode[i]));
}

/* --- Turning. --- */

void phase_word_turn(struct phase_word *out, const struct phase_word *in, int by) {
  struct phase_word turned = {.n = in->n};
  for (int i = 0; i < in->n; i++) memcpy(turned.mode[i], in->mode[(i + by) % in->n], sizeof turned.mode[i]);
  *out = turned;
}

/* By the order of the phases, from their first. */
static int compare(const struct phase_word *a, const struct phase_word *b) {
  for (int i = 0; i < a->n && i < b->n; i++) {
    int order = rank_of(a->mode[i]) - rank_of(b->mode[i]);
    if (order) return order;
  }
  return a->n - b->n;
}

bool phase_word_turns_into(const struct phase_word *other, const struct phase_word *w, int by) {
  struct phase_word turned;
  phase_word_turn(&turned, w, by);
  return compare(&turned, other) == 0;
}

void phase_word_canonical(struct phase_word *w) {
  struct phase_word best = *w, turned;
  for (int by = 1; by < w->n; by++) {
    phase_word_turn(&turned, w, by);
    if (compare(&turned, &best) < 0) best = turned;
  }
  *w = best;
}

bool phase_word_same(const struct phase_word *a, const struct phase_word *b) {
  struct phase_word x = *a, y = *b;
  phase_word_canonical(&x);
  phase_word_canonical(&y);
  return compare(&x, &y) == 0;
}

bool phase_word_is_papers(const struct phase_word *w) {
  static const struct phase_word papers = {
      4, {{MODE_STICK, MODE_STICK}, {MODE_BELOW, MODE_STICK}, {MODE_BELOW, MODE_BELOW}, {MODE_STICK, MODE_BELOW}}};
  return phase_word_same(w, &papers);
}

bool phase_word_has_faster(const struct phase_word *w) {
  for (int i = 0; i < w->n; i++)
    if (w->mode[i][0] == MODE_ABOVE || w->mode[i][1] == MODE_ABOVE) return true;
  return false;
}

/* --- What can happen. --- */

const char *phase_word_barrier(const enum coulomb_mode from[2], const enum coulomb_mode to[2]) {
  bool one = from[0] != to[0], two = from[1] != to[1];
  if (!one && !two) return "a phase does not follow itself";
  if (one && two) return "both masses change at once, which needs a coincidence of two events";
  if (one && from[0] == MODE_STICK && to[0] == MODE_ABOVE && from[1] != MODE_ABOVE)
    return "the force on m1 only rises while it sticks and m2 is not faster than the belt, so it breaks loose to the "
           "slower side";
  if (two && from[1] == MODE_STICK) {
    if (from[0] == MODE_STICK) return "the force on m2 is constant while both masses stick";
    if (from[0] == MODE_BELOW && to[1] == MODE_ABOVE)
      return "the force on m2 only rises while it sticks and m1 is slower than the belt";
    if (from[0] == MODE_ABOVE && to[1] == MODE_BELOW)
      return "the force on m2 only falls while it sticks and m1 is faster than the belt";
  }
  return NULL;
}

static bool ever_slower(const struct phase_word *w, int mass) {
  for (int i = 0; i < w->n; i++)
    if (w->mode[i][mass] == MODE_BELOW) return true;
  return false;
}

enum word_fate phase_word_fate(struct text *why, const struct phase_word *w) {
  for (int both = 0; both < 2 && w->n > 1; both++)
    for (int i = 0; i < w->n; i++) {
      const enum coulomb_mode *from = w->mode[i], *to = w->mode[(i + 1) % w->n];
      const char *barrier = phase_word_barrier(from, to);
      if (!barrier || (from[0] != to[0] && from[1] != to[1]) != both) continue;
      if (why) text_printf(why, "%s to %s: %s", phase_word_name(from), phase_word_name(to), barrier);
      return both ? WORD_COINCIDENCE : WORD_IMPOSSIBLE;
    }
  for (int mass = 0; mass < 2; mass++) {
    if (ever_slower(w, mass)) continue;
    if (why) text_printf(why, "m%d is never slower than the belt, so it does not come back", mass + 1);
    return WORD_UNCLOSED;
  }
  if (w->n > 1) return WORD_OPEN;
  if (why) text_add(why, "both masses slip for ever: families of free oscillations, no isolated orbit");
  return WORD_FAMILY;
}

/* --- All of them. --- */

static void set_phase(struct phase_word *w, int i, int k) {
  memcpy(w->mode[i], pairs[k].mode, sizeof w->mode[i]);
}

static bool is_canonical(const struct phase_word *w) {
  struct phase_word least = *w;
  phase_word_canonical(&least);
  return compare(w, &least) == 0;
}

/* Counts like an odometer, and skips what a barrier forbids at the first place where it does. */
bool phase_word_next(struct phase_word *w, int n) {
  int at[WORD_MOST], i = w->n == 0 ? 0 : n - 1;
  bool fresh = w->n == 0;
  for (int k = 0; k < n; k++) at[k] = fresh ? -1 : rank_of(w->mode[k]);
  w->n = n;
  while (i >= 0) {
    if (++at[i] == N_PAIRS) {
      at[i--] = -1;
      continue;
    }
    set_phase(w, i, at[i]);
    if (at[i] < at[0] || (i > 0 && phase_word_barrier(w->mode[i - 1], w->mode[i]))) continue;
    if (i < n - 1) {
      i++;
      continue;
    }
    if ((n == 1 || !phase_word_barrier(w->mode[n - 1], w->mode[0])) && is_canonical(w)) return true;
  }
  return false;
}

/* Burnside: the mean over the turns by k of the words that they leave alone, closed walks of gcd(k, n) steps on nine
   points without a step in place, 8^d + 8 (-1)^d of them. */
long phase_word_count(int n) {
  if (n == 1) return N_PAIRS;
  long sum = 0;
  for (int k = 1; k <= n; k++) {
    int d = (int)n_gcd((ulong)k, (ulong)n);
    sum += (d % 2 ? -8 : 8) + (1L << 3 * d);
  }
  return sum / n;
}
