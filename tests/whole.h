/* The audit of the whole paper as the program under test leaves it.  It takes long, so that one serves all tests that
   only read it: make check has made it before the suites (STICKSLIP_WHOLE is its folder); where a suite is run by
   itself, each fixture that asks makes its own. */
#ifndef STICKSLIP_TESTS_WHOLE_H
#define STICKSLIP_TESTS_WHOLE_H

#include "paper_model.h"

/* Puts it at "whole" in the scratch folder, to be read only: whole/paper is the report, and tests/whole.sh says what
   else is there.  Fails the test where the audit itself failed; verdicts may differ from their record. */
void whole_open(void);
/* Behind whole_open: the record as audit.json and the tables hold it; to be cleared. */
void whole_record(struct audit_result *r);

/* That record, beside the paper's files and a scratch folder: fixtures. */
extern struct audit_result the_audit;
void audit_open(void);
void audit_close(void);

#endif
