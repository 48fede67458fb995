//! A figure and its forms: SVG, CSV, JSON.

use serde_json::{Value, json};

use super::table::csv_text;
use crate::failure::Failure;
use crate::plot::{Panel, render};

/// A figure of one or more panels.
pub struct Figure {
    /// Name of its files.
    pub name: &'static str,
    /// What it shows.
    pub caption: String,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel, pixels.
    pub size: (u32, u32),
}

impl Figure {
    /// Its points as CSV.
    pub fn csv(&self) -> Result<String, Failure> {
        let columns = ["panel", "series", "x", "y", "value"].map(String::from);
        let mut rows: Vec<Vec<String>> = Vec::new();
        for (index, panel) in self.panels.iter().enumerate() {
            match panel {
                Panel::Chart(chart) | Panel::Tall(chart) => {
                    for series in &chart.series {
                        for (x, y) in &series.points {
                            rows.push(vec![
                                index.to_string(),
                                series.name.clone(),
                                x.to_string(),
                                y.to_string(),
                                String::new(),
                            ]);
                        }
                    }
                }
                Panel::Map(map) => {
                    for (x, y, value) in map.cells() {
                        rows.push(vec![
                            index.to_string(),
                            map.quantity.clone(),
                            x.to_string(),
                            y.to_string(),
                            value.to_string(),
                        ]);
                    }
                }
                Panel::Strip(strip) => {
                    for (state, start, end) in &strip.stretches {
                        rows.push(vec![
                            index.to_string(),
                            strip.states[*state].clone(),
                            start.to_string(),
                            end.to_string(),
                            String::new(),
                        ]);
                    }
                }
            }
        }
        csv_text(&columns, rows.into_iter())
    }

    /// Its points as JSON.
    pub fn json(&self) -> Value {
        let panels: Vec<_> = self
            .panels
            .iter()
            .map(|panel| match panel {
                Panel::Chart(chart) | Panel::Tall(chart) => json!({
                    "title": chart.title,
                    "x": chart.x.label,
                    "y": chart.y.label,
                    "series": chart.series.iter()
                        .map(|series| json!({"name": series.name, "points": series.points}))
                        .collect::<Vec<_>>(),
                }),
                Panel::Map(map) => json!({
                    "title": map.title,
                    "x": map.x.label,
                    "y": map.y.label,
                    "quantity": map.quantity,
                    "cells": map.cells().collect::<Vec<_>>(),
                }),
                Panel::Strip(strip) => json!({
                    "x": strip.x.label,
                    "states": strip.states,
                    "stretches": strip.stretches,
                }),
            })
            .collect();
        json!({"caption": self.caption, "panels": panels})
    }

    /// As one picture.
    pub fn svg(&self) -> Result<String, Failure> {
        render(&self.panels, self.columns, self.size)
    }
}
