/* What the board gives to the program: the timer of the core, and the exit by semihosting. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Ends the program; the debugger, or QEMU, reports whether it passed. */
void board_exit(uint32_t passed) __attribute__((noreturn));

/* Interrupts the program every so many cycles of the core, with sys_tick_handler of program.h. */
void board_start_sys_tick(uint32_t cycles);
void board_stop_sys_tick(void);

#endif
