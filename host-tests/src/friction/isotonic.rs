//! Speeds and contact forces of a row of balls that push each other: a ball that is pushed by `F` from behind and by `F'` from ahead moves at
//! `free + compliance (F - F')`.

/// Solves `min sum (x_j - free_j)^2/(2 compliance_j)` under `x_j <= x_(j+1)`: neighbours that break the condition are joined into one
/// cluster with their weighted mean speed, until none does (pool adjacent violators).
///
/// Returns the speeds and the contact forces between neighbours, `F_j = sum_(i <= j) (free_i - x)/compliance_i` within a cluster. Source: the complementarity form of Lin 2019, eqs. (3.30), (3.31), for the linear model of (3.49).
pub fn pool_adjacent_violators(free: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
    struct Cluster {
        weight: f64,
        moment: f64,
        balls: usize,
    }
    let mut clusters: Vec<Cluster> = Vec::with_capacity(free.len());
    for (&x, &s) in free.iter().zip(compliance) {
        clusters.push(Cluster {
            weight: 1.0 / s,
            moment: x / s,
            balls: 1,
        });
        while let [.., rear, front] = clusters.as_slice() {
            if rear.moment * front.weight <= front.moment * rear.weight {
                break;
            }
            let merged = Cluster {
                weight: rear.weight + front.weight,
                moment: rear.moment + front.moment,
                balls: rear.balls + front.balls,
            };
            clusters.truncate(clusters.len() - 2);
            clusters.push(merged);
        }
    }
    let speeds: Vec<f64> = clusters
        .iter()
        .flat_map(|c| std::iter::repeat_n(c.moment / c.weight, c.balls))
        .collect();
    let mut forces = Vec::with_capacity(free.len().saturating_sub(1));
    let mut balls = free.iter().zip(compliance).zip(&speeds);
    for cluster in &clusters {
        let mut force = 0.0;
        for ((x, s), speed) in balls.by_ref().take(cluster.balls - 1) {
            force += (x - speed) / s;
            forces.push(force.max(0.0));
        }
        if balls.next().is_some() {
            forces.push(0.0);
        }
    }
    forces.pop();
    (speeds, forces)
}
