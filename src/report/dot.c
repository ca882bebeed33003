/* The claims as a graph for Graphviz.  An arrow leads from what a claim rests on to the claim; arrows that a longer way
   implies are left out.  Colour is the verdict, shape the kind of fault; failures have a heavy border, claims that fall
   with one a dashed one. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "graph.h"
#include "report.h"

static const char *colour(enum verdict v) {
  static const char *const of[N_VERDICTS] = {
      [VERDICT_PROVED] = "#a6dba0",    [VERDICT_CONDITIONAL] = "#fdd49e", [VERDICT_SUPPORTED] = "#d9f0d3",
      [VERDICT_REFUTED] = "#f4a582",   [VERDICT_UNKNOWN] = "#ffffb3",     [VERDICT_SKIPPED] = "#eeeeee",
      [VERDICT_DEFINITION] = "#deebf7"};
  return of[v];
}

static const char *shape(const struct finding *f) {
  static const struct {
    const char *fault, *shape;
  } of[] = {{"notation", "octagon"}, {"formula", "box"}, {"number", "diamond"}, {"argument", "hexagon"}};
  for (size_t i = 0; f->fault && i < sizeof of / sizeof *of; i++)
    if (strcmp(of[i].fault, f->fault) == 0) return of[i].shape;
  return "ellipse";
}

static void add_node(struct text *out, const struct claim_graph *g, size_t i) {
  const struct finding *f = i < g->r->n_findings ? &g->r->findings[i] : NULL;
  text_add(out, "  ");
  escape_dot(out, g->ids.name[i]);
  if (f)
    text_printf(out, " [shape=%s, fillcolor=\"%s\", tooltip=", shape(f), colour(f->verdict));
  else
    text_add(out, " [shape=ellipse, fillcolor=\"#ffffff\", tooltip=");
  escape_dot(out, f && f->title ? f->title : "not judged in this run");
  bool failed = f && finding_fails(f);
  if (failed) text_add(out, ", penwidth=3, color=\"#b2182b\"");
  if (claim_falls(g->r, g->ids.name[i], NULL))
    text_add(out, failed ? ", peripheries=2" : ", color=\"#b2182b\", style=\"filled,dashed\"");
  text_add(out, "];\n");
}

void report_dot(struct text *out, const struct audit_result *r) {
  struct claim_graph g;
  claim_graph_init(&g, r);
  text_add(out,
           "// Arrows lead from what a claim rests on to the claim.  Colour: the verdict.  Shape: the fault of a\n"
           "// failure (octagon notation, box formula, diamond number, hexagon argument).  Heavy border: a failure;\n"
           "// dashed: it fails when a formula it rests on is read as printed (doubled where it is a failure too).\n");
  text_add(out, "digraph claims {\n  rankdir=LR;\n  node [style=filled, fontname=\"Helvetica\"];\n  label=");
  escape_dot(out, r->title ? r->title : r->scene);
  text_add(out, ";\n");
  for (size_t i = 0; i < g.ids.n; i++) add_node(out, &g, i);
  for (size_t a = 0; a < g.ids.n; a++)
    for (size_t b = 0; b < g.ids.n; b++) {
      bool fatal = claim_falls(r, g.ids.name[a], g.ids.name[b]);
      if (!fatal && (!g.rests[a * g.ids.n + b] || claim_graph_implied(&g, a, b))) continue;
      text_add(out, "  ");
      escape_dot(out, g.ids.name[b]);
      text_add(out, " -> ");
      escape_dot(out, g.ids.name[a]);
      text_add(out, fatal ? " [color=\"#b2182b\", penwidth=2];\n" : ";\n");
    }
  text_add(out, "}\n");
  claim_graph_clear(&g);
}
