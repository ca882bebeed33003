/* What a claim's file says of it: its kind, what it is about, what it makes, what corrects it, what rests on it. */
#ifndef STICKSLIP_CLAIM_H
#define STICKSLIP_CLAIM_H

#include "judging.h"
#include "kinds.h"
#include "model/model.h"
#include "record/result.h"

/* Do the items of --only select the claim, by its own id or by one that a restriction of it makes?  And does every item
   of --only select some claim? */
bool claims_selects(const char *const *only, int n_only, const struct claim *c);
bool claims_check_selection(const struct claims *claims, const char *const *only, int n_only, struct diag *d);
/* The error that no claim has the id, with those that may have been meant; false. */
bool claims_unknown(const struct claims *claims, const char *id, struct diag *d);

enum { CLAIM_NAME = 32 };
/* Items of a list separated by commas or blanks, at most max; how many there are. */
int claim_names_listed(char (*names)[CLAIM_NAME], int max, const char *list);
/* The next item of a list separated by commas, without blanks at its ends, into buf; where the rest begins, or NULL at
   the end, or where there is no list. */
const char *claim_next_item(char *buf, size_t size, const char *list);
/* Is it an item of the list that is the attribute? */
bool claim_lists(const struct claim *c, const char *key, const char *item);
/* A record that an argument cites: "eq-52#1.2 D" is step 2 of statement 1, in phase D; 0 or "" for all of them. */
struct cited {
  char id[48], phase[16];
  int statement, step;
  bool misnumbered; /* no number, or none from 1 on, stands behind the # */
};
/* The first item of the list; where the rest begins, or NULL where there is none. */
const char *claim_next_cited(struct cited *out, const char *list);
/* Do both cite some step in common; does one of the list with this one; do two lists? */
bool cited_overlap(const struct cited *a, const struct cited *b);
bool cited_share(const char *a, const char *b);
/* A formula that is an attribute of a claim or a result, or NULL; where it cites a statement, "eq-53#2", what that sets
   beside a symbol, its right side where that can be, in the arena.  A citation of what is not there, or of a statement
   with no symbol alone on a side, is returned as it is, and is no formula. */
const char *claim_formula(struct arena *a, const struct model *m, const struct claim *c, const char *key);
/* How the symbol stands to it there: '=', '<' or '>'; '?': no symbol is alone on a side; '\0': nothing is cited. */
char claim_formula_relation(const struct model *m, const struct claim *c, const char *key);
/* Whether the claim is an argument whose conclusion is more than its premises in other words, over all orbits: then
   what cites the conclusion rests on it. */
bool claim_deduces(const struct claim *c);
/* The claim of that id, or NULL. */
const struct claim *claim_named(const struct claims *claims, const char *id);
/* The first of n records, claims, statements or roots, on whose list of that name the id stands; or NULL. */
const struct claim *claims_listing(const struct claims *claims, size_t n, const char *key, const char *id);
/* Is the id that of a claim which a restriction of this one makes? */
bool claim_makes(const struct claim *c, const char *id);
/* A claim that is made where a condition holds: an item of the attribute restricted. */
struct made_claim {
  char condition[32], record[16], id[CLAIM_NAME];
};
/* The first item of the list; where the rest begins, or NULL where there is none. */
const char *claim_next_made(struct made_claim *out, const char *list);
/* The claim of that id, or the one that makes it, or NULL. */
const struct claim *claim_answering(const struct claims *claims, const char *id);
/* Appends, behind the prefix and a line each, the formulas that the claim is about as it reads them, in the notation of
   the files; how many. */
int claim_formulas(struct text *out, const struct model *m, const struct claim *c, const char *prefix);
/* How a claim is read: its own text as printed, the rest corrected. */
struct view claim_view(const struct model *m, const struct claim *c);
/* Is the record of the paper's files what the claim is about: its statement; or, for a value, a definition under the
   claim's equation number, since a formula is printed together with its parts? */
bool claim_is_about(const struct statement_record *r, const struct claim *c);
/* Has an overlay another text in the place of that? */
bool claim_is_altered(const struct model *m, const struct claim *c);
/* Is it a definition under the claim's equation number? */
bool claim_numbers(const struct claim *c, const struct statement_record *r);
/* Whether an erratum is about the claim: it replaces its statement or, not by statement, defines something anew under
   the claim's equation number. */
bool erratum_is_about(const struct statement_record *r, const struct claim *c, bool by_statement);
/* Is there one that replaces the claim's statement? */
bool erratum_replaces(const struct model *m, const struct claim *c);
/* The correction of a claim and what it replaces as LaTeX, and where they differ. */
void erratum_typeset(struct finding *f, struct judge *j, const struct claim *c);
/* Whether the correction that errata.eq holds for the claim puts other symbols in the place of symbols, in the argument
   of a function anything, or keeps some of the readings of an index, and does nothing else. */
bool erratum_renames(const struct model *m, const struct claim *c);
/* The class of the claim's refutation: its kind's; of an identity or a matrix, whose sides are held against each other,
   an argument's where an inequality is claimed, else a slip of notation where the correction only renames, else a
   formula's.  A text that cannot be read at all is a slip of notation, whatever stands here. */
enum fault claim_fault(const struct model *m, const struct claim *c);
/* Whether it is tried at points: by its kind or, of an inequality, since it is between the symbols of a paper about
   another system. */
bool claim_judged_at_points(const struct model *m, const struct claim *c);
/* The correction that errata.eq holds for the sentence of a claim; false when it holds none. */
bool erratum_text(struct text *out, const struct model *m, const struct claim *c);

/* --- The files (files.c) --- */

/* All that an audit reads of a data folder besides scenes. */
struct paper_files {
  struct model model;
  struct claims claims, controls, statements, roots;
};

void paper_files_init(struct paper_files *f);
/* paper: NULL, or the folder of a paper in the place of the data folder's; overlay: NULL, or a file of corrections. */
bool paper_files_load(struct paper_files *f, const char *data, const char *paper, const char *overlay, struct diag *d);
void paper_files_clear(struct paper_files *f);

/* --- What can be checked without judging (check.c) --- */

/* The same as it is handed on, or a part of it. */
struct audit_data {
  const struct model *model;
  const struct claims *claims, *controls;
  const struct claims *statements; /* of the paper; NULL: they are not asked */
  const struct claims *roots;      /* of discrepancies; NULL likewise */
};

/* Every check that is made of the data when they have been loaded, by verify, and by mutate of damaged data: false with
   d set, at the place, by the first that fails. */
bool data_check(const struct audit_data *a, struct diag *d);
/* The part of it that is about claims (and results), or controls, alone. */
bool claims_check(const struct claims *c, bool controls, struct diag *d);

/* --- What rests on what (depends.c) --- */

/* Of all the claims, each with its own text as printed and all else corrected; model and claims must stay.  What a
   claim reaches is found when it is first asked for. */
struct dependences *dependences_new(const struct model *m, const struct claims *claims);
void dependences_free(struct dependences *d);
/* Whether the formulas of claim a reach what claim b is about; indices in the claims. */
bool dependences_on(struct dependences *d, size_t a, size_t b);
/* The definitions that the formulas of claim a reach. */
size_t dependences_n_used(struct dependences *d, size_t a);
const struct definition *dependences_used(struct dependences *d, size_t a, size_t i);
/* Whether they reach a definition that is corrected under this equation number. */
bool dependences_corrected(struct dependences *d, size_t a, const char *equation);
/* Whether claim a rests on claim b at all: by its formulas, by what it cites, or as it names by hand. */
bool dependences_any(struct dependences *d, size_t a, size_t b);
/* Fills depends_on: all of these, in the order of the claims. */
bool dependences_list(struct finding *f, struct judge *j, const struct claim *c);

/* --- Rules that no claim breaks silently (rules.c) --- */

/* One claim by itself: its points and routes are as many as its kind asks, or its attribute few says why not; an
   argument's conclusion is not among its premises; the words of transition and side, and the first of given, are those
   of its sentence.  false with d set at the place. */
bool claim_keeps_rules(const struct model *m, const struct claim *c, struct diag *d);
/* All of them, and what they have together: nothing rests on itself through others; every correction in the errata is
   one of a claim; every kind, and every kind of correction, has its controls. */
bool claims_keep_rules(const struct model *m, const struct claims *claims, const struct claims *controls,
                       struct diag *d);

/* Whether the file says in its first line, "count: N", how many records it holds: one that is lost is missed. */
bool records_counted(const struct record_file *f, struct diag *d);

/* --- The paper's statements (statements.c) --- */

/* Records "statement ID" of files *.statements beside the paper's equations, in the order of the paper:

     quote     what it says, or a few words that find it in the text, and it alone; place: where (quote/quote.h)
     equation  the number that is printed at it
     claims    what answers what it asserts; or
     reason    why nothing does
     checks    the suite's own claims around it: a claim that no statement names under claims is of the suite */
/* One by itself. */
bool statement_check(const struct claim *s, struct diag *d);
/* All together: the claims that they name are there, each under claims or under checks; each claim is named; and each
   equation number of the paper, up to the last, stands at some statement. */
bool statements_keep_rules(const struct model *m, const struct claims *claims, const struct claims *statements,
                           struct diag *d);
/* Those without claims, by reason, among what is left out. */
void statements_unanswered(struct audit_result *out, const struct claims *statements);
/* Whether some statement has the claim of that id to answer it. */
bool statements_claim(const struct claims *statements, const char *id);

/* --- The roots of discrepancies (roots.c) --- */

/* Records "root ID" of files *.roots beside the claims, in order of consequence: those of substance first, then
   remarks, then slips of notation.

     title        what it is about
     severity     substance, remark or notation
     where        the numbers or sections of the paper
     wrong, correct, consequence   sentences, with TeX between dollar signs.  In correct {err-40}, outside of TeX, is
                  the TeX of that record of errata.eq, or of the paper, and {text-free-index.repaired} what the claim's
                  own file says in its place
     by-hand      one way to see it; may be missing
     claims       those that fail for it */
bool root_check(const struct claim *root, struct diag *d);
/* All together: the claims that they name are there, each at one root; where errata.eq or a claim's own file corrects
   it, its root cites that, or has the corrected symbols in their order; a claim on record as refuted or conditional has
   a root. */
bool roots_keep_rules(const struct model *m, const struct claims *claims, const struct claims *roots, struct diag *d);
/* Says of each finding whose it is and, where it fails, of what root; adds the roots that have such findings.  false
   with d set where a root cites what is not there. */
bool roots_attach(struct audit_result *out, const struct model *m, const struct claims *claims,
                  const struct claims *statements, const struct claims *roots, struct diag *d);

#endif
