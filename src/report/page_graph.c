/* What rests on what, as a picture: a column for each level, on which stand the claims that rest on the levels to its
   left.  Claims on which nothing rests and that rest on nothing are left out; so are arrows that a longer way
   implies. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "escape.h"
#include "finding.h"
#include "graph.h"
#include "sections.h"

enum { COLUMN = 200, ROW = 20, BOX = 152, MARGIN = 10 };

struct place {
  bool shown;
  int level, row;
};

enum arrow { ARROW_NONE, ARROW_RESTS, ARROW_FATAL };

struct drawing {
  struct claim_graph g;
  struct place *at;
  unsigned char *arrow; /* n x n: from the column to the row */
  int levels, rows, shown, arrows, fatal;
};

static enum arrow arrow_of(const struct claim_graph *g, size_t a, size_t b) {
  if (claim_falls(g->r, g->ids.name[a], g->ids.name[b])) return ARROW_FATAL;
  return g->rests[a * g->ids.n + b] && !claim_graph_implied(g, a, b) ? ARROW_RESTS : ARROW_NONE;
}

/* A level above all that the claim rests on; claims that rest on each other stand where the first of them does. */
static void find_levels(struct drawing *d) {
  size_t n = d->g.ids.n;
  bool moved = true;
  for (size_t pass = 0; moved && pass < n; pass++) {
    moved = false;
    for (size_t a = 0; a < n; a++)
      for (size_t b = 0; b < n; b++) {
        bool above = d->g.rests[a * n + b] && !d->g.reach[b * n + a];
        if (!above || d->at[a].level > d->at[b].level) continue;
        d->at[a].level = d->at[b].level + 1;
        moved = true;
      }
  }
}

static void find_rows(struct drawing *d) {
  size_t n = d->g.ids.n;
  int *used = ss_malloc((n + 1) * sizeof *used);
  memset(used, 0, (n + 1) * sizeof *used);
  for (size_t i = 0; i < n; i++) {
    if (!d->at[i].shown) continue;
    d->at[i].row = used[d->at[i].level]++;
    if (d->at[i].row >= d->rows) d->rows = d->at[i].row + 1;
    if (d->at[i].level >= d->levels) d->levels = d->at[i].level + 1;
    d->shown++;
  }
  free(used);
}

static void drawing_init(struct drawing *d, const struct audit_result *r) {
  *d = (struct drawing){.levels = 0};
  claim_graph_init(&d->g, r);
  size_t n = d->g.ids.n;
  d->at = ss_malloc((n + 1) * sizeof *d->at);
  d->arrow = ss_malloc(n * n + 1);
  memset(d->at, 0, (n + 1) * sizeof *d->at);
  for (size_t a = 0; a < n; a++)
    for (size_t b = 0; b < n; b++) {
      enum arrow arrow = arrow_of(&d->g, a, b);
      d->arrow[a * n + b] = (unsigned char)arrow;
      if (arrow == ARROW_NONE) continue;
      d->at[a].shown = d->at[b].shown = true;
      d->arrows++;
      d->fatal += arrow == ARROW_FATAL;
    }
  find_levels(d);
  find_rows(d);
}

static void drawing_clear(struct drawing *d) {
  free(d->arrow);
  free(d->at);
  claim_graph_clear(&d->g);
}

static void add_arrows(const struct page *p, const struct drawing *d, enum arrow kind) {
  for (size_t a = 0; a < d->g.ids.n; a++)
    for (size_t b = 0; b < d->g.ids.n; b++) {
      if (d->arrow[a * d->g.ids.n + b] != kind) continue;
      int x0 = MARGIN + d->at[b].level * COLUMN + BOX, y0 = MARGIN + d->at[b].row * ROW + ROW / 2;
      int x1 = MARGIN + d->at[a].level * COLUMN, y1 = MARGIN + d->at[a].row * ROW + ROW / 2;
      text_printf(p->out, "M%d %dC%d %d %d %d %d %d", x0, y0, x0 + 40, y0, x1 - 40, y1, x1, y1);
    }
}

/* Those of the style sheet, so that verdicts differ without colours. */
static const char *const sign[N_VERDICTS] = {[VERDICT_PROVED] = "\xe2\x96\xa0",
                                             [VERDICT_CONDITIONAL] = "\xe2\x97\x90",
                                             [VERDICT_SUPPORTED] = "\xe2\x96\xa1",
                                             [VERDICT_REFUTED] = "\xe2\x9c\x95",
                                             [VERDICT_UNKNOWN] = "?",
                                             [VERDICT_SKIPPED] = "\xe2\x80\x93",
                                             [VERDICT_DEFINITION] = "\xe2\x80\xa2"};

static void add_node(const struct page *p, const struct drawing *d, size_t i) {
  const struct finding *f = i < p->r->n_findings ? &p->r->findings[i] : NULL;
  int x = MARGIN + d->at[i].level * COLUMN, y = MARGIN + d->at[i].row * ROW;
  bool failed = f && finding_fails(f);
  text_printf(p->out, "<g><title>");
  escape_html(p->out, d->g.ids.name[i]);
  if (f) text_printf(p->out, " (%s): ", verdict_name[f->verdict]);
  escape_html(p->out, f ? f->title : " (not judged in this run)");
  text_printf(p->out,
              "</title><rect class=\"node %s%s\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"3\" "
              "fill=\"#fff\" stroke=\"currentColor\" />",
              f ? verdict_name[f->verdict] : "skipped", failed ? " failed" : "", x, y + 2, BOX, ROW - 4);
  text_printf(p->out, "<text x=\"%d\" y=\"%d\">", x + 4, y + 14);
  escape_html(p->out, f ? sign[f->verdict] : sign[VERDICT_SKIPPED]);
  text_add_char(p->out, ' ');
  escape_html(p->out, d->g.ids.name[i]);
  text_add(p->out, "</text></g>\n");
}

static void add_drawing(const struct page *p, const struct drawing *d) {
  int width = 2 * MARGIN + d->levels * COLUMN - (COLUMN - BOX), height = 2 * MARGIN + d->rows * ROW;
  text_printf(
      p->out,
      "<div class=\"wide\"><svg class=\"graph\" font-size=\"11\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
      "role=\"img\" "
      "aria-label=\"Graph of %d claims on %d levels with %d arrows, %d of them to a claim that fails when what it "
      "rests on is read as printed; the same is said in words in each claim, under Rests on\">\n<path "
      "class=\"edge\" fill=\"none\" stroke=\"#777\" stroke-width=\".7\" d=\"",
      width, height, width, height, d->shown, d->levels, d->arrows, d->fatal);
  add_arrows(p, d, ARROW_RESTS);
  text_add(p->out,
           "\" />\n<path class=\"edge fatal\" fill=\"none\" stroke=\"currentColor\" stroke-dasharray=\"5 3\" d=\"");
  add_arrows(p, d, ARROW_FATAL);
  text_add(p->out, "\" />\n");
  for (size_t i = 0; i < d->g.ids.n; i++)
    if (d->at[i].shown) add_node(p, d, i);
  text_add(p->out, "</svg></div>\n");
}

void page_graph(const struct page *p) {
  struct drawing d;
  drawing_init(&d, p->r);
  page_begin_section(p, "graph", "What rests on what");
  if (d.shown) {
    text_add(p->out, "<p>A claim stands to the right of all that it rests on. The sign before its name is that of its "
                     "verdict, as <a href=\"#s-verdicts\">above</a>; a heavy border marks "
                     "a failure, and a dashed arrow leads to a claim that fails when the formula at its tail is read "
                     "as printed. Claims "
                     "without a connection are left out, and so are arrows that a longer way implies.</p>\n");
    add_drawing(p, &d);
  } else {
    text_add(p->out, "<p>No claim of this run rests on another.</p>\n");
  }
  text_add(p->out, "</section>\n");
  drawing_clear(&d);
}
