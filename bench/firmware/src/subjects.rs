//! Every function under test: its inputs, how it is run, and what it gives.

use core::hint::black_box;

use epas_friction::adaptation::AdaptationInputs;
use epas_friction::kinematics::EllipticContact;
use epas_friction::law::{FrictionLevel, SlidingLimits};
use epas_friction::scene::WithMemoryInputs;
use epas_friction::{Faults, Inputs, LoadShare, Regime};

use crate::contexts::Contexts;
#[allow(
    clippy::wildcard_imports,
    reason = "every function that is counted is a subject"
)]
use crate::counted::*;
use crate::gears::{GEAR_33X20, GEAR_33X20_RANGE, GEAR_33X20_WORN};
use crate::inputs::{
    SPECIAL, adaptation, angle, contact_angle, four_contacts, impedances, memory, pair, positive,
    tick, train, wave,
};
use crate::numbers::{
    adapted, all, linear_outputs, motion, outputs, screw_ball, two, uncaged_outputs,
};
use crate::remembering::{carriage_inputs, counted_inputs, counted_on};
use crate::scenes::{BALLS, CAGED_BY_LAW, EfficiencyStep, TICK, UNCAGED, remembered};
use crate::spread::Spread;

/// Most inputs and most outputs that a function has.
pub const WIDEST: usize = 40;

/// A function under test.
pub struct Subject {
    /// Its name; its call is the symbol `count_` with this name.
    pub name: &'static str,
    /// How many numbers go in.
    pub inputs: usize,
    /// How many numbers come out.
    pub outputs: usize,
    /// Writes the inputs of one case.
    pub fill: fn(&mut Spread, &mut [f32]),
    /// Runs it.
    pub run: fn(&mut Contexts, &[f32], &mut [f32]),
}

macro_rules! subjects {
    ($(#[$meta:meta])* $list:ident; $($name:ident: |$spread:ident| -> [$inputs:literal] $fill:expr,
        |$contexts:ident, $pattern:pat_param| -> [$outputs:literal] $run:expr;)*) => {
        $(#[$meta])*
        pub static $list: &[Subject] = &[$(Subject {
            name: stringify!($name),
            inputs: $inputs,
            outputs: $outputs,
            fill: {
                fn fill($spread: &mut Spread, inputs: &mut [f32]) {
                    let values: [f32; $inputs] = $fill;
                    for (input, value) in inputs.iter_mut().zip(values) {
                        *input = value;
                    }
                }
                fill
            },
            run: {
                fn run($contexts: &mut Contexts, inputs: &[f32], outputs: &mut [f32]) {
                    let Ok($pattern) = <[f32; $inputs]>::try_from(inputs) else {
                        return;
                    };
                    let values: [f32; $outputs] = $run;
                    for (output, value) in outputs.iter_mut().zip(values) {
                        *output = value;
                    }
                }
                run
            },
        }),*];
    };
}

/// Reads the cycle counter before and after a call; `black_box` keeps the compiler from moving the call.
macro_rules! timed {
    ($contexts:ident, $call:expr) => {{
        let start = ($contexts.clock)();
        let result = black_box($call);
        $contexts.elapsed = ($contexts.clock)().wrapping_sub(start);
        result
    }};
}

fn contacts([a, b, c, d, e, f, g, h]: [f32; 8]) -> FourContacts {
    FourContacts {
        angles: [a, b, c, d],
        forces: [e, f, g, h],
    }
}

subjects! {
    /// Every function of the crate that belongs into a control loop.
    SUBJECTS;
    curvature_literature: |spread| -> [2] contact_angle(spread),
        |c, [cos, sin]| -> [1] [timed!(c, count_curvature_literature(black_box(&c.literature), cos, sin))];
    curvature_circular_groove: |spread| -> [2] contact_angle(spread),
        |c, [cos, sin]| -> [1] [timed!(c, count_curvature_circular_groove(black_box(&c.circular), cos, sin))];
    curvature_fitted: |spread| -> [2] contact_angle(spread),
        |c, [cos, sin]| -> [1] [timed!(c, count_curvature_fitted(black_box(&c.fitted), cos, sin))];
    curvature_exact: |spread| -> [2] contact_angle(spread),
        |c, [cos, sin]| -> [2] {
            let both = timed!(c, count_curvature_exact(black_box(&c.exact), cos, sin));
            [both.kappa1, both.kappa2]
        };
    hertz_ellipse: |spread| -> [1] {
            let load = spread.magnitude(1e-3, 1e5);
            [spread.special(&[0.0, -1.0, f32::NAN, 1e9], SPECIAL).unwrap_or(load)]
        },
        |c, [load]| -> [4] {
            let ellipse = timed!(c, count_hertz_ellipse(black_box(&c.hertz), load));
            [ellipse.semi_major, ellipse.semi_minor, ellipse.deflection, ellipse.max_pressure]
        };
    efficiency_rolling: |spread| -> [2] {
            let friction = spread.between(0.0, 0.3);
            // Every other case without rolling resistance, as most are.
            let tangent = spread.between(0.0, 0.01);
            [friction, if spread.index().is_multiple_of(2) { 0.0 } else { tangent }]
        },
        |c, [friction, tangent]| -> [1] [
            timed!(c, count_efficiency_rolling(black_box(&c.efficiency), friction, tangent))
        ];
    efficiency_sliding: |spread| -> [1] [spread.between(0.0, 0.3)],
        |c, [friction]| -> [1] [timed!(c, count_efficiency_sliding(black_box(&c.efficiency), friction))];
    efficiency_backdrive: |spread| -> [1] [spread.between(0.0, 0.3)],
        |c, [friction]| -> [1] [timed!(c, count_efficiency_backdrive(black_box(&c.efficiency), friction))];
    kinematics_update: |spread| -> [6] [
            spread.between(0.55, 0.9),
            spread.between(0.2e-3, 0.8e-3),
            spread.between(0.03e-3, 0.15e-3),
            spread.between(0.55, 0.9),
            spread.between(0.2e-3, 0.8e-3),
            spread.between(0.03e-3, 0.15e-3),
        ],
        |c, [screw_angle, screw_major, screw_minor, nut_angle, nut_major, nut_minor]| -> [11] {
            let screw = black_box(EllipticContact {
                contact_angle: screw_angle, semi_major: screw_major, semi_minor: screw_minor,
            });
            let nut = black_box(EllipticContact {
                contact_angle: nut_angle, semi_major: nut_major, semi_minor: nut_minor,
            });
            let taken = timed!(c, count_kinematics_update(black_box(&mut c.kinematics), &screw, &nut));
            let [a, b, d, e, f, g, h, i, j, k] = motion(&c.kinematics.per_speed());
            [a, b, d, e, f, g, h, i, j, k, if taken { 1.0 } else { 0.0 }]
        };
    kinematics_tick: |spread| -> [1] {
            let speed = spread.between(-300.0, 300.0);
            [spread.special(&[0.0, f32::NAN, f32::INFINITY], SPECIAL).unwrap_or(speed)]
        },
        |c, [speed]| -> [10] motion(&timed!(c, count_kinematics_tick(black_box(&c.kinematics), speed)));
    kinematics_ratios: |spread| -> [1] [spread.between(0.0, 1.0)],
        |c, [_]| -> [4] {
            let ratios = timed!(c, count_kinematics_ratios(black_box(&c.kinematics)));
            [ratios.entrainment_angle, ratios.slide_to_roll, ratios.slide_angle, ratios.spin_to_roll]
        };
    friction_map: |spread| -> [1] {
            let offset = spread.between(-3.0, 3.0);
            [spread.special(&[0.0, 1.0, -1.0, 1e12, f32::INFINITY, f32::NAN], SPECIAL).unwrap_or(offset)]
        },
        |c, [offset]| -> [3] {
            let friction = timed!(c, count_friction_map(black_box(&c.map), offset));
            [friction.force, friction.moment, friction.power]
        };
    friction_coefficient: |spread| -> [1] {
            let speed = spread.between(-500.0, 500.0);
            [spread.special(&[0.0, 1e6, f32::INFINITY, f32::NAN], SPECIAL).unwrap_or(speed)]
        },
        |c, [speed]| -> [1] [timed!(c, count_friction_coefficient(black_box(&c.at_temperature), speed))];
    friction_coefficient_warming: |spread| -> [2] [
            spread.between(-500.0, 500.0), spread.between(213.0, 423.0),
        ],
        |c, [speed, temperature]| -> [1] [
            timed!(c, count_friction_coefficient_warming(black_box(&c.coefficient), speed, temperature))
        ];
    adaptation_update: |spread| -> [4] adaptation(spread),
        |c, [level, modelled, speed, load_torque]| -> [8] {
            let inputs = black_box(AdaptationInputs {
                observed: level * modelled, modelled, lubricant_drag: 0.0, level: FrictionLevel::ONE, nut_speed: speed, load_torque,
                regime: Regime::Driving, faults: Faults::NONE, saturated: false,
            });
            adapted(&timed!(c, count_adaptation_update(black_box(&mut c.adaptation), &inputs)))
        };
    sqrt: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_sqrt(x))];
    cbrt: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_cbrt(x))];
    cbrt_squared: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_cbrt_squared(x))];
    cbrt_and_squared: |spread| -> [1] positive(spread),
        |c, [x]| -> [2] two(timed!(c, count_cbrt_and_squared(x)));
    sin_cos: |spread| -> [1] angle(spread),
        |c, [x]| -> [2] two(timed!(c, count_sin_cos(x)));
    linear_ball_speed: |spread| -> [8] four_contacts(spread),
        |c, input| -> [2] {
            let ball = black_box(contacts(input));
            let moved = timed!(c, count_linear_ball_speed(black_box(&c.analytic), &ball));
            [moved.speed_deviation, moved.compliance]
        };
    linear_ball_analytic: |spread| -> [16] pair(four_contacts(spread), four_contacts(spread)),
        |c, [a, b, d, e, f, g, h, i, j, k, l, m, n, o, p, q]| -> [1] {
            let rear = black_box(contacts([a, b, d, e, f, g, h, i]));
            let front = black_box(contacts([j, k, l, m, n, o, p, q]));
            [timed!(c, count_linear_ball_analytic(black_box(&c.analytic), &rear, &front))]
        };
    step_efficiency: |spread| -> [3] [
            spread.between(-60.0, 60.0), spread.between(-10.0, 10.0), spread.between(0.01, 0.2),
        ],
        |c, [nut_speed, load_torque, friction]| -> [2] {
            let EfficiencyStep { efficiency, friction_torque } = timed!(
                c, count_step_efficiency(black_box(&c.efficiency), nut_speed, load_torque, friction)
            );
            [efficiency, friction_torque]
        };
    step_closed_form: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.closed_form);
            outputs(&timed!(c, count_step_closed_form(model, nut_speed, axial_load)))
        };
    step_load_proportional: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.load_proportional);
            outputs(&timed!(c, count_step_load_proportional(model, nut_speed, axial_load)))
        };
    step_caged: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] outputs(
            &timed!(c, count_step_caged(black_box(&mut c.caged), nut_speed, axial_load))
        );
    step_caged_range: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.caged_range);
            outputs(&timed!(c, count_step_caged_range(model, nut_speed, axial_load)))
        };
    step_caged_memory: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.caged_memory);
            let inputs = black_box(remembered(nut_speed, axial_load));
            outputs(&timed!(c, count_step_caged_memory(model, &inputs)))
        };
    step_caged_law: |spread| -> [3] {
            let [nut_speed, axial_load] = tick(spread);
            [nut_speed, axial_load, spread.between(250.0, 400.0)]
        },
        |c, [nut_speed, axial_load, temperature]| -> [4] {
            let model = black_box(&mut c.caged_law);
            let inputs = black_box(WithMemoryInputs {
                temperature,
                ..remembered(nut_speed, axial_load)
            });
            outputs(&timed!(c, count_step_caged_law(model, &inputs)))
        };
    between_caged: |spread| -> [1] [spread.between(-60.0, 60.0)],
        |c, [reading]| -> [4] {
            let model = black_box(&mut c.caged_memory);
            outputs(&timed!(c, count_between_caged(model, reading)))
        };
    set_friction_caged: |spread| -> [3] {
            let [nut_speed, axial_load] = tick(spread);
            [nut_speed, axial_load, spread.between(0.05, 0.15)]
        },
        |c, [nut_speed, axial_load, friction]| -> [4] {
            let model = black_box(&mut c.caged_set);
            let _ = timed!(c, count_set_friction_caged(model, friction));
            outputs(&model.step(Inputs { nut_speed, axial_load }))
        };
    swap_caged: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            c.worn = !c.worn;
            let model = black_box(&mut c.caged_swapped);
            let constants = black_box(if c.worn { &GEAR_33X20_WORN } else { &GEAR_33X20 });
            let _ = timed!(c, count_swap_caged(model, constants));
            outputs(&model.step(Inputs { nut_speed, axial_load }))
        };
    start_caged: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.caged_set);
            timed!(c, count_start_caged(model, black_box(&GEAR_33X20_RANGE)));
            outputs(&model.step(Inputs { nut_speed, axial_load }))
        };
    start_caged_law: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [4] {
            let model = black_box(&mut c.caged_law_started);
            timed!(c, count_start_caged_law(model, black_box(&CAGED_BY_LAW)));
            outputs(&model.step(remembered(nut_speed, axial_load)))
        };
    set_friction_37: |spread| -> [1] [spread.between(0.05, 0.15)],
        |c, [friction]| -> [1] {
            let model = black_box(&mut c.set);
            let done = timed!(c, count_set_friction_37(model, friction));
            [f32::from(u8::from(done))]
        };
    start_37: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [7] {
            let model = black_box(&mut c.uncaged_started);
            timed!(c, count_start_37(model, black_box(&UNCAGED)));
            uncaged_outputs(&model.step(Inputs { nut_speed, axial_load }))
        };
    memory_8: |spread| -> [3] memory(spread),
        |c, [turn, forward, backward]| -> [1] {
            let limits = black_box(SlidingLimits { forward, backward, load: 1.0 });
            let state = black_box(&mut c.proportional_state);
            [timed!(c, count_memory_8(black_box(&c.proportional), state, turn, &limits))]
        };
    memory_load_exact_8: |spread| -> [4] {
            let load = spread.between(0.0, 5.0);
            let [turn, forward, backward] = memory(spread);
            [turn, forward, backward, load]
        },
        |c, [turn, forward, backward, load]| -> [1] {
            let limits = black_box(SlidingLimits { forward, backward, load });
            let state = black_box(&mut c.load_exact_state);
            [timed!(c, count_memory_load_exact_8(black_box(&c.load_exact), state, turn, &limits))]
        };
    memory_preloaded_10: |spread| -> [4] {
            let load = spread.between(1.0, 4.0);
            let [turn, forward, backward] = memory(spread);
            [turn, forward, backward, load]
        },
        |c, [turn, forward, backward, load]| -> [1] {
            let limits = black_box(SlidingLimits { forward, backward, load });
            let state = black_box(&mut c.preloaded_state);
            [timed!(c, count_memory_preloaded_10(black_box(&c.preloaded), state, turn, &limits))]
        };
    memory_together_10: |spread| -> [3] memory(spread),
        |c, [turn, forward, backward]| -> [1] {
            let limits = black_box(SlidingLimits { forward, backward, load: 1.0 });
            let state = black_box(&mut c.together_state);
            [timed!(c, count_memory_together_10(black_box(&c.together), state, turn, &limits))]
        };
    memory_seat: |spread| -> [3] memory(spread),
        |c, [turn, forward, backward]| -> [1] {
            let limits = black_box(SlidingLimits { forward, backward, load: 1.0 });
            let state = black_box(&mut c.seat_state);
            [timed!(c, count_memory_seat(black_box(&c.seat), state, turn, &limits))]
        };
    turn_of_counts: |spread| -> [1] [spread.between(0.0, 16_400.0)],
        |c, [reading]| -> [1] {
            let last = black_box(&mut c.last_count);
            [timed!(c, count_turn_of_counts(black_box(&c.counts), last, reading as u32))]
        };
    turn_of_angles: |spread| -> [1] {
            let angle = spread.between(0.0, core::f32::consts::TAU);
            [spread.special(&[f32::NAN, -1.0, f32::INFINITY], SPECIAL).unwrap_or(angle)]
        },
        |c, [reading]| -> [1] {
            let last = black_box(&mut c.last_angle);
            [timed!(c, count_turn_of_angles(black_box(&c.angles), last, reading))]
        };
    turn_of_speed: |spread| -> [1] {
            let speed = spread.between(-2000.0, 2000.0);
            [spread.special(&[0.0, f32::NAN, f32::INFINITY], SPECIAL).unwrap_or(speed)]
        },
        |c, [speed]| -> [1] [timed!(c, count_turn_of_speed(black_box(&c.speeds), speed))];
    turn_steady: |spread| -> [1] [spread.between(0.0, 16_400.0)],
        |c, [reading]| -> [1] {
            let last = black_box(&mut c.last_steady);
            [timed!(c, count_turn_steady(black_box(&c.steady), last, reading as u32))]
        };
    play: |spread| -> [1] {
            let turn = spread.between(-3e-3, 3e-3);
            [spread.special(&[0.0, f32::NAN, 1.0], SPECIAL).unwrap_or(turn)]
        },
        |c, [turn]| -> [1] {
            let state = black_box(&mut c.play_state);
            [timed!(c, count_play(black_box(&c.play), state, turn))]
        };
    deviation_map: |spread| -> [1] [spread.between(0.0, 1.0)],
        |c, [period]| -> [1] {
            let phase = (period * 4_294_967_296.0) as u32;
            [timed!(c, count_deviation_map(black_box(c.deviation), phase))]
        };
    ball_screw_row: |spread| -> [2] [spread.between(-60.0, 60.0), spread.between(-400.0, 400.0)],
        |c, [nut_speed, load]| -> [5] {
            let row = timed!(c, count_ball_screw_row(black_box(&c.screw_row), nut_speed, load));
            c.screw_tick = row;
            screw_ball(&row.ball(0.03, -0.02, &LoadShare::MEAN), row.nominal_speed())
        };
    ball_screw_ball: |spread| -> [2] [spread.between(-0.2, 0.2), spread.between(-0.2, 0.2)],
        |c, [screw, nut]| -> [4] {
            let row = black_box(&c.screw_tick);
            let ball = timed!(c, count_ball_screw_ball(row, screw, nut, &LoadShare::MEAN));
            [ball.speed_deviation, ball.compliance, ball.groove_torque, ball.rubbing]
        };
    press_37: |spread| -> [3] train(spread),
        |c, input| -> [37] {
            let free = black_box(wave(input));
            let (impedance, room) = (black_box(impedances()), black_box([0.0; BALLS]));
            timed!(c, count_press_37(black_box(&mut c.press), &free, &impedance, &room));
            all(c.press.forces())
        };
    train_37: |spread| -> [3] train(spread),
        |c, input| -> [37] {
            let free = black_box(wave(input));
            let impedance = black_box(impedances());
            timed!(c, count_train_37(black_box(&mut c.train), &free, &impedance, 2e-3));
            all(c.train.forces())
        };
    step_train_37: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [7] uncaged_outputs(
            &timed!(c, count_step_train_37(black_box(&mut c.uncaged), nut_speed, axial_load))
        );
    step_train_37_pressing: |spread| -> [2] [spread.between(10.0, 30.0), spread.between(4_000.0, 40.0)],
        |c, [nut_speed, axial_load]| -> [7] uncaged_outputs(
            &timed!(c, count_step_train_37_pressing(black_box(&mut c.pressing), nut_speed, axial_load))
        );
    step_train_37_shares: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [7] uncaged_outputs(
            &timed!(c, count_step_train_37_shares(black_box(&mut c.uncaged_shares), nut_speed, axial_load))
        );
    step_train_37_range: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [7] uncaged_outputs(
            &timed!(c, count_step_train_37_range(black_box(&mut c.uncaged_range), nut_speed, axial_load))
        );
    step_train_37_memory: |spread| -> [2] tick(spread),
        |c, [nut_speed, axial_load]| -> [7] {
            c.gear_count = counted_on(c.gear_count, nut_speed, TICK);
            let inputs = black_box(counted_inputs(nut_speed, axial_load, c.gear_count));
            let model = black_box(&mut c.gear);
            uncaged_outputs(&timed!(c, count_step_train_37_memory(model, &inputs)))
        };
    step_train_37_memory_pressing: |spread| -> [2] [spread.between(10.0, 30.0), spread.between(4_000.0, 40.0)],
        |c, [nut_speed, axial_load]| -> [7] {
            c.gear_pressing_count = counted_on(c.gear_pressing_count, nut_speed, TICK);
            let inputs = black_box(counted_inputs(nut_speed, axial_load, c.gear_pressing_count));
            let model = black_box(&mut c.gear_pressing);
            uncaged_outputs(&timed!(c, count_step_train_37_memory_pressing(model, &inputs)))
        };
    step_train_37_law: |spread| -> [3] {
            let [nut_speed, axial_load] = tick(spread);
            [nut_speed, axial_load, spread.between(250.0, 400.0)]
        },
        |c, [nut_speed, axial_load, temperature]| -> [7] {
            c.gear_law_count = counted_on(c.gear_law_count, nut_speed, TICK);
            let inputs = black_box(WithMemoryInputs {
                temperature,
                ..counted_inputs(nut_speed, axial_load, c.gear_law_count)
            });
            let model = black_box(&mut c.gear_law);
            uncaged_outputs(&timed!(c, count_step_train_37_law(model, &inputs)))
        };
    between_train_37: |spread| -> [1] [spread.between(-60.0, 60.0)],
        |c, [nut_speed]| -> [7] {
            c.gear_count = counted_on(c.gear_count, nut_speed, 0.05 * TICK);
            let model = black_box(&mut c.gear);
            uncaged_outputs(&timed!(c, count_between_train_37(model, c.gear_count)))
        };
    step_linear_memory: |spread| -> [2] {
            let [speed, load] = tick(spread);
            [0.02 * speed, 0.1 * load]
        },
        |c, [speed, load]| -> [7] {
            let inputs = black_box(carriage_inputs(speed, load));
            let model = black_box(&mut c.carriage_memory);
            linear_outputs(&timed!(c, count_step_linear_memory(model, &inputs)))
        };
    between_linear: |spread| -> [1] [spread.between(-1.2, 1.2)],
        |c, [speed]| -> [7] {
            let model = black_box(&mut c.carriage_memory);
            linear_outputs(&timed!(c, count_between_linear(model, speed)))
        };
    step_linear: |spread| -> [2] {
            let [speed, load] = tick(spread);
            [0.02 * speed, 0.1 * load]
        },
        |c, [speed, load]| -> [7] linear_outputs(
            &timed!(c, count_step_linear(black_box(&mut c.carriage), speed, load, 0.2 * load))
        );
}

subjects! {
    /// Functions of other crates for the same purposes, counted for comparison.
    PEERS;
    libm_sqrtf: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_libm_sqrtf(x))];
    libm_cbrtf: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_libm_cbrtf(x))];
    libm_cosf: |spread| -> [1] angle(spread),
        |c, [x]| -> [1] [timed!(c, count_libm_cosf(x))];
    libm_sincosf: |spread| -> [1] angle(spread),
        |c, [x]| -> [2] two(timed!(c, count_libm_sincosf(x)));
    libm_powf: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_libm_powf(x))];
    micromath_sqrt: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_micromath_sqrt(x))];
    micromath_cos: |spread| -> [1] angle(spread),
        |c, [x]| -> [1] [timed!(c, count_micromath_cos(x))];
    micromath_powf: |spread| -> [1] positive(spread),
        |c, [x]| -> [1] [timed!(c, count_micromath_powf(x))];
    idsp_sin_cos: |spread| -> [1] angle(spread),
        |c, [x]| -> [2] two(timed!(c, count_idsp_sin_cos(x)));
    lugre_step: |spread| -> [1] [spread.between(-5.0, 5.0)],
        |c, [speed]| -> [1] [timed!(c, count_lugre_step(black_box(&mut c.lugre), speed))];
    stribeck_curve: |spread| -> [1] [spread.between(-5.0, 5.0)],
        |c, [speed]| -> [1] [timed!(c, count_stribeck_curve(black_box(&c.lugre.stribeck), speed))];
}
