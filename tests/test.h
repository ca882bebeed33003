/* What nearly every suite includes. */
#ifndef STICKSLIP_TESTS_TEST_H
#define STICKSLIP_TESTS_TEST_H

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "local.h"
#include "says.h"
#include "scratch.h"
#include "suite.h"
#include "table.h"

#endif
