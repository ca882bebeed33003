/* What several reports ask the record about a claim: whether it fails, how bad that is, what decided it, what mends
   it. */
#ifndef STICKSLIP_REPORT_FINDING_H
#define STICKSLIP_REPORT_FINDING_H

#include "record/result.h"

/* --- Any claim --- */

/* Whether it does not hold as printed. */
bool finding_fails(const struct finding *f);
/* Whether o says the sentence of f under a restriction that saves it. */
bool finding_restricts(const struct finding *o, const struct finding *f);
/* The paper's own text and the formula as read, where a part decides that part alone; NULL without one. */
const char *finding_quote(const struct finding *f);
const char *finding_printed(const struct finding *f);
/* The value of that name in its certificate, or NULL; e_1 and e_2, state and times of the orbit there, "e_1 = 2.73,
   ..., t_d = 3.49", or nothing. */
const char *finding_certified(const struct finding *f, const char *name);
void finding_orbit(struct text *out, const struct finding *f);
/* Behind a route, ", 24 trials, 128 bits", as far as it has them. */
void evidence_extent(struct text *out, const struct evidence *e);
/* The command that judges it again. */
const char *finding_recheck(const struct finding *f);

/* --- Failures --- */

/* What decided: the first route that differs; the first piece of evidence where none is said to. */
const struct evidence *failure_evidence(const struct finding *f);
/* The failure before this one that the same correction mends; NULL when there is none. */
const struct finding *failure_mended_with(const struct audit_result *r, const struct finding *f);
/* Before what the claim says: that it does not hold, or not in general; empty where it holds. */
const char *failure_heading(const struct finding *f);
/* Before its correction, which may be refuted, too. */
const char *correction_heading(const struct finding *f);
/* The class of the fault, N_FAULTS where none is named; the same in plain words. */
enum fault failure_fault(const struct finding *f);
const char *failure_words(const struct audit_result *r, const struct finding *f);
/* Whether it is a printed number with the value it should have. */
bool failure_is_number(const struct finding *f);
/* The right value of the printed number that the root's claim is about, as LaTeX: "t_{a} = 0.5323"; NULL for another
   claim. */
const char *root_value(const struct audit_result *r, const struct root_cause *root, int claim);
struct sheet;
/* What is wrong, the right numbers where it is numbers, what should stand there, what comes of it, how to see it. */
void root_say(const struct sheet *s, const struct audit_result *r, const struct root_cause *root);
/* The root of the wrong numbers; NULL where there are none. */
const struct root_cause *audit_root_of_numbers(const struct audit_result *r);
/* What became of the paper's statements: "Of the 144 statements of the paper that assert something, 113 have been
   proved, 11 hold under a condition, 19 do not hold as printed, 6 of them about the numbers of the example; 1 could not
   be decided". */
void verdicts_say(struct text *out, const struct audit_result *r);
/* The first of the quantities derived from it to which that happens, behind the last one; NULL when there is no
   more. */
const struct derived *derived_next(const struct consequence *q, const struct derived *last, enum change change);
/* The formulas of all of them with what was found, between two texts; nothing where there are none. */
void derived_list(const struct sheet *s, const struct consequence *q, enum change change, const char *begin,
                  const char *end);
/* How large the effect is; NULL where that is not known. */
const char *failure_size(const struct audit_result *r, const struct finding *f);

/* --- The record --- */

/* How the paper was judged, in a sentence. */
const char *audit_method(const struct audit_result *r);
/* What the data are, in a sentence, where the record names them; else nothing. */
void audit_data(struct text *out, const struct audit_result *r);
/* The command that repeats the audit, by what is given with its claims; without one, that of the usual scene. */
void audit_recheck(struct text *out, const struct audit_result *r);
/* Statements made wrong on purpose that this run has noticed. */
size_t controls_noticed(const struct audit_result *r);

/* One of them, and several: "remark", "remarks". */
extern const char *const severity_words[N_SEVERITIES][2];
/* Over the roots of that severity. */
extern const char *const severity_heading[N_SEVERITIES];
/* What stands before the correction: "Should read", or "Suggested" where nothing is wrong as printed. */
extern const char *const severity_correction[N_SEVERITIES];

/* The readings that give every printed number: that which assumes least; NULL without one. */
const struct example_reading *best_reading(const struct audit_result *r);
/* How the printed numbers arose by it: which were data, what was not solved, where the start comes from. */
void reading_say(const struct sheet *s, const struct example_reading *e);

#endif
