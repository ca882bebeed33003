/* stickslip jacobian: the 2x2 Jacobian of one period by the method asked for, with its accuracy and its eigenvalues. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/json.h"
#include "cli.h"

static int parse_jacobian(struct jacobian_request *q, const struct options *o) {
  const char *method = option(o, OPT_METHOD), *layer = option(o, OPT_LAYER);
  enum { TABLE_DIGITS = 8 };
  *q = (struct jacobian_request){.method = METHOD_ANALYTIC, .layer = LAYER_CORRECTED};
  int status = parse_digits(&q->digits, o);
  if (status) return status;
  if (option(o, OPT_PHASES) && (method || layer))
    return usage("--phases shows every method and takes no %s", method ? "--method" : "--layer");
  if (option(o, OPT_PHASES) && !option(o, OPT_DIGITS) && !option(o, OPT_JSON)) q->digits = TABLE_DIGITS;
  if (method) {
    int k = 0;
    while (k < N_METHODS && strcmp(method, method_name[k]) != 0) k++;
    if (k == N_METHODS)
      return usage("--method takes analytic, implicit, saltation, fd, fd-double or ode, not %.200s", method);
    q->method = (enum jacobian_method)k;
  }
  if (layer) {
    int k = 0;
    while (k < N_LAYERS && strcmp(layer, layer_name[k]) != 0) k++;
    if (k == N_LAYERS) return usage("--layer takes printed, corrected or stable, not %.200s", layer);
    q->layer = (enum layer)k;
  }
  return parse_start(&q->orbit, &q->at_printed, o);
}

/* A whole number of which n digits are known, from `from` on: 212766240 as 2.1276624e+8, since a zero that only fills up would be
   read as a digit. */
static void show_as_power(struct text *out, size_t from, slong n) {
  size_t sign = out->data[from] == '-', figures = out->len - from - sign;
  if (figures <= (size_t)n || strspn(out->data + from + sign, "0123456789") != figures) return;
  struct text whole;
  text_init(&whole);
  text_add(&whole, out->data + from);
  out->len = from;
  out->data[from] = '\0';
  text_printf(out, "%.*s", (int)sign + 1, whole.data);
  if (n > 1) text_printf(out, ".%.*s", (int)n - 1, whole.data + sign + 1);
  text_printf(out, "e+%zu", figures - 1);
  text_clear(&whole);
}

void print_known(struct text *out, const arb_struct *x, slong digits) {
  slong n = digits;
  size_t from = out->len;
  while (n > 0 && num_print(out, x, n) != SS_OK) n = n > 20 ? n / 2 : n - 1;
  if (n == 0) text_add_char(out, '0');
  if (n > 0 && n < digits) show_as_power(out, from, n);
}

void print_accuracy(struct text *out, const arb_struct *worst) {
  arb_t up;
  arb_init(up);
  arb_mul_ui(up, worst, 106, 64); /* two digits round down by less than 1/20 */
  arb_div_ui(up, up, 100, 64);
  arb_get_mid_arb(up, up);
  num_print(out, up, 2);
  arb_clear(up);
}

void print_at(struct text *out, const struct jacobian_request *q) {
  if (q->at_printed)
    text_add(out, "printed");
  else
    text_printf(out, "orbit:%ld", (long)q->orbit + 1);
}

/* How far rounding of the matrix can move its eigenvalues: by the size of the matrix over their distance more than the
   matrix, and where that is not small, by the root. */
static double eigenvalue_error(const double m[4], const double re[2], const double im[2]) {
  double size = hypot(hypot(m[0], m[1]), hypot(m[2], m[3])), gap = hypot(re[0] - re[1], im[0] - im[1]);
  double move = 4 * DBL_EPSILON * size * (size / gap);
  return move < gap / 8 ? move : 8 * sqrt(DBL_EPSILON) * size;
}

static void print_near(struct text *out, double x, double err) {
  arb_t ball;
  arb_init(ball);
  arb_set_d(ball, x);
  mag_set_d(arb_radref(ball), err);
  print_known(out, ball, 15);
  arb_clear(ball);
}

bool print_eigenvalues(struct text out[2], arb_srcptr j) {
  double m[4], re[2], im[2], err = 0;
  for (int i = 0; i < 4; i++) {
    m[i] = num_arb.get_d(j + i);
    err = fmax(err, mag_get_d(arb_radref(j + i)));
  }
  if (dyn_eigenvalues_d(re, im, m) != SS_OK) return false;
  err = eigenvalue_error(m, re, im) * fmax(1, err / (DBL_EPSILON * hypot(hypot(m[0], m[1]), hypot(m[2], m[3]))));
  for (int i = 0; i < 2; i++)
    if (!isfinite(err) || !(err < hypot(re[i], im[i]) || err < 1e-3)) return false; /* no digit is known */
  for (int i = 0; i < 2; i++) {
    print_near(&out[i], re[i], err);
    if (im[i] == 0) continue;
    if (im[i] > 0) text_add_char(&out[i], '+');
    print_near(&out[i], im[i], err);
    text_add_char(&out[i], 'i');
  }
  return true;
}

/* What is printed about one Jacobian: entries, trace, det. */
enum { TRACE = 4, DET = 5, N_NUMBERS = 6 };

static void jacobian_json(struct text *out, const struct text e[N_NUMBERS], const char *at, const char *layer,
                          const struct jacobian_request *q) {
  struct json w;
  json_init(&w, out);
  json_object(&w, NULL);
  json_array(&w, "J");
  for (int i = 0; i < 2; i++) {
    json_array(&w, NULL);
    for (int k = 0; k < 2; k++) json_string(&w, NULL, text_str(&e[2 * i + k]));
    json_end_array(&w);
  }
  json_end_array(&w);
  json_string(&w, "trace", text_str(&e[TRACE]));
  json_string(&w, "det", text_str(&e[DET]));
  json_string(&w, "method", method_name[q->method]);
  json_string(&w, "layer", layer);
  json_string(&w, "at", at);
  json_end_object(&w);
}

static void jacobian_text(struct text *out, const struct text e[N_NUMBERS], arb_srcptr x,
                          const struct jacobian_request *q) {
  struct text gsl[2];
  arb_t worst;
  arb_init(worst);
  for (int i = 0; i < 2; i++) text_init(&gsl[i]);
  for (int i = 0; i < 2; i++) text_printf(out, "  %s  %s\n", text_str(&e[2 * i]), text_str(&e[2 * i + 1]));
  text_printf(out, "trace %s\ndet   %s\naccuracy ", text_str(&e[TRACE]), text_str(&e[DET]));
  jacobian_accuracy(worst, x, 4);
  print_accuracy(out, worst);
  text_printf(out, " (%s)\n", method_accuracy[q->method]);
  if (arb_is_zero(x + DET)) text_printf(out, "eigenvalues 0 and %s (exactly: 0 and the trace)\n", text_str(&e[TRACE]));
  if (print_eigenvalues(gsl, x))
    text_printf(out, "eigenvalues %s and %s (GSL)\n", text_str(&gsl[0]), text_str(&gsl[1]));
  for (int i = 0; i < 2; i++) text_clear(&gsl[i]);
  arb_clear(worst);
}

/* x: J, trace and det. */
static void print_jacobian(arb_srcptr x, const struct jacobian_request *q, const struct scene *s, bool as_json) {
  struct text e[N_NUMBERS], at, out;
  for (int i = 0; i < N_NUMBERS; i++) {
    text_init(&e[i]);
    print_known(&e[i], x + i, q->digits);
  }
  text_init(&at);
  text_init(&out);
  print_at(&at, q);
  const char *layer = q->method == METHOD_ANALYTIC ? layer_name[q->layer] : "model";
  if (as_json) {
    jacobian_json(&out, e, text_str(&at), layer, q);
  } else {
    text_printf(&out, "%s, %s, method %s, layer %s\n", s->name, text_str(&at), method_name[q->method], layer);
    jacobian_text(&out, e, x, q);
  }
  fputs(text_str(&out), stdout);
  for (int i = 0; i < N_NUMBERS; i++) text_clear(&e[i]);
  text_clear(&at);
  text_clear(&out);
}

/* Whether an entry or the trace would be printed as 0 though all that is known is that it is not large. */
static bool is_lost(arb_srcptr x) {
  const double near = 1e-3;
  for (int i = 0; i <= TRACE; i++)
    if (arb_contains_zero(x + i) && !(mag_get_d(arb_radref(x + i)) < near)) return true;
  return false;
}

static bool show_jacobian(const struct options *o, const struct model *m, const struct scene *s,
                          const struct jacobian_request *q, struct diag *d) {
  arb_ptr x = _arb_vec_init(N_NUMBERS);
  bool ok = audit_jacobian(x, x + TRACE, x + DET, m, s, q, d);
  if (ok && is_lost(x)) {
    diag_set(d, "%s: error: method %s knows no digit of the Jacobian's entries or of their trace here", s->path,
             method_name[q->method]);
    ok = false;
  }
  if (ok) print_jacobian(x, q, s, option(o, OPT_JSON));
  _arb_vec_clear(x, N_NUMBERS);
  return ok;
}

int run_jacobian(const struct options *o, const char *data) {
  struct jacobian_request q;
  int status = parse_jacobian(&q, o);
  if (status) return status;
  if (o->operands.n != 1) return usage("jacobian takes one %s", "SCENE");
  struct diag d;
  struct model m;
  struct scene s;
  diag_init(&d);
  model_init(&m);
  bool ok = load_scene(&s, o->operands.word[0], data, o, true, &d) && scene_one_point(&s, &d);
  if (ok && scene_other_word(&s))
    status = run_word_jacobian(o, &s, &q, &d);
  else if (!ok || !load_model(&m, data, o, &d) ||
           !(option(o, OPT_PHASES) ? show_phases : show_jacobian)(o, &m, &s, &q, &d))
    status = bad_input(&d);
  scene_clear(&s);
  model_clear(&m);
  return status;
}
