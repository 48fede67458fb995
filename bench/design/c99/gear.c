/* Friction of one ball screw with a cage or spacer balls: see @HEADER@ for units and signs.
 *
 * Written by `epas design --format c99`; not to be edited, but written anew. C99, `float` alone. Each function has the arithmetic of the
 * function of the Rust crate epas-friction that its comment names, in the same order: compiled with -ffp-contract=off its results
 * have the same bits. Needs of a library only `sqrtf` of <math.h>, and not even that where GCC or clang compile for an Arm
 * floating-point unit. EPAS_PLAIN_C99 leaves out what is not of the standard.
 *
 * MISRA C:2012: no required rule is violated. Advisory ones that are, with the reason:
 *   1.2   (language extension) the square root as an instruction of Arm, encapsulated in square_root; without one a call would need a library
 *   8.7   (external linkage) functions are for the application, which is another translation unit
 *   8.9   (object of one function) the numbers of a screw stand together, above all functions
 *   19.2  (union) a number's bits, for its logarithm and its sign: `memcpy` between unlike types would violate the required rule 21.15 */
#include "@HEADER@"

#include <float.h>
#include <stddef.h>

/* `epas_friction::math::sqrt` */
#if defined(__GNUC__) && defined(__ARM_FP) && !defined(EPAS_PLAIN_C99)
static inline float square_root(float number)
{
    float root;

    __asm("vsqrt.f32 %0, %1" : "=t"(root) : "t"(number));
    return root;
}
#else
#include <math.h>
static inline float square_root(float number)
{
    return sqrtf(number);
}
#endif

/* -- The block ------------------------------------------------------------------------------------------------------------------ */

#define NODES @NODES@u /* friction coefficients */
#define PARTS 8u       /* parts of a curve */
#define FORWARD 0u
#define BACKWARD 1u

/* Friction torque over load and friction coefficient, m, by the biased logarithm of the load (Rust: `LoadCurve`). */
typedef struct {
    float starts[PARTS];
    float cubics[PARTS][4];
} curve_t;

/* Curves under a load that opposes the motion and under one that assists it (Rust: `FrictionNode`). */
typedef struct {
    float friction;
    float octaves;
    curve_t curves[2];
    float shift[2];
} node_t;

@BLOCK@
/* -- Numbers -------------------------------------------------------------------------------------------------------------------- */

typedef union {
    float number;
    uint32_t bits;
    int32_t signed_bits;
} word_t;

/* `f32::to_bits` */
static inline uint32_t bits_of(float number)
{
    const word_t word = {.number = number};

    return word.bits;
}

/* `f32::to_bits().cast_signed()`: rises with a number that is not negative. */
static inline int32_t rank_of(float number)
{
    const word_t word = {.number = number};

    return word.signed_bits;
}

/* `f32::from_bits` */
static inline float number_of(uint32_t bits)
{
    const word_t word = {.bits = bits};

    return word.number;
}

/* `f32::abs` */
static inline float size_of(float number)
{
    return number_of(bits_of(number) & 0x7FFFFFFFu);
}

/* `Range::contains` */
static inline bool within(float number, float least, float largest)
{
    return (number >= least) && (number <= largest);
}

/* `scene::contract::direction` */
static inline float direction_of(float speed)
{
    return (speed < 0.0f) ? -1.0f : 1.0f;
}

/* The place of a direction in a pair: `FrictionLevel::of`, `CagedFriction::of` */
static inline uint32_t side_of(float direction)
{
    return (direction < 0.0f) ? BACKWARD : FORWARD;
}

#ifdef EPAS_NO_SUBNORMALS
static const bool subnormals_wanted = false;
#else
static const bool subnormals_wanted = true;
#endif

bool epas_gear_arithmetic_is_sound(void)
{
    /* Volatile: the compiler cannot compute with them. */
    volatile float above_one = 0x1.001p+0f;
    volatile float its_square = 0x1.002p+0f;
    volatile float one = 1.0f;
    volatile float half_ulp = 0x1p-24f;
    volatile float smallest_normal = FLT_MIN;
    volatile float subnormal;
    volatile uint32_t bits_of_nan = 0x7FC00000u;
    const float a = above_one;
    const float b = its_square;
    const float c = one;
    const float d = half_ulp;
    const float not_a_number = number_of(bits_of_nan);
    const float contracted = (a * a) - b; /* 2^-24 where the product is not rounded */
    const float reordered = (c + d) - c;  /* 2^-24 where the sum is not rounded */
    const bool rounds = (contracted == 0.0f) && (reordered == 0.0f);
    const bool compares = !(not_a_number <= c) && !(not_a_number > c);

    subnormal = smallest_normal * 0.5f;

    return rounds && compares && ((!subnormals_wanted) || ((subnormal * 0x1p+24f) == 0x1p-103f));
}

/* -- The law of one ball -------------------------------------------------------------------------------------------------------- */

/* `epas_friction::ball::folded::log2_biased` */
static inline float log2_biased(float number)
{
    const uint32_t bits = bits_of(number);
    const uint32_t exponent = bits >> 23u;
    const float mantissa = number_of((bits & 0x007FFFFFu) | 0x3F800000u) - 1.0f;

    return (float)exponent
           + (mantissa * (1.4383084f + (mantissa * (-0.6748423f + (mantissa * (0.3156053f + (mantissa * -0.0790714f)))))));
}

/* `LoadCurve::at` */
static inline float curve_at(const curve_t *curve, float log2)
{
    const int32_t rank = rank_of(log2);
    const float *cubic;
    float along;
    uint32_t part = 0u;

    if (rank >= rank_of(curve->starts[4])) {
        part = 4u;
    }
    if (rank >= rank_of(curve->starts[part + 2u])) {
        part += 2u;
    }
    if (rank >= rank_of(curve->starts[part + 1u])) {
        part += 1u;
    }
    cubic = curve->cubics[part];
    along = log2 - curve->starts[part];
    return cubic[0] + (along * (cubic[1] + (along * (cubic[2] + (along * cubic[3])))));
}

/* `LoadLaw::interval` */
static inline epas_gear_interval_t interval_of(float friction)
{
    epas_gear_interval_t interval = {0.0f, 0.0f, 0u};

    interval.friction = friction;
#if NODES > 1u
    {
        uint32_t number;

        for (number = 1u; (number + 1u) < NODES; number++) {
            if (friction > nodes[number].friction) {
                interval.node = number;
            }
        }
        if (friction <= nodes[0].friction) {
            interval.fraction = 0.0f;
        } else if (friction < nodes[NODES - 1u].friction) {
            const float low = nodes[interval.node].octaves;

            interval.fraction = (log2_biased(friction) - low) / (nodes[interval.node + 1u].octaves - low);
        } else {
            interval.fraction = 1.0f;
        }
    }
#endif
    return interval;
}

/* `LoadLaw::torque_over_load`: m, under a load of one ball, N, that opposes (0) or assists (1) the motion, at its logarithm within the law. */
static inline float torque_over_load(float log2, uint32_t branch, const epas_gear_interval_t *interval)
{
    const node_t *below = &nodes[interval->node];
    float value;

#if NODES > 1u
    {
        const node_t *above = &nodes[interval->node + 1u];
        const float octaves = log2 - SHIFTED_FROM;
        const float part = (octaves > 1.0f) ? 1.0f : ((octaves > 0.0f) ? octaves : 0.0f);
        const float shift = below->shift[branch] * part;
        const float low = curve_at(&below->curves[branch], log2 - (interval->fraction * shift));
        const float high = curve_at(&above->curves[branch], log2 + ((1.0f - interval->fraction) * shift));

        value = low + (interval->fraction * (high - low));
    }
#else
    value = curve_at(&below->curves[branch], log2);
#endif
    return (value > 0.0f) ? (interval->friction * value) : 0.0f;
}

/* The logarithm of a ball's load within the law, and EPAS_GEAR_BEYOND_MODEL above it: begin of `LoadLaw::torque_over_load` */
static inline float log2_within(float load, uint32_t *faults)
{
    float log2 = log2_biased(load);

    if (log2 > MOST_LOG2) {
        *faults |= EPAS_GEAR_BEYOND_MODEL;
        log2 = MOST_LOG2;
    }
    return (log2 > LEAST_LOG2) ? log2 : LEAST_LOG2;
}

/* -- The screw without memory --------------------------------------------------------------------------------------------------- */

/* `scene::ReversalState` */
typedef struct {
    float factor;
    float direction;
    bool standing;
} reversal_t;

/* That of `SceneOutputs::safe` */
static const reversal_t standing_still = {0.0f, 1.0f, true};

/* `Limits::check_inputs`: whether both are finite; they are then within their limits. */
static inline bool check_inputs(float *nut_speed, float *axial_load, uint32_t *faults)
{
    const float speed = *nut_speed;
    const float load = *axial_load;
    const bool speed_beyond = !(size_of(speed) <= SPEED_LIMIT);
    const bool load_beyond = !(size_of(load) <= LOAD_LIMIT);
    bool finite = true;

    if (speed_beyond || load_beyond) {
        const bool speed_finite = size_of(speed) <= FLT_MAX;
        const bool load_finite = size_of(load) <= FLT_MAX;

        finite = speed_finite && load_finite;
        if (finite) {
            *nut_speed = speed_beyond ? (direction_of(speed) * SPEED_LIMIT) : speed;
            *axial_load = load_beyond ? (direction_of(load) * LOAD_LIMIT) : load;
            *faults |= speed_beyond ? EPAS_GEAR_SPEED_RANGE : 0u;
            *faults |= load_beyond ? EPAS_GEAR_LOAD_RANGE : 0u;
        } else {
            *faults |= speed_finite ? 0u : EPAS_GEAR_SPEED_NOT_FINITE;
            *faults |= load_finite ? 0u : EPAS_GEAR_LOAD_NOT_FINITE;
        }
    }
    return finite;
}

/* `Outputs::new`, of the friction, N m, and of sliding friction in the direction of motion, N m */
static inline void set_outputs(epas_gear_outputs_t *outputs, float friction, float sliding, float axial_load, const reversal_t *reversal,
                               uint32_t faults)
{
    const float load_torque = axial_load * REDUCED_LEAD;
    const float opposing = reversal->direction * load_torque;
    float torque = friction;
    float efficiency = 0.0f;
    uint32_t regime;

    outputs->faults = faults;
    if (!(size_of(friction) <= TORQUE_LIMIT)) {
        outputs->faults |= EPAS_GEAR_FRICTION_LIMIT;
        torque = (size_of(friction) > 0.0f) ? (direction_of(friction) * TORQUE_LIMIT) : 0.0f;
    }
    if (reversal->standing) {
        regime = EPAS_GEAR_STANDING;
    } else if (opposing >= 0.0f) {
        regime = EPAS_GEAR_DRIVING;
    } else if (sliding < -opposing) {
        regime = EPAS_GEAR_BACK_DRIVING;
    } else {
        regime = EPAS_GEAR_LOCKED;
    }
    if ((size_of(load_torque) > 0.0f) && !reversal->standing) {
        if (((bits_of(torque) ^ bits_of(load_torque)) >> 31u) == 0u) {
            efficiency = load_torque / (load_torque + torque);
        } else {
            efficiency = 1.0f + (torque / load_torque);
            efficiency = (efficiency > -1e6f) ? efficiency : -1e6f;
        }
    }
    outputs->friction_torque = torque;
    outputs->load_torque = load_torque;
    outputs->efficiency = efficiency;
    outputs->regime = regime;
}

/* End of `FrictionModel::step`: ticks with a fault (`Faults::faulty`) in a row */
static inline uint32_t counted_faults(uint32_t ticks, uint32_t faults)
{
    uint32_t counted = 0u;

    if ((faults & ~EPAS_GEAR_BEYOND_MODEL) != 0u) {
        counted = ticks + ((ticks == 0xFFFFFFFFu) ? 0u : 1u);
    }
    return counted;
}

/* `FrictionModel::of` of a `CagedBallScrew` */
void epas_gear_init(epas_gear_t *model)
{
    model->interval = interval_of(FRICTION);
    model->faulted_ticks = 0u;
}

/* `FrictionModel::step` of a `CagedBallScrew` */
void epas_gear_step(epas_gear_t *model, float nut_speed, float axial_load, epas_gear_outputs_t *outputs)
{
    float speed = nut_speed;
    float load = axial_load;
    uint32_t faults = 0u;
    reversal_t reversal = standing_still;
    float sliding = 0.0f;

    if (check_inputs(&speed, &load, &faults)) {
        const float total_load = size_of(load) + LIFT_OFF;
        const float log2 = log2_within(total_load * PER_BALL, &faults);

        reversal.factor = speed / square_root((speed * speed) + REVERSAL_SQUARED);
        reversal.direction = direction_of(speed);
        reversal.standing = size_of(speed) < REVERSAL_SPEED;
        sliding = total_load * torque_over_load(log2, ((reversal.direction * load) < 0.0f) ? 1u : 0u, &model->interval);
    } else {
        load = 0.0f;
    }
    set_outputs(outputs, reversal.factor * sliding, sliding, load, &reversal, faults);
    model->faulted_ticks = counted_faults(model->faulted_ticks, outputs->faults);
}

/* `FrictionModel::set_friction` of a `CagedBallScrew` */
bool epas_gear_set_friction(epas_gear_t *model, float friction)
{
    const bool allowed = within(friction, EPAS_GEAR_LEAST_FRICTION, EPAS_GEAR_LARGEST_FRICTION);

    if (allowed) {
        model->interval = interval_of(friction);
    }
    return allowed;
}

/* -- The screw with memory ------------------------------------------------------------------------------------------------------ */

/* `CoefficientLaw::at_temperature` */
static void set_temperature(epas_gear_memory_t *model, float temperature)
{
    float ratio = SCALE * (temperature - POLE);
    float square;

    ratio = (ratio < WARMEST) ? ratio : WARMEST;
    ratio = (ratio > COLDEST) ? ratio : COLDEST;
    square = ratio * ratio;
    model->temperature = temperature;
    model->half_share_speed = (square * square) * ratio;
    model->churning = CHURNING / model->half_share_speed;
    model->fluidity = FLUIDITY * (square * square);
}

/* `FrictionModel::set_coefficient` of a `CoefficientLaw` with other coefficients, and else that of the block */
bool epas_gear_memory_set_coefficient(epas_gear_memory_t *model, float boundary, float full_film)
{
    bool allowed = within(boundary, 1e-6f, 1.0f) && within(full_film, 1e-6f, 1.0f);
    uint32_t side;

    for (side = 0u; side < 2u; side++) {
        const float slow = direction_factors[side] * boundary;
        const float fast = direction_factors[side] * full_film;

        allowed = allowed && within(slow, 1e-6f, 1.0f) && within(fast, 1e-6f, 0.5f) && within(fast + (slow - fast), 1e-6f, 0.5f);
    }
    for (side = 0u; allowed && (side < 2u); side++) {
        model->full_film[side] = direction_factors[side] * full_film;
        model->difference[side] = (direction_factors[side] * boundary) - model->full_film[side];
    }
    return allowed;
}

/* `FrictionModel::of` of a `WithMemory<CagedBallScrew, @ELEMENTS@, Deadband<CountSensor>, CoefficientLaw>` */
bool epas_gear_memory_init(epas_gear_memory_t *model, const epas_gear_sensors_t *sensors)
{
    const float counts = (sensors->period == 0u) ? 0x1p+32f : (float)sensors->period;
    const float size = size_of(sensors->turn_per_count);
    const float half = (0.5f * counts) * size;
    const bool encoder = (sensors->period != 1u) && within(size, 1e-9f, 1.0f) && within(sensors->play, 0.0f, 1e3f)
                         && within(sensors->largest_turn, 1e-6f, (half < 1e3f) ? half : 1e3f);
    const bool load = within(sensors->load_hold, 0.0f, 1e3f) && within(sensors->load_fade, 1e-6f, 1e3f);
    const bool temperature = within(sensors->fallback_temperature, 150.0f, 500.0f) && within(sensors->temperature_hold, 0.0f, 86400.0f)
                             && within(sensors->temperature_fade, 1e-3f, 86400.0f);
    const bool allowed = encoder && load && temperature;

    if (allowed) {
        uint32_t element;

        model->faulted_ticks = 0u;
        model->drag_torque = 0.0f;
        model->sensors = *sensors;
        model->load_rate = 1.0f / sensors->load_fade;
        model->temperature_rate = 1.0f / sensors->temperature_fade;
        for (element = 0u; element < EPAS_GEAR_ELEMENTS; element++) {
            model->held[element] = 0.0f;
        }
        model->play_position = 0.0f;
        model->last_count = 0u;
        model->counted = false;
        model->stepped = false;
        model->level[FORWARD] = 1.0f;
        model->level[BACKWARD] = 1.0f;
        model->nut_speed = 0.0f;
        model->axial_load = 0.0f;
        (void)epas_gear_memory_set_coefficient(model, BOUNDARY, FULL_FILM);
        set_temperature(model, sensors->fallback_temperature);
    }
    return allowed;
}

/* `Fade::left` */
static inline float left_of(float age, float hold, float rate)
{
    const float left = 1.0f - ((age - hold) * rate);
    const float faded = (left > 0.0f) ? left : 0.0f;

    return (age <= hold) ? 1.0f : faded;
}

/* `TemperatureFade::at`, and `WithMemoryConstants::take_temperature` */
static inline uint32_t take_temperature(epas_gear_memory_t *model, float temperature, float age)
{
    const bool valid = within(temperature, 150.0f, 500.0f);
    const bool fresh = age <= model->sensors.temperature_hold;
    const float fallback = model->sensors.fallback_temperature;
    float taken = temperature;
    uint32_t faults = 0u;

    if (!valid || !fresh) {
        const float left = left_of(age, model->sensors.temperature_hold, model->temperature_rate);

        faults |= valid ? 0u : EPAS_GEAR_TEMPERATURE_RANGE;
        faults |= fresh ? 0u : EPAS_GEAR_TEMPERATURE_STALE;
        if (!valid || !(left > 0.0f)) {
            taken = fallback;
        } else if (left < 1.0f) {
            taken = fallback + (left * (temperature - fallback));
        } else {
            taken = temperature;
        }
    }
    if ((taken < model->temperature) || (taken > model->temperature)) {
        set_temperature(model, taken);
    }
    return faults;
}

/* `NutAngle::turn` of a `Deadband<CountSensor>`: rad, and EPAS_GEAR_ANGLE_NOT_VALID where it is unknown or cut */
static inline float turn_of(epas_gear_memory_t *model, uint32_t count, uint32_t *faults)
{
    const uint32_t period = model->sensors.period;
    float moved = 0.0f;

    if ((period != 0u) && (count >= period)) {
        *faults |= EPAS_GEAR_ANGLE_NOT_VALID;
    } else {
        const uint32_t last = model->counted ? model->last_count : count;
        const uint32_t wrapped = (count < last) ? period : 0u;
        const uint32_t ahead = (count - last) + wrapped;
        const uint32_t back = period - ahead;
        const uint32_t half = (period == 0u) ? 0x80000000u : (period - (period / 2u));
        const float play = model->sensors.play;
        float turn = ((ahead >= half) ? -(float)back : (float)ahead) * model->sensors.turn_per_count;
        float position;

        model->last_count = count;
        model->counted = true;
        if (size_of(turn) > model->sensors.largest_turn) {
            turn = (turn < 0.0f) ? -model->sensors.largest_turn : model->sensors.largest_turn;
            *faults |= EPAS_GEAR_ANGLE_NOT_VALID;
        }
        /* `Play::follow` */
        position = model->play_position + turn;
        if (position > play) {
            model->play_position = play;
            moved = position - play;
        } else if (position < -play) {
            model->play_position = -play;
            moved = position + play;
        } else {
            model->play_position = position;
        }
    }
    return moved;
}

/* What an element holds, N m, after a turn, rad, between these limits, N m */
static inline float held_after(float held, float rate, float turn, float low, float high)
{
    float force = held + (rate * turn);

    force = (force > high) ? high : force;
    return (force < low) ? low : force;
}

#if !FOLLOWS_LOAD
/* `Elements::follow` of `ProportionalElements`; a turn is within the sensors' largest */
static inline float elements_follow(epas_gear_memory_t *model, float turn, float low, float high)
{
    const float base = held_after(model->held[0], rates[0], turn, low, high);
    float friction = -0.0f; /* its sum with any number is that number */
    uint32_t element;

    model->held[0] = base;
    for (element = 1u; element < EPAS_GEAR_ELEMENTS; element++) {
        model->held[element] = held_after(model->held[element], rates[element], turn, low, high);
        friction += shares[element] * (model->held[element] - base);
    }
    return base + friction;
}
#else
#if PRELOADED
/* `PreloadedElements::shared`, and `PreloadSum::under` */
static inline float shared_load(float load)
{
    const float axial = load - 1.0f;
    float sum = size_of(axial);

    if (sum < FLANKS_LIFT_OFF) {
        const float squared = axial * axial;

        sum = FLANKS_SUM + ((squared * FLANKS_SQUARE) * (1.0f + (squared * FLANKS_QUARTIC)));
    }
    return FLANKS_PER_SUM * sum;
}
#else
static inline float shared_load(float load)
{
    return load;
}
#endif

/* `load_exact::approach`, and `inverse_cube_roots`: the power 2/3 */
static inline float approach_of(float load)
{
    const float bounded = (load < 1e12f) ? load : 1e12f;
    const float seed = number_of(0x548D0DDBu - (bits_of(bounded) / 3u));
    const float cube = (bounded * seed) * (seed * seed);
    const float inverse = seed * (0x1.be3b42p+0f - (cube * (0x1.398d7ap+0f - (0x1.f6b04ap-2f * cube))));
    const float root = bounded * inverse;
    const float off = 1.0f - (root * (inverse * inverse));

    return root + (root * ((1.0f / 3.0f) * off));
}

/* `Elements::follow` of `LoadExactElements`; a turn is within the sensors' largest */
static inline float elements_follow(epas_gear_memory_t *model, float turn, float low, float high)
{
    const float approach = approach_of(shared_load(model->load_over_reference));
    const float almost = 1.0f - ((0.5f * FLT_EPSILON) * 12.0f); /* of eight elements */
    float borne[EPAS_GEAR_ELEMENTS];
    float whole = 0.0f;
    float share = 0.0f;
    float friction = -0.0f;
    uint32_t element;

    for (element = 0u; element < EPAS_GEAR_ELEMENTS; element++) {
        const float beyond = approach - onsets[element];

        borne[element] = stiffnesses[element] * ((beyond < 0.0f) ? 0.0f : beyond);
        whole += borne[element];
    }
    if (whole > 0.0f) {
        share = 1.0f / whole;
    }
    for (element = 0u; element < EPAS_GEAR_ELEMENTS; element++) {
        const float of = borne[element];

        model->held[element] = held_after(model->held[element], stiffnesses[element], turn, of * (share * low), of * (share * high));
        friction += model->held[element];
    }
    /* `load_exact::summed` */
    friction = (friction > (almost * high)) ? high : friction;
    return (friction < (almost * low)) ? low : friction;
}
#endif

/* `WithMemoryConstants::follow` */
static void follow(epas_gear_memory_t *model, float turn, uint32_t faults, epas_gear_outputs_t *outputs)
{
    reversal_t reversal = standing_still;

    if (model->stepped) {
        const float forward = model->sliding[FORWARD] * model->level[FORWARD];
        const float backward = model->sliding[BACKWARD] * model->level[BACKWARD];
        const float friction = elements_follow(model, turn, -backward, forward);
        const float limit = (friction < 0.0f) ? backward : forward;
        const bool too_fast = (size_of(model->nut_speed) > 60.0f) && (DRAG_TORQUE > 0.0f);

        if (limit > 0.0f) {
            const float factor = friction / limit;

            reversal.factor = factor * model->level[side_of(friction)];
            reversal.direction = direction_of(friction);
            reversal.standing = (size_of(factor) < 0.99f) || ((turn * friction) < 0.0f);
        } else {
            reversal.direction = direction_of(turn);
            reversal.standing = !(size_of(turn) > 0.0f);
        }
        set_outputs(outputs, (reversal.factor * model->sliding[side_of(reversal.factor)]) + model->drag_torque,
                    model->sliding[side_of(reversal.direction)], model->axial_load, &reversal,
                    faults | model->sliding_faults | (too_fast ? EPAS_GEAR_BEYOND_MODEL : 0u));
    } else {
        set_outputs(outputs, 0.0f, 0.0f, 0.0f, &reversal, faults);
    }
}

/* `LoadLaw::holds` */
static inline bool holds(float friction)
{
    return within(friction, (1.0f - 1e-3f) * EPAS_GEAR_LEAST_FRICTION, (1.0f + 1e-3f) * EPAS_GEAR_LARGEST_FRICTION);
}

/* `Sliding::sliding_friction` of a `CagedBallScrew` and `CoefficientAtTemperature::drag_torque`, under an axial load, N */
static inline void slide(epas_gear_memory_t *model, float axial_load)
{
    const float speed = size_of(model->nut_speed);
    const float share = model->half_share_speed / (model->half_share_speed + speed);
    const float forward = model->full_film[FORWARD] + (model->difference[FORWARD] * share);
    const float backward = model->full_film[BACKWARD] + (model->difference[BACKWARD] * share);
    const float mu_forward = (forward < 0.5f) ? forward : 0.5f;
    const float mu_backward = (backward < 0.5f) ? backward : 0.5f;
    const float size = size_of(axial_load);
    const float load = size + LIFT_OFF;
    epas_gear_interval_t interval = interval_of(mu_forward);
    bool held = holds(mu_forward);
    uint32_t faults = 0u;
    const float log2 = log2_within(load * PER_BALL, &faults);
    float both;
    float rolling;

    model->sliding[FORWARD] = load * torque_over_load(log2, (axial_load < 0.0f) ? 1u : 0u, &interval);
    if ((mu_backward < mu_forward) || (mu_backward > mu_forward)) {
        held = held && holds(mu_backward);
        interval = interval_of(mu_backward);
    }
    model->sliding[BACKWARD] = load * torque_over_load(log2, (axial_load > 0.0f) ? 1u : 0u, &interval);
    model->sliding_faults = faults | (held ? 0u : EPAS_GEAR_BEYOND_MODEL);
    model->stepped = true;
#if FOLLOWS_LOAD
    model->load_over_reference = load * PER_REFERENCE_LOAD;
#endif

    /* `RollingDrag::at`, where the unloaded flank of a preload lifts off at the difference of both loads */
    both = 2.1f * (load - size);
    rolling = (size > both) ? size : both;
    rolling = square_root(square_root(((speed * speed) * speed) * rolling));
    rolling = (DRAG_TORQUE * rolling) / (model->fluidity + (DRAG_HEATING * speed));
    rolling = number_of(bits_of(rolling) | (bits_of(model->nut_speed) & 0x80000000u));
    model->drag_torque = (model->churning * model->nut_speed) + rolling;
}

/* `FrictionModel::step` with memory */
void epas_gear_memory_step(epas_gear_memory_t *model, const epas_gear_memory_inputs_t *inputs, epas_gear_outputs_t *outputs)
{
    float speed = inputs->nut_speed;
    float load = inputs->axial_load;
    uint32_t faults = 0u;
    float left;
    float turn;

    if (check_inputs(&speed, &load, &faults)) {
        model->nut_speed = speed;
        model->axial_load = load;
    }
    faults |= take_temperature(model, inputs->temperature, inputs->temperature_age);
    left = left_of(inputs->load_age, model->sensors.load_hold, model->load_rate);
    faults |= (left < 1.0f) ? EPAS_GEAR_LOAD_STALE : 0u;
    turn = turn_of(model, inputs->count, &faults);
    slide(model, left * model->axial_load);
    follow(model, turn, faults, outputs);
    model->faulted_ticks = counted_faults(model->faulted_ticks, outputs->faults);
}

/* `FrictionModel::between` */
void epas_gear_memory_between(epas_gear_memory_t *model, uint32_t count, epas_gear_outputs_t *outputs)
{
    uint32_t faults = 0u;
    const float turn = turn_of(model, count, &faults);

    follow(model, turn, faults, outputs);
}

/* `FrictionModel::set_level` */
bool epas_gear_memory_set_level(epas_gear_memory_t *model, float forward, float backward)
{
    const bool allowed = within(forward, 0.1f, 10.0f) && within(backward, 0.1f, 10.0f);

    if (allowed) {
        model->level[FORWARD] = forward;
        model->level[BACKWARD] = backward;
    }
    return allowed;
}

