//! What a run on the target finds: figures of functions and scenes, and what holds of the images.

use serde::{Deserialize, Serialize};

use epas_page::failure::Failure;

/// What a run found.
// Each says by itself whether something holds.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Functions of the crate, then what others offer.
    pub functions: Vec<FunctionFigures>,
    /// Scenes.
    pub scenes: Vec<SceneFigures>,
    /// The program that computes nothing.
    pub empty: SceneFigures,
    /// Whether every image links without any way to the panic handler.
    pub panic_free: bool,
    /// Whether any image of the crate's own holds arithmetic in double precision by software.
    pub soft_double: bool,
    /// Whether every result on the target has the bits of the host's.
    pub equal_to_host: bool,
    /// Whether each scene alone gives what it gives among all the others.
    pub scenes_equal: bool,
    /// Names that no image may hold and one does: an allocator, formatting.
    pub unwanted: Vec<String>,
    /// Functions that can call themselves, directly or through others.
    pub recursive: Vec<String>,
    /// Code of the crate in the image of a scene that leaves it out, inlined code included.
    pub out_of_place: Vec<String>,
    /// Limits of loops that a counted call has exceeded: then a longest path may be too short.
    #[serde(default)]
    pub broken_limits: Vec<String>,
}

/// What a function takes, from its first instruction to its return.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FunctionFigures {
    /// Its name.
    pub name: String,
    /// Least and most instructions over the inputs, on a Cortex-M4F.
    pub instructions_min: u32,
    /// See above.
    pub instructions_max: u32,
    /// Least and most cycles over the inputs, by Arm's table for the Cortex-M4F.
    pub cycles_min: u32,
    /// See above.
    pub cycles_max: u32,
    /// Cycles of the longest path in the image, whatever the inputs; none where loops have no bound.
    #[serde(default)]
    pub longest: Option<u32>,
    /// Why there is no longest path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_longest: Option<String>,
    /// Most cycles of the same function built for size.
    pub cycles_max_small: u32,
    /// Most instructions of the same function built for a Cortex-M7.
    pub instructions_max_cortex_m7: u32,
    /// How many inputs.
    pub inputs: u32,
}

/// What a scene takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneFigures {
    /// Its name.
    pub name: String,
    /// Bytes of flash of its whole image.
    pub flash: u64,
    /// Bytes of flash more than the program that computes nothing.
    pub flash_beyond_empty: u64,
    /// Bytes of memory, the stack not counted.
    pub ram: u64,
    /// Bytes of stack of a tick, at most.
    pub stack: u64,
    /// Bytes of stack of the set-up.
    pub stack_set_up: u64,
    /// Bytes of flash of its whole image built for size.
    pub flash_small: u64,
    /// Bytes of stack of a tick, at most, built for size.
    pub stack_small: u64,
}

impl Figures {
    /// A function by its name.
    pub fn function(&self, name: &str) -> Option<&FunctionFigures> {
        self.functions.iter().find(|entry| entry.name == name)
    }

    /// A scene by its name.
    pub fn scene(&self, name: &str) -> Option<&SceneFigures> {
        self.scenes.iter().find(|entry| entry.name == name)
    }

    /// Counts above the longest path, and limits of longest paths that a counted call exceeds.
    fn beyond_longest(&self) -> Vec<String> {
        let above = self.functions.iter().filter_map(|entry| {
            let longest = entry
                .longest
                .filter(|&longest| entry.cycles_max > longest)?;
            let (name, counted) = (&entry.name, entry.cycles_max);
            Some(format!(
                "{name}: {counted} cycles counted, {longest} on the longest path"
            ))
        });
        let broken = self.broken_limits.iter().cloned();
        above.chain(broken).collect()
    }

    /// What has to hold of the images: whether it does, what it is, and what to say where it does not.
    fn conditions(&self) -> [(bool, &'static str, String); 8] {
        let beyond = self.beyond_longest();
        let none = |what: &'static str, wrong: &str, names: &[String]| {
            (
                names.is_empty(),
                what,
                format!("{wrong}: {}", names.join(", ")),
            )
        };
        [
            (
                self.equal_to_host,
                "results equal to the host's bit for bit",
                "results on the target differ from the host's".into(),
            ),
            (
                self.panic_free,
                "no way to a panic",
                "a way to the panic handler is left".into(),
            ),
            (
                !self.soft_double,
                "no double precision by software",
                "double precision by software is linked".into(),
            ),
            (
                self.scenes_equal,
                "scenes alone equal to all in one",
                "a scene gives other numbers alone than among the others".into(),
            ),
            none(
                "no allocator, no formatting",
                "unwanted in an image",
                &self.unwanted,
            ),
            none("no recursion", "recursive", &self.recursive),
            none(
                "every scene without what it leaves out",
                "not left out",
                &self.out_of_place,
            ),
            none(
                "no count above the longest path nor its limits",
                "beyond the longest path",
                &beyond,
            ),
        ]
    }

    /// What holds of the images, a line each.
    pub fn proofs(&self) -> String {
        let yes = |yes: bool| if yes { "yes" } else { "NO" };
        self.conditions()
            .map(|(holds, what, _)| format!("{what}: {}", yes(holds)))
            .join("\n")
    }

    /// Fails where something does not hold that must hold whatever it costs.
    pub fn require(&self) -> Result<(), Failure> {
        let broken = self.conditions().into_iter().filter(|(holds, ..)| !holds);
        let broken: Vec<String> = broken.map(|(_, _, wrong)| wrong).collect();
        if broken.is_empty() {
            Ok(())
        } else {
            Err(Failure::Data(broken.join("\n")))
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::counts::stored;
    use epas_page::failure::Failure;

    #[test]
    fn a_count_above_the_longest_path_fails() {
        let stored = stored().unwrap();
        stored.require().unwrap();
        let mut figures = stored.clone();
        figures.functions[0].longest = Some(figures.functions[0].cycles_max - 1);
        let Err(Failure::Data(message)) = figures.require() else {
            panic!("a count above the longest path passes");
        };
        assert!(message.contains("curvature_literature"), "{message}");
        let mut figures = stored;
        figures.broken_limits.push("turns of a loop".into());
        assert!(figures.require().is_err());
    }

    #[test]
    fn accuracy_page_says_how_long_the_longest_paths_are() {
        let figures = stored().unwrap();
        let of = |name: &str| {
            let entry = figures.function(name).unwrap();
            let longest = entry.longest.unwrap();
            (longest, f64::from(longest) / f64::from(entry.cycles_max))
        };
        let page = include_str!("../../accuracy.md").replace('\n', " ");
        let caged = figures.functions.iter().map(|entry| entry.name.as_str());
        let caged = caged.filter(|name| name.starts_with("step_caged") || *name == "between_caged");
        let most = caged.map(|name| of(name).1).fold(0.0, f64::max);
        let (balls, linear) = (of("step_train_37_pressing"), of("step_linear"));
        let thousands = |cycles: u32| format!("{},{:03}", cycles / 1000, cycles % 1000);
        for said in [
            format!("caged steps at most {most:.2} times"),
            format!(
                "37 balls {} cycles ({:.1} times)",
                thousands(balls.0),
                balls.1
            ),
            format!(
                "linear bearing {} ({:.1} times)",
                thousands(linear.0),
                linear.1
            ),
        ] {
            assert!(page.contains(&said), "{said}");
        }
    }
}
