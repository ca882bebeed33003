/* Calls that say what is wrong: each names, as &d, a struct diag that it has for itself. */
#ifndef STICKSLIP_TESTS_SAYS_H
#define STICKSLIP_TESTS_SAYS_H

#include <check.h>
#include <string.h>

#include "base/text.h"

/* Fails the test where the call fails, and shows what it says. */
#define goes_well(call)                                                                                                \
  do {                                                                                                                 \
    struct diag d;                                                                                                     \
    diag_init(&d);                                                                                                     \
    ck_assert_msg(call, "%s: %s", #call, d.message);                                                                   \
  } while (0)

/* Fails the test where the call does not, or does not say these words; fails_as: where it says anything else. */
#define fails_with(call, words)                                                                                        \
  do {                                                                                                                 \
    struct diag d;                                                                                                     \
    diag_init(&d);                                                                                                     \
    ck_assert_msg(!(call), "%s", #call);                                                                               \
    ck_assert_msg(strstr(d.message, words) != NULL, "%s: \"%s\" is not in \"%s\"", #call, words, d.message);           \
  } while (0)
#define fails_as(call, message_)                                                                                       \
  do {                                                                                                                 \
    struct diag d;                                                                                                     \
    diag_init(&d);                                                                                                     \
    ck_assert_msg(!(call) && d.set, "%s", #call);                                                                      \
    ck_assert_str_eq(d.message, message_);                                                                             \
  } while (0)

#endif
