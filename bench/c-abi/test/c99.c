/* A screw as `epas design --format c99` writes it: the ticks of check/src/c99.rs, whose outputs are the crate's to the bit. */
#include "rack.h"
#include "ticks.h"

#include <stddef.h>

/* A tick: what is set before it, inputs as in rack_memory_inputs_t, a count after it; then whether it was set, outputs without memory, with,
 * and after the count, drag, and ticks with a fault. Floats by their bits. */
typedef struct {
    uint32_t set;
    float first;
    float second;
    rack_memory_inputs_t inputs;
    uint32_t count_between;
    uint32_t expected[18];
} tick_t;

static const rack_sensors_t sensors[] = {SENSORS};

static rack_t caged;
static rack_memory_t memory;
static tick_t ticks[50];

#if defined(__arm__)
#include "board.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define INSTRUCTIONS 40u /* in a tick of the timer, where QEMU counts one instruction a nanosecond */
#define CALLS 100u

void test_put(const char *text);
void test_put_number(uint32_t number);

static uint32_t semihosting(uint32_t operation, const uint32_t *arguments)
{
    register uint32_t r0 __asm("r0") = operation;
    register const uint32_t *r1 __asm("r1") = arguments;

    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

/* The next ticks of the file; how many. */
static size_t next_ticks(void)
{
    static uint32_t file;

    if (file == 0u) {
        file = semihosting(1u, (const uint32_t[]){(uint32_t)TICKS, 1u, sizeof(TICKS) - 1u});
    }
    return (sizeof(ticks) - semihosting(6u, (const uint32_t[]){file, (uint32_t)ticks, sizeof(ticks)})) / sizeof(ticks[0]);
}

static rack_outputs_t outputs;
static void nothing(void) { __asm volatile("" : : : "memory"); }
static void step(void) { rack_step(&caged, ticks[0].inputs.nut_speed, ticks[0].inputs.axial_load, &outputs); }
static void memory_step(void) { rack_memory_step(&memory, &ticks[0].inputs, &outputs); }
static void memory_between(void) { rack_memory_between(&memory, ticks[0].inputs.count, &outputs); }

static void say(const char *name, uint32_t number)
{
    test_put(name);
    test_put(" ");
    test_put_number(number);
    test_put("\n");
}

static uint32_t time_of(void (*volatile function)(void))
{
    uint32_t call;

    SYST_CSR = 0u;
    SYST_RVR = 0xFFFFFFu;
    SYST_CVR = 0u;
    SYST_CSR = 5u;
    for (call = 0u; call < CALLS; call++) {
        function();
    }
    return 0xFFFFFFu - SYST_CVR;
}

/* Most instructions of a call, over inputs spread over their ranges. */
static void count_of(const char *name, void (*function)(void))
{
    rack_memory_inputs_t *inputs = &ticks[0].inputs;
    uint32_t most = 0u;
    uint32_t place;

    for (place = 1u; place < 64u; place++) {
        const float part = (float)((place * 37u) % 64u) - 31.5f;
        uint32_t instructions;

        *inputs = (rack_memory_inputs_t){3.0f * part, (float)place * 300.0f, (place * 7919u) % 16384u, 0.0f, 320.0f + part, 0.0f};
        rack_memory_step(&memory, inputs, &outputs);
        instructions = ((time_of(function) - time_of(nothing)) * INSTRUCTIONS) / CALLS;
        most = (instructions > most) ? instructions : most;
    }
    say(name, most);
}

static void counts(void)
{
    (void)rack_memory_init(&memory, &sensors[0]);
    count_of("step", step);
    count_of("memory_step", memory_step);
    count_of("memory_between", memory_between);
    say("ram", sizeof(rack_t));
    say("memory_ram", sizeof(rack_memory_t));
}

void sys_tick_handler(void)
{
}
#else
#include <stdio.h>

static void test_put(const char *text) { (void)fputs(text, stdout); }
static void test_put_number(uint32_t number) { (void)printf("%lu", (unsigned long)number); }
static void counts(void) { }

static size_t next_ticks(void)
{
    static FILE *file;

    if (file == NULL) {
        file = fopen(TICKS, "rb");
    }
    return (file == NULL) ? 0u : fread(ticks, sizeof(ticks[0]), sizeof(ticks) / sizeof(ticks[0]), file);
}
#endif

static uint32_t bits(float number)
{
    const union {
        float number;
        uint32_t bits;
    } both = {.number = number};

    return both.bits;
}

static uint32_t differ(const uint32_t *expected, const rack_outputs_t *found)
{
    return ((expected[0] == bits(found->friction_torque)) && (expected[1] == bits(found->load_torque))
            && (expected[2] == bits(found->efficiency)) && (expected[3] == found->regime) && (expected[4] == found->faults))
               ? 0u
               : 1u;
}

static bool set(const tick_t *tick)
{
    switch (tick->set) {
    case 1u:
        return rack_set_friction(&caged, tick->first);
    case 2u:
        return rack_memory_set_coefficient(&memory, tick->first, tick->second);
    case 3u:
        return rack_memory_set_level(&memory, tick->first, tick->second);
    case 4u:
        return rack_memory_init(&memory, &sensors[(uint32_t)tick->first]);
    default:
        return true;
    }
}

/* Whether an output of a tick differs in a bit. */
static uint32_t differs(const tick_t *tick)
{
    const uint32_t *expected = tick->expected;
    uint32_t wrong = (expected[0] == (set(tick) ? 1u : 0u)) ? 0u : 1u;
    rack_outputs_t found;

    rack_step(&caged, tick->inputs.nut_speed, tick->inputs.axial_load, &found);
    wrong |= differ(&expected[1], &found);
    rack_memory_step(&memory, &tick->inputs, &found);
    wrong |= differ(&expected[6], &found);
    rack_memory_between(&memory, tick->count_between, &found);
    wrong |= differ(&expected[11], &found);
    wrong |= ((expected[16] == bits(memory.drag_torque)) && (expected[17] == (caged.faulted_ticks + memory.faulted_ticks))) ? 0u : 1u;
    return wrong;
}

int main(void)
{
    uint32_t wrong = 0u;
    uint32_t number = 0u;
    size_t read;

#if defined(FLUSH) && defined(__arm__)
    __asm volatile("vmsr fpscr, %0" : : "r"(1u << 24));
#elif defined(FLUSH)
    __builtin_ia32_ldmxcsr(0x9FC0u);
#endif
    if (!rack_arithmetic_is_sound()) {
        test_put("arithmetic is not sound\n");
        return 1;
    }
    rack_init(&caged);
    wrong += rack_memory_init(&memory, &sensors[0]) ? 0u : 1u;
    for (read = next_ticks(); read > 0u; read = next_ticks()) {
        size_t place;

        for (place = 0u; place < read; place++) {
            wrong += differs(&ticks[place]);
            number++;
        }
    }
    counts();
    test_put_number(number);
    test_put(" ticks, ");
    test_put_number(wrong);
    test_put(" differ\n");
    test_put(((wrong == 0u) && (number == NUMBER)) ? "passed\n" : "FAILED\n");
    return ((wrong == 0u) && (number == NUMBER)) ? 0 : 1;
}
