/* What a scene asks: lists are cut at commas and checked as far as a scene alone can be; claims and quantities are
   looked up when the files that hold them are there. */
#include <stdlib.h>
#include <string.h>

#include "claim/claims.h"
#include "record/routes.h"
#include "scene_impl.h"

/* --- Lists --- */

/* From a place to the next byte that is neither blank nor in a line of comment. */
static size_t skip_blanks(const char *s, size_t i, size_t end, size_t begin) {
  while (i < end && (scene_blank(s[i]) || s[i] == '#')) {
    if (s[i] == '#') {
      size_t line = i;
      while (line > begin && (s[line - 1] == ' ' || s[line - 1] == '\t')) line--;
      if (line == begin || s[line - 1] != '\n') break;
      while (i < end && s[i] != '\n') i++;
    } else {
      i++;
    }
  }
  return i;
}

/* The next item into out, blanks within it as one; a comma in brackets belongs to it.  Returns where it ends. */
static size_t next_item(struct text *out, const char *s, size_t i, size_t end, size_t begin) {
  int open = 0;
  text_reset(out);
  while (i < end && (open > 0 || s[i] != ',')) {
    open += s[i] == '(' || s[i] == '[';
    open -= s[i] == ')' || s[i] == ']';
    text_add_char(out, s[i++]);
    size_t next = skip_blanks(s, i, end, begin);
    if (next > i && next < end && s[next] != ',') text_add_char(out, ' ');
    i = next;
  }
  return i;
}

static bool complain(const struct scene_line *l, size_t at, struct diag *d, const char *fmt, const char *what) {
  return diag_at(d, l->src, at, fmt, what);
}

static bool add_item(struct scene_list *list, const struct scene_line *l, struct span at, const char *item,
                     struct diag *d) {
  if (!*item)
    return complain(l, at.begin, d, "an empty item in the list of %s; one comma between two", scene_key_name[l->key]);
  if (word_find(item, (const char *const *)list->item, (int)list->n) < (int)list->n)
    return complain(l, at.begin, d, "%.100s stands twice in this list; once is enough", item);
  if (list->n == MAX_SCENE_LIST)
    return complain(l, at.begin, d, "more than 1000 items in the list of %s", scene_key_name[l->key]);
  size_t cap = list->cap;
  list->item = ss_grow(list->item, list->n, &list->cap, sizeof *list->item);
  list->place = ss_grow(list->place, list->n, &cap, sizeof *list->place);
  list->item[list->n] = ss_strdup(item);
  list->place[list->n++] = at;
  return true;
}

static bool read_list(struct scene_list *list, const struct scene_line *l, struct diag *d) {
  const char *s = l->src->text;
  OWNED(text) item = {0};
  list->source = l->src;
  bool ok = true;
  size_t i = skip_blanks(s, l->value.begin, l->value.end, l->value.begin);
  for (bool more = true; ok && more;) {
    size_t begin = i;
    i = next_item(&item, s, i, l->value.end, l->value.begin);
    ok = add_item(list, l, (struct span){begin, i}, text_str(&item), d);
    more = i < l->value.end;
    i = skip_blanks(s, i + more, l->value.end, l->value.begin);
  }
  return ok;
}

static void list_clear(struct scene_list *list) {
  for (size_t i = 0; i < list->n; i++) free(list->item[i]);
  free(list->item);
  free(list->place);
}

void scene_asked_clear(struct scene_asked *a) {
  list_clear(&a->claims);
  list_clear(&a->values);
  list_clear(&a->routes);
}

/* --- What needs nothing but the scene --- */

static bool check_claims(const struct scene_list *list, struct diag *d) {
  for (size_t i = 0; i < list->n; i++) {
    if (!strchr(list->item[i], ' ') || claim_group_known(list->item[i])) continue;
    OWNED(text) groups = {0};
    claim_groups_print(&groups);
    return diag_at(d, list->source, list->place[i].begin, "%.100s is no group of claims; groups are %s", list->item[i],
                   text_str(&groups));
  }
  return true;
}

static void print_routes(struct text *out) {
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    const char *name = route_first_called(i);
    if (name) text_printf(out, "%s%s", out->len ? ", " : "", name);
  }
}

static bool check_routes(const struct scene_list *list, struct diag *d) {
  for (size_t i = 0; i < list->n; i++) {
    if (route_is_known(list->item[i])) continue;
    OWNED(text) routes = {0};
    print_routes(&routes);
    return diag_at(d, list->source, list->place[i].begin, "unknown route %.100s; routes are %s", list->item[i],
                   text_str(&routes));
  }
  return true;
}

/* The quantity as a tree: a name, a function of an argument, an entry of one of them, a trace or a determinant. */
const struct expr *scene_quantity(struct arena *a, const struct scene_list *list, size_t i, struct diag *d) {
  const struct expr *e = expr_parse(a, list->source, list->place[i], d);
  const struct expr *inner = e;
  if (inner && (inner->kind == EXPR_TR || inner->kind == EXPR_DET)) inner = inner->args[0];
  while (inner && inner->kind == EXPR_INDEX) inner = inner->args[0];
  if (e && inner->kind != EXPR_SYM && inner->kind != EXPR_CALL) {
    diag_at(d, list->source, list->place[i].begin,
            "%.100s is no quantity; write a name, an entry or a trace, as in z10, H(t_c)[1,3], trace_J", list->item[i]);
    return NULL;
  }
  return e;
}

static bool check_quantities(const struct scene_list *list, struct diag *d) {
  bool ok = true;
  for (size_t i = 0; ok && i < list->n; i++) {
    LOCAL(arena, a);
    ok = scene_quantity(&a, list, i, d) != NULL;
  }
  return ok;
}

static bool read_whole(unsigned long long *n, const struct scene_line *l, unsigned long long most, const char *limits,
                       struct diag *d) {
  *n = 0;
  const char *p = l->text;
  for (; *p >= '0' && *p <= '9' && *n <= most; p++) *n = 10 * *n + (unsigned)(*p - '0');
  return (p > l->text && !*p && *n > 0 && *n <= most) || complain(l, l->value.begin, d, limits, scene_key_name[l->key]);
}

bool scene_read_asked(struct scene_asked *a, const struct scene_line *l, struct diag *d) {
  unsigned long long n;
  switch (scene_keys[l->key].takes) {
  case TAKES_CLAIMS:
    return read_list(&a->claims, l, d) && check_claims(&a->claims, d);
  case TAKES_QUANTITIES:
    return read_list(&a->values, l, d) && check_quantities(&a->values, d);
  case TAKES_ROUTES:
    return read_list(&a->routes, l, d) && check_routes(&a->routes, d);
  case TAKES_DIGITS:
    if (!read_whole(&n, l, MOST_SCENE_DIGITS, "%s takes a whole number from 1 to 100000", d)) return false;
    a->digits = (long)n;
    return true;
  case TAKES_BUDGET:
    return read_whole(&a->budget, l, MOST_SCENE_BUDGET, "%s takes a whole number from 1 to 10^18", d);
  default:
    abort();
  }
}
