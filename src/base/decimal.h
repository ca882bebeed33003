/* Doubles as decimals: the bytes of printf, sooner. */
#ifndef STICKSLIP_BASE_DECIMAL_H
#define STICKSLIP_BASE_DECIMAL_H

enum { DECIMAL_MAX = 40, DECIMAL_DIGITS = 15 };

/* x as %.*g gives it, digits from 1 to DECIMAL_DIGITS; its length. */
int decimal_digits(char out[DECIMAL_MAX], double x, int digits);
/* x to 15 digits, or 16 or 17, the first that reads back as x. */
int decimal_whole(char out[DECIMAL_MAX], double x);

#endif
