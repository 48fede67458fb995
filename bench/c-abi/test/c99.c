/* A screw as `epas design --format c99` writes it: the ticks of check/src/c99.rs, whose outputs have to be the crate's to the bit. */
#include "expected.h"
#include "rack.h"

#include <stddef.h>

#if defined(__arm__)
#include "board.h"

void test_put(const char *text);
void test_put_number(uint32_t number);
#else
#include <stdio.h>

static void test_put(const char *text)
{
    (void)fputs(text, stdout);
}

static void test_put_number(uint32_t number)
{
    (void)printf("%lu", (unsigned long)number);
}
#endif

static uint32_t random_word;

static uint32_t next(void)
{
    random_word ^= random_word << 13;
    random_word ^= random_word >> 17;
    random_word ^= random_word << 5;
    return random_word;
}

static float number(uint32_t bits)
{
    union {
        uint32_t bits;
        float number;
    } both;

    both.bits = bits;
    return both.number;
}

static uint32_t bits(float number)
{
    union {
        uint32_t bits;
        float number;
    } both;

    both.number = number;
    return both.bits;
}

/* A number within plus and minus a bound. */
static float within(float bound)
{
    return ((float)(next() >> 8) - 8388608.0f) * (bound * 0x1p-23f);
}

static float between(float least, float most)
{
    return least + ((float)(next() >> 8) * ((most - least) * 0x1p-24f));
}

/* A number up to a little more than a bound, of any size and sign; now and then a special one, or any bits. */
static float quantity(float bound)
{
    static const uint32_t special[8] = {0x7FC00000u, 0x7F800000u, 0xFF800000u, 0u, 0x80000000u, 0x00000123u, 0x80400000u, 0x7F7FFFFFu};
    const uint32_t kind = next() % 64u;
    const uint32_t size = next() % 16u;
    float found = within(1.1f * bound);
    uint32_t half;

    for (half = 0u; half < size; half++) {
        found *= 0.5f;
    }
    if (kind < 8u) {
        found = number(special[kind]);
    } else if (kind == 8u) {
        found = bound;
    } else if (kind == 9u) {
        found = number(next());
    } else {
        /* as it is */
    }
    return found;
}

static const rack_sensors_t sensors[3] = {
    {16384u, 1.533981e-4f, 1.2f, 1e-4f, 0.01f, 0.09f, 313.15f, 10.0f, 60.0f},
    {0u, -2e-3f, 0.5f, 0.0f, 0.0f, 0.5f, 280.0f, 0.0f, 1e-3f},
    {5u, 0.01f, 0.025f, 5e-3f, 0.02f, 1e-6f, 500.0f, 1.0f, 7.0f},
};

static rack_t caged;
static rack_memory_t memory;
static uint32_t period;
static uint32_t count;
static uint32_t row[WORDS];

static void put(uint32_t at, const rack_outputs_t *outputs)
{
    row[at] = bits(outputs->friction_torque);
    row[at + 1u] = bits(outputs->load_torque);
    row[at + 2u] = bits(outputs->efficiency);
    row[at + 3u] = outputs->regime;
    row[at + 4u] = outputs->faults;
}

static uint32_t turned(void)
{
    const uint32_t kind = next() % 64u;
    const uint32_t most = (kind < 8u) ? 4000u : 3u;
    const uint32_t ahead = next() % ((2u * most) + 1u);

    if (period == 0u) {
        count = (count + ahead) - most;
    } else {
        count = ((count + ahead) + ((most * period) - most)) % period;
    }
    return (kind == 63u) ? 4294967295u : count;
}

/* What is set now and then; whether it was. */
static uint32_t change(void)
{
    const uint32_t kind = next() % 256u;
    const float first = between(0.02f, 0.6f);
    const float second = between(0.02f, 0.2f);
    uint32_t set = 2u;

    if (kind < 8u) {
        set = rack_set_friction(&caged, first) ? 1u : 0u;
    } else if (kind < 12u) {
        set = rack_memory_set_coefficient(&memory, first, second) ? 1u : 0u;
    } else if (kind < 16u) {
        set = rack_memory_set_level(&memory, 10.0f * first, 10.0f * second) ? 1u : 0u;
    } else if (kind == 16u) {
        const rack_sensors_t *other = &sensors[next() % 3u];

        set = rack_memory_init(&memory, other) ? 1u : 0u;
        period = other->period;
        count = 0u;
    } else if (kind == 17u) {
        set = rack_set_friction(&caged, quantity(0.1f)) ? 1u : 0u;
    } else {
        /* nothing */
    }
    return set;
}

static void tick(void)
{
    rack_outputs_t outputs;
    rack_memory_inputs_t inputs;

    row[0] = change();
    inputs.nut_speed = quantity(100.0f);
    inputs.axial_load = quantity(20000.0f);
    rack_step(&caged, inputs.nut_speed, inputs.axial_load, &outputs);
    put(1u, &outputs);
    inputs.count = turned();
    inputs.load_age = ((next() % 8u) == 0u) ? quantity(0.2f) : 0.001f;
    inputs.temperature = ((next() % 16u) == 0u) ? quantity(600.0f) : between(240.0f, 380.0f);
    inputs.temperature_age = ((next() % 8u) == 0u) ? quantity(100.0f) : 0.5f;
    rack_memory_step(&memory, &inputs, &outputs);
    put(6u, &outputs);
    rack_memory_between(&memory, turned(), &outputs);
    put(11u, &outputs);
    row[16] = bits(memory.drag_torque);
    row[17] = caged.faulted_ticks + memory.faulted_ticks;
}

/* The number of stored ticks, or of thousands of ticks, that differ. */
static uint32_t ticks(void)
{
    uint32_t wrong = 0u;
    uint32_t thousand;
    uint32_t sum = 2166136261u;

    random_word = SEED;
    period = sensors[0].period;
    rack_init(&caged);
    wrong += rack_memory_init(&memory, &sensors[0]) ? 0u : 1u;
    rack_memory_between(&memory, 5u, &(rack_outputs_t){0.0f, 0.0f, 0.0f, 0u, 0u});
    for (thousand = 0u; thousand < THOUSANDS; thousand++) {
        uint32_t place;

        for (place = 0u; place < 1000u; place++) {
            uint32_t word;
            uint32_t differs = 0u;

            tick();
            for (word = 0u; word < WORDS; word++) {
                sum = (sum ^ row[word]) * 16777619u;
                if ((thousand == 0u) && (row[word] != stored[place][word])) {
                    differs = 1u;
                }
            }
            wrong += differs;
            if ((differs != 0u) && (wrong < 4u)) {
                test_put("tick ");
                test_put_number(place);
                test_put(" differs\n");
            }
        }
        if (sum != sums[thousand]) {
            wrong++;
        }
    }
    return wrong;
}

/* Each number of the sensors out of its range, alone. */
static uint32_t refusals(void)
{
    const rack_sensors_t good = sensors[0];
    rack_sensors_t bad[10];
    uint32_t place;
    uint32_t wrong = 0u;

    for (place = 0u; place < 10u; place++) {
        bad[place] = good;
    }
    bad[0].period = 1u;
    bad[1].turn_per_count = 0.0f;
    bad[2].largest_turn = 1.3f;
    bad[3].play = -1e-3f;
    bad[4].load_hold = number(0x7FC00000u);
    bad[5].load_fade = 0.0f;
    bad[6].fallback_temperature = 20.0f;
    bad[7].temperature_hold = 1e5f;
    bad[8].temperature_fade = number(0x7F800000u);
    bad[9].turn_per_count = number(0x7FC00000u);
    for (place = 0u; place < 10u; place++) {
        wrong += rack_memory_init(&memory, &bad[place]) ? 1u : 0u;
    }
    return wrong;
}

#if defined(FLUSH)
static void flush(void)
{
#if defined(__arm__)
    __asm volatile("vmsr fpscr, %0" : : "r"(1u << 24));
#else
    __builtin_ia32_ldmxcsr(0x9FC0u);
#endif
}
#endif

#if defined(__arm__)
#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)

/* Instructions in a tick of the timer, where QEMU counts one instruction a nanosecond. */
#define INSTRUCTIONS 40u
#define CALLS 400u

static rack_outputs_t counted_outputs;
static rack_memory_inputs_t counted_inputs;

static void nothing(void) { __asm volatile("" : : : "memory"); }
static void step(void) { rack_step(&caged, counted_inputs.nut_speed, counted_inputs.axial_load, &counted_outputs); }
static void memory_step(void) { rack_memory_step(&memory, &counted_inputs, &counted_outputs); }
static void memory_between(void) { rack_memory_between(&memory, counted_inputs.count, &counted_outputs); }

static uint32_t ticks_of(void (*volatile function)(void))
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
    uint32_t most = 0u;
    uint32_t place;

    random_word = SEED;
    (void)rack_memory_init(&memory, &sensors[0]);
    rack_init(&caged);
    for (place = 0u; place < 64u; place++) {
        uint32_t instructions;

        counted_inputs.nut_speed = within(100.0f);
        counted_inputs.axial_load = within(20000.0f);
        counted_inputs.count = next() % 16384u;
        counted_inputs.temperature = between(250.0f, 400.0f);
        memory_step();
        instructions = ((ticks_of(function) - ticks_of(nothing)) * INSTRUCTIONS) / CALLS;
        most = (instructions > most) ? instructions : most;
    }
    test_put(name);
    test_put(": ");
    test_put_number(most);
    test_put(" instructions\n");
}

void sys_tick_handler(void)
{
}
#endif

int main(void)
{
    uint32_t wrong = 0u;

#if defined(FLUSH)
    flush();
#endif
    if (!rack_arithmetic_is_sound()) {
        test_put("arithmetic is not sound\n");
        wrong = 1u;
    } else {
        wrong = ticks() + refusals();
        test_put_number(wrong);
        test_put(" differ\n");
#if defined(__arm__)
        count_of("step", step);
        count_of("memory_step", memory_step);
        count_of("memory_between", memory_between);
#endif
    }
    test_put((wrong == 0u) ? "passed\n" : "FAILED\n");
    return (wrong == 0u) ? 0 : 1;
}
