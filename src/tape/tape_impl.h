/* What the files of this module share. */
#ifndef STICKSLIP_TAPE_IMPL_H
#define STICKSLIP_TAPE_IMPL_H

#include "tape.h"

/* The flags of the operands together: an instruction with a failed operand is not run. */
int tape_inherited(const struct tape *t, slong i, const int *flags);

#endif
