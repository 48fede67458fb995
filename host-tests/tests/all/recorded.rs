//! Lines of `recorded.json`: what the long tests and the counted ones print of themselves.

use serde_json::json;

/// A sweep over every input of a function: errors against float64.
pub struct Sweep<'a> {
    /// What is computed, and what the error is of.
    pub quantity: &'a str,
    pub inputs: f64,
    pub largest: f64,
    pub rms: f64,
    pub mean: f64,
    pub command: &'a str,
}

impl Sweep<'_> {
    pub fn print(&self) {
        // Three digits: what the next compiler may change is not recorded.
        let short = |number: f64| -> f64 { format!("{number:.2e}").parse().unwrap() };
        println!(
            "recorded.json, sweeps: {}",
            json!({
                "quantity": self.quantity,
                "inputs": self.inputs as u64,
                "largest": short(self.largest),
                "rms": short(self.rms),
                "mean": short(self.mean),
                "command": self.command,
            })
        );
    }
}

pub fn print(what: &str, count: u64, command: &str) {
    println!(
        "recorded.json, runs: {}",
        json!({ "what": what, "count": count, "failures": 0, "command": command })
    );
}
