/* What rests on what: a graph of the claims. */
#ifndef STICKSLIP_REPORT_GRAPH_H
#define STICKSLIP_REPORT_GRAPH_H

#include "names.h"
#include "record/result.h"

/* Nodes: the findings, then ids that findings name and that were not judged in this run. */
struct claim_graph {
  const struct audit_result *r;
  struct names ids;
  bool *rests, *reach; /* n x n: row rests on column, directly; over any way */
};
void claim_graph_init(struct claim_graph *g, const struct audit_result *r);
void claim_graph_clear(struct claim_graph *g);
/* Whether a rests on b over something else as well; claims that rest on each other imply nothing. */
bool claim_graph_implied(const struct claim_graph *g, size_t a, size_t b);

/* Whether the claim falls with the failure, or with any when that is NULL. */
bool claim_falls(const struct audit_result *r, const char *id, const char *failure);

#endif
