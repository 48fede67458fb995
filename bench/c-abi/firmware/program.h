/* What the program gives to the start-up: where it begins, and what runs in the timer's interrupt. */
#ifndef PROGRAM_H
#define PROGRAM_H

int main(void);
void sys_tick_handler(void);

#endif
