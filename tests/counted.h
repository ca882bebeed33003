/* For make cover, before every file: what a process has counted is written where it ends by _exit too. */
#ifndef STICKSLIP_COUNTED
#define STICKSLIP_COUNTED

void __gcov_dump(void);
_Noreturn void _Exit(int status);

__attribute__((unused)) static _Noreturn void counted_exit(int status) {
  __gcov_dump();
  _Exit(status);
}
#define _exit counted_exit

#endif
