//! Pictures inside a page: colours follow the page's scheme, light or dark.

use super::style::PALETTE;

/// Colours of a picture that are a page's to choose, with the names that the page has for them.
const NAMED: [(&str, &str); 3] = [("#282828", "ink"), ("#DEDEDE", "grid"), ("#787878", "axis")];

/// An SVG picture for a page: no background, and the colours of text, grid, axes and series as variables of the page: `--ink`,
/// `--grid`, `--axis`, `--series-0` to `--series-6`. Colours of maps stay.
pub fn themed(svg: &str) -> String {
    let mut text = without_background(svg);
    for (colour, name) in NAMED {
        text = named(&text, colour, name);
    }
    for (index, colour) in PALETTE.iter().enumerate() {
        let written = format!("#{:02X}{:02X}{:02X}", colour.0, colour.1, colour.2);
        text = named(&text, &written, &format!("series-{index}"));
    }
    text
}

fn named(text: &str, colour: &str, name: &str) -> String {
    let of = |what: &str| {
        (
            format!("{what}=\"{colour}\""),
            format!("{what}=\"var(--{name})\""),
        )
    };
    let (fill, stroke) = (of("fill"), of("stroke"));
    text.replace(&fill.0, &fill.1).replace(&stroke.0, &stroke.1)
}

/// The first rectangle is the background.
fn without_background(svg: &str) -> String {
    let Some((before, rest)) = svg.split_once("<rect ") else {
        return svg.into();
    };
    match rest.split_once("/>") {
        Some((first, after)) if first.contains("#FFFFFF") => format!("{before}{after}"),
        _ => svg.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_chooses_the_colours_but_those_of_maps() {
        let svg = concat!(
            "<svg><rect x=\"0\" fill=\"#FFFFFF\"/><text fill=\"#282828\"/>",
            "<line stroke=\"#D55E00\"/><rect fill=\"#00224E\"/></svg>"
        );
        let page = concat!(
            "<svg><text fill=\"var(--ink)\"/>",
            "<line stroke=\"var(--series-1)\"/><rect fill=\"#00224E\"/></svg>"
        );
        assert_eq!(themed(svg), page);
    }
}
