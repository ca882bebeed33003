/* What rests on what, as a graph of the claims, with all that is reached over any way. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "graph.h"

static size_t node_of(struct claim_graph *g, const char *id) {
  return names_index(&g->ids, id);
}

static void add_list(struct claim_graph *g, const struct id_list *list) {
  for (int i = 0; i < list->n; i++) node_of(g, list->id[i]);
}

void claim_graph_init(struct claim_graph *g, const struct audit_result *r) {
  *g = (struct claim_graph){.r = r};
  for (size_t i = 0; i < r->n_findings; i++) node_of(g, r->findings[i].id);
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_depends_on; k++) node_of(g, r->findings[i].depends_on[k]);
  for (size_t i = 0; i < r->n_consequences; i++) add_list(g, &r->consequences[i].falls);
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

void claim_graph_clear(struct claim_graph *g) {
  free(g->reach);
  free(g->rests);
  free(g->ids.name);
}

bool claim_graph_implied(const struct claim_graph *g, size_t a, size_t b) {
  for (size_t c = 0; c < g->ids.n; c++)
    if (c != a && c != b && g->rests[a * g->ids.n + c] && g->reach[c * g->ids.n + b] && !g->reach[b * g->ids.n + c] &&
        !g->reach[c * g->ids.n + a])
      return true;
  return false;
}

bool claim_falls(const struct audit_result *r, const char *id, const char *failure) {
  for (size_t i = 0; i < r->n_consequences; i++) {
    const struct consequence *q = &r->consequences[i];
    if (failure && strcmp(q->failure, failure) != 0) continue;
    for (int k = 0; k < q->falls.n; k++)
      if (strcmp(q->falls.id[k], id) == 0) return true;
  }
  return false;
}
