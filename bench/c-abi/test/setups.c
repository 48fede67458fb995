/* The scenes, set up as a user would: constant blocks and configurations, places of static duration. */
#include "epas_test.h"

#include <stddef.h>

#include "gear.h"
#include "gears.h"
#include "screw.h"

#define STEEL {210e9f, 0.28f, 7800.0f}

/* The gear of Lin 2019, chapter 3.6, with 100 N on each flank of the nut. */
#define DESIGN \
    { \
        .pitch_radius = 16.5e-3f, \
        .lead = 20e-3f, \
        .ball_radius = 2.778e-3f, \
        .screw_conformity = 0.56f, \
        .nut_conformity = 0.56f, \
        .contact_angle = 0.785398163f, \
        .ball_material = STEEL, \
        .groove_material = STEEL, \
    }
#define OVERSIZE (-4.068737e-7f)

/* A folded gear. */
#define BLOCK(words) {(words), (uint32_t)(sizeof(words) / sizeof((words)[0]))}

const epas_block_t test_block = BLOCK(GEAR_33X20_BLOCK);
const epas_block_t test_worn_block = BLOCK(GEAR_33X20_WORN_BLOCK);
const epas_block_t test_range_block = BLOCK(GEAR_33X20_RANGE_BLOCK);
const epas_block_t test_other_range_block = BLOCK(GEAR_BLOCK);
const epas_block_t test_ball_block = BLOCK(GEAR_33X20_BALL_BLOCK);
const epas_block_t test_worn_ball_block = BLOCK(GEAR_33X20_BALL_WORN_BLOCK);
const epas_block_t test_ball_range_block = BLOCK(SCREW_BLOCK);

/* The same gear by a closed form. */
const epas_closed_form_configuration_t test_closed_form_configuration = {
    .design = DESIGN,
    .friction = 0.075f,
    .rolling_tangent = 1e-3f,
    .branch = EPAS_BRANCH_ROLLING,
    .clearance = OVERSIZE,
    .loaded_balls = 36u,
    .reversal_speed = 0.5f,
    .limits = {.nut_speed = 100.0f, .axial_load = 20000.0f, .friction_torque = 20.0f},
};

/* The same gear with a memory, behind an encoder of 14 bits on its motor and a belt of ratio 2.5. */
const epas_memory_configuration_t test_memory_configuration = {
    .block = BLOCK(GEAR_33X20_RANGE_BLOCK),
    .encoder = {.period = 16384u, .turn_per_count = 1.533981e-4f, .largest_turn = 1.2f, .play = 1e-4f},
    .coefficient = {
        .boundary = 0.12f,
        .full_film = 0.05f,
        .half_share_speed = 4.9f,
        .reference_temperature = 293.15f,
        .forward = 1.0f,
        .backward = 1.1f,
        .churning = 1e-6f,
        .drag_torque = 0.0013f,
        .drag_heating = 0.0005f,
        .oil = {
            .kinematic_viscosity_40 = 100e-6f,
            .kinematic_viscosity_100 = 11.2e-6f,
            .density = 880.0f,
            .pour_point = 233.15f,
        },
    },
    /* By the design, under 5 kN. */
    .reference_torque = 0.6083f,
    .slip_share = 0.3717f,
    .slip_angle = 23.5e-3f,
    .spin_angle = 0.3017e-3f,
    .load_hold = 0.01f,
    .load_fade = 0.09f,
    .fallback_temperature = 313.15f,
    .temperature_hold = 10.0f,
    .temperature_fade = 60.0f,
};

/* Deviations and shares of the load stay for as long as a model uses them. */
static epas_deviation_t screw_deviation;
static epas_deviation_t nut_deviation;
static epas_load_share_t load_shares[6];
static epas_deviation_t rail_deviation;

/* What was folded of the ball screw without cage, decoded, stays too: for one friction coefficient, worn, and for a range. */
static epas_folded_ball_t ball;
static epas_folded_ball_t worn_ball;
epas_folded_ball_range_t test_ball_range;
/* No model uses it. */
epas_folded_ball_t test_spare_ball;

#define CIRCUIT \
    { \
        .ball_friction = 0.1f, \
        .balls = 37u, \
        .turns = 1.8f, \
        .return_length = 20e-3f, \
        .screw_deviation = &screw_deviation, \
        .nut_deviation = &nut_deviation, \
        .load_shares = load_shares, \
        .load_share_count = 6u, \
        .tick = 0.5e-3f, \
    }

/* The ball screw of Lin 2019, chapter 3.6, without cage. */
const epas_screw_configuration_t test_screw_configuration = {.folded = &ball, .circuit = CIRCUIT};
const epas_screw_configuration_t test_worn_screw_configuration = {.folded = &worn_ball, .circuit = CIRCUIT};
const epas_screw_range_configuration_t test_screw_range_configuration = {.folded = &test_ball_range, .circuit = CIRCUIT};

/* A linear bearing with balls of 10 mm. */
epas_linear_configuration_t test_linear_configuration = {
    .bearing = {
        .ball_radius = 5e-3f,
        .conformity = 0.52f,
        .contact_angle = 0.785398163f,
        .ball_material = STEEL,
        .groove_material = STEEL,
    },
    .friction = 0.1f,
    .ball_friction = 0.12f,
    .balls = 32u,
    .loaded_length = 0.2f,
    .return_length = 0.13f,
    .wavelength = 0.05f,
    .rail_deviation = &rail_deviation,
    .carriage_deviation = NULL,
    .load_shares = NULL,
    .load_share_count = 0u,
    .reversal_speed = 1e-3f,
    .tick = 1e-3f,
    .limits = {.speed = 2.0f, .load = 5000.0f, .friction_force = 50.0f},
};

uint32_t test_setup_caged(epas_caged_t *place)
{
    return epas_caged_init(place, &test_block, NULL);
}

uint32_t test_setup_caged_range(epas_caged_range_t *place)
{
    return epas_caged_range_init(place, &test_range_block, NULL);
}

uint32_t test_setup_closed_form(epas_closed_form_t *place)
{
    return epas_closed_form_init(place, &test_closed_form_configuration, NULL);
}

uint32_t test_setup_memory(epas_memory_t *place)
{
    return epas_memory_init(place, &test_memory_configuration, NULL);
}

/* Tables of the screw without cage. */
static uint32_t set_up_circuit(void)
{
    static const epas_harmonic_t waves[2] = {{1u, 0.002f, 0.0f}, {2u, 0.0f, 0.014f}};
    static const float shares[6] = {1.4f, 1.2f, 1.1f, 0.9f, 0.8f, 0.6f};
    float triangle[EPAS_DEVIATION_SAMPLES];
    uint32_t sample;
    uint32_t status;

    for (sample = 0u; sample < EPAS_DEVIATION_SAMPLES; sample++) {
        const float rise = (sample < 32u) ? (float)sample : (64.0f - (float)sample);
        triangle[sample] = (rise - 16.0f) * 0.0005f;
    }
    status = epas_deviation_from_harmonics(&screw_deviation, 1u, waves, 2u, NULL);
    if (status == EPAS_OK) {
        status = epas_deviation_from_samples(&nut_deviation, 2u, triangle, NULL);
    }
    if (status == EPAS_OK) {
        status = epas_load_shares_init(load_shares, shares, 6u, NULL);
    }
    return status;
}

uint32_t test_setup_ball(void)
{
    return epas_folded_ball_init(&ball, &test_ball_block, NULL);
}

uint32_t test_setup_ball_range(void)
{
    return epas_folded_ball_range_init(&test_ball_range, &test_ball_range_block, NULL);
}

uint32_t test_setup_screw(epas_screw_t *place)
{
    uint32_t status = set_up_circuit();

    if (status == EPAS_OK) {
        status = test_setup_ball();
    }
    if (status == EPAS_OK) {
        status = epas_folded_ball_init(&worn_ball, &test_worn_ball_block, NULL);
    }
    if (status == EPAS_OK) {
        status = epas_screw_init(place, &test_screw_configuration, NULL);
    }
    if (status == EPAS_OK) {
        status = epas_screw_set_nut_angle(place, 1.25f);
    }
    return status;
}

uint32_t test_setup_screw_range(epas_screw_range_t *place)
{
    uint32_t status = set_up_circuit();

    if (status == EPAS_OK) {
        status = test_setup_ball_range();
    }
    if (status == EPAS_OK) {
        status = epas_screw_range_init(place, &test_screw_range_configuration, NULL);
    }
    if (status == EPAS_OK) {
        status = epas_screw_range_set_nut_angle(place, 1.25f);
    }
    return status;
}

uint32_t test_setup_linear(epas_linear_t *place)
{
    static const epas_harmonic_t wave = {1u, 0.01f, 0.02f};
    uint32_t status = epas_deviation_from_harmonics(&rail_deviation, 1u, &wave, 1u, NULL);

    if (status == EPAS_OK) {
        status = epas_linear_init(place, &test_linear_configuration, NULL);
    }
    if (status == EPAS_OK) {
        status = epas_linear_set_carriage_position(place, 0.0125f);
    }
    return status;
}
