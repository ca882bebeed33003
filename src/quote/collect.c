/* What is quoted, from the records that quote. */
#include <stdlib.h>
#include <string.h>

#include "claim/kinds.h"
#include "quote.h"
#include "scene/scene.h"

/* --- Pieces --- */

static void drop_closing_marks(struct quote_tokens *t) {
  while (t->n > 0 && t->token[t->n - 1].len == 1 && strchr(".,;:", *t->token[t->n - 1].s)) t->n--;
}

/* The text's pieces, as far as "..." leaves any. */
static void add_pieces(struct quotations *q, const char *s) {
  for (const char *gap; s; s = gap ? gap + 3 : NULL) {
    gap = strstr(s, "...");
    struct quote_piece p = {.place = 0};
    quote_tokens_read(&p.tokens, s, gap ? (size_t)(gap - s) : strlen(s));
    drop_closing_marks(&p.tokens);
    if (p.tokens.n == 0) {
      quote_tokens_clear(&p.tokens);
      continue;
    }
    *SS_PUSH(q->piece, q->n_pieces, q->cap_pieces) = p;
  }
}

/* The number at s; 0: none is there. */
static size_t read_number(const char **s) {
  size_t n = 0;
  if (**s < '1' || **s > '9') return 0;
  for (; char_is_digit(**s) && n <= MAX_QUOTED_TEXT; ++*s) n = 10 * n + (size_t)(**s - '0');
  return n <= MAX_QUOTED_TEXT ? n : 0;
}

/* FIRST-LAST of the list at s; false: it does not stand there. */
static bool read_place(const char **s, size_t *first, size_t *last) {
  *first = read_number(s);
  if (*first == 0 || **s != '-') return false;
  ++*s;
  *last = read_number(s);
  if (*last < *first || (**s && **s != ' ')) return false;
  while (**s == ' ') ++*s;
  return true;
}

static bool read_places(struct quotations *q, const struct quotation *item, const struct field *f, struct diag *d) {
  const char *s = f->text;
  size_t before = 0, first, last;
  for (size_t i = 0; i < item->n; i++) {
    struct quote_piece *p = &q->piece[item->first + i];
    if (!read_place(&s, &first, &last) || first <= before)
      return diag_at(
          d, item->src, f->value.begin,
          "a place is the numbers of the first and the last token, such as 12-17, rising from piece to piece; the "
          "quotation has %zu piece%s",
          item->n, plural_s((long long)item->n));
    if (last - first + 1 != p->tokens.n)
      return diag_at(d, item->src, f->value.begin, "%zu-%zu are %zu tokens, and %s %zu", first, last, last - first + 1,
                     item->n == 1 ? "the quotation has" : "that piece of the quotation has", p->tokens.n);
    p->place = first;
    before = last;
  }
  if (!*s) return true;
  return diag_at(d, item->src, f->value.begin, "more places than the quotation has pieces, which are %zu", item->n);
}

/* What the attribute of that name quotes, if it stands there. */
static bool add(struct quotations *q, enum quote_kind kind, const struct source *src, const struct record *r,
                const char *key, struct diag *d) {
  const struct field *f = record_field(r, key), *place = record_field(r, "place");
  bool statement = kind == QUOTE_CLAIM && f && strcmp(f->text, "statement") == 0; /* quoted there */
  if (!f || statement) return true;
  struct quotation item = {.kind = kind, .id = r->id_name ? r->id_name : "", .src = src, .field = f};
  item.equation = record_get(r, "equation");
  item.first = q->n_pieces;
  add_pieces(q, f->text);
  item.n = q->n_pieces - item.first;
  if (item.n == 0) return diag_at(d, src, f->value.begin, "nothing is quoted");
  if (place && !read_places(q, &item, place, d)) return false;
  *SS_PUSH(q->item, q->n, q->cap) = item;
  return true;
}

/* --- Printed numbers of scenes --- */

/* The claim about the printed number of that name, or NULL. */
static const struct claim *about_number(const struct claims *c, const char *name, size_t len) {
  for (size_t i = 0; i < c->n; i++) {
    const char *number = claim_get(&c->claim[i], "number");
    if (claim_kind(&c->claim[i]) == KIND_NUMBER && number && word_is(name, len, number)) return &c->claim[i];
  }
  return NULL;
}

static const struct quotation *quotation_of(const struct quotations *q, const struct claim *c) {
  for (size_t k = 0; c && k < q->n; k++)
    if (q->item[k].kind == QUOTE_CLAIM && strcmp(q->item[k].id, c->id) == 0) return &q->item[k];
  return NULL;
}

/* Does the quotation end with the relation sign and the number? */
static bool ends_with(const struct quotations *q, const struct quotation *item, const struct quote_tokens *number,
                      char sign) {
  const struct quote_tokens *t = &q->piece[item->first + item->n - 1].tokens;
  if (t->n <= number->n) return false;
  const struct quote_token *tail = t->token + t->n - number->n;
  for (size_t i = 0; i < number->n; i++)
    if (!quote_token_same(&tail[i], &number->token[i])) return false;
  return tail[-1].len == 1 && *tail[-1].s == sign;
}

/* "NAME = DECIMAL"; a line of data that no claim is about is no printed number. */
static void add_number(struct quotations *q, const struct claims *c, size_t scene, const struct field *f) {
  const char *line = q->scene[scene].src.text + f->value.begin;
  size_t len = f->value.end - f->value.begin, name = strcspn(line, " =");
  const char *equals = memchr(line, '=', len);
  const struct claim *about = about_number(c, line, name);
  if (!equals || (!f->attribute && !about)) return; /* the reader of scenes says what is wrong */
  const char *relation = about ? claim_get(about, "relation") : NULL;
  struct quoted_number n = {.line = line, .len = len, .scene = scene, .of = quotation_of(q, about)};
  quote_tokens_read(&n.number, equals + 1, (size_t)(line + len - equals) - 1);
  n.same = n.of && ends_with(q, n.of, &n.number, relation ? *relation : '=');
  *SS_PUSH(q->number, q->n_numbers, q->cap_numbers) = n;
}

/* Where some numbers are printed, the data are the paper's too. */
bool quotations_add_scene(struct quotations *q, const struct claims *c, struct source src, struct diag *d) {
  struct record_file *f = SS_PUSH(q->scene, q->n_scenes, q->cap_scenes);
  if (!record_file_parse(f, src, d)) return false;
  const struct record *r = &f->records[0];
  for (size_t k = 0; k < r->n_fields; k++)
    if (record_get(r, "printed") && (!r->fields[k].attribute || strcmp(r->fields[k].key_name, "printed") == 0))
      add_number(q, c, q->n_scenes - 1, &r->fields[k]);
  return true;
}

bool quotations_add_scenes(struct quotations *q, const struct claims *c, const char *data, struct diag *d) {
  LOCAL(arena, a);
  OWNED(text) path = {0};
  size_t n;
  text_printf(&path, "%s/scenes", data);
  FREED char **name = folder_files(&n, text_str(&path), ".scene", &a, d);
  bool ok = n > 0;
  for (size_t i = 0; ok && i < n; i++) {
    struct source src;
    ok = source_read(&src, name[i], MAX_SCENE_FILE, d) && quotations_add_scene(q, c, src, d);
  }
  return ok;
}

/* --- All of it --- */

static bool add_claims(struct quotations *q, enum quote_kind kind, const struct claims *c, struct diag *d) {
  bool ok = true;
  for (size_t i = 0; ok && i < c->n; i++) ok = add(q, kind, &c->claim[i].file->src, c->claim[i].record, "quote", d);
  return ok;
}

bool quotations_collect(struct quotations *q, const struct audit_data *a, struct diag *d) {
  const struct model *m = a->model;
  *q = (struct quotations){.n = 0};
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_files && q->n == 0; i++)
    ok = add(q, QUOTE_TITLE, &m->files[i]->src, &m->files[i]->records[0], "paper", d);
  for (size_t i = 0; ok && i < m->n_records; i++)
    if (m->records[i].rank == RANK_PAPER) ok = add(q, QUOTE_TEX, m->records[i].src, m->records[i].record, "tex", d);
  return ok && add_claims(q, QUOTE_CLAIM, a->claims, d) &&
         (!a->statements || add_claims(q, QUOTE_STATEMENT, a->statements, d));
}

void quotations_clear(struct quotations *q) {
  for (size_t i = 0; i < q->n_pieces; i++) quote_tokens_clear(&q->piece[i].tokens);
  for (size_t i = 0; i < q->n_numbers; i++) quote_tokens_clear(&q->number[i].number);
  for (size_t i = 0; i < q->n_scenes; i++) record_file_clear(&q->scene[i]);
  free(q->item);
  free(q->piece);
  free(q->number);
  free(q->scene);
  *q = (struct quotations){.n = 0};
}
