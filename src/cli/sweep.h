/* What the files of the sweep share.

   sweep       the command line, and which points are asked for
   sweep_rows  the rows of a unit of work
   sweep_file  where the rows go; taking up an interrupted file
   sweep_run   handing out units, and putting them in order
   sweep_mpi   the same over the ranks of an MPI job (make MPI=1 only) */
#ifndef STICKSLIP_SWEEP_H
#define STICKSLIP_SWEEP_H

#include "base/crew.h"
#include "base/part.h"
#include "cli.h"
#include "explore/family.h"

/* A unit of work is a stretch of one line (dyn_axis_stretch), or some whole lines of a plane, each beside the next. */
struct sweep {
  struct scene scene;
  int n_axes; /* the last one runs along the lines */
  struct scene_range range[MAX_OVER];
  struct dyn_axis axis[MAX_OVER];
  slong every, digits;
  bool all, json;
  slong unit, per_line, abreast; /* points of a unit on a line, units of a line, lines of a unit */
  slong lines, units, points;    /* how many there are */
};

/* What --over takes: the words where it has another shape, how many values, and how many without :N (0: it must be
   given). */
struct over_rule {
  const char *shape;
  unsigned long long least, most;
  slong usual;
};
/* NAME=A:B:N; other: the range that may not vary the same, or NULL.  An exit status; the axis is initialised when it is
   EXIT_AS_RECORDED. */
int parse_over(struct scene_range *r, struct dyn_axis *axis, const char *text, const struct scene_range *other,
               const struct over_rule *rule);

static inline const struct dyn_axis *sweep_line_axis(const struct sweep *q) {
  return &q->axis[q->n_axes - 1];
}

/* --- sweep_rows.c --- */

/* What stands before the first row and after the last. */
void sweep_head(struct text *out, const struct sweep *q);
void sweep_tail(struct text *out, const struct sweep *q);
/* The rows of a unit. */
void sweep_rows(struct text *out, const struct sweep *q, slong unit);

/* --- sweep_file.c --- */

struct sink {
  struct part part; /* of --csv; else rows go to stdout */
  bool to_file;
  slong done; /* units that it holds */
};
bool sink_open(struct sink *s, const struct sweep *q, const struct options *o, struct diag *d);
bool sink_write(struct sink *s, const struct text *rows, struct diag *d);
bool sink_finish(struct sink *s, const struct sweep *q, struct diag *d);
/* The exit status where one of these was false; a reader who has read enough, as behind "| head", is no error. */
int sink_failed(const struct diag *d);
void sink_clear(struct sink *s);

/* --- sweep_run.c --- */

/* From here SIGINT and SIGTERM set sweep_stopped, or no longer do. */
void sweep_listen(bool on);
bool sweep_stopped(void);
/* A crew whose items are units. */
struct crew *sweep_crew(const struct sweep *q, int jobs, struct diag *d);
/* An exit status. */
int sweep_carry_out(const struct sweep *q, struct sink *s, int jobs);

#ifdef STICKSLIP_MPI
/* --- sweep_mpi.c --- */

/* Every process calls open first and close last.  Rank 0 writes, the others compute for it; what they have to say about
   the command line, rank 0 says too, so their standard error is closed. */
void ranks_open(void);
void ranks_close(int status);
int ranks_number(void); /* this one's */
/* --jobs where none is given: the processors of this machine shared among its ranks. */
int ranks_jobs(void);
/* Ranks other than 0: computes what rank 0 asks for until it asks for no more; an exit status. */
int ranks_serve(const struct sweep *q, int jobs);

/* The other ranks, as rank 0 sees them. */
struct helpers;
struct helpers *helpers_open(const struct sweep *q);
/* Sends them home. */
void helpers_close(struct helpers *h);
/* Whether there are any. */
bool helpers_waiting(const struct helpers *h);
/* Hands the unit to a rank that has room for it; false when there is none. */
bool helpers_give(struct helpers *h, slong unit);
/* What has come: the rows of a unit, or (*lost) a unit that a lost rank had; false when nothing has. */
bool helpers_take(struct helpers *h, slong *unit, bool *lost, struct text *rows);
#endif

#endif
