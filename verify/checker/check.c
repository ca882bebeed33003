/* stickslip-checker: rechecks certificates of periodic stick-slip orbits, trusting nothing in them.

   It shares no source with the program that writes them.  Equations (1) of the paper, x_1'' + x_1 - chi x_2 = u_1 and
   x_2'' + chi eta (x_2 - x_1) = eta u_2, with Coulomb's law (2), u_i = u_si on a mass slower than the belt and x_i' = V
   while one sticks, become Z' = A Z for z = x - d, d the rest under both sliding forces: z_1'' = -(z_1 - chi z_2) while
   m1 slips, z_2'' = -chi eta (z_2 - z_1) while m2 slips, else 0.  A sticking mass breaks away at the force u_ri: z_1 -
   chi z_2 = e1 = u_r1 - u_s1, or chi (z_2 - z_1) = e2 = u_r2 - u_s2; a slipping one sticks when z_i' = V.  An orbit of
   the word D (both stick), Gamma (m1 slips), H (both), C (m2) has eight numbers, two of them known, and six equations.

   All motion is exp(A t), by Arb's matrix exponential.  Krawczyk's operator on the six equations proves one solution in
   the file's box and then narrows it.  The trace follows from their derivatives.  That a function f of the motion stays
   below zero is proved by halving the phase until f(0) + f'(0) s + B s^2/2 < 0 on each piece; B >= |f''| by what is
   conserved:

     Gamma  w = z_1 - chi z_2, w'' = -w:            w^2 + w'^2, and p = z_1' - V, r = z_2 - z_1: p'' = -w', r'' = w
     C      r'' = -chi eta r:                       r'^2 + chi eta r^2, and z_2''' = -chi eta r', w'' = chi^2 eta r
     H      E = eta v_1'^2 + v_2'^2 + eta ((v_1 - chi v_2)^2 + chi (1 - chi) v_2^2), the energy of the derivative v =
            z'; it is at least eta (v_1 - chi v_2)^2 and chi eta (v_2 - v_1)^2, and z_1''' = chi v_2 - v_1, z_2''' = chi
            eta (v_1 - v_2)

   A zero that f has at an end of its phase by the equations is factored out by the sign of f' there.  The precision
   doubles while anything is undecided.  That no orbit is left out is not claimed, and not checked.  Exit status: 0
   verified, 1 rejected, 2 usage, 3 not a certificate, 4 no answer: memory ran out, or nobody took the answer. */
#include <errno.h>
#include <flint/fmpq.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#if __FLINT_RELEASE >= 30000
#include <flint/arb_mat.h>
#else
#include <arb_mat.h>
#endif

enum { VERIFIED = 0, REJECTED = 1, USAGE = 2, BAD_FILE = 3, NO_ANSWER = 4 };

/* Ends with the status, unless what was printed has not reached its reader. */
static _Noreturn void end(int status) {
  if (fflush(stdout) != 0 || ferror(stdout)) {
    fputs("stickslip-checker: standard output cannot be written\n", stderr);
    status = NO_ANSWER;
  }
  exit(status);
}

static __attribute__((format(printf, 2, 3), noreturn)) void stop(int status, const char *fmt, ...) {
  char why[900];
  va_list args;
  va_start(args, fmt);
  vsnprintf(why, sizeof why, fmt, args);
  va_end(args);
  for (char *p = why; *p; p++)
    if (*p < ' ' || *p > '~') *p = '?';
  fprintf(status == REJECTED ? stdout : stderr, "%s: %s\n", status == REJECTED ? "rejected" : "stickslip-checker", why);
  end(status);
}

/* --- Memory: without it there is no answer --- */
static void *resized(void *p, size_t size) {
  p = realloc(p, size ? size : 1);
  if (!p) stop(NO_ANSWER, "memory ran out");
  return p;
}
static void *taken(size_t size) {
  return resized(NULL, size);
}
static void *zeros(size_t n, size_t size) {
  void *p = calloc(n ? n : 1, size ? size : 1);
  if (!p) stop(NO_ANSWER, "memory ran out");
  return p;
}
static void *gmp_resized(void *p, size_t old, size_t size) {
  (void)old;
  return resized(p, size);
}
static void gmp_given(void *p, size_t size) {
  (void)size;
  free(p);
}

/* --- JSON, as a list of texts with their paths: ".orbits.0.box.t_a" --- */
enum { MAX_DIGITS = 200000, MAX_FILE = 1 << 25, MAX_VALUES = 5000, MAX_PATH = 80 };

static struct value {
  char path[MAX_PATH];
  const char *text; /* in the file's buffer; true and false too */
  bool bare, used;  /* bare: true or false, without quotes */
} values[MAX_VALUES];
static int n_values;
static char *buffer, *at;

static char blanks(void) {
  while (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r') at++;
  return *at;
}

static void expect(char c) {
  if (blanks() != c) stop(BAD_FILE, "the file is not JSON, or holds what no certificate has: %c is missing", c);
  at++;
}

/* Ends in the buffer where its quote was.  Escaped characters are kept as they stand: only names of scenes have any. */
static const char *read_string(void) {
  expect('"');
  const char *start = at;
  while (*at && *at != '"') at += at[0] == '\\' && at[1] ? 2 : 1;
  if (!*at) stop(BAD_FILE, "the file is not JSON: a string does not end");
  *at++ = '\0';
  return start;
}

/* The path is so short that nothing nests deeply. */
static void read_value(char *path, size_t len) {
  char c = blanks();
  if (c != '{' && c != '[') {
    if (n_values == MAX_VALUES) stop(BAD_FILE, "the file has too many values");
    struct value *v = &values[n_values++];
    memcpy(v->path, path, len + 1);
    v->text = strncmp(at, "true", 4) == 0 ? "true" : strncmp(at, "false", 5) == 0 ? "false" : NULL;
    v->bare = v->text != NULL;
    at += v->bare ? strlen(v->text) : 0;
    if (!v->bare) v->text = read_string();
    for (int i = 0; i < n_values - 1; i++)
      if (strcmp(values[i].path, path) == 0) stop(BAD_FILE, "%s occurs twice", path);
    return;
  }
  at++;
  for (int n = 0; blanks() != (c == '{' ? '}' : ']'); n++) {
    char number[16];
    if (n > 0) expect(',');
    snprintf(number, sizeof number, "%d", n);
    const char *key = c == '{' ? read_string() : number;
    if (c == '{') expect(':');
    size_t more = strlen(key) + 1;
    if (len + more >= MAX_PATH || strchr(key, '.')) stop(BAD_FILE, "no certificate has the name %.80s there", key);
    snprintf(path + len, MAX_PATH - len, ".%s", key);
    read_value(path, len + more);
    path[len] = '\0';
  }
  at++;
}

static void read_file(const char *name) {
  struct stat st = {0};
  FILE *f = stat(name, &st) == 0 && S_ISREG(st.st_mode) ? fopen(name, "rb") : NULL;
  size_t size = st.st_size < MAX_FILE ? (size_t)st.st_size : MAX_FILE;
  if (!f && errno == ENOMEM) stop(NO_ANSWER, "memory ran out");
  if (!f) stop(BAD_FILE, "%.200s cannot be read", name);
  at = buffer = taken(size + 1);
  size = fread(buffer, 1, size, f);
  bool whole = fgetc(f) == EOF;
  fclose(f);
  if (!whole || memchr(buffer, '\0', size)) stop(BAD_FILE, "%.200s is not a certificate", name);
  buffer[size] = '\0';
  if (strncmp(buffer, "\xEF\xBB\xBF", 3) == 0) at += 3; /* a byte-order mark */
  read_value((char[MAX_PATH]){0}, 0);
  if (blanks()) stop(BAD_FILE, "something follows the end of the certificate");
}

/* The text at a path made like by printf; NULL when it is optional, which only strings are, and there is none. */
enum wanted { OPTIONAL, STRING, TRUTH };
static __attribute__((format(printf, 2, 3))) const char *get(enum wanted what, const char *fmt, ...) {
  char path[2 * MAX_PATH];
  va_list args;
  va_start(args, fmt);
  vsnprintf(path, sizeof path, fmt, args);
  va_end(args);
  for (int i = 0; i < n_values; i++)
    if (strcmp(values[i].path, path) == 0) {
      if (values[i].bare != (what == TRUTH)) stop(BAD_FILE, "%s has a value of the wrong type", path);
      values[i].used = true;
      return values[i].text;
    }
  if (what != OPTIONAL) stop(BAD_FILE, "%s is missing", path);
  return NULL;
}

/* --- Numbers --- */
static void read_rational(fmpq_t q, const char *s) {
  const char *n = s + (s[0] == '-'), *end = n + strspn(n, "0123456789");
  bool good = end > n && end - s <= MAX_DIGITS;
  if (good && end[0] == '/' && end[1] > '0') end += 1 + strspn(end + 1, "0123456789");
  if (!good || *end || fmpq_set_str(q, s, 10)) stop(BAD_FILE, "%.40s is not a rational number that can be read", s);
}

/* "mantissa exponent mantissa exponent" of midpoint and radius, in hexadecimal: Arb's text form. */
static void read_ball(arb_t x, const char *s) {
  static const size_t most[4] = {MAX_DIGITS, 6, 8, 6};
  fmpz_t part[4];
  const char *p = s;
  for (int i = 0; i < 4; i++) {
    size_t sign = p[0] == '-', len = sign + strspn(p + sign, "0123456789abcdef");
    bool good = len > sign && len - sign <= most[i] && p[len] == (i < 3 ? ' ' : '\0') && !(i == 2 && sign);
    char *copy = good ? memcpy(zeros(len + 1, 1), p, len) : NULL;
    fmpz_init(part[i]);
    if (!copy || fmpz_set_str(part[i], copy, 16)) stop(BAD_FILE, "%.40s is no ball, or out of range", s);
    free(copy);
    p += len + 1;
  }
  arf_set_fmpz_2exp(arb_midref(x), part[0], part[1]);
  mag_set_fmpz_2exp_fmpz(arb_radref(x), part[2], part[3]);
  for (int i = 0; i < 4; i++) fmpz_clear(part[i]);
}

/* Temporaries live in a pool until it is released to a mark. */
enum { CHUNK = 256, MAX_CHUNKS = 128 };
typedef const arb_struct *num;
static arb_ptr chunk[MAX_CHUNKS];
static slong used, prec;

static arb_ptr fresh(void) {
  if (used == (slong)CHUNK * MAX_CHUNKS) stop(REJECTED, "the proof takes more memory than it may");
  if (!chunk[used / CHUNK]) chunk[used / CHUNK] = _arb_vec_init(CHUNK);
  arb_ptr z = chunk[used / CHUNK] + used % CHUNK;
  used++;
  return z;
}

#define NUM(declared, computed)                                                                                        \
  static num declared {                                                                                                \
    arb_ptr z = fresh();                                                                                               \
    computed;                                                                                                          \
    return z;                                                                                                          \
  }
NUM(add(num x, num y), arb_add(z, x, y, prec))
NUM(sub(num x, num y), arb_sub(z, x, y, prec))
NUM(mul(num x, num y), arb_mul(z, x, y, prec))
NUM(div_by(num x, num y), arb_div(z, x, y, prec))
NUM(least_of(num x, num y), arb_min(z, x, y, prec))
NUM(hull(num x, num y), arb_union(z, x, y, prec))
NUM(root(num x), arb_sqrtpos(z, x, prec))
NUM(square(num x), arb_mul(z, x, x, prec))
NUM(sine(num x), arb_sin(z, x, prec))
NUM(arcsine(num x), arb_asin(z, x, prec))
NUM(pi(void), arb_const_pi(z, prec))
NUM(modulus(num x), arb_abs(z, x))
NUM(middle(num x), arb_get_mid_arb(z, x))
NUM(scaled(num x, slong shift), arb_mul_2exp_si(z, x, shift))
NUM(integer(slong n), arb_set_si(z, n))
NUM(rational(const fmpq_t q), arb_set_fmpq(z, q, prec))

/* --- The motion --- */
enum { Z10, Z20, E1, E2, TA, TB, TC, TD, N_X, N_FREE = 6 };
enum { D, GAMMA, H, C, N_PHASES };
enum { F_W, F_R, F_V1, F_V2 }; /* z_1 - chi z_2 - e1, chi (z_2 - z_1) - e2, z_1' - V, z_2' - V; each ends its phase */

static const char *const number_name[] = {"z10", "z20",    "e1",    "e2",     "t_a",      "t_b",     "t_c",
                                          "t_d", "period", "trace", "margin", "u_r1_min", "u_r2_min"};
static fmpq model[3], known[N_X], friction[2]; /* chi, eta, V; of the eight numbers and of u_r1, u_r2 what is given */
static bool is_known[N_X], is_rough[2];        /* is_rough: u_ri is given */
static num chi, eta, V, stiff, zero;           /* at the working precision; stiff = chi eta */

struct state {
  num z[4];
};

/* A Z. */
static struct state field(int ph, const struct state *s) {
  num w = sub(s->z[0], mul(chi, s->z[1])), pull = mul(stiff, sub(s->z[0], s->z[1]));
  return (struct state){
      {s->z[2], s->z[3], ph == GAMMA || ph == H ? sub(zero, w) : zero, ph == H || ph == C ? pull : zero}};
}

/* exp(A t) as exp(A mid) exp(A (t - mid)): the squarings inside the first see no radius. */
static void propagator(arb_mat_t e, int ph, num t) {
  arb_mat_t a, small;
  arb_mat_init(a, 4, 4);
  arb_mat_init(small, 4, 4);
  for (int k = 0; k < 4; k++) {
    struct state u = {{integer(k == 0), integer(k == 1), integer(k == 2), integer(k == 3)}}, v = field(ph, &u);
    for (int i = 0; i < 4; i++) arb_set(arb_mat_entry(a, i, k), v.z[i]);
  }
  arb_mat_scalar_mul_arb(e, a, middle(t), prec);
  arb_mat_exp(e, e, prec);
  arb_mat_scalar_mul_arb(small, a, sub(t, middle(t)), prec);
  arb_mat_exp(small, small, prec);
  arb_mat_mul(e, e, small, prec);
  arb_mat_clear(a);
  arb_mat_clear(small);
}

static struct state apply(const arb_mat_t e, const struct state *s) {
  struct state out;
  for (int i = 0; i < 4; i++) {
    out.z[i] = zero;
    for (int k = 0; k < 4; k++) out.z[i] = add(out.z[i], mul(arb_mat_entry(e, i, k), s->z[k]));
  }
  return out;
}

static struct state after(int ph, const struct state *s, num t) {
  arb_mat_t e;
  arb_mat_init(e, 4, 4);
  propagator(e, ph, t);
  struct state out = apply(e, s);
  arb_mat_clear(e);
  return out;
}

/* n Z for the function's gradient n, and the function. */
static num linear(int f, const struct state *s) {
  if (f == F_V1 || f == F_V2) return s->z[f == F_V1 ? 2 : 3];
  return f == F_W ? sub(s->z[0], mul(chi, s->z[1])) : mul(chi, sub(s->z[1], s->z[0]));
}

static num value(int f, const struct state *s, const num x[N_X]) {
  return sub(linear(f, s), f == F_W ? x[E1] : f == F_R ? x[E2] : V);
}

/* The word at the eight numbers x: states, six equations, and their derivatives. */
struct word {
  struct state z[N_PHASES + 1];
  num f[N_FREE], j[N_FREE][N_X];
};

static void word_make(struct word *w, const num x[N_X]) {
  struct state s[N_X]; /* how Z moves with each number */
  arb_mat_t e;
  arb_mat_init(e, 4, 4);
  for (int k = 0; k < N_X; k++) s[k] = (struct state){{integer(k == Z10), integer(k == Z20), zero, zero}};
  w->z[0] = (struct state){{x[Z10], x[Z20], V, V}};
  for (int ph = 0; ph < N_PHASES; ph++) {
    propagator(e, ph, x[TA + ph]);
    w->z[ph + 1] = apply(e, &w->z[ph]);
    for (int k = 0; k < N_X; k++) s[k] = apply(e, &s[k]);
    s[TA + ph] = field(ph, &w->z[ph + 1]);
    w->f[ph] = value(ph, &w->z[ph + 1], x);
    for (int k = 0; k < N_X; k++) w->j[ph][k] = linear(ph, &s[k]);
  }
  for (int i = 0; i < 2; i++) {
    w->j[i][E1 + i] = sub(w->j[i][E1 + i], integer(1));
    w->f[4 + i] = sub(w->z[N_PHASES].z[i], x[Z10 + i]);
    for (int k = 0; k < N_X; k++) w->j[4 + i][k] = sub(s[k].z[i], integer(k == Z10 + i));
  }
  arb_mat_clear(e);
}

/* --- One solution in a box --- */
/* An orbit's entry in the file, and what is settled about it. */
struct entry {
  arb_struct x[N_X]; /* the file's box, then where in it the solution is */
  bool boxed;
  const char *open; /* what is undecided, */
  bool digits;      /* because a number is claimed to more digits */
};

/* Krawczyk's operator on the box x: mid - Y f(mid) + (1 - Y J(x)) (x - mid), Y the rounded inverse of J(mid).  Every
   solution in the box lies in the image; an image inside the box proves that there is exactly one. */
static bool krawczyk(num image[N_X], const num x[N_X]) {
  struct word at_mid, all;
  num mid[N_X];
  int unknown[N_FREE], n = 0;
  arb_mat_t y;
  arb_mat_init(y, N_FREE, N_FREE);
  for (int k = 0; k < N_X; k++) {
    mid[k] = is_known[k] ? x[k] : middle(x[k]);
    image[k] = x[k];
    if (!is_known[k]) unknown[n++] = k;
  }
  word_make(&at_mid, mid);
  word_make(&all, x);
  for (int i = 0; i < N_FREE; i++)
    for (int k = 0; k < N_FREE; k++) arb_get_mid_arb(arb_mat_entry(y, i, k), at_mid.j[i][unknown[k]]);
  bool inside = arb_mat_inv(y, y, prec);
  for (int k = 0; k < N_FREE && arb_mat_is_finite(y); k++) {
    num sum = mid[unknown[k]], row[N_FREE];
    for (int i = 0; i < N_FREE; i++) {
      row[i] = middle(arb_mat_entry(y, k, i));
      sum = sub(sum, mul(row[i], at_mid.f[i]));
    }
    for (int l = 0; l < N_FREE; l++) {
      num rest = integer(k == l);
      for (int i = 0; i < N_FREE; i++) rest = sub(rest, mul(row[i], all.j[i][unknown[l]]));
      sum = add(sum, mul(rest, sub(x[unknown[l]], mid[unknown[l]])));
    }
    image[unknown[k]] = sum;
    inside = inside && arb_is_finite(sum) && arb_contains_interior(x[unknown[k]], sum);
  }
  arb_mat_clear(y);
  return inside;
}

/* Narrows o->x as far as the precision allows.  false when the box could not be proved. */
static bool enclose(struct entry *o) {
  bool halved = true;
  slong mark = used;
  for (int i = 0; i < 64 && halved; i++, used = mark) {
    num x[N_X], image[N_X];
    for (int k = 0; k < N_X; k++) x[k] = is_known[k] ? rational(&known[k]) : &o->x[k];
    if (!krawczyk(image, x) && !o->boxed) return false;
    o->boxed = true;
    halved = false;
    for (int k = 0; k < N_X; k++) {
      halved = halved || (!is_known[k] && mag_cmp(arb_radref(scaled(image[k], 1)), arb_radref(x[k])) < 0);
      if (is_known[k] || !arb_intersection(&o->x[k], x[k], image[k], prec)) arb_set(&o->x[k], x[k]);
    }
  }
  return true;
}

/* --- A function along a phase --- */
/* Answers: the statement is true, false, or cannot be told at this precision. */
enum { NO = -1, OPEN = 0, YES = 1, MAX_LEVEL = 80, MAX_PIECES = 400000 };

struct walk {
  int ph, f;
  bool zero_at_start;
  const num *x;
  num bound; /* of |f''| */
  long pieces;
};

/* The bound for what is asked: chi r and z_i' in Gamma and H, z_2' and w in C.  See above. */
static num bend_bound(int ph, int f, const struct state *s) {
  struct state v = field(ph, s);
  num slip = sub(v.z[0], mul(chi, v.z[1])), pace = sub(v.z[1], v.z[0]), r = sub(s->z[1], s->z[0]);
  num wave = ph == C ? root(add(square(pace), mul(stiff, square(r)))) : root(add(square(linear(F_W, s)), square(slip)));
  if (ph == C) return mul(f == F_W ? mul(chi, root(stiff)) : stiff, wave);
  if (ph == GAMMA) return f == F_R ? mul(chi, wave) : wave;
  num lost = mul(mul(chi, sub(integer(1), chi)), square(v.z[1]));
  num e = add(mul(eta, add(square(v.z[2]), add(square(slip), lost))), square(v.z[3]));
  return root(f == F_V1 ? div_by(e, eta) : mul(stiff, e));
}

static num rate(const struct walk *w, const struct state *s) {
  struct state v = field(w->ph, s);
  return linear(w->f, &v);
}

/* Is f < 0 on the piece of the given length that starts at s?  The first piece may start at its zero. */
static int below(struct walk *w, const struct state *s, num length, int level, bool first) {
  slong mark = used;
  num f = value(w->f, s, w->x), half = scaled(length, -1), chord = add(rate(w, s), mul(w->bound, half));
  bool at_zero = first && w->zero_at_start; /* f(t) <= f(0) + t chord: a parabola that bends up */
  bool negative = at_zero || (arb_is_negative(f) && arb_is_negative(add(f, mul(length, chord))));
  int answer = negative && (!at_zero || arb_is_negative(chord)) ? YES : !at_zero && arb_is_positive(f) ? NO : OPEN;
  if (answer == OPEN && level < MAX_LEVEL && ++w->pieces < MAX_PIECES) {
    struct state next = after(w->ph, s, half);
    answer = below(w, s, half, level + 1, first);
    if (answer == YES) answer = below(w, &next, half, level + 1, false);
  }
  used = mark;
  return answer;
}

/* Is f < 0 on the open phase?  Zeros at its ends that f has by the equations are said. */
static int stays_below(const struct word *o, const num x[N_X], int ph, int f, bool zero_start, bool zero_end) {
  struct walk w = {.ph = ph, .f = f, .zero_at_start = zero_start, .x = x, .bound = bend_bound(ph, f, &o->z[ph])};
  num end = x[TA + ph], slack = zero;
  arb_ptr length = fresh();
  if (zero_end) { /* f(T - u) <= -u (f'(T) - B u/2) < 0 for 0 < u < 2 f'(T)/B: half of that need not be walked */
    num d = rate(&w, &o->z[ph + 1]);
    if (!arb_is_positive(d)) return arb_is_negative(d) ? NO : OPEN;
    slack = div_by(d, w.bound);
  }
  arb_zero(length);
  arb_get_ubound_arf(arb_midref(length), sub(end, slack), prec);
  if (zero_end && !arb_lt(sub(end, length), scaled(slack, 1))) return OPEN;
  if (!arb_is_finite(length) || !arb_is_finite(w.bound)) return OPEN;
  return arb_is_positive(length) ? below(&w, &o->z[ph], length, 0, true) : YES;
}

/* The least z_1 - chi z_2 in C and D.  At u/omega before the end of C r = r_f cos u; the rate is a - chi r'. */
static num least_force(const struct word *o, const num x[N_X]) {
  num r = sub(x[Z20], x[Z10]), w = linear(F_W, &o->z[C + 1]), a = mul(sub(integer(1), chi), V);
  num peak = mul(mul(chi, root(stiff)), r), u = arcsine(div_by(a, peak));
  num least = least_of(least_of(x[E1], w), linear(F_W, &o->z[C]));
  if (arb_lt(peak, a)) return least;
  for (int i = 0; i < 2; i++, u = sub(pi(), u)) {
    num s = div_by(u, root(stiff)), rise = mul(mul(chi, r), square(sine(scaled(u, -1))));
    num lower = least_of(least, add(sub(w, mul(a, s)), scaled(rise, 1)));
    if (!arb_gt(s, x[TD])) least = arb_le(s, x[TD]) ? lower : hull(least, lower);
  }
  return least;
}

/* The trace of (z10, z20) -> (z_1, z_2) after the word, its times moving so that the events stay. */
static num trace_of(const struct word *o) {
  num trace = integer(2), dt[N_PHASES];
  for (int i = 0; i < 2; i++) {
    trace = add(trace, o->j[4 + i][Z10 + i]);
    for (int ph = 0; ph < N_PHASES; ph++) {
      num moved = o->j[ph][Z10 + i];
      for (int q = 0; q < ph; q++) moved = add(moved, mul(o->j[ph][TA + q], dt[q]));
      dt[ph] = sub(zero, div_by(moved, o->j[ph][TA + ph]));
      trace = add(trace, mul(o->j[4 + i][TA + ph], dt[ph]));
    }
  }
  return trace;
}

/* --- What the file claims --- */
enum { N_NUMBERS = N_X + 5, N_CONDITIONS = 8, MAX_ORBITS = 100, MAX_PREC = 1 << 20, ENOUGH = 4096, FAR = 1 << 20 };
static const ulong MOST_ETA = (ulong)1 << 40;

static const char *const phase_name[N_PHASES] = {"D", "Gamma", "H", "C"};
/* f < 0 on the open phase; the zeros that f has at its ends. */
static const struct {
  const char *name;
  int ph, f, zero_start, zero_end;
} condition[N_CONDITIONS] = {{"t_a", D, F_W, 0, 1},         {"d_r", D, F_R, 0, 0},   {"gamma_v1", GAMMA, F_V1, 1, 0},
                             {"gamma_r", GAMMA, F_R, 0, 1}, {"h_v1", H, F_V1, 0, 1}, {"h_v2", H, F_V2, 1, 0},
                             {"c_v2", C, F_V2, 0, 1},       {"c_w", C, F_W, 0, 0}};

static int claimed(int orbit, const char *group, const char *name) {
  return get(TRUTH, ".orbits.%d.%s.%s", orbit, group, name)[0] == 't' ? YES : NO;
}

static int sign_of(num x) {
  return arb_is_positive(x) ? YES : arb_is_nonpositive(x) ? NO : OPEN;
}

/* Whether the file is right about an inequality: a proof where it holds, a place where it is broken. */
static int condition_right(int *all, int orbit, int i, const struct word *o, const num x[N_X]) {
  char path[40];
  int ph = condition[i].ph, f = condition[i].f;
  snprintf(path, sizeof path, "conditions.%s", condition[i].name);
  int holds = claimed(orbit, path, "holds");
  if (holds == NO) *all = NO;
  const char *where = holds == YES ? "start" : get(i > 0 ? STRING : OPTIONAL, ".orbits.%d.%s.broken_at", orbit, path);
  if (i == 0) return holds * sign_of(x[TA]);
  struct state s = o->z[strcmp(where, "end") == 0 ? ph + 1 : ph];
  if (ph == D) return holds * sign_of(sub(zero, value(f, &s, x))); /* constant */
  if (holds == YES) return stays_below(o, x, ph, f, condition[i].zero_start, condition[i].zero_end);
  if (ph != C && condition[i].zero_end) return NO; /* the event would not be the first */
  if (strcmp(where, "end") != 0 && strcmp(where, "start") != 0) {
    arb_ptr t = fresh();
    read_ball(t, where);
    if (!arb_is_exact(t) || arb_is_negative(t) || arb_gt(t, x[TA + ph])) return NO;
    if (!arb_le(t, x[TA + ph])) return OPEN;
    s = after(ph, &s, t);
  }
  return sign_of(value(f, &s, x));
}

static void settle(struct entry *o, int orbit, const char *what, int answer) {
  if (answer == NO) stop(REJECTED, "orbit %d: %s is not as claimed", orbit + 1, what);
  if (answer == OPEN) o->open = what;
}

/* Everything about one orbit at one precision. */
static void recheck(struct entry *o, int i) {
  struct word w;
  num x[N_X], own[N_NUMBERS];
  used = 0;
  chi = rational(&model[0]);
  eta = rational(&model[1]);
  V = rational(&model[2]);
  stiff = mul(chi, eta);
  zero = integer(0);
  o->open = enclose(o) ? NULL : "that its box holds a single solution";
  if (o->open) return;
  for (int k = 0; k < N_X; k++) own[k] = x[k] = &o->x[k];
  word_make(&w, x);
  own[N_X] = add(add(x[TA], x[TB]), add(x[TC], x[TD]));
  own[N_X + 1] = trace_of(&w);
  own[N_X + 2] = sub(modulus(own[N_X + 1]), integer(1));
  own[N_X + 3] = scaled(sub(x[E1], least_force(&w, x)), -1);
  own[N_X + 4] = scaled(sub(zero, value(F_R, &w.z[D], x)), -1); /* in Gamma r grows, by e1 + a t - w >= 0 */
  for (int k = 0; k < N_NUMBERS; k++) {
    arb_ptr claim = fresh();
    read_ball(claim, get(STRING, ".orbits.%d.enclosures.%s", i, number_name[k]));
    settle(o, i, number_name[k], arb_contains(claim, own[k]) ? YES : arb_overlaps(claim, own[k]) ? OPEN : NO);
  }
  settle(o, i, "stable", claimed(i, "verdicts", "stable") * -sign_of(own[N_X + 2]));
  int all = YES;
  for (int k = 0; k < 2; k++) {
    if (!is_rough[k]) continue;
    int claim = claimed(i, k == 0 ? "conditions.u_r1" : "conditions.u_r2", "holds");
    settle(o, i, k == 0 ? "u_r1" : "u_r2", claim * sign_of(sub(rational(&friction[k]), own[N_X + 3 + k])));
    if (claim == NO) all = NO;
  }
  o->digits = o->open != NULL;
  for (int k = E1; k <= TD; k++) settle(o, i, number_name[k], k == TA ? YES : sign_of(x[k]));
  /* First events.  D: w is affine.  Gamma and H: the conditions gamma_r and h_v1.  C: a sine with zeros pi/omega
     apart. */
  for (int ph = 0; ph < N_PHASES; ph++) settle(o, i, phase_name[ph], claimed(i, "first_events", phase_name[ph]));
  num turns = sub(square(pi()), mul(stiff, square(x[TD])));
  settle(o, i, phase_name[C], arb_contains_zero(value(F_V2, &w.z[C], x)) ? OPEN : sign_of(turns));
  for (int k = 0; k < N_CONDITIONS && !o->open; k++)
    settle(o, i, condition[k].name, condition_right(&all, i, k, &w, x));
  if (!o->open && all != claimed(i, "verdicts", "admissible")) settle(o, i, "admissible", NO);
}

/* What is given, and the box of each entry. */
static int read_claims(struct entry *o) {
  static const char *const model_name[3] = {"chi", "eta", "V"};
  int n = 0, n_known = 0;
  if (strcmp(get(STRING, ".format"), "stickslip orbits of the word D-Gamma-H-C, version 1") != 0)
    stop(BAD_FILE, "this format is not known");
  for (int i = 0; i < 3; i++) {
    read_rational(&model[i], get(STRING, ".given.%s", model_name[i]));
    if (fmpq_sgn(&model[i]) <= 0 || (i < 2 && fmpq_cmp_ui(&model[i], i == 0 ? 1 : MOST_ETA) >= 0))
      stop(REJECTED, "%s is out of its range", model_name[i]);
  }
  get(STRING, ".scene");
  for (int k = 0; k < N_X; k++) {
    const char *number = get(OPTIONAL, ".given.%s", number_name[k]);
    is_known[k] = number != NULL;
    n_known += is_known[k];
    if (!number) continue;
    read_rational(&known[k], number);
    for (int i = 0; i < MAX_ORBITS; i++) arb_set_fmpq(&o[i].x[k], &known[k], ENOUGH);
  }
  for (int i = 0; i < 2; i++) {
    const char *u = get(OPTIONAL, ".given.u_r%d", i + 1);
    is_rough[i] = u != NULL;
    if (u) read_rational(&friction[i], u);
    if (u && (fmpq_sgn(&friction[i]) <= 0 || (is_known[E1 + i] && fmpq_cmp(&friction[i], &known[E1 + i]) <= 0)))
      stop(REJECTED, "u_r%d is out of its range: it is positive, and above e%d", i + 1, i + 1);
  }
  if (n_known != 2 || is_known[Z10] || is_known[Z20]) stop(BAD_FILE, "two of e1, e2, t_a, t_b, t_c, t_d must be given");
  for (; n < MAX_ORBITS && get(OPTIONAL, ".orbits.%d.box.z10", n); n++)
    for (int k = 0; k < N_X; k++) {
      if (!is_known[k]) read_ball(&o[n].x[k], get(STRING, ".orbits.%d.box.%s", n, number_name[k]));
      if (k >= TA && (arf_cmpabs_ui(arb_midref(&o[n].x[k]), FAR) > 0 || mag_cmp_2exp_si(arb_radref(&o[n].x[k]), 0) > 0))
        stop(REJECTED, "orbit %d: %s is beyond what can be checked", n + 1, number_name[k]);
    }
  return n;
}

int main(int argc, char **argv) {
  static struct entry orbit[MAX_ORBITS];
  mp_set_memory_functions(taken, gmp_resized, gmp_given);
  __flint_set_memory_functions(taken, zeros, resized, free);
  if (argc != 2) stop(USAGE, "usage: stickslip-checker CERTIFICATE");
  read_file(argv[1]);
  int n = read_claims(orbit);
  if (n == 0) stop(REJECTED, "nothing is certified");
  for (int i = 0; i < n; i++) {
    for (prec = 128; prec == 128 || (orbit[i].open && prec <= (orbit[i].digits ? MAX_PREC : ENOUGH)); prec *= 2)
      recheck(&orbit[i], i);
    if (orbit[i].open) stop(REJECTED, "orbit %d: %s cannot be confirmed", i + 1, orbit[i].open);
    for (int k = 0; k < i; k++)
      if (arb_overlaps(&orbit[i].x[TB], &orbit[k].x[TB]) && arb_overlaps(&orbit[i].x[TC], &orbit[k].x[TC]))
        stop(REJECTED, "orbits %d and %d may be one", k + 1, i + 1);
  }
  for (int i = 0; i < n_values; i++)
    if (!values[i].used) stop(BAD_FILE, "unknown name %s", values[i].path);
  printf("verified: %d orbit%s; whether there are others is not checked\n", n, n == 1 ? "" : "s");
  flint_cleanup();
  end(VERIFIED);
}
