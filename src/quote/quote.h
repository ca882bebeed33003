/* Quotations held against a copy of the paper's text, token by token.

   What is quoted: `paper`, the title, and `tex` of the paper's own equation files; `quote` of the claims and of the
   list of the paper's statements; and the numbers that scenes call printed, and the data beside them that claims are
   about, each of which must be the one that ends the quotation of the claim about it (kind number, `number: NAME`).
   Errata, stable forms, overlays and controls quote nothing.

   A text is Markdown with mathematics in TeX.  It counts as its tokens, which are

     - a number with its decimals: 12, 0.6784;
     - a command, \chi; \begin and \end with the name behind them;
     - any other character alone: a letter, whether of a word or of a formula, a sign, a brace.

   Dropped, and so without any weight:

     - white space, in words too; \quad, \qquad, \, and the like, ~
     - what fences mathematics off: $, $$, \( \) \[ \]; \left and \right
     - the environments aligned and cases, which set lines below each other, with & and \\ in them or outside of any
       environment; those of a matrix count
     - an equation's number: \quad (12) at the end of a formula, before $$
     - Markdown's emphasis: * wherever no ^ or { stands before it.

   All else must be the same.  In a quotation "..." leaves something out; what stands between, a piece, ends without
   the marks . , ; : that close it.  Each piece stands in the text at a place of its own, the numbers of its first and
   its last token, counted from 1 at the beginning of the text: `place: 812-840` beside the quotation, `place: 812-840
   4410-4417` for two pieces, in the order of the text.  A place as long as its piece is asked for without a text too,
   so that no word is lost.  A piece counts as found at its place only, and where it neither begins nor ends inside a
   word nor right before the ) or } of a bracket that it opens.  Where the record that quotes names an equation, the
   number printed next behind the first piece's place, or last before it, must be that one.

   Time and memory grow with the text, which is looked through once for each piece that is not at its place. */
#ifndef STICKSLIP_QUOTE_QUOTE_H
#define STICKSLIP_QUOTE_QUOTE_H

#include "base/arena.h"
#include "claim/claim.h"

enum { MAX_QUOTED_TEXT = 4 << 20, QUOTE_DIGEST = 7 + 64 + 1 };

/* --- Texts --- */

struct quote_token {
  const char *s;
  size_t len;
};

/* A text, or a piece of a quotation; the bytes are the source's.  The numbers of its equations stand beside the tokens:
   `behind` tokens stand before one. */
struct quote_tag {
  struct quote_token number;
  size_t behind;
};
struct quote_tokens {
  struct quote_token *token;
  size_t n, cap;
  struct quote_tag *tag;
  size_t n_tags, cap_tags;
};

bool quote_token_same(const struct quote_token *a, const struct quote_token *b);
/* The tokens of len bytes, behind those that there are. */
void quote_tokens_read(struct quote_tokens *t, const char *s, size_t len);
void quote_tokens_clear(struct quote_tokens *t);
/* "sha256 " and 64 hexadecimal digits: the digest of the tokens and, where they stand, the numbers of equations in
   their parentheses, each with a line feed behind it. */
void quote_tokens_digest(char digest[QUOTE_DIGEST], const struct quote_tokens *t);

/* A copy of the paper's text. */
struct paper_text {
  struct source src;
  struct quote_tokens tokens;
};
/* At most MAX_QUOTED_TEXT bytes; false with d set, also for a text without a token.  To be cleared in any case. */
bool paper_text_read(struct paper_text *t, const char *path, struct diag *d);
void paper_text_clear(struct paper_text *t);

/* --- Quotations --- */

enum quote_kind { QUOTE_TITLE, QUOTE_TEX, QUOTE_CLAIM, QUOTE_STATEMENT, N_QUOTE_KINDS };

enum quote_outcome {
  QUOTE_FOUND,
  QUOTE_PLACELESS, /* no place is kept with it */
  QUOTE_MISNAMED,  /* at its place, where equations have other numbers than its record says */
  QUOTE_ELSEWHERE, /* not at its place, but at another */
  QUOTE_NOWHERE
};

struct quote_piece {
  struct quote_tokens tokens;
  size_t place; /* 0: none */
  enum quote_outcome outcome;
  size_t elsewhere; /* of QUOTE_ELSEWHERE: the nearest to its place */
};

struct quotation {
  enum quote_kind kind;
  const char *id;           /* of the record; "" for the title */
  const char *equation;     /* that the record names, or NULL */
  const struct source *src; /* of the file that quotes */
  const struct field *field;
  size_t first, n; /* its pieces */
};

/* A number that a scene calls printed, or a line of data beside such numbers that a claim is about. */
struct quoted_number {
  const char *line; /* of the scene, with its length */
  size_t len, scene;
  const struct quotation *of; /* of the claim about it; NULL: there is none */
  struct quote_tokens number; /* as the scene has it */
  bool same;                  /* as the claim quotes it */
};

struct quotations {
  struct quotation *item;
  size_t n, cap;
  struct quote_piece *piece; /* those of a quotation stand together, in its order */
  size_t n_pieces, cap_pieces;
  struct quoted_number *number;
  size_t n_numbers, cap_numbers;
  struct record_file *scene;
  size_t n_scenes, cap_scenes;
};

/* Everything that is quoted but for scenes; the data outlive it.  false with d set where a place is no rising list
   of one for each piece, as long as that.  quotations_clear it all the same. */
bool quotations_collect(struct quotations *q, const struct audit_data *a, struct diag *d);
/* The printed numbers of a scene, whose source it takes over; of all scenes of a data folder. */
bool quotations_add_scene(struct quotations *q, const struct claims *c, struct source src, struct diag *d);
bool quotations_add_scenes(struct quotations *q, const struct claims *c, const char *data, struct diag *d);
void quotations_clear(struct quotations *q);

/* The first place from that one on at which the piece stands in the text; 0: none. */
size_t quote_next(const struct quote_tokens *piece, const struct quote_tokens *text, size_t from);
/* Looks for every piece in the text. */
void quotations_compare(struct quotations *q, const struct quote_tokens *text);
/* Are all pieces of it at their places? */
bool quotation_found(const struct quotations *q, const struct quotation *item);

/* What is not found, in the order of the files: with the places, and both sides at the first difference; then how many
   are.  Returns whether all are. */
bool quotations_report(struct text *out, const struct quotations *q, const struct paper_text *text);

#endif
