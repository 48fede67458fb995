//! What an instruction costs on a Cortex-M4F.
//!
//! Source of all numbers: Arm, "Cortex-M4 Technical Reference Manual", DDI 0439D, tables 3-1 (processor
//! instructions) and 7-1 (floating-point unit). A model: no wait states of the flash, no divisions that
//! end early, no stores that wait for the bus, no pairs of loads that overlap. A core in silicon differs by
//! what its memory adds; the ranking of two functions does not.

/// Cycles that refilling the pipeline takes: the manual's `P`, 1 to 3, as found for most branches.
const REFILL: u32 = 2;

/// A division: the manual says 2 to 12, and it depends on the operands.
const INTEGER_DIVISION: u32 = 12;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    pub size: u32,
    /// Cycles when the next instruction in memory follows.
    cycles: u32,
    taken: u32,
    pub call: bool,
    /// Single-precision registers that it computes, a bit each.
    result: u32,
    operands: u32,
}

impl Instruction {
    pub fn new(size: u32, mnemonic: &str, operands: &str) -> Self {
        let name = mnemonic.split('.').next().unwrap_or(mnemonic);
        let double = mnemonic
            .rsplit_once('.')
            .is_some_and(|(_, kind)| kind == "64" || kind == "f64");
        let listed = listed_registers(operands);
        let starts = |prefixes: &[&str]| prefixes.iter().any(|prefix| name.starts_with(prefix));

        let branch = is_branch(name);
        let cycles = if starts(&["vdiv", "vsqrt"]) {
            14
        } else if starts(&["vnmul"]) {
            1
        } else if starts(&["vfma", "vfms", "vfnm", "vmla", "vmls", "vnml"]) {
            3
        } else if starts(&["vldm", "vstm", "vpush", "vpop"]) {
            1 + listed
        } else if starts(&["vldr", "vstr"]) {
            if double || operands.trim_start().starts_with('d') {
                3
            } else {
                2
            }
        } else if starts(&["vmov"]) {
            // Two core registers to or from two others: one each.
            if operands.matches(',').count() >= 2 {
                2
            } else {
                1
            }
        } else if starts(&["push", "pop", "ldm", "stm"]) {
            1 + listed
        } else if starts(&["ldrd", "strd"]) {
            3
        } else if starts(&["ldr"]) {
            2
        } else if starts(&["sdiv", "udiv"]) {
            INTEGER_DIVISION
        } else if starts(&["tbb", "tbh"]) {
            2
        } else {
            1
        };
        let always = matches!(name, "bl" | "blx" | "bx" | "tbb" | "tbh");
        let (result, read) = floating_registers(name, operands);
        Self {
            size,
            cycles: if always { cycles + REFILL } else { cycles },
            // A load into the program counter jumps as well.
            taken: if always { 0 } else { REFILL },
            call: branch && matches!(name, "bl" | "blx"),
            result,
            operands: read,
        }
    }

    /// Cycles, with the instruction that is executed next and whether it is the next one in memory.
    pub fn cycles(&self, next: &Self, jumps: bool) -> u32 {
        let waits = u32::from(self.result & next.operands != 0);
        self.cycles + if jumps { self.taken } else { 0 } + waits
    }
}

fn is_branch(name: &str) -> bool {
    name.starts_with('b') && !name.starts_with("bf") && !name.starts_with("bic") && name != "bkpt"
        || name.starts_with("cb")
        || name.starts_with("tb")
}

/// Registers in a list in braces, doubles twice.
fn listed_registers(operands: &str) -> u32 {
    let Some(list) = operands
        .split_once('{')
        .and_then(|(_, rest)| rest.split_once('}'))
    else {
        return 0;
    };
    list.0
        .split(',')
        .map(|entry| {
            let entry = entry.trim();
            let width = if entry.starts_with('d') { 2 } else { 1 };
            let number = |name: &str| -> Option<u32> {
                name.trim()
                    .trim_start_matches(|letter: char| letter.is_ascii_alphabetic())
                    .parse()
                    .ok()
            };
            let count = entry
                .split_once('-')
                .and_then(|(from, to)| Some(number(to)? - number(from)? + 1))
                .unwrap_or(1);
            width * count
        })
        .sum()
}

/// What an instruction of the floating-point unit computes, and what it reads.
fn floating_registers(name: &str, operands: &str) -> (u32, u32) {
    if !name.starts_with('v') {
        return (0, 0);
    }
    let registers: Vec<u32> = operands
        .split(|letter: char| !letter.is_ascii_alphanumeric())
        .filter_map(register)
        .collect();
    let all = |list: &[u32]| list.iter().fold(0, |bits, register| bits | register);
    let only_reads = ["vstr", "vstm", "vpush", "vcmp"];
    let only_loads = ["vldr", "vldm", "vpop", "vmrs"];
    if only_reads.iter().any(|prefix| name.starts_with(prefix)) {
        (0, all(&registers))
    } else if only_loads.iter().any(|prefix| name.starts_with(prefix)) {
        (0, 0)
    } else {
        match registers.as_slice() {
            // From a floating-point register to a core register: the only operand is read.
            [only] if name.starts_with("vmov") && operands.trim_start().starts_with('r') => {
                (0, *only)
            }
            [result, rest @ ..] => {
                // Accumulating instructions read what they add to.
                let accumulates = ["vfma", "vfms", "vfnm", "vmla", "vmls", "vnml"]
                    .iter()
                    .any(|prefix| name.starts_with(prefix));
                let own = if accumulates { *result } else { 0 };
                (*result, all(rest) | own)
            }
            [] => (0, 0),
        }
    }
}

/// The bits of `s3` or `d1`.
fn register(name: &str) -> Option<u32> {
    let (kind, number) = name.split_at_checked(1)?;
    let number: u32 = number.parse().ok()?;
    match kind {
        "s" if number < 32 => Some(1 << number),
        "d" if number < 16 => Some(3 << (2 * number)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cycles(mnemonic: &str, operands: &str) -> u32 {
        let next = Instruction::new(2, "nop", "");
        Instruction::new(4, mnemonic, operands).cycles(&next, false)
    }

    #[test]
    fn costs_are_those_of_the_manual() {
        assert_eq!(cycles("vmul.f32", "s0, s1, s2"), 1);
        assert_eq!(cycles("vnmul.f32", "s0, s1, s2"), 1);
        assert_eq!(cycles("vfma.f32", "s0, s1, s2"), 3);
        assert_eq!(cycles("vdiv.f32", "s0, s1, s2"), 14);
        assert_eq!(cycles("vsqrt.f32", "s0, s1"), 14);
        assert_eq!(cycles("vldr", "s0, [r0, #4]"), 2);
        assert_eq!(cycles("vldr", "d0, [r0]"), 3);
        assert_eq!(cycles("vpush", "{d8, d9}"), 5);
        assert_eq!(cycles("vldmia", "r0!, {s2-s5}"), 5);
        assert_eq!(cycles("vmov", "r0, r1, d2"), 2);
        assert_eq!(cycles("vmov", "r0, s2"), 1);
        assert_eq!(cycles("push", "{r4-r7, lr}"), 6);
        assert_eq!(cycles("ldr.w", "r0, [r1]"), 2);
        assert_eq!(cycles("str", "r0, [r1]"), 1);
        assert_eq!(cycles("adds", "r0, #1"), 1);
    }

    #[test]
    fn jumps_refill_the_pipeline() {
        let next = Instruction::new(2, "nop", "");
        let taken =
            |mnemonic, operands| Instruction::new(2, mnemonic, operands).cycles(&next, true);
        assert_eq!(taken("bne", "#0x100"), 3);
        assert_eq!(taken("bl", "#0x100"), 3);
        assert_eq!(taken("bx", "lr"), 3);
        assert_eq!(taken("pop", "{r7, pc}"), 5);
        assert_eq!(cycles("bne", "#0x100"), 1);
        assert_eq!(cycles("bics", "r0, r1"), 1);
    }

    /// "+1 when the next instruction uses a floating-point result."
    #[test]
    fn a_result_used_at_once_is_waited_for() {
        let product = Instruction::new(4, "vmul.f32", "s4, s1, s2");
        let using = Instruction::new(4, "vadd.f32", "s0, s0, s4");
        let storing = Instruction::new(4, "vstr", "s4, [r0]");
        let other = Instruction::new(4, "vadd.f32", "s0, s0, s5");
        assert_eq!(product.cycles(&using, false), 2);
        assert_eq!(product.cycles(&storing, false), 2);
        assert_eq!(product.cycles(&other, false), 1);
        let loaded = Instruction::new(4, "vldr", "s4, [r0]");
        assert_eq!(loaded.cycles(&using, false), 2);
    }
}
