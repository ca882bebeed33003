/* One period of the two masses on the belt, moved by CSS where the reader's system does not ask for less motion;
   without it they stand where the period begins.  Below, the positions over time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page.h"
#include "picture.h"

enum { PHASE, MARK, TIME, POSITION, VELOCITY, PULL = 7, LIMIT = 9, COLUMNS = 11 };

/* In pixels: the wall, the right end, a block's sides, the least length of a spring, where the blocks stand, the length
   of a spring and of the longest bar before they are scaled. */
enum { WALL = 16, RIGHT = 352, BLOCK = 46, HIGH = 34, SPRING = 26, FLOOR = 122, WHOLE = 100, BAR = 40 };

struct stage {
  const struct rows *t;
  double scale, left[2], low[2]; /* a mass at z stands at left + scale (z - low) */
  double pull;                   /* the greatest */
  double period, passed;         /* passed: how far the belt goes in it */
};

/* What moves: the block of each mass, the spring at its left, the bar of its pull; and what is shown for a while: the
   name of a phase, that a mass sticks. */
enum track { TRACK_BLOCK, TRACK_SPRING, TRACK_PULL, N_TRACKS };
enum { SWITCH = 2 * N_TRACKS, STICKS = SWITCH + 4, N_MOVING = STICKS + 2 };
static const char *const moving[N_MOVING] = {"m1", "k1", "u1", "m2", "k2", "u2", "p0", "p1", "p2", "p3", "p4", "p5"};
static const char *const phases[][2] = {{"D", "phase *D*: both masses stick"},
                                        {"Gamma", "phase \xce\x93: *m*_1 slips, *m*_2 sticks"},
                                        {"H", "phase *H*: both masses slip"},
                                        {"C", "phase *C*: *m*_1 sticks, *m*_2 slips"}};

static double place(const struct stage *s, size_t row, int mass) {
  return s->left[mass] + s->scale * (rows_number(s->t, row, POSITION + 2 * (size_t)mass) - s->low[mass]);
}

/* By how many pixels it is moved, or how it is scaled. */
static double value_of(const struct stage *s, size_t row, enum track track, int mass) {
  if (track == TRACK_BLOCK) return place(s, row, mass);
  if (track == TRACK_PULL) return rows_number(s->t, row, PULL + (size_t)mass) / s->pull;
  double from = mass ? place(s, row, 0) + BLOCK : WALL;
  return (place(s, row, mass) - from) / WHOLE;
}

/* false where the table does not hold one period of a motion. */
static bool set_stage(struct stage *s, const struct rows *t) {
  double least = (double)NAN, most = 0, high[2] = {(double)NAN, (double)NAN};
  *s = (struct stage){.t = t, .low = {(double)NAN, (double)NAN}};
  if (t->n < 2 || t->columns < COLUMNS) return false;
  for (size_t i = 0; i < t->n; i++)
    for (size_t mass = 0; mass < 2; mass++) {
      plot_hold(&s->low[mass], &high[mass], rows_number(t, i, POSITION + 2 * mass));
      s->pull = fmax(s->pull, fabs(rows_number(t, i, PULL + mass)));
    }
  for (size_t i = 0; i < t->n; i++)
    plot_hold(&least, &most, rows_number(t, i, POSITION + 2) - s->low[1] - rows_number(t, i, POSITION) + s->low[0]);
  double across = high[1] - s->low[1] - least;
  s->period = rows_number(t, t->n - 1, TIME);
  double velocity = rows_number(t, 0, VELOCITY);
  s->scale = (RIGHT - WALL - 2 * SPRING - 2 * BLOCK) / across;
  s->left[0] = WALL + SPRING;
  s->left[1] = s->left[0] + BLOCK + SPRING - s->scale * least;
  s->passed = s->scale * velocity * s->period;
  double all[] = {s->period, velocity, s->pull, across};
  for (int i = 0; i < 4; i++)
    if (!(all[i] > 1e-6 && all[i] < 1e6)) return false;
  return true;
}

/* --- Motion --- */

static double seconds(const struct stage *s) {
  return fmin(fmax(s->period, 6), 30);
}

static bool is_on(const struct stage *s, size_t row, int k) {
  return k < STICKS ? rows_is(s->t, row, PHASE, phases[k - SWITCH][0])
                    : !rows_is(s->t, row, LIMIT + (size_t)(k - STICKS), "-");
}

static const char *seen(const struct stage *s, size_t row, int k) {
  return is_on(s, row, k) ? "visible" : "hidden";
}

/* Of what moves every other row and all events, of what is shown where that changes. */
static bool is_frame(const struct stage *s, size_t row, int k) {
  if (k < SWITCH) return row % 2 == 0 || !rows_is(s->t, row, MARK, "-");
  return row == 0 || is_on(s, row, k) != is_on(s, row - 1, k);
}

static void add_frame(struct plot *p, const struct stage *s, size_t row, int k) {
  text_printf(p->out, " %.2f%% { ", 100 * rows_number(s->t, row, TIME) / s->period);
  if (k >= SWITCH)
    text_printf(p->out, "visibility: %s; }", seen(s, row, k));
  else
    text_printf(p->out, k % N_TRACKS == TRACK_BLOCK ? "transform: translateX(%.1fpx); }" : "transform: scaleX(%.3f); }",
                value_of(s, row, (enum track)(k % N_TRACKS), k / N_TRACKS));
}

static void add_animation(struct plot *p, const struct stage *s, const char *name, const char *pace) {
  text_printf(p->out, ".animation-%s { animation: animation-%s %.1fs %s infinite; }\n", name, name, seconds(s), pace);
}

static void add_motion(struct plot *p, const struct stage *s) {
  text_add(p->out, "<style>\n");
  plot_style(p->out, picture_animation_css);
  text_add(p->out, "@media (prefers-reduced-motion: no-preference) {\n");
  for (int k = 0; k < N_MOVING; k++) {
    text_printf(p->out, "@keyframes animation-%s {", moving[k]);
    for (size_t i = 0; i < s->t->n; i++)
      if (is_frame(s, i, k)) add_frame(p, s, i, k);
    text_add(p->out, " }\n");
    add_animation(p, s, moving[k], k < SWITCH ? "linear" : "step-end");
  }
  text_printf(p->out, "@keyframes animation-v { to { stroke-dashoffset: %.1fpx; } }\n", -s->passed);
  text_printf(p->out, "@keyframes animation-t { to { transform: translateX(%.1fpx); } }\n",
              plot_x(p, s->period) - plot_x(p, 0));
  add_animation(p, s, "v", "linear");
  add_animation(p, s, "t", "linear");
  text_add(p->out, "}\n</style>\n");
}

/* --- What is moved --- */

static void add_spring(struct plot *p, const struct stage *s, int mass, double x) {
  text_printf(p->out,
              "<g transform=\"translate(%.1f %d)\"><path class=\"spring animation-k%d\" " PLOT_STROKE
              " transform=\"scale(%.3f 1)\" d=\"M0 0h12l6 -7l12 14l12 -14l12 14l12 -14l12 14l6 -7h16\" /></g>\n",
              x, FLOOR - HIGH / 2, mass + 1, value_of(s, 0, TRACK_SPRING, mass));
}

/* The block with what moves with it, the spring at the right of the first one too; its pull above, towards the wall
   where it is positive. */
static void add_block(struct plot *p, const struct stage *s, int mass) {
  double limit = rows_number(s->t, 0, LIMIT + (size_t)mass);
  int middle = BLOCK / 2, above = FLOOR - HIGH - 14;
  char label[16];
  snprintf(label, sizeof label, "*m*_%d", mass + 1);
  text_printf(p->out, "<g class=\"animation-m%d\" transform=\"translate(%.1f 0)\">\n", mass + 1,
              value_of(s, 0, TRACK_BLOCK, mass));
  text_printf(p->out, "<rect class=\"block b%d\" " PLOT_STROKE " y=\"%d\" width=\"%d\" height=\"%d\" rx=\"3\" />\n",
              mass, FLOOR - HIGH, BLOCK, HIGH);
  text_printf(p->out,
              "<g class=\"animation-p%d\" visibility=\"%s\"><rect class=\"stick b%d\" fill=\"currentColor\" "
              "fill-opacity=\".3\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"3\" />\n",
              STICKS - SWITCH + mass, seen(s, 0, STICKS + mass), mass, FLOOR - HIGH, BLOCK, HIGH);
  if (!isnan(limit))
    text_printf(p->out, "<path class=\"limit\" " PLOT_STROKE " d=\"M%.1f %dv14\" />\n", middle - BAR * limit / s->pull,
                above - 7);
  text_add(p->out, "</g>\n");
  text_printf(p->out,
              "<g transform=\"translate(%d %d)\"><path class=\"pull b%d animation-u%d\" " PLOT_STROKE
              " transform=\"scale(%.3f 1)\" d=\"M0 0h-%d\" /></g>\n",
              middle, above, mass, mass + 1, value_of(s, 0, TRACK_PULL, mass), BAR);
  plot_text(p, middle, FLOOR - HIGH / 2 + 4, "middle", label);
  if (mass == 0) add_spring(p, s, 1, BLOCK);
  text_add(p->out, "</g>\n");
}

static void add_blocks(struct plot *p, const struct stage *s) {
  double apart = s->passed / ceil(s->passed / 24); /* so that a whole number of marks passes in a period */
  text_printf(p->out, "<path class=\"wall\" " PLOT_STROKE " d=\"M%d %dv%d\" />\n", WALL, FLOOR - HIGH - 10, HIGH + 10);
  text_printf(p->out,
              "<path class=\"belt\" " PLOT_STROKE
              " d=\"M6 %dH354M6 %dH354\" />\n<path class=\"belt marks animation-v\" " PLOT_STROKE
              " stroke-dasharray=\"2 %.3f\" stroke-width=\"8\" d=\"M6 %dH354\" />\n",
              FLOOR, FLOOR + 10, apart - 2, FLOOR + 5);
  add_spring(p, s, 0, WALL);
  for (int mass = 0; mass < 2; mass++) add_block(p, s, mass);
  for (int k = SWITCH; k < STICKS; k++) {
    text_printf(p->out, "<g class=\"animation-%s\" visibility=\"%s\">", moving[k], seen(s, 0, k));
    plot_text(p, PLOT_WIDTH / 2, 42, "middle", phases[k - SWITCH][1]);
    text_add(p->out, "</g>\n");
  }
  plot_text(p, 354, FLOOR + 24, "end", "belt, velocity *V* \xe2\x86\x92");
}

static void add_history(struct plot *p, const struct stage *s) {
  const struct rows *t = s->t;
  plot_hold_columns(p, t, TIME, POSITION, 1);
  plot_hold_column(p, 1, t, POSITION + 2);
  plot_widen(p, 1, 0.08, 0.2);
  plot_panel(p, FLOOR + 52, 150, "time *t*", "*z*_1 and *z*_2");
  picture_phases(p, t, PHASE, TIME);
  for (size_t mass = 0; mass < 2; mass++) plot_column(p, t, plot_class[mass], TIME, POSITION + 2 * mass);
  text_printf(p->out, "<path class=\"frame animation-t\" " PLOT_STROKE " d=\"M%.1f %.1fv%.1f\" />\n", plot_x(p, 0),
              p->top, p->height);
  plot_free(p);
}

static void draw_animation(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "*z*_1, mass *m*_1"}, {"c1", "*z*_2, mass *m*_2"}};
  struct stage s;
  char says[240];
  p->bottom = plot_key(p, key, 2);
  if (!set_stage(&s, t)) return;
  add_history(p, &s);
  add_blocks(p, &s);
  add_motion(p, &s);
  snprintf(says, sizeof says, "One period, %.4f, takes %.1f seconds here. " TABLE_UNITS, s.period, seconds(&s));
  double y = plot_lines(p, 4, p->bottom + 14,
                        "A filled block sticks to the belt. The bar above it: the pull of the springs less sliding "
                        "friction; the tick: where it breaks loose.");
  p->bottom = plot_lines(p, 4, y, says);
}

static void say_animation(struct text *out, const struct rows *t) {
  (void)t;
  text_add(out, "It stands still where the reader's system asks for less motion.");
}

static void tell_animation(struct text *out, const struct rows *t) {
  if (t->columns < COLUMNS) return;
  text_add(out, "Two blocks on a moving belt, joined by a spring, the left one to a wall by another.");
  for (size_t i = 0; i < t->n; i++)
    if (!rows_is(t, i, MARK, "-"))
      text_printf(out, " %s: t = %.3f, z1 = %.3f, z2 = %.3f, %s of phase %s.", t->cell[i][MARK],
                  rows_number(t, i, TIME), rows_number(t, i, POSITION), rows_number(t, i, POSITION + 2),
                  rows_is(t, i, MARK, "O") ? "beginning" : "end", t->cell[i][PHASE]);
}

const struct picture picture_animation = {"animation",   "animation.tsv", "One period of the two masses on the belt",
                                          say_animation, tell_animation,  draw_animation};
