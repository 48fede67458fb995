/* Stored cases: what the crate makes of them on the host, called from Rust, and what the library makes of
 * them here, bit for bit. */
#include "epas_test.h"

#include <stddef.h>

#include "stored.h"

#define ROWS(table) ((uint32_t)(sizeof(table) / sizeof((table)[0])))

const uint32_t test_ticks = ROWS(stored_caged);

/* A float by its bits. */
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

static uint32_t differ(const uint32_t *found, const uint32_t *stored, uint32_t count)
{
    uint32_t word;
    uint32_t differs = 0u;

    for (word = 0u; word < count; word++) {
        if (found[word] != stored[word]) {
            differs = 1u;
        }
    }
    return differs;
}

static uint32_t screw_differs(const epas_outputs_t *outputs, const uint32_t *stored)
{
    uint32_t found[5];

    found[0] = bits(outputs->friction_torque);
    found[1] = bits(outputs->load_torque);
    found[2] = bits(outputs->efficiency);
    found[3] = outputs->regime;
    found[4] = outputs->faults;
    return differ(found, stored, 5u);
}

/* Worn from the middle on; anew from the first tick on. */
uint32_t test_caged_tick(epas_caged_t *place, uint32_t tick)
{
    const uint32_t *row = stored_caged[tick];
    const epas_inputs_t inputs = {number(row[0]), number(row[1])};
    epas_outputs_t outputs;
    uint32_t status = EPAS_OK;

    if (tick == 0u) {
        status = epas_caged_swap(place, &test_block, NULL);
    } else if (tick == (test_ticks / 2u)) {
        status = epas_caged_swap(place, &test_worn_block, NULL);
    } else {
        /* As it was. */
    }
    if ((status != EPAS_OK) || (epas_caged_step(place, &inputs, &outputs) != EPAS_OK)) {
        return 1u;
    }
    return screw_differs(&outputs, &row[2]);
}

/* The friction coefficient rises in every tick. */
static uint32_t caged_range_tick(epas_caged_range_t *place, uint32_t tick)
{
    const uint32_t *row = stored_caged_range[tick];
    const epas_inputs_t inputs = {number(row[0]), number(row[1])};
    const float friction = 0.05f + ((float)tick * (0.1f / 256.0f));
    epas_outputs_t outputs;

    if ((epas_caged_range_set_friction(place, friction, NULL) != EPAS_OK)
        || (epas_caged_range_step(place, &inputs, &outputs) != EPAS_OK)) {
        return 1u;
    }
    return screw_differs(&outputs, &row[2]);
}

static uint32_t closed_form_tick(epas_closed_form_t *place, uint32_t tick)
{
    const uint32_t *row = stored_closed_form[tick];
    const epas_inputs_t inputs = {number(row[0]), number(row[1])};
    epas_outputs_t outputs;

    if (epas_closed_form_step(place, &inputs, &outputs) != EPAS_OK) {
        return 1u;
    }
    return screw_differs(&outputs, &row[2]);
}

/* What changes on the way, as in the stored case. */
static uint32_t memory_changes(epas_memory_t *place, uint32_t tick)
{
    epas_memory_configuration_t configuration = test_memory_configuration;
    epas_coefficient_t law = test_memory_configuration.coefficient;
    uint32_t status = EPAS_OK;

    if (tick == 64u) {
        status = epas_memory_set_level(place, 1.2f, 0.9f, NULL);
    } else if (tick == 128u) {
        configuration.block = test_other_range_block;
        status = epas_memory_swap(place, &configuration, NULL);
    } else if (tick == 192u) {
        law.boundary = 0.15f;
        status = epas_memory_set_coefficient(place, &law, NULL);
    } else {
        /* Nothing changes. */
    }
    return status;
}

uint32_t test_memory_tick(epas_memory_t *place, uint32_t tick)
{
    const uint32_t *row = stored_memory[tick];
    const epas_memory_inputs_t inputs = {number(row[0]), number(row[1]), row[2],
                                         number(row[3]), number(row[4]), number(row[5])};
    epas_outputs_t outputs;
    epas_outputs_t between;
    uint32_t found[8];

    if ((memory_changes(place, tick) != EPAS_OK) || (epas_memory_step(place, &inputs, &outputs) != EPAS_OK)
        || (epas_memory_between(place, row[6], &between) != EPAS_OK)) {
        return 1u;
    }
    found[0] = bits(outputs.friction_torque);
    found[1] = bits(outputs.load_torque);
    found[2] = bits(outputs.efficiency);
    found[3] = outputs.regime;
    found[4] = outputs.faults;
    found[5] = bits(between.friction_torque);
    found[6] = between.regime;
    found[7] = between.faults;
    return differ(found, &row[7], 8u);
}

static uint32_t screw_outputs_differ(const epas_screw_outputs_t *outputs, const uint32_t *stored)
{
    uint32_t found[8];

    found[0] = bits(outputs->friction_torque);
    found[1] = bits(outputs->groove_torque);
    found[2] = bits(outputs->ball_torque);
    found[3] = bits(outputs->load_torque);
    found[4] = bits(outputs->largest_contact_force);
    found[5] = outputs->contacts;
    found[6] = outputs->regime;
    found[7] = outputs->faults;
    return differ(found, stored, 8u);
}

/* Worn from the middle on; anew from the first tick on. */
uint32_t test_screw_tick(epas_screw_t *place, uint32_t tick)
{
    const uint32_t *row = stored_screw[tick];
    const epas_inputs_t inputs = {number(row[0]), number(row[1])};
    epas_screw_outputs_t outputs;
    uint32_t status = EPAS_OK;

    if (tick == 0u) {
        status = epas_screw_swap(place, &test_screw_configuration, NULL);
    } else if (tick == (test_ticks / 2u)) {
        status = epas_screw_swap(place, &test_worn_screw_configuration, NULL);
    } else {
        /* As it was. */
    }
    if ((status != EPAS_OK) || (epas_screw_step(place, &inputs, &outputs) != EPAS_OK)) {
        return 1u;
    }
    return screw_outputs_differ(&outputs, &row[2]);
}

/* The friction coefficient rises in every tick, from the least to the largest that was folded. */
static uint32_t screw_range_tick(epas_screw_range_t *place, uint32_t tick)
{
    const uint32_t *row = stored_screw_range[tick];
    const epas_inputs_t inputs = {number(row[0]), number(row[1])};
    epas_failure_t range;
    epas_screw_outputs_t outputs;
    float friction;

    /* What is refused says what there may be. */
    (void)epas_screw_range_set_friction(place, 0.0f, &range);
    friction = range.minimum + ((float)tick * ((range.maximum - range.minimum) / 256.0f));
    if ((epas_screw_range_set_friction(place, friction, NULL) != EPAS_OK)
        || (epas_screw_range_step(place, &inputs, &outputs) != EPAS_OK)) {
        return 1u;
    }
    return screw_outputs_differ(&outputs, &row[2]);
}

uint32_t test_linear_tick(epas_linear_t *place, uint32_t tick)
{
    const uint32_t *row = stored_linear[tick];
    const epas_linear_inputs_t inputs = {number(row[0]), number(row[1]), number(row[2])};
    epas_linear_outputs_t outputs;
    uint32_t found[7];

    if (epas_linear_step(place, &inputs, &outputs) != EPAS_OK) {
        return 1u;
    }
    found[0] = bits(outputs.friction_force);
    found[1] = bits(outputs.groove_force);
    found[2] = bits(outputs.ball_force);
    found[3] = bits(outputs.largest_contact_force);
    found[4] = outputs.contacts;
    found[5] = outputs.regime;
    found[6] = outputs.faults;
    return differ(found, &row[3], 7u);
}

static uint32_t efficiency_differs(const uint32_t *row)
{
    const epas_efficiency_request_t request = {
        .lead_angle = number(row[0]),
        .contact_angle = number(row[1]),
        .ball_ratio = number(row[2]),
        .friction = number(row[3]),
        .rolling_tangent = number(row[4]),
    };
    epas_efficiency_t answer;
    uint32_t found[6];

    if (epas_efficiency(&request, &answer, NULL) != EPAS_OK) {
        return 1u;
    }
    found[0] = bits(answer.rolling_drive);
    found[1] = bits(answer.rolling_backdrive);
    found[2] = bits(answer.sliding_drive);
    found[3] = bits(answer.sliding_backdrive);
    found[4] = answer.locked_drive;
    found[5] = answer.locked_backdrive;
    return differ(found, &row[5], 6u);
}

static uint32_t curvature_differs(const uint32_t *row)
{
    epas_curvature_request_t request = {.design = test_closed_form_configuration.design};
    epas_curvature_t answer;
    uint32_t found[4];

    request.design.pitch_radius = number(row[0]);
    request.design.lead = number(row[1]);
    request.design.ball_radius = number(row[2]);
    request.design.screw_conformity = 0.528f;
    request.design.nut_conformity = 0.528f;
    request.groove = row[3];
    request.contact_angle = number(row[4]);
    if (epas_curvature(&request, &answer, NULL) != EPAS_OK) {
        return 1u;
    }
    found[0] = bits(answer.first);
    found[1] = bits(answer.second);
    found[2] = bits(answer.circular_groove);
    found[3] = bits(answer.literature);
    return differ(found, &row[5], 4u);
}

static uint32_t reported(const char *name, uint32_t cases, uint32_t differing)
{
    test_put(name);
    test_put(": ");
    test_put_number(cases);
    test_put(" cases, ");
    test_put_number(differing);
    test_put(" differ\n");
    return differing;
}

uint32_t test_cases(void)
{
    static epas_caged_t caged;
    static epas_caged_range_t caged_range;
    static epas_closed_form_t closed_form;
    static epas_memory_t memory;
    static epas_screw_t screw;
    static epas_screw_range_t screw_range;
    static epas_linear_t linear;
    uint32_t total = 0u;
    uint32_t differing;
    uint32_t row;

    differing = (test_setup_caged(&caged) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_caged); row++) {
        differing += test_caged_tick(&caged, row);
    }
    total += reported("caged ball screw", ROWS(stored_caged), differing);

    differing = (test_setup_caged_range(&caged_range) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_caged_range); row++) {
        differing += caged_range_tick(&caged_range, row);
    }
    total += reported("the same with a friction coefficient that changes", ROWS(stored_caged_range), differing);

    differing = (test_setup_closed_form(&closed_form) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_closed_form); row++) {
        differing += closed_form_tick(&closed_form, row);
    }
    total += reported("the same by a closed form", ROWS(stored_closed_form), differing);

    differing = (test_setup_memory(&memory) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_memory); row++) {
        differing += test_memory_tick(&memory, row);
    }
    total += reported("ball screw whose friction remembers", ROWS(stored_memory), differing);

    /* A reset brings back what was set on the way, but for the block. */
    differing = (epas_memory_swap(&memory, &test_memory_configuration, NULL) == EPAS_OK) ? 0u : 1u;
    differing += (epas_memory_reset(&memory) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_memory); row++) {
        differing += test_memory_tick(&memory, row);
    }
    total += reported("the same after a reset", ROWS(stored_memory), differing);

    differing = (test_setup_screw(&screw) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_screw); row++) {
        differing += test_screw_tick(&screw, row);
    }
    total += reported("ball screw, balls press on each other", ROWS(stored_screw), differing);

    /* After a reset everything comes again, but for the folded ball, which the first tick swaps back. */
    differing = (epas_screw_reset(&screw) == EPAS_OK) ? 0u : 1u;
    differing += (epas_screw_set_nut_angle(&screw, 1.25f) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_screw); row++) {
        differing += test_screw_tick(&screw, row);
    }
    total += reported("the same after a reset", ROWS(stored_screw), differing);

    differing = (test_setup_screw_range(&screw_range) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_screw_range); row++) {
        differing += screw_range_tick(&screw_range, row);
    }
    total += reported("the same with a friction coefficient that changes", ROWS(stored_screw_range), differing);

    differing = (test_setup_linear(&linear) == EPAS_OK) ? 0u : 1u;
    for (row = 0u; row < ROWS(stored_linear); row++) {
        differing += test_linear_tick(&linear, row);
    }
    total += reported("linear bearing", ROWS(stored_linear), differing);

    differing = 0u;
    for (row = 0u; row < ROWS(stored_efficiency); row++) {
        differing += efficiency_differs(stored_efficiency[row]);
    }
    total += reported("efficiency", ROWS(stored_efficiency), differing);

    differing = 0u;
    for (row = 0u; row < ROWS(stored_curvature); row++) {
        differing += curvature_differs(stored_curvature[row]);
    }
    total += reported("curvature", ROWS(stored_curvature), differing);
    return total;
}
