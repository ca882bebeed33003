/* One claim of the paper judged, with its evidence.
     cc -o audit audit.c $(pkg-config --cflags --libs stickslip)
     ./audit num-t_a */
#include <stdio.h>
#include <stickslip.h>

static const char *shown(const char *text) {
  return text ? text : "-";
}

int main(int argc, char **argv) {
  ss_paper *paper;
  ss_scene *scene;
  ss_audit *audit;
  if (ss_paper_open(&paper, NULL) || ss_scene_open(&scene, "paper", NULL) ||
      ss_audit_run(&audit, paper, scene, argc > 1 ? argv[1] : "eq-40", 1, NULL, NULL)) {
    fprintf(stderr, "%s\n", ss_error());
    return 1;
  }
  for (size_t i = 0; i < ss_audit_count(audit); i++) {
    printf("%s: %s\n", ss_finding_text(audit, i, SS_FINDING_ID), ss_verdict_name((int)ss_finding_verdict(audit, i)));
    printf("  condition: %s\n", shown(ss_finding_text(audit, i, SS_FINDING_CONDITION)));
    printf("  correction: %s\n", shown(ss_finding_text(audit, i, SS_FINDING_CORRECTION)));
    for (size_t k = 0; k < ss_evidence_count(audit, i); k++)
      printf("  %s %s, worst at %s\n", ss_evidence_text(audit, i, k, SS_EVIDENCE_ROUTE),
             ss_evidence_text(audit, i, k, SS_EVIDENCE_RESULT),
             shown(ss_evidence_text(audit, i, k, SS_EVIDENCE_WORST)));
  }
  ss_audit_free(audit);
  ss_scene_free(scene);
  ss_paper_free(paper);
  return 0;
}
