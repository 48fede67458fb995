//! Every object that is made from plain numbers: refused, or its answers are finite.

use epas_design::efficiency::{
    DesignRequest, Duty, DynamicCorrection, optimum_contact_angle, optimum_efficiency,
};
use epas_friction::ball::{
    AnalyticLinearBall, GrooveFit, LinearBallParameters, ScrewRow, SpeedDeviation,
};
use epas_friction::contact::FrictionMap;
use epas_friction::curvature::{FittedCurvature, GothicArch};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::{ContactAngle, Groove, GrooveProfile, HelixPath};
use epas_friction::hertz::HertzContact;
use epas_friction::kinematics::{ContactKinematics, EllipticContact, KinematicsParameters};
use epas_friction::train::{Press, Train};
use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, Error, GrooveSize, LoadShare, Material,
};
use epas_testkit::random_scenes::row_numbers;

/// Numbers to make objects of, in turn; zeros when they are used up.
pub struct Numbers(pub Vec<f32>);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0.pop().unwrap_or(0.0)
    }

    fn several<const N: usize>(&mut self) -> [f32; N] {
        std::array::from_fn(|_| self.next())
    }

    fn within(&mut self, low: f32, high: f32) -> f32 {
        let raw = self.next();
        let bits = raw.to_bits();
        match bits & 7 {
            0 => raw,
            1 if bits & 8 == 0 => low,
            1 => high,
            _ => low + (high - low) * ((bits >> 8) as f32 * (1.0 / 16_777_215.0)),
        }
    }

    fn size(&mut self, low: f32, high: f32) -> f32 {
        let raw = self.next();
        let bits = raw.to_bits();
        match bits & 7 {
            0 => raw,
            1 if bits & 8 == 0 => low,
            1 => high,
            _ => low * (high / low).powf((bits >> 8) as f32 * (1.0 / 16_777_215.0)),
        }
    }

    fn choice(&mut self, count: u32) -> u32 {
        (self.next().to_bits() ^ self.0.len() as u32) % count
    }
}

fn all_finite(what: &str, values: &[f32]) -> Result<(), String> {
    if values.iter().all(|value| value.is_finite()) {
        Ok(())
    } else {
        Err(format!("{what}: {values:?}"))
    }
}

fn refused(what: &str, error: &Error) -> Result<(), String> {
    if error.field().is_empty() || error.allowed().contains(error.value()) {
        Err(format!("{what} refuses an allowed value: {error}"))
    } else {
        Ok(())
    }
}

/// What is made answers with finite numbers, or is refused.
fn asked<T, const N: usize>(
    what: &str,
    made: Result<T, Error>,
    answers: impl FnOnce(T) -> [f32; N],
) -> Result<(), String> {
    match made {
        Ok(made) => all_finite(what, &answers(made)),
        Err(error) => refused(what, &error),
    }
}

fn material(numbers: &mut Numbers) -> Material {
    let youngs_modulus = numbers.size(1e6, 1e13);
    let poisson_ratio = numbers.within(0.0, 0.5);
    let density = numbers.size(1.0, 1e5);
    match numbers.choice(3) {
        0 => Material {
            youngs_modulus,
            poisson_ratio,
            density,
        },
        1 => Material::STEEL,
        _ => Material::SILICON_NITRIDE,
    }
}

fn groove(numbers: &mut Numbers, ball_radius: f32) -> GrooveSize {
    let size = numbers.within(0.5005, 1.0);
    if numbers.choice(2) == 0 {
        GrooveSize::Conformity(size)
    } else {
        GrooveSize::Radius(2.0 * size * ball_radius)
    }
}

/// Makes one kind of object and asks it everything.
pub fn check(numbers: &mut Numbers) -> Result<(), String> {
    match numbers.choice(11) {
        0 => ball_screw(numbers),
        1 => curvature(numbers),
        2 => hertz(numbers),
        3 => efficiency(numbers),
        4 => kinematics(numbers),
        5 => friction_map(numbers),
        6 => linear_ball(numbers),
        7 => press(numbers),
        8 => train(numbers),
        9 => design(numbers),
        _ => shares(numbers),
    }
}

/// A clearance from each of its words: what is accepted is one that the design's balls have.
fn clearance(numbers: &mut Numbers, design: &BallScrew) -> Result<(), String> {
    let value = numbers.size(1e-9, 1e4);
    let loaded_balls = numbers.choice(1000) as u16;
    let words = [
        Clearance::new(value).and_then(|clearance| clearance.checked(design)),
        Clearance::new(-value).and_then(|clearance| clearance.checked(design)),
        Clearance::of_preload(design, value),
        Clearance::of_axial_play(design, value),
    ];
    for word in words {
        let clearance = match word {
            Ok(clearance) => clearance,
            Err(error) => {
                refused("Clearance", &error)?;
                continue;
            }
        };
        let forces = [
            clearance.preload(design),
            clearance.axial_preload(design, loaded_balls),
            clearance.axial_play(design),
        ];
        let what = format!("{clearance:?} of {value} in {:?}", design.parameters());
        all_finite(&what, &forces)?;
        if clearance.checked(design) != Ok(clearance) || forces.iter().any(|force| *force < 0.0) {
            return Err(format!("{what}: {forces:?}"));
        }
    }
    Ok(())
}

fn ball_screw(numbers: &mut Numbers) -> Result<(), String> {
    let pitch_radius = numbers.size(1e-3, 0.5);
    let lead = numbers.size(1e-7, 0.2);
    let ball_radius = pitch_radius * numbers.within(0.01, 0.9);
    let contact_angle = numbers.within(0.01, 1.5533);
    let parameters = BallScrewParameters {
        pitch_radius,
        lead,
        ball_radius,
        screw_groove: groove(numbers, ball_radius),
        nut_groove: groove(numbers, ball_radius),
        contact_angle,
        ball_material: material(numbers),
        groove_material: material(numbers),
    };
    let design = match BallScrew::new(parameters) {
        Ok(design) => design,
        Err(error) => return refused("BallScrew", &error),
    };
    for groove in [Groove::Screw, Groove::Nut] {
        let contact = HertzContact::of(&design, groove);
        let ellipse = contact.at(numbers.next());
        all_finite(
            &format!("HertzContact::of {groove:?} {parameters:?}"),
            &[
                contact.axis_ratio(),
                contact.semi_major_coefficient(),
                contact.semi_minor_coefficient(),
                contact.deflection_coefficient(),
                contact.max_pressure_coefficient(),
                ellipse.semi_major,
                ellipse.semi_minor,
            ],
        )?;
        let angle = numbers.within(0.0, 1.256);
        let angle = if (0.0..=1.256).contains(&angle) {
            angle
        } else {
            0.5
        };
        let fitted = FittedCurvature::of(&design, groove).first(ContactAngle::new(angle));
        all_finite(&format!("FittedCurvature {parameters:?}"), &[fitted])?;
    }
    clearance(numbers, &design)?;
    let friction = numbers.size(1e-6, 0.5);
    let [force, load] = [numbers.size(1e-3, 1e6), numbers.size(1e-6, 1e7)];
    let [nut_speed, screw, nut] = numbers.several();
    let fit = match numbers.choice(3) {
        0 => GrooveFit::Zero,
        1 => GrooveFit::Play,
        _ => GrooveFit::Preload {
            contact_force: force,
        },
    };
    match ScrewRow::new(&design, friction, fit) {
        Ok(row) => {
            let tick = row.at(nut_speed, load);
            let ball = tick.ball(screw, nut, &LoadShare::MEAN);
            let what = format!(
                "ScrewRow {parameters:?} {friction} {fit:?} at {nut_speed} {load} {screw} {nut}"
            );
            all_finite(&what, &row_numbers(&tick, &ball))?;
            if ball.compliance > 0.0 && ball.groove_torque >= 0.0 {
                Ok(())
            } else {
                Err(format!("{what}: {ball:?}"))
            }
        }
        Err(error) => refused("ScrewRow", &error),
    }
}

fn curvature(numbers: &mut Numbers) -> Result<(), String> {
    let curvature = numbers.size(1e-9, 1e9);
    let torsion = numbers.within(-1.0, 1.0) * curvature;
    let groove_radius = numbers.size(1e-3, 2.0) / curvature;
    let offset_h = groove_radius * numbers.within(0.0, 1.0);
    let offset_l = groove_radius * numbers.within(0.0, 1.0);
    let angle = numbers.within(0.0, std::f32::consts::FRAC_PI_2);
    let side = if numbers.choice(2) == 0 {
        Groove::Screw
    } else {
        Groove::Nut
    };
    let angle = match ContactAngle::checked(angle) {
        Ok(angle) => angle,
        Err(error) => return refused("ContactAngle", &error),
    };
    let path = if numbers.choice(2) == 0 {
        HelixPath { curvature, torsion }
    } else {
        match HelixPath::checked_from_lead_angle(curvature, torsion) {
            Ok(path) => path,
            Err(error) => return refused("HelixPath", &error),
        }
    };
    let profile = GrooveProfile {
        groove_radius,
        offset_h,
        offset_l,
    };
    let what = format!("GothicArch {side:?} {path:?} {profile:?} at {angle:?}");
    let arch = GothicArch::checked(side, &path, &profile, angle);
    asked(&what, arch, |arch| {
        let found = arch.principal(angle);
        [found.kappa1, found.kappa2]
    })
}

fn hertz(numbers: &mut Numbers) -> Result<(), String> {
    let first = numbers.size(1e-9, 1e9);
    let second = first * numbers.size(1e-5, 1e5);
    let modulus = numbers.size(1e3, 1e15);
    let load = numbers.size(1e-9, 1e7);
    let what = format!("HertzContact {first} {second} {modulus} at {load}");
    let contact = HertzContact::checked(first, second, modulus);
    asked(&what, contact, |contact| {
        let ellipse = contact.at(if load.is_infinite() { 1.0 } else { load });
        [
            ellipse.semi_major,
            ellipse.semi_minor,
            ellipse.deflection,
            ellipse.max_pressure,
        ]
    })
}

fn efficiency(numbers: &mut Numbers) -> Result<(), String> {
    let lead = numbers.within(0.0, 1.5);
    let contact = numbers.within(0.001, std::f32::consts::FRAC_PI_2);
    let ratio = numbers.within(0.0, 1.0);
    let friction = numbers.within(0.0, 1.0).abs();
    let friction = if friction <= 1.0 { friction } else { 0.1 };
    for drive in [
        epas_friction::efficiency::Drive::Driving,
        epas_friction::efficiency::Drive::BackDriving,
    ] {
        let what = format!("optimum_contact_angle {drive:?} {lead} {friction}");
        let best = optimum_contact_angle(drive, lead, friction);
        asked(&what, best, |best| {
            [best.contact_angle.unwrap_or(0.0), best.largest_lead_angle]
        })?;
    }
    all_finite("optimum_efficiency", &[optimum_efficiency(friction)])?;
    let what = format!("EfficiencyGeometry {lead} {contact} {ratio} with {friction}");
    let geometry = EfficiencyGeometry::new(lead, contact, ratio);
    // The denominator of eq. (3) vanishes on a line of the domain: its neighbours are large.
    asked(&what, geometry, |geometry| {
        [
            geometry.sliding_loss(friction),
            DynamicCorrection::new(&geometry, friction).coefficient(),
            geometry.rolling_backdrive_efficiency(friction, 0.0),
        ]
    })
}

fn kinematics(numbers: &mut Numbers) -> Result<(), String> {
    let ball_diameter = numbers.size(1e-4, 0.2);
    let pitch_angle = numbers.within(-1.5, 1.5);
    let [semi_major_screw, semi_major_nut] =
        [(); 2].map(|()| 0.5 * ball_diameter * numbers.within(0.0, 0.3));
    let parameters = KinematicsParameters {
        ball_diameter,
        pitch_radius: numbers.size(1e-4, 2.0),
        lead_angle: numbers.within(-1.2, 1.2),
        groove_radius_screw: ball_diameter * numbers.within(0.5, 2.0),
        groove_radius_nut: ball_diameter * numbers.within(0.5, 2.0),
        contact_angle_screw: pitch_angle + numbers.within(-1.3, 1.3),
        contact_angle_nut: pitch_angle + numbers.within(-1.3, 1.3),
        pitch_angle,
        yaw_angle: numbers.within(-0.5, 0.5),
        rolling_radius_screw: ball_diameter * numbers.within(0.25, 1.0),
        rolling_radius_nut: ball_diameter * numbers.within(0.25, 1.0),
        semi_major_screw,
        semi_minor_screw: semi_major_screw * numbers.within(0.0, 1.0),
        semi_major_nut,
        semi_minor_nut: semi_major_nut * numbers.within(0.0, 1.0),
    };
    let mut kinematics = match ContactKinematics::new(&parameters) {
        Ok(kinematics) => kinematics,
        Err(error) => return refused("ContactKinematics", &error),
    };
    let [speed, x, y] = numbers.several();
    let answers = |kinematics: &ContactKinematics| {
        let tick = kinematics.tick(speed);
        let mut values = vec![tick.orbital_speed, tick.spin_speed];
        for (contact, slip) in [
            (kinematics.screw(), tick.screw),
            (kinematics.nut(), tick.nut),
        ] {
            let ratios = contact.ratios();
            let at = contact.slip_at(speed, x, y);
            values.extend([
                slip.rolling_slip,
                slip.side_slip,
                slip.spin,
                slip.entrainment_speed,
                ratios.entrainment_angle,
                ratios.slide_to_roll,
                ratios.slide_angle,
                ratios.spin_to_roll,
                at.rolling,
                at.side,
            ]);
        }
        all_finite(
            &format!("ContactKinematics {parameters:?} at {speed}"),
            &values,
        )
    };
    answers(&kinematics)?;
    let contact = EllipticContact {
        contact_angle: numbers.within(-1.5, 1.5),
        semi_major: semi_major_screw,
        semi_minor: semi_major_screw * numbers.within(0.0, 1.0),
    };
    let before = kinematics;
    if !kinematics.update(contact, contact) && kinematics != before {
        return Err(format!("a refused update changed {before:?}"));
    }
    answers(&kinematics)?;
    Ok(())
}

fn friction_map(numbers: &mut Numbers) -> Result<(), String> {
    let ratio = numbers.within(0.01, 1.0);
    let offset = numbers.size(1e-6, 1e6);
    let what = format!("FrictionMap {ratio} at {offset}");
    asked(&what, FrictionMap::new(ratio), |map| {
        let found = map.evaluate(offset);
        [found.force, found.moment, found.power]
    })
}

fn linear_ball(numbers: &mut Numbers) -> Result<(), String> {
    let ball_radius = numbers.size(1e-5, 1.0);
    let contact_angle = numbers.within(0.05, 1.5);
    let axis_ratio = numbers.within(0.01, 1.0);
    let semi_major_coefficient = numbers.size(1e-8, 1.0);
    let friction = numbers.size(1e-6, 10.0);
    let slope = numbers.within(0.1, 10.0);
    let parameters = LinearBallParameters {
        ball_radius,
        contact_angle,
        axis_ratio,
        semi_major_coefficient,
        friction,
    };
    let what = format!("{parameters:?} {:?}", numbers.0);
    let ball = AnalyticLinearBall::new(&parameters, slope);
    asked(&what, ball, |ball| {
        let mut one = || ball.speed_deviation(&numbers.several(), &numbers.several());
        let [rear, front]: [SpeedDeviation; 2] = [one(), one()];
        [
            rear.speed_deviation,
            rear.compliance,
            rear.contact_force(&front),
        ]
    })
}

fn press(numbers: &mut Numbers) -> Result<(), String> {
    let mut press = Press::<5>::new();
    let free = [(); 5].map(|()| numbers.within(-1.0, 1.0));
    let impedance = [(); 5].map(|()| numbers.size(1e-9, 1e9));
    let room = [(); 5].map(|()| numbers.size(1e-9, 1e3));
    let sound = press.solve(&free, &impedance, &room);
    let forces: Vec<f32> = press.forces().collect();
    let speeds: Vec<f32> = press.speeds().collect();
    let what = format!("Press {free:?} {impedance:?} {room:?}");
    all_finite(&what, &forces)?;
    all_finite(&what, &speeds)?;
    if forces.iter().any(|force| *force < 0.0) || (!sound && forces.iter().any(|f| *f != 0.0)) {
        return Err(format!("{what}: sound {sound}, forces {forces:?}"));
    }
    Ok(())
}

fn train(numbers: &mut Numbers) -> Result<(), String> {
    let length = numbers.size(1e-4, 1e4);
    let pitch = length * numbers.size(1e-6, 0.25);
    let gaps = [(); 4].map(|()| (0.25 * length - pitch) * numbers.within(0.0, 1.0));
    match Train::<4>::new(length, pitch, &gaps) {
        Ok(mut train) => {
            for _ in 0..4 {
                let free = [(); 4].map(|()| numbers.within(-1.0, 1.0));
                let impedance = [(); 4].map(|()| numbers.size(1e-9, 1e9));
                let travel = length * numbers.within(-0.03, 0.03);
                train.step(&free, &impedance, travel);
                let what = format!(
                    "Train {length} {pitch} {gaps:?} after {free:?} {impedance:?} {travel}"
                );
                all_finite(&what, &train.forces().collect::<Vec<_>>())?;
                all_finite(&what, &train.gaps().collect::<Vec<_>>())?;
                let positions: Vec<u32> = train.positions().collect();
                let around: u64 = (0..4)
                    .map(|j| u64::from(positions[(j + 1) % 4].wrapping_sub(positions[j])))
                    .sum();
                if around != 1 << 32 {
                    return Err(format!("{what}: balls out of order {positions:?}"));
                }
            }
            Ok(())
        }
        Err(error) => refused("Train", &error),
    }
}

fn design(numbers: &mut Numbers) -> Result<(), String> {
    let duty = numbers.size(1e-3, 1e6);
    let lead_angle = numbers.within(0.001, 1.5);
    let friction = numbers.within(0.0, 1.0);
    let screw_length = numbers.size(0.06, 30.0);
    let pitch_radius = screw_length * numbers.size(1.0 / 60.0, 1.0);
    let ball_ratio = numbers.within(0.07, 0.2);
    let osculation = numbers.within(0.95, 0.97);
    let rotation = numbers.within(-1e6, 1e6);
    let request = DesignRequest {
        duty: if numbers.choice(2) == 0 {
            Duty::MoveAxialLoad(duty)
        } else {
            Duty::DeliverTorque(duty)
        },
        lead_angle,
        friction,
        screw_length,
        pitch_radius,
        ball_ratio,
        osculation,
        loaded_balls: numbers.choice(65536) as u16,
        rotation,
        material: material(numbers),
    };
    asked(&format!("{request:?}"), request.figures(), |figures| {
        [
            figures.contact_angle,
            figures.contact_force,
            figures.max_pressure_screw,
            figures.max_pressure_nut,
            figures.sliding_efficiency,
            figures.lead,
        ]
    })
}

fn shares(numbers: &mut Numbers) -> Result<(), String> {
    let share = numbers.size(0.01, 100.0);
    asked("LoadShare", LoadShare::new(share), |share| [share.share()])
}
