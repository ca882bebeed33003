/* What the files of this module share. */
#ifndef STICKSLIP_TAPE_IMPL_H
#define STICKSLIP_TAPE_IMPL_H

#include "tape.h"

/* How many of a and b are operands; those of a root are links. */
int tape_arity(enum tape_op op);

#endif
