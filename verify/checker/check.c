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
   on each piece, B >= |f''|.  With F the masses that slip or are free and k >= 2 (1 where no mass sticks), b = x^(k)
   obeys M b'' + C b' + K b = P^(k) on F, so that the energy 2 E = b' M b' + b K b has d sqrt(2 E)/dt <= the sum of
   (l frequency)^k sqrt(sum |P_li|^2/m_i) over the orders l, and |c y^(k)| <= sqrt(c_x K^-1 c_x + c_v M^-1 c_v)
   sqrt(2 E), to which the loads in c are added; |f''| is |c y''| or |c A y'|, the smaller.  A zero that f has at an end
   of its phase by the equations is factored out by the sign of its first derivative that is not zero there.  The
   precision doubles while anything is undecided.

   The older format is of the paper's two masses, chi and eta, (1): they are a system in z = x - d, d the rest under
   both sliding forces: no sliding friction, limits e1 and e2 that may be unknown, m_2 = 1/eta, the word D (both stick),
   Gamma (m1 slips), H (both), C (m2).  Six equations, eight numbers, two of them given.

   That no orbit is left out is not claimed, and not checked.  Exit status: 0 verified, 1 rejected, 2 usage, 3 not a
   certificate, 4 no answer: memory ran out, or nobody took the answer. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "checker.h"

enum { MAX_ORBITS = 100, MAX_PREC = 1 << 20, ENOUGH = 4096, FAR = 1 << 20 };

/* An orbit's entry in the file, and what is settled about it. */
static struct entry {
  int number; /* from 0 */
  struct word word;
  arb_struct x[NUMBERS]; /* the file's box, then where in it the solution is */
  bool boxed;
  const char *open; /* what is undecided, */
  bool digits;      /* because a number is claimed to more digits */
} orbits[MAX_ORBITS];

static void settle(struct entry *o, const char *what, int answer) {
  if (answer == NO) stop(REJECTED, "orbit %d: %s is not as claimed", o->number + 1, what);
  if (answer == OPEN) o->open = what;
}

/* A truth of the file, by the names that lead to it; the last may be missing. */
static int claimed(const struct entry *o, const char *group, const char *name, const char *last) {
  return get(TRUTH, ".orbits.%d.%s.%s%s", o->number, group, name, last)[0] == 't' ? YES : NO;
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

static void check_reach(const struct entry *o, const char *what, num x) {
  if (arf_cmpabs_ui(arb_midref(x), FAR) > 0 || mag_cmp_2exp_si(arb_radref(x), 0) > 0)
    stop(REJECTED, "orbit %d: %s is beyond what can be checked", o->number + 1, what);
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

static void new_system(int n, bool loads) {
  sys.n = n;
  sys.loads = loads;
  sys.side = 2 * n + (loads ? 2 : 1); /* each order adds two */
  fmpq_mat_init(sys.mass, n, N_DATA);
  fmpq_mat_init(sys.force, n, 2 * n + 2 + 2 * ORDERS);
  fmpq_init(&sys.frequency); /* zero without loads */
}

/* A spring or damper between two masses, or one and the ground, -1; first: the column of the force for the first
   mass. */
static void add_link(int first, int a, int b, const fmpq *size) {
  for (int i = 0; i < 4; i++) {
    int row = i < 2 ? a : b, column = i % 2 ? a : b;
    if (row < 0 || column < 0) continue;
    fmpq *entry = fmpq_mat_entry(sys.force, row, first + column);
    (row == column ? fmpq_add : fmpq_sub)(entry, entry, size);
  }
}

/* --- The paper's two masses --- */
enum { Z10, Z20, TA, TB, TC, TD, E1, E2, N_X, N_NUMBERS = N_X + 5 };
enum { D, GAMMA, H, C, N_PHASES };
static const ulong MOST_ETA = (ulong)1 << 40;

static const char *const number_name[] = {"z10", "z20",    "t_a",   "t_b",    "t_c",      "t_d",     "e1",
                                          "e2",  "period", "trace", "margin", "u_r1_min", "u_r2_min"};
static const char *const friction_name[2] = {"u_r1", "u_r2"};
static const char *const phase_name[N_PHASES] = {"D", "Gamma", "H", "C"};
/* Of each mass in each phase: its force stays below its limit, or its velocity below the belt's. */
static const char *const condition_name[N_PHASES][2] = {
    {"t_a", "d_r"}, {"gamma_v1", "gamma_r"}, {"h_v1", "h_v2"}, {"c_w", "c_v2"}};
static fmpq chi, eta, V, given[N_X];
static fmpq friction[2]; /* u_r1, u_r2; 0: not given */
static struct word paper_word;

/* Whether the file is right about the condition of mass i in phase k: a proof where it holds, a place where it is
   broken. */
static int condition_right(const struct entry *o, const struct motion *m, int k, int i, int holds) {
  const char *phase = o->word.phase[k], *name = condition_name[k][i], *where = NULL;
  enum event e = phase[i] == 's' ? SLOWER : REACHES;
  num limit = o->x + E1 + i, length = o->x + TA + k;
  bool of_time = k == D && i == 0; /* that t_a is positive */
  if (holds == NO) where = get(STRING, ".orbits.%d.conditions.%s.broken_at", o->number, name);
  if (of_time) return where && strcmp(where, "start") != 0 ? NO : holds * sign_of(length);
  if (k == D && holds == YES) return -sign_of(value(e, i, phase, m->start[k], limit)); /* constant */
  if (holds == YES) return stays_below(m, &o->word, o->x, k, i, e);
  if (k != C && ends(&o->word, k, i, e)) return NO; /* the event would not be the first */
  mat y = strcmp(where, "end") == 0 ? m->end[k] : m->start[k];
  if (strcmp(where, "end") != 0 && strcmp(where, "start") != 0) {
    arb_ptr t = fresh();
    read_ball(t, where);
    if (!arb_is_exact(t) || arb_is_negative(t) || arb_gt(t, length)) return NO;
    if (!arb_le(t, length)) return OPEN;
    y = after(phase, y, t);
  }
  return sign_of(value(e, i, phase, y, limit));
}

/* The least z_1 - chi z_2 in C and D.  At u/omega before the end of C r = r_f cos u; the rate is a - chi r'. */
static num least_force(const struct motion *m, num x, num omega) {
  num shift = mul(rational(&chi), sub(x + Z20, x + Z10)), a = mul(sub(integer(1), rational(&chi)), rational(&V));
  num zero = integer(0), w = value(SLOWER, 0, "s-", m->end[C], zero);
  num ratio = div_by(a, mul(shift, omega)), u = arcsine(ratio), cosine = root(sub(integer(1), square(ratio)));
  num least = least_of(x + E1, least_of(w, value(SLOWER, 0, "s-", m->start[C], zero)));
  if (arb_lt(mul(shift, omega), a)) return least;
  for (int i = 0; i < 2; i++) {
    num s = div_by(u, omega), lower = least_of(least, add(sub(w, mul(a, s)), mul(shift, sub(integer(1), cosine))));
    if (!arb_gt(s, x + TD)) least = arb_le(s, x + TD) ? lower : hull(least, lower);
    u = sub(pi(), u);
    cosine = sub(zero, cosine);
  }
  return least;
}

/* Everything about one orbit of the paper's masses at one precision; the answer: is it admissible? */
static int recheck_paper(struct entry *o, const struct motion *m) {
  num x = o->x, own[N_NUMBERS], stiff = mul(rational(&chi), rational(&eta));
  arb_ptr trace = fresh();
  arb_mat_trace(trace, return_matrix(m, &o->word), prec);
  for (int k = 0; k < N_X; k++) own[k] = x + k;
  own[N_X] = add(add(x + TA, x + TB), add(x + TC, x + TD));
  own[N_X + 1] = trace;
  own[N_X + 2] = sub(modulus(trace), integer(1));
  own[N_X + 3] = scaled(sub(x + E1, least_force(m, x, root(stiff))), -1);
  /* r grows in Gamma, by e1 + a t - w >= 0 */
  own[N_X + 4] = scaled(value(FASTER, 1, "ss", m->start[D], sub(integer(0), x + E2)), -1);
  for (int k = 0; k < N_NUMBERS; k++)
    settle(o, number_name[k], within(get(STRING, ".orbits.%d.enclosures.%s", o->number, number_name[k]), own[k]));
  settle(o, "stable", claimed(o, "verdicts", "stable", "") * -sign_of(own[N_X + 2]));
  int all = YES;
  for (int k = 0; k < 2; k++) {
    if (fmpq_is_zero(&friction[k])) continue;
    int holds = claimed(o, "conditions", friction_name[k], ".holds");
    settle(o, friction_name[k], holds * sign_of(sub(rational(&friction[k]), own[N_X + 3 + k])));
    all = FLINT_MIN(all, holds);
  }
  o->digits = o->open != NULL;
  for (int k = TB; k < N_X; k++) settle(o, number_name[k], sign_of(x + k));
  /* First events.  D: w is affine.  Gamma and H: the conditions gamma_r and h_v1.  C: a sine with zeros pi/omega
     apart. */
  for (int k = 0; k < N_PHASES; k++) settle(o, phase_name[k], claimed(o, "first_events", phase_name[k], ""));
  num turns = sub(square(pi()), mul(stiff, square(x + TD)));
  bool at_zero = arb_contains_zero(value(REACHES, 1, "s-", m->start[C], NULL));
  settle(o, phase_name[C], at_zero ? OPEN : sign_of(turns));
  for (int k = 0; k < N_PHASES; k++)
    for (int i = 0; i < 2 && !o->open; i++) {
      int holds = claimed(o, "conditions", condition_name[k][i], ".holds");
      settle(o, condition_name[k][i], condition_right(o, m, k, i, holds));
      all = FLINT_MIN(all, holds);
    }
  return all;
}

static void read_friction(int i) {
  const fmpq *e = paper_word.known[E1 + i];
  const char *u = get(OPTIONAL, ".given.%s", friction_name[i]);
  if (!u) return;
  read_rational(&friction[i], u);
  if (fmpq_sgn(&friction[i]) <= 0 || (e && fmpq_cmp(&friction[i], e) <= 0))
    stop(REJECTED, "u_r%d is out of its range: it is positive, and above e%d", i + 1, i + 1);
}

/* What is given, as a system. */
static void read_given(void) {
  static const char *const model_name[3] = {"chi", "eta", "V"}, *const phase[N_PHASES] = {"ss", "-s", "--", "s-"};
  fmpq *const model[3] = {&chi, &eta, &V};
  int n_known = 0;
  for (int i = 0; i < 3; i++) {
    read_rational(model[i], get(STRING, ".given.%s", model_name[i]));
    if (fmpq_sgn(model[i]) <= 0 || (i < 2 && fmpq_cmp_ui(model[i], i == 0 ? 1 : MOST_ETA) >= 0))
      stop(REJECTED, "%s is out of its range", model_name[i]);
  }
  new_system(2, false);
  fmpq_one(fmpq_mat_entry(sys.mass, 0, INERTIA));
  fmpq_inv(fmpq_mat_entry(sys.mass, 1, INERTIA), &eta);
  for (int i = 0; i < 2; i++) fmpq_set(fmpq_mat_entry(sys.mass, i, SURFACE), &V);
  add_link(0, 0, 1, &chi);
  fmpq_one(fmpq_mat_entry(sys.force, 0, 0)); /* 1 - chi between m1 and the ground */
  paper_word.n = N_PHASES;
  memcpy(paper_word.phase, phase, sizeof phase);
  word_finish(&paper_word);
  for (int k = 0; k < N_X; k++) {
    const char *number = get(OPTIONAL, ".given.%s", number_name[k]);
    if (!number) continue;
    read_rational(&given[k], number);
    paper_word.known[k] = &given[k];
    n_known++;
  }
  for (int i = 0; i < 2; i++) read_friction(i);
  if (n_known != 2 || paper_word.known[Z10] || paper_word.known[Z20])
    stop(BAD_FILE, "two of e1, e2, t_a, t_b, t_c, t_d must be given");
}

/* The box of an entry; false when there is none. */
static bool read_paper_orbit(struct entry *o) {
  if (!get(OPTIONAL, ".orbits.%d.box.z10", o->number)) return false;
  o->word = paper_word;
  for (int k = 0; k < N_X; k++) {
    if (o->word.known[k])
      arb_set_fmpq(&o->x[k], &given[k], ENOUGH);
    else
      read_ball(&o->x[k], get(STRING, ".orbits.%d.box.%s", o->number, number_name[k]));
    if (k >= TA && k <= TD) check_reach(o, number_name[k], &o->x[k]);
  }
  return true;
}

/* --- Any system --- */

/* A number of a system: from about 2^-40 to 2^40 in size, or 0; positive for sign = 1, for 0 not negative. */
static __attribute__((format(printf, 3, 4))) void read_size(fmpq_t q, int sign, const char *fmt, ...) {
  char path[80];
  va_list args;
  va_start(args, fmt);
  vsnprintf(path, sizeof path, fmt, args);
  va_end(args);
  read_rational(q, get(STRING, ".system.%s", path));
  slong bits = (slong)fmpz_bits(fmpq_numref(q)) - (slong)fmpz_bits(fmpq_denref(q));
  if ((!fmpq_is_zero(q) && labs(bits) > 40) || fmpq_sgn(q) < sign) stop(REJECTED, "%s is out of its range", path);
}

/* The index of a mass from its number; -1 for the ground where that is allowed, which has the number 0. */
static int read_mass_number(const char *text, bool ground) {
  bool good = *text && strspn(text, "0123456789") == strlen(text) && strlen(text) <= 2 && (text[0] != '0' || !text[1]);
  int i = good ? atoi(text) : -1;
  if (i < (ground ? 0 : 1) || i > sys.n) stop(REJECTED, "there is no mass with the number %.20s", text);
  return i - 1;
}

static void read_mass(int i) {
  static const char *const side[2] = {"below", "above"};
  fmpq *of = fmpq_mat_entry(sys.mass, i, 0);
  get(OPTIONAL, ".system.masses.%d.name", i);
  read_size(of + INERTIA, 1, "masses.%d.inertia", i);
  sys.rubbed[i] = get(OPTIONAL, ".system.masses.%d.static", i) != NULL;
  if (sys.rubbed[i]) {
    read_size(of + STATIC, 1, "masses.%d.static", i);
    read_size(of + SLIDING, 0, "masses.%d.sliding", i);
    read_size(of + SURFACE, -1, "masses.%d.surface", i);
    if (fmpq_cmp(of + STATIC, of + SLIDING) < 0)
      stop(REJECTED, "mass %d: its static limit is below its sliding friction", i + 1);
  }
  for (int k = 0; k < 2; k++) {
    sys.stopped[k][i] = get(OPTIONAL, ".system.masses.%d.%s.position", i, side[k]) != NULL;
    if (!sys.stopped[k][i]) continue;
    read_size(of + POSITION + k, -1, "masses.%d.%s.position", i, side[k]);
    read_size(of + RESTITUTION + k, 0, "masses.%d.%s.restitution", i, side[k]);
    if (fmpq_is_zero(of + RESTITUTION + k) && sys.rubbed[i] && fmpq_is_zero(of + SURFACE))
      stop(REJECTED, "mass %d: at rest at its obstacle it would stick to its surface", i + 1);
    if (fmpq_cmp_ui(of + RESTITUTION + k, 1) > 0) stop(REJECTED, "mass %d: its restitution is above 1", i + 1);
  }
  if (sys.stopped[0][i] && sys.stopped[1][i] && fmpq_cmp(of + POSITION, of + POSITION + 1) >= 0)
    stop(REJECTED, "mass %d: there is no room between its obstacles", i + 1);
}

static void read_links(int first, const char *list, const char *name) {
  static fmpq size;
  get(GROUP, ".system.%s", list);
  for (int l = 0; get(OPTIONAL, ".system.%s.%d.%s", list, l, name); l++) {
    int a = read_mass_number(get(STRING, ".system.%s.%d.between.0", list, l), true);
    int b = read_mass_number(get(STRING, ".system.%s.%d.between.1", list, l), true);
    read_size(&size, 1, "%s.%d.%s", list, l, name);
    if (a == b) stop(REJECTED, "%s.%d ties something to itself", list, l);
    add_link(first, a, b, &size);
  }
}

/* The place of a load's order among all; a new one is added. */
static int read_order(int load) {
  const char *text = get(OPTIONAL, ".system.loads.%d.order", load);
  int order = text ? atoi(text) : 1, k = 0;
  if (text && (text[strspn(text, "0123456789")] || strlen(text) > 2 || order < 1 || order > ORDERS))
    stop(REJECTED, "%.20s is no order of a load", text);
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
  new_system(n, get(OPTIONAL, ".system.frequency") != NULL);
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
  for (int i = 0; good && i < sys.n; i++)
    good = rests(phase[i]) ? sys.stopped[phase[i] == 'a'][i] && fmpq_is_zero(datum(i, RESTITUTION + (phase[i] == 'a')))
                           : strchr(sys.rubbed[i] ? "s-+" : ".", phase[i]) != NULL;
  good = good && (!*mark || *mark == '<' || *mark == '>');
  int i = good && *mark ? read_mass_number(mark + 1, false) : -1;
  if (!good || (i >= 0 && (phase[i] == 's' || rests(phase[i]) || !sys.stopped[*mark == '>'][i])))
    stop(REJECTED, "orbit %d: %.60s is no phase of this system", o->number + 1, phase);
}

/* The word and the box of an entry; false when there is none. */
static bool read_orbit(struct entry *o) {
  struct word *w = &o->word;
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
  if (turns && (strlen(turns) > 6 || strspn(turns, "0123456789") < strlen(turns) || (w->turns = atol(turns)) == 0))
    stop(REJECTED, "orbit %d: %.20s is no number of turns", o->number + 1, turns);
  if (w->n_free == 0) get(GROUP, ".orbits.%d.box.free", o->number);
  for (int k = 0; k < equations(w); k++) {
    bool free = k < w->n_free;
    read_ball(&o->x[k],
              get(STRING, ".orbits.%d.box.%s.%d", o->number, free ? "free" : "times", free ? k : k - w->n_free));
    check_reach(o, free ? "its start" : "a time", &o->x[k]);
  }
  for (int i = 0; i < sys.n; i++) w->known[equations(w) + i] = datum(i, STATIC);
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

/* Each multiplier in a ball of its own, and below 1 in modulus: settles what is claimed. */
static void check_multipliers(struct entry *o, const struct motion *m) {
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
  settle(o, "stable", claimed(o, "verdicts", "stable", "") * stable);
  acb_clear(claim);
  _acb_vec_clear(z, n);
}

/* Whether the function of an event has a sign to keep in a phase. */
static bool is_asked(const char *phase, int mass, enum event e) {
  if (rests(phase[mass]) || e == LIFTS) return rests(phase[mass]) && e == LIFTS;
  if (e >= BELOW) return sys.stopped[e == ABOVE][mass];
  return phase[mass] != '.' && (phase[mass] == 's') == (e < REACHES);
}

/* A mass that goes on through the velocity of its surface at the end of a phase has a force beyond its limit. */
static int passes(const struct motion *m, const struct word *w, int k) {
  int i = w->mass[k];
  char next = w->phase[(k + 1) % w->n][i];
  if (w->event[k] != REACHES || next == 's') return YES;
  return sign_of(value(next == '-' ? SLOWER : FASTER, i, w->phase[k], m->end[k], rational(datum(i, STATIC))));
}

/* Everything about one orbit of a system at one precision; the answer: is it admissible? */
static int recheck_system(struct entry *o, const struct motion *m) {
  const struct word *w = &o->word;
  num x = o->x, period = integer(0);
  int holds = YES;
  for (int i = 0; i < 2 * sys.n + sys.loads; i++) {
    const char *claim = get(STRING, ".orbits.%d.enclosures.start.%d", o->number, i);
    settle(o, "its start", within(claim, arb_mat_entry(m->start[0], i, 0)));
  }
  for (int k = 0; k < w->n; k++) {
    num t = x + w->n_free + k;
    settle(o, "a time", within(get(STRING, ".orbits.%d.enclosures.times.%d", o->number, k), t));
    settle(o, "that its times are positive", sign_of(t));
    period = add(period, t);
  }
  settle(o, "period", within(get(STRING, ".orbits.%d.enclosures.period", o->number), period));
  check_multipliers(o, m);
  o->digits = o->open != NULL;
  for (int k = 0; k < w->n && !o->open; k++) {
    for (int i = 0; i < sys.n; i++)
      for (enum event e = 0; e < N_EVENTS; e++) {
        int answer = is_asked(w->phase[k], i, e) ? stays_below(m, w, x, k, i, e) : YES;
        if (ends(w, k, i, e)) settle(o, "that its events are the first ones", answer);
        holds = FLINT_MIN(holds, answer);
      }
    holds = FLINT_MIN(holds, passes(m, w, k));
  }
  return holds;
}

/* --- Everything --- */
static bool is_paper; /* of the two formats */

/* How many bits may be tried: a box of a system that is not proved with twice as many as it is narrow never will be. */
static slong most_bits(const struct entry *o) {
  slong narrow = 0;
  if (is_paper) return o->digits ? MAX_PREC : ENOUGH;
  if (o->boxed) return o->digits ? 2 * ENOUGH : ENOUGH;
  for (int k = 0; k < equations(&o->word); k++)
    narrow = FLINT_MAX(narrow, -fmpz_get_si(MAG_EXPREF(arb_radref(&o->x[k]))));
  return FLINT_MIN(ENOUGH, 512 + 2 * narrow);
}

/* Proves what is claimed of an orbit; the precision doubles while anything is undecided. */
static void recheck(struct entry *o) {
  for (prec = 128; prec == 128 || (o->open && prec <= most_bits(o)); prec *= 2) {
    struct motion m;
    release(0);
    o->open = enclose(o->x, &o->boxed, &o->word) ? NULL : "that its box holds a single solution";
    if (o->open) continue;
    follow(&m, &o->word, o->x);
    int admissible = (is_paper ? recheck_paper : recheck_system)(o, &m);
    /* while anything is open, not every condition has been looked at */
    if (!o->open) settle(o, "admissible", claimed(o, "verdicts", "admissible", "") * admissible);
  }
  if (o->open) stop(REJECTED, "orbit %d: %s cannot be confirmed", o->number + 1, o->open);
}

/* What the certificate claims: of how many orbits. */
static int read_certificate(void) {
  const char *format = get(STRING, ".format");
  int n = 0;
  is_paper = strcmp(format, "stickslip orbits of the word D-Gamma-H-C, version 1") == 0;
  if (!is_paper && strcmp(format, "stickslip orbits of a system, version 1") != 0)
    stop(BAD_FILE, "this format is not known");
  get(STRING, ".scene");
  (is_paper ? read_given : read_system)();
  for (; n < MAX_ORBITS; n++) {
    orbits[n].number = n;
    if (!(is_paper ? read_paper_orbit : read_orbit)(&orbits[n])) break;
  }
  if (n == 0) stop(REJECTED, "nothing is certified");
  return n;
}

int main(int argc, char **argv) {
  use_own_memory();
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
