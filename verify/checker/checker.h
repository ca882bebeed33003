/* What the files of the checker share: the file's values, balls, and the motion of a system. */
#ifndef STICKSLIP_CHECKER_H
#define STICKSLIP_CHECKER_H

#include <flint/fmpq.h>
#include <flint/fmpq_mat.h>
#include <stdbool.h>
#if __FLINT_RELEASE >= 30000
#include <flint/acb.h>
#include <flint/acb_mat.h>
#include <flint/arb.h>
#include <flint/arb_mat.h>
#else
#include <acb_mat.h>
#include <arb_mat.h>
#endif

/* --- file.c: how it ends, the values of the file --- */
enum { VERIFIED = 0, REJECTED = 1, USAGE = 2, BAD_FILE = 3, NO_ANSWER = 4 };
enum kind { OPTIONAL, STRING, TRUTH, GROUP };

/* Ends with the status, unless what was printed has not reached its reader. */
_Noreturn void end(int status);
__attribute__((format(printf, 2, 3), noreturn)) void stop(int status, const char *fmt, ...);
void read_file(const char *name);
/* The text at a path made like by printf.  NULL when there is none: of an optional string, and of a group, an object or
   a list, which is asked for only where it may be empty. */
__attribute__((format(printf, 2, 3))) const char *get(enum kind what, const char *fmt, ...);
void all_used(void); /* else the file is no certificate */
void read_rational(fmpq_t q, const char *s);
void read_ball(arb_t x, const char *s);
/* Of the balls read so far that are no points: minus the exponent of the radius, and no more than ENOUGH and the bits
   that are written. */
extern slong narrowest;
enum { ENOUGH = 4096 };

/* --- Matrices of balls, and balls: each lives in a pool until the pool is cut back to the size it had before --- */
typedef const arb_struct *num;
typedef arb_mat_struct *mat;
extern slong prec, pool_size;
mat matrix(slong rows, slong columns); /* zero */
arb_ptr fresh(void);
mat part(mat m, slong row, slong column, slong rows, slong columns);
void release(slong size);

#define MAT(declared, rows, columns, computed)                                                                         \
  __attribute__((unused)) static mat declared {                                                                        \
    mat z = matrix(rows, columns);                                                                                     \
    computed;                                                                                                          \
    return z;                                                                                                          \
  }
MAT(times(mat a, mat b), arb_mat_nrows(a), arb_mat_ncols(b), arb_mat_mul(z, a, b, prec))
MAT(minus(mat a, mat b), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_sub(z, a, b, prec))
MAT(by_ball(mat a, num t), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_scalar_mul_arb(z, a, t, prec))
MAT(transposed(mat a), arb_mat_ncols(a), arb_mat_nrows(a), arb_mat_transpose(z, a))
MAT(exponential(mat a), arb_mat_nrows(a), arb_mat_ncols(a), arb_mat_exp(z, a, prec))
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
NUM(root(num x), arb_sqrtpos(z, x, prec))
NUM(square(num x), arb_mul(z, x, x, prec))
NUM(pi(void), arb_const_pi(z, prec))
NUM(modulus(num x), arb_abs(z, x))
NUM(scaled(num x, slong shift), arb_mul_2exp_si(z, x, shift))
NUM(integer(slong n), arb_set_si(z, n))
NUM(rational(const fmpq_t q), arb_set_fmpq(z, q, prec))
NUM(middle(num x), arb_get_mid_arb(z, x))
/* A row times the first column of y. */
NUM(product(mat row, mat y),
    arb_dot(z, NULL, 0, row->entries, 1, y->entries, arb_mat_ncols(y), arb_mat_ncols(row), prec))

/* --- motion.c --- */
enum { MASSES = 24, PHASES = 48, ORDERS = 64, NUMBERS = 3 * MASSES + 1 + PHASES };
/* Answers: the statement is false, cannot be told at this precision, or is true; the least is that of both. */
enum { NO = -1, OPEN = 0, YES = 1 };
/* What ends a phase at a mass i, and the function that is negative before: f_i - r_i and -f_i - r_i while it sticks,
   x_i' - V_i or V_i - x_i' while it slips, X - x_i, x_i - X; u_i - f_i or f_i - u_i while it rests at the obstacle
   below (b) or above (a), u_i the friction of a mass at rest. */
enum event { SLOWER, FASTER, REACHES, LIFTS, BELOW, ABOVE, N_EVENTS };
/* What is known of a mass; POSITION and RESTITUTION of the obstacle below it, and one further on of that above. */
enum { INERTIA, SLIDING, STATIC, SURFACE, POSITION, RESTITUTION = POSITION + 2, N_DATA = RESTITUTION + 2 };

/* The system; a word has the limits r_i among its numbers. */
extern struct system {
  int n, side; /* side: of y = (x_1 ... x_n, x_1' ... x_n', with loads theta, cos k theta, sin k theta by order, 1) */
  bool loads, rubbed[MASSES], stopped[2][MASSES]; /* stopped: below, above */
  bool shifted;           /* positions are counted from the rest under sliding friction, which is not known */
  fmpq_mat_t mass, force; /* n by N_DATA; f = force y */
  int orders, order[ORDERS];
  fmpq frequency; /* theta' */
} sys;
const fmpq *datum(int mass, int which);

/* A word, and its numbers: the coordinates that are free at its start, the lengths of the phases, the limits. */
struct word {
  int n, n_free, place[2 * MASSES + 1]; /* place: in y, of each free coordinate */
  const char *phase[PHASES];            /* a letter for each mass; > or < and the mass that has rebounded */
  int mass[PHASES];                     /* whose event ends it */
  enum event event[PHASES];
  slong turns;
  const fmpq *known[NUMBERS]; /* NULL: unknown */
};
/* How many equations: n + n_free; then the number of the first limit. */
int equations(const struct word *w);
/* Fills in what follows from n and the phases; false when they do not follow each other by one event. */
bool word_finish(struct word *w);

/* The word at its numbers: y at the start and the end of each phase, what is zero by the equations.  Behind the first
   column stand the derivatives by the numbers. */
struct motion {
  mat start[PHASES], end[PHASES], zero;
};
void follow(struct motion *o, const struct word *w, arb_srcptr x);
bool rests(char letter);
/* The function of an event, see above, in a phase; r is its limit. */
num value(enum event e, int mass, const char *phase, mat y, num r);
/* Krawczyk's operator proves one solution in the box x and then narrows it as far as the precision allows.  false when
   the box could not be proved, and was not before. */
bool enclose(arb_ptr x, bool *proved, const struct word *w);
/* The derivative of the first return of the free coordinates. */
mat return_matrix(const struct motion *o, const struct word *w);
/* Whether the event ends the phase k. */
bool ends(const struct word *w, int k, int mass, enum event e);
/* Is the function of the event, times the sign, negative on the open phase k?  One of negative length is the stretch
   from its end to its start. */
int stays_below(const struct motion *o, const struct word *w, arb_srcptr x, int k, int mass, enum event e, int sign);

#endif
