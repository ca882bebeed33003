/* Systems in memory: what is made from masses and links, and the matrices of a phase. */
#include "mech.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"

void mech_init(struct mech *m) {
  *m = (struct mech){.n = 0};
  m->title = ss_strdup("");
  fmpq_mat_init(m->stiffness, 0, 0);
  fmpq_mat_init(m->damping, 0, 0);
  fmpq_mat_init(m->loading, 0, 0);
  fmpq_init(m->frequency);
}

static void links_clear(struct mech_link *link, int n) {
  for (int i = 0; i < n; i++) fmpq_clear(link[i].size);
  free(link);
}

void mech_given_free(struct mech_given *list) {
  while (list) {
    struct mech_given *next = list->next;
    free((char *)list->name);
    fmpq_clear(list->low);
    fmpq_clear(list->high);
    free(list);
    list = next;
  }
}

/* Initialises the numbers of a mass, or clears them. */
static void each_number(struct mech_mass *mass, void (*f)(fmpq_t)) {
  f(mass->inertia);
  f(mass->sliding);
  f(mass->limit);
  f(mass->surface);
  for (int s = 0; s < 2; s++) {
    f(mass->stop[s].position);
    f(mass->stop[s].restitution);
  }
}

void mech_clear(struct mech *m) {
  for (int i = 0; i < m->n; i++) each_number(&m->mass[i], fmpq_clear);
  links_clear(m->spring, m->n_springs);
  links_clear(m->damper, m->n_dampers);
  for (int l = 0; l < m->n_loads; l++) {
    fmpq_clear(m->load[l].frequency);
    fmpq_clear(m->load[l].cosine);
    fmpq_clear(m->load[l].sine);
  }
  free(m->load);
  fmpq_mat_clear(m->stiffness);
  fmpq_mat_clear(m->damping);
  fmpq_mat_clear(m->loading);
  fmpq_clear(m->frequency);
  free(m->title);
  mech_given_free(m->interval);
  for (int i = 0; i < m->n_intervals; i++) mech_clear(&m->moved[i]);
  free(m->moved);
}

static void set_name(char to[MECH_NAME], const char *name) {
  snprintf(to, MECH_NAME, "%s", name);
}

struct mech_mass *mech_add_mass(struct mech *m, const char *name) {
  if (m->n == MECH_MASSES) return NULL;
  struct mech_mass *mass = &m->mass[m->n++];
  *mass = (struct mech_mass){.rubbed = false};
  set_name(mass->name, name);
  each_number(mass, fmpq_init);
  return mass;
}

struct mech_link *mech_add_link(struct mech *m, bool spring, const char *name) {
  int *n = spring ? &m->n_springs : &m->n_dampers;
  struct mech_link **list = spring ? &m->spring : &m->damper;
  if (*n == MECH_LINKS) return NULL;
  *list = ss_realloc(*list, (size_t)(*n + 1) * sizeof **list);
  struct mech_link *link = &(*list)[(*n)++];
  *link = (struct mech_link){.end = {-1, -1}};
  set_name(link->name, name);
  fmpq_init(link->size);
  return link;
}

struct mech_load *mech_add_load(struct mech *m, const char *name) {
  if (m->n_loads == MECH_LINKS) return NULL;
  m->load = ss_realloc(m->load, (size_t)(m->n_loads + 1) * sizeof *m->load);
  struct mech_load *load = &m->load[m->n_loads++];
  load->mass = 0;
  set_name(load->name, name);
  fmpq_init(load->frequency);
  fmpq_init(load->cosine);
  fmpq_init(load->sine);
  return load;
}

struct mech_stop *mech_add_stop(struct mech_mass *mass, bool above, const char *name) {
  struct mech_stop *stop = &mass->stop[above];
  stop->given = true;
  set_name(stop->name, name);
  return stop;
}

/* --- K, C, P and Omega --- */

static void add_to(fmpq_mat_t k, int i, int j, const fmpq_t x, bool minus) {
  fmpq *entry = fmpq_mat_entry(k, i, j);
  if (minus)
    fmpq_sub(entry, entry, x);
  else
    fmpq_add(entry, entry, x);
}

static void make_matrix(fmpq_mat_t k, int n, const struct mech_link *link, int n_links) {
  fmpq_mat_clear(k);
  fmpq_mat_init(k, n, n);
  for (int l = 0; l < n_links; l++)
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 2; j++) {
        int a = link[l].end[i], b = link[l].end[j];
        if (a >= 0 && b >= 0) add_to(k, a, b, link[l].size, i != j);
      }
}

/* What is wrong with the frequencies of the loads together, all positive, and in *name where it shows; or NULL. */
static const char *make_loading(struct mech *m, const char **name) {
  NUMBERS(fmpq, base, order);
  fmpq_mat_clear(m->loading);
  fmpq_mat_init(m->loading, m->n, 2 * MECH_ORDERS);
  for (int l = 0; l < m->n_loads; l++) fmpq_gcd(base, base, m->load[l].frequency);
  fmpq_set(m->frequency, base);
  m->n_orders = m->n_loads > 0;
  m->order[0] = 1;
  for (int l = 0; l < m->n_loads; l++) {
    struct mech_load *load = &m->load[l];
    *name = load->name;
    fmpq_div(order, load->frequency, base);
    if (fmpq_cmp_si(order, MECH_HIGHEST) > 0)
      return "its frequency is more than 64 times the largest number of which those of all loads are whole multiples";
    load->order = (int)fmpz_get_si(fmpq_numref(order));
    int k = 0;
    while (k < m->n_orders && m->order[k] != load->order) k++;
    if (k == MECH_ORDERS) return "loads have at most 8 frequencies, beside one of which all are whole multiples";
    if (k == m->n_orders) m->order[m->n_orders++] = load->order;
    add_to(m->loading, load->mass, 2 * k, load->cosine, false);
    add_to(m->loading, load->mass, 2 * k + 1, load->sine, false);
  }
  return NULL;
}

/* The first mass that no chain of springs ties to the ground; n: all are tied. */
static int first_loose(const struct mech *m) {
  bool tied[MECH_MASSES] = {false};
  for (int round = 0; round < m->n; round++)
    for (int l = 0; l < m->n_springs; l++)
      for (int side = 0; side < 2; side++) {
        int here = m->spring[l].end[side], there = m->spring[l].end[!side];
        if (here >= 0 && (there < 0 || tied[there])) tied[here] = true;
      }
  int i = 0;
  while (i < m->n && tied[i]) i++;
  return i;
}

static const char *wrong_with_mass(const struct mech_mass *mass) {
  if (fmpq_sgn(mass->inertia) <= 0) return "an inertia is positive";
  if (!mass->rubbed) return NULL;
  if (fmpq_sgn(mass->sliding) < 0) return "a sliding friction is not negative";
  if (fmpq_cmp(mass->limit, mass->sliding) < 0) return "its static limit is below its sliding friction";
  return fmpq_sgn(mass->limit) > 0 ? NULL : "friction without any force: leave its lines out";
}

static const char *wrong_with_stops(const struct mech_mass *mass, const char **name) {
  for (int s = 0; s < 2; s++) {
    const struct mech_stop *stop = &mass->stop[s];
    if (!stop->given) continue;
    *name = stop->name;
    if (fmpq_sgn(stop->restitution) < 0 || fmpq_cmp_si(stop->restitution, 1) > 0)
      return "a restitution is between 0 and 1";
    if (fmpq_is_zero(stop->restitution) && mass->rubbed && fmpq_is_zero(mass->surface))
      return "a mass that comes to rest there, with a restitution of 0, would stick to its surface, which is at rest "
             "as well";
    if (s && mass->stop[0].given && fmpq_cmp(mass->stop[0].position, stop->position) >= 0)
      return "it leaves no room between it and the obstacle below";
  }
  return NULL;
}

static const char *wrong_with_link(const struct mech_link *link) {
  if (link->end[0] == link->end[1]) return "it ties something to itself";
  return fmpq_sgn(link->size) > 0 ? NULL : "a stiffness, and a damper's constant, is positive";
}

static const char *wrong_with_load(const struct mech_load *load) {
  if (fmpq_sgn(load->frequency) <= 0) return "a frequency is positive";
  return fmpq_is_zero(load->cosine) && fmpq_is_zero(load->sine) ? "a load without any force" : NULL;
}

const char *mech_other_order(const struct mech *a, const struct mech *b) {
  for (int l = 0; l < a->n_loads; l++)
    if (a->load[l].order != b->load[l].order) return a->load[l].name;
  return NULL;
}

bool mech_finish(struct mech *m, const char **why, const char **name) {
  *why = m->n ? NULL : "a system has at least one mass";
  *name = "";
  for (int i = 0; !*why && i < m->n; i++)
    if ((*why = wrong_with_mass(&m->mass[i])))
      *name = m->mass[i].name;
    else
      *why = wrong_with_stops(&m->mass[i], name);
  for (int l = 0; !*why && l < m->n_springs + m->n_dampers; l++) {
    const struct mech_link *link = l < m->n_springs ? &m->spring[l] : &m->damper[l - m->n_springs];
    if ((*why = wrong_with_link(link))) *name = link->name;
  }
  for (int l = 0; !*why && l < m->n_loads; l++)
    if ((*why = wrong_with_load(&m->load[l]))) *name = m->load[l].name;
  if (!*why) *why = make_loading(m, name);
  int loose = *why ? m->n : first_loose(m);
  if (loose < m->n) {
    *why = "no chain of springs ties it to the ground, so that nothing brings it back";
    *name = m->mass[loose].name;
  }
  make_matrix(m->stiffness, m->n, m->spring, m->n_springs);
  make_matrix(m->damping, m->n, m->damper, m->n_dampers);
  m->states = 2 * m->n + 2 * m->n_orders;
  return !*why;
}

/* --- A phase --- */

static const char marks[] = "<>"; /* of rebounds */

/* row += sign f_i */
static void add_force(fmpq *row, const struct mech *m, int i, int sign) {
  for (int j = 0; j < m->states; j++) {
    const fmpq *entry = j < m->n       ? fmpq_mat_entry(m->stiffness, i, j)
                        : j < 2 * m->n ? fmpq_mat_entry(m->damping, i, j - m->n)
                                       : fmpq_mat_entry(m->loading, i, j - 2 * m->n);
    if ((sign > 0) == (j < 2 * m->n))
      fmpq_add(row + j, row + j, entry);
    else
      fmpq_sub(row + j, row + j, entry);
  }
}

/* constant += sign u_i of a slipping mass */
static void add_friction(fmpq *constant, const struct mech_mass *mass, char mode, int sign) {
  if (mode == '.') return;
  ((mode == '-') == (sign > 0) ? fmpq_add : fmpq_sub)(constant, constant, mass->sliding);
}

void mech_at_angle(double *pairs, const struct mech *m, double theta) {
  for (int k = 0; k < m->n_orders; k++) {
    pairs[2 * k] = cos(m->order[k] * theta);
    pairs[2 * k + 1] = sin(m->order[k] * theta);
  }
}

void mech_rate(fmpq_mat_t a, const struct mech *m, const char *phase) {
  int n = m->n, one = m->states;
  fmpq_mat_zero(a);
  for (int k = 0, at = 2 * n; k < m->n_orders; k++, at += 2) {
    fmpq_mul_si(fmpq_mat_entry(a, at, at + 1), m->frequency, -m->order[k]);
    fmpq_mul_si(fmpq_mat_entry(a, at + 1, at), m->frequency, m->order[k]);
  }
  for (int i = 0; i < n; i++) {
    if (mech_rests(phase[i])) continue;
    fmpq_one(fmpq_mat_entry(a, i, n + i));
    if (phase[i] == 's') continue;
    fmpq *row = fmpq_mat_entry(a, n + i, 0);
    add_force(row, m, i, -1);
    add_friction(row + one, &m->mass[i], phase[i], 1);
    for (int j = 0; j <= one; j++) fmpq_div(row + j, row + j, m->mass[i].inertia);
  }
}

void mech_condition(fmpq_mat_t row, const struct mech *m, int mass, char mode, enum mech_end end) {
  fmpq *c = fmpq_mat_entry(row, 0, 0), *constant = c + m->states;
  fmpq_mat_zero(row);
  if (mech_is_hit(end)) {
    fmpq_set_si(c + mass, end == MECH_HITS_ABOVE ? 1 : -1, 1);
    fmpq_set(constant, m->mass[mass].stop[end == MECH_HITS_ABOVE].position);
    if (end == MECH_HITS_ABOVE) fmpq_neg(constant, constant);
  } else if (end == MECH_REACHES) {
    fmpq_set_si(c + m->n + mass, mode == '-' ? 1 : -1, 1);
    fmpq_set(constant, m->mass[mass].surface);
    if (mode == '-') fmpq_neg(constant, constant);
  } else if (end == MECH_LIFTS) {
    int sign = mode == 'a' ? 1 : -1;
    add_force(c, m, mass, sign);
    add_friction(constant, &m->mass[mass], mech_slipping(&m->mass[mass]), -sign);
  } else {
    add_force(c, m, mass, end == MECH_BREAKS_SLOWER ? 1 : -1);
    fmpq_neg(constant, m->mass[mass].limit);
  }
}

bool mech_is_hit(enum mech_end end) {
  return end == MECH_HITS_BELOW || end == MECH_HITS_ABOVE;
}

bool mech_rests(char mode) {
  return mode == 'a' || mode == 'b';
}

char mech_slipping(const struct mech_mass *mass) {
  return !mass->rubbed ? '.' : fmpq_sgn(mass->surface) > 0 ? '-' : '+';
}

void mech_mark(char *to, int mass, bool above) {
  int number = mass + 1;
  *to++ = marks[above];
  if (number >= 10) *to++ = (char)('0' + number / 10);
  *to++ = (char)('0' + number % 10);
  *to = '\0';
}

int mech_event(enum mech_end *end, const char *from, const char *to) {
  size_t letters = strcspn(to, marks);
  int mass = to[letters] ? atoi(to + letters + 1) - 1 : -1;
  for (int i = 0; i < (int)letters; i++) {
    if (from[i] == to[i] || i == mass) continue;
    if (mass >= 0) return -1;
    mass = i;
  }
  if (to[letters])
    *end = to[letters] == '<' ? MECH_HITS_BELOW : MECH_HITS_ABOVE;
  else if (mass >= 0 && mech_rests(to[mass]))
    *end = to[mass] == 'b' ? MECH_HITS_BELOW : MECH_HITS_ABOVE;
  else if (mass >= 0 && mech_rests(from[mass]))
    *end = MECH_LIFTS;
  else if (mass >= 0)
    *end = from[mass] != 's' ? MECH_REACHES : to[mass] == '-' ? MECH_BREAKS_SLOWER : MECH_BREAKS_FASTER;
  return mass;
}

/* --- Words --- */

static bool is_mark(const char *s, size_t len, int mass) {
  char mark[MECH_PHASE - MECH_MASSES + 1];
  mech_mark(mark, mass, s[0] == '>');
  return word_is(s, len, mark);
}

static const char *wrong_with_mode(char mode, const struct mech_mass *mass) {
  if (!strchr("s-+.ab", mode))
    return "a mass sticks (s), slips slower (-) or faster (+) than its surface, is free (.), or rests at the obstacle "
           "above (a) or below (b)";
  const struct mech_stop *stop = &mass->stop[mode == 'a'];
  if (mech_rests(mode))
    return stop->given && fmpq_is_zero(stop->restitution) ? NULL
                                                          : "a mass rests only at an obstacle with a restitution of 0";
  if ((mode == '.') != mass->rubbed) return NULL;
  return mass->rubbed ? "a mass that a surface rubs is not free (.)" : "a mass that nothing rubs is free (.)";
}

static const char *wrong_with_phase(const char *s, size_t len, const struct mech *m) {
  size_t letters = strcspn(s, marks) < len ? strcspn(s, marks) : len;
  if (letters != (size_t)m->n) return "a phase has one letter for each mass";
  for (int i = 0; i < m->n; i++) {
    const char *why = wrong_with_mode(s[i], &m->mass[i]);
    if (why) return why;
  }
  if (letters == len) return NULL;
  int mass = 0;
  while (mass < m->n && !is_mark(s + letters, len - letters, mass)) mass++;
  if (mass == m->n) return "a rebound is written behind the letters of its phase, <1 or >1 with the number of the mass";
  if (s[mass] == 's') return "a mass that rebounds does not stick at once";
  if (mech_rests(s[mass])) return "a mass that rebounds does not rest at once";
  if (!m->mass[mass].stop[s[letters] == '>'].given) return "there is no obstacle at that side of this mass";
  return NULL;
}

/* m: NULL where the letters are those of a motion. */
static const char *wrong_with_order(const struct mech_word *w, int k, const struct mech *m) {
  enum mech_end end;
  const char *from = w->phase[k], *to = w->phase[(k + 1) % w->n];
  int mass = mech_event(&end, from, to);
  bool leaves = mass >= 0 && mech_rests(from[mass]);
  if (leaves && (end != MECH_LIFTS || to[mass] == 's' || (m && to[mass] != mech_slipping(&m->mass[mass]))))
    return "a mass that leaves an obstacle slips as at rest beside its surface, or is free";
  if (mass >= 0) return NULL;
  return strncmp(from, to, strcspn(to, marks)) == 0 ? "a phase is followed by another one"
                                                    : "one mass changes its mode at a time";
}

bool mech_word_good(const struct mech_word *w) {
  bool good = true;
  for (int k = 0; k < w->n; k++) good = good && !wrong_with_order(w, k, NULL);
  return good;
}

bool mech_word_is_of(const struct mech_word *w, const struct mech *m) {
  bool all = true;
  for (int k = 0; k < w->n; k++) all = all && !wrong_with_phase(w->phase[k], strlen(w->phase[k]), m);
  return all;
}

bool mech_word_parse(struct mech_word *w, size_t *at, const char **why, const char *text, const struct mech *m) {
  size_t place[MECH_PHASES];
  w->n = 0;
  *at = 0;
  *why = "a word has at least one phase";
  for (const char *p = text + strspn(text, " "); *p; p += strspn(p, " ")) {
    size_t len = strcspn(p, " ");
    *at = (size_t)(p - text);
    *why = w->n == MECH_PHASES ? "a word has at most 48 phases" : wrong_with_phase(p, len, m);
    if (*why) return false;
    place[w->n] = *at;
    memcpy(w->phase[w->n], p, len);
    w->phase[w->n++][len] = '\0';
    p += len;
  }
  if (w->n == 0) return false;
  for (int k = 0; k < w->n; k++)
    if ((*why = wrong_with_order(w, k, m))) {
      *at = place[k];
      return false;
    }
  return true;
}

void mech_word_print(struct text *out, const struct mech_word *w) {
  for (int k = 0; k < w->n; k++) text_printf(out, "%s%s", k ? " " : "", w->phase[k]);
}

void mech_word_turn(struct mech_word *out, const struct mech_word *in, int by) {
  struct mech_word turned = {.n = in->n};
  for (int k = 0; k < in->n; k++) memcpy(turned.phase[k], in->phase[(k + by) % in->n], sizeof turned.phase[k]);
  *out = turned;
}

bool mech_word_goes_through(const struct mech_word *w, const struct mech_word *once, int by) {
  bool same = w->n % once->n == 0;
  for (int k = 0; same && k < w->n; k++) same = strcmp(w->phase[k], once->phase[(k + by) % once->n]) == 0;
  return same;
}

int mech_word_turned(const struct mech_word *a, const struct mech_word *b) {
  for (int by = 0; a->n == b->n && by < a->n; by++)
    if (mech_word_goes_through(a, b, by)) return by;
  return -1;
}

bool mech_word_same(const struct mech_word *a, const struct mech_word *b) {
  return mech_word_turned(a, b) >= 0;
}
