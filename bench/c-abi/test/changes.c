/* What is set while a model runs: block, friction coefficient, law, level; and what is refused of it. */
#include "epas_test.h"

#include <stddef.h>

static uint32_t failed;

static void check(uint32_t holds, const char *what)
{
    if (holds == 0u) {
        failed++;
        test_put("failed: ");
        test_put(what);
        test_put("\n");
    }
}

/* Within a part of the second number. */
static uint32_t near(float found, float wanted, float part)
{
    const float most = (wanted < 0.0f) ? (-part * wanted) : (part * wanted);
    const float off = found - wanted;

    return ((off <= most) && (off >= -most)) ? 1u : 0u;
}

static float no_number(void)
{
    static volatile float zero = 0.0f;

    return zero / zero;
}

/* Another block and another friction coefficient are there from the next tick on, as in a model that was made so. */
static void caged(void)
{
    static epas_caged_t changed;
    static epas_caged_t made;
    static epas_caged_range_t range;
    const epas_inputs_t inputs = {60.0f, 6000.0f};
    const epas_block_t none = {NULL, 0u};
    epas_outputs_t before = {0};
    epas_outputs_t found = {0};
    epas_outputs_t wanted = {0};
    epas_failure_t failure;

    check(test_setup_caged(&changed) == EPAS_OK, "a caged screw");
    check(epas_caged_init(&made, &test_worn_block, NULL) == EPAS_OK, "a worn one");
    (void)epas_caged_step(&changed, &inputs, &before);
    check(epas_caged_swap(&changed, &test_range_block, &failure) == EPAS_BLOCK_NODES, "a block of another scene");
    check(failure.field == EPAS_FIELD_BLOCK, "and which field");
    check(epas_caged_swap(&changed, &none, NULL) == EPAS_NULL_POINTER, "no words");
    check(epas_caged_swap(&changed, NULL, NULL) == EPAS_NULL_POINTER, "no block");
    (void)epas_caged_step(&changed, &inputs, &found);
    check(found.friction_torque == before.friction_torque, "what was refused changes nothing");
    check(epas_caged_swap(&changed, &test_worn_block, &failure) == EPAS_OK, "another block");
    check(failure.status == EPAS_OK, "and no failure");
    (void)epas_caged_step(&changed, &inputs, &found);
    (void)epas_caged_step(&made, &inputs, &wanted);
    check(found.friction_torque == wanted.friction_torque, "friction of the other block in the next tick");
    check(near(found.friction_torque, before.friction_torque, 1e-2f) == 0u, "which is another one");
    check(epas_caged_swap(NULL, &test_block, NULL) == EPAS_NULL_POINTER, "no place");

    check(test_setup_caged_range(&range) == EPAS_OK, "a range of friction coefficients");
    (void)epas_caged_range_step(&range, &inputs, &before);
    check(epas_caged_range_set_friction(&range, 0.6f, &failure) == EPAS_OUT_OF_RANGE, "a friction coefficient too large");
    check((failure.field == EPAS_FIELD_FRICTION) && (failure.minimum == 0.05f) && (failure.maximum == 0.15f), "and which");
    check(epas_caged_range_set_friction(&range, 0.11f, &failure) == EPAS_OK, "another friction coefficient");
    (void)epas_caged_range_step(&range, &inputs, &found);
    check(found.friction_torque > (1.2f * before.friction_torque), "more friction in the next tick");
    check(epas_caged_range_reset(&range) == EPAS_OK, "a reset");
    (void)epas_caged_range_step(&range, &inputs, &found);
    check(found.friction_torque == before.friction_torque, "brings the block's back");
    check(epas_caged_range_set_friction(NULL, 0.1f, NULL) == EPAS_NULL_POINTER, "no place");
}

/* Another folded ball and another friction coefficient are there from the next tick on, as in a model that was made so. */
static void screw(void)
{
    static epas_screw_t changed;
    static epas_screw_t made;
    const epas_inputs_t inputs = {60.0f, 6000.0f};
    epas_screw_configuration_t wrong = test_screw_configuration;
    epas_screw_outputs_t before = {0};
    epas_screw_outputs_t found = {0};
    epas_screw_outputs_t wanted = {0};
    epas_failure_t failure;
    uint32_t tick;

    check((test_setup_screw(&changed) == EPAS_OK) && (test_setup_screw(&made) == EPAS_OK), "screws");
    check(epas_screw_swap(&made, &test_worn_screw_configuration, NULL) == EPAS_OK, "a worn one");
    check(epas_screw_swap(NULL, &test_screw_configuration, NULL) == EPAS_NULL_POINTER, "no place");
    check(epas_screw_swap(&changed, NULL, NULL) == EPAS_NULL_POINTER, "no configuration");
    check(epas_folded_ball_init(&test_spare_ball, &test_block, NULL) != EPAS_OK, "a folded ball of no words");
    wrong.folded = &test_spare_ball;
    check(epas_screw_swap(&changed, &wrong, &failure) == EPAS_NOT_INITIALISED, "which is none");
    check(failure.field == EPAS_FIELD_FOLDED, "and which field");
    wrong = test_screw_configuration;
    wrong.circuit.turns = 1.5f;
    check(epas_screw_swap(&changed, &wrong, &failure) == EPAS_OUT_OF_RANGE, "a track on which the balls do not fit");
    check(failure.field == EPAS_FIELD_BALL_PITCH, "and which field");
    for (tick = 0u; tick < 50u; tick++) {
        (void)epas_screw_step(&changed, &inputs, &before);
        (void)epas_screw_step(&made, &inputs, &wanted);
    }
    check(near(wanted.groove_torque, before.groove_torque, 1e-2f) == 0u, "wear shows");
    check(epas_screw_swap(&changed, &test_worn_screw_configuration, &failure) == EPAS_OK, "another folded ball");
    check(failure.status == EPAS_OK, "and no failure");
    (void)epas_screw_step(&changed, &inputs, &found);
    (void)epas_screw_step(&made, &inputs, &wanted);
    check((found.friction_torque == wanted.friction_torque) && (found.contacts == wanted.contacts),
          "friction of the other folded ball in the next tick, with the balls where they were");
}

static void screw_range(void)
{
    static epas_screw_range_t place;
    static epas_screw_range_t next;
    static uint8_t block[EPAS_SCREW_RANGE_STATE_BYTES];
    const epas_inputs_t inputs = {60.0f, 6000.0f};
    epas_screw_outputs_t before = {0};
    epas_screw_outputs_t found = {0};
    epas_screw_outputs_t wanted = {0};
    epas_failure_t failure;
    uint32_t ticks = 1u;

    check(epas_screw_range_step(&place, &inputs, &found) == EPAS_NOT_INITIALISED, "a place of zeros");
    check(found.faults == EPAS_FAULT_CALL, "a place of zeros, flagged");
    check((test_setup_screw_range(&place) == EPAS_OK) && (test_setup_screw_range(&next) == EPAS_OK), "screws");
    check(epas_screw_range_set_friction(NULL, 0.1f, NULL) == EPAS_NULL_POINTER, "no place");
    check(epas_screw_range_set_friction(&place, 0.0f, &failure) == EPAS_OUT_OF_RANGE, "no friction");
    check((failure.field == EPAS_FIELD_FRICTION) && (failure.minimum > 0.0f) && (failure.maximum > failure.minimum),
          "and which there may be");
    check(epas_screw_range_set_friction(&place, no_number(), NULL) == EPAS_NOT_FINITE, "a friction coefficient that is none");
    check(epas_screw_range_set_friction(&place, failure.minimum, NULL) == EPAS_OK, "the least friction coefficient");
    (void)epas_screw_range_step(&place, &inputs, &before);
    check(epas_screw_range_set_friction(&place, failure.maximum, NULL) == EPAS_OK, "the largest one");
    (void)epas_screw_range_step(&place, &inputs, &found);
    check(found.groove_torque > (1.2f * before.groove_torque), "more friction in the next tick");
    check(epas_screw_range_faulted_ticks(&place, &ticks) == EPAS_OK, "counter");
    check(ticks == 0u, "no faulted ticks");

    /* The next ignition: the friction coefficient that was set is there again. */
    check(epas_screw_range_export(&place, block, 369u) == EPAS_STATE_LENGTH, "no room");
    check(epas_screw_range_export(&place, block, sizeof block) == EPAS_OK, "export");
    check(epas_screw_range_import(&next, block, sizeof block) == EPAS_OK, "import");
    (void)epas_screw_range_step(&place, &inputs, &wanted);
    (void)epas_screw_range_step(&next, &inputs, &found);
    check((found.friction_torque == wanted.friction_torque) && (found.contacts == wanted.contacts), "a tick after an import");

    /* A swap, and a reset, bring the folded friction coefficient back. */
    check(epas_screw_range_swap(&place, &test_screw_range_configuration, NULL) == EPAS_OK, "a swap");
    (void)epas_screw_range_step(&place, &inputs, &found);
    check(found.groove_torque < wanted.groove_torque, "which brings the folded coefficient back");
    check(epas_screw_range_reset(&next) == EPAS_OK, "a reset");
    (void)epas_screw_range_step(&next, &inputs, &found);
    check(found.groove_torque < wanted.groove_torque, "which does so too");
}

static void linear(void)
{
    static epas_linear_t place;
    const epas_linear_inputs_t inputs = {0.3f, 2000.0f, 300.0f};
    epas_linear_outputs_t before = {0};
    epas_linear_outputs_t found = {0};
    epas_failure_t failure;
    uint32_t tick;

    check(test_setup_linear(&place) == EPAS_OK, "a bearing");
    for (tick = 0u; tick < 40u; tick++) {
        (void)epas_linear_step(&place, &inputs, &before);
    }
    check(test_setup_linear(&place) == EPAS_OK, "a bearing again");
    check(epas_linear_set_friction(&place, 2.0f, &failure) == EPAS_OUT_OF_RANGE, "a friction coefficient too large");
    check((failure.minimum == 1e-6f) && (failure.maximum == 1.0f), "and which there may be");
    check(epas_linear_set_friction(&place, 0.2f, NULL) == EPAS_OK, "twice the friction coefficient");
    for (tick = 0u; tick < 40u; tick++) {
        (void)epas_linear_step(&place, &inputs, &found);
    }
    /* A handful of roundings. */
    check(near(found.friction_force, 2.0f * before.friction_force, 1e-6f), "twice the friction");
    check(near(found.largest_contact_force, 2.0f * before.largest_contact_force, 1e-6f), "twice the forces");
}

/* Once round, in steps of a count. */
static epas_outputs_t turned(epas_memory_t *place, uint32_t start, uint32_t counts, uint32_t backwards)
{
    epas_memory_inputs_t inputs = {0.0f, 5000.0f, 0u, 0.0f, 293.15f, 0.0f};
    epas_outputs_t outputs = {0};
    uint32_t count;

    for (count = 0u; count <= counts; count++) {
        inputs.count = (backwards != 0u) ? (start - count) : (start + count);
        (void)epas_memory_step(place, &inputs, &outputs);
    }
    return outputs;
}

/* Screws that remember. */
static epas_memory_t remembering;
static epas_memory_t next_remembering;

static void memory(void)
{
    static uint8_t block[EPAS_MEMORY_STATE_BYTES];
    static uint8_t caged_block[EPAS_CAGED_STATE_BYTES];
    epas_memory_configuration_t wrong = test_memory_configuration;
    epas_memory_configuration_t soft = test_memory_configuration;
    epas_memory_inputs_t inputs = {0.0f, 5000.0f, 1000u, 0.0f, 293.15f, 0.0f};
    epas_coefficient_t law = test_memory_configuration.coefficient;
    epas_outputs_t forward;
    epas_outputs_t other;
    epas_failure_t failure;

    wrong.encoder.play = -1.0f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "a play below zero");
    check(failure.field == EPAS_FIELD_PLAY, "and which field");
    wrong = test_memory_configuration;
    wrong.block = test_block;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_BLOCK_LENGTH, "a block for one friction coefficient");
    check(failure.field == EPAS_FIELD_BLOCK, "and which field");
    wrong = test_memory_configuration;
    wrong.slip_angle = no_number();
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_NOT_FINITE, "no breakaway angle of slip");
    check(failure.field == EPAS_FIELD_SLIP_ANGLE, "and which field");
    wrong = test_memory_configuration;
    wrong.spin_angle = 0.0f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "no breakaway angle of spin");
    check(failure.field == EPAS_FIELD_SPIN_ANGLE, "and which field");
    wrong = test_memory_configuration;
    wrong.slip_share = 1.0f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "no share of spin");
    check(failure.field == EPAS_FIELD_SLIP_SHARE, "and which field");
    wrong = test_memory_configuration;
    wrong.coefficient.oil.pour_point = 400.0f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "no pour point");
    check(failure.field == EPAS_FIELD_POUR_POINT, "and which field");
    wrong = test_memory_configuration;
    wrong.coefficient.boundary = 0.9f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "a coefficient too large for the screw");
    check((failure.field == EPAS_FIELD_COEFFICIENT) && (failure.maximum == 0.5f), "and which field");
    wrong = test_memory_configuration;
    wrong.reference_torque = -1.0f;
    check(epas_memory_init(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "no reference torque");
    check(failure.field == EPAS_FIELD_REFERENCE_TORQUE, "and which field");
    check(epas_memory_step(&remembering, &inputs, &other) == EPAS_NOT_INITIALISED, "what was refused has no model");
    check((other.faults == EPAS_FAULT_CALL) && (other.friction_torque == 0.0f), "no torque, flagged");
    check(epas_memory_between(&next_remembering, 0u, &other) == EPAS_NOT_INITIALISED, "between, of zeros");
    check(other.faults == EPAS_FAULT_CALL, "between, flagged");

    check(test_setup_memory(&remembering) == EPAS_OK, "a screw that remembers");
    check(epas_memory_between(&remembering, 1000u, &other) == EPAS_OK, "before the first step");
    check(other.friction_torque == 0.0f, "there is no friction");
    forward = turned(&remembering, 1000u, 400u, 0u);
    check((forward.friction_torque > 0.0f) && (forward.faults == 0u), "friction forward");
    other = turned(&remembering, 1400u, 0u, 0u);
    check(other.friction_torque == forward.friction_torque, "at rest friction stays");
    /* The play and one count take nothing away; a motion beyond the breakaway angle turns it round. */
    other = turned(&remembering, 1400u, 1u, 1u);
    check(other.friction_torque == forward.friction_torque, "the play");
    other = turned(&remembering, 1399u, 400u, 1u);
    check(other.friction_torque < (-0.9f * forward.friction_torque), "friction backward");
    check(epas_memory_between(&remembering, 99999u, &forward) == EPAS_OK, "a count that is none");
    check((forward.faults == EPAS_FAULT_ANGLE_NOT_VALID) && (forward.friction_torque == other.friction_torque),
          "friction stays, flagged");

    /* A larger breakaway angle: friction builds up later. */
    soft.slip_angle = 0.1f;
    check(epas_memory_init(&next_remembering, &soft, NULL) == EPAS_OK, "a breakaway angle as measured");
    (void)turned(&next_remembering, 1000u, 4000u, 0u);
    (void)turned(&remembering, 1000u, 4000u, 0u);
    forward = turned(&remembering, 5000u, 10u, 1u);
    other = turned(&next_remembering, 5000u, 10u, 1u);
    check(other.friction_torque > forward.friction_torque, "the larger angle");

    check(epas_memory_set_level(&remembering, 20.0f, 1.0f, &failure) == EPAS_OUT_OF_RANGE, "a level too large");
    check(failure.field == EPAS_FIELD_FORWARD, "and which");
    law.full_film = 0.0f;
    check(epas_memory_set_coefficient(&remembering, &law, &failure) == EPAS_OUT_OF_RANGE, "a law without friction");
    check(failure.field == EPAS_FIELD_FULL_FILM, "and which field");
    check(epas_memory_set_coefficient(&remembering, NULL, NULL) == EPAS_NULL_POINTER, "no law");
    check(epas_memory_swap(&remembering, &wrong, &failure) == EPAS_OUT_OF_RANGE, "a swap without a reference torque");
    check(failure.field == EPAS_FIELD_REFERENCE_TORQUE, "and which field");

    check(epas_memory_export(&remembering, block, sizeof block - 1u) == EPAS_STATE_LENGTH, "no room");
    check(epas_memory_export(&remembering, block, sizeof block) == EPAS_OK, "export");
    check(test_setup_memory(&next_remembering) == EPAS_OK, "the next ignition");
    block[40] ^= 1u;
    check(epas_memory_import(&next_remembering, block, sizeof block) == EPAS_STATE_DAMAGED, "a damaged block");
    block[40] ^= 1u;
    check(epas_caged_import(NULL, caged_block, sizeof caged_block) == EPAS_NULL_POINTER, "no place");
    check(epas_memory_import_with_count(&next_remembering, block, sizeof block) == EPAS_OK, "import with the count");
    inputs.count = 4990u;
    (void)epas_memory_step(&remembering, &inputs, &forward);
    (void)epas_memory_step(&next_remembering, &inputs, &other);
    check(forward.friction_torque == other.friction_torque, "a tick after an import");
    check(epas_memory_import(&next_remembering, block, sizeof block) == EPAS_OK, "import without the count");
    inputs.count = 12000u;
    (void)epas_memory_step(&next_remembering, &inputs, &other);
    check((other.faults == 0u) && (other.friction_torque == forward.friction_torque), "the turn in between is unknown");
}

/* Levels of the screw itself after its commissioning. */
#define FORWARD 1.4f
#define BACKWARD 1.2f
/* Parts by which levels and drift may be off: 2e-6 and 0.01 measured, the drift's average takes its time. */
#define LEVEL_FOUND 1e-3f
#define DRIFT_FOUND 0.02f

/* The closed loop of the screw itself (`remembering`) and its model (`next_remembering`): what the adaptation finds is set as the model's level, and comes back in its friction torque. */
static void adapted(void)
{
    static epas_adaptation_t adaptation;
    static const epas_adaptation_configuration_t configuration = {
        .tick = 0.01f, .forgetting_time = 2.0f, .filter_time = 0.02f, .noise = 2e-3f,
        .level_deviation = 0.3f, .least_level = 0.4f, .largest_level = 2.5f,
        .largest_torque = 40.0f, .largest_speed = 500.0f, .least_speed = 0.2f, .least_friction = 5e-3f,
        .average_time = 4.0f, .fall = 0.25f, .rise = 0.25f, .hysteresis = 0.1f,
    };
    epas_memory_inputs_t inputs = {0.0f, 5000.0f, 1000u, 0.0f, 293.15f, 0.0f};
    epas_adaptation_outputs_t found = {.forward = 1.0f, .backward = 1.0f};
    uint32_t refused = 0u;
    uint32_t tick;

    check(test_setup_memory(&remembering) == EPAS_OK, "a screw");
    check(test_setup_memory(&next_remembering) == EPAS_OK, "its model");
    check(epas_adaptation_init(&adaptation, &configuration, NULL) == EPAS_OK, "an adaptation");
    for (tick = 0u; tick < 4000u; tick++) {
        /* To and fro, 6 rad/s: 400 counts a tick. */
        const uint32_t back = (tick / 100u) % 2u;
        epas_outputs_t outputs = {0};
        epas_adaptation_inputs_t now = {.forward = found.forward, .backward = found.backward};

        if (tick == 1000u) {
            check(near(found.forward, 1.0f, 1e-3f) && near(found.backward, 1.0f, 1e-3f), "levels of 1");
            check(epas_adaptation_commission(&adaptation) == EPAS_OK, "commissioning");
            check(epas_memory_set_level(&remembering, FORWARD, BACKWARD, NULL) == EPAS_OK, "more friction");
        }
        inputs.count = (inputs.count + ((back == 0u) ? 400u : (16384u - 400u))) % 16384u;
        inputs.nut_speed = (back == 0u) ? 6.136f : -6.136f;
        (void)epas_memory_step(&remembering, &inputs, &outputs);
        now.observed = outputs.friction_torque;
        refused += epas_memory_set_level(&next_remembering, found.forward, found.backward, NULL);
        refused += epas_memory_step(&next_remembering, &inputs, &outputs);
        now.modelled = outputs.friction_torque;
        refused += epas_memory_drag_torque(&next_remembering, &now.lubricant_drag);
        now.load_torque = outputs.load_torque;
        now.nut_speed = inputs.nut_speed;
        now.regime = outputs.regime;
        now.faults = outputs.faults;
        refused += epas_adaptation_update(&adaptation, &now, &found);
    }
    check(refused == 0u, "a loop that is closed");
    check(near(found.forward, FORWARD, LEVEL_FOUND) && near(found.backward, BACKWARD, LEVEL_FOUND), "the screw's levels");
    check(near(found.drift, 0.5f * (FORWARD + BACKWARD) - 1.0f, DRIFT_FOUND), "their drift");
    check((found.health == EPAS_HEALTH_RISEN) && (found.flags == 0u), "which is flagged");
}

uint32_t test_changes(void)
{
    failed = 0u;
    caged();
    screw();
    screw_range();
    linear();
    memory();
    adapted();
    test_put("changes while a model runs: ");
    test_put_number(failed);
    test_put(" failed\n");
    return failed;
}
