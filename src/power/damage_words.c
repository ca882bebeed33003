/* Damages by the character and the word: TeX, quotations, numbers, titles. */
#include <string.h>

#include "damages_impl.h"

/* --- Any value --- */

static struct span value_of(const struct maker *k) {
  return k->field->value;
}

static void change_digit(struct maker *k, size_t i) {
  char next = (char)('0' + (k->text[i] - '0' + 1) % 10);
  if (char_is_digit(k->text[i])) maker_add(k, i, i + 1, &next, 1, NULL);
}

void maker_digits(struct maker *k) {
  for (size_t i = value_of(k).begin; i < value_of(k).end; i++) change_digit(k, i);
}

static char turned(char c) {
  static const char pairs[] = "+-<>";
  const char *p = c ? strchr(pairs, c) : NULL;
  return p ? pairs[(p - pairs) ^ 1] : '\0';
}

/* A hyphen between letters is no sign. */
static bool is_hyphen(const char *text, size_t i) {
  return text[i] == '-' && i > 0 && char_is_letter(text[i - 1]) && char_is_letter(text[i + 1]);
}

void maker_signs(struct maker *k) {
  for (size_t i = value_of(k).begin; i < value_of(k).end; i++) {
    char other = turned(k->text[i]);
    if (other && !is_hyphen(k->text, i)) maker_add(k, i, i + 1, &other, 1, NULL);
  }
}

static bool is_of_word(char c) {
  return char_is_word(c) || c == '-' || c == '\'';
}

/* A part of such a list: a text for another and, unless it is one way, that for it. */
struct exchange {
  const char *was, *now;
  size_t n_was, n_now;
  bool one_way;
};

/* false behind the last part. */
static bool next_exchange(struct exchange *e, const char **list) {
  *e = (struct exchange){.was = *list, .n_was = strcspn(*list, ":|")};
  if (!*e->was) return false;
  e->one_way = e->was[e->n_was] == ':';
  e->now = e->was + e->n_was + 1;
  e->n_now = strcspn(e->now, ",");
  *list = e->now + e->n_now + strspn(e->now + e->n_now, ", ");
  return true;
}

static void exchange_word(struct maker *k, size_t i, const char *was, size_t n, const char *now, size_t n_now) {
  if (i + n <= value_of(k).end && strncmp(k->text + i, was, n) == 0 && !is_of_word(k->text[i + n]))
    maker_add(k, i, i + n, now, n_now, NULL);
}

void maker_exchange(struct maker *k, const char *list) {
  struct span v = value_of(k);
  struct exchange e;
  for (size_t i = v.begin; i < v.end; i++)
    for (const char *rest = list; (i == v.begin || !is_of_word(k->text[i - 1])) && next_exchange(&e, &rest);) {
      exchange_word(k, i, e.was, e.n_was, e.now, e.n_now);
      if (!e.one_way) exchange_word(k, i, e.now, e.n_now, e.was, e.n_was);
    }
}

/* a, b, c, d of the paper's times and states, and its other indices. */
static char other_index(char c) {
  static const char pairs[] = "abcdfcijrski";
  const char *p = c ? strchr(pairs, c) : NULL;
  if (char_is_digit(c)) return (char)(c == '1' ? '2' : c == '2' ? '1' : '0' + (c - '0' + 1) % 10);
  return p ? pairs[(p - pairs) ^ 1] : '\0';
}

static void change_index(struct maker *k, size_t i) {
  char other = other_index(k->text[i]);
  if (other) maker_add(k, i, i + 1, &other, 1, NULL);
}

void maker_index(struct maker *k) {
  for (size_t i = value_of(k).begin; i + 1 < value_of(k).end; i++)
    if (k->text[i] == '_' && char_is_letter(k->text[i + 1]) && !char_is_word(k->text[i + 2])) change_index(k, i + 1);
}

static void move_bar(struct maker *k, size_t open, size_t close) {
  size_t n = close - open - 1, relation = strcspn(k->text + open + 1, "<>");
  OWNED(text) t = {0};
  if (relation < n) { /* |x < y| becomes |x| < y */
    size_t inside = relation;
    while (inside && k->text[open + inside] == ' ') inside--;
    text_add_n(&t, k->text + open, inside + 1);
    text_add_char(&t, '|');
    text_add_n(&t, k->text + open + 1 + inside, n - inside);
  } else {
    text_add_n(&t, k->text + open + 1, n);
  }
  maker_put(k, open, close + 1, text_str(&t));
}

void maker_bars(struct maker *k) {
  size_t open = 0;
  for (size_t i = value_of(k).begin; i < value_of(k).end; i++) {
    if (k->text[i] != '|') continue;
    if (open) move_bar(k, open, i);
    open = open ? 0 : i;
  }
}

/* --- TeX --- */

/* Commands with braces behind them that are no mathematics. */
static bool is_plain_group(const char *text, size_t n) {
  return word_is(text, n, "\\text") || word_is(text, n, "\\begin") || word_is(text, n, "\\end");
}

static size_t command_length(const char *p) {
  size_t n = 1;
  while (char_is_letter(p[n])) n++;
  return n;
}

static size_t group_end(const char *text, size_t i, size_t end) {
  int open = 0;
  for (; i < end; i++) {
    open += (text[i] == '{') - (text[i] == '}');
    if (open == 0) return i + 1;
  }
  return end;
}

/* A symbol with its primes, index and exponent. */
static size_t symbol_end(const char *text, size_t i, size_t end) {
  i += text[i] == '\\' ? command_length(text + i) : 1;
  while (i < end) {
    if (text[i] == '\'')
      i++;
    else if ((text[i] == '_' || text[i] == '^') && i + 1 < end)
      i = text[i + 1] == '{' ? group_end(text, i + 1, end) : i + 2;
    else
      break;
  }
  return i;
}

/* Something stands before or behind it that it is multiplied with. */
static bool is_factor(const struct maker *k, size_t begin, size_t end) {
  struct span v = value_of(k);
  size_t i = begin, j = end;
  while (i > v.begin && k->text[i - 1] == ' ') i--;
  while (j < v.end && k->text[j] == ' ') j++;
  char before = i > v.begin ? k->text[i - 1] : '\0', after = j < v.end ? k->text[j] : '\0';
  bool command = after == '\\' && (strncmp(k->text + j, "\\chi", 4) == 0 || strncmp(k->text + j, "\\eta", 4) == 0 ||
                                   strncmp(k->text + j, "\\omega", 6) == 0);
  return char_is_letter(before) || char_is_digit(before) || before == ')' || char_is_letter(after) || after == '(' ||
         command;
}

/* Letters that are taken for one another, and commands. */
static const char similar[] =
    "\\chi|\\eta, \\lambda:\\Lambda, \\Lambda:\\Gamma, \\Gamma|\\gamma, \\omega:\\psi, \\psi|\\varphi, "
    "\\Pi:\\Gamma, \\sin|\\cos, u|v, x|z, V:v, K:k, H:N, N|M, J|I, C:G, D:O, Z:z, h|k, t:l, y:g, e:c";

static void exchange_symbol(struct maker *k, size_t i, size_t n) {
  struct exchange e;
  for (const char *rest = similar; next_exchange(&e, &rest);)
    if (n == e.n_was && strncmp(k->text + i, e.was, n) == 0)
      maker_add(k, i, i + n, e.now, e.n_now, NULL);
    else if (!e.one_way && n == e.n_now && strncmp(k->text + i, e.now, n) == 0)
      maker_add(k, i, i + n, e.was, e.n_was, NULL);
}

static bool is_accent(const char *text, size_t n) {
  return word_is(text, n, "\\bar") || word_is(text, n, "\\tilde");
}

/* \bar{h} becomes h. */
static void drop_accent(struct maker *k, size_t i, size_t n) {
  size_t end = group_end(k->text, i + n, value_of(k).end);
  if (k->text[i + n] == '{' && end > i + n + 2) maker_add(k, i, end, k->text + i + n + 1, end - i - n - 2, NULL);
}

static bool is_greek(const char *text, size_t n) {
  static const char *const letters[] = {"\\chi",   "\\eta",   "\\lambda", "\\Lambda",
                                        "\\Gamma", "\\omega", "\\psi",    "\\Pi"};
  for (size_t e = 0; e < sizeof letters / sizeof *letters; e++)
    if (word_is(text, n, letters[e])) return true;
  return false;
}

static void drop_factor(struct maker *k, size_t i) {
  size_t end = symbol_end(k->text, i, value_of(k).end);
  if (is_factor(k, i, end)) maker_put(k, i, end, "");
}

/* Where the next thing begins. */
static size_t damage_command(struct maker *k, size_t i) {
  size_t n = command_length(k->text + i), end = value_of(k).end;
  if (n == 1) return i + 2;
  if (is_plain_group(k->text + i, n)) return group_end(k->text, i + n, end);
  if (is_accent(k->text + i, n)) drop_accent(k, i, n);
  exchange_symbol(k, i, n);
  if (is_greek(k->text + i, n)) drop_factor(k, i);
  return i + n;
}

static size_t damage_index(struct maker *k, size_t i) {
  size_t end = k->text[i + 1] == '{' ? group_end(k->text, i + 1, value_of(k).end) : i + 2;
  for (size_t j = i + 1; j < end && k->text[i + 1] != '\\'; j++) {
    char other = turned(k->text[j]);
    if (other) maker_add(k, j, j + 1, &other, 1, NULL);
    change_index(k, j);
  }
  return end;
}

static size_t damage_character(struct maker *k, size_t i) {
  char c = k->text[i], other = turned(c);
  if (other) maker_add(k, i, i + 1, &other, 1, NULL);
  if (c == '\'') maker_put(k, i, i + 1, "");
  change_digit(k, i);
  if (char_is_letter(c)) {
    exchange_symbol(k, i, 1);
    drop_factor(k, i);
  }
  return i + 1;
}

static size_t find(const struct maker *k, size_t from, const char *what) {
  const char *p = strstr(k->text + from, what);
  size_t at = p ? (size_t)(p - k->text) : value_of(k).end;
  return at < value_of(k).end ? at : value_of(k).end;
}

/* The first two rows of each matrix. */
static void exchange_rows(struct maker *k) {
  size_t end = value_of(k).end;
  for (size_t i = find(k, value_of(k).begin, "\\begin{pmatrix}"); i < end; i = find(k, i, "\\begin{pmatrix}")) {
    i += strlen("\\begin{pmatrix}");
    size_t close = find(k, i, "\\end{pmatrix}"), row = find(k, i, "\\\\"), second = row + 2;
    if (row >= close) continue;
    size_t third = find(k, second, "\\\\"), to = third < close ? third : close;
    OWNED(text) t = {0};
    text_add_n(&t, k->text + second, to - second);
    text_add(&t, " \\\\ ");
    text_add_n(&t, k->text + i, row - i);
    maker_put(k, i, to, text_str(&t));
  }
}

void damage_tex(struct maker *k) {
  for (size_t i = value_of(k).begin; i < value_of(k).end;) {
    char c = k->text[i];
    i = c == '\\' ? damage_command(k, i) : c == '_' ? damage_index(k, i) : damage_character(k, i);
  }
  exchange_rows(k);
}

/* --- Sentences --- */

void damage_quotation(struct maker *k) {
  struct span v = value_of(k);
  bool mathematics = false;
  for (size_t i = v.begin; i < v.end; i++) {
    if (k->text[i] == '$') mathematics = !mathematics;
    if (mathematics || !char_is_letter(k->text[i]) || (i > v.begin && char_is_word(k->text[i - 1]))) continue;
    size_t end = i;
    while (end < v.end && (char_is_word(k->text[end]) || k->text[end] == '-')) end++;
    maker_put(k, i, end < v.end && k->text[end] == ' ' ? end + 1 : end, "");
    i = end - 1;
  }
}

static void exchange_digits(struct maker *k) {
  for (size_t i = value_of(k).begin; i + 1 < value_of(k).end; i++) {
    char two[2] = {k->text[i + 1], k->text[i]};
    if (char_is_digit(two[0]) && char_is_digit(two[1])) maker_add(k, i, i + 2, two, 2, NULL);
  }
}

/* The number behind the name. */
void damage_number(struct maker *k) {
  struct field number = *k->field;
  const struct field *all = k->field;
  while (number.value.begin < number.value.end && k->text[number.value.begin] != '=') number.value.begin++;
  k->field = &number;
  maker_digits(k);
  exchange_digits(k);
  k->field = all;
}

static const char other_words[] =
    "first|second, slip-stick|stick-slip, stick|slip, sticks|slips, sticking|slipping, above|below, lower|upper, "
    "slower|faster, start:end, starts|ends, begins:ends, increases:decreases, increasing:decreasing, "
    "positive:negative, stable|unstable, attract|repel, attracts|repels, inside|outside, more:less, before:after, "
    "always:never, every:no, constant:increasing, one:two, two:three, three|four, six:five, least:largest, "
    "velocity:position, velocities|positions, displacement:velocity, determinant|trace, lambda:omega, chi|eta, "
    "Gamma:H, H:C, C:D, D:Gamma, x|y, u|v, =:<";

void damage_title(struct maker *k) {
  maker_exchange(k, other_words);
}
