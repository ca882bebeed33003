/* stickslip jacobian: the 2x2 Jacobian of one period by the method asked for. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "stickslip/json.h"

static int parse_jacobian(struct jacobian_request *q, const struct options *o) {
  *q = (struct jacobian_request){.method = METHOD_ANALYTIC, .layer = LAYER_CORRECTED};
  int status = parse_digits(&q->digits, o);
  if (status) return status;
  if (o->method) {
    int k = 0;
    while (k < N_METHODS && strcmp(o->method, method_name[k]) != 0) k++;
    if (k == N_METHODS) return usage("--method takes analytic, implicit, saltation, fd or ode, not %.200s", o->method);
    q->method = (enum jacobian_method)k;
  }
  if (o->layer) {
    int k = 0;
    while (k < N_LAYERS && strcmp(o->layer, layer_name[k]) != 0) k++;
    if (k == N_LAYERS) return usage("--layer takes printed or corrected, not %.200s", o->layer);
    q->layer = (enum layer)k;
  }
  return parse_start(&q->orbit, &q->at_printed, o->at);
}

/* As many of the digits as are known; 0 when not even the first is. */
static void print_known(struct text *out, const arb_struct *x, slong digits) {
  slong n = digits;
  while (n > 0 && num_print(out, x, n) != SS_OK) n = n > 20 ? n / 2 : n - 1;
  if (n == 0) text_add_char(out, '0');
}

static void print_jacobian(arb_srcptr j, const arb_t trace, const arb_t det, const struct jacobian_request *q,
                           const struct scene *s, bool as_json) {
  struct text e[6], at, out;
  for (int i = 0; i < 6; i++) {
    text_init(&e[i]);
    const arb_struct *x = i < 4 ? j + i : i == 4 ? trace : det;
    print_known(&e[i], x, q->digits);
  }
  text_init(&at);
  text_init(&out);
  if (q->at_printed)
    text_add(&at, "printed");
  else
    text_printf(&at, "orbit:%ld", (long)q->orbit + 1);
  const char *layer = q->method == METHOD_ANALYTIC ? layer_name[q->layer] : "model";
  if (as_json) {
    struct json w;
    json_init(&w, &out);
    json_object(&w, NULL);
    json_array(&w, "J");
    for (int i = 0; i < 2; i++) {
      json_array(&w, NULL);
      for (int k = 0; k < 2; k++) json_string(&w, NULL, text_str(&e[2 * i + k]));
      json_end_array(&w);
    }
    json_end_array(&w);
    json_string(&w, "trace", text_str(&e[4]));
    json_string(&w, "det", text_str(&e[5]));
    json_string(&w, "method", method_name[q->method]);
    json_string(&w, "layer", layer);
    json_string(&w, "at", text_str(&at));
    json_end_object(&w);
  } else {
    text_printf(&out, "%s, %s, method %s, layer %s\n", s->name, text_str(&at), method_name[q->method], layer);
    for (int i = 0; i < 2; i++) text_printf(&out, "  %s  %s\n", text_str(&e[2 * i]), text_str(&e[2 * i + 1]));
    text_printf(&out, "trace %s\ndet   %s\n", text_str(&e[4]), text_str(&e[5]));
  }
  fputs(text_str(&out), stdout);
  for (int i = 0; i < 6; i++) text_clear(&e[i]);
  text_clear(&at);
  text_clear(&out);
}

int run_jacobian(const struct options *o, const char *data) {
  struct jacobian_request q;
  int status = parse_jacobian(&q, o);
  if (status) return status;
  if (o->n_operands != 1) return usage("jacobian takes one %s", "SCENE");
  struct diag d;
  struct model m;
  struct scene s;
  diag_init(&d);
  model_init(&m);
  arb_ptr j = _arb_vec_init(6);
  bool ok = scene_load(&s, o->operand[0], data, &d) && load_model(&m, data, o, &d) &&
            audit_jacobian(j, j + 4, j + 5, &m, &s, &q, &d);
  if (ok)
    print_jacobian(j, j + 4, j + 5, &q, &s, o->json);
  else
    status = bad_input(&d);
  _arb_vec_clear(j, 6);
  scene_clear(&s);
  model_clear(&m);
  return status;
}
