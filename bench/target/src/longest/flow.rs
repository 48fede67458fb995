//! Where an instruction leads.

/// Where an instruction leads, taken by itself: within an `it` block it may be passed over too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// To the next one in memory.
    Next,
    /// To the next one; so many that follow are executed or passed over.
    Condition(u32),
    Jump(u32),
    /// To an address, or to the next one.
    Branch(u32),
    /// To the next one, through a function.
    Call(u32),
    Return,
    /// To one of the entries of a table behind it, of one byte or two each.
    Table(u32),
    /// To an address that only the run knows.
    Unknown,
    /// Nowhere: an instruction that no sound program reaches.
    Trap,
}

impl Flow {
    pub fn of(mnemonic: &str, operands: &str) -> Self {
        let name = mnemonic.split('.').next().unwrap_or(mnemonic);
        let target = operands.rsplit('#').next().and_then(|word| {
            let digits = word.trim().strip_prefix("0x");
            digits.map_or_else(
                || word.trim().parse().ok(),
                |digits| u32::from_str_radix(digits, 16).ok(),
            )
        });
        let to = |flow: fn(u32) -> Self| target.map_or(Self::Unknown, flow);
        match name {
            "udf" => Self::Trap,
            "b" => to(Self::Jump),
            "bl" => to(Self::Call),
            "cbz" | "cbnz" => to(Self::Branch),
            "blx" | "bxj" => Self::Unknown,
            "bx" => Self::returning(operands.trim() == "lr"),
            "tbb" => Self::Table(1),
            "tbh" => Self::Table(2),
            _ if name.starts_with("it") && name.bytes().all(|byte| b"ite".contains(&byte)) => {
                Self::Condition(name.len() as u32 - 1)
            }
            _ if CONDITIONS
                .iter()
                .any(|condition| name == format!("b{condition}")) =>
            {
                to(Self::Branch)
            }
            _ => Self::by_result(name, operands),
        }
    }

    /// An instruction that may compute the program counter.
    fn by_result(name: &str, operands: &str) -> Self {
        let (first, rest) = operands.split_once(',').unwrap_or((operands, ""));
        let compares = ["cmp", "cmn", "tst", "teq", "str", "push", "stm"];
        let list = operands.split_once('{').map(|(_, list)| list);
        let in_list = list.is_some_and(|list| list.contains("pc"));
        if compares.iter().any(|other| name.starts_with(other)) {
            Self::Next
        } else if in_list {
            Self::returning(name.starts_with("pop") || operands.trim().starts_with("sp!"))
        } else if first.trim() == "pc" {
            let popped = name.starts_with("ldr") && rest.trim() == "[sp], #4";
            Self::returning(popped || name == "mov" && rest.trim() == "lr")
        } else {
            Self::Next
        }
    }

    fn returning(returns: bool) -> Self {
        if returns { Self::Return } else { Self::Unknown }
    }
}

/// What a conditional branch has behind its `b`.
const CONDITIONS: [&str; 16] = [
    "eq", "ne", "hs", "cs", "lo", "cc", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_out_of_an_instruction_is_known() {
        assert_eq!(Flow::of("b", "#0x120"), Flow::Jump(0x120));
        assert_eq!(Flow::of("b.w", "#0x120"), Flow::Jump(0x120));
        assert_eq!(Flow::of("bhi.w", "#0x120"), Flow::Branch(0x120));
        assert_eq!(Flow::of("bls", "#8"), Flow::Branch(8));
        assert_eq!(Flow::of("cbnz", "r0, #0x12"), Flow::Branch(0x12));
        assert_eq!(Flow::of("bl", "#0x4000"), Flow::Call(0x4000));
        assert_eq!(Flow::of("bx", "lr"), Flow::Return);
        assert_eq!(Flow::of("pop.w", "{r4, r5, pc}"), Flow::Return);
        assert_eq!(Flow::of("pop", "{r4, r5}"), Flow::Next);
        assert_eq!(Flow::of("ldr", "pc, [sp], #4"), Flow::Return);
        assert_eq!(Flow::of("mov", "pc, lr"), Flow::Return);
        assert_eq!(Flow::of("itte", "ne"), Flow::Condition(3));
        assert_eq!(Flow::of("tbh", "[pc, r0, lsl #1]"), Flow::Table(2));
        assert_eq!(Flow::of("udf", "#0xfe"), Flow::Trap);
        for data in [
            ("bic", "r0, r1, #4"),
            ("bfi", "r0, r1, #4, #2"),
            ("ldr", "r0, [pc, #8]"),
            ("add", "r0, pc, #4"),
            ("str", "r0, [r1]"),
            ("vmov.f32", "s0, s1"),
            ("vldr", "s0, [pc, #8]"),
        ] {
            assert_eq!(Flow::of(data.0, data.1), Flow::Next, "{data:?}");
        }
    }

    #[test]
    fn what_only_the_run_knows_is_no_way() {
        assert_eq!(Flow::of("blx", "r3"), Flow::Unknown);
        assert_eq!(Flow::of("bx", "r3"), Flow::Unknown);
        assert_eq!(Flow::of("mov", "pc, r3"), Flow::Unknown);
        assert_eq!(Flow::of("ldr", "pc, [r3]"), Flow::Unknown);
        assert_eq!(Flow::of("ldm", "r3, {r4, pc}"), Flow::Unknown);
        assert_eq!(Flow::of("add", "pc, r3"), Flow::Unknown);
    }
}
