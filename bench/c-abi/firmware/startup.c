/* Start-up of a Cortex-M4F in C: vectors, memory, floating-point unit. */
#include "board.h"
#include "epas_test.h"

extern uint32_t __stack_top[];
extern uint32_t __data_start[];
extern uint32_t __data_end[];
extern const uint32_t __data_load[];
extern uint32_t __bss_start[];
extern uint32_t __bss_end[];

#define CPACR (*(volatile uint32_t *)0xE000ED88u)

void reset_handler(void) __attribute__((noreturn));
static void fault_handler(void);

typedef void (*vector_t)(void);

/* The first is the stack pointer, the others the handlers of the core's exceptions. */
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    vector_t handlers[15];
} vectors = {
    __stack_top,
    {
        reset_handler, fault_handler, fault_handler, fault_handler, fault_handler,
        fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
        fault_handler, fault_handler, fault_handler, fault_handler, sys_tick_handler,
    },
};

void reset_handler(void)
{
    const uint32_t *from = __data_load;
    uint32_t *to;

    /* Full access to the floating-point unit, before the first function that may use it. */
    CPACR |= 0xFu << 20;
    __asm volatile("dsb\n\tisb" ::: "memory");

    for (to = __data_start; to < __data_end; to++) {
        *to = *from;
        from++;
    }
    for (to = __bss_start; to < __bss_end; to++) {
        *to = 0u;
    }
    board_exit((main() == 0) ? 1u : 0u);
}

static void fault_handler(void)
{
    test_put("fault\n");
    board_exit(0u);
}
