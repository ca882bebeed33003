/* Where digits are lost, as tables: each row of the ledger as tab-separated fields, and the worst formulas for a
   terminal. */
#include <math.h>
#include <stdlib.h>

#include "stability.h"
#include "stability_words.h"

void report_stability_tsv(struct text *out, const struct stability_result *r) {
  const double none = (double)NAN;
  char a[80], b[32], c[32], e[32], f[32], g[32];
  text_add(out, "formula\tequation\tregion\tpoints\tfailures\tdigits lost\tby the problem\tby the formula\tpredicted\t"
                "cause\tnode\tsource\tafter\tgained\tafter, most\tafter, failures\tshort\tshort, "
                "rounded\twitness\tfailure\tfailure "
                "source\tfailure witness\n");
  for (long i = 0; i < r->n_rows; i++) {
    const struct stability_row *row = &r->row[i];
    const struct stability_formula *of = &r->formula[row->formula];
    if (!row->at_fault) continue;
    bool found = row->found && stability_loses(row);
    text_printf(out, "%s\t%s\t%s\t%ld\t%ld\t%s\t%s\t%s\t%s\t%s\t%s\t%s", of->id, or_dash(of->equation),
                r->region[row->region].id, row->points, row->failures, or_dash(found ? stability_lost(a, row) : NULL),
                stability_digits(b, found ? row->problem : none), stability_digits(c, found ? row->excess : none),
                stability_digits(e, found ? row->predicted : none), found ? loss_cause_says[row->cause] : "-",
                or_dash(found ? row->node : NULL), or_dash(found ? row->source : NULL));
    text_printf(out, "\t%s\t%s\t%s\t%ld\t%ld\t%ld\t%s\t%s\t%s\t%s\n", stability_digits(a, found ? row->after : none),
                stability_digits(f, found ? stability_gained(row) : none), stability_digits(g, row->after_most),
                row->after_failures, row->after_short, row->after_rounded, or_dash(found ? row->witness : NULL),
                row->failure_witness ? loss_cause_says[row->failure] : "-", or_dash(row->failure_source),
                or_dash(row->failure_witness));
  }
}

void report_stability_text(struct text *out, const struct stability_result *r) {
  enum { SHOWN = 40 };
  char a[32], b[32], c[32], all[80];
  int n;
  FREED const struct stability_row **row = stability_ledger(&n, r);
  text_printf(out, "%-22s %-22s %5s %8s %8s%s  cause\n", "formula", "region", "lost", "problem", "formula",
              r->after ? "   after" : "");
  for (int i = 0; i < n && i < SHOWN && stability_loses(row[i]); i++) {
    const struct stability_formula *f = &r->formula[row[i]->formula];
    text_printf(out, "%-22s %-22s %5s %8s %8s", f->id, r->region[row[i]->region].id,
                stability_digits(a, row[i]->observed), stability_digits(b, row[i]->problem),
                stability_digits(c, row[i]->excess));
    if (r->after) text_printf(out, " %7s", stability_digits(a, row[i]->after));
    text_add(out, "  ");
    stability_add_cause(out, row[i], "");
    if (stability_relative_error(a, row[i])) text_printf(out, "; %s", stability_lost(all, row[i]));
    text_printf(out, "\n%23s at %s\n", "", row[i]->witness);
  }
  text_add_char(out, '\n');
  stability_add_confusion(out, r);
  stability_add_summary(out, r);
  for (int i = 0; i < r->n_pairs; i++)
    if (stability_pair_fails(&r->pair[i]))
      text_printf(out, "\n%s: the stable form has not the corrected one's value at %s", r->pair[i].formula,
                  r->pair[i].witness);
  text_add_char(out, '\n');
}
