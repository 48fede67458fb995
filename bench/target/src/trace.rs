//! Instructions and cycles of single calls, from QEMU's log of every executed instruction.

use std::collections::HashMap;
use std::io::{self, BufRead};

use super::cycles::Instruction;
use super::watch::Watch;

/// What the calls of a function took.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Calls {
    /// Instructions and cycles of each call, from the function's first instruction to its return, with
    /// all that it calls.
    pub calls: Vec<(u32, u32)>,
}

impl Calls {
    /// Least and most of the instructions, then of the cycles.
    pub fn ranges(&self) -> Option<[(u32, u32); 2]> {
        let range = |value: fn(&(u32, u32)) -> u32| {
            let values = || self.calls.iter().map(value);
            Some((values().min()?, values().max()?))
        };
        Some([range(|call| call.0)?, range(|call| call.1)?])
    }
}

struct Open {
    function: usize,
    back: u32,
    instructions: u32,
    cycles: u32,
}

#[derive(Debug, Default)]
pub struct Counts {
    pub calls: Vec<Calls>,
    /// For each function what its calls have exceeded of its limits.
    pub broken: Vec<Vec<String>>,
}

/// Counts calls while a log is read.
pub struct Counter {
    instructions: HashMap<u32, Instruction>,
    entries: HashMap<u32, usize>,
    open: Option<Open>,
    last: Option<(u32, Instruction)>,
    counted: Vec<Calls>,
    watches: Vec<Watch>,
}

impl Counter {
    /// Counts the functions at these addresses, and holds them to limits where there are any.
    pub fn new(addresses: &[u32], watches: Vec<Watch>) -> Self {
        Self {
            instructions: HashMap::new(),
            entries: addresses
                .iter()
                .enumerate()
                .map(|(function, &address)| (address, function))
                .collect(),
            open: None,
            last: None,
            counted: vec![Calls::default(); addresses.len()],
            watches,
        }
    }

    /// Reads a log to its end; calls in the order of the addresses given.
    pub fn read(mut self, mut log: impl BufRead) -> io::Result<Counts> {
        let mut line = Vec::new();
        loop {
            line.clear();
            if log.read_until(b'\n', &mut line)? == 0 {
                let broken = self.watches.iter();
                return Ok(Counts {
                    calls: self.counted,
                    broken: broken
                        .map(|watch| watch.broken().map(str::to_owned).collect())
                        .collect(),
                });
            }
            if let Some(address) = executed(&line) {
                self.step(address);
            } else if let Some((address, instruction)) = disassembled(&line) {
                self.instructions.insert(address, instruction);
            }
        }
    }

    fn step(&mut self, address: u32) {
        // QEMU writes an instruction down before it asks whether anything else is due, and once more when
        // it comes back to it.
        if self.last.is_some_and(|(before, _)| before == address) {
            return;
        }
        let Some(&instruction) = self.instructions.get(&address) else {
            self.last = None;
            return;
        };
        if let Some((before, last)) = self.last {
            let jumps = address != before.wrapping_add(last.size);
            if let Some(open) = &mut self.open {
                open.instructions += 1;
                open.cycles += last.cycles(&instruction, jumps);
                if address == open.back {
                    self.counted[open.function]
                        .calls
                        .push((open.instructions, open.cycles));
                    self.open = None;
                }
            } else if last.call
                && let Some(&function) = self.entries.get(&address)
            {
                self.open = Some(Open {
                    function,
                    back: before.wrapping_add(last.size),
                    instructions: 0,
                    cycles: 0,
                });
            }
            if let Some(open) = &self.open
                && let Some(watch) = self.watches.get_mut(open.function)
            {
                watch.step(before, address);
            }
        }
        self.last = Some((address, instruction));
    }
}

/// The address in `Trace 0: 0x7f... [00800408/000042e0/00000110/ff020201] name`.
fn executed(line: &[u8]) -> Option<u32> {
    if !line.starts_with(b"Trace ") {
        return None;
    }
    let start = line.iter().position(|&byte| byte == b'[')?;
    let rest = line.get(start..)?;
    let slash = rest.iter().position(|&byte| byte == b'/')?;
    let digits = rest.get(slash + 1..)?;
    let end = digits.iter().position(|&byte| byte == b'/')?;
    hexadecimal(digits.get(..end)?)
}

/// The instruction in `0x000042e0:  b580       push     {r7, lr}`.
fn disassembled(line: &[u8]) -> Option<(u32, Instruction)> {
    let line = str::from_utf8(line.strip_prefix(b"0x")?).ok()?;
    let (address, rest) = line.split_once(':')?;
    let address = hexadecimal(address.as_bytes())?;
    let (first, rest) = word(rest);
    // Codes from 0b11101 on have two halves.
    let long = u32::from_str_radix(first, 16).ok()? >= 0xE800;
    let rest = if long { word(rest).1 } else { rest };
    let (mnemonic, operands) = word(rest);
    Some((
        address,
        Instruction::new(if long { 4 } else { 2 }, mnemonic, operands.trim()),
    ))
}

fn word(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    text.split_at(text.find(char::is_whitespace).unwrap_or(text.len()))
}

fn hexadecimal(digits: &[u8]) -> Option<u32> {
    digits.iter().try_fold(0_u32, |value, &digit| {
        let digit = char::from(digit).to_digit(16)?;
        Some((value << 4) | digit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A call of a function of four instructions, with a taken branch inside.
    const LOG: &str = "\
----------------
IN: main
0x00000100:  f000 f87e  bl       #0x200

Trace 0: 0x7f00 [00800408/00000100/00000110/ff020201] main
----------------
IN: function
0x00000200:  ee20 0a01  vmul.f32 s0, s0, s2

Trace 0: 0x7f01 [00800408/00000200/00000110/ff020201] function
0x00000204:  ee30 0a01  vadd.f32 s0, s0, s2
Trace 0: 0x7f02 [00800408/00000204/00000110/ff020201] function
0x00000208:  d001       beq      #0x20e
Trace 0: 0x7f03 [00800408/00000208/00000110/ff020201] function
0x0000020e:  4770       bx       lr
Trace 0: 0x7f04 [00800408/0000020e/00000110/ff020201] function
0x00000104:  bf00       nop
Trace 0: 0x7f05 [00800408/00000104/00000110/ff020201] main
";

    fn counted(address: u32, log: &[u8]) -> Vec<Calls> {
        Counter::new(&[address], Vec::new())
            .read(log)
            .unwrap()
            .calls
    }

    #[test]
    fn a_call_is_counted_to_its_return() {
        let calls = counted(0x200, LOG.as_bytes());
        // vmul 1 and one for its result used at once, vadd 1, taken branch 3, return 3.
        assert_eq!(calls[0].calls, [(4, 9)]);
        assert_eq!(calls[0].ranges(), Some([(4, 4), (9, 9)]));
    }

    #[test]
    fn an_instruction_written_down_twice_is_counted_once() {
        let line = "Trace 0: 0x7f02 [00800408/00000204/00000110/ff020201] function\n";
        let twice = LOG.replace(line, &line.repeat(2));
        assert_ne!(twice, LOG);
        let calls = counted(0x200, twice.as_bytes());
        assert_eq!(calls[0].calls, [(4, 9)]);
    }

    #[test]
    fn functions_that_are_never_called_have_no_range() {
        let calls = counted(0x300, LOG.as_bytes());
        assert_eq!(calls[0].ranges(), None);
    }
}
