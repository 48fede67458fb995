//! The documentation of a unit, `documentation/index.html`: what it is, for which platforms it has a library, and how it gets another one.

use quick_xml::escape::escape;

use super::description::Version;
use super::library::{platform, platforms};
use super::unit::Unit;

pub fn documentation(unit: &Unit, version: Version, place: &str) -> String {
    let scene = unit.stored.scene;
    let design = escape(unit.stored.design.as_str());
    let fmi = match version {
        Version::Two => "2.0",
        Version::Three => "3.0",
    };
    let number = match version {
        Version::Two => "2",
        Version::Three => "3",
    };
    let known = platforms(version).map(|(folder, system)| {
        format!("<tr><td><code>binaries/{folder}</code></td><td>{system}</td></tr>")
    });
    let known: String = known.collect();
    let (name, about, token) = (scene.name(), scene.about(), escape(unit.token()));
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "<!DOCTYPE html>
<html lang=\"en\"><head><meta charset=\"utf-8\"><title>epas-friction {name}</title></head><body>
<h1>Friction of a {about}</h1>
<p>Scene <code>{name}</code>, design {design}, FMI {fmi} for co-simulation, epas {version}. Variables have units and ranges in <code>modelDescription.xml</code>; the end of the
initialisation checks parameters.</p>
<h2>Platforms</h2>
<p>This unit holds a library for {platform}: <code>{place}</code>. It needs nothing but the system's C library.</p>
<p>To add another platform, build the same unit there, with the same version of epas and the same design file:</p>
<pre>epas fmu --scene {name} --design DESIGN --fmi {number} --output other.fmu</pre>
<p>and copy the folder below <code>binaries/</code> of that file, which is a zip archive, into this one. Both units have the same token, <code>{token}</code>, in
<code>modelDescription.xml</code>; a library of another version refuses the unit by it. Names of FMI {fmi}:</p>
<table>{known}</table>
</body></html>
",
        platform = platform(),
    )
}
