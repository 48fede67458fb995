//! The few words of GDB's remote protocol that the emulator is steered with.

use std::io::{Error, Read, Result, Write};

/// An emulator that waits for a debugger.
pub struct Debugger<W, R> {
    to: W,
    answers: R,
}

impl<W: Write, R: Read> Debugger<W, R> {
    pub fn new(to: W, answers: R) -> Self {
        Self { to, answers }
    }

    /// Lets the processor run until it comes to an address in Thumb code.
    pub fn run_to(&mut self, address: u32) -> Result<()> {
        let place = format!("0,{:x},2", address & !1);
        self.done(&format!("Z{place}"))?;
        let stopped = self.ask("c")?;
        if !stopped.starts_with('T') {
            return Err(Error::other(format!("it did not stop: {stopped}")));
        }
        self.done(&format!("z{place}"))
    }

    /// Gives a command to the emulator's monitor.
    pub fn monitor(&mut self, command: &str) -> Result<()> {
        let words = command.bytes().fold("qRcmd,".to_string(), |words, byte| {
            words + &format!("{byte:02x}")
        });
        let mut answer = self.ask(&words)?;
        // What the monitor writes comes before its result.
        while answer.starts_with('O') && answer != "OK" {
            answer = self.answer()?;
        }
        fine(&answer)
    }

    pub fn detach(&mut self) -> Result<()> {
        self.done("D")
    }

    fn done(&mut self, command: &str) -> Result<()> {
        fine(&self.ask(command)?)
    }

    fn ask(&mut self, command: &str) -> Result<String> {
        let sum = command.bytes().fold(0u8, u8::wrapping_add);
        write!(self.to, "${command}#{sum:02x}")?;
        self.to.flush()?;
        self.answer()
    }

    /// The next packet, `$...#` and two digits, which is acknowledged.
    fn answer(&mut self) -> Result<String> {
        while self.byte()? != b'$' {}
        let mut answer = String::new();
        loop {
            match self.byte()? {
                b'#' => break,
                byte => answer.push(byte.into()),
            }
        }
        self.byte()?;
        self.byte()?;
        self.to.write_all(b"+")?;
        self.to.flush()?;
        Ok(answer)
    }

    fn byte(&mut self) -> Result<u8> {
        let mut byte = [0];
        self.answers.read_exact(&mut byte)?;
        let [byte] = byte;
        Ok(byte)
    }
}

fn fine(answer: &str) -> Result<()> {
    if answer == "OK" {
        return Ok(());
    }
    Err(Error::other(format!("it answered {answer}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_to_an_address_and_logs() {
        let answers = b"+$OK#9a+$T05thread:01;#07+$OK#9a+$O6f6b#00$OK#9a+$OK#9a";
        let mut said = Vec::new();
        let mut debugger = Debugger::new(&mut said, &answers[..]);
        debugger.run_to(0x1235).unwrap();
        debugger.monitor("log").unwrap();
        debugger.detach().unwrap();
        let said = String::from_utf8(said).unwrap();
        assert_eq!(
            said,
            "$Z0,1234,2#de+$c#63+$z0,1234,2#fe+$qRcmd,6c6f67#c5++$D#44+"
        );
    }

    #[test]
    fn refusals_and_early_ends_are_errors() {
        for answers in ["", "+$E01#a6", "+$OK#9a+$W00#b7", "+$OK#9a+"] {
            let mut debugger = Debugger::new(Vec::new(), answers.as_bytes());
            assert!(debugger.run_to(0x1000).is_err(), "{answers}");
        }
    }
}
