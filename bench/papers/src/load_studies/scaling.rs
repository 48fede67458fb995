//! Ball screws of any number of balls, for the cost of the static model.

use epas_reference::statics::cases::CaseStudy;

/// Case 1 of section 2.4 with more balls: as many turns as they need at the same distance, on a screw as
/// much longer, under the same load per ball.
#[must_use]
pub fn long_nut(balls: usize) -> CaseStudy {
    let case = CaseStudy::table_2_1();
    let factor = balls as f64 / case.balls as f64;
    let nut = factor * case.balls as f64 * case.ball_spacing * case.geometry.advance();
    let screw_length = case.screw_length.max(nut + 0.2);
    CaseStudy {
        balls,
        axial_load: factor * case.axial_load,
        screw_length,
        nut_position: 0.5 * screw_length,
        ..case
    }
}
