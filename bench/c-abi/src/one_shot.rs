//! Functions without state: clearance, efficiency, curvature.

use epas_friction::curvature::{CircularGrooveCurvature, GothicArch, LiteratureCurvature};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::ranges::FRICTION_OR_NONE;
use epas_friction::{Clearance, Error, Range};

use crate::design::{ball_screw, clearance as checked_clearance, loaded_balls};
use crate::requests::{
    self, ClearanceRequest, Curvature, CurvatureRequest, EPAS_GIVEN_AXIAL_PLAY,
    EPAS_GIVEN_CLEARANCE, EPAS_GIVEN_PRELOAD, EPAS_GROOVE_NUT, EPAS_GROOVE_SCREW, Efficiency,
    EfficiencyRequest,
};
use crate::status::{
    EPAS_FIELD_CONTACT_ANGLE, EPAS_FIELD_FRICTION, EPAS_FIELD_GIVEN, EPAS_FIELD_GROOVE,
    EPAS_FIELD_ROLLING_TANGENT, Failure,
};

/// A number that the crate takes unchecked.
fn checked(
    field: u32,
    name: &'static str,
    value: f32,
    minimum: f32,
    maximum: f32,
) -> Result<f32, Failure> {
    let allowed = Range::new(minimum, maximum);
    if allowed.contains(value) {
        Ok(value)
    } else {
        let error = if value.is_finite() {
            Error::OutOfRange {
                field: name,
                value,
                allowed,
            }
        } else {
            Error::NotFinite {
                field: name,
                value,
                allowed,
            }
        };
        Err(Failure::at(error, field))
    }
}

pub(crate) fn clearance(request: &ClearanceRequest) -> Result<requests::Clearance, Failure> {
    let design = ball_screw(&request.design)?;
    let balls = loaded_balls(request.loaded_balls)?;
    let clearance = match request.given {
        EPAS_GIVEN_CLEARANCE => checked_clearance(request.value)?.checked(&design),
        EPAS_GIVEN_PRELOAD => Clearance::of_preload(&design, request.value),
        EPAS_GIVEN_AXIAL_PLAY => Clearance::of_axial_play(&design, request.value),
        other => return Err(Failure::count(EPAS_FIELD_GIVEN, other, 0, 2)),
    }
    .map_err(Failure::of)?;
    Ok(requests::Clearance {
        clearance: clearance.gap(),
        preload: clearance.preload(&design),
        axial_preload: clearance.axial_preload(&design, balls),
        axial_play: clearance.axial_play(&design),
    })
}

pub(crate) fn efficiency(request: &EfficiencyRequest) -> Result<Efficiency, Failure> {
    let friction = checked(
        EPAS_FIELD_FRICTION,
        "friction",
        request.friction,
        0.0,
        FRICTION_OR_NONE.maximum,
    )?;
    let rolling = checked(
        EPAS_FIELD_ROLLING_TANGENT,
        "rolling_tangent",
        request.rolling_tangent,
        0.0,
        0.1,
    )?;
    let geometry = EfficiencyGeometry::new(
        request.lead_angle,
        request.contact_angle,
        request.ball_ratio,
    )
    .map_err(Failure::of)?;
    Ok(Efficiency {
        rolling_drive: geometry.rolling_efficiency(friction, rolling),
        rolling_backdrive: geometry.rolling_backdrive_efficiency(friction, rolling),
        sliding_drive: geometry.sliding_efficiency(friction),
        sliding_backdrive: geometry.sliding_backdrive_efficiency(friction),
        locked_drive: u32::from(geometry.locks(Drive::Driving, friction)),
        locked_backdrive: u32::from(geometry.locks(Drive::BackDriving, friction)),
    })
}

pub(crate) fn curvature(request: &CurvatureRequest) -> Result<Curvature, Failure> {
    let design = ball_screw(&request.design)?;
    let groove = match request.groove {
        EPAS_GROOVE_SCREW => Groove::Screw,
        EPAS_GROOVE_NUT => Groove::Nut,
        other => return Err(Failure::count(EPAS_FIELD_GROOVE, other, 0, 1)),
    };
    let angle = ContactAngle::new(checked(
        EPAS_FIELD_CONTACT_ANGLE,
        "contact_angle",
        request.contact_angle,
        0.0,
        core::f32::consts::FRAC_PI_2,
    )?);
    let exact = GothicArch::of(&design, groove).principal(angle);
    Ok(Curvature {
        first: exact.kappa1,
        second: exact.kappa2,
        circular_groove: CircularGrooveCurvature::of(&design, groove).first(angle),
        literature: LiteratureCurvature::of(&design, groove).first(angle),
    })
}
