/* Friction of one ball screw with a cage or spacer balls, in C99: the block that follows from its drawing, the step of a control
 * interrupt, and friction that remembers. Written by `epas design --format c99`.
 *
@SUMMARY@
 *
 * Numbers are `float`, units m, rad, s, N, N m, K. Speeds and torques are about the nut's axis. A positive axial load opposes the travel
 * that a positive nut speed makes: speed times load > 0 is driving, < 0 back-driving. No function allocates, blocks, loops over
 * data, or has state beside the object that it is given; pointers must not be null. */
#ifndef EPAS_GEAR_H
#define EPAS_GEAR_H

#include <stdbool.h>
#include <stdint.h>

/* Friction coefficients of ball and groove for which the block was folded. */
#define EPAS_GEAR_LEAST_FRICTION @LEAST@
#define EPAS_GEAR_LARGEST_FRICTION @LARGEST@

/* Elements of the memory. */
#define EPAS_GEAR_ELEMENTS 8u

/* What the mechanism does (Rust: `Regime`). */
#define EPAS_GEAR_STANDING 0u     /* slower than the reversal speed; with memory, elements stick or the nut has just turned back */
#define EPAS_GEAR_DRIVING 1u      /* the motor moves the load, or turns against friction alone */
#define EPAS_GEAR_BACK_DRIVING 2u /* the load turns the nut */
#define EPAS_GEAR_LOCKED 3u       /* back-driving, and the load alone does not sustain the motion: the motor has to push */

/* What was wrong in a tick, a sum of these (Rust: `Faults`). The torque is the best one with every fault. */
#define EPAS_GEAR_SPEED_NOT_FINITE 1u     /* NaN or infinite: no torque; with memory the last sound speed and load */
#define EPAS_GEAR_LOAD_NOT_FINITE 2u      /* the same of the load */
#define EPAS_GEAR_SPEED_RANGE 4u          /* beyond its limit, which stands in */
#define EPAS_GEAR_LOAD_RANGE 8u           /* the same of the load */
#define EPAS_GEAR_FRICTION_LIMIT 16u      /* the friction torque was cut to its limit */
#define EPAS_GEAR_BEYOND_MODEL 32u        /* less accurate than the certificate says; inputs and outputs are sound */
#define EPAS_GEAR_ANGLE_NOT_VALID 128u    /* no valid count, or too large a turn: friction stays, the next count spans the gap */
#define EPAS_GEAR_TEMPERATURE_RANGE 256u  /* NaN or beyond 150 to 500 K: the fallback stands in */
#define EPAS_GEAR_LOAD_STALE 512u         /* older than it may be: its friction fades */
#define EPAS_GEAR_TEMPERATURE_STALE 1024u /* older than it may be: the fallback stands in, little by little */

/* Outputs of a tick (Rust: `Outputs`). */
typedef struct {
    float friction_torque; /* N m, that the motor has to add to overcome friction: with the sign of the nut speed */
    float load_torque;     /* N m, that holds the load without friction: axial load times lead over 2 pi */
    float efficiency;      /* work out over work in; 0 without a load, while standing and in a fault; negative where locked */
    uint32_t regime;       /* EPAS_GEAR_STANDING, _DRIVING, _BACK_DRIVING or _LOCKED */
    uint32_t faults;       /* 0, or a sum of the faults above */
} epas_gear_outputs_t;

/* A friction coefficient and the nodes of the block between which it lies (Rust: `FrictionInterval`). */
typedef struct {
    float friction;
    float fraction;
    uint32_t node;
} epas_gear_interval_t;

/* The screw without memory. */
typedef struct {
    uint32_t faulted_ticks; /* to read: steps in a row with a fault other than EPAS_GEAR_BEYOND_MODEL */
    epas_gear_interval_t interval;
} epas_gear_t;

/* Sensors of the screw with memory. */
typedef struct {
    uint32_t period;            /* counts after which the encoder starts again at 0: 2 and more, 0 for 2^32 */
    float turn_per_count;       /* rad of the nut, negative where the counter runs the other way; size 1e-9 to 1 */
    float largest_turn;         /* rad between two counts, 1e-6 to 1e3, at most half a period: largest speed times longest gap */
    float play;                 /* rad, 0 to 1e3: half the width of the angle's noise, counts included */
    float load_hold;            /* s, 0 to 1e3: age up to which a load counts as it is (0.01) */
    float load_fade;            /* s, 1e-6 to 1e3: time after that in which it fades to none (0.09) */
    float fallback_temperature; /* K, 150 to 500: stands in for one that is too old (313.15) */
    float temperature_hold;     /* s, 0 to 86400: age up to which a temperature counts as it is (60) */
    float temperature_fade;     /* s, 1e-3 to 86400: time after that in which it gives way to the fallback (60) */
} epas_gear_sensors_t;

/* Inputs of a tick of the screw with memory (Rust: `WithMemoryInputs`). */
typedef struct {
    float nut_speed;       /* rad/s, relative to the screw: the friction coefficient follows it */
    float axial_load;      /* N */
    uint32_t count;        /* of the encoder: friction follows it; the period or more is no count */
    float load_age;        /* s since the load was found */
    float temperature;     /* K, of the screw */
    float temperature_age; /* s since the temperature was found */
} epas_gear_memory_inputs_t;

/* The screw with memory. Pairs are forward and backward. */
typedef struct {
    uint32_t faulted_ticks; /* to read: as of epas_gear_t */
    float drag_torque;      /* to read: lubricant drag in the friction torque of the last step, N m, which no level scales */
    epas_gear_sensors_t sensors;
    float load_rate;
    float temperature_rate;
    float held[EPAS_GEAR_ELEMENTS];
    float play_position;
    uint32_t last_count;
    bool counted;
    bool stepped;
    float full_film[2];
    float difference[2];
    float level[2];
    float temperature;
    float half_share_speed;
    float churning;
    float fluidity;
    float nut_speed;
    float axial_load;
    float sliding[2];
    float load_over_reference; /* of elements that follow the load */
    uint32_t sliding_faults;
} epas_gear_memory_t;

/* Whether this compiler's arithmetic is the one that the certificate holds for: ask once at start-up. False where products and sums
 * are contracted or numbers reordered (compile with -ffp-contract=off, without -ffast-math), where subnormal numbers are flushed to
 * zero (leave FPSCR.FZ, or MXCSR.FTZ and DAZ, cleared), or where `float` is computed in a wider type. A floating-point unit without
 * subnormal numbers (TriCore) takes inputs and results below 1.2e-38 as 0, and gives the same bits else: compile with EPAS_NO_SUBNORMALS,
 * which leaves them out of the check. */
bool epas_gear_arithmetic_is_sound(void);

/* Before the first step: the block's own friction coefficient, @FRICTION@. */
void epas_gear_init(epas_gear_t *model);

/* One tick: nut speed, rad/s, and axial load, N. */
void epas_gear_step(epas_gear_t *model, float nut_speed, float axial_load, epas_gear_outputs_t *outputs);

/* Sets the friction coefficient, from the next step on. False, and nothing set, outside EPAS_GEAR_LEAST_FRICTION to _LARGEST_FRICTION. */
bool epas_gear_set_friction(epas_gear_t *model, float friction);

/* Before the first step with memory, and again to forget all. False, and nothing set, where a number of the sensors is out of its range. */
bool epas_gear_memory_init(epas_gear_memory_t *model, const epas_gear_sensors_t *sensors);

/* One tick with memory, every millisecond or so: friction passes to its other direction with the nut's angle, over the breakaway
 * angles of the design. Without a valid speed and load it goes on with the last ones, without a valid count it stays. */
void epas_gear_memory_step(epas_gear_memory_t *model, const epas_gear_memory_inputs_t *inputs, epas_gear_outputs_t *outputs);

/* Friction between two steps, after a new count: for a loop that is faster than the step. No friction before the first step. */
void epas_gear_memory_between(epas_gear_memory_t *model, uint32_t count, epas_gear_outputs_t *outputs);

/* Sets the friction coefficients at standstill and on a full film, both before the factors of the directions; from the next step on.
 * False, and nothing set, where one or its product with a factor is outside 1e-6 to 0.5. */
bool epas_gear_memory_set_coefficient(epas_gear_memory_t *model, float boundary, float full_film);

/* Sets friction over that of the block in each direction, 0.1 to 10, from the next step or count on. False, and nothing set, outside. */
bool epas_gear_memory_set_level(epas_gear_memory_t *model, float forward, float backward);

#endif
