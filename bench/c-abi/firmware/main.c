/* The tests on the target: the stored cases bit for bit, the stack of each step, and one model stepped in an
 * interrupt that comes in the middle of the steps of another. */
#include "board.h"
#include "epas_test.h"

#include <stddef.h>

static epas_caged_t caged;
static epas_caged_range_t caged_range;
static epas_memory_t memory;
static epas_screw_t screw;
static epas_screw_range_t screw_range;
static epas_linear_t linear;

/* ---- Stack ------------------------------------------------------------------------------------------- */

#define PAINT 0x5AFE5AFEu
#define PAINTED_WORDS 4096u

/* Bytes of stack that a step may take. */
#define STEP_STACK 1536u

static const epas_inputs_t inputs = {120.0f, 8000.0f};
static const epas_memory_inputs_t memory_inputs = {120.0f, 8000.0f, 100u, 0.0f, 303.15f, 0.0f};
static const epas_linear_inputs_t linear_inputs = {0.3f, 2000.0f, 700.0f};

static void set_up_caged(void) { (void)test_setup_caged(&caged); }
static void set_up_caged_range(void) { (void)test_setup_caged_range(&caged_range); }
static void set_up_memory(void) { (void)test_setup_memory(&memory); }
static void set_up_ball(void) { (void)test_setup_ball(); }
static void set_up_ball_range(void) { (void)test_setup_ball_range(); }
static void set_up_screw(void) { (void)test_setup_screw(&screw); }
static void set_up_screw_alone(void) { (void)epas_screw_init(&screw, &test_screw_configuration, NULL); }
static void set_up_screw_range(void) { (void)epas_screw_range_init(&screw_range, &test_screw_range_configuration, NULL); }
static void set_up_linear(void) { (void)test_setup_linear(&linear); }

static epas_outputs_t outputs;
static epas_screw_outputs_t screw_outputs;
static epas_linear_outputs_t linear_outputs;

static void step_caged(void) { (void)epas_caged_step(&caged, &inputs, &outputs); }
static void step_caged_range(void) { (void)epas_caged_range_step(&caged_range, &inputs, &outputs); }
static void swap_caged_range(void) { (void)epas_caged_range_swap(&caged_range, &test_other_range_block, NULL); }
static void step_memory(void) { (void)epas_memory_step(&memory, &memory_inputs, &outputs); }
static void between_memory(void) { (void)epas_memory_between(&memory, 103u, &outputs); }
static void step_screw(void) { (void)epas_screw_step(&screw, &inputs, &screw_outputs); }
static void step_screw_range(void) { (void)epas_screw_range_step(&screw_range, &inputs, &screw_outputs); }
static void swap_screw_range(void) { (void)epas_screw_range_swap(&screw_range, &test_screw_range_configuration, NULL); }
static void step_linear(void) { (void)epas_linear_step(&linear, &linear_inputs, &linear_outputs); }

/* Bytes of stack that a function takes, its caller's return address included. */
__attribute__((noinline)) static uint32_t stack_of(void (*function)(void))
{
    uint32_t *top;
    volatile uint32_t *word;

    __asm volatile("mov %0, sp" : "=r"(top));
    for (word = top - PAINTED_WORDS; word < top; word++) {
        *word = PAINT;
    }
    function();
    for (word = top - PAINTED_WORDS; (word < top) && (*word == PAINT); word++) {
    }
    return (uint32_t)((const volatile uint8_t *)top - (const volatile uint8_t *)word);
}

static uint32_t stack_within(const char *name, void (*function)(void), uint32_t bound)
{
    const uint32_t bytes = stack_of(function);

    test_put("stack of ");
    test_put(name);
    test_put(": ");
    test_put_number(bytes);
    test_put(" bytes\n");
    return ((bytes > 0u) && (bytes <= bound)) ? 0u : 1u;
}

static uint32_t stacks(void)
{
    uint32_t wrong = 0u;

    /* Set-up happens once, outside of the control loop: no bound but that of the paint. */
    wrong += stack_within("epas_caged_init", set_up_caged, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_caged_range_init", set_up_caged_range, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_caged_range_swap", swap_caged_range, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_memory_init", set_up_memory, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_folded_ball_init", set_up_ball, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_folded_ball_range_init", set_up_ball_range, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_screw_init with its tables", set_up_screw, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_screw_init", set_up_screw_alone, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_screw_range_init", set_up_screw_range, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_screw_range_swap", swap_screw_range, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_linear_init with its table", set_up_linear, (4u * PAINTED_WORDS) - 4u);
    wrong += stack_within("epas_caged_step", step_caged, STEP_STACK);
    wrong += stack_within("epas_caged_range_step", step_caged_range, STEP_STACK);
    wrong += stack_within("epas_memory_step", step_memory, STEP_STACK);
    wrong += stack_within("epas_memory_between", between_memory, STEP_STACK);
    wrong += stack_within("epas_screw_step", step_screw, STEP_STACK);
    wrong += stack_within("epas_screw_range_step", step_screw_range, STEP_STACK);
    wrong += stack_within("epas_linear_step", step_linear, STEP_STACK);
    return wrong;
}

/* ---- Interrupts -------------------------------------------------------------------------------------- */

static epas_caged_t caged_in_interrupt;
static volatile uint32_t next_tick;
static volatile uint32_t interrupt_differs;
static volatile uint32_t in_screw_step;
static volatile uint32_t interrupted;

/* The control interrupt: one stored tick of the caged ball screw, over and over. */
void sys_tick_handler(void)
{
    const uint32_t tick = next_tick;

    if (in_screw_step != 0u) {
        interrupted++;
    }
    interrupt_differs += test_caged_tick(&caged_in_interrupt, tick);
    next_tick = ((tick + 1u) < test_ticks) ? (tick + 1u) : 0u;
}

static uint32_t interrupts(void)
{
    uint32_t wrong;
    uint32_t tick;
    uint32_t pass;

    wrong = (test_setup_caged(&caged_in_interrupt) == EPAS_OK) ? 0u : 1u;
    board_start_sys_tick(331u);
    for (pass = 0u; pass < 8u; pass++) {
        wrong += (test_setup_screw(&screw) == EPAS_OK) ? 0u : 1u;
        for (tick = 0u; tick < test_ticks; tick++) {
            in_screw_step = 1u;
            wrong += test_screw_tick(&screw, tick);
            in_screw_step = 0u;
        }
    }
    board_stop_sys_tick();
    wrong += interrupt_differs;
    test_put("a step in an interrupt, in the middle of another's: ");
    test_put_number(interrupted);
    test_put(" times, ");
    test_put_number(wrong);
    test_put(" differ\n");
    return wrong + ((interrupted > test_ticks) ? 0u : 1u);
}

int main(void)
{
    const uint32_t wrong = test_cases() + test_refusals() + test_changes() + test_reaction() + stacks() + interrupts();

    test_put((wrong == 0u) ? "passed\n" : "FAILED\n");
    return (wrong == 0u) ? 0 : 1;
}
