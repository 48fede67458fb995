/* What the library refuses, and what it says of it. */
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

static uint32_t same_text(const char *one, const char *other)
{
    while ((*one != '\0') && (*one == *other)) {
        one++;
        other++;
    }
    return (*one == *other) ? 1u : 0u;
}

static float not_a_number(void)
{
    static volatile float zero = 0.0f;

    return zero / zero;
}

static void check_failure(uint32_t status, const epas_failure_t *failure, uint32_t expected_status,
                          uint32_t field, const char *name)
{
    check((status == expected_status) && (failure->status == expected_status), name);
    check(failure->field == field, name);
    check(same_text(epas_field_name(failure->field), name), name);
}

static void pointers(void)
{
    static epas_caged_t caged;
    static epas_caged_t never;
    static epas_screw_t screw;
    const epas_inputs_t inputs = {10.0f, 1000.0f};
    epas_outputs_t outputs = {0};
    epas_screw_outputs_t screw_outputs = {0};
    epas_failure_t failure;
    uint32_t ticks;

    check(epas_caged_init(NULL, &test_block, &failure) == EPAS_NULL_POINTER, "no place");
    check(failure.status == EPAS_NULL_POINTER, "no place, said");
    check(epas_caged_init(&caged, NULL, NULL) == EPAS_NULL_POINTER, "no configuration");
    check(epas_caged_init((epas_caged_t *)(void *)((uint8_t *)&caged + 4), &test_block, NULL)
              == EPAS_MISALIGNED,
          "misaligned place");

    check(epas_caged_step(&never, &inputs, &outputs) == EPAS_NOT_INITIALISED, "a place of zeros");
    check((outputs.faults == EPAS_FAULT_CALL) && (outputs.friction_torque == 0.0f), "no torque");
    check(epas_caged_reset(&never) == EPAS_NOT_INITIALISED, "reset of a place of zeros");

    check(test_setup_caged(&caged) == EPAS_OK, "set-up");
    check(epas_caged_step(&caged, &inputs, &outputs) == EPAS_OK, "a sound step");
    check((outputs.faults == 0u) && (outputs.friction_torque > 0.0f), "a sound step's torque");
    check(epas_caged_step(NULL, &inputs, &outputs) == EPAS_NULL_POINTER, "step without place");
    check(outputs.faults == EPAS_FAULT_CALL, "step without place, flagged");
    check(epas_caged_step(&caged, NULL, &outputs) == EPAS_NULL_POINTER, "step without inputs");
    check(epas_caged_step(&caged, &inputs, NULL) == EPAS_NULL_POINTER, "step without outputs");

    /* Another scene's place. */
    check(epas_screw_step((epas_screw_t *)(void *)&caged, &inputs, &screw_outputs) == EPAS_NOT_INITIALISED,
          "another scene's place");
    check(screw_outputs.faults == EPAS_FAULT_CALL, "another scene's place, flagged");
    check(epas_screw_step(&screw, &inputs, &screw_outputs) == EPAS_NOT_INITIALISED, "a screw of zeros");

    /* A model that is copied as a whole is one of its own. */
    never = caged;
    check(epas_caged_step(&never, &inputs, &outputs) == EPAS_OK, "a copy");
    check(epas_caged_faulted_ticks(&caged, &ticks) == EPAS_OK, "counter");
    check(ticks == 0u, "no faulted ticks");
    check(epas_caged_faulted_ticks(&caged, NULL) == EPAS_NULL_POINTER, "counter without a place to go");
}

static void inputs(void)
{
    static epas_caged_t caged;
    static epas_linear_t linear;
    const epas_inputs_t bad = {not_a_number(), 1000.0f};
    const epas_inputs_t beyond = {600.0f, 30000.0f};
    const epas_inputs_t at_limit = {100.0f, 20000.0f};
    const epas_linear_inputs_t bad_load = {0.5f, 1000.0f, not_a_number()};
    epas_outputs_t outputs;
    epas_outputs_t of_limit;
    epas_linear_outputs_t linear_outputs;
    uint32_t ticks = 0u;

    (void)test_setup_caged(&caged);
    check(epas_caged_step(&caged, &bad, &outputs) == EPAS_OK, "an input that is NaN or infinite is no refusal");
    check((outputs.faults == EPAS_FAULT_SPEED_NOT_FINITE) && (outputs.friction_torque == 0.0f),
          "but a fault");
    check((epas_caged_faulted_ticks(&caged, &ticks) == EPAS_OK) && (ticks == 1u), "one faulted tick");

    /* Beyond the limits the limits stand in: the torque is theirs. */
    check(epas_caged_step(&caged, &beyond, &outputs) == EPAS_OK, "inputs beyond their limits");
    check((outputs.faults & (EPAS_FAULT_SPEED_RANGE | EPAS_FAULT_LOAD_RANGE))
              == (EPAS_FAULT_SPEED_RANGE | EPAS_FAULT_LOAD_RANGE),
          "inputs beyond their limits, flagged");
    check(epas_caged_step(&caged, &at_limit, &of_limit) == EPAS_OK, "inputs at their limits");
    check((outputs.friction_torque == of_limit.friction_torque) && (outputs.friction_torque > 0.0f),
          "the torque of the limits");

    (void)test_setup_linear(&linear);
    check(epas_linear_step(&linear, &bad_load, &linear_outputs) == EPAS_OK, "a load that is NaN or infinite");
    check((linear_outputs.faults == EPAS_FAULT_LOAD_NOT_FINITE) && (linear_outputs.friction_force == 0.0f),
          "no force, flagged");
}

/* Bytes of a screw's state with its 37 balls. */
#define STATE_OF_37_BALLS 370u

/* A block that is taken over gives the same ticks; one that is refused changes nothing. */
static void states(void)
{
    static epas_screw_t screw;
    static epas_screw_t next;
    static epas_caged_t caged;
    static epas_linear_t linear;
    static uint8_t block[EPAS_SCREW_STATE_BYTES];
    static uint8_t caged_block[EPAS_CAGED_STATE_BYTES];
    static uint8_t linear_block[EPAS_LINEAR_STATE_BYTES];
    const epas_inputs_t inputs = {10.0f, 1000.0f};
    epas_screw_outputs_t one = {0};
    epas_screw_outputs_t other = {0};
    uint32_t tick;

    check(epas_screw_export(&screw, block, sizeof block) == EPAS_NOT_INITIALISED, "export of a screw of zeros");
    check((test_setup_screw(&screw) == EPAS_OK) && (test_setup_screw(&next) == EPAS_OK), "screws");
    for (tick = 0u; tick < 50u; tick++) {
        (void)epas_screw_step(&screw, &inputs, &one);
    }
    check(epas_screw_import(&next, block, sizeof block) == EPAS_NOT_A_STATE, "a block of zeros");
    check(epas_screw_export(&screw, NULL, sizeof block) == EPAS_NULL_POINTER, "no block");
    check(epas_screw_export(&screw, block, STATE_OF_37_BALLS - 1u) == EPAS_STATE_LENGTH, "no room");
    check(epas_screw_export(&screw, block, sizeof block) == EPAS_OK, "export");
    block[100] ^= 1u;
    check(epas_screw_import(&next, block, sizeof block) == EPAS_STATE_DAMAGED, "a damaged block");
    block[100] ^= 1u;
    block[4]++;
    check(epas_screw_import(&next, block, sizeof block) == EPAS_STATE_VERSION, "a block of another version");
    block[4]--;
    check(epas_screw_import(&next, block, STATE_OF_37_BALLS - 1u) == EPAS_STATE_LENGTH, "a short block");
    check(epas_screw_import(&next, block, STATE_OF_37_BALLS) == EPAS_OK, "the block alone");
    check(epas_screw_import(&next, block, sizeof block) == EPAS_OK, "import");
    for (tick = 0u; tick < 50u; tick++) {
        (void)epas_screw_step(&screw, &inputs, &one);
        (void)epas_screw_step(&next, &inputs, &other);
        check((one.friction_torque == other.friction_torque) && (one.contacts == other.contacts)
                  && (one.faults == other.faults),
              "a tick after an import");
    }

    (void)test_setup_caged(&caged);
    check(epas_caged_import(&caged, block, sizeof block) == EPAS_STATE_FOREIGN, "another scene's block");
    check(epas_caged_export(&caged, caged_block, sizeof caged_block) == EPAS_OK, "caged export");
    check(epas_caged_import(&caged, caged_block, sizeof caged_block) == EPAS_OK, "caged import");
    (void)test_setup_linear(&linear);
    check(epas_linear_export(&linear, linear_block, sizeof linear_block) == EPAS_OK, "linear export");
    check(epas_linear_import(&linear, linear_block, sizeof linear_block) == EPAS_OK, "linear import");
    check(same_text(epas_status_name(EPAS_STATE_DAMAGED), "damaged state"), "name of a state's status");
}

/* Words of a block to which something happens. */
static uint32_t words[EPAS_FOLDED_BALL_WORDS + 32u];

/* A block that is none, or not whole, is refused with a status of its own; the place holds no model then. */
static void blocks(void)
{
    static epas_caged_t place;
    static epas_caged_range_t range;
    const epas_inputs_t sound = {10.0f, 1000.0f};
    epas_block_t block = {words, 0u};
    epas_outputs_t outputs;
    epas_failure_t failure;
    uint32_t status;
    uint32_t word;

    (void)test_setup_caged(&place);
    for (word = 0u; word < test_block.count; word++) {
        words[word] = test_block.words[word];
    }
    block.count = test_block.count;
    check(epas_caged_init(&place, &block, &failure) == EPAS_OK, "words that were copied");
    words[0] ^= 1u;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_NOT_A_BLOCK, EPAS_FIELD_BLOCK, "block");
    check(epas_caged_step(&place, &sound, &outputs) == EPAS_NOT_INITIALISED, "a place whose block was refused holds no model");
    words[0] ^= 1u;
    words[1]++;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_VERSION, EPAS_FIELD_BLOCK, "block");
    words[1]--;
    words[3] = 2u;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_NODES, EPAS_FIELD_BLOCK, "block");
    words[3] = 1u;
    words[20] ^= 1u;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_DAMAGED, EPAS_FIELD_BLOCK, "block");
    words[20] ^= 1u;
    block.count--;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_LENGTH, EPAS_FIELD_BLOCK, "block");
    block.words = NULL;
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_NULL_POINTER, EPAS_FIELD_BLOCK, "block");
    block.words = (const uint32_t *)(const void *)((const uint8_t *)words + 2);
    status = epas_caged_init(&place, &block, &failure);
    check_failure(status, &failure, EPAS_MISALIGNED, EPAS_FIELD_BLOCK, "block");
    status = epas_caged_range_init(&range, &test_block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_LENGTH, EPAS_FIELD_BLOCK, "block");
    check(same_text(epas_status_name(EPAS_BLOCK_DAMAGED), "damaged block"), "name of a block's status");
}

/* The same of a screw without cage. */
static void folded_balls(void)
{
    static epas_caged_t caged;
    static epas_screw_t screw;
    epas_screw_configuration_t configuration = test_screw_configuration;
    epas_block_t block = {words, 0u};
    epas_failure_t failure;
    uint32_t status;
    uint32_t word;

    for (word = 0u; word < test_ball_block.count; word++) {
        words[word] = test_ball_block.words[word];
    }
    block.count = test_ball_block.count;
    configuration.folded = &test_spare_ball;
    check(epas_folded_ball_init(&test_spare_ball, &block, &failure) == EPAS_OK, "words that were copied");
    check(failure.status == EPAS_OK, "and no failure");
    check(epas_screw_init(&screw, &configuration, NULL) == EPAS_OK, "a screw of them");
    words[0] ^= 1u;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_NOT_A_BLOCK, EPAS_FIELD_BLOCK, "block");
    status = epas_screw_init(&screw, &configuration, &failure);
    check_failure(status, &failure, EPAS_NOT_INITIALISED, EPAS_FIELD_FOLDED, "folded");
    words[0] ^= 1u;
    words[1]++;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_VERSION, EPAS_FIELD_BLOCK, "block");
    words[1]--;
    words[3] = 2u;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_NODES, EPAS_FIELD_BLOCK, "block");
    words[3] = 1u;
    words[1000] ^= 1u;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_DAMAGED, EPAS_FIELD_BLOCK, "block");
    words[1000] ^= 1u;
    block.count--;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_LENGTH, EPAS_FIELD_BLOCK, "block");
    block.words = NULL;
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_NULL_POINTER, EPAS_FIELD_BLOCK, "block");
    block.words = (const uint32_t *)(const void *)((const uint8_t *)words + 2);
    status = epas_folded_ball_init(&test_spare_ball, &block, &failure);
    check_failure(status, &failure, EPAS_MISALIGNED, EPAS_FIELD_BLOCK, "block");
    check(epas_folded_ball_init(NULL, &test_ball_block, NULL) == EPAS_NULL_POINTER, "no place");
    check(epas_folded_ball_init(&test_spare_ball, NULL, NULL) == EPAS_NULL_POINTER, "no block");

    /* Blocks of other scenes, either way. */
    status = epas_folded_ball_range_init(&test_ball_range, &test_ball_block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_LENGTH, EPAS_FIELD_BLOCK, "block");
    status = epas_folded_ball_init(&test_spare_ball, &test_ball_range_block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_NODES, EPAS_FIELD_BLOCK, "block");
    status = epas_folded_ball_init(&test_spare_ball, &test_block, &failure);
    check_failure(status, &failure, EPAS_BLOCK_LENGTH, EPAS_FIELD_BLOCK, "block");
    status = epas_caged_init(&caged, &test_ball_block, &failure);
    check_failure(status, &failure, EPAS_NOT_A_BLOCK, EPAS_FIELD_BLOCK, "block");

    /* A folded ball of another kind, or none. */
    check(epas_folded_ball_range_init(&test_ball_range, &test_ball_range_block, NULL) == EPAS_OK, "a range");
    configuration.folded = (const epas_folded_ball_t *)(const void *)&test_ball_range;
    status = epas_screw_init(&screw, &configuration, &failure);
    check_failure(status, &failure, EPAS_NOT_INITIALISED, EPAS_FIELD_FOLDED, "folded");
    configuration.folded = (const epas_folded_ball_t *)(const void *)((const uint8_t *)&test_spare_ball + 2);
    status = epas_screw_init(&screw, &configuration, &failure);
    check_failure(status, &failure, EPAS_MISALIGNED, EPAS_FIELD_FOLDED, "folded");
    configuration.folded = NULL;
    status = epas_screw_init(&screw, &configuration, &failure);
    check_failure(status, &failure, EPAS_NULL_POINTER, EPAS_FIELD_FOLDED, "folded");
}

static void closed_form_fields(void)
{
    static epas_closed_form_t place;
    const epas_inputs_t sound = {10.0f, 1000.0f};
    epas_closed_form_configuration_t wrong = test_closed_form_configuration;
    epas_outputs_t outputs;
    epas_failure_t failure;
    uint32_t status;

    (void)test_setup_closed_form(&place);
    wrong.design.lead = -1.0f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LEAD, "lead");
    check((failure.value == -1.0f) && (failure.minimum == 0.0f) && (failure.maximum == 0.2f),
          "value and range of the lead");
    check(epas_closed_form_step(&place, &sound, &outputs) == EPAS_NOT_INITIALISED,
          "a place whose configuration was refused holds no model");

    wrong = test_closed_form_configuration;
    wrong.friction = not_a_number();
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_NOT_FINITE, EPAS_FIELD_FRICTION, "friction");

    wrong = test_closed_form_configuration;
    wrong.design.nut_conformity = 0.4f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_NUT_CONFORMITY, "nut_conformity");

    wrong.design.screw_conformity = 0.4f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_SCREW_CONFORMITY, "screw_conformity");

    wrong = test_closed_form_configuration;
    wrong.design.ball_radius = 12e-3f;
    wrong.design.screw_conformity = 1.0f;
    wrong.design.nut_conformity = 1.0f;
    wrong.design.contact_angle = 1.5f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_FOLDED_GROOVE, EPAS_FIELD_SCREW_CONFORMITY, "screw_conformity");
    check((failure.value == 1.0f) && (failure.maximum > 0.5f) && (failure.maximum < 1.0f),
          "the conformity that would fit");

    wrong = test_closed_form_configuration;
    wrong.design.groove_material.youngs_modulus = 210.0f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_GROOVE_YOUNGS_MODULUS,
                  "groove_material.youngs_modulus");

    wrong.design.ball_material.youngs_modulus = 210.0f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_BALL_YOUNGS_MODULUS,
                  "ball_material.youngs_modulus");

    wrong = test_closed_form_configuration;
    wrong.loaded_balls = 0u;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LOADED_BALLS, "loaded_balls");

    wrong = test_closed_form_configuration;
    wrong.branch = 3u;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_BRANCH, "branch");
    check((failure.value == 3.0f) && (failure.minimum == 1.0f) && (failure.maximum == 2.0f), "value and range of the branch");

    wrong = test_closed_form_configuration;
    wrong.limits.friction_torque = 0.0f;
    status = epas_closed_form_init(&place, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LIMIT_FRICTION_TORQUE,
                  "limits.friction_torque");

    status = epas_closed_form_init(&place, &test_closed_form_configuration, &failure);
    check_failure(status, &failure, EPAS_OK, EPAS_FIELD_NONE, "");
}

static void train_fields(void)
{
    static epas_screw_t screw;
    static epas_linear_t linear;
    static epas_deviation_t empty;
    static epas_load_share_t shares[2];
    static epas_deviation_t large;
    static const epas_harmonic_t large_wave = {1u, 0.19f, 0.0f};
    static const float one_wrong[2] = {1.0f, 0.001f};
    epas_screw_configuration_t wrong;
    epas_linear_configuration_t wrong_linear;
    epas_failure_t failure;
    uint32_t status;

    check(test_setup_screw(&screw) == EPAS_OK, "set-up of the screw");
    wrong = test_screw_configuration;
    wrong.circuit.nut_deviation = &empty;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_NOT_INITIALISED, EPAS_FIELD_RECIRCULATING_DEVIATION, "recirculating deviation");

    wrong = test_screw_configuration;
    status = epas_load_shares_init(shares, one_wrong, 2u, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_SHARE, "share");
    check(failure.index == 1u, "which share");
    wrong.circuit.load_shares = shares;
    wrong.circuit.load_share_count = 2u;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_NOT_INITIALISED, EPAS_FIELD_LOAD_SHARES, "load_shares");
    check(failure.index == 1u, "which share is not initialised");
    wrong.circuit.load_share_count = 257u;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LOAD_SHARE_COUNT, "load_share_count");

    wrong = test_screw_configuration;
    wrong.circuit.turns = 1.5f;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_BALL_PITCH, "ball pitch");

    wrong = test_screw_configuration;
    wrong.circuit.tick = not_a_number();
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_NOT_FINITE, EPAS_FIELD_TICK, "tick");

    wrong = test_screw_configuration;
    wrong.circuit.ball_friction = 1.5f;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_BALL_FRICTION, "ball_friction");

    wrong = test_screw_configuration;
    wrong.circuit.balls = EPAS_MOST_BALLS + 1u;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_BALLS, "balls");
    check((failure.value == 65.0f) && (failure.minimum == 1.0f) && (failure.maximum == 64.0f), "more balls than there is room for");

    /* A deviation larger than any that was folded. */
    check(epas_deviation_from_harmonics(&large, 1u, &large_wave, 1u, NULL) == EPAS_OK, "a large deviation");
    wrong = test_screw_configuration;
    wrong.circuit.screw_deviation = &large;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_PASSING_DEVIATION, "passing deviation");
    wrong = test_screw_configuration;
    wrong.circuit.nut_deviation = &large;
    status = epas_screw_init(&screw, &wrong, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_RECIRCULATING_DEVIATION,
                  "recirculating deviation");

    wrong = test_screw_configuration;
    wrong.circuit.screw_deviation = NULL;
    wrong.circuit.nut_deviation = NULL;
    wrong.circuit.load_shares = NULL;
    check(epas_screw_init(&screw, &wrong, &failure) == EPAS_OK, "no tables along the track");

    check(test_setup_linear(&linear) == EPAS_OK, "set-up of the linear bearing");
    wrong_linear = test_linear_configuration;
    wrong_linear.bearing.conformity = 0.5f;
    status = epas_linear_init(&linear, &wrong_linear, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_CONFORMITY, "conformity");
    wrong_linear = test_linear_configuration;
    wrong_linear.bearing.contact_angle = 0.02f;
    status = epas_linear_init(&linear, &wrong_linear, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_PASSING_DEVIATION, "passing deviation");
    wrong_linear = test_linear_configuration;
    wrong_linear.limits.speed = 0.0f;
    status = epas_linear_init(&linear, &wrong_linear, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LIMIT_SPEED, "limits.speed");
}

static void tables_and_requests(void)
{
    static epas_deviation_t deviation;
    epas_harmonic_t waves[2] = {{1u, 0.01f, 0.0f}, {9u, 0.0f, 0.01f}};
    float samples[EPAS_DEVIATION_SAMPLES] = {0.0f};
    epas_efficiency_request_t request = {0.1f, 0.8f, 0.2f, 1.5f, 0.0f};
    epas_efficiency_t efficiency;
    epas_curvature_request_t curvature_request = {.design = test_closed_form_configuration.design};
    epas_curvature_t curvature;
    epas_clearance_request_t clearance_request = {
        .design = test_closed_form_configuration.design,
        .given = EPAS_GIVEN_PRELOAD,
        .value = 50.0f,
        .loaded_balls = 70u,
    };
    epas_clearance_t clearance;
    epas_failure_t failure;
    uint32_t status;

    status = epas_deviation_from_harmonics(&deviation, 1u, waves, 2u, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_ORDER, "order");
    check((failure.index == 1u) && (failure.maximum == 8.0f), "which order");
    waves[1].order = 3u;
    waves[1].sine = 0.3f;
    status = epas_deviation_from_harmonics(&deviation, 1u, waves, 2u, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_SINE, "sine");
    check(failure.index == 1u, "which sine");
    status = epas_deviation_from_harmonics(&deviation, 70000u, waves, 1u, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_TURNS, "turns");
    check(failure.value == 70000.0f, "how many turns");
    status = epas_deviation_from_harmonics(&deviation, 1u, waves, 10u, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_HARMONIC_COUNT, "harmonic count");
    check(epas_deviation_from_harmonics(&deviation, 1u, NULL, 1u, NULL) == EPAS_NULL_POINTER, "no waves");
    check(epas_deviation_from_harmonics(&deviation, 1u, NULL, 0u, NULL) == EPAS_OK, "none asked for");

    samples[63] = not_a_number();
    status = epas_deviation_from_samples(&deviation, 1u, samples, &failure);
    check_failure(status, &failure, EPAS_NOT_FINITE, EPAS_FIELD_DEVIATION, "deviation");
    check(failure.index == 63u, "which sample");

    check(epas_clearance(&clearance_request, &clearance, &failure) == EPAS_OK, "a preload");
    check((clearance.clearance < 0.0f) && (clearance.axial_play == 0.0f), "is an oversize");
    check((clearance.preload > 49.999f) && (clearance.preload < 50.001f), "of that preload");
    check(clearance.axial_preload > 40.0f * clearance.preload, "of all balls on each flank");
    clearance_request.given = EPAS_GIVEN_AXIAL_PLAY;
    status = epas_clearance(&clearance_request, &clearance, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_AXIAL_PLAY, "axial play");
    clearance_request.value = 20e-6f;
    check(epas_clearance(&clearance_request, &clearance, &failure) == EPAS_OK, "an axial play");
    check((clearance.clearance > 0.0f) && (clearance.preload == 0.0f), "is a gap");
    clearance_request.given = EPAS_GIVEN_PRELOAD;
    clearance_request.value = -1.0f;
    status = epas_clearance(&clearance_request, &clearance, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_CONTACT_FORCE, "contact force");
    clearance_request.given = EPAS_GIVEN_CLEARANCE;
    status = epas_clearance(&clearance_request, &clearance, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_CLEARANCE, "clearance");
    clearance_request.value = -2e-6f;
    check(epas_clearance(&clearance_request, &clearance, &failure) == EPAS_OK, "a clearance");
    check(clearance.clearance == clearance_request.value, "is itself");
    clearance_request.loaded_balls = 0x10001u;
    status = epas_clearance(&clearance_request, &clearance, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_LOADED_BALLS, "loaded_balls");
    clearance_request.loaded_balls = 1u;
    clearance_request.given = 3u;
    status = epas_clearance(&clearance_request, &clearance, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_GIVEN, "given");

    status = epas_efficiency(&request, &efficiency, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_FRICTION, "friction");
    request.friction = 0.1f;
    request.contact_angle = 0.0f;
    status = epas_efficiency(&request, &efficiency, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_CONTACT_ANGLE, "contact_angle");

    curvature_request.groove = 7u;
    status = epas_curvature(&curvature_request, &curvature, &failure);
    check_failure(status, &failure, EPAS_OUT_OF_RANGE, EPAS_FIELD_GROOVE, "groove");
    check(epas_curvature(&curvature_request, NULL, &failure) == EPAS_NULL_POINTER, "nowhere to answer");

    check(epas_abi_version() == EPAS_ABI_VERSION, "header and library");
    check(same_text(epas_status_name(EPAS_OUT_OF_RANGE), "out of range"), "name of a status");
    check(same_text(epas_status_name(99u), "unknown status"), "name of no status");
    check(same_text(epas_field_name(1000u), ""), "name of no field");
}

/* The friction level that follows the vehicle: found, refused, and kept across ignition. */
static void adaptation(void)
{
    static epas_adaptation_t place;
    static epas_adaptation_t next;
    static uint8_t block[EPAS_ADAPTATION_STATE_BYTES];
    epas_adaptation_configuration_t configuration = {
        .tick = 0.01f, .forgetting_time = 5.0f, .filter_time = 0.02f, .noise = 2e-3f,
        .level_deviation = 0.3f, .least_level = 0.4f, .largest_level = 2.5f,
        .largest_torque = 10.0f, .largest_speed = 500.0f, .least_speed = 0.2f, .least_friction = 5e-3f,
        .average_time = 600.0f, .fall = 0.3f, .rise = 0.5f, .hysteresis = 0.1f,
    };
    epas_adaptation_inputs_t now = {
        .observed = 0.052f, .modelled = 0.04f, .forward = 1.0f, .backward = 1.0f, .nut_speed = 8.0f,
        .regime = EPAS_REGIME_DRIVING,
    };
    epas_adaptation_outputs_t found = {0};
    epas_failure_t failure;
    float forward;
    uint32_t tick;

    check(epas_adaptation_update(&place, &now, &found) == EPAS_NOT_INITIALISED, "an adaptation of zeros");
    check((found.flags == EPAS_FAULT_CALL) && (found.forward == 1.0f), "an adaptation of zeros, flagged");
    configuration.noise = not_a_number();
    check_failure(epas_adaptation_init(&place, &configuration, &failure), &failure, EPAS_NOT_FINITE,
                  EPAS_FIELD_NOISE, "noise");
    configuration.noise = 2e-3f;
    configuration.hysteresis = 0.4f;
    check_failure(epas_adaptation_init(&place, &configuration, &failure), &failure, EPAS_OUT_OF_RANGE,
                  EPAS_FIELD_HYSTERESIS, "hysteresis");
    configuration.hysteresis = 0.1f;
    check(epas_adaptation_init(&place, &configuration, &failure) == EPAS_OK, "set-up of an adaptation");
    check(epas_adaptation_init(&next, &configuration, NULL) == EPAS_OK, "set-up of another");

    for (tick = 0u; tick < 2000u; tick++) {
        check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "an update");
    }
    check((found.forward > 1.29f) && (found.forward < 1.31f) && (found.flags == 0u), "a level that is found");
    check((found.drag == 0.0f) && (found.health == 0u), "what was left out");
    forward = found.forward;
    now.observed = not_a_number();
    check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "no torque");
    check((found.flags == EPAS_ADAPTATION_INPUT_RANGE) && (found.forward == forward), "no torque, flagged");
    now.observed = 0.052f;
    now.forward = 0.0f;
    check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "no level");
    check((found.flags == EPAS_ADAPTATION_INPUT_RANGE) && (found.forward == forward), "no level, flagged");
    now.forward = 1.0f;
    now.faults = EPAS_FAULT_LOAD_RANGE;
    check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "a faulted step");
    check(found.flags == EPAS_ADAPTATION_FAULTED, "a faulted step, flagged");
    now.faults = 0u;
    now.regime = 17u;
    check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "no regime");
    check(found.flags == EPAS_ADAPTATION_STANDING, "no regime, flagged");
    now.saturated = 1u;
    now.regime = EPAS_REGIME_DRIVING;
    check(epas_adaptation_update(&place, &now, &found) == EPAS_OK, "a motor at its limit");
    check(found.flags == EPAS_ADAPTATION_SATURATED, "a motor at its limit, flagged");
    check(epas_adaptation_update(&place, NULL, &found) == EPAS_NULL_POINTER, "update without inputs");
    check(epas_adaptation_update(&place, &now, NULL) == EPAS_NULL_POINTER, "update without outputs");

    check(epas_adaptation_commission(&place) == EPAS_OK, "commissioning");
    check(epas_adaptation_import(&next, block, sizeof block) == EPAS_NOT_A_STATE, "an adaptation of zeros");
    check(epas_adaptation_export(&place, block, sizeof block - 1u) == EPAS_STATE_LENGTH, "no room");
    check(epas_adaptation_export(&place, block, sizeof block) == EPAS_OK, "export of an adaptation");
    check(epas_adaptation_import(&next, block, sizeof block) == EPAS_OK, "import of an adaptation");
    check(epas_adaptation_update(&next, &now, &found) == EPAS_OK, "an update after an import");
    check(found.forward == forward, "a level after an import");
    block[20] ^= 1u;
    check(epas_adaptation_import(&next, block, sizeof block) == EPAS_STATE_DAMAGED, "a damaged adaptation");
    check(epas_adaptation_reset(&next) == EPAS_OK, "reset of an adaptation");
    check(epas_adaptation_update(&next, &now, &found) == EPAS_OK, "an update after a reset");
    check(found.forward == 1.0f, "a level after a reset");
}

uint32_t test_refusals(void)
{
    failed = 0u;
    pointers();
    inputs();
    states();
    blocks();
    folded_balls();
    closed_form_fields();
    train_fields();
    tables_and_requests();
    adaptation();
    test_put("refusals: ");
    test_put_number(failed);
    test_put(" failed\n");
    return failed;
}
