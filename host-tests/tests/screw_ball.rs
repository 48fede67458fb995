//! The ball of a ball screw: closed form and refined variant against the exact models.

use epas_friction::{
    BallScrew, BallScrewParameters, ContactAngle, Groove, GrooveFit, GrooveSize, HertzContact,
    LoadShare, Material, Press, ScrewBall, ScrewBallState, ScrewChain, ScrewContacts, ScrewRow,
};
use epas_reference::friction::ball_screw_ball::{
    Groove as Flank, ScrewContact, ScrewTrack, motion_with_contacts,
};
use epas_reference::friction::ball_screw_closed::{
    ContactAngles, Support, ThreePointModel, speed_ratio,
};
use epas_reference::friction::ball_screw_elastic::{BallSlip, ElasticBalls, ScrewSupport};
use epas_reference::friction::ball_screw_grooves::ElasticGrooves;
use epas_reference::friction::ball_screw_train::solve_screw_train;
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::EllipseLaw;
use serde_json::Value;
use std::f64::consts::FRAC_PI_4;

const TRACK: ScrewTrack = ScrewTrack {
    pitch_radius: 16.5e-3,
    lead: 20e-3,
    ball_radius: 2.778e-3,
};

fn design() -> BallScrew {
    BallScrew::new(BallScrewParameters {
        pitch_radius: 16.5e-3,
        lead: 20e-3,
        ball_radius: 2.778e-3,
        screw_groove: GrooveSize::Radius(3.254e-3),
        nut_groove: GrooveSize::Radius(3.254e-3),
        contact_angle: std::f32::consts::FRAC_PI_4,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
    .unwrap()
}

fn law(design: &BallScrew, groove: epas_friction::Groove) -> HertzLaw {
    let contact = epas_friction::HertzContact::of(design, groove);
    HertzLaw {
        ellipse: EllipseLaw {
            semi_major_constant: f64::from(contact.semi_major_coefficient()),
            axis_ratio: f64::from(contact.axis_ratio()),
        },
        compliance: 1e-7,
    }
}

#[test]
fn row_is_the_closed_form() {
    let design = design();
    for friction in [0.05, 0.12] {
        let row = ScrewRow::new(&design, friction as f32, GrooveFit::Zero).unwrap();
        let model = ThreePointModel {
            track: TRACK,
            screw: law(&design, epas_friction::Groove::Screw),
            nut: law(&design, epas_friction::Groove::Nut),
            friction,
            contact_angle: FRAC_PI_4,
        };
        for load in [-1000.0, -100.0, -50.0, -10.0, -1.0, -0.1, 1.0, 50.0f64] {
            for speed in [1.0, -1.0] {
                let tick = row.at(speed as f32, load as f32);
                for share in [0.1, 0.5, 1.0, 1.5, 3.0] {
                    for theta in [-3.0f64, 0.0, 3.0] {
                        for eta in [-3.0f64, 0.0, 3.0] {
                            let (t, e) = (theta.to_radians(), eta.to_radians());
                            let support = Support::of(load, speed);
                            let side = if load < 0.0 { 1.0 } else { -1.0 };
                            let angles = ContactAngles {
                                screw: FRAC_PI_4 + side * t,
                                nut: FRAC_PI_4 - side * e,
                                third: if support == Support::ThirdOnScrew {
                                    FRAC_PI_4 - side * t
                                } else {
                                    FRAC_PI_4 + side * e
                                },
                            };
                            let exact = model.ball(support, angles, load * share, speed).unwrap();
                            let ball = tick.ball(
                                t as f32,
                                e as f32,
                                &LoadShare::new(share as f32).unwrap(),
                            );
                            let path = TRACK.path_radius();
                            let dev = f64::from(ball.speed_deviation + tick.nominal_speed()) / path
                                - exact.orbital_speed / speed;
                            let y = f64::from(ball.compliance) / exact.compliance - 1.0;
                            let p = f64::from(ball.groove_torque) / exact.groove_loss() - 1.0;
                            let n = f64::from(tick.main_load()) * share / exact.main_load - 1.0;
                            let n3 = f64::from(tick.third_load()) * share / exact.third_load - 1.0;
                            let rub = f64::from(ball.rubbing)
                                / (TRACK.ball_radius
                                    * (exact.spin.abs()
                                        - exact.orbital_speed.abs() * TRACK.lead_angle().1))
                                - 1.0;
                            if (theta == 3.0 && eta == -3.0)
                                || (theta == 0.0 && eta == 0.0)
                                || (theta == 3.0 && eta == 3.0)
                            {
                                println!(
                                    "mu {friction} load {load} speed {speed} share {share} theta {theta} eta {eta}: speed {dev:.1e} Y {y:.1e} P {p:.1e} N {n:.1e} N3 {n3:.1e} rub {rub:.1e}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Errors of a sweep: no case above `bound`; largest, rms and mean are printed for the documentation.
struct Errors {
    name: String,
    bound: f64,
    max: f64,
    squares: f64,
    sum: f64,
    count: f64,
}

impl Errors {
    fn within(bound: f64, name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            bound,
            max: 0.0,
            squares: 0.0,
            sum: 0.0,
            count: 0.0,
        }
    }

    fn add(&mut self, error: f64, case: &str) {
        assert!(
            error.abs() <= self.bound,
            "{}: {error:.2e} above {:.1e} in {case}",
            self.name,
            self.bound
        );
        self.max = self.max.max(error.abs());
        self.squares += error * error;
        self.sum += error;
        self.count += 1.0;
    }

    fn rms(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }

    /// Largest rms and mean that are accepted.
    fn finish(self, rms: f64, bias: f64) {
        println!(
            "{}: max {:.1e} rms {:.1e} mean {:+.1e} of {}",
            self.name,
            self.max,
            self.rms(),
            self.sum / self.count,
            self.count
        );
        assert!(self.rms() <= rms, "{}: rms {:.2e}", self.name, self.rms());
        assert!(
            (self.sum / self.count).abs() <= bias,
            "{}: mean {:.2e}",
            self.name,
            self.sum / self.count
        );
    }
}

/// Numbers between two limits, the same in every run.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    fn design(&mut self) -> BallScrew {
        let pitch_radius = self.between(5e-3, 40e-3);
        let ball_radius = pitch_radius * self.between(0.1, 0.3);
        let groove = GrooveSize::Conformity(self.between(0.515, 0.58) as f32);
        BallScrew::new(BallScrewParameters {
            pitch_radius: pitch_radius as f32,
            lead: (pitch_radius * self.between(0.2, 1.8)) as f32,
            ball_radius: ball_radius as f32,
            screw_groove: groove,
            nut_groove: groove,
            contact_angle: self.between(0.61, 0.96) as f32,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })
        .unwrap()
    }

    /// Angles that deviate by up to `deviation` from the design's, each on its own.
    fn angles(&mut self, design: &BallScrew, deviation: f64) -> [f32; 4] {
        let nominal = design.parameters().contact_angle;
        [(); 4].map(|()| nominal + self.between(-deviation, deviation) as f32)
    }

    /// Forces of 2 to 200 N on one diagonal, and shares of them on the other one's screw and nut.
    fn forces(&mut self, first: f64, second: f64) -> [f32; 4] {
        let force = 2.0 * self.between(0.0, 100_f64.ln()).exp();
        let near = force * self.between(0.97, 1.03);
        let (first, second) = if self.between(0.0, 1.0) < 0.5 {
            (first, second)
        } else {
            (second, first)
        };
        let forces = if self.between(0.0, 1.0) < 0.5 {
            [force, first * force, second * force, near]
        } else {
            [first * force, force, near, second * force]
        };
        forces.map(|force| force as f32)
    }
}

fn track(design: &BallScrew) -> ScrewTrack {
    ScrewTrack {
        pitch_radius: f64::from(design.pitch_radius()),
        lead: f64::from(design.lead()),
        ball_radius: f64::from(design.ball_radius()),
    }
}

/// The same contacts for the exact model, each with the ellipse of its own contact angle.
fn exact_contacts(design: &BallScrew, angles: &[f32; 4], forces: &[f32; 4]) -> Vec<ScrewContact> {
    let grooves = [Groove::Screw, Groove::Screw, Groove::Nut, Groove::Nut];
    let given = Flank::ALL
        .into_iter()
        .zip(grooves)
        .zip(angles.iter().zip(forces));
    given
        .filter(|(_, (_, force))| **force > 0.0)
        .map(|((flank, groove), (angle, force))| {
            let contact = HertzContact::of_at(design, groove, ContactAngle::new(*angle));
            ScrewContact {
                groove: flank,
                load: f64::from(*force),
                contact_angle: f64::from(*angle),
                ellipse: EllipseLaw {
                    semi_major_constant: f64::from(contact.semi_major_coefficient()),
                    axis_ratio: f64::from(contact.axis_ratio()),
                },
            }
        })
        .collect()
}

/// Forces of an open row of balls.
fn press<const N: usize>(free: &[f32; N], compliance: &[f32; N], forces: &mut [f32; N]) {
    let mut press = Press::<N>::new();
    let mut room = [0.0; N];
    room[N - 1] = f32::INFINITY;
    assert!(press.solve(free, &compliance.map(|y| 1.0 / y), &room));
    for (force, found) in forces.iter_mut().zip(press.forces()) {
        *force = found;
    }
}

/// One kind of contact: shares of the other diagonal's two contacts as ranges, and bounds of the orbital
/// speed's error (largest, rms) and of the groove torque's after 0, 1, 2, ... impedance steps.
struct Kind {
    name: &'static str,
    deviation: f64,
    first: (f64, f64),
    second: (f64, f64),
    speed: [(f64, f64); 6],
    torque: [(f64, f64); 6],
}

fn sweep(kind: &Kind, closed: bool) {
    let mut random = Random(7);
    let errors = |quantity: &str, bounds: &[(f64, f64); 6]| -> Vec<Errors> {
        bounds
            .iter()
            .enumerate()
            .map(|(steps, bound)| {
                Errors::within(
                    bound.0,
                    format!("{}, {quantity} after {steps} steps", kind.name),
                )
            })
            .collect()
    };
    let mut speed = errors("orbital speed", &kind.speed);
    let mut torque = errors("groove torque", &kind.torque);
    for _ in 0..60 {
        let design = random.design();
        let friction = random.between(0.03, 0.2) as f32;
        let angles = random.angles(&design, kind.deviation);
        let first = random.between(kind.first.0, kind.first.1);
        let second = random.between(kind.second.0, kind.second.1);
        let scale = if second > 0.0 {
            1.0
        } else {
            f64::from(friction)
        };
        let forces = random.forces(scale * first, scale * second);
        let case = format!(
            "{:?}, friction {friction}, angles {angles:?}, forces {forces:?}",
            design.parameters()
        );
        let exact = motion_with_contacts(
            &track(&design),
            &exact_contacts(&design, &angles, &forces),
            f64::from(friction),
            1.0,
        )
        .expect(&case);

        let ball = ScrewBall::new(&design, friction).unwrap();
        let contacts = ball.contacts(&angles, &forces);
        let mut state = if closed {
            ball.closed_form(&contacts)
        } else {
            ball.start(&contacts)
        };
        for (speed, torque) in speed.iter_mut().zip(&mut torque) {
            let found = f64::from(ball.orbital_speed(&state.motion));
            speed.add(found - exact.orbital_speed, &case);
            torque.add(
                f64::from(state.groove_torque) / exact.power_loss - 1.0,
                &case,
            );
            state = ball.step(&contacts, &state, 0.0);
        }
    }
    for (errors, (max, rms)) in speed
        .into_iter()
        .zip(kind.speed)
        .chain(torque.into_iter().zip(kind.torque))
    {
        errors.finish(rms, 0.5 * max);
    }
}

const ANY: [(f64, f64); 6] = [(9.0, 9.0); 6];

#[test]
fn four_given_contacts() {
    for (degrees, name) in [
        (1.0_f64, "four contacts, 1 degree"),
        (3.0, "four contacts, 3 degrees"),
    ] {
        sweep(
            &Kind {
                name,
                deviation: degrees.to_radians(),
                first: (0.1, 1.0),
                second: (0.1, 1.0),
                speed: ANY,
                torque: ANY,
            },
            true,
        );
    }
}

#[test]
fn three_given_contacts() {
    for (first, name) in [
        ((0.5, 1.4), "pinned third contact"),
        ((0.02, 0.5), "light third contact"),
    ] {
        for closed in [true, false] {
            sweep(
                &Kind {
                    name: if closed { name } else { "from the start" },
                    deviation: 3_f64.to_radians(),
                    first,
                    second: (0.0, 0.0),
                    speed: ANY,
                    torque: ANY,
                },
                closed,
            );
        }
    }
}

#[test]
fn two_given_contacts() {
    sweep(
        &Kind {
            name: "two contacts",
            deviation: 3_f64.to_radians(),
            first: (0.0, 0.0),
            second: (0.0, 0.0),
            speed: ANY,
            torque: ANY,
        },
        true,
    );
}

fn stored() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/ballscrew.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Contact force of two balls with given contacts: closed form, and after every step of the iteration.
fn forces_of_pair(
    ball: &ScrewBall,
    contacts: &[ScrewContacts; 2],
    friction: f32,
    steps: usize,
) -> (Vec<f64>, ScrewChain<2>) {
    let mut chain = ScrewChain::new(contacts.map(|contacts| ball.start(&contacts)));
    ball.press_chain(&mut chain, 1.0, press);
    let mut found = vec![f64::from(chain.forces[0])];
    for _ in 0..steps {
        ball.refine_chain(contacts, &mut chain, 1.0, friction, press);
        found.push(f64::from(chain.forces[0]));
    }
    (found, chain)
}

/// Contacts of stored pairs: speeds on their own, and the force between them in grooves that give way.
#[test]
fn stored_pairs_with_given_contacts() {
    let design = design();
    let ball = ScrewBall::new(&design, 0.1).unwrap();
    let mut closed_speed = Errors::within(1.4e-3, "orbital speed, closed form");
    let mut refined_speed = Errors::within(3e-7, "orbital speed after 3 steps");
    let mut forces = [
        Errors::within(0.19, "contact force, closed form"),
        Errors::within(0.023, "contact force after 1 step"),
        Errors::within(0.005, "contact force after 2 steps"),
        Errors::within(0.005, "contact force after 3 steps"),
    ];
    for case in stored()["impedance"].as_array().unwrap() {
        let name = format!(
            "{} N, {} degrees, oversize {} mm",
            case["Fax"], case["theta"], case["over_mm"]
        );
        let contacts = ["contacts1", "contacts2"].map(|of_ball| {
            let mut angles = [0.0; 4];
            let mut loads = [0.0; 4];
            let flanks = ["SL", "SR", "NL", "NR"].iter();
            for (flank, (angle, load)) in flanks.zip(angles.iter_mut().zip(&mut loads)) {
                if let Some(contact) = case[of_ball].get(*flank) {
                    *load = number(&contact[0]) as f32;
                    *angle = number(&contact[1]) as f32;
                }
            }
            ball.contacts(&angles, &loads)
        });
        for (contacts, key) in contacts.iter().zip(["wB1", "wB2"]) {
            let closed = ball.closed_form(contacts);
            let refined = ball.refine(contacts, &closed, 0.0, 3);
            let speed = |state: &ScrewBallState| f64::from(ball.orbital_speed(&state.motion));
            closed_speed.add(speed(&closed) - number(&case[key]), &name);
            refined_speed.add(speed(&refined) - number(&case[key]), &name);
        }
        let (found, _) = forces_of_pair(&ball, &contacts, 0.1, 3);
        for (errors, force) in forces.iter_mut().zip(found) {
            errors.add(force / number(&case["F"]) - 1.0, &name);
        }
    }
    closed_speed.finish(5e-4, 2e-4);
    refined_speed.finish(2e-7, 2e-7);
    for (errors, rms) in forces.into_iter().zip([0.09, 0.012, 0.003, 0.003]) {
        errors.finish(rms, rms);
    }
}

/// Pairs with contacts of any kind against the exact model with the same contacts, friction between the balls included.
#[test]
fn pairs_with_given_contacts() {
    let mut random = Random(11);
    // Of the largest force that friction lets a ball hold along the track.
    let mut forces = [
        Errors::within(9.0, "contact force, closed form"),
        Errors::within(9.0, "contact force after 1 step"),
        Errors::within(9.0, "contact force after 2 steps"),
        Errors::within(9.0, "contact force after 3 steps"),
        Errors::within(9.0, "contact force after 4 steps"),
        Errors::within(9.0, "contact force after 5 steps"),
    ];
    let mut loss = Errors::within(9.0, "power loss after 5 steps");
    for _ in 0..60 {
        let design = random.design();
        let friction = random.between(0.05, 0.15) as f32;
        let other = random.between(0.2, 1.0);
        let loads = random.forces(other, other);
        let given = [(); 2].map(|()| (random.angles(&design, 0.035), loads));
        let case = format!("{:?}, friction {friction}, {given:?}", design.parameters());
        let exact: Vec<_> = given
            .iter()
            .map(|(angles, loads)| exact_contacts(&design, angles, loads))
            .collect();
        let mu = f64::from(friction);
        let exact = solve_screw_train(&track(&design), &exact, mu, mu, 1.0).expect(&case);
        let ball = ScrewBall::new(&design, friction).unwrap();
        let contacts = given.map(|(angles, loads)| ball.contacts(&angles, &loads));
        let (found, chain) = forces_of_pair(&ball, &contacts, friction, 5);
        let total: f32 = loads.iter().sum();
        let scale = mu * f64::from(total);
        for (errors, force) in forces.iter_mut().zip(found) {
            errors.add((force - exact.contact_forces[0]) / scale, &case);
        }
        let torque = ball.ball_torque(&chain, friction)
            + chain
                .balls
                .iter()
                .map(|state| state.groove_torque)
                .sum::<f32>();
        loss.add(f64::from(torque) / exact.power_loss() - 1.0, &case);
    }
    for errors in forces {
        errors.finish(9.0, 9.0);
    }
    loss.finish(9.0, 9.0);
}

/// Where loads vanish so do contact ellipses, and with them what spin moments do to the speed.
#[test]
fn closed_forms_are_the_geometry_of_contacts_that_do_not_slip() {
    let mut random = Random(3);
    let mut three = Errors::within(9.0, "third contact");
    let mut two = Errors::within(9.0, "two contacts");
    for _ in 0..300 {
        let design = random.design();
        let ball = ScrewBall::new(&design, 0.1).unwrap();
        let angles = random.angles(&design, 0.05);
        let [screw_left, screw_right, nut_left, nut_right] = angles.map(f64::from);
        let case = format!("{:?}, {angles:?}", design.parameters());
        for (forces, support, of) in [
            (
                [1.0, 1.0, 0.0, 1.0],
                Support::ThirdOnScrew,
                [screw_left, nut_right, screw_right],
            ),
            (
                [0.0, 1.0, 1.0, 1.0],
                Support::ThirdOnNut,
                [screw_right, nut_left, nut_right],
            ),
            (
                [1.0, 0.0, 0.0, 1.0],
                Support::TwoPoint,
                [screw_left, nut_right, 0.0],
            ),
        ] {
            let contacts = ball.contacts(&angles, &forces.map(|f: f32| 1e-6 * f));
            let [screw, nut, third] = of;
            let expected = speed_ratio(
                &track(&design),
                support,
                ContactAngles { screw, nut, third },
            );
            let found = f64::from(ball.orbital_speed(&ball.closed_form(&contacts).motion));
            let errors = if support == Support::TwoPoint {
                &mut two
            } else {
                &mut three
            };
            errors.add(found - expected, &case);
        }
    }
    three.finish(9.0, 9.0);
    two.finish(9.0, 9.0);
}

/// Hertz constants of the stored elastic models, m and N.
fn stored_law(side: &str) -> HertzLaw {
    let all = stored();
    let constants = &all["hertz"][format!("{side}_rG3.254")]["correct"];
    let value = |key: &str| number(&constants[key]) * 1e-3;
    HertzLaw {
        ellipse: EllipseLaw {
            semi_major_constant: value("Ca"),
            axis_ratio: value("Cb") / value("Ca"),
        },
        compliance: value("C"),
    }
}

/// Balls in grooves without play that give way, the second one in a screw groove that deviates by `theta`.
fn elastic(deviations: &[f64], nut_speed: f64) -> ElasticBalls {
    let (screw, nut) = (stored_law("S"), stored_law("N"));
    let grooves = deviations
        .iter()
        .map(|theta| ElasticGrooves {
            track: TRACK,
            groove_radius: 3.254e-3,
            arc_angles: [FRAC_PI_4 - theta, FRAC_PI_4 + theta, FRAC_PI_4, FRAC_PI_4],
            screw,
            nut,
            oversize: 0.0,
        })
        .collect();
    ElasticBalls {
        grooves,
        friction: 0.1,
        ball_friction: 0.1,
        nut_speed,
        ball_slip: BallSlip::Orbiting,
    }
}

/// Without play friction closes a third contact: on the screw or on the nut, with the direction.
#[test]
fn the_third_contact_follows_load_and_direction() {
    let row = ScrewRow::new(&design(), 0.1, GrooveFit::Zero).unwrap();
    let mut main = Errors::within(9.0, "load of the main contacts");
    let mut third = Errors::within(9.0, "load of the third contact");
    for load in [-100.0_f64, -50.0, -10.0, 10.0, 50.0, 100.0] {
        for speed in [1.0_f64, -1.0] {
            let case = format!("{load} N, {speed} rad/s");
            let solved = elastic(&[0.0], speed)
                .solve(ScrewSupport::Load(load))
                .unwrap();
            let (_, forces) = row.contacts(speed as f32, load as f32, 0.0, 0.0);
            let contacts = &solved.balls[0].contacts;
            assert_eq!(contacts.len(), 3, "{case}");
            let least = contacts
                .iter()
                .map(|contact| contact.contact.load)
                .fold(f64::INFINITY, f64::min);
            for (flank, force) in Flank::ALL.iter().zip(forces) {
                let exact = contacts
                    .iter()
                    .find(|contact| contact.contact.groove == *flank)
                    .map(|contact| contact.contact.load);
                match exact {
                    None => assert!(force == 0.0, "{case}: {flank:?}"),
                    Some(exact) => {
                        let errors = if exact > least { &mut main } else { &mut third };
                        errors.add(f64::from(force) / exact - 1.0, &case);
                    }
                }
            }
        }
    }
    main.finish(9.0, 9.0);
    third.finish(9.0, 9.0);
}

/// Force between two balls, loads and all, against the exact model of balls in elastic grooves.
///
/// A deviation that loads the third contact pins it; the opposite one lets it slide, and the closed form, which
/// takes it for pinned, is too large.
#[test]
fn force_between_two_balls_in_elastic_grooves() {
    let design = design();
    let row = ScrewRow::new(&design, 0.1, GrooveFit::Zero).unwrap();
    let ball = ScrewBall::new(&design, 0.1).unwrap();
    for per_ball in [10.0_f64, 25.0, 50.0, 100.0] {
        for sign in [-1.0, 1.0] {
            for pinning in [true, false] {
                let name = format!(
                    "{per_ball} N, {}, {}",
                    if sign < 0.0 { "SR-NL" } else { "SL-NR" },
                    if pinning { "pinning" } else { "opposite" }
                );
                let mut closed = Errors::within(9.0, format!("{name}: closed form"));
                let mut refined = Errors::within(9.0, format!("{name}: refined"));
                for degrees in [0.5_f64, 1.0, 2.0, 3.0] {
                    let theta = degrees.to_radians() * if pinning { 1.0 } else { -1.0 };
                    let load = sign * per_ball;
                    let tick = row.at(1.0, load as f32);
                    let states =
                        [0.0, theta].map(|theta| tick.ball(theta as f32, 0.0, &LoadShare::MEAN));
                    let difference = states[0].speed_deviation - states[1].speed_deviation;
                    // The faster ball is behind.
                    let order = if difference > 0.0 {
                        [0.0, theta]
                    } else {
                        [theta, 0.0]
                    };
                    let exact = elastic(&order, 1.0)
                        .solve(ScrewSupport::Load(2.0 * load))
                        .unwrap()
                        .contact_force;
                    let force = difference.abs() / (states[0].compliance + states[1].compliance);
                    closed.add(f64::from(force) / exact - 1.0, &name);
                    let contacts = order.map(|theta| {
                        let (angles, forces) = row.contacts(1.0, load as f32, theta as f32, 0.0);
                        ball.contacts(&angles, &forces)
                    });
                    let (found, _) = forces_of_pair(&ball, &contacts, 0.1, 4);
                    refined.add(found[4] / exact - 1.0, &name);
                }
                closed.finish(9.0, 9.0);
                refined.finish(9.0, 9.0);
            }
        }
    }
}

/// Lin 2019, Table 3.7, under the reading that reproduces it: 50 N on each of the two balls, three contacts, the
/// groove radius of Table 2.1 (3.254 mm), SR-NL load, SL and SR of the second ball turned by theta: 1.92 and 2.89 N.
#[test]
fn table_3_7() {
    let design = design();
    let row = ScrewRow::new(&design, 0.1, GrooveFit::Zero).unwrap();
    let ball = ScrewBall::new(&design, 0.1).unwrap();
    for (degrees, published) in [(2.0_f64, 1.92), (3.0, 2.89)] {
        let tick = row.at(1.0, -50.0);
        let states =
            [0.0, degrees.to_radians()].map(|theta| tick.ball(theta as f32, 0.0, &LoadShare::MEAN));
        let difference = states[0].speed_deviation - states[1].speed_deviation;
        let force = f64::from(difference / (states[0].compliance + states[1].compliance));
        let contacts = [0.0, degrees.to_radians()].map(|theta| {
            let (angles, forces) = row.contacts(1.0, -50.0, theta as f32, 0.0);
            ball.contacts(&angles, &forces)
        });
        let (refined, _) = forces_of_pair(&ball, &contacts, 0.1, 4);
        println!(
            "{degrees} degrees: row {force:.3} N ({:+.1} %), refined {:.3} N ({:+.1} %)",
            100.0 * (force / published - 1.0),
            refined[4],
            100.0 * (refined[4] / published - 1.0)
        );
    }
}
