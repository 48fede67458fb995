//! Nodes of interpolation and quadrature, tables of sines, and numbers with a name: from their definitions.

use std::f64::consts::PI;

use epas_friction::ball::HALF_TO_FOUR_THIRDS;
use epas_friction::curvature::CHEBYSHEV;
use epas_friction::math::elliptic::GAUSS;
use epas_friction::scene::SINES;
use gauss_quad::GaussLegendre;

/// Rounded to nearest from a number that is itself within some ulp of float64.
fn is_rounded(stored: f32, exact: f64) {
    let error = (f64::from(stored) - exact).abs();
    assert!(
        error <= 0.51 * f64::from(f32::EPSILON) * exact.abs(),
        "{stored} {exact}"
    );
}

#[test]
fn the_curvature_is_fitted_at_chebyshev_nodes() {
    for (index, &node) in CHEBYSHEV.iter().enumerate() {
        if index == 2 {
            assert_eq!(node, 0.0);
        } else {
            is_rounded(node, ((2 * index + 1) as f64 * PI / 10.0).cos());
        }
    }
}

#[test]
fn numbers_with_a_name() {
    is_rounded(HALF_TO_FOUR_THIRDS, 0.5_f64.powf(4.0 / 3.0));
}

#[test]
fn the_narrow_integral_is_summed_by_gauss() {
    let rule = GaussLegendre::new(5.try_into().unwrap());
    let mut nodes = rule.as_node_weight_pairs().to_vec();
    nodes.sort_by(|first, second| first.0.total_cmp(&second.0));
    for ((node, weight), (stored_node, stored_weight)) in nodes.into_iter().zip(GAUSS) {
        if stored_node == 0.0 {
            assert!(node.abs() < 2e-16);
        } else {
            is_rounded(stored_node, node);
        }
        is_rounded(stored_weight, weight);
    }
}

/// 63 rotations in float64 leave 1e-14: rounded to f32 each sine is right, and a zero is within that.
#[test]
fn deviation_maps_are_made_of_sines() {
    for (sample, &sine) in SINES.iter().enumerate() {
        let exact = (PI * sample as f64 / 32.0).sin();
        assert!(
            (f64::from(sine) - exact).abs() < 6.1e-8 * exact.abs() + 1e-14,
            "{sample}"
        );
    }
}
