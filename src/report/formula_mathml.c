/* TeX to MathML.  What the checker of formulas accepts is set by descent along the braces; nothing else is tried, so
   that each function may rely on groups that close and arguments that are there.  Presentation MathML as browsers draw
   it (MathML Core): italics are theirs, the form of a sign is said where its place in the row would mislead. */
#include <string.h>

#include "escape.h"
#include "formula.h"

/* What stands before the next sign: a minus after an operator is that of a number. */
enum before { BEFORE_NOTHING, BEFORE_OPERATOR, BEFORE_ATOM };

struct setter {
  struct text *out;
  struct tex_token t; /* the next one */
  const char *end;
  const char *whole; /* where the marks count from */
  const bool *changed;
  bool continued; /* the formula was broken before its first sign */
  enum before before;
};

static void set_row(struct setter *m);

/* Goes on at s. */
static void go_to(struct setter *m, const char *s) {
  m->t = tex_read(s, m->end);
}

static void pass(struct setter *m) {
  go_to(m, m->t.s + m->t.len);
}

static void skip_blanks(struct setter *m) {
  while (m->t.kind == TEX_BLANK) pass(m);
}

static bool is_function(const struct tex_token *t) {
  return t->kind == TEX_WORD && t->word->role == TEX_ROLE_FUNCTION;
}

/* Puts what has been written since `at` between two tags. */
static void wrap(struct text *out, size_t at, const char *open, const char *close) {
  size_t n = strlen(open), tail = out->len - at;
  text_add(out, open);
  memmove(out->data + at + n, out->data + at, tail);
  memcpy(out->data + at, open, n);
  text_add(out, close);
}

/* --- Atoms --- */

static void set_sign(struct setter *m, const char *attributes, const char *s, size_t len, enum before after) {
  text_printf(m->out, "<mo%s>", attributes);
  escape_html(m->out, s, len);
  text_add(m->out, "</mo>");
  m->before = after;
}

static void set_binary(struct setter *m, const char *s, size_t len) {
  const char *form = m->continued ? " form=\"infix\"" : m->before == BEFORE_ATOM ? "" : " form=\"prefix\"";
  set_sign(m, form, s, len, BEFORE_OPERATOR);
}

static void set_character(struct setter *m) {
  const char *c = m->t.s;
  if (*c == '-')
    set_binary(m, "\xe2\x88\x92", 3);
  else if (*c == '+')
    set_binary(m, c, 1);
  else if (strchr("=<>:,;", *c))
    set_sign(m, "", c, 1, BEFORE_OPERATOR);
  else if (strchr("([", *c))
    set_sign(m, " stretchy=\"false\"", c, 1, BEFORE_NOTHING);
  else if (strchr(")]", *c))
    set_sign(m, " stretchy=\"false\"", c, 1, BEFORE_ATOM);
  else if (*c == '|')
    set_sign(m, " stretchy=\"false\" lspace=\"0\" rspace=\"0\"", c, 1, BEFORE_ATOM);
  else
    set_sign(m, "", c, 1, BEFORE_ATOM);
  pass(m);
}

static void set_number(struct setter *m, size_t len) {
  text_printf(m->out, "<mn>%.*s</mn>", (int)len, m->t.s);
  go_to(m, m->t.s + len);
  m->before = BEFORE_ATOM;
}

static void set_letter(struct setter *m) {
  text_printf(m->out, "<mi>%c</mi>", *m->t.s);
  pass(m);
  m->before = BEFORE_ATOM;
}

/* {...} as one element. */
static void set_group(struct setter *m) {
  skip_blanks(m);
  pass(m);
  set_row(m);
  pass(m);
  m->before = BEFORE_ATOM;
}

/* --- Commands --- */

/* The next group when it holds letters and digits alone, which is then passed; NULL otherwise. */
static const char *letters_group(struct setter *m, size_t *len) {
  skip_blanks(m);
  const char *s = tex_braced(len, m->t.s, m->end);
  size_t n = 0;
  while (s && n < *len && char_is_letter_or_digit(s[n])) n++;
  if (n == 0 || n < *len) return NULL;
  go_to(m, s + n + 1);
  return s;
}

/* Script and bold capitals have characters of their own; of the script ones some stand elsewhere in Unicode. */
static void set_alphabet(struct setter *m, char c, bool script) {
  static const struct {
    char c;
    unsigned point;
  } elsewhere[] = {{'B', 0x212C}, {'E', 0x2130}, {'F', 0x2131}, {'H', 0x210B},
                   {'I', 0x2110}, {'L', 0x2112}, {'M', 0x2133}, {'R', 0x211B}};
  unsigned point = (script ? 0x1D49CU : 0x1D400U) + (unsigned)(c - 'A');
  for (size_t i = 0; script && i < sizeof elsewhere / sizeof *elsewhere; i++)
    if (elsewhere[i].c == c) point = elsewhere[i].point;
  text_printf(m->out, "<mi>&#x%X;</mi>", point);
}

static void set_font(struct setter *m, const char *name) {
  size_t len;
  const char *s = letters_group(m, &len);
  bool script = strcmp(name, "mathcal") == 0, bold = strcmp(name, "mathbf") == 0;
  if (!s)
    set_group(m);
  else if ((script || bold) && len == 1 && *s >= 'A' && *s <= 'Z')
    set_alphabet(m, *s, script);
  else
    text_printf(m->out, len == 1 ? "<mi mathvariant=\"normal\">%.*s</mi>" : "<mi>%.*s</mi>", (int)len, s);
  m->before = BEFORE_ATOM;
}

static void set_words(struct setter *m) {
  int depth = 0;
  skip_blanks(m);
  text_add(m->out, "<mtext>");
  do {
    const enum tex_kind kind = m->t.kind;
    depth += (kind == TEX_OPEN) - (kind == TEX_CLOSE);
    if (kind == TEX_BLANK || kind == TEX_GAP)
      text_add(m->out, "&#xA0;");
    else if (kind != TEX_OPEN && kind != TEX_CLOSE && kind != TEX_BRACE)
      escape_html(m->out, m->t.s, m->t.len);
    pass(m);
  } while (depth > 0);
  text_add(m->out, "</mtext>");
  m->before = BEFORE_ATOM;
}

static void set_accent(struct setter *m, const struct tex_word *w) {
  text_add(m->out, "<mover accent=\"true\">");
  set_group(m);
  text_printf(m->out, "<mo stretchy=\"false\">%s</mo></mover>", w->text);
}

static void set_operator_name(struct setter *m, const struct tex_word *w) {
  size_t len = strlen(w->text);
  const char *s = w->args ? letters_group(m, &len) : w->text;
  if (s)
    text_printf(m->out, "<mi>%.*s</mi>", (int)len, s);
  else
    set_group(m);
  m->before = BEFORE_ATOM;
}

static void set_word(struct setter *m, const struct tex_word *w) {
  size_t at = m->out->len;
  switch (w->role) {
  case TEX_ROLE_LETTER:
  case TEX_ROLE_UPRIGHT:
    text_printf(m->out, w->role == TEX_ROLE_LETTER ? "<mi>%s</mi>" : "<mi mathvariant=\"normal\">%s</mi>", w->text);
    m->before = BEFORE_ATOM;
    return;
  case TEX_ROLE_ORDINARY:
    set_sign(m, " stretchy=\"false\" lspace=\"0\" rspace=\"0\"", w->text, strlen(w->text), BEFORE_ATOM);
    return;
  case TEX_ROLE_OPEN:
  case TEX_ROLE_CLOSE:
    set_sign(m, " stretchy=\"false\"", w->text, 1, w->role == TEX_ROLE_OPEN ? BEFORE_NOTHING : BEFORE_ATOM);
    return;
  case TEX_ROLE_BINARY:
    set_binary(m, w->text, strlen(w->text));
    return;
  case TEX_ROLE_SPACE:
    text_printf(m->out, "<mspace width=\"%s\"></mspace>", w->text);
    return;
  case TEX_ROLE_FUNCTION:
    set_operator_name(m, w);
    return;
  case TEX_ROLE_ACCENT:
    set_accent(m, w);
    return;
  case TEX_ROLE_FONT:
    set_font(m, w->name);
    return;
  case TEX_ROLE_TEXT:
    set_words(m);
    return;
  case TEX_ROLE_ROOT:
    set_group(m);
    wrap(m->out, at, "<msqrt>", "</msqrt>");
    return;
  case TEX_ROLE_FRACTION:
    set_group(m);
    set_group(m);
    wrap(m->out, at, "<mfrac>", "</mfrac>");
    return;
  }
}

/* One delimiter; '.' is none.  One that stretches is set wider, so that it does only where it has to. */
static void add_delimiter(struct text *out, char c, bool opens, bool stretches) {
  if (c == '.') return;
  text_printf(out, "<mo fence=\"true\" stretchy=\"%s\" form=\"%s\"%s>%c</mo>", stretches ? "true" : "false",
              opens ? "prefix" : "postfix", c == '|' ? " lspace=\"0\" rspace=\"0\"" : "", c);
}

/* The delimiter behind \left or \right. */
static char pass_fence(struct setter *m) {
  const char *delimiter = m->t.s + m->t.len;
  go_to(m, delimiter + 1);
  return *delimiter;
}

/* \left( ... \right) as one element. */
static void set_fenced(struct setter *m) {
  struct text *out = m->out, inside = {0};
  char open = pass_fence(m);
  m->out = &inside;
  set_row(m);
  m->out = out;
  char close = pass_fence(m);
  bool high = strstr(inside.data, "<mfrac>") || strstr(inside.data, "<mtable") || strstr(inside.data, "<msqrt>");
  text_add(out, "<mrow>");
  add_delimiter(out, open, true, high);
  text_add(out, inside.data);
  add_delimiter(out, close, false, high);
  text_add(out, "</mrow>");
  text_clear(&inside);
  m->before = BEFORE_ATOM;
}

/* {name} behind \begin or \end. */
static const struct tex_environment *pass_environment(struct setter *m) {
  size_t len;
  const char *name = tex_braced(&len, m->t.s + m->t.len, m->end);
  go_to(m, name + len + 1);
  return tex_environment(name, len);
}

static void set_cells(struct setter *m) {
  text_add(m->out, "<mtr><mtd>");
  set_row(m);
  while (m->t.kind != TEX_FINISH) {
    bool cell = m->t.kind == TEX_CELL;
    pass(m);
    if (!cell) skip_blanks(m);
    if (!cell && m->t.kind == TEX_FINISH) break; /* the last row is ended too */
    text_add(m->out, cell ? "</mtd><mtd>" : "</mtd></mtr><mtr><mtd>");
    set_row(m);
  }
  text_add(m->out, "</mtd></mtr>");
}

static void set_environment(struct setter *m) {
  const struct tex_environment *kind = pass_environment(m);
  text_add(m->out, "<mrow>");
  if (*kind->open) text_printf(m->out, "<mo fence=\"true\" form=\"prefix\">%s</mo>", kind->open);
  text_printf(m->out, "<mtable class=\"%s\">", kind->name);
  set_cells(m);
  text_add(m->out, "</mtable>");
  if (*kind->close) text_printf(m->out, "<mo fence=\"true\" form=\"postfix\">%s</mo>", kind->close);
  text_add(m->out, "</mrow>");
  pass_environment(m);
  m->before = BEFORE_ATOM;
}

/* \, and its like. */
static void set_gap(struct setter *m) {
  static const char kinds[] = ",:;! ";
  static const char *const width[] = {"0.1667em", "0.2222em", "0.2778em", "-0.1667em", "0.25em"};
  text_printf(m->out, "<mspace width=\"%s\"></mspace>", width[strchr(kinds, m->t.s[1]) - kinds]);
  pass(m);
}

/* \{ and \}. */
static void set_brace(struct setter *m) {
  const char *c = m->t.s + 1;
  set_sign(m, " stretchy=\"false\"", c, 1, *c == '{' ? BEFORE_NOTHING : BEFORE_ATOM);
  pass(m);
}

/* --- Rows and scripts --- */

static void set_atom(struct setter *m) {
  const struct tex_word *w = m->t.word;
  switch (m->t.kind) {
  case TEX_WORD:
    pass(m);
    set_word(m, w);
    return;
  case TEX_OPEN:
    set_group(m);
    return;
  case TEX_DIGIT:
    set_number(m, tex_number_length(m->t.s, m->end));
    return;
  case TEX_LETTER:
    set_letter(m);
    return;
  case TEX_BEGIN:
    set_environment(m);
    return;
  case TEX_LEFT:
    set_fenced(m);
    return;
  case TEX_GAP:
    set_gap(m);
    return;
  case TEX_BRACE:
    set_brace(m);
    return;
  default:
    set_character(m);
  }
}

/* A group, or one digit, character or command. */
static void set_script(struct setter *m, struct text *into) {
  struct text *out = m->out;
  m->out = into;
  skip_blanks(m);
  m->before = BEFORE_NOTHING;
  if (m->t.kind == TEX_DIGIT)
    set_number(m, 1);
  else
    set_atom(m);
  m->out = out;
}

/* Scripts and primes that follow, in any order; the number of primes. */
static int read_scripts(struct setter *m, struct text *sub, struct text *sup) {
  for (int primes = 0;;) {
    const struct tex_token blank = m->t;
    skip_blanks(m);
    if (m->t.kind == TEX_PRIME) {
      primes++;
      pass(m);
    } else if (m->t.kind == TEX_LOWERED || m->t.kind == TEX_RAISED) {
      struct text *into = m->t.kind == TEX_LOWERED ? sub : sup;
      pass(m);
      set_script(m, into);
    } else {
      m->t = blank;
      return primes;
    }
  }
}

/* The sign itself is raised; as a superscript it would be so twice. */
static void add_primes(struct setter *m, size_t at, int n) {
  text_add(m->out, "<mo lspace=\"0\" rspace=\"0\">");
  for (int i = 0; i < n; i++) text_add(m->out, "\xe2\x80\xb2");
  text_add(m->out, "</mo>");
  wrap(m->out, at, "<mrow>", "</mrow>");
}

static void add_script(struct setter *m, size_t at, const struct text *script, const char *open, const char *close) {
  text_add(m->out, text_str(script));
  wrap(m->out, at, open, close);
}

/* Primes and scripts after the element written since `at`. */
static void set_scripts(struct setter *m, size_t at) {
  OWNED(text) sub = {0}, sup = {0};
  int primes = read_scripts(m, &sub, &sup);
  bool both = sub.len && sup.len && !primes;
  if (both) {
    text_add(m->out, text_str(&sub));
    add_script(m, at, &sup, "<msubsup>", "</msubsup>");
  } else {
    if (sub.len) add_script(m, at, &sub, "<msub>", "</msub>");
    if (primes) add_primes(m, at, primes);
    if (sup.len) add_script(m, at, &sup, "<msup>", "</msup>");
  }
  if (sub.len || sup.len || primes) m->before = BEFORE_ATOM;
}

/* The sign of application, and a thin space before an argument without parentheses. */
static void set_application(struct setter *m) {
  text_add(m->out, "<mo>&#x2061;</mo>");
  skip_blanks(m);
  if (m->t.kind != TEX_END && *m->t.s != '(' && m->t.kind != TEX_LEFT)
    text_add(m->out, "<mspace width=\"0.1667em\"></mspace>");
  m->before = BEFORE_NOTHING;
}

static bool row_ends(enum tex_kind next) {
  return next == TEX_END || next == TEX_CLOSE || next == TEX_CELL || next == TEX_ROW || next == TEX_FINISH ||
         next == TEX_RIGHT;
}

/* The number of elements. */
static int set_item(struct setter *m) {
  bool function = is_function(&m->t);
  if (function && m->before == BEFORE_ATOM) text_add(m->out, "<mspace width=\"0.1667em\"></mspace>");
  size_t at = m->out->len, from = (size_t)(m->t.s - m->whole);
  if (m->t.kind == TEX_RAISED || m->t.kind == TEX_LOWERED || m->t.kind == TEX_PRIME)
    text_add(m->out, "<mrow></mrow>");
  else
    set_atom(m);
  set_scripts(m, at);
  m->continued = false;
  if (m->changed && m->changed[from]) wrap(m->out, at, "<mrow class=\"chg\">", "</mrow>");
  if (function) set_application(m);
  return function ? 2 : 1;
}

/* Up to the end of the group, cell or fence; one element. */
static void set_row(struct setter *m) {
  size_t at = m->out->len;
  int n = 0;
  m->before = BEFORE_NOTHING;
  for (skip_blanks(m); !row_ends(m->t.kind); skip_blanks(m)) n += set_item(m);
  if (n != 1) wrap(m->out, at, "<mrow>", "</mrow>");
}

/* --- Pieces --- */

static void set_piece(struct setter *m, const char *s, const char *end) {
  m->end = end;
  go_to(m, s);
  m->continued = s > m->whole && formula_breaks_before(&m->t);
  text_add(m->out, "<math displaystyle=\"true\"><semantics>");
  set_row(m);
  text_add(m->out, "<annotation encoding=\"application/x-tex\">");
  escape_html(m->out, s, (size_t)(end - s));
  text_add(m->out, "</annotation></semantics></math>");
}

bool formula_mathml(struct text *out, const char *tex, size_t len, const bool *changed) {
  if (!formula_is_sane(tex, len)) return false;
  struct setter m = {.out = out, .whole = tex, .changed = changed};
  const char *end = tex + len;
  for (const char *s = tex; s < end;) {
    while (s > tex && s < end && *s == ' ') s++;
    if (s == end) break;
    const char *stop = formula_piece_end(s, end);
    if (s > tex) text_add_char(out, ' ');
    set_piece(&m, s, stop);
    s = stop;
  }
  return true;
}
