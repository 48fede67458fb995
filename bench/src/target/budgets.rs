//! What functions and scenes may cost.

use super::measure::Figures;

/// What a budget limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Most cycles of a function.
    Cycles,
    /// Most over least cycles of a function.
    Spread,
    /// Flash of a scene beyond the empty program, bytes.
    FlashBeyondEmpty,
    /// Flash of a scene, bytes.
    Flash,
    /// Flash of a scene built for size, bytes.
    FlashSmall,
    /// Memory of a scene, bytes.
    Ram,
    /// Stack of a scene's step, bytes.
    Stack,
}

/// One budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Function or scene.
    pub name: &'static str,
    /// What is limited.
    pub quantity: Quantity,
    /// The limit.
    pub most: f64,
}

const fn cycles(name: &'static str, most: f64) -> Budget {
    Budget {
        name,
        quantity: Quantity::Cycles,
        most,
    }
}

const fn spread(name: &'static str) -> Budget {
    Budget {
        name,
        quantity: Quantity::Spread,
        most: 1.5,
    }
}

const fn scene(name: &'static str, quantity: Quantity, most: f64) -> Budget {
    Budget {
        name,
        quantity,
        most,
    }
}

/// Every budget. The unit of the first four is the literature formula of the curvature, 31 cycles; 8,400
/// cycles are one period of a 20 kHz loop at 168 MHz.
pub const BUDGETS: [Budget; 31] = [
    cycles("curvature_literature", 31.0),
    cycles("curvature_circular_groove", 36.0),
    cycles("curvature_fitted", 45.0),
    cycles("curvature_exact", 140.0),
    cycles("sqrt", 20.0),
    cycles("cbrt", 60.0),
    cycles("sin_cos", 60.0),
    cycles("efficiency_rolling", 40.0),
    cycles("efficiency_sliding", 66.0),
    cycles("kinematics_update", 450.0),
    cycles("kinematics_tick", 40.0),
    cycles("friction_map", 45.0),
    cycles("linear_ball_analytic", 250.0),
    cycles("linear_ball_refined", 1500.0),
    cycles("train_37", 2500.0),
    cycles("step_caged", 300.0),
    cycles("step_train_37", 8400.0),
    cycles("step_train_37_pressing", 8400.0),
    spread("step_efficiency"),
    spread("step_caged"),
    spread("step_linear"),
    spread("step_train_37"),
    scene("curvature", Quantity::FlashBeyondEmpty, 1024.0),
    scene("everything", Quantity::Flash, 16384.0),
    scene("everything", Quantity::FlashSmall, 16384.0),
    scene("ball_screw_37", Quantity::Ram, 1536.0),
    scene("curvature", Quantity::Stack, 512.0),
    scene("efficiency", Quantity::Stack, 512.0),
    scene("caged_ball_screw", Quantity::Stack, 512.0),
    scene("linear_bearing", Quantity::Stack, 512.0),
    scene("ball_screw_37", Quantity::Stack, 512.0),
];

impl Budget {
    /// What it limits, in words.
    pub fn what(&self) -> String {
        let quantity = match self.quantity {
            Quantity::Cycles => "cycles",
            Quantity::Spread => "most over least cycles",
            Quantity::FlashBeyondEmpty => "flash beyond empty",
            Quantity::Flash => "flash",
            Quantity::FlashSmall => "flash, built for size",
            Quantity::Ram => "RAM",
            Quantity::Stack => "stack",
        };
        format!("{}: {quantity}", self.name)
    }
}

/// The figure that a budget limits.
pub fn figure(figures: &Figures, budget: &Budget) -> Option<f64> {
    let function = || figures.function(budget.name);
    let scene = || figures.scene(budget.name);
    Some(match budget.quantity {
        Quantity::Cycles => f64::from(function()?.cycles_max),
        Quantity::Spread => {
            let entry = function()?;
            f64::from(entry.cycles_max) / f64::from(entry.cycles_min)
        }
        Quantity::FlashBeyondEmpty => scene()?.flash_beyond_empty as f64,
        Quantity::Flash => scene()?.flash as f64,
        Quantity::FlashSmall => scene()?.flash_small as f64,
        Quantity::Ram => scene()?.ram as f64,
        Quantity::Stack => scene()?.stack as f64,
    })
}
