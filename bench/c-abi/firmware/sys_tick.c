/* The timer of the Cortex-M, as the control loop's clock. */
#include "board.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)

void board_start_sys_tick(uint32_t cycles)
{
    SYST_RVR = cycles - 1u;
    SYST_CVR = 0u;
    SYST_CSR = 7u;
}

void board_stop_sys_tick(void)
{
    SYST_CSR = 0u;
    __asm volatile("dsb\n\tisb" ::: "memory");
}
