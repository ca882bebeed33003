/* The population of damaged formulas, and the model with one of them in place. */
#ifndef STICKSLIP_MUTANTS_H
#define STICKSLIP_MUTANTS_H

#include "claim/claims.h"
#include "expr/edit.h"
#include "model/model.h"

/* A statement of the equation files that can be damaged. */
struct target {
  size_t record;  /* in the model */
  int stmt;       /* in the record */
  long def;       /* in the model; -1 for a statement that defines nothing */
  bool corrected; /* the errata have another text in its place */
};

struct mutant {
  size_t target;
  struct edit edit;
};

struct mutants {
  struct arena arena;
  struct target *target;
  size_t n_targets, cap_targets;
  struct mutant *mutant;
  size_t n, cap;
};

/* The one-token edits of the model's statements of the paper and of the errata, in the order of the files; only those
   of the named records or files ("eq-40", "4-stability.eq", "4-stability") when n_only > 0. */
void mutants_init(struct mutants *m, const struct model *model, const char *const *only, int n_only);
void mutants_clear(struct mutants *m);
/* Is some of them in the file or record of that name? */
bool mutants_any(const struct mutants *m, const struct model *model, const char *item);

/* The names that mean something in a section, with their shapes; and the edits of a statement that may use them. */
struct lexicon;
struct lexicon *lexicon_new(const struct model *m, const char *section);
void lexicon_free(struct lexicon *l);
void lexicon_edits(struct edits *out, struct arena *a, struct lexicon *l, const struct stmt *s);

/* The target of a statement. */
struct target target_of(const struct model *model, size_t record, int stmt);

/* A model that shares everything with another, and in which statements can be exchanged: the overlay that a mutation
   is. */
struct overlay {
  struct model model;
  const struct model *under;
};
void overlay_init(struct overlay *o, const struct model *under);
void overlay_clear(struct overlay *o);
/* The statement of the target becomes s; NULL puts the original back. */
void overlay_set(struct overlay *o, const struct target *t, const struct stmt *s);
/* Leaves the target's statement out of its record, or puts it back; for statements that define nothing. */
void overlay_leave_out(struct overlay *o, const struct target *t, bool out);

/* What holds on every motion of the word by the definition of its phases: velocities that are V, forces at their
   limits, perturbations that are zero.  Exact algebra uses it. */
extern const char *const motion_facts[][2]; /* a name, and an expression that it equals */
extern const int n_motion_facts;
struct facts;
struct facts *facts_new(const struct model *m);
void facts_free(struct facts *f);
/* Whether exact algebra uses them from now on; it does at first. */
void facts_use(struct facts *f, bool use);

/* Proves that a claim says the same in two models that differ in one statement, with its own text as printed and with
   everything corrected: its sides are equal as rational functions on every motion, or its statement is the other's
   times something positive.  false: not proved. */
bool claim_same_in(const struct claim *c, const struct target *t, const struct model *a, const struct model *b,
                   const struct facts *f);
/* The same for the statement itself or, failing that, for every statement that uses it, and what uses those: then no
   claim can tell. */
bool target_same_in(const struct target *t, const struct model *a, const struct model *b, const struct claims *claims,
                    const struct facts *f);
/* Whether a claim with its text as in model a, read as printed, says the same as in model b with everything corrected;
   a record says what the set of its relations says. */
bool claim_says_corrected(const struct claim *c, const struct model *a, const struct model *b, const struct facts *f);
bool stands_in_statement(const struct stmt *s, const char *name);
/* Sets record[i] where record i is the target's or names, through whatever definitions, what the target defines. */
void target_reaches(bool *record, const struct model *m, const struct target *t);

#endif
