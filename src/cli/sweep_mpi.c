/* A sweep over the processes of an MPI job.

   Rank 0 writes, and computes with a crew of its own; each other rank says how many units it has room for, and gets one
   whenever it has room.  Ranks talk by probing, so that nobody blocks: a rank says every second that it
   lives, and one that is silent for half a minute, whether it died or its machine did, is lost: its units are handed
   out again.  Rows that come after all are the same bytes, and ignored.

   Whether a job outlives a rank is up to the MPI library's launcher: Open MPI's ends the whole job unless it is told
   --enable-recovery.  What rank 0 wrote until then can be resumed. */
#include <fcntl.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"
#include "bench/bench.h"
#include "sweep.h"

enum { TAG_HELLO = 1, TAG_ALIVE, TAG_ROWS, TAG_UNIT };
enum { ALIVE_EVERY = 1, LOST_AFTER = 30, ORPHAN_AFTER = 120 }; /* seconds */
enum { MOST_UNITS = 2 * MAX_JOBS };                            /* that a rank has at a time */

static bool anyone_lost;
static int neighbours = 1; /* ranks on this machine, this one among them */

/* --- Ranks. --- */

int ranks_number(void) {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

static int ranks_count(void) {
  int n;
  MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

static void count_neighbours(void) {
  MPI_Comm here;
  if (MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here) != MPI_SUCCESS) return;
  MPI_Comm_size(here, &neighbours);
  MPI_Comm_free(&here);
}

void ranks_open(void) {
  int level;
  MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  count_neighbours();
  if (ranks_number() == 0) return;
  int nowhere =
      open("/dev/null", O_WRONLY); /* all ranks read the same command line: rank 0 says what is wrong with it */
  if (nowhere >= 0) {
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
}

void ranks_close(int status) {
  if (!anyone_lost) {
    MPI_Finalize();
    return;
  }
  fflush(NULL); /* to wait for a rank that is gone would be to wait for ever */
  MPI_Abort(MPI_COMM_WORLD, status);
}

int ranks_jobs(void) {
  long share = sysconf(_SC_NPROCESSORS_ONLN) / neighbours;
  return share < 1 ? 1 : share > MAX_JOBS ? MAX_JOBS : (int)share;
}

static bool arrived(MPI_Status *s, int from) {
  int any = 0;
  return MPI_Iprobe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &any, s) == MPI_SUCCESS && any;
}

/* The message that arrived, into text; false when its sender dies over it. */
static bool receive(struct text *body, const MPI_Status *s) {
  int len = 0, done = 0;
  MPI_Request request;
  MPI_Get_count(s, MPI_BYTE, &len);
  text_reset(body);
  for (int i = 0; i < len; i++) text_add_char(body, ' ');
  char none = 0;
  char *to = len > 0 ? body->data : &none;
  if (MPI_Irecv(to, len, MPI_BYTE, s->MPI_SOURCE, s->MPI_TAG, MPI_COMM_WORLD, &request) != MPI_SUCCESS) return false;
  for (double begun = bench_now(); !done && bench_now() - begun < LOST_AFTER;)
    if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) return false;
  if (!done) MPI_Cancel(&request);
  return done != 0;
}

static bool send_bytes(const void *data, size_t len, int to, int tag) {
  return MPI_Send(data, (int)len, MPI_BYTE, to, tag, MPI_COMM_WORLD) == MPI_SUCCESS;
}

static bool send_unit(slong unit, int to) {
  return send_bytes(&unit, sizeof unit, to, TAG_UNIT);
}

/* --- The other ranks. --- */

/* Who they are: units they have room for, and what they understood of the request. */
static bool say_hello(const struct sweep *q, int room) {
  OWNED(text) hello = {0};
  text_add_n(&hello, (const char *)&room, sizeof room);
  sweep_head(&hello, q);
  return send_bytes(hello.data, hello.len, 0, TAG_HELLO);
}

static bool send_rows(struct text *message, slong unit, const struct text *rows) {
  text_reset(message);
  text_add_n(message, (const char *)&unit, sizeof unit);
  text_add_n(message, text_str(rows), rows->len);
  return send_bytes(message->data, message->len, 0, TAG_ROWS);
}

/* Whether it goes on. */
static bool send_done(struct crew *crew, struct text *rows, struct text *message) {
  size_t unit;
  enum crew_news news = crew_take(crew, &unit, rows, 1);
  return news == CREW_ITEM ? send_rows(message, (slong)unit, rows) : news == CREW_NOTHING;
}

static bool serve(const struct sweep *q, struct crew *crew, int jobs) {
  MPI_Status s;
  OWNED(text) rows = {0}, message = {0};
  bool ok = say_hello(q, jobs + 1);
  double said = bench_now(), heard = said;
  while (ok && !sweep_stopped()) {
    slong unit = 0;
    while (ok && unit >= 0 && arrived(&s, 0)) {
      heard = bench_now();
      ok = receive(&message, &s);
      if (!ok || s.MPI_TAG != TAG_UNIT) continue;
      memcpy(&unit, message.data, sizeof unit);
      if (unit >= 0) crew_give(crew, (size_t)unit);
    }
    if (unit < 0) break;
    ok = ok && send_done(crew, &rows, &message);
    if (bench_now() - said >= ALIVE_EVERY) {
      said = bench_now();
      ok = ok && send_bytes(&ok, 0, 0, TAG_ALIVE) && said - heard < ORPHAN_AFTER;
    }
  }
  return ok;
}

int ranks_serve(const struct sweep *q, int jobs) {
  struct diag d = {0};
  struct crew *crew = sweep_crew(q, jobs, &d);
  if (!crew) return bad_input(&d);
  bool ok = serve(q, crew, jobs);
  crew_close(crew);
  return ok ? EXIT_AS_RECORDED : EXIT_INTERNAL;
}

/* --- Rank 0. --- */

struct helper {
  int room;              /* 0 until its hello */
  slong has[MOST_UNITS]; /* units */
  int n;
  double heard;
  bool lost;
};
struct helpers {
  const struct sweep *q;
  int n;
  struct helper *rank; /* that of rank 0 is not used */
  struct text body;
};

struct helpers *helpers_open(const struct sweep *q) {
  struct helpers *h = ss_malloc(sizeof *h);
  *h = (struct helpers){.q = q, .n = ranks_count()};
  h->rank = ss_malloc((size_t)h->n * sizeof *h->rank);
  memset(h->rank, 0, (size_t)h->n * sizeof *h->rank);
  for (int i = 0; i < h->n; i++) h->rank[i].heard = bench_now();
  return h;
}

void helpers_close(struct helpers *h) {
  for (int i = 1; i < h->n; i++)
    if (!h->rank[i].lost) send_unit(-1, i);
  text_clear(&h->body);
  free(h->rank);
  free(h);
}

bool helpers_waiting(const struct helpers *h) {
  bool any = false;
  for (int i = 1; i < h->n; i++) any |= !h->rank[i].lost;
  return any;
}

bool helpers_give(struct helpers *h, slong unit) {
  for (int i = 1; i < h->n; i++) {
    struct helper *r = &h->rank[i];
    if (r->lost || r->n >= r->room || !send_unit(unit, i)) continue;
    r->has[r->n++] = unit;
    return true;
  }
  return false;
}

static void lose(struct helpers *h, int rank, const char *why) {
  h->rank[rank].lost = anyone_lost = true;
  fprintf(stderr, "stickslip: warning: rank %d %s; what it had (%d units of work) is done again\n", rank, why,
          h->rank[rank].n);
}

/* It must have read the same scene, and have been built from the same sources. */
static void welcome(struct helpers *h, int rank) {
  OWNED(text) head = {0};
  int room = 0;
  sweep_head(&head, h->q);
  bool same = h->body.len == sizeof room + head.len && memcmp(h->body.data + sizeof room, head.data, head.len) == 0;
  if (same) memcpy(&room, h->body.data, sizeof room);
  h->rank[rank].room = room < 1 ? 0 : room > MOST_UNITS ? MOST_UNITS : room;
  if (!same) lose(h, rank, "understands another request");
}

/* The rows of a unit that the rank had. */
static bool rows_of(struct helpers *h, int rank, slong *unit, struct text *rows) {
  struct helper *r = &h->rank[rank];
  if (h->body.len < sizeof *unit) return false;
  memcpy(unit, h->body.data, sizeof *unit);
  for (int i = 0; i < r->n; i++) {
    if (r->has[i] != *unit) continue;
    r->has[i] = r->has[--r->n];
    text_reset(rows);
    text_add_n(rows, h->body.data + sizeof *unit, h->body.len - sizeof *unit);
    return true;
  }
  return false;
}

bool helpers_take(struct helpers *h, slong *unit, bool *lost, struct text *rows) {
  MPI_Status s;
  *lost = false;
  while (arrived(&s, MPI_ANY_SOURCE)) {
    int rank = s.MPI_SOURCE;
    if (!receive(&h->body, &s)) {
      lose(h, rank, "broke off");
      continue;
    }
    if (h->rank[rank].lost) continue;
    h->rank[rank].heard = bench_now();
    if (s.MPI_TAG == TAG_HELLO) welcome(h, rank);
    if (s.MPI_TAG == TAG_ALIVE) send_bytes(h, 0, rank, TAG_ALIVE);
    if (s.MPI_TAG == TAG_ROWS && rows_of(h, rank, unit, rows)) return true;
  }
  for (int i = 1; i < h->n; i++) {
    struct helper *r = &h->rank[i];
    if (!r->lost && bench_now() - r->heard > LOST_AFTER) lose(h, i, "is lost");
    if (!r->lost || r->n == 0) continue;
    *unit = r->has[--r->n];
    *lost = true;
    return true;
  }
  return false;
}
