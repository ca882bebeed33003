/* What the files of the checker share: the file's values, balls, and the motion of a system. */
#ifndef STICKSLIP_CHECKER_H
#define STICKSLIP_CHECKER_H

#include <flint/fmpq_mat.h>
#include <stdbool.h>
#if __FLINT_RELEASE >= 30000
#include <flint/acb_mat.h>
#include <flint/arb_mat.h>
#else
#include <acb_mat.h>
#include <arb_mat.h>
#endif

/* --- file.c: how it ends, memory, the values of the file --- */
enum { VERIFIED = 0, REJECTED = 1, USAGE = 2, BAD_FILE = 3, NO_ANSWER = 4 };
enum wanted { OPTIONAL, STRING, TRUTH };

/* Ends with the status, unless what was printed has not reached its reader. */
_Noreturn void end(int status);
__attribute__((format(printf, 2, 3), noreturn)) void stop(int status, const char *fmt, ...);
void *taken(size_t size);
void *zeros(size_t n, size_t size);
void use_own_memory(void);
void read_file(const char *name);
/* The text at a path made like by printf; NULL when it is optional, which only strings are, and there is none. */
__attribute__((format(printf, 2, 3))) const char *get(enum wanted what, const char *fmt, ...);
void all_used(void); /* else the file is no certificate */
void read_rational(fmpq_t q, const char *s);
void read_ball(arb_t x, const char *s);

/* --- Balls and matrices of them: temporaries live in a pool until it is released to a mark --- */
typedef const arb_struct *num;
typedef arb_mat_struct *mat;
struct mark {
  slong nums, mats;
};
extern slong prec;
arb_ptr fresh(void);
mat matrix(slong rows, slong columns); /* zero */
mat part(mat m, slong row, slong column, slong rows, slong columns);
struct mark here(void);
void release(struct mark to);

#define MAT(declared, rows, columns, computed)                                                                         \
  __attribute__((unused)) static mat declared {                                                                        \
    mat z = matrix(rows, columns);                                                                                     \
    computed;                                                                                                          \
    return z;                                                                                                          \
  }
MAT(times(mat a, mat b), arb_mat_nrows(a), arb_mat_ncols(b), arb_mat_mul(z, a, b, prec))
MAT(minus(mat a, mat b), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_sub(z, a, b, prec))
MAT(by_ball(mat a, num t), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_scalar_mul_arb(z, a, t, prec))
MAT(exponential(mat a), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_exp(z, a, prec))
MAT(middles(mat a), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_get_mid(z, a))
#define NUM(declared, computed)                                                                                        \
  __attribute__((unused)) static num declared {                                                                        \
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
NUM(scaled(num x, slong shift), arb_mul_2exp_si(z, x, shift))
NUM(integer(slong n), arb_set_si(z, n))
NUM(rational(const fmpq_t q), arb_set_fmpq(z, q, prec))
NUM(middle(num x), arb_get_mid_arb(z, x))
NUM(product(mat row, mat y), arb_dot(z, NULL, 0, row->entries, 1, y->entries, 1, arb_mat_ncols(row), prec))

/* --- motion.c --- */
enum { MASSES = 24, PHASES = 48, NUMBERS = 3 * MASSES + 1 + PHASES };
/* Answers: the statement is true, false, or cannot be told at this precision. */
enum { NO = -1, OPEN = 0, YES = 1 };
/* What ends a phase at a mass i, and the function that is negative before: f_i - r_i and -f_i - r_i while it sticks,
   x_i' - V_i or V_i - x_i' while it slips, X - x_i, x_i - X. */
enum event { SLOWER, FASTER, REACHES, BELOW, ABOVE };

/* The system; a word has the limits r_i among its numbers. */
extern struct system {
  int n, side; /* side: of y = (x_1 ... x_n, x_1' ... x_n', with loads cos theta, sin theta, 1) */
  fmpq_mat_t stiffness, damping, load;     /* K and C; n by 2, of cos theta and sin theta */
  bool rubbed[MASSES], stopped[2][MASSES]; /* stopped: below, above */
  fmpq inertia[MASSES], sliding[MASSES], limit[MASSES], surface[MASSES];
  fmpq position[2][MASSES], restitution[2][MASSES], frequency;
} sys;

/* A word, and its numbers: the coordinates that are free at its start, the lengths of the phases, the limits. */
struct word {
  int n, n_free, place[2 * MASSES + 1]; /* place: in y, of each free coordinate; that of cos theta for theta */
  const char *phase[PHASES];            /* a letter for each mass; > or < and the mass that has rebounded */
  int mass[PHASES];                     /* whose event ends it */
  enum event event[PHASES];
  slong turns;
  bool known[NUMBERS];
  fmpq number[NUMBERS]; /* those that are known */
};
/* How many equations: n + n_free; then the number of the first limit. */
int equations(const struct word *w);
/* Fills in what follows from n and the phases; false when they do not follow each other by one event. */
bool word_finish(struct word *w);

/* The word at its numbers: y at the start and the end of each phase, the equations, their derivatives. */
struct motion {
  mat start[PHASES], end[PHASES], f, j;
  long work; /* done along its phases */
};
void follow(struct motion *o, const struct word *w, arb_srcptr x);
/* y after the time t in a phase. */
mat after(const char *phase, mat y, num t);
/* The function of an event, see above, in a phase; r is its limit. */
num value(enum event e, int mass, const char *phase, mat y, num r);
/* Krawczyk's operator proves one solution in the box x and then narrows it as far as the precision allows.  false when
   the box could not be proved, and was not before. */
bool enclose(arb_ptr x, bool *proved, const struct word *w);
/* The derivative of the first return of the free coordinates. */
mat return_matrix(const struct motion *o, const struct word *w);

/* Is the function negative on the open phase k?  zeros: how many of f, f' are zero at the start by the equations;
   zero_end: whether f is at the end. */
struct along {
  int k, mass, zeros;
  enum event event;
  bool zero_end;
};
int stays_below(const struct along *a, struct motion *o, const struct word *w, arb_srcptr x);

#endif
