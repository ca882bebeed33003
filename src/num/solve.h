/* Square systems of equations: Newton's iteration finds a solution, Krawczyk's operator proves it.

   The system f(x) = 0 has n equations in n unknowns and is a function of its caller.  Elements are those of one number
   type (num.h); Newton's iteration takes any, Krawczyk's operator takes balls.  Statuses are flags (status.h): what the
   system itself returns is passed on; besides, SS_DOMAIN means that a derivative in double or mpfr is exactly singular,
   and SS_UNABLE that nothing was found or proved, which never shows that there is no solution.

   What is proved.  With X a box, mid a point in it, Y any matrix (here the inverse of the derivative near mid, rounded)
   and J an enclosure of the derivative over X, every zero of f in X lies in the image
       K(X) = mid - Y f(mid) + (I - Y J) (X - mid).
   When K(X) lies in the interior of X, X holds exactly one zero, J is regular on all of X, and the zero lies in K(X).
   When the system has parameters that are balls, f(mid) and J enclose their values for all of these, and what is proved
   holds for each point of the parameters.  A double zero is never proved: J is singular there. */
#ifndef STICKSLIP_NUM_SOLVE_H
#define STICKSLIP_NUM_SOLVE_H

#include "flint_more.h"
#include "num.h"

enum { SOLVE_MOST = 96 }; /* unknowns */

/* Sets f (n pointers) to the values at x and j (n by n, row by row) to the derivatives: elements that live until the
   next call.  x are n elements: points or, for Krawczyk's operator, the box, in which case f is NULL and j must enclose
   the derivative over all of it.  At a point j need not enclose anything: it serves as a direction. */
struct solve_system {
  slong n;
  int (*values)(const void **f, const void **j, const struct num_vec *x, void *self);
  void *self;
};

/* --- Newton's iteration. --- */

/* What the caller makes of a step, which is about to be subtracted from x (n elements each): how large may be measured
   in the units that the unknowns have. */
enum newton_next {
  NEWTON_ON,   /* another one after it */
  NEWTON_LAST, /* x is good enough after it */
  NEWTON_STAY, /* x is as good as it gets without it */
  NEWTON_LOST  /* it leads nowhere: SS_UNABLE */
};
typedef enum newton_next newton_judge(const struct num_vec *x, const struct num_vec *step, void *self);

/* x = the last iterate, from x, the values, derivatives and steps being of ctx; x has its type but may have a precision
   of its own (mpfr), to which it is rounded.  For balls each iterate is an exact point.  SS_UNABLE when `most` steps do
   not settle. judge receives the system's self.  Each step takes one call of the system and n^3/3 multiplications. */
int newton_run(struct num_vec *x, const struct solve_system *s, struct num_ctx ctx, int most, newton_judge *judge);

/* Whether |step| <= 2^-bits |scale|, exactly for double, mpfr and exact balls. */
bool newton_is_small(const struct num_type *type, const void *step, slong bits, const void *scale);

/* newton_run in balls until a step is so short that rounding hides the next one, or the steps stop shrinking, which
   beside a double solution they soon do.  SS_UNABLE where they stop before 1/1024 of the largest unknown. */
int newton_settle(struct num_vec *x, const struct solve_system *s, int most);

/* Newton's iteration doubles the correct bits, so that only the last levels of precision cost: level is called from 192
   bits (or prec, if that is less) up to prec, each time with a little less than twice the bits, until one fails.  A
   level that ends when a step is below 2^-(bits/2 + 4) leaves its successor one or two steps. */
int newton_rising(int (*level)(slong bits, void *self), void *self, slong prec);

/* --- Krawczyk's operator; balls only. --- */

struct krawczyk {
  const struct solve_system *system;
  struct num_vec mid, box, image; /* mid is an exact point */
  arb_mat_t y, step;              /* Y, and Y f(mid) */
  arb_mat_t rest, off;            /* I - Y J, and box - mid */
  bool inside;                    /* the image lies in the interior of the box, and mid in the box: proved */
  bool too_wide; /* |I - Y J| (X - mid) alone is no narrower than X, nor with all radii of X larger by one factor */
};
/* The system must outlive it. */
void krawczyk_init(struct krawczyk *k, const struct solve_system *s, slong prec);
void krawczyk_clear(struct krawczyk *k);
/* mid = the midpoints of x, and Y and Newton's step there.  One call of the system, n^3 multiplications. */
int krawczyk_centre(struct krawczyk *k, const struct num_vec *x);
/* image = K(box), and whether it is inside.  One call of the system, n^3 multiplications. */
int krawczyk_apply(struct krawczyk *k);
/* Finds a box that is proved; SS_UNABLE when none is after a dozen.  Every box holds mid and more than rounding can do
   to it. grow, for parameters that are points, at Newton's last iterate: boxes around mid, the first eight times as
   wide as Newton's step is long, each eight times as wide as the one before.  follow, for parameters that are balls,
   which make Newton's step wide: each box is the image of the one before, its radii longer by 2^wider of themselves,
   with mid. */
int krawczyk_grow(struct krawczyk *k);
int krawczyk_follow(struct krawczyk *k, slong wider);
/* The operator at x, boxes grown around it: x becomes the image, and box, unless it is NULL, the one that is proved. */
int krawczyk_enclose(struct num_vec *x, struct num_vec *box, const struct solve_system *s);
/* Whether two solutions of n unknowns, enclosed in x and y and the only ones in their boxes, are one. */
bool krawczyk_same(const arb_t *x, const arb_t *x_box, const arb_t *y, const arb_t *y_box, int n);

#endif
