/* The double nearest to pi: POSIX alone does not promise M_PI.  Number types have their own (num.h). */
#ifndef STICKSLIP_PI_H
#define STICKSLIP_PI_H

#define PI 3.14159265358979323846

#endif
