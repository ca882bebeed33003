/* Would the audit have noticed damaged data?  Each class has its own draw, so that its score says something however
   many damages it has. */
#include "mutate_data.h"

#include <stdlib.h>
#include <string.h>

#include "base/random.h"

/* Selection sampling: the order is kept. */
size_t *draw_some(size_t *n_drawn, size_t n, size_t wanted, uint64_t *state) {
  size_t *drawn = ss_malloc((n + 1) * sizeof *drawn);
  if (wanted == 0 || wanted > n) wanted = n;
  *n_drawn = 0;
  for (size_t i = 0; i < n && *n_drawn < wanted; i++)
    if (random_next(state) % (n - i) < wanted - *n_drawn) drawn[(*n_drawn)++] = i;
  return drawn;
}

struct data_run {
  const struct material *m;
  const struct damages *damages;
  struct damage_study *study;
  size_t *drawn; /* indices of damages, ascending */
  size_t n_drawn;
};

/* The damages of a class stand together. */
static void draw_classes(struct data_run *r, const struct mutation_options *opt) {
  const struct damages *all = r->damages;
  uint64_t state = opt->seed;
  size_t wanted = ((size_t)opt->count + 3) / 4;
  r->drawn = ss_malloc((all->n + 1) * sizeof *r->drawn);
  for (size_t from = 0, to; from < all->n; from = to) {
    size_t n;
    for (to = from; to < all->n && all->damage[to].class == all->damage[from].class;) to++;
    FREED size_t *some = draw_some(&n, to - from, wanted, &state);
    for (size_t i = 0; i < n; i++) r->drawn[r->n_drawn++] = from + some[i];
  }
}

size_t mutate_data_count(const struct damages *damages, const struct mutation_options *opt) {
  struct data_run r = {.damages = damages};
  draw_classes(&r, opt);
  free(r.drawn);
  return r.n_drawn;
}

static void try_one(void *result, size_t i, void *arg) {
  struct data_run *r = arg;
  damage_try(result, r->study, &r->damages->damage[r->drawn[i]]);
}

/* --- The report --- */

enum { EXAMPLES = 3, SHOWN = 90 };

/* Some bytes on one line, with a few words around them where they are few. */
static const char *shown(struct mutation_result *out, const char *text, size_t begin, size_t end) {
  struct text t = {0};
  for (size_t i = begin; i < end; i++)
    if (text[i] != '\n')
      text_add_char(&t, text[i]);
    else if (i + 1 < end)
      text_add(&t, " / ");
  t.len = text_valid_prefix(text_str(&t), t.len < SHOWN ? t.len : SHOWN);
  return text_take(&out->arena, &t);
}

/* What stood and what stands there, from the beginning of a word to the end of one. */
static void show_place(struct damaged *g, struct mutation_result *out, const struct source *src,
                       const struct damage *d) {
  size_t begin = d->begin, end = d->end, line, column;
  while (begin > 0 && d->begin - begin < SHOWN / 4 && !strchr(" \n", src->text[begin - 1])) begin--;
  while (end < src->len && end - d->end < SHOWN / 4 && !strchr(" \n", src->text[end])) end++;
  bool lines = d->end > d->begin && src->text[d->end - 1] == '\n';
  g->was = shown(out, src->text, begin, lines ? d->end : end);
  OWNED(text) now = {0};
  text_add_n(&now, src->text + begin, d->begin - begin);
  text_add(&now, d->now);
  if (!lines) text_add_n(&now, src->text + d->end, end - d->end);
  g->now = shown(out, text_str(&now), 0, now.len);
  source_place(&line, &column, src, d->begin);
  g->line = (long)line;
}

static void keep_damaged(struct mutation_result *out, const struct data_run *r, const struct damage *d,
                         const struct damage_said *said) {
  const struct material_file *f = &r->m->file[d->file];
  struct damaged g = {.class = d->class, .fate = said->fate};
  g.file = arena_strdup(&out->arena, f->name);
  g.record = arena_strdup(&out->arena, d->record);
  g.attribute = arena_strdup(&out->arena, d->attribute);
  g.says = arena_strdup(&out->arena, said->says);
  show_place(&g, out, &f->parsed->src, d);
  *SS_PUSH(out->damaged, out->n_damaged, out->cap_damaged) = g;
}

static void report(struct mutation_result *out, const struct data_run *r, const struct damage_said *said) {
  int examples[N_DAMAGE_CLASSES][N_MUTANT_FATES] = {{0}};
  out->population += (long)r->damages->n;
  out->tried += (long)r->n_drawn;
  for (size_t i = 0; i < r->n_drawn; i++) {
    const struct damage *d = &r->damages->damage[r->drawn[i]];
    enum mutant_fate fate = said[i].fate;
    out->data[d->class].count[fate]++;
    if (fate == FATE_UNDECIDED || examples[d->class][fate]++ < EXAMPLES) keep_damaged(out, r, d, &said[i]);
  }
}

bool mutate_data(struct mutation_result *out, const struct material *m, const struct damages *damages,
                 const struct mutation_options *opt, struct crew_tally *tally, struct diag *d) {
  struct data_run r = {.m = m, .damages = damages, .study = damage_study_new(m, opt->text)};
  draw_classes(&r, opt);
  FREED struct damage_said *said = ss_malloc((r.n_drawn + 1) * sizeof *said);
  bool ok = crew_results(said, sizeof *said, r.n_drawn, opt->jobs, try_one, &r, tally, d);
  if (ok) report(out, &r, said);
  free(r.drawn);
  damage_study_free(r.study);
  return ok;
}
