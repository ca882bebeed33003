/* What happens where a mass reaches the belt's velocity or breaks loose from it: proved from (1) and (2) by the signs
   on finitely many cells of states (law.h), each mass and each side for itself. */
#include "friction.h"
#include "num/num_exact.h"

/* Every statement of these proofs is about a mass, a side, and a cell in which a force or an acceleration has a
   sign. */
static struct law_answer answer_in(struct law_state *s, const struct friction *f, struct law_cell cell) {
  law_state_open_in(s, cell);
  struct law_answer a = law_answer(&f->law[cell.mass], s, cell.speed);
  if (a.n == 1) s->u[cell.mass] = a.u;
  return a;
}

/* The sign of x'' by the branch that applies in the cell; NO_SIGN where not just one does. */
static int acceleration_in(const struct friction *f, struct law_cell cell) {
  OWNED(law_state) s;
  struct law_answer a = answer_in(&s, f, cell);
  return a.n == 1 ? law_sign(&s, friction_acceleration(f, &s, cell.mass)) : NO_SIGN;
}

/* At the belt's velocity with |f| < u_r the sticking branch alone applies, and by (1) the mass keeps that velocity. */
static bool sticks_inside(const struct friction *f, int mass) {
  OWNED(law_state) s;
  struct law_cell cell = {mass, 0, PULL_INSIDE, 1};
  struct law_answer a = answer_in(&s, f, cell);
  return a.n == 1 && a.b == STICKS && acceleration_in(f, cell) == 0;
}

/* A slipping mass is driven towards the belt's velocity or away from it, as f is below u_s or beyond on its side. */
static bool slips_by_sliding_friction(const struct friction *f, int mass) {
  bool ok = true;
  for (int side = 1; side >= -1; side -= 2)
    ok = ok && acceleration_in(f, (struct law_cell){mass, side, PULL_OVER, side}) == -side &&
         acceleration_in(f, (struct law_cell){mass, side, PULL_SLIDING, side}) == 0 &&
         acceleration_in(f, (struct law_cell){mass, side, PULL_UNDER, side}) == side;
  return ok;
}

/* Beyond a limit the breaking branch alone applies, with the friction of the slip motion to which x'' leads. */
static bool breaks_beyond(const struct friction *f, int mass) {
  bool ok = true;
  for (int side = 1; side >= -1; side -= 2) {
    OWNED(law_state) s;
    struct law_cell cell = {mass, 0, PULL_BEYOND, side};
    struct law_answer a = answer_in(&s, f, cell);
    ok = ok && a.n == 1 && a.b == BREAKS && friction_apply(f, &s, mass, side) &&
         law_sign(&s, calc_sub(&s.c, a.u, s.u[mass])) == 0 && acceleration_in(f, cell) == -side;
  }
  return ok;
}

/* With f at the limit, what the slip motion makes of the mass, and the fall of its friction from f; other: how far the
   acceleration of the other mass changes with it. */
struct fall {
  int away, friction, by_e, other;
};
static struct fall fall_at(const struct friction *f, int mass, int side) {
  OWNED(law_state) s;
  struct fall fall = {NO_SIGN, NO_SIGN, NO_SIGN, NO_SIGN};
  law_state_open_in(&s, (struct law_cell){mass, 0, PULL_AT, side});
  struct calc *c = &s.c;
  if (friction_apply(f, &s, mass, 0)) {
    val held = s.u[mass], other[2];
    other[0] = friction_acceleration(f, &s, !mass);
    if (friction_apply(f, &s, mass, side)) {
      val drop = calc_sub(c, held, s.u[mass]), e = calc_sub(c, s.limit[mass], s.slide[mass]);
      other[1] = friction_acceleration(f, &s, !mass);
      fall.away = law_sign(&s, friction_acceleration(f, &s, mass));
      fall.friction = law_sign(&s, drop);
      fall.by_e = law_sign(&s, side > 0 ? calc_sub(c, drop, e) : calc_add(c, drop, e));
      if (other[0] && other[1]) fall.other = law_sign(&s, calc_sub(c, other[1], other[0]));
    }
  }
  return fall;
}

static bool falls_by_e(const struct friction *f, int mass) {
  bool ok = true;
  for (int side = 1; side >= -1; side -= 2) {
    struct fall fall = fall_at(f, mass, side);
    ok = ok && fall.friction == side && fall.by_e == 0 && fall.away == -side && fall.other == 0;
  }
  return ok;
}

/* Does the mass still stick, by (2), where the force has the size that the claim calls the limit? */
static bool sticks_at(const struct friction *f, int mass, bool sliding_limit) {
  OWNED(law_state) s;
  struct law_answer a = answer_in(&s, f, (struct law_cell){mass, 0, sliding_limit ? PULL_SLIDING : PULL_AT, 1});
  return a.n == 1 && a.b == STICKS;
}

/* What (2) says of each instant does not decide alone. */
#define STICKS_ON                                                                                                      \
  "That a mass that sticks does so until |f_i| reaches u_ri is the paper's rule for transitions, and is taken here: "  \
  "(1) and (2), held at each instant alone, would let it leave where f_i passes eps u_si, with x''_i = 0 there"

bool events_decided(const struct friction *f) {
  bool ok = true;
  for (int i = 0; i < 2; i++) ok = ok && sticks_inside(f, i) && slips_by_sliding_friction(f, i) && breaks_beyond(f, i);
  return ok;
}

static struct route_result proof_by_signs(struct behaviour *b, bool known, const char *note) {
  return behaviour_proof(b, known ? ROUTE_AGREES : ROUTE_UNDECIDED,
                         known ? note : "the signs of the accelerations are not known in every case");
}

struct route_result events_prove_stick(struct behaviour *b) {
  bool ok = true;
  for (int i = 0; i < 2; i++) ok = ok && sticks_inside(b->law, i) && slips_by_sliding_friction(b->law, i);
  return proof_by_signs(
      b, ok,
      "finite case analysis, exact for either mass: where x'_i = V and |f_i| < u_ri, no branch of (2) but the "
      "sticking one applies (f_1 = x_1 - chi x_2, f_2 = chi (x_2 - x_1)); its friction u_i = f_i makes x''_i = 0 in "
      "(1). A slip that began there would begin with the acceleration of a slipping mass, which is zero only for |f_i| "
      "= u_si: for any other force it is not that of (2), and the stick motion is the only continuation. " STICKS_ON);
}

struct route_result events_prove_slip(struct behaviour *b, bool sliding_limit) {
  bool ok = true, still = false;
  for (int i = 0; i < 2; i++) {
    ok = ok && sticks_inside(b->law, i) && breaks_beyond(b->law, i) && falls_by_e(b->law, i);
    still = still || sticks_at(b->law, i, sliding_limit);
  }
  if (still) return behaviour_proof(b, ROUTE_DIFFERS, "where the force has this size, (2) lets the mass stick: exact");
  return proof_by_signs(
      b, ok && !sliding_limit,
      "finite case analysis, exact for either mass and either direction: beyond the limit, eps f_i > u_ri, (2) has "
      "the breaking branch alone, with the friction of the slip motion with eps (V - x'_i) > 0, to which eps x''_i < 0 "
      "leads; at eps f_i = u_ri that slip motion begins with eps x''_i = -e_i (times eta for m_2). Where the force "
      "only touches the limit and turns back, the mass slips by this statement, and by (2) with >= in the place of >; "
      "(2) as printed leaves it open. " STICKS_ON);
}

/* Where x_1 and x_2 change by r and -r, does the force on m_1 change by (1 + chi) r, and that on m_2 by -2 chi r? */
static bool changes_by_these_factors(void) {
  OWNED(law_state) s;
  law_state_open(&s, num_ctx_exact());
  struct calc *c = &s.c;
  val r = law_free(&s), before[2] = {law_pull(&s, 0), law_pull(&s, 1)}, cr = calc_mul(c, s.chi, r);
  s.x[0] = calc_add(c, s.x[0], r);
  s.x[1] = calc_sub(c, s.x[1], r);
  val change[2] = {calc_sub(c, law_pull(&s, 0), before[0]), calc_sub(c, law_pull(&s, 1), before[1])};
  return law_sign(&s, calc_sub(c, change[0], calc_add(c, r, cr))) == 0 &&
         law_sign(&s, calc_add(c, change[1], calc_add(c, cr, cr))) == 0;
}

struct route_result events_prove_small(struct behaviour *b) {
  return proof_by_signs(
      b, sticks_inside(b->law, 0) && sticks_inside(b->law, 1) && changes_by_these_factors(),
      "for either mass: where x'_i = V and |f_i| < u_ri, the sticking branch of (2) alone applies, and by (1) "
      "x''_i = 0. On an admissible orbit |f_i| < u_ri where the phase begins and, up to t_a, throughout it. As f_1 = "
      "x_1 - chi x_2 and f_2 = chi (x_2 - x_1), changes of z_10 and z_20 by at most r change the force on m_1 by at "
      "most (1 + chi) r and that on m_2 by at most 2 chi r; so both masses stick wherever these are smaller than the "
      "least distances of the forces from their limits");
}

struct route_result events_prove_modes(struct behaviour *b) {
  return proof_by_signs(
      b, events_decided(b->law),
      "finite case analysis, exact for either mass: x'_i < V and x'_i > V slip, x'_i = V sticks for |f_i| < u_ri and "
      "breaks away into a slip motion for |f_i| > u_ri; three states of each mass, nine of both, are all there are. "
      "The phases do not accumulate: a mass that leaves the belt's velocity to one side has eps f_i >= u_ri, and only "
      "with eps f_i <= u_si can it come back from there (beyond, eps x''_i < 0), so that f_i changes by e_i > 0 in "
      "between, at a rate that is bounded in a bounded time, since the frictions are. " STICKS_ON);
}

/* With its slip friction for that sign of V - x', does the mass accelerate to that side? */
static bool driven(const struct friction *f, struct law_state *s, int mass, int slips, int sign) {
  return friction_apply(f, s, mass, slips) && law_sign(s, friction_acceleration(f, s, mass)) == sign;
}

/* Beyond a limit a mass passes the belt's velocity, from faster to slower for side 1, and its friction changes by
   2 u_s. */
static bool passes_by_two_slides(const struct friction *f, int mass) {
  bool ok = true;
  for (int side = 1; side >= -1; side -= 2) {
    OWNED(law_state) s;
    law_state_open_in(&s, (struct law_cell){mass, 0, PULL_BEYOND, side});
    ok = ok && driven(f, &s, mass, -side, -side);
    val before = s.u[mass];
    ok = ok && driven(f, &s, mass, side, -side);
    val jump = calc_sub(&s.c, s.u[mass], before), two = calc_mul(&s.c, calc_d(&s.c, 2 * side), s.slide[mass]);
    ok = ok && law_sign(&s, calc_sub(&s.c, jump, two)) == 0;
  }
  return ok;
}

/* Do friction and acceleration go on without a jump where a mass breaks loose? */
static bool goes_on(const struct friction *f, int mass) {
  bool smooth = false;
  for (int side = 1; side >= -1; side -= 2) {
    struct fall fall = fall_at(f, mass, side);
    smooth = smooth || fall.friction == 0 || fall.away == 0;
  }
  return smooth;
}

bool behaviour_jumps(struct behaviour *b) {
  const struct friction *f = b->law;
  bool all = events_decided(f), smooth = goes_on(f, 0) || goes_on(f, 1);
  for (int i = 0; i < 2; i++) all = all && falls_by_e(f, i) && passes_by_two_slides(f, i);
  if (smooth)
    behaviour_decide(b, ROUTE_DIFFERS,
                     "a mass that breaks loose has the same friction or acceleration before and after");
  else if (!all)
    behaviour_decide(b, ROUTE_UNDECIDED, "the jumps at the switches are not known in every case");
  else
    behaviour_decide(
        b, ROUTE_AGREES,
        "for either mass and either direction: where a mass breaks loose, eps f_i = u_ri, its friction falls "
        "from f_i to eps u_si, by e_i > 0, and x''_i from 0 to -eps e_i (times eta for m_2); x'' of the other mass "
        "does not jump. Where a mass is caught, |f_i| < u_ri, its friction jumps from eps u_si to f_i and x''_i to 0, "
        "unless f_i = eps u_si. Where a mass passes the belt's velocity without sticking, eps f_i > u_ri, its friction "
        "turns from -eps u_si to eps u_si, and x''_i, which keeps its sign, changes by 2 u_si (times eta for m_2). In "
        "each "
        "branch (1) and (2) bound x''_i by the positions, so that positions and velocities are continuous");
  return true;
}
