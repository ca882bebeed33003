/* Mathematics in LaTeX, token by token: the one reader of its characters and commands.  What follows from their order,
   such as a formula set on a page or an expression, is made by those who read the tokens. */
#ifndef STICKSLIP_BASE_TEX_H
#define STICKSLIP_BASE_TEX_H

#include <stdbool.h>
#include <stddef.h>

/* --- Commands --- */

/* How the command of a formula is set. */
enum tex_role {
  TEX_ROLE_LETTER,
  TEX_ROLE_UPRIGHT,  /* a letter that does not lean */
  TEX_ROLE_ORDINARY, /* a sign without space around it */
  TEX_ROLE_OPEN,
  TEX_ROLE_CLOSE,
  TEX_ROLE_BINARY, /* as a plus, or a relation */
  TEX_ROLE_FUNCTION,
  TEX_ROLE_SPACE,
  TEX_ROLE_ACCENT,
  TEX_ROLE_FONT,
  TEX_ROLE_TEXT,
  TEX_ROLE_ROOT,
  TEX_ROLE_FRACTION
};
struct tex_word {
  const char *name; /* without the backslash */
  enum tex_role role;
  int args;         /* arguments between braces that follow */
  bool symbol;      /* can be a script or an argument without braces */
  const char *text; /* the character in UTF-8, the name of a function, or the width of a space; "" for others */
};
/* The command of that name; NULL for one that is not of formulas. */
const struct tex_word *tex_word(const char *name, size_t len);
/* The name of a letter in the language of the records: eps and phi of \varepsilon and \varphi, else its own. */
const char *tex_letter_name(const struct tex_word *w);

struct tex_environment {
  const char *name, *open, *close; /* the fences around it, "" for none */
  int most_cells;                  /* in a row */
};
/* The environment of that name; NULL for one that is not of formulas. */
const struct tex_environment *tex_environment(const char *name, size_t len);

/* --- Tokens --- */

enum tex_kind {
  TEX_END,   /* nothing is left */
  TEX_BLANK, /* one space */
  TEX_LETTER,
  TEX_DIGIT,
  TEX_SIGN,    /* any other printable character of ASCII that stands for itself: + ( | . and so on */
  TEX_OPEN,    /* { */
  TEX_CLOSE,   /* } */
  TEX_RAISED,  /* ^ */
  TEX_LOWERED, /* _ */
  TEX_PRIME,   /* ' */
  TEX_CELL,    /* & */
  TEX_ROW,     /* two backslashes */
  TEX_GAP,     /* \, \: \; \! or a backslash and a blank */
  TEX_BRACE,   /* \{ or \} */
  TEX_LEFT,    /* \left and \right; what they stretch is the next token */
  TEX_RIGHT,
  TEX_BEGIN, /* \begin and \end; tex_braced reads the name behind them */
  TEX_FINISH,
  TEX_WORD,   /* a command of the table */
  TEX_STRANGE /* what formulas do not have: another command, a comment, a byte that is not printable ASCII */
};
/* The bytes are those of the source: nothing is copied. */
struct tex_token {
  enum tex_kind kind;
  const char *s;
  size_t len;                  /* 0 for TEX_END only */
  const struct tex_word *word; /* of TEX_WORD, else NULL */
};
/* The token that begins at s; it ends at `end` at the latest. */
struct tex_token tex_read(const char *s, const char *end);

/* The length of the number whose first digit stands at s: a point belongs to it where a digit follows, for one behind
   the last digit ends a sentence. */
size_t tex_number_length(const char *s, const char *end);
/* What stands between a brace at s and the next closing one, with its length; NULL where s is no opening brace or none
   closes. */
const char *tex_braced(size_t *len, const char *s, const char *end);

#endif
