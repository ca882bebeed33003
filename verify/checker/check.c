/* stickslip-checker: rechecks certificates of periodic stick-slip orbits, trusting nothing in them.

   It shares no source with the program that writes them.  Masses obey m_i x_i'' = u_i - f_i, f = K x + C x' - sum P_k
   (cos k theta, sin k theta), with K and C made from springs and dampers, theta' a frequency, and Coulomb's law: u_i =
   +s_i on a mass slower than its surface, -s_i on a faster one, |u_i| = |f_i| < r_i while one sticks, x_i' = V_i.  A
   mass that reaches an obstacle rebounds, or rests there, pressed against it, until it is not.  A word's unknowns are
   the lengths of its phases and what is free at its start; its equations are the events that end the phases, and the
   return.

   Krawczyk's operator on these equations proves one solution in the file's box and then narrows it.  The multipliers
   are those of the first return, from the derivatives.  That a function f = c y of the motion stays below zero is
   proved on each half of a phase, from the phase's end inwards, by halving further until f(0) + f'(0) s + B s^2/2 < 0
   on each piece, B >= |f''|; an event is the first where f or -f does.  With F the masses that slip or are free and k
   >= 2 (1 where no mass sticks), b = x^(k) obeys M b'' + C b' + K b = P^(k) on F, so that the energy 2 E = b' M b' +
   b K b has d sqrt(2 E)/dt <= the sum of (l frequency)^k sqrt(sum |P_li|^2/m_i) over the orders l, and |c y^(k)| <=
   sqrt(c_x K^-1 c_x + c_v M^-1 c_v) sqrt(2 E), to which the loads in c are added; |f''| is |c y''| or |c A y'|, the
   smaller.  A zero that f has at an end of its phase by the equations is factored out by the sign of its first
   derivative that is not zero there.  The precision doubles while anything is undecided.

   Where no mass is ever faster than its surface, x can be counted from the rest under all sliding friction, which then
   is in no equation: f_i of a mass that sticks lies between e_i - 2 r_i and its excess e_i = r_i - s_i, and the least
   r_i with that e_i is (e_i - least f_i)/2.  Excesses and lengths of phases are numbers alike: as many of them are
   given as there are masses.  The paper's two masses are such a system.

   That no orbit is left out is not claimed, and not checked.  Exit status: 0 verified, 1 rejected, 2 usage, 3 not a
   certificate, 4 no answer: memory ran out, or nobody took the answer. */
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "checker.h"

enum { MAX_ORBITS = 100, MAX_TURNS = 999999, MAX_PREC = 1 << 20, FAR = 1 << 20, MAX_SIZE = 1000, LIGHTEST = -39 };

/* An orbit's entry in the file, and what is settled about it. */
static struct entry {
  int number; /* from 0 */
  struct word word;
  fmpq given[NUMBERS];
  arb_struct x[NUMBERS]; /* the file's box, then where in it the solution is */
  bool boxed, lawful;    /* the box is proved; so are the verdicts about the law */
  const char *open;      /* what is undecided */
} orbits[MAX_ORBITS];

static void settle(struct entry *o, const char *what, int answer) {
  if (answer == NO) stop(REJECTED, "orbit %d: %s is not as claimed", o->number + 1, what);
  if (answer == OPEN) o->open = what;
}

static int verdict(const struct entry *o, const char *name) {
  return get(TRUTH, ".orbits.%d.verdicts.%s", o->number, name)[0] == 't' ? YES : NO;
}

static int sign_of(num x) {
  return arb_is_positive(x) ? YES : arb_is_nonpositive(x) ? NO : OPEN;
}

/* Whether the number is in the ball of the file. */
static int within(const char *claim, num own) {
  arb_ptr ball = fresh();
  read_ball(ball, claim);
  return arb_contains(ball, own) ? YES : arb_overlaps(ball, own) ? OPEN : NO;
}

/* Whether two entries may be one orbit, entered elsewhere: their phases are the same, of lengths that may be. */
static bool may_be_one(const struct entry *a, const struct entry *b) {
  const struct word *v = &a->word, *w = &b->word;
  for (int by = 0; by < w->n; by++) {
    int k = 0;
    while (k < v->n * w->n && strcmp(v->phase[k % v->n], w->phase[(k + by) % w->n]) == 0 &&
           arb_overlaps(a->x + v->n_free + k % v->n, b->x + w->n_free + (k + by) % w->n))
      k++;
    if (k == v->n * w->n) return true;
  }
  return false;
}

/* --- The system --- */

static slong size_of(const fmpq_t q) {
  return (slong)fmpz_bits(fmpq_numref(q)) - (slong)fmpz_bits(fmpq_denref(q));
}

/* A number of a system: from about 2^-1000 to 2^1000 in size, or 0; positive for sign = 1, for 0 not negative. */
static void check_size(const fmpq_t q, int sign, const char *what) {
  if ((!fmpq_is_zero(q) && labs(size_of(q)) > MAX_SIZE) || fmpq_sgn(q) < sign)
    stop(REJECTED, "%s is out of its range", what);
}

static __attribute__((format(printf, 3, 4))) void read_size(fmpq_t q, int sign, const char *fmt, ...) {
  char path[80];
  va_list args;
  va_start(args, fmt);
  vsnprintf(path, sizeof path, fmt, args);
  va_end(args);
  read_rational(q, get(STRING, ".system.%s", path));
  check_size(q, sign, path);
}

/* A whole number between two others in as few digits as it has; else -1. */
static int read_whole(const char *text, int least, int most) {
  size_t len = strspn(text, "0123456789");
  int i = len > 0 && len < 7 && !text[len] && (text[0] != '0' || len == 1) ? atoi(text) : -1;
  return i < least || i > most ? -1 : i;
}

/* The index of a mass from its number; -1 for the ground where that is allowed, which has the number 0. */
static int read_mass_number(const char *text, bool ground) {
  int i = read_whole(text, ground ? 0 : 1, sys.n);
  if (i < 0) stop(REJECTED, "there is no mass with the number %.20s", text);
  return i - 1;
}

static bool has(int mass, const char *name) {
  return get(OPTIONAL, ".system.masses.%d.%s", mass, name) != NULL;
}

static void read_mass(int i) {
  static const char *const side[2] = {"below", "above"};
  fmpq *of = fmpq_mat_entry(sys.mass, i, 0);
  has(i, "name");
  read_size(of + INERTIA, 1, "masses.%d.inertia", i);
  if (size_of(of + INERTIA) < LIGHTEST) stop(REJECTED, "mass %d is too light to be checked", i + 1);
  sys.rubbed[i] = has(i, "surface");
  if (sys.rubbed[i]) read_size(of + SURFACE, -1, "masses.%d.surface", i);
  if (sys.shifted ? has(i, "static") : sys.rubbed[i]) read_size(of + STATIC, 1, "masses.%d.static", i);
  if (sys.rubbed[i] && !sys.shifted) read_size(of + SLIDING, 0, "masses.%d.sliding", i);
  if (!sys.shifted && fmpq_cmp(of + STATIC, of + SLIDING) < 0)
    stop(REJECTED, "mass %d: its static limit is below its sliding friction", i + 1);
  for (int k = 0; k < 2; k++) {
    sys.stopped[k][i] = get(OPTIONAL, ".system.masses.%d.%s.position", i, side[k]) != NULL;
    if (!sys.stopped[k][i]) continue;
    read_size(of + POSITION + k, -1, "masses.%d.%s.position", i, side[k]);
    read_size(of + RESTITUTION + k, 0, "masses.%d.%s.restitution", i, side[k]);
    if (fmpq_is_zero(of + RESTITUTION + k) && sys.rubbed[i] && fmpq_is_zero(of + SURFACE))
      stop(REJECTED, "mass %d: at rest at its obstacle it would stick to its surface", i + 1);
    if (fmpq_cmp_ui(of + RESTITUTION + k, 1) > 0) stop(REJECTED, "mass %d: its restitution is above 1", i + 1);
  }
  if (sys.shifted && (!sys.rubbed[i] || has(i, "sliding") || sys.stopped[0][i] || sys.stopped[1][i]))
    stop(REJECTED, "mass %d: where sliding friction is left open it is so of every mass, and none meets an obstacle",
         i + 1);
  if (sys.stopped[0][i] && sys.stopped[1][i] && fmpq_cmp(of + POSITION, of + POSITION + 1) >= 0)
    stop(REJECTED, "mass %d: there is no room between its obstacles", i + 1);
}

/* Springs or dampers between two masses, or one and the ground; first: the column of the force for the first mass. */
static void read_links(int first, const char *list, const char *name) {
  static fmpq size;
  get(GROUP, ".system.%s", list);
  for (int l = 0; get(OPTIONAL, ".system.%s.%d.%s", list, l, name); l++) {
    int end[2];
    for (int i = 0; i < 2; i++) end[i] = read_mass_number(get(STRING, ".system.%s.%d.between.%d", list, l, i), true);
    read_size(&size, 1, "%s.%d.%s", list, l, name);
    if (end[0] == end[1]) stop(REJECTED, "%s.%d ties something to itself", list, l);
    for (int i = 0; i < 4; i++) {
      int row = end[i / 2], column = end[i % 2];
      if (row < 0 || column < 0) continue;
      fmpq *entry = fmpq_mat_entry(sys.force, row, first + column);
      (row == column ? fmpq_add : fmpq_sub)(entry, entry, &size);
    }
  }
}

/* The place of a load's order among all; a new one is added. */
static int read_order(int load) {
  const char *text = get(OPTIONAL, ".system.loads.%d.order", load);
  int order = text ? read_whole(text, 1, ORDERS) : 1, k = 0;
  if (order < 0) stop(REJECTED, "%.20s is no order of a load", text);
  while (k < sys.orders && sys.order[k] != order) k++;
  if (k < sys.orders) return k;
  sys.side += 2;
  sys.order[sys.orders++] = order;
  return k;
}

static void read_system(void) {
  static fmpq size;
  int n = 0;
  while (n <= MASSES && get(OPTIONAL, ".system.masses.%d.inertia", n)) n++;
  if (n == 0 || n > MASSES) stop(REJECTED, "a system has 1 to %d masses", MASSES);
  sys.n = n;
  sys.loads = get(OPTIONAL, ".system.frequency") != NULL;
  sys.side = 2 * n + (sys.loads ? 2 : 1); /* each order adds two */
  fmpq_mat_init(sys.mass, n, N_DATA);
  fmpq_mat_init(sys.force, n, 2 * n + 2 + 2 * ORDERS);
  for (int i = 0; i < n; i++) sys.shifted = sys.shifted || (has(i, "surface") && !has(i, "sliding"));
  for (int i = 0; i < n; i++) read_mass(i);
  read_links(0, "springs", "stiffness");
  read_links(n, "dampers", "constant");
  get(GROUP, ".system.loads");
  if (sys.loads) read_size(&sys.frequency, 1, "frequency");
  for (int l = 0; sys.loads && get(OPTIONAL, ".system.loads.%d.mass", l); l++) {
    int i = read_mass_number(get(STRING, ".system.loads.%d.mass", l), false), order = read_order(l);
    for (int k = 0; k < 2; k++) {
      fmpq *entry = fmpq_mat_entry(sys.force, i, 2 * n + 1 + 2 * order + k);
      read_size(&size, -1, "loads.%d.%s", l, k ? "sine" : "cosine");
      fmpq_sub(entry, entry, &size);
    }
  }
}

static void check_phase(const struct entry *o, int k) {
  const char *phase = o->word.phase[k], *mark = phase + sys.n;
  bool good = (int)strlen(phase) >= sys.n;
  for (int i = 0; good && i < sys.n; i++) {
    const char *letters = !sys.rubbed[i] ? "." : sys.shifted ? "s-" : "s-+";
    int side = phase[i] == 'a';
    good = rests(phase[i]) ? sys.stopped[side][i] && fmpq_is_zero(datum(i, RESTITUTION + side))
                           : strchr(letters, phase[i]) != NULL;
  }
  good = good && (!*mark || *mark == '<' || *mark == '>');
  int i = good && *mark ? read_mass_number(mark + 1, false) : -1;
  if (!good || (i >= 0 && (phase[i] == 's' || rests(phase[i]) || !sys.stopped[*mark == '>'][i])))
    stop(REJECTED, "orbit %d: %.60s is no phase of this system", o->number + 1, phase);
}

/* A length or an excess e_i: unknown in a ball, or a rational that is given. */
static void read_unknown(struct entry *o, int k, const char *text, const char *what) {
  if (strchr(text, ' ')) {
    read_ball(&o->x[k], text);
    return;
  }
  read_rational(&o->given[k], text);
  check_size(&o->given[k], -1, what);
  arb_set_fmpq(&o->x[k], &o->given[k], ENOUGH);
  o->word.known[k] = &o->given[k];
}

/* The word and the box of an entry; false when there is none. */
static bool read_orbit(struct entry *o) {
  struct word *w = &o->word;
  int n_given = 0;
  const char *phase, *turns = get(OPTIONAL, ".orbits.%d.turns", o->number);
  while (w->n <= PHASES && (phase = get(OPTIONAL, ".orbits.%d.word.%d", o->number, w->n))) {
    if (w->n == PHASES) stop(REJECTED, "orbit %d: a word has at most %d phases", o->number + 1, PHASES);
    w->phase[w->n] = phase;
    check_phase(o, w->n++);
  }
  if (w->n == 0) return false;
  if (!word_finish(w))
    stop(REJECTED, "orbit %d: the phases of its word differ by more or less than one event", o->number + 1);
  if ((turns != NULL) != sys.loads) stop(BAD_FILE, "turns are of loads");
  if (turns && (w->turns = read_whole(turns, 1, MAX_TURNS)) < 0)
    stop(REJECTED, "orbit %d: %.20s is no number of turns", o->number + 1, turns);
  if (w->n_free == 0) get(GROUP, ".orbits.%d.box.free", o->number);
  for (int l = 0; l < w->n_free; l++) read_ball(&o->x[l], get(STRING, ".orbits.%d.box.free.%d", o->number, l));
  for (int k = w->n_free; k < equations(w); k++) {
    read_unknown(o, k, get(STRING, ".orbits.%d.box.times.%d", o->number, k - w->n_free), "a time");
    n_given += w->known[k] != NULL;
    if (arf_cmpabs_ui(arb_midref(&o->x[k]), FAR) > 0 || mag_cmp_2exp_si(arb_radref(&o->x[k]), 0) > 0)
      stop(REJECTED, "orbit %d: a time is beyond what can be checked", o->number + 1);
  }
  for (int i = 0, k = equations(w); i < sys.n; i++, k++) {
    if (!sys.shifted)
      w->known[k] = datum(i, STATIC);
    else
      read_unknown(o, k, get(STRING, ".orbits.%d.box.excess.%d", o->number, i), "an excess");
    n_given += w->known[k] != NULL;
    if (sys.shifted && w->known[k] && !fmpq_is_zero(datum(i, STATIC)) && fmpq_cmp(datum(i, STATIC), w->known[k]) <= 0)
      stop(REJECTED, "mass %d: its static limit is out of its range: it is above its excess over sliding friction",
           i + 1);
  }
  if (n_given != sys.n) stop(BAD_FILE, "as many lengths and limits must be given as there are masses");
  return true;
}

/* An eigenvalue of a real matrix is real where the mirror image of its ball meets no ball but its own. */
static void make_real(acb_ptr z, slong n) {
  acb_t mirrored;
  acb_init(mirrored);
  for (slong k = 0; k < n; k++) {
    bool alone = true;
    acb_conj(mirrored, z + k);
    for (slong l = 0; l < n; l++) alone = alone && (acb_overlaps(mirrored, z + l) == (l == k));
    if (alone) arb_zero(acb_imagref(z + k));
  }
  acb_clear(mirrored);
}

/* Encloses the n eigenvalues of the return. */
static void find_multipliers(acb_ptr z, const struct entry *o, const struct motion *m) {
  slong n = o->word.n_free;
  acb_mat_t a, right;
  acb_ptr near = _acb_vec_init(n);
  acb_mat_init(a, n, n);
  acb_mat_init(right, n, n);
  acb_mat_set_arb_mat(a, return_matrix(m, &o->word));
  if (n > 0) acb_mat_approx_eig_qr(near, NULL, right, a, NULL, 0, prec);
  if (n > 0 && !acb_mat_eig_multiple(z, a, near, right, prec)) _acb_vec_indeterminate(z, n);
  make_real(z, n);
  _acb_vec_clear(near, n);
  acb_mat_clear(a);
  acb_mat_clear(right);
}

/* Each multiplier lies in a ball of its own; the answer: are they below 1 in modulus? */
static int check_multipliers(struct entry *o, const struct motion *m) {
  slong n = o->word.n_free;
  acb_ptr z = _acb_vec_init(n);
  bool taken[2 * MASSES + 1] = {false};
  int stable = YES;
  acb_t claim;
  acb_init(claim);
  find_multipliers(z, o, m);
  if (n == 0) get(GROUP, ".orbits.%d.enclosures.multipliers", o->number);
  for (slong k = 0; k < n; k++) {
    read_ball(acb_realref(claim), get(STRING, ".orbits.%d.enclosures.multipliers.%d.re", o->number, (int)k));
    read_ball(acb_imagref(claim), get(STRING, ".orbits.%d.enclosures.multipliers.%d.im", o->number, (int)k));
    int found = NO;
    for (slong l = 0; l < n && found != YES; l++) {
      if (taken[l] || !acb_overlaps(claim, z + l)) continue;
      found = acb_contains(claim, z + l) ? YES : OPEN;
      taken[l] = found == YES;
    }
    settle(o, "a multiplier", found);
    arb_ptr size = fresh();
    acb_abs(size, z + k, prec);
    stable = FLINT_MIN(stable, sign_of(sub(integer(1), size)));
  }
  acb_clear(claim);
  _acb_vec_clear(z, n);
  return stable;
}

/* Whether the function of an event has a sign to keep in a phase. */
static bool is_asked(const char *phase, int mass, enum event e) {
  if (rests(phase[mass]) || e == LIFTS) return rests(phase[mass]) && e == LIFTS;
  if (e >= BELOW) return sys.stopped[e == ABOVE][mass];
  return phase[mass] != '.' && (phase[mass] == 's') == (e < REACHES) && !(e == FASTER && sys.shifted);
}

/* A mass that goes on through the velocity of its surface at the end of a phase has a force beyond its limit. */
static int passes(const struct motion *m, const struct word *w, int k) {
  int i = w->mass[k];
  char next = w->phase[(k + 1) % w->n][i];
  if (w->event[k] != REACHES || next == 's') return YES;
  return sign_of(value(next == '-' ? SLOWER : FASTER, i, w->phase[k], m->end[k], rational(datum(i, STATIC))));
}

/* Does a mass keep the law along a phase?  The event that ends it is in any case the first zero of its function. */
static int keeps(struct entry *o, const struct motion *m, int k, int i) {
  const struct word *w = &o->word;
  int kept = w->mass[k] == i ? passes(m, w, k) : YES;
  for (enum event e = 0; e < N_EVENTS; e++) {
    int below = is_asked(w->phase[k], i, e) ? stays_below(m, w, o->x, k, i, e, 1) : YES;
    if (ends(w, k, i, e))
      settle(o, "that its events are the first ones", below == NO ? stays_below(m, w, o->x, k, i, e, -1) : below);
    kept = FLINT_MIN(kept, below);
  }
  return kept;
}

/* Is a static limit r above its least?  Above -(2 r - e) the force stays wherever the mass sticks. */
static int exceeds_least(const struct entry *o, const struct motion *m, int i, num r) {
  arb_struct x[NUMBERS];
  arb_ptr limit = x + equations(&o->word) + i;
  int above = YES;
  memcpy(x, o->x, sizeof x);
  *limit = *sub(scaled(r, 1), limit);
  for (int k = 0; k < o->word.n; k++)
    if (o->word.phase[k][i] == 's') above = FLINT_MIN(above, stays_below(m, &o->word, x, k, i, FASTER, 1));
  return above;
}

/* The least static limit of a mass is in the ball of the file; the answer: does it have more, where it is given, and
   sliding friction? */
static int check_least(struct entry *o, const struct motion *m, int i) {
  arb_ptr claim = fresh(), radius = fresh();
  read_ball(claim, get(STRING, ".orbits.%d.enclosures.static.%d", o->number, i));
  arf_set_mag(arb_midref(radius), arb_radref(claim));
  settle(o, "a least static limit", exceeds_least(o, m, i, add(middle(claim), radius)));
  settle(o, "a least static limit", -exceeds_least(o, m, i, sub(middle(claim), radius)));
  if (fmpq_is_zero(datum(i, STATIC))) return YES;
  num given = rational(datum(i, STATIC)), excess = o->x + equations(&o->word) + i;
  return FLINT_MIN(sign_of(sub(given, excess)), exceeds_least(o, m, i, given));
}

/* Coulomb's law, obstacles, the signs of lengths and limits: asked until all of it is settled at one precision. */
static void check_law(struct entry *o, const struct motion *m) {
  const struct word *w = &o->word;
  num t = o->x + w->n_free, limit = t + w->n;
  int admissible = YES;
  for (int i = 0; i < sys.n && sys.shifted; i++) settle(o, "that an excess is positive", sign_of(limit + i));
  for (int k = 0; k < w->n; k++) {
    settle(o, "the sign of a time", arb_contains_zero(t + k) ? OPEN : YES);
    admissible = arb_is_positive(t + k) ? admissible : NO;
  }
  for (int k = 0; k < w->n; k++) {
    const char *kept = get(STRING, ".orbits.%d.kept.%d", o->number, k);
    if ((int)strlen(kept) != sys.n || (int)strspn(kept, "yn") != sys.n)
      stop(BAD_FILE, "%.60s does not say of each mass whether it keeps the law", kept);
    for (int i = 0; i < sys.n && !o->open; i++) {
      static char name[80];
      snprintf(name, sizeof name, "whether mass %d keeps the law in phase %d", i + 1, k + 1);
      settle(o, name, (kept[i] == 'y' ? YES : NO) * keeps(o, m, k, i));
      admissible = kept[i] == 'y' ? admissible : NO;
    }
  }
  for (int i = 0; i < sys.n && sys.shifted && !o->open; i++) admissible = FLINT_MIN(admissible, check_least(o, m, i));
  if (!o->open) settle(o, "admissible", verdict(o, "admissible") * admissible);
  o->lawful = !o->open;
}

/* Everything about one orbit at one precision. */
static void recheck_at(struct entry *o, const struct motion *m) {
  const struct word *w = &o->word;
  num t = o->x + w->n_free, period = integer(0);
  if (!o->lawful) check_law(o, m);
  for (int i = 0; i < 2 * sys.n + sys.loads; i++) {
    const char *claim = get(STRING, ".orbits.%d.enclosures.start.%d", o->number, i);
    settle(o, "its start", within(claim, arb_mat_entry(m->start[0], i, 0)));
  }
  for (int i = 0; i < sys.n && sys.shifted; i++)
    settle(o, "an excess", within(get(STRING, ".orbits.%d.enclosures.excess.%d", o->number, i), t + w->n + i));
  for (int k = 0; k < w->n; k++) {
    settle(o, "a time", within(get(STRING, ".orbits.%d.enclosures.times.%d", o->number, k), t + k));
    period = add(period, t + k);
  }
  settle(o, "period", within(get(STRING, ".orbits.%d.enclosures.period", o->number), period));
  settle(o, "stable", verdict(o, "stable") * check_multipliers(o, m));
}

/* --- Everything --- */

/* Proves what is claimed of an orbit; the precision doubles while anything is undecided.  A number that does not lie in
   its ball by twice as many bits as that is narrow never will. */
static void recheck(struct entry *o) {
  slong most = FLINT_MAX(ENOUGH, FLINT_MIN(512 + 2 * narrowest, MAX_PREC));
  for (prec = 128; prec == 128 || (o->open && prec <= most); prec *= 2) {
    struct motion m;
    release(0);
    o->open = enclose(o->x, &o->boxed, &o->word) ? NULL : "that its box holds a single solution";
    if (o->open) continue;
    follow(&m, &o->word, o->x);
    recheck_at(o, &m);
  }
  if (o->open) stop(REJECTED, "orbit %d: %s cannot be confirmed", o->number + 1, o->open);
}

/* What the certificate claims: of how many orbits. */
static int read_certificate(void) {
  int n = 0;
  if (strcmp(get(STRING, ".format"), "stickslip orbits, version 2") != 0) stop(BAD_FILE, "this format is not known");
  get(STRING, ".scene");
  read_system();
  for (; n < MAX_ORBITS; n++) {
    orbits[n].number = n;
    if (!read_orbit(&orbits[n])) break;
  }
  if (n == 0) stop(REJECTED, "nothing is certified");
  return n;
}

/* GMP and FLINT abort where memory runs out. */
static void no_memory(int by) {
  static const char why[] = "stickslip-checker: GMP or FLINT gave up, as where memory runs out\n";
  (void)by;
  (void)!write(STDERR_FILENO, why, sizeof why - 1);
  _exit(NO_ANSWER);
}

int main(int argc, char **argv) {
  signal(SIGABRT, no_memory);
  if (argc != 2 || strcmp(argv[1], "--help") == 0)
    stop(USAGE, "usage: stickslip-checker CERTIFICATE, a file of stickslip orbit --certificate; "
                "status 0: verified, 1: rejected, 2: usage, 3: no certificate, 4: no answer");
  read_file(argv[1]);
  int n = read_certificate();
  for (int i = 0; i < n; i++) {
    recheck(&orbits[i]);
    for (int k = 0; k < i; k++)
      if (may_be_one(&orbits[i], &orbits[k])) stop(REJECTED, "orbits %d and %d may be one", k + 1, i + 1);
  }
  all_used();
  printf("verified: %d orbit%s; whether there are others is not checked\n", n, n == 1 ? "" : "s");
  end(VERIFIED);
}
