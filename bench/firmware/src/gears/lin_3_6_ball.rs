// placeholder
#[allow(missing_docs)]
pub static LIN_3_6_BALL: epas_friction::scene::FoldedBall<1> = {
    use epas_friction::ball::pressed::*;
    let numbers = BallNumbers {
        free: [0.001, 0.3, 0.25, 0.01, 0.02, 0.01],
        impedance: [20.0, 1.0, 2.0],
        torque: [2e-3, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5],
        slope: 1e-4,
        grip: -0.5,
        rubbing: 1e-2,
    };
    let mut knots = [BallKnot {
        load: 1.0,
        per_width: 0.0,
        numbers,
    }; KNOTS];
    let mut k = 0;
    while k < KNOTS {
        knots[k].load = 1.0 + 17.0 * k as f32;
        knots[k].per_width = if k + 1 < KNOTS { 1.0 / 17.0 } else { 0.0 };
        k += 1;
    }
    let node = BallNode {
        friction: 0.1,
        branches: [knots; 2],
        unheld: [0; 2],
    };
    let mut nodes = [node; 1];
    let mut n = 1;
    while n < 1 {
        nodes[n].friction = nodes[n - 1].friction * 1.5;
        n += 1;
    }
    epas_friction::scene::FoldedBall {
        law: BallLaw {
            nodes,
            deviations: [0.0401, 0.0225],
            lift_off: 0.0,
        },
        friction: 0.1,
        lead: 0.02,
        ball_radius: 0.002976,
        path_radius: 0.01789,
        speed: 0.0085,
        reversal_speed: 0.5,
        limits: epas_friction::Limits {
            nut_speed: 100.0,
            axial_load: 20_000.0,
            friction_torque: 20.0,
        },
    }
};
