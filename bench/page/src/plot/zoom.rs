//! A page with charts below each other, in which a reader looks closer: one stretch of the horizontal axis for all of them.

use serde_json::{Value, json};

use super::chart::Chart;
use super::panel::{Panel, render_one};
use super::series::Mark;
use super::strip::Strip;
use super::theme::themed;
use crate::failure::Failure;

const STYLE: &str = include_str!("zoom.css");
const SCRIPT: &str = include_str!("zoom.js");

/// Size of the pictures that stand in where a page runs no script, pixels.
const SIZE: (u32, u32) = (1000, 250);

/// The page: points of every panel, and the script that draws them.
pub fn zoomable(title: &str, panels: &[Panel]) -> Result<String, Failure> {
    let data: Vec<Value> = panels.iter().filter_map(data).collect();
    let data = serde_json::to_string(&data).map_err(|error| Failure::Data(error.to_string()))?;
    let mut still = String::new();
    for panel in panels {
        still += &themed(&render_one(panel, SIZE)?);
    }
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    // Nothing in the data ends the script: a name may hold anything.
    let data = data.replace("</", "<\\/");
    Ok(format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <meta name=\"color-scheme\" content=\"light dark\"><link rel=\"icon\" href=\"data:,\">\
         <title>{title}</title><style>{STYLE}</style></head><body><h1>{title}</h1>\n\
         <p class=\"help\">Drag over a stretch to look closer, or turn the wheel; two fingers on a screen. A double click shows \
         everything. <button type=\"button\">Show everything</button></p>\n\
         <div id=\"panels\"></div><noscript>{still}</noscript>\n\
         <script>\"use strict\";const PANELS={data};\n{SCRIPT}</script></body></html>\n"
    ))
}

fn data(panel: &Panel) -> Option<Value> {
    match panel {
        Panel::Chart(chart) | Panel::Tall(chart) => Some(of_chart(chart)),
        Panel::Strip(strip) => Some(of_strip(strip)),
        Panel::Map(_) => None,
    }
}

fn of_chart(chart: &Chart) -> Value {
    let series: Vec<_> = chart
        .series
        .iter()
        .map(|series| {
            let mark = match series.mark {
                Mark::Band => "band",
                Mark::Dashed => "dashed",
                mark if mark_is_line(mark) => "line",
                _ => "dots",
            };
            json!({"name": series.name, "colour": series.colour, "mark": mark, "points": series.points})
        })
        .collect();
    json!({"x": chart.x.label, "y": chart.y.label, "series": series})
}

const fn mark_is_line(mark: Mark) -> bool {
    matches!(mark, Mark::Line | Mark::ShadedBelow | Mark::ShadedAbove)
}

fn of_strip(strip: &Strip) -> Value {
    json!({"x": strip.x.label, "states": strip.states, "stretches": strip.stretches})
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Series};

    #[test]
    fn a_name_does_not_end_the_script() {
        let chart = Chart {
            title: String::new(),
            x: Axis::linear("time (s)"),
            y: Axis::linear("load (N)"),
            series: vec![Series::new(
                "</script>",
                0,
                Mark::Line,
                vec![(0.0, 1.0), (1.0, f64::NAN)],
            )],
            notes: Vec::new(),
        };
        let page = zoomable("a < b", &[Panel::Chart(chart)]).unwrap();
        assert_eq!(page.matches("</script>").count(), 1);
        assert!(page.contains("<h1>a &lt; b</h1>"));
        assert!(page.contains("[1.0,null]"), "{page}");
    }
}
