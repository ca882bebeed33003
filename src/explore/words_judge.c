/* The conditions along the phases of a word's orbit, decided in balls.

   Each is a function that must be negative inside its phase; at an end it may be zero by definition (a mass has just
   broken loose, or the phase ends because it is zero), and then its rate there decides.  The phase is halved until
   every piece is settled: by its values, or beside such an end by the sign of the rate. */
#include "words_impl.h"

enum { MOST_DEPTH = 40, MOST_PIECES = 4000 };

struct span_of_phase {
  struct calc *c;
  const struct harmonic *f;
  val length;
  bool zero_at_start, zero_at_end;
  long pieces;
};

/* The time at k/2^depth of the phase, or with wide the stretch from there on to the next. */
static val moment(struct span_of_phase *s, ulong k, int depth, bool wide) {
  arb_ptr x = calc_new(s->c);
  if (wide) {
    arb_set_ui(x, 2 * k + 1);
    mag_set_ui(arb_radref(x), 1);
    depth++;
  } else {
    arb_set_ui(x, k);
  }
  arb_mul_2exp_si(x, x, -depth);
  return calc_mul(s->c, s->length, x);
}

static truth negative_piece(struct span_of_phase *s, ulong k, int depth) {
  struct calc *c = s->c;
  slong mark = calc_mark(c);
  struct angle angle[2];
  val box = moment(s, k, depth, true), mid = moment(s, 2 * k + 1, depth + 1, false);
  bool first = k == 0 && s->zero_at_start, last = k + 1 == 1UL << depth && s->zero_at_end;
  s->pieces++;
  harmonic_angles(angle, c, s->f, box);
  val rate = harmonic_rate(c, s->f, angle);
  harmonic_angles(angle, c, s->f, mid);
  val value = harmonic_value(c, s->f, angle, mid);
  val whole = calc_add(c, value, calc_mul(c, rate, calc_sub(c, box, mid)));
  bool settled =
      arb_is_negative(whole) || (first && !last && arb_is_negative(rate)) || (last && !first && arb_is_positive(rate));
  bool broken = arb_is_positive(value);
  calc_release(c, mark);
  if (settled) return TRUTH_TRUE;
  if (broken) return TRUTH_FALSE;
  if (depth == MOST_DEPTH || s->pieces > MOST_PIECES || c->status) return TRUTH_UNKNOWN;
  truth left = negative_piece(s, 2 * k, depth + 1);
  return left == TRUTH_FALSE ? left : truth_and(left, negative_piece(s, 2 * k + 1, depth + 1));
}

static truth negative(struct calc *c, const struct harmonic *f, val length, bool zero_at_start, bool zero_at_end) {
  struct span_of_phase s = {c, f, length, zero_at_start, zero_at_end, 0};
  return negative_piece(&s, 0, 0);
}

static struct word_condition *add(struct word_orbit *o, int phase, int mass, enum word_condition_kind kind,
                                  truth holds) {
  struct word_condition *k = &o->condition[o->n_conditions++];
  *k = (struct word_condition){phase, mass, kind, holds, TRUTH_TRUE};
  return k;
}

/* f < 0 inside the phase.  Where the phase ends because f is zero, that is the first such time also when f > 0 until
   then. */
static void judge(struct word_orbit *o, struct calc *c, int phase, int mass, enum word_condition_kind kind,
                  const struct harmonic *f, bool zero_at_start, bool ends) {
  val length = o->t + phase;
  truth holds = negative(c, f, length, zero_at_start, ends);
  struct word_condition *k = add(o, phase, mass, kind, holds);
  if (!ends || holds == TRUTH_TRUE) return;
  struct harmonic over = harmonic_sided(c, f, -1);
  k->first = truth_or(holds, negative(c, &over, length, zero_at_start, true));
}

/* w < e, and w > -(e + over) where over is known. */
static void judge_stick(struct word_orbit *o, struct calc *c, const struct word_law *m, int phase, int mass,
                        const struct motion *motion) {
  struct word_event e = word_event_of(&o->word, phase);
  bool ends = e.mass == mass, up = ends && e.to == MODE_BELOW, down = ends && e.to == MODE_ABOVE;
  struct harmonic f = motion->force[mass];
  f.start = calc_sub(c, f.start, m->e[mass]);
  judge(o, c, phase, mass, WORD_BELOW_BREAK, &f, false, up);
  if (!m->over[mass]) return;
  f = harmonic_sided(c, &motion->force[mass], -1);
  f.start = calc_sub(c, f.start, calc_add(c, m->e[mass], m->over[mass]));
  judge(o, c, phase, mass, WORD_ABOVE_BREAK, &f, false, down);
}

static void judge_slip(struct word_orbit *o, struct calc *c, int phase, int mass, const struct motion *motion) {
  struct word_event before = word_event_of(&o->word, (phase + o->word.n - 1) % o->word.n);
  struct word_event e = word_event_of(&o->word, phase);
  bool slower = o->word.mode[phase][mass] == MODE_BELOW;
  struct harmonic f = harmonic_sided(c, &motion->speed[mass], slower ? 1 : -1);
  if (before.mass == mass) f.start = calc_d(c, 0);
  judge(o, c, phase, mass, slower ? WORD_SLOWER : WORD_FASTER, &f, before.mass == mass, e.mass == mass);
}

/* A mass that passes through at the end of the phase: its force, in the next phase's first state, is beyond the
   limit. */
static void judge_passage(struct word_orbit *o, struct calc *c, const struct word_law *m, int phase) {
  struct word_event e = word_event_of(&o->word, phase);
  if (e.from == MODE_STICK || e.to == MODE_STICK) return;
  val w = o->state + N_STATE * ((phase + 1) % o->word.n) + WORD_W1 + e.mass, limit = m->e[e.mass];
  val beyond = e.to == MODE_BELOW ? calc_sub(c, limit, w) : calc_add(c, w, calc_add(c, limit, m->over[e.mass]));
  add(o, phase, e.mass, WORD_BEYOND, num_arb.lt(beyond, calc_d(c, 0)));
}

/* u_r is at least (e - w)/2 where the mass is captured: u_s >= -(e + w)/2 makes |f| <= u_r. */
static void find_friction(struct word_orbit *o, struct calc *c, const struct word_law *m) {
  for (int mass = 0; mass < 2; mass++) {
    arb_zero(o->u_r_min[mass]);
    for (int p = 0; p < o->word.n; p++) {
      struct word_event before = word_event_of(&o->word, (p + o->word.n - 1) % o->word.n);
      if (before.mass != mass || before.to != MODE_STICK) continue;
      val least = calc_mul(c, calc_d(c, 0.5), calc_sub(c, m->e[mass], o->state + N_STATE * p + WORD_W1 + mass));
      arb_max(o->u_r_min[mass], o->u_r_min[mass], least, c->ctx.prec);
    }
  }
}

void word_judge(struct word_orbit *o, struct calc *c, const struct word_law *m) {
  o->n_conditions = 0;
  for (int p = 0; p < o->word.n; p++) {
    slong mark = calc_mark(c);
    const enum coulomb_mode *mode = o->word.mode[p];
    truth length = num_arb.lt(calc_d(c, 0), o->t + p);
    bool d = mode[0] == MODE_STICK && mode[1] == MODE_STICK;
    add(o, p, 0, WORD_LENGTH, length)->first = d ? TRUTH_TRUE : length;
    val state[N_STATE];
    for (int i = 0; i < N_STATE; i++) state[i] = o->state + N_STATE * p + i;
    struct motion motion;
    word_motion(&motion, c, m, mode, state, false);
    for (int mass = 0; mass < 2 && length == TRUTH_TRUE; mass++) {
      if (mode[mass] == MODE_STICK)
        judge_stick(o, c, m, p, mass, &motion);
      else
        judge_slip(o, c, p, mass, &motion);
    }
    judge_passage(o, c, m, p);
    calc_release(c, mark);
  }
  find_friction(o, c, m);
  o->own = o->admissible = TRUTH_TRUE;
  for (int i = 0; i < o->n_conditions; i++) {
    o->admissible = truth_and(o->admissible, o->condition[i].holds);
    o->own = truth_and(o->own, o->condition[i].first);
  }
}
