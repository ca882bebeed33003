/* Words of phases: reading, printing, turning, which phase can follow which, and which words cannot close. */
#include <string.h>

#include "words.h"

const char *const word_fate_name[] = {"open", "impossible", "coincidence", "unclosed", "family"};

enum { N_PAIRS = 9 };

/* In the order of canonical words.  The first letter of a name stands for it. */
static const struct {
  const char *name, *phase;
} pairs[N_PAIRS] = {{"D", "ss"}, {"Gamma", "-s"}, {"H", "--"}, {"C", "s-"}, {"gamma", "+s"},
                    {"h", "++"}, {"c", "s+"},     {"X", "-+"}, {"x", "+-"}};

static int rank_of(const char *phase) {
  int k = 0;
  while (strcmp(pairs[k].phase, phase) != 0) k++;
  return k;
}

const char *phase_word_name(const char *phase) {
  return pairs[rank_of(phase)].name;
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
    if (word_is(text, len, pairs[*k].name)) return len;
  for (*k = 0; *k < N_PAIRS; ++*k)
    if (pairs[*k].name[0] == text[0]) return 1;
  return 0;
}

bool phase_word_parse(struct mech_word *w, size_t *at, const char **why, const char *text, size_t len) {
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
    strcpy(w->phase[w->n++], pairs[k].phase);
    apart = false;
    i += taken;
  }
  if (apart) return complain(at, why, len - 1, "a hyphen stands between two phases");
  return w->n > 0 || complain(at, why, 0, "a word has at least one phase");
}

void phase_word_print(struct text *out, const struct mech_word *w) {
  for (int i = 0; i < w->n; i++) text_printf(out, "%s%s", i ? "-" : "", phase_word_name(w->phase[i]));
}

/* --- Turning. --- */

/* Where the turn of the word comes first that begins with its phase number 0, 1, ...; of equal ones the first. */
static int first_turn(const struct mech_word *w) {
  int best = 0;
  for (int by = 1; by < w->n; by++) {
    int order = 0;
    for (int i = 0; i < w->n && !order; i++)
      order = rank_of(w->phase[(i + by) % w->n]) - rank_of(w->phase[(i + best) % w->n]);
    if (order < 0) best = by;
  }
  return best;
}

void phase_word_canonical(struct mech_word *w) {
  mech_word_turn(w, w, first_turn(w));
}

bool phase_word_is_papers(const struct mech_word *w) {
  static const struct mech_word papers = {4, {"ss", "-s", "--", "s-"}};
  return mech_word_same(w, &papers);
}

bool phase_word_has_faster(const struct mech_word *w) {
  for (int i = 0; i < w->n; i++)
    if (strchr(w->phase[i], '+')) return true;
  return false;
}

/* --- What can happen. --- */

const char *phase_word_barrier(const char *from, const char *to) {
  bool one = from[0] != to[0], two = from[1] != to[1];
  if (!one && !two) return "a phase does not follow itself";
  if (one && two) return "both masses change at once, which needs a coincidence of two events";
  if (one && from[0] == 's' && to[0] == '+' && from[1] != '+')
    return "the force on m1 only rises while it sticks and m2 is not faster than the belt, so it breaks loose to the "
           "slower side";
  if (two && from[1] == 's') {
    if (from[0] == 's') return "the force on m2 is constant while both masses stick";
    if (from[0] == '-' && to[1] == '+')
      return "the force on m2 only rises while it sticks and m1 is slower than the belt";
    if (from[0] == '+' && to[1] == '-')
      return "the force on m2 only falls while it sticks and m1 is faster than the belt";
  }
  return NULL;
}

static bool ever_slower(const struct mech_word *w, int mass) {
  for (int i = 0; i < w->n; i++)
    if (w->phase[i][mass] == '-') return true;
  return false;
}

enum word_fate phase_word_fate(struct text *why, const struct mech_word *w) {
  for (int both = 0; both < 2 && w->n > 1; both++)
    for (int i = 0; i < w->n; i++) {
      const char *from = w->phase[i], *to = w->phase[(i + 1) % w->n];
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

/* Counts like an odometer, and skips what a barrier forbids at the first place where it does. */
bool phase_word_next(struct mech_word *w, int n) {
  int at[WORD_MOST], i = w->n == 0 ? 0 : n - 1;
  bool fresh = w->n == 0;
  for (int k = 0; k < n; k++) at[k] = fresh ? -1 : rank_of(w->phase[k]);
  w->n = n;
  while (i >= 0) {
    if (++at[i] == N_PAIRS) {
      at[i--] = -1;
      continue;
    }
    strcpy(w->phase[i], pairs[at[i]].phase);
    if (at[i] < at[0] || (i > 0 && phase_word_barrier(w->phase[i - 1], w->phase[i]))) continue;
    if (i < n - 1) {
      i++;
      continue;
    }
    if ((n == 1 || !phase_word_barrier(w->phase[n - 1], w->phase[0])) && first_turn(w) == 0) return true;
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
