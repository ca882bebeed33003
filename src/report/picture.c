/* The pictures of a record: the section of the page, and each as a document of its own. */
#include <string.h>

#include "page.h"
#include "report.h"

static const struct picture *const pictures[] = {&picture_history,      &picture_animation,  &picture_margins,
                                                 &picture_portrait,     &picture_return_map, &picture_long_run,
                                                 &picture_steps,        &picture_along,      &picture_planes,
                                                 &picture_bifurcations, &picture_map};
enum { N_PICTURES = sizeof pictures / sizeof *pictures };

static void add_svg(struct text *out, const struct picture *q, const struct rows *t, bool alone) {
  OWNED(text) told = {0}, drawn = {0};
  struct plot p = plot_begin(&drawn, q->id, PLOT_WIDTH);
  q->tell(&told, t);
  q->draw(&p, t);
  plot_svg(out, &p, q->title, text_str(&told), alone);
}

/* --- Documents of their own --- */

int report_pictures(void) {
  return N_PICTURES;
}

const char *report_picture_id(int i) {
  return pictures[i]->id;
}

bool report_picture(struct text *out, const struct audit_result *r, int i) {
  OWNED(rows) t;
  bool there = rows_read(&t, r, pictures[i]->table);
  if (there) add_svg(out, pictures[i], &t, true);
  return there;
}

/* --- In the page --- */

static void add_figure(const struct page *p, const struct picture *q, const struct rows *t, const char *words) {
  OWNED(text) said = {0};
  if (words)
    text_add(&said, words);
  else
    q->say(&said, t);
  page_add(p, "<figure id=\"g-%s\">\n", q->id);
  add_svg(p->out, q, t, false);
  page_add(p, "<figcaption><strong>%p.</strong> %t Numbers: <a href=\"%s\">%s</a>.</figcaption></figure>\n", q->title,
           text_str(&said), q->table, q->table);
}

void page_picture(const struct page *p, const struct picture *q, const char *words) {
  OWNED(rows) t;
  if (rows_read(&t, p->r, q->table)) add_figure(p, q, &t, words);
}

/* What other commands have left beside the report. */
static void add_neighbours(const struct page *p) {
  if (p->r->n_neighbours == 0) return;
  text_add(p->out, "<p>More pictures, of the methods behind all this: ");
  for (size_t i = 0; i < p->r->n_neighbours; i++)
    page_add(p, "%s<a href=\"%e\">%e</a>", i ? ", " : NULL, p->r->neighbours[i].path, p->r->neighbours[i].says);
  text_add(p->out, ".</p>\n");
}

/* Those that stand in the letter are not shown again. */
void page_pictures(const struct page *p) {
  page_begin_fold(p, "pictures", "Pictures");
  text_add(p->out,
           "<p>Drawn by the whole audit of a scene that has a periodic orbit, from the tables named below each; "
           "curves differ in dash as well as in colour. The words of every picture stand in it for a screen "
           "reader.</p>\n<div class=\"plots\">\n");
  for (int i = 0; i < N_PICTURES; i++)
    if (pictures[i]->say && pictures[i] != &picture_portrait && pictures[i] != &picture_along)
      page_picture(p, pictures[i], NULL);
  text_add(p->out, "</div>\n");
  add_neighbours(p);
  text_add(p->out, "</details>\n");
}
