/* What becomes of the torque of the README's example: it runs as it stands there. */
#include "epas_test.h"

/* Of the example. */
void report(const char *field, const epas_failure_t *failure);
void friction_init(void);
float friction_step(float nut_speed, float axial_load);

#define LARGEST_STEP 0.1f
#define HOLD_TICKS 10u

/* A step is a difference of torques below 4 N m, each rounded once. */
#define ROUNDING 4.8e-7f

static uint32_t wrong;
static float last;

void report(const char *field, const epas_failure_t *failure)
{
    (void)failure;
    test_put(field);
    test_put(" is out of range\n");
    wrong++;
}

static void expect(uint32_t holds, const char *what)
{
    if (holds == 0u) {
        test_put(what);
        test_put("\n");
        wrong++;
    }
}

/* A tick, and that it makes no jump. */
static float tick(float nut_speed, float axial_load)
{
    const float torque = friction_step(nut_speed, axial_load);
    const float step = torque - last;

    expect((uint32_t)((step <= (LARGEST_STEP + ROUNDING)) && (step >= -(LARGEST_STEP + ROUNDING))),
           "the torque jumps");
    last = torque;
    return torque;
}

/* The load passes its limit of 20 kN and comes back: the torque stays that of the limit. */
static void beyond_the_limit(void)
{
    float at_limit = 0.0f;
    float load;

    for (load = 15000.0f; load <= 20000.0f; load += 100.0f) {
        at_limit = tick(30.0f, load);
    }
    for (load = 20100.0f; load <= 23000.0f; load += 100.0f) {
        expect((uint32_t)(tick(30.0f, load) == at_limit), "the torque leaves that of the limit");
    }
    expect((uint32_t)(at_limit > 0.2f), "there is no torque");
}

/* Without a load: held, faded, and back. */
static void without_a_load(void)
{
    const float sound = tick(30.0f, 15000.0f);
    const float none = 0.0f;
    const float nan = none / none;
    float torque = sound;
    uint32_t count;

    for (count = 0u; count < HOLD_TICKS; count++) {
        expect((uint32_t)(tick(30.0f, nan) == sound), "the torque is not held");
    }
    for (count = 0u; count < 50u; count++) {
        const float faded = tick(nan, 15000.0f);
        expect((uint32_t)(faded == (0.98f * torque)), "the torque does not fade");
        torque = faded;
    }
    expect((uint32_t)((torque > (0.36f * sound)) && (torque < (0.37f * sound))), "the fade has another pace");
    for (count = 0u; count < 40u; count++) {
        torque = tick(30.0f, 15000.0f);
    }
    expect((uint32_t)(torque == sound), "the torque does not come back");
}

uint32_t test_reaction(void)
{
    uint32_t count;

    wrong = 0u;
    last = 0.0f;
    friction_init();
    for (count = 0u; count < 40u; count++) {
        (void)tick(30.0f, 15000.0f);
    }
    beyond_the_limit();
    for (count = 0u; count < 40u; count++) {
        (void)tick(30.0f, 15000.0f);
    }
    without_a_load();
    test_put((wrong == 0u) ? "the example's torque never jumps\n" : "the example's torque is wrong\n");
    return wrong;
}
