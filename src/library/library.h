/* The library: the public functions of include/stickslip over the rooms of the program.  One file for each public
   header, which holds the contracts.  This header is what they share: how they fail, and the handles that more than one
   of them looks into. */
#ifndef STICKSLIP_LIBRARY_H
#define STICKSLIP_LIBRARY_H

#include <stdatomic.h>

#include "claim/claim.h"
#include "route/jacobian.h"
#include "run/audit.h"
#include "stickslip.h"
#include "value/coulomb_setup.h"
#include "value/solved.h"

/* Keeps the message for ss_error() and returns the status. */
int library_fail(int status, const char *fmt, ...) SS_PRINTF(2, 3);
/* SS_INPUT, with the diagnostic's message. */
int library_input(const struct diag *d);
/* SS_ARGUMENT, about a function. */
int library_argument(const char *function, const char *what);
/* Is it a number of digits that there can be?  SS_OK or SS_ARGUMENT. */
int library_digits(const char *function, size_t digits, size_t most);
enum { LIBRARY_DIGITS = MOST_SCENE_DIGITS };
/* The text's memory becomes the caller's. */
char *library_take(struct text *t);
/* data, or where the data is; NULL, with the message kept, when it is nowhere. */
const char *library_data(const char *data);

/* One of the two; borrowed from the handle that it is part of. */
struct ss_number {
  arb_srcptr ball;
  const fmpq *exact;
};

struct ss_scene {
  struct scene s;
  char *spec, *text, *data; /* how it was asked for; text or data is NULL */
  char **set;               /* its changes, "e2=1/2" */
  int n_set;
  struct ss_number parameter[N_KEYS], *printed;
};
/* One exact set of parameters, of the paper's word?  SS_OK or SS_INPUT; forces: that gives e1 and e2. */
int library_point(const struct ss_scene *s, bool papers_word, bool forces);

/* The caller has it, and each audit whose result points into it; who is last frees it. */
struct ss_paper {
  struct paper_files files;
  atomic_int holders;
};

/* A line through a scene that gives e1 and e2, as the scene allows it; an SS_ status. */
int library_range(struct scene_range *r, const struct ss_scene *s, const char *parameter, const char *from,
                  const char *to);

#endif
