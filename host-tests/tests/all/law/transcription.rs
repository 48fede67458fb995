//! The elements' update in f64, straight from its formula, and their stored energy.

use epas_friction::law::memory::BackboneElement;

pub struct Elements {
    pub stiffnesses: Vec<f64>,
    pub shares: Shares,
    pub torques: Vec<f64>,
}

pub enum Shares {
    Constant(Vec<f64>),
    ByLoad(Vec<f64>),
}

impl Elements {
    pub fn of_table(angles: &[f64], weights: &[f64]) -> Self {
        Self {
            stiffnesses: weights.iter().zip(angles).map(|(w, z)| w / z).collect(),
            torques: vec![0.0; angles.len()],
            shares: Shares::Constant(weights.to_vec()),
        }
    }

    pub fn of_backbone(backbone: &[BackboneElement]) -> Self {
        let of = |number: fn(&BackboneElement) -> f32| -> Vec<f64> {
            backbone.iter().map(|e| number(e).into()).collect()
        };
        Self::of_table(&of(|e| e.angle), &of(|e| e.weight))
    }

    pub fn by_load(count: usize, largest_load: f64) -> Self {
        let half = 0.5 * largest_load.cbrt();
        let rule = gauss_quad::GaussLegendre::new(count.try_into().unwrap());
        let nodes = rule.as_node_weight_pairs();
        Self {
            stiffnesses: nodes.iter().map(|(_, g)| 1.5 * g * half).collect(),
            torques: vec![0.0; count],
            shares: Shares::ByLoad(
                nodes
                    .iter()
                    .map(|(u, _)| ((u + 1.0) * half).powi(2))
                    .collect(),
            ),
        }
    }

    fn shares(&self, load: f64) -> Vec<f64> {
        match &self.shares {
            Shares::Constant(shares) => shares.clone(),
            Shares::ByLoad(onsets) => {
                let approach = load.powf(2.0 / 3.0);
                let springs = onsets.iter().zip(&self.stiffnesses);
                let borne: Vec<f64> = springs.map(|(c, k)| k * (approach - c).max(0.0)).collect();
                let sum: f64 = borne.iter().sum();
                borne
                    .iter()
                    .map(|l| if sum > 0.0 { l / sum } else { 0.0 })
                    .collect()
            }
        }
    }

    pub fn follow(&mut self, turn: f64, forward: f64, backward: f64, load: f64) -> f64 {
        let shares = self.shares(load);
        for ((f, k), share) in self.torques.iter_mut().zip(&self.stiffnesses).zip(shares) {
            *f = (*f + k * turn).clamp(-share * backward, share * forward);
        }
        self.torques.iter().sum()
    }
}

pub fn energy(torques: &[f32], stiffnesses: &[f32]) -> f64 {
    let springs = torques.iter().zip(stiffnesses);
    springs
        .map(|(&f, &k)| f64::from(f).powi(2) / (2.0 * f64::from(k)))
        .sum()
}
