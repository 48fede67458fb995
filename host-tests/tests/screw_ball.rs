//! The ball of a ball screw: closed form and refined variant against the exact models.

use epas_friction::{
    BallScrew, BallScrewParameters, GrooveFit, GrooveSize, LoadShare, Material, ScrewRow,
};
use epas_reference::friction::ball_screw_ball::ScrewTrack;
use epas_reference::friction::ball_screw_closed::{ContactAngles, Support, ThreePointModel};
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::EllipseLaw;
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
