/* The claims as a graph for Graphviz.  An arrow leads from what a claim rests on to the claim; arrows that a longer way
   implies are left out.  Colour is the verdict, shape the kind of fault; failures have a heavy border, claims that fall
   with one a dashed one. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "escape.h"
#include "finding.h"
#include "name_list.h"
#include "report.h"

/* --- What rests on what --- */

/* Nodes: the findings, then ids that findings name and that were not judged in this run. */
struct claim_graph {
  const struct audit_result *r;
  struct names ids;
  bool *rests, *reach; /* n x n: row rests on column, directly; over any way */
};

static size_t node_of(struct claim_graph *g, const char *id) {
  return names_index(&g->ids, id);
}

static void graph_init(struct claim_graph *g, const struct audit_result *r) {
  *g = (struct claim_graph){.r = r};
  for (size_t i = 0; i < r->n_findings; i++) node_of(g, r->findings[i].id);
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_depends_on; k++) node_of(g, r->findings[i].depends_on[k]);
  for (size_t i = 0; i < r->n_consequences; i++)
    for (int k = 0; k < r->consequences[i].falls.n; k++) node_of(g, r->consequences[i].falls.id[k]);
  size_t bytes = g->ids.n * g->ids.n * sizeof *g->rests;
  g->rests = ss_malloc(bytes);
  g->reach = ss_malloc(bytes);
  memset(g->rests, 0, bytes);
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_depends_on; k++)
      g->rests[node_of(g, r->findings[i].id) * g->ids.n + node_of(g, r->findings[i].depends_on[k])] = true;
  memcpy(g->reach, g->rests, bytes);
  for (size_t k = 0; k < g->ids.n; k++)
    for (size_t i = 0; i < g->ids.n; i++)
      for (size_t j = 0; g->reach[i * g->ids.n + k] && j < g->ids.n; j++)
        g->reach[i * g->ids.n + j] = g->reach[i * g->ids.n + j] || g->reach[k * g->ids.n + j];
}

static void graph_clear(struct claim_graph *g) {
  free(g->reach);
  free(g->rests);
  free(g->ids.name);
}

/* Whether a rests on b over something else as well; claims that rest on each other imply nothing. */
static bool is_implied(const struct claim_graph *g, size_t a, size_t b) {
  for (size_t c = 0; c < g->ids.n; c++)
    if (c != a && c != b && g->rests[a * g->ids.n + c] && g->reach[c * g->ids.n + b] && !g->reach[b * g->ids.n + c] &&
        !g->reach[c * g->ids.n + a])
      return true;
  return false;
}

/* Whether the claim falls with the failure, or with any when that is NULL. */
static bool falls(const struct audit_result *r, const char *id, const char *failure) {
  for (size_t i = 0; i < r->n_consequences; i++) {
    const struct consequence *q = &r->consequences[i];
    if (failure && strcmp(q->failure, failure) != 0) continue;
    if (word_find(id, q->falls.id, q->falls.n) < q->falls.n) return true;
  }
  return false;
}

/* --- The file --- */

static const char *colour(enum verdict v) {
  static const char *const of[N_VERDICTS] = {
      [VERDICT_PROVED] = "#a6dba0",    [VERDICT_CONDITIONAL] = "#fdd49e", [VERDICT_SUPPORTED] = "#d9f0d3",
      [VERDICT_REFUTED] = "#f4a582",   [VERDICT_UNKNOWN] = "#ffffb3",     [VERDICT_SKIPPED] = "#eeeeee",
      [VERDICT_DEFINITION] = "#deebf7"};
  return of[v];
}

/* By the class of the fault, the last one without any. */
static const char *const shape[N_FAULTS + 1] = {"octagon", "box", "diamond", "hexagon", "ellipse"};

static void add_node(struct text *out, const struct claim_graph *g, size_t i) {
  const struct finding *f = i < g->r->n_findings ? &g->r->findings[i] : NULL;
  text_add(out, "  ");
  escape_dot(out, g->ids.name[i]);
  if (f)
    text_printf(out, " [shape=%s, fillcolor=\"%s\", tooltip=", shape[failure_fault(f)], colour(f->verdict));
  else
    text_add(out, " [shape=ellipse, fillcolor=\"#ffffff\", tooltip=");
  escape_dot(out, f && f->title ? f->title : "not judged in this run");
  bool failed = f && finding_fails(f);
  if (failed) text_add(out, ", penwidth=3, color=\"#b2182b\"");
  if (falls(g->r, g->ids.name[i], NULL))
    text_add(out, failed ? ", peripheries=2" : ", color=\"#b2182b\", style=\"filled,dashed\"");
  text_add(out, "];\n");
}

void report_dot(struct text *out, const struct audit_result *r) {
  OWNED_CLEARED(graph_clear) struct claim_graph g;
  graph_init(&g, r);
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
      bool fatal = falls(r, g.ids.name[a], g.ids.name[b]);
      if (!fatal && (!g.rests[a * g.ids.n + b] || is_implied(&g, a, b))) continue;
      text_add(out, "  ");
      escape_dot(out, g.ids.name[b]);
      text_add(out, " -> ");
      escape_dot(out, g.ids.name[a]);
      text_add(out, fatal ? " [color=\"#b2182b\", penwidth=2];\n" : ";\n");
    }
  text_add(out, "}\n");
}
