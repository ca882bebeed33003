/* Judges: one for each kind of claim, and what is done with what they find. */
#ifndef STICKSLIP_JUDGE_H
#define STICKSLIP_JUDGE_H

#include "claim/claim.h"
#include "record/finding.h"
#include "value/printed.h"
#include "value/sentence.h"
#include "verdict.h"

/* Fills verdict, evidence, condition, correction, effect of f.  false with j->d set when the claim cannot be read. */
typedef bool (*kind_fn)(struct finding *f, struct judge *j, const struct claim *c, struct view view);

/* The routes by which the claim is tried, the decisive one first; none where its kind has its own. */
enum { MOST_CLAIM_ROUTES = 16, ROUTE_NAME = 32 };
int claim_routes(char name[MOST_CLAIM_ROUTES][ROUTE_NAME], const struct claim *c);
/* Whether the scene asks for this route, or for all of them. */
bool route_is_asked(const struct scene *s, const char *route);
/* Of a claim that was judged: evidence by other routes goes, and with it what rested on it; says so. */
void keep_asked_routes(struct finding *f, struct judge *j, const struct claim *c);

#define JUDGE(name, word, fn, ...) bool fn(struct finding *f, struct judge *j, const struct claim *c, struct view view);
CLAIM_KINDS(JUDGE)
#undef JUDGE
/* That of the claim's kind, which there is; or, where the program can compute nothing of what the claim is about (a
   paper about another system, a quantity that the model lacks), the verdict unknown with the reason. */
bool judge_subject(struct finding *f, struct judge *j, const struct claim *c, struct view view);

/* Judges the claim again under each restriction, as V = 1; adds the findings that pass or are on record. */
bool judge_restrictions(struct judge *j, const struct claim *c, struct view view, const struct finding *refuted);

/* Whether the attribute stands there, which may only say this word: an error if it says another. */
bool judge_switch(bool *on, struct judge *j, const struct claim *c, const char *attribute, const char *word);
/* "chi = 2/5, eta = 4, ..." (NULL or wrong: an error of the claim's attribute "at"), up to a semicolon, into p, which
   is that orbit. */
bool judge_params(struct point *p, struct judge *j, const struct claim *c, const char *at);
/* Whether a constraint of the list is about u_r1 or u_r2, which no periodic solution fixes: the claim is then
   unknown. */
struct conditions;
bool constraints_leave_open(struct finding *f, struct judge *j, const struct conditions *list);
/* The verdict on record; N_VERDICTS: none for the scene. */
enum verdict claim_recorded(const struct judge *j, const struct claim *c);
/* What stands in the claim's file and in the paper, before anything is judged. */
bool finding_describe(struct finding *f, struct judge *j, const struct claim *c);
/* The claim's own finding, without its correction and restrictions. */
bool judge_verdict(struct finding *f, struct judge *j, const struct claim *c);
/* All findings of a claim, added to the result: its own, with the correction, and those that its restrictions make. */
bool judge_claim(struct judge *j, const struct claim *c);
/* A control beside its claim, whose own verdict may be among the findings of the result: what became of it is added
   there. */
bool judge_control(struct judge *j, const struct claim *control, const struct claim *claim);

/* How far the control's damage takes the claim's sentence from what it says corrected: log2 of the largest difference
   of a side, relative where that is more than 1.  false: it is not tried at points, or has no value at those tried. */
bool control_distance(double *log_distance, struct judge *j, const struct claim *c, const char *control);

/* A text read in the place of a record's statements; to be cleared whether or not it could be read.  NULL with d
   set. */
struct reread {
  struct source src;
  struct arena arena;
  const struct stmt *stmt;
  struct statement_record record;
};
const struct statement_record *reread_open(struct reread *r, const struct statement_record *in, const char *text,
                                           const char *name, struct diag *d);
void reread_clear(struct reread *r);

/* The verdict on a correction that the claim's file holds, by the claim that its attribute repaired-as names: a
   criterion reads it as its statement; a law as the heading over the branches of a mass that has the belt's velocity,
   or, with ";", as the names of its sliding and its static friction.  Their evidence becomes the finding's.  false with
   j->d set when there is no such claim. */
bool judge_repaired(struct finding *f, struct judge *j, const struct claim *c, const char *repaired);

#endif
