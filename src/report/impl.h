/* What the writers share. */
#ifndef STICKSLIP_REPORT_IMPL_H
#define STICKSLIP_REPORT_IMPL_H

#include "stickslip/json.h"
#include "stickslip/report.h"

/* Whether LaTeX with amsmath can set the len bytes as a formula; false where that is not understood. */
bool math_is_sane(const char *s, size_t len);

/* The commands of formulas: how each is set, and its character or its width. */
enum math_role {
  MATH_LETTER,
  MATH_UPRIGHT,  /* a letter that does not lean */
  MATH_ORDINARY, /* a sign without space around it */
  MATH_OPEN,
  MATH_CLOSE,
  MATH_BINARY, /* as a plus, or a relation */
  MATH_FUNCTION,
  MATH_SPACE,
  MATH_ACCENT,
  MATH_FONT,
  MATH_TEXT,
  MATH_ROOT,
  MATH_FRACTION
};
struct math_word {
  const char *name;
  enum math_role role;
  int args;    /* braced arguments that follow */
  bool symbol; /* can be a script or an argument without braces */
  const char *text;
};
/* NULL for a command that is not one of formulas. */
const struct math_word *math_word(const char *s, size_t len);
/* Whether the len bytes are the word. */
bool math_is(const char *s, size_t len, const char *word);

/* A document in one of two dialects. */
struct sheet {
  struct text *out;
  bool tex;
};

/* Text in which $...$ is mathematics; everything else is escaped, so that it shows as it is.  Mathematics that the
   dialect might stumble over (braces that do not match, commands beyond those of formulas) is shown as code. */
void sheet_text(const struct sheet *s, const char *text);
/* One formula, without dollar signs. */
void sheet_math(const struct sheet *s, const char *math);
/* A command or a name as it is typed. */
void sheet_code(const struct sheet *s, const char *code);

/* --- Failures (failure.c) --- */

/* Whether a claim does not hold as printed. */
bool report_is_failure(const struct finding *f);
/* How bad a failure is, worst first: results of the paper that are wrong, then formulas and notation, each with those
   first that change what is derived from them. */
enum grade {
  GRADE_NUMBER,
  GRADE_FORMULA_WIDE,
  GRADE_NOTATION_WIDE,
  GRADE_ARGUMENT,
  GRADE_FORMULA,
  GRADE_NOTATION,
  N_GRADES
};
extern const char *const report_grade_heading[N_GRADES];
enum grade report_grade(const struct audit_result *r, const struct finding *f);
/* What decided: the first route that differs; the first piece of evidence where none is said to. */
const struct evidence *report_deciding(const struct finding *f);
/* The failure before this one that the same correction mends; NULL when there is none. */
const struct finding *report_mended_with(const struct audit_result *r, const struct finding *f);
/* The class of the fault in plain words. */
const char *report_fault_words(const struct finding *f);
/* Whether o says the sentence of f under a restriction that saves it. */
bool report_restricts(const struct finding *o, const struct finding *f);
/* A printed number with the value it should have. */
bool report_is_number(const struct finding *f);
/* A claim that asserts nothing and states something about the paper's data all the same. */
bool report_states(const struct finding *f);
/* Whether the claim falls with the failure, or with any when that is NULL. */
bool report_falls(const struct audit_result *r, const char *id, const char *failure);

/* --- What rests on what (graph.c) --- */

/* Nodes: the findings, then ids that findings name and that were not judged in this run. */
struct claim_graph {
  const struct audit_result *r;
  const char **id;
  size_t n, cap;
  bool *rests, *reach; /* n x n: row rests on column, directly; over any way */
};
void claim_graph_init(struct claim_graph *g, const struct audit_result *r);
void claim_graph_clear(struct claim_graph *g);
/* Whether a rests on b over something else as well; claims that rest on each other imply nothing. */
bool claim_graph_implied(const struct claim_graph *g, size_t a, size_t b);

/* The section of audit.md about consequences. */
void report_consequences(struct text *out, const struct audit_result *r);

#endif
