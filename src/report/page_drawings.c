/* The two masses on the belt as SVG, in the page's own colours; it says in words what it shows. */
#include "page.h"

/* So that a line is one where no style sheet is read. */
#define LINE "fill=\"none\" stroke=\"currentColor\""

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
