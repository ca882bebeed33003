/* The paper as data: equation files, the overlays that correct them, and their formulas elaborated to scalars.

   An equation file is a record file (record.h).  Record 0 may carry "section: NAME" for the records that follow it in
   the file; names are scoped by section, since the paper uses some letters twice.  In one of the paper's own files it
   may carry "paper: TITLE", "text: sha256 ...", the digest of the text that is quoted (quote/quote.h), and "model: two
   masses on a belt": then, and only then, its names are those of the program's own model.  Records:

     symbol NAME        a free quantity; "means: text" says what it is; "domain: 0 < NAME < 1", or "domain: real", says
                        which numbers it may be: a symbol of the paper's own, to which points give a value
     define ID          statements "name := expr", "name(t) := expr", "name = expr" and "root name: ..."
     equation ID        statements lhs = rhs
     inequality ID      chains lhs < mid < rhs, perhaps "for t in (a, b)"
     relation ID        statements that hold along a motion: "trajectory z_1(t)" names an unknown function of time

   with the attributes section, equation (the paper's number, where the id does not have it, record.h), tex (in the
   paper's own files a quotation to the letter), place (where it stands, quote/quote.h), reads (how the TeX departs from
   what it says to the letter, "PIECE as TEX"; perhaps several), note and, in overlays, replaces.  Another attribute is
   an error.  A name that is neither defined nor a symbol is an error where it is used.  Seen from a section, its own
   definition of a name comes first, then one without a section, then that of another section, if there is only one.

   Layers.  printed = the paper's files and, when given, the user's overlay; corrected = printed under errata.eq; stable
   = corrected under stable.eq, whose forms equal the corrected ones (proof/stable_forms.h) and keep their digits in
   double precision.  An overlay's definition replaces the one of the same name (and section, when both name one), an
   overlay's record the one with the same id, in whose section it stands unless it names another. */
#ifndef STICKSLIP_MODEL_MODEL_H
#define STICKSLIP_MODEL_MODEL_H

#include "base/record.h"
#include "expr/expr.h"
#include "tape/tape.h"

enum layer { LAYER_PRINTED, LAYER_CORRECTED, LAYER_STABLE, N_LAYERS };
extern const char *const layer_name[N_LAYERS];

/* Where a file stands; a later rank hides an earlier one. */
enum rank { RANK_PAPER, RANK_USER, RANK_ERRATA, RANK_STABLE, RANK_CONTROL };

struct definition {
  const char *name;
  const char *section;  /* "" without one */
  const char *equation; /* "" without one */
  const struct stmt *stmt;
  const struct source *src;
  const struct record *record;
  enum rank rank;
  size_t next; /* the one after it in its bucket (model.c), counted from 1; 0: none */
};

/* A record other than symbol, with its statements in order. */
struct statement_record {
  const char *id; /* of the record it replaces, for an overlay's record with "replaces: ID"; else its own */
  const char *section, *equation, *tex;
  const struct record *record;
  const struct source *src;
  enum rank rank;
  const struct stmt **stmts;
  int n_stmts;
};

/* Its tex as text with mathematics between dollar signs, outside of which stands what `gap` says for "..." */
void record_quote(struct text *out, const struct statement_record *r, const char *gap);

/* What look-ups have returned so far, by index in the model's arrays. */
struct model_use {
  bool *def, *record;
};

/* A free quantity.  Without a domain it has no value but what the model has for its name. */
struct symbol {
  const char *name;
  const struct record *record;
  const struct source *src;
  bool has_domain;
  struct {
    bool bounded, closed;
    fmpq_t at;
  } low, high; /* of the domain; low < high */
};

/* Whether the number belongs to the domain. */
bool symbol_takes(const struct symbol *s, const fmpq_t z);

enum { MODEL_BUCKETS = 256 };

struct model {
  struct arena arena;
  const char *paper;        /* the paper's title; NULL where its files say none */
  const char *paper_text;   /* the digest of its text; NULL likewise */
  const char *paper_source; /* what was read of it: "a machine conversion of ..."; NULL likewise */
  const char *options;      /* " --paper FOLDER --overlay FILE", as it was asked for; "" without them */
  const char *system;       /* what it is about, of which the program has a model; NULL where its files say nothing */
  struct record_file **files;
  enum rank *ranks; /* of the files */
  size_t n_files, cap_files, cap_ranks;
  struct definition *defs;
  size_t n_defs, cap_defs;
  struct {
    size_t first, last;
  } bucket[MODEL_BUCKETS]; /* definitions by name, each in the order of the files; counted from 1 */
  struct statement_record *records;
  size_t n_records, cap_records;
  struct symbol *symbols;
  size_t n_symbols, cap_symbols, n_own; /* n_own: with a domain */
  struct model_use *use;                /* NULL: nobody asks */
};

void model_init(struct model *m);
void model_clear(struct model *m);
/* The same model, whose look-ups are noted: of nothing so far.  The notes are to be cleared. */
struct model model_noting(struct model_use *use, const struct model *m);
/* The same model, whose look-ups are not noted. */
struct model model_unnoted(const struct model *m);
void model_use_clear(struct model_use *use);
/* Whether the record, or something that it defines, was looked up. */
bool model_use_has(const struct model_use *use, const struct model *m, size_t record);
/* Adds one file, a text that messages call by the name, or every *.eq file of a folder in the order of their names. */
bool model_add_file(struct model *m, const char *path, enum rank rank, struct diag *d);
bool model_add_text(struct model *m, const char *name, const char *text, enum rank rank, struct diag *d);
bool model_add_folder(struct model *m, const char *path, enum rank rank, struct diag *d);

/* All of a data folder: its paper, or that of another folder (paper, or NULL), the user's overlay (or NULL), the
   errata, the stable forms and the controls' damages, by rank. */
bool model_load(struct model *m, const char *data, const char *paper, const char *overlay, struct diag *d);

/* Whether the TeX of every record up to that rank, read as expr/latex_read.h says, is its statements, one for one and
   in their order; a trajectory declares and is not said.  "lo < t < hi" in the TeX is the range of the statements that
   have one in t, "a^2 = b" defines a := sqrt(b), "p = 0" the root of p.  false with d set to the first difference, with
   both places. */
bool model_check_tex(const struct model *m, enum rank last, struct diag *d);

/* What a reader sees: corrected, except that everything with the equation number `own` (may be NULL), or without a
   number and with that id, is read as printed; controls with the id `control` (may be NULL) on top. */
struct view {
  const struct model *model;
  enum layer layer;
  const char *own;
  const char *control;
};

/* The definition of a name seen from a section, or NULL with d set (undefined, or ambiguous between sections). */
const struct definition *view_lookup(const struct view *v, const char *name, const char *section, struct diag *d);
/* That of what a value such as K or H(t) names, likewise. */
const struct definition *view_lookup_value(const struct view *v, const char *value, const char *section,
                                           struct diag *d);
/* A statement of a record, with its place; of one that defines a name the definition that the view sees, which may be
   another record's. */
struct definition view_stated(const struct view *v, const struct statement_record *r, const struct stmt *s);
bool model_is_symbol(const struct model *m, const char *name);
/* The symbol of that name whose domain is declared; NULL when there is none. */
const struct symbol *model_own_symbol(const struct model *m, const char *name);
/* Whether the definition belongs to the view's layer (a higher rank may still hide it). */
bool view_sees(const struct view *v, const struct definition *def);
/* What a record of the files says, or NULL. */
const struct statement_record *model_statements(const struct model *m, const struct record *r);
/* The record of that id under the view, or NULL. */
const struct statement_record *view_record(const struct view *v, const char *id);

/* --- Elaboration --- */

/* A matrix of shared scalars; 1x1 stands for a scalar. */
struct matrix {
  int rows, cols;
  const struct expr **e; /* row-major, in the pool's arena */
};

/* A matrix name whose entries are supplied from outside (an oracle's value): they become symbols "name[i,j]". */
struct override {
  const char *name;
  int rows, cols;
};

struct elaboration {
  struct expr_pool pool;
  struct view view;
  const struct override *overrides;
  int n_overrides;
  struct tape_root *roots;
  size_t n_roots, cap_roots;
  struct elab_memo *memo;
  size_t n_memo, cap_memo;
  struct elab_call *calls; /* functions at arguments met last */
  size_t n_calls, next_call;
  int depth;
};

void elaboration_init(struct elaboration *el, struct view view, const struct override *overrides, int n_overrides);
void elaboration_clear(struct elaboration *el);

/* Elaborates an expression seen from a section.  Definitions are replaced by their bodies, functions applied,
   derivatives taken, matrices multiplied out; nothing is folded.  The literal 0 stands for a zero block or matrix where
   its neighbours give it a shape.  inv and det by cofactors up to 4x4.  Definitions and brackets may nest 1000 levels
   deep, products may have 4096 entries, and all of an elaboration's scalars together 500000.  false with d set (src
   positions) on failure. */
bool elaborate(struct matrix *out, struct elaboration *el, const struct expr *e, const struct source *src,
               const char *section, struct diag *d);
/* The same of an expression as text; messages call it by that name. */
bool elaborate_text(struct matrix *out, struct elaboration *el, const char *called, const char *text,
                    const char *section, struct diag *d);
/* Both sides of step k of a relation in one shape (a literal 0 takes the other's shape). */
bool elaborate_sides(struct matrix *lhs, struct matrix *rhs, struct elaboration *el, const struct stmt *s, int k,
                     const struct source *src, const char *section, struct diag *d);
/* Whether all sides of a relation, those of an inequality as scalars, and the ends of its range can be elaborated;
   false with d set. */
bool relation_check(struct elaboration *el, const struct stmt *s, const struct source *src, const char *section,
                    struct diag *d);

/* The definitions that this elaboration has put in, directly or inside others; NULL for one that failed. */
size_t elaboration_n_used(const struct elaboration *el);
const struct definition *elaboration_used(const struct elaboration *el, size_t i);

/* A root that it has met which has this name or whose polynomial contains it, or NULL: no derivative by the name sees
   through a root. */
const char *elaboration_root_of(struct elaboration *el, const char *name);

/* The tape of scalars of this elaboration, with the roots it has met. */
bool elaboration_tape(struct tape *t, const struct elaboration *el, const struct expr *const *outputs, slong n,
                      struct diag *d);

/* The way from text to tape: what elaborate_text makes of it, and a tape with an output for each entry.  t is empty
   when false. */
bool elaborate_tape(struct tape *t, struct matrix *out, struct elaboration *el, const char *called, const char *text,
                    const char *section, struct diag *d);

/* Elaborates every definition and statement that the view sees: names, shapes, roots. */
bool view_check(struct view v, struct diag *d);

#endif
