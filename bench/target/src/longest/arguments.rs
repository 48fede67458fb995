//! Constant arguments of calls.

use std::collections::BTreeMap;

use super::steps::{Step, Steps};

/// What a register holds where a function is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    Constant(u32),
    /// What it held when the function that calls was called.
    Inherited,
    /// What only the run knows.
    Unknown,
}

/// What a register holds when the instruction at an address is reached: backwards, as long as one instruction alone can come
/// before.
pub fn argument(steps: &Steps, address: u32, register: &str) -> Argument {
    let mut before: BTreeMap<u32, Vec<(u32, &Step)>> = BTreeMap::new();
    for (&from, step) in steps {
        for next in step.following.iter().filter_map(|following| following.to) {
            before.entry(next).or_default().push((from, step));
        }
    }
    let mut address = address;
    for _ in 0..steps.len() {
        let (from, step) = match before.get(&address).map(Vec::as_slice) {
            None => return Argument::Inherited,
            Some([(from, step)]) => (*from, *step),
            Some(_) => return Argument::Unknown,
        };
        let calls = step
            .following
            .iter()
            .any(|following| following.call.is_some());
        match written(&step.decoded.text, register) {
            Some(_) if step.conditional => return Argument::Unknown,
            Some(argument) => return argument,
            None if calls => return Argument::Unknown,
            None => address = from,
        }
    }
    Argument::Unknown
}

/// What an instruction leaves in a register that it may write.
fn written(text: &str, register: &str) -> Option<Argument> {
    let (mnemonic, operands) = text.split_once(' ').unwrap_or((text, ""));
    let mut words = operands.split(|letter: char| !letter.is_ascii_alphanumeric());
    let first = words.next() == Some(register);
    if !first && !words.any(|word| word == register) {
        return None;
    }
    let name = mnemonic.split('.').next().unwrap_or(mnemonic);
    let reads = [
        "str", "stm", "push", "cmp", "cmn", "tst", "teq", "cb", "vstr", "vstm",
    ];
    // What writes its address register back writes behind the first operand.
    let behind = ["ldrd", "ldm", "pop", "vmov"];
    let back = operands.contains('!') || operands.contains("],");
    let only_reads = reads.iter().any(|other| name.starts_with(other)) && !back;
    let later = !first && !back && !behind.iter().any(|other| name.starts_with(other));
    if only_reads || later {
        return None;
    }
    let constant = operands.rsplit_once('#').and_then(|(before, digits)| {
        let moves = ["mov", "movs", "movw"].contains(&name);
        let alone = before.trim_end_matches([' ', ',']) == register;
        (moves && alone).then(|| match digits.strip_prefix("0x") {
            Some(digits) => u32::from_str_radix(digits, 16).ok(),
            None => digits.parse().ok(),
        })?
    });
    Some(constant.map_or(Argument::Unknown, Argument::Constant))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_move_of_a_number_leaves_a_number() {
        assert_eq!(
            written("movs r2, #0x24", "r2"),
            Some(Argument::Constant(36))
        );
        assert_eq!(
            written("mov.w r1, #288", "r1"),
            Some(Argument::Constant(288))
        );
        assert_eq!(written("add.w r2, r2, #4", "r2"), Some(Argument::Unknown));
        assert_eq!(written("ldr r1, [r2], #4", "r2"), Some(Argument::Unknown));
        assert_eq!(written("ldrd r1, r2, [r0]", "r2"), Some(Argument::Unknown));
        assert_eq!(written("add.w r0, r2, r3", "r2"), None);
        assert_eq!(written("str r2, [r3]", "r2"), None);
        assert_eq!(written("vmul.f32 s0, s1, s2", "r2"), None);
    }
}
