/* Symbols and their domains, for the files of this room. */
#ifndef STICKSLIP_MODEL_SYMBOL_H
#define STICKSLIP_MODEL_SYMBOL_H

#include "model.h"

/* The symbol that a record declares, without its domain. */
void symbol_init(struct symbol *s, const struct record *r, const struct source *src);
/* Frees the array with what its symbols hold. */
void symbols_clear(struct symbol *s, size_t n);
/* Reads the record's attribute "domain", if there is one; false with d set at the place. */
bool symbol_read_domain(struct symbol *s, struct diag *d);

#endif
