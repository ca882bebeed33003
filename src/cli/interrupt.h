/* An end from outside: Ctrl-C, SIGTERM, SIGHUP, or the clock of --timeout. */
#ifndef STICKSLIP_CLI_INTERRUPT_H
#define STICKSLIP_CLI_INTERRUPT_H

#include <stdbool.h>

/* From here on each of them ends the program with status 5, a message and no process left, wherever it is; a report is
   the old one or the new one, whole, and the message says which.  seconds: of the clock, 0 for none.  false when the
   clock cannot be set. */
bool interrupt_begin(double seconds);
/* Another scene begins. */
void interrupt_next(void);
void interrupt_end(void);

#endif
