/* What reports say of a claim that does not hold as printed: how bad it is, what decided it, what mends it. */
#ifndef STICKSLIP_REPORT_FINDING_H
#define STICKSLIP_REPORT_FINDING_H

#include "stickslip/result.h"

/* Whether a claim does not hold as printed. */
bool finding_fails(const struct finding *f);
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
extern const char *const grade_heading[N_GRADES];
enum grade failure_grade(const struct audit_result *r, const struct finding *f);
/* What decided: the first route that differs; the first piece of evidence where none is said to. */
const struct evidence *failure_evidence(const struct finding *f);
/* The failure before this one that the same correction mends; NULL when there is none. */
const struct finding *failure_mended_with(const struct audit_result *r, const struct finding *f);
/* The class of the fault in plain words. */
const char *failure_words(const struct finding *f);
/* Whether o says the sentence of f under a restriction that saves it. */
bool finding_restricts(const struct finding *o, const struct finding *f);
/* A printed number with the value it should have. */
bool failure_is_number(const struct finding *f);
/* A claim that asserts nothing and states something about the paper's data all the same. */
bool finding_states(const struct finding *f);

#endif
