/* The audit: the paper's claims, judged by exact proof, in balls and by oracles that do not use the paper's formulas.

   A claim is judged with its own text as printed and everything it uses corrected.  Verdicts:

     proved       an exact identity, or enclosures that settle it on its whole domain
     conditional  refuted on the domain, proved under the condition that the finding names
     supported    agrees at every point tried by at least two independent routes; not a proof
     refuted      a certificate: exact parameters at which the two sides are disjoint, or a form that cannot be right
     unknown, skipped, definition

   An audit makes processes (fork) when jobs > 1 or the scene has a budget; a program with threads of its own says 1.
   One audit runs at a time in a process, a second one waits. */
#ifndef SS_AUDIT_H
#define SS_AUDIT_H

#include "formula.h"

#ifdef __cplusplus
extern "C" {
#endif

enum ss_verdict {
  SS_PROVED,
  SS_CONDITIONAL,
  SS_SUPPORTED,
  SS_REFUTED,
  SS_UNDECIDED, /* "unknown" */
  SS_SKIPPED,
  SS_DEFINITION,
  SS_VERDICTS /* none */
};
/* "proved", ...; NULL beyond. */
SS_API const char *ss_verdict_name(int verdict);

/* The claims on file: how many; claim i's id, "eq-40"; an attribute of it, "title", "kind", "section", "equation",
   "quote", "record" (the verdict on record) or another of the claim files; NULL where it has none. */
SS_API size_t ss_claims_count(const ss_paper *p);
SS_API const char *ss_claim_id(const ss_paper *p, size_t i);
SS_API const char *ss_claim_attribute(const ss_paper *p, size_t i, const char *name);

typedef struct ss_audit ss_audit;
/* Judges the claims that `only` selects and the scene asks for, and the controls beside them: ids with commas between,
   "eq-40" or "eq-40,num-t_a", of which eq-27 selects eq-27b too; NULL: all, which takes seconds.  The same verdicts by
   any number of jobs (processes, 1 to 64).  progress (or NULL) is told of pieces done, of all known so far.  SS_INPUT:
   nothing is selected, or the files are at fault. */
SS_API int ss_audit_run(ss_audit **out, const ss_paper *p, const ss_scene *s, const char *only, int jobs,
                        void (*progress)(void *self, size_t done, size_t of), void *self);
SS_API void ss_audit_free(ss_audit *a);
/* Findings whose verdict is not the one on record, controls that were not refuted, routes that disagree: 0 when all is
   well. */
SS_API size_t ss_audit_unexpected(const ss_audit *a);
SS_API size_t ss_audit_count(const ss_audit *a);

/* What a finding says, each as text; NULL where there is none. */
enum ss_finding_field {
  SS_FINDING_ID,
  SS_FINDING_EQUATION,
  SS_FINDING_SECTION,
  SS_FINDING_TITLE,
  SS_FINDING_QUOTE,            /* the paper's own text */
  SS_FINDING_PRINTED,          /* its formula as parsed, LaTeX, or the printed number */
  SS_FINDING_CONDITION,        /* under which it is proved: "V = 1" */
  SS_FINDING_FAULT,            /* notation, formula, number or argument */
  SS_FINDING_CORRECTION,       /* in the paper's notation */
  SS_FINDING_CORRECTION_LATEX, /* the same typeset */
  SS_FINDING_EFFECT,           /* what the fault does, and how large it is */
  SS_FINDING_REPRODUCE,        /* a command that judges it again */
  SS_FINDING_FIELDS
};
SS_API const char *ss_finding_text(const ss_audit *a, size_t i, int field);
/* Its verdict; that on record, and of its correction, SS_VERDICTS where there is none. */
SS_API enum ss_verdict ss_finding_verdict(const ss_audit *a, size_t i);
SS_API enum ss_verdict ss_finding_recorded(const ss_audit *a, size_t i);
SS_API enum ss_verdict ss_finding_corrected(const ss_audit *a, size_t i);

/* The evidence: a row for each route. */
enum ss_evidence_field {
  SS_EVIDENCE_ROUTE,    /* "balls", "taylor", ... */
  SS_EVIDENCE_LAYER,    /* whose formulas */
  SS_EVIDENCE_RESULT,   /* agrees, differs, undecided, states */
  SS_EVIDENCE_RESIDUAL, /* the order of magnitude of the largest difference */
  SS_EVIDENCE_WORST,    /* the exact point at which that is */
  SS_EVIDENCE_NOTE,
  SS_EVIDENCE_FIELDS
};
SS_API size_t ss_evidence_count(const ss_audit *a, size_t i);
SS_API const char *ss_evidence_text(const ss_audit *a, size_t i, size_t row, int field);
/* At how many points it was tried, and at how many bits at most; -1 where that says nothing. */
SS_API long ss_evidence_trials(const ss_audit *a, size_t i, size_t row);
SS_API long ss_evidence_bits(const ss_audit *a, size_t i, size_t row);

/* The whole result as audit.json, whose shape schema/ of the project describes. */
SS_API int ss_audit_json(char **out, const ss_audit *a);
/* The report, audit.json, audit.md, index.html and others, into a folder that is made if need be; all files or none. */
SS_API int ss_audit_write(const ss_audit *a, const char *folder);

#ifdef __cplusplus
}
#endif

#endif
