//! x
use epas_friction::*;
use epas_reference::friction::ball_screw_ball::{
    self as rb, ScrewContact, ScrewTrack, motion_with_contacts,
};
use epas_reference::friction::ball_screw_train::solve_screw_train;
use epas_reference::friction::linear_ball::EllipseLaw;

const FLANKS: [rb::Groove; 4] = rb::Groove::ALL;

fn rng(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    ((*state >> 11) as f64) / ((1u64 << 53) as f64)
}

fn design(pitch: f64, lead: f64, ball: f64, conf: f64, angle: f64) -> BallScrew {
    BallScrew::new(BallScrewParameters {
        pitch_radius: pitch as f32,
        lead: lead as f32,
        ball_radius: ball as f32,
        screw_groove: GrooveSize::Radius((2.0 * conf * ball) as f32),
        nut_groove: GrooveSize::Radius((2.0 * conf * ball) as f32),
        contact_angle: angle as f32,
        ball_material: Material::STEEL,
        groove_material: Material::STEEL,
    })
    .unwrap()
}

fn exact(design: &BallScrew, angles: &[f32; 4], forces: &[f32; 4]) -> Vec<ScrewContact> {
    (0..4)
        .filter(|&i| forces[i] > 0.0)
        .map(|i| {
            let groove = if i < 2 { Groove::Screw } else { Groove::Nut };
            let c = HertzContact::of_at(design, groove, ContactAngle::new(angles[i]));
            ScrewContact {
                groove: FLANKS[i],
                load: f64::from(forces[i]),
                contact_angle: f64::from(angles[i]),
                ellipse: EllipseLaw {
                    semi_major_constant: f64::from(c.semi_major_coefficient()),
                    axis_ratio: f64::from(c.axis_ratio()),
                },
            }
        })
        .collect()
}

#[test]
fn golden() {
    let data: serde_json::Value = serde_json::from_str(
        &std::fs::read_to_string(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/golden/ballscrew.json"
        ))
        .unwrap(),
    )
    .unwrap();
    let d = design(
        16.5e-3,
        20e-3,
        2.778e-3,
        3.254 / 2.0 / 2.778,
        std::f64::consts::FRAC_PI_4,
    );
    let ball = ScrewBall::new(&d, 0.1).unwrap();
    for case in data["impedance"].as_array().unwrap() {
        let get = |key: &str| {
            let mut a = [0.785f32; 4];
            let mut f = [0.0f32; 4];
            for (i, n) in ["SL", "SR", "NL", "NR"].iter().enumerate() {
                if let Some(c) = case[key].get(*n) {
                    f[i] = c[0].as_f64().unwrap() as f32;
                    a[i] = c[1].as_f64().unwrap() as f32;
                }
            }
            ball.contacts(&a, &f)
        };
        let contacts = [get("contacts1"), get("contacts2")];
        let states = contacts.map(|c| ball.closed_form(&c));
        let mut chain = ScrewChain::new(states);
        let mut press = Press::<2>::new();
        let mut pool = |u: &[f32; 2], y: &[f32; 2], f: &mut [f32; 2]| {
            press.solve(u, &y.map(|y| 1.0 / y), &[0.0, f32::INFINITY]);
            for (a, b) in f.iter_mut().zip(press.forces()) {
                *a = b;
            }
        };
        ball.press_chain(&mut chain, 1.0, &mut pool);
        print!(
            "closed F {:.4} ",
            chain.forces[0] / case["F"].as_f64().unwrap() as f32 - 1.0
        );
        for k in 0..2 {
            print!(
                " w {:.1e}",
                f64::from(ball.orbital_speed(&states[k].motion))
                    - case[["wB1", "wB2"][k]].as_f64().unwrap()
            );
        }
        for n in 1..5 {
            let s = contacts.map(|c| ball.refine(&c, &ball.closed_form(&c), 0.0, n));
            print!(" | {n}:");
            for k in 0..2 {
                print!(
                    " {:.1e}",
                    f64::from(ball.orbital_speed(&s[k].motion))
                        - case[["wB1", "wB2"][k]].as_f64().unwrap()
                );
            }
            ball.refine_chain(&contacts, &mut chain, 1.0, 0.1, &mut pool);
            print!(
                " F {:.4}",
                chain.forces[0] / case["F"].as_f64().unwrap() as f32 - 1.0
            );
        }
        println!();
    }
}

fn cases() -> Vec<Vec<f64>> {
    if let Ok(t) = std::fs::read_to_string("/tmp/sb_cases.txt") {
        return t
            .lines()
            .map(|l| l.split_whitespace().map(|x| x.parse().unwrap()).collect())
            .collect();
    }
    let mut out = Vec::new();
    for points in [2, 3, 30, 4] {
        let mut seed = 7u64;
        for _ in 0..250 {
            let mut r = |a: f64, b: f64| a + (b - a) * rng(&mut seed);
            let pitch = r(5e-3, 40e-3);
            let ballr = pitch * r(0.1, 0.3);
            let lead = pitch * r(0.2, 1.8);
            let conf = r(0.515, 0.58);
            let angle = r(0.61, 0.96);
            let mu = r(0.03, 0.2);
            let d = design(pitch, lead, ballr, conf, angle);
            let angles = [(); 4].map(|()| (angle + r(-0.0523, 0.0523)) as f32);
            let n = (r(0.0, 1.0) * 4.6).exp() * 2.0;
            let share = match points {
                2 => 0.0,
                3 => r(0.5, 1.4) * mu,
                30 => r(0.02, 0.5) * mu,
                _ => r(0.1, 1.0),
            };
            let main = n * r(0.97, 1.03);
            let up = r(0.0, 1.0) < 0.5;
            let screw = r(0.0, 1.0) < 0.5;
            let (t1, t2) = match points {
                4 => (share * n, share * n * r(0.9, 1.1)),
                _ => {
                    if screw {
                        (share * n, 0.0)
                    } else {
                        (0.0, share * n)
                    }
                }
            };
            let forces = if up {
                [n as f32, t1 as f32, t2 as f32, main as f32]
            } else {
                [t1 as f32, n as f32, main as f32, t2 as f32]
            };
            let track = ScrewTrack {
                pitch_radius: f64::from(d.pitch_radius()),
                lead: f64::from(d.lead()),
                ball_radius: f64::from(d.ball_radius()),
            };
            let list = exact(&d, &angles, &forces);
            let Ok(motion) = motion_with_contacts(&track, &list, f64::from(mu as f32), 1.0) else {
                println!("refused");
                continue;
            };
            let mut row = vec![f64::from(points), pitch, lead, ballr, conf, angle, mu];
            row.extend(angles.map(f64::from));
            row.extend(forces.map(f64::from));
            row.extend([motion.orbital_speed, motion.power_loss]);
            row.extend(motion.spin);
            out.push(row);
        }
    }
    let text: Vec<String> = out
        .iter()
        .map(|r| {
            r.iter()
                .map(|x| format!("{x:e}"))
                .collect::<Vec<_>>()
                .join(" ")
        })
        .collect();
    std::fs::write("/tmp/sb_cases.txt", text.join("\n")).unwrap();
    out
}

#[test]
fn random() {
    let all = cases();
    for points in [2, 3, 30, 4] {
        let mut worst = [(0.0f64, 0.0f64, 0.0f64); 8];
        let mut torque = [(0.0f64, 0.0f64, 0.0f64); 8];
        let mut bad = [0; 8];
        let mut count = 0.0;
        for c in all.iter().filter(|c| c[0] as i32 == points) {
            let d = design(c[1], c[2], c[3], c[4], c[5]);
            let ball = ScrewBall::new(&d, c[6] as f32).unwrap();
            let angles = [7, 8, 9, 10].map(|i| c[i] as f32);
            let forces = [11, 12, 13, 14].map(|i| c[i] as f32);
            let contacts = ball.contacts(&angles, &forces);
            count += 1.0;
            let mut s = ball.start(&contacts);
            for k in 0..8 {
                let e = f64::from(ball.orbital_speed(&s.motion)) - c[15];
                let t = f64::from(s.groove_torque) / c[16] - 1.0;
                if e.abs() > worst[k].0 {
                    worst[k].0 = e.abs();
                    if k >= 7 {
                        println!("  {points} step {k} {e:.2e}: {c:?} {:?}", s.motion);
                    }
                }
                if e.abs() > 2e-4 {
                    bad[k] += 1;
                }
                worst[k].1 += e * e;
                worst[k].2 += e;
                torque[k].0 = torque[k].0.max(t.abs());
                torque[k].1 += t * t;
                torque[k].2 += t;
                s = ball.step(&contacts, &s, 0.0);
            }
        }
        for k in 0..8 {
            println!(
                "points {points} step {k}: speed max {:.1e} rms {:.1e} mean {:+.1e} bad {}/{count}; torque max {:.1e} rms {:.1e} mean {:+.1e}",
                worst[k].0,
                (worst[k].1 / count).sqrt(),
                worst[k].2 / count,
                bad[k],
                torque[k].0,
                (torque[k].1 / count).sqrt(),
                torque[k].2 / count
            );
        }
    }
}
