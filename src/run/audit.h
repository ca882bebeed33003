/* An audit: what is asked of it, and the run. */
#ifndef STICKSLIP_RUN_AUDIT_H
#define STICKSLIP_RUN_AUDIT_H

#include "claim/claims.h"
#include "model/model.h"
#include "record/result.h"
#include "scene/scene.h"

/* Whether each item that the scene asks for selects some claim and names some quantity; false with d set, at the place
   in the scene's file or option. */
bool scene_check_asked(const struct scene *s, const struct claims *c, const struct model *m, struct diag *d);

/* What pieces of an audit were measured to cost, by a table of tab-separated rows "what, name, units, milliseconds"
   (verify/costs.tsv, made by "make scenes").  It decides which piece comes first and how long the rest
   may take, and nothing else. */
struct cost {
  char what[16], name[48]; /* claim eq-27; control ctl-...; consequence eq-40; study routes */
  double units, ms;
};
struct costs {
  struct cost *row;
  size_t n, cap;
};
/* No file at path: no rows.  false with d set when it cannot be read or is no such table. */
bool costs_load(struct costs *c, const char *path, struct diag *d);
void costs_clear(struct costs *c);
/* The row, or NULL; costs may be NULL. */
const struct cost *cost_of(const struct costs *c, const char *what, const char *name);

struct audit_options {
  const char *const *only;
  int n_only;
  /* Or NULL: pieces that are done, of all that are known so far, and the part of the expected cost that they were. */
  void (*progress)(void *arg, size_t done, size_t total, double share);
  void *arg;
  bool readings; /* search how the printed numbers arose, when claims about them are selected */
  int jobs;      /* processes; 0 and 1: this one alone */
  /* Or NULL: told of each piece, by its names in the table of costs, when this process has done it. */
  void (*ended)(void *arg, const char *what, const char *name, unsigned long long units);
  const struct costs *costs; /* or NULL */
  /* Of the paper, whose unanswered ones the whole audit names, and of discrepancies (claim/claim.h); or NULL: all
     claims count as the paper's, and none has a root. */
  const struct claims *statements, *roots;
  double (*seconds_now)(void); /* seconds, for what run.json says of the pieces; or NULL */
};

/* Judges the claims that are selected (by --only and, where the scene asks for some, by the scene: those that both
   name), then the controls that stand beside them; the same bytes for any number of jobs.  A scene's budget is for each
   claim and each control: what runs out of it is unknown.  false with d set when the claim files or the equation files
   are at fault. */
bool audit_run(struct audit_result *out, const struct model *m, const struct claims *claims,
               const struct claims *controls, const struct scene *scene, const struct audit_options *opt,
               struct diag *d);

/* What may be coloured stands between one of these characters and the last. */
enum explain_mark { EXPLAIN_PLAIN = 1, EXPLAIN_GOOD, EXPLAIN_BAD, EXPLAIN_DOUBT, EXPLAIN_END };

/* One claim for a reader, with marks: the paper's text, the formula as read, in the notation of the files, where and
   how it is tried, its verdict and evidence now, both sides in each number type at the scene's parameters changed by at
   ("chi=1/2,V=2", or NULL), with a star behind entries that are proved to differ, and the tape when asked for. */
bool audit_explain(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *at, bool tape, struct diag *d);

/* Reads a file as what its suffix says, .eq (over the paper's files), .claim or .scene, and checks all that can be
   checked without judging: syntax, names, shapes, attributes.  What it is read with is the data folder that it stands
   in, by itself or in its paper/, claims/, controls/ or scenes/; else `data`, but for an equation file that bears the
   title of another paper, which is read alone. */
bool audit_check_file(const char *path, const char *data, struct diag *d);

#endif
