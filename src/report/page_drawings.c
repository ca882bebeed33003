/* Pictures drawn from the record as SVG, in the page's own colours; each says in words what it shows. */
#include "page.h"

/* So that a line is one where no style sheet is read. */
#define LINE "fill=\"none\" stroke=\"currentColor\""

/* --- The counts as a bar --- */

enum { BAR_WIDTH = 700, BAR_HEIGHT = 44, BAR_TOP = 4 };

/* Hatching, so that the parts differ in grey too. */
static void add_patterns(const struct page *p) {
  static const char *const line[N_VERDICTS] = {[VERDICT_CONDITIONAL] = "M0 8L8 0",
                                               [VERDICT_SUPPORTED] = "M0 4H8",
                                               [VERDICT_REFUTED] = "M0 0L8 8M0 8L8 0",
                                               [VERDICT_UNKNOWN] = "M4 0V8",
                                               [VERDICT_SKIPPED] = "M0 0L8 8"};
  text_add(p->out, "<defs>\n");
  for (int i = 0; i < N_VERDICTS; i++) {
    text_printf(p->out,
                "<pattern id=\"p-%s\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\">"
                "<rect class=\"fill %s\" fill=\"%s\" width=\"8\" height=\"8\" />",
                verdict_name[i], verdict_name[i], i == VERDICT_PROVED ? "#bbb" : "#eee");
    if (line[i]) text_printf(p->out, "<path class=\"hatch\" " LINE " d=\"%s\" />", line[i]);
    text_add(p->out, "</pattern>\n");
  }
  text_add(p->out, "</defs>\n");
}

/* Each verdict that occurs has a part in proportion, but none so small that it cannot be seen. */
static void part_widths(int width[N_VERDICTS], const long count[N_VERDICTS]) {
  enum { LEAST = 14 };
  long total = 0;
  int used = 0, widest = 0;
  for (int i = 0; i < N_VERDICTS; i++) total += count[i];
  for (int i = 0; i < N_VERDICTS; i++) {
    width[i] = count[i] ? (int)(count[i] * BAR_WIDTH / total) : 0;
    if (count[i] && width[i] < LEAST) width[i] = LEAST;
    if (width[i] > width[widest]) widest = i;
    used += width[i];
  }
  width[widest] += used ? BAR_WIDTH - used : 0;
}

static void add_label(const struct page *p, const long count[N_VERDICTS]) {
  const char *sep = "";
  for (int i = 0; i < N_VERDICTS; i++)
    if (count[i]) {
      text_printf(p->out, "%s%ld %s", sep, count[i], verdict_name[i]);
      sep = ", ";
    }
}

static void add_key(const struct page *p, const long count[N_VERDICTS]) {
  text_add(p->out, "<figcaption>");
  const char *sep = "";
  for (int i = 0; i < N_VERDICTS; i++)
    if (count[i]) {
      text_printf(p->out,
                  "%s<span class=\"key\"><svg class=\"swatch\" width=\"16\" height=\"16\" viewBox=\"0 0 16 16\" "
                  "aria-hidden=\"true\"><rect "
                  "width=\"16\" height=\"16\" fill=\"url(#p-%s)\" /></svg> %ld %s</span>",
                  sep, verdict_name[i], count[i], verdict_name[i]);
      sep = " ";
    }
  text_add(p->out, "</figcaption></figure>\n");
}

void page_verdict_bar(const struct page *p, const long count[N_VERDICTS]) {
  int width[N_VERDICTS];
  part_widths(width, count);
  text_printf(p->out,
              "<figure>\n<svg class=\"bar\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" role=\"img\" "
              "aria-label=\"Verdicts as a bar: ",
              BAR_WIDTH, BAR_HEIGHT, BAR_WIDTH, BAR_HEIGHT);
  add_label(p, count);
  text_add(p->out, "\">\n");
  add_patterns(p);
  for (int i = 0, x = 0; i < N_VERDICTS; x += width[i++]) {
    if (!width[i]) continue;
    text_printf(
        p->out,
        "<rect class=\"part\" stroke=\"#fff\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"url(#p-%s)\" />\n", x,
        BAR_TOP, width[i], BAR_HEIGHT - 2 * BAR_TOP, verdict_name[i]);
  }
  text_add(p->out, "</svg>\n");
  add_key(p, count);
}

/* --- The two masses on the belt --- */

/* A spring from x to x + 80 at height y. */
static void add_spring(const struct page *p, int x, int y) {
  text_printf(p->out, "<path class=\"line\" " LINE " d=\"M%d %dh10l5 -10l10 20l10 -20l10 20l10 -20l5 10h20\" />\n", x,
              y);
}

static void add_block(const struct page *p, int x, const char *index) {
  text_printf(p->out,
              "<rect class=\"block\" fill=\"#eee\" stroke=\"currentColor\" x=\"%d\" y=\"50\" width=\"90\" "
              "height=\"60\" rx=\"4\" />\n"
              "<text x=\"%d\" y=\"86\" text-anchor=\"middle\"><tspan font-style=\"italic\">m</tspan><tspan dy=\"4\" "
              "font-size=\"12\">%s</tspan></text>\n"
              "<path class=\"arrow\" " LINE " d=\"M%d 40h34\" />\n<path class=\"head\" d=\"M%d 40l-8 -4v8z\" />\n"
              "<text x=\"%d\" y=\"28\"><tspan font-style=\"italic\">x</tspan><tspan dy=\"4\" "
              "font-size=\"12\">%s</tspan></text>\n",
              x, x + 45, index, x + 30, x + 70, x + 40, index);
}

void page_belt(const struct page *p) {
  text_add(p->out,
           "<figure>\n<svg class=\"belt\" width=\"560\" height=\"170\" font-size=\"18\" viewBox=\"0 0 560 170\" "
           "role=\"img\" aria-label=\"A wall on the left; a "
           "spring k1 from it to the block m1; a spring k2 from m1 to the block m2 on its right; both blocks lie on "
           "a belt that runs to the right with velocity V. Positions x1 and x2 count to the right.\">\n"
           "<path class=\"wall\" " LINE " d=\"M40 30v80M40 30l-14 14M40 50l-14 14M40 70l-14 14M40 90l-14 14\" />\n");
  add_spring(p, 40, 80);
  add_block(p, 120, "1");
  add_spring(p, 210, 80);
  add_block(p, 290, "2");
  text_add(p->out,
           "<text x=\"80\" y=\"62\" text-anchor=\"middle\"><tspan font-style=\"italic\">k</tspan><tspan dy=\"4\" "
           "font-size=\"12\">1"
           "</tspan></text>\n"
           "<text x=\"250\" y=\"62\" text-anchor=\"middle\"><tspan font-style=\"italic\">k</tspan><tspan dy=\"4\" "
           "font-size=\"12\">2"
           "</tspan></text>\n"
           "<rect class=\"track\" " LINE " x=\"60\" y=\"110\" width=\"440\" height=\"44\" rx=\"22\" />\n"
           "<circle class=\"line\" " LINE " cx=\"82\" cy=\"132\" r=\"14\" /><circle class=\"line\" " LINE
           " cx=\"478\" cy=\"132\" r=\"14\" "
           "/>\n"
           "<path class=\"arrow\" " LINE " d=\"M420 98h54\" /><path class=\"head\" d=\"M482 98l-10 -5v10z\" />\n"
           "<text x=\"440\" y=\"88\" font-style=\"italic\">V</text>\n</svg>\n<figcaption>The system as the equations "
           "of motion (1) "
           "describe it.</figcaption></figure>\n");
}
