//! Every instruction of a function that can be reached, with all that may follow it.

use std::collections::BTreeMap;

use super::code::{Code, Decoded, Function};
use super::flow::Flow;
use epas_page::failure::Failure;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Following {
    /// The next instruction within the function; none where it ends here.
    pub to: Option<u32>,
    /// A function that runs to its return in between.
    pub call: Option<u32>,
    /// Whether the next instruction executed is not the next one in memory.
    pub jumps: bool,
}

pub struct Step {
    pub decoded: Decoded,
    pub following: Vec<Following>,
    pub conditional: bool,
}

pub type Steps = BTreeMap<u32, Step>;

/// Follows a function from its first instruction on.
pub fn steps(code: &Code, function: &Function) -> Result<Steps, Failure> {
    let mut steps = Steps::new();
    // Addresses to follow, with the number of instructions there that may be passed over.
    let mut open = vec![(function.start, 0_u32)];
    while let Some((address, conditional)) = open.pop() {
        if steps.contains_key(&address) {
            continue;
        }
        let decoded = code.instruction(address)?;
        let skipped = match decoded.flow {
            Flow::Condition(count) => count,
            _ => conditional.saturating_sub(1),
        };
        let conditional = conditional > 0;
        let following = following(code, function, address, &decoded, conditional)?;
        open.extend(
            following
                .iter()
                .filter_map(|following| Some((following.to?, skipped))),
        );
        let step = Step {
            decoded,
            following,
            conditional,
        };
        steps.insert(address, step);
    }
    Ok(steps)
}

/// All that may follow an instruction, which may be passed over where that is `conditional`.
fn following(
    code: &Code,
    function: &Function,
    address: u32,
    decoded: &Decoded,
    conditional: bool,
) -> Result<Vec<Following>, Failure> {
    let next = address + decoded.cost.size;
    let inside = |address| (function.start..function.end).contains(&address);
    let on = Following {
        to: Some(next),
        call: None,
        jumps: false,
    };
    let to = |target: u32| Following {
        to: inside(target).then_some(target),
        call: (!inside(target)).then_some(target),
        jumps: target != next,
    };
    let out = Following {
        to: None,
        call: None,
        jumps: true,
    };
    let mut following = match decoded.flow {
        Flow::Next | Flow::Condition(_) => vec![on],
        Flow::Jump(target) => vec![to(target)],
        Flow::Branch(target) => vec![on, to(target)],
        Flow::Call(target) => vec![Following {
            call: Some(target),
            jumps: true,
            ..on
        }],
        Flow::Return => vec![out],
        Flow::Table(width) => table(code, address, width)?.into_iter().map(to).collect(),
        Flow::Trap => Vec::new(),
        Flow::Unknown => {
            return Err(Failure::Data(format!(
                "{} at {address:#x}: {:?} leads to an address that only the run knows",
                function.name, decoded.text
            )));
        }
    };
    if conditional {
        following.push(on);
    }
    following.sort_unstable();
    following.dedup();
    Ok(following)
}

/// Targets of the table behind a `tbb` or `tbh`, which ends where the first of them stands. One byte may fill it up.
fn table(code: &Code, address: u32, width: u32) -> Result<Vec<u32>, Failure> {
    let broken = || Failure::Data(format!("no end of the table at {address:#x}"));
    let start = address + 4;
    let mut targets = Vec::new();
    let mut end = u32::MAX;
    while start + width * (targets.len() as u32) < end {
        let entry = start + width * (targets.len() as u32);
        let bytes = code.bytes(entry).ok_or_else(broken)?;
        let target = match *bytes {
            [low, high, ..] if width == 2 => start + 2 * u32::from(u16::from_le_bytes([low, high])),
            [byte, ..] => start + 2 * u32::from(byte),
            [] => return Err(broken()),
        };
        if target <= entry {
            break;
        }
        end = end.min(target);
        targets.push(target);
    }
    Ok(targets)
}
