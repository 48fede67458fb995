//! The images of scenes, and which modules of the crate stand in them.

/// What a scene with a cage leaves out.
const BUT_CAGED: [&str; 14] = [
    "contact",
    "hertz",
    "curvature",
    "efficiency",
    "kinematics",
    "train",
    "ball::pressed",
    "ball::linear",
    "ball::screw",
    "law",
    "scene::closed_form",
    "scene::circuit",
    "scene::linear",
    "scene::uncaged",
];

/// Scenes, each with an image of its own, a module of the crate that it has, and those that it leaves out.
///
/// Whatever runs once is folded by the compiler: an image has of a module what its step calls.
pub const SCENES: [(&str, &str, &[&str]); 9] = [
    (
        "curvature",
        "curvature",
        &[
            "contact",
            "train",
            "ball",
            "efficiency",
            "kinematics",
            "scene",
            "model",
        ],
    ),
    (
        "efficiency",
        "efficiency",
        &[
            "curvature",
            "hertz",
            "contact",
            "train",
            "ball",
            "kinematics",
            "scene",
            "model",
        ],
    ),
    ("caged_ball_screw", "scene::caged", &BUT_CAGED),
    ("caged_from_page", "scene::caged", &BUT_CAGED),
    (
        "caged_with_memory",
        "scene::memory",
        &[
            "contact",
            "hertz",
            "curvature",
            "efficiency",
            "kinematics",
            "train",
            "ball::pressed",
            "ball::linear",
            "ball::screw",
            "scene::closed_form",
            "scene::circuit",
            "scene::linear",
            "scene::uncaged",
        ],
    ),
    (
        "linear_bearing",
        "train",
        &[
            "geometry::ball_screw",
            "curvature",
            "contact::across",
            "ball::pressed",
            "ball::screw",
            "efficiency",
            "kinematics",
            "law",
            "scene::closed_form",
            "scene::uncaged",
        ],
    ),
    (
        "ball_screw_37",
        "train",
        &[
            "hertz",
            "contact",
            "geometry::linear_bearing",
            "ball::linear",
            "ball::screw",
            "efficiency",
            "kinematics",
            "law",
            "scene::closed_form",
            "scene::linear",
        ],
    ),
    (
        "ball_screw_37_with_memory",
        "scene::memory",
        &[
            "hertz",
            "contact",
            "geometry::linear_bearing",
            "ball::linear",
            "ball::screw",
            "efficiency",
            "kinematics",
            "scene::closed_form",
            "scene::linear",
        ],
    ),
    ("everything", "train", &["kinematics"]),
];

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// What is counted is what the README prints.
    #[test]
    fn the_readmes_example_is_the_one_that_is_counted() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
        let counted = read("bench/firmware/src/from_page.rs");
        let (_, code) = counted.split_once("\n\n").unwrap();
        assert!(code.contains("pub fn set_up"), "{code}");
        assert!(read("README.md").contains(&format!("```rust\n{code}```")));
    }

    /// Or nothing would be found of a module that was renamed, and a scene would seem to leave it out.
    #[test]
    fn every_module_stands_in_the_crate() {
        let crate_root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src");
        for (scene, has, left_out) in SCENES {
            for module in left_out.iter().chain([&has]) {
                let path = crate_root.join(format!("{}.rs", module.replace("::", "/")));
                assert!(path.is_file(), "{scene}: {module}");
            }
        }
    }
}
