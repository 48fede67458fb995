/* What the start-up and semihosting give to the program. */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

/* Ends the program; the debugger, or QEMU, reports whether it passed. */
void board_exit(uint32_t passed) __attribute__((noreturn));

/* Interrupts every so many cycles of the core, with sys_tick_handler. */
void board_start_sys_tick(uint32_t cycles);
void board_stop_sys_tick(void);

void sys_tick_handler(void);
int main(void);

#endif
