/* What the board gives to the program, and what it calls of it. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* semihosting.c: ends the program; the debugger, or QEMU, reports whether it passed. */
void board_exit(uint32_t passed) __attribute__((noreturn));

/* sys_tick.c: interrupts every so many cycles of the core, with sys_tick_handler. */
void board_start_sys_tick(uint32_t cycles);
void board_stop_sys_tick(void);

/* main.c: called by the vectors and the start-up. */
void sys_tick_handler(void);
int main(void);

#endif
