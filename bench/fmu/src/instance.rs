//! A unit while a simulation has it.

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use epas_cli::fmu::{Causality, Moment, RESOURCE, Running, Stored, Unit, Variable};

use crate::flags::Flags;
use crate::kinds::Phase;
pub use crate::kinds::Wanted;
use crate::outcome::Told;
use crate::state::Snapshot;

/// What a call may say beside its success.
pub type Said = Result<Option<Told>, String>;

/// The flag of accuracy alone: nothing is wrong with the inputs.
const ACCURACY: u32 = epas_cli::fmu::ACCURACY;

/// Most ticks of one communication step.
const MOST_TICKS: f64 = 1e7;

/// How far a step may be from a whole number of ticks, over the step, and a communication point from the end of the last step: texts
/// of times in traces are rounded.
const ROUNDING: f64 = 1e-6;

/// A unit while a simulation has it.
pub struct Instance {
    unit: Arc<Unit>,
    token: u32,
    phase: Phase,
    values: Vec<f64>,
    running: Option<Box<dyn Running>>,
    flags: Flags,
    states: HashMap<usize, Vec<u8>>,
}

/// Units by the text of their resource: tables of a design are read once in a process.
static UNITS: LazyLock<Mutex<HashMap<String, Arc<Unit>>>> = LazyLock::new(Mutex::default);

fn unit(resources: &Path) -> Result<Arc<Unit>, String> {
    let path = resources.join(RESOURCE);
    let text = std::fs::read_to_string(&path).map_err(|error| {
        format!(
            "the unit's resource {} cannot be read: {error}",
            path.display()
        )
    })?;
    let mut units = UNITS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = units.get(&text) {
        return Ok(known.clone());
    }
    let stored: Stored =
        toml::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    let unit = Arc::new(Unit::restored(&stored)?);
    units.insert(text, unit.clone());
    Ok(unit)
}

impl Instance {
    /// A new instance of the unit whose resources stand in a folder.
    pub fn new(resources: &Path, token: &str) -> Result<Self, String> {
        let unit = unit(resources)?;
        let own = unit.token();
        if own != token {
            return Err(format!(
                "the token {token:?} is not the unit's, which is {own:?}"
            ));
        }
        let values = unit.starts();
        Ok(Self {
            token: crc32fast::hash(own.as_bytes()),
            unit,
            phase: Phase::Instantiated,
            values,
            running: None,
            flags: Flags::default(),
            states: HashMap::new(),
        })
    }

    fn refuse_unless(&self, call: &str, allowed: &[Phase]) -> Result<(), String> {
        if allowed.contains(&self.phase) {
            return Ok(());
        }
        let names: Vec<_> = allowed.iter().map(|phase| phase.name()).collect();
        Err(format!(
            "{call} is called {}; allowed: {}",
            self.phase.name(),
            names.join(", ")
        ))
    }

    /// Sets the time at which a simulation starts, s.
    pub fn start_at(&mut self, call: &str, time: f64) -> Result<(), String> {
        self.refuse_unless(call, &[Phase::Instantiated])?;
        if !time.is_finite() {
            return Err(format!(
                "startTime = {time} is out of range; allowed: finite numbers"
            ));
        }
        if let Some(own) = self.values.first_mut() {
            *own = time;
        }
        Ok(())
    }

    /// Begins the initialisation.
    pub fn enter_initialization(&mut self, call: &str) -> Said {
        self.refuse_unless(call, &[Phase::Instantiated])?;
        self.phase = Phase::Initializing;
        Ok(None)
    }

    /// Checks parameters and makes the model.
    pub fn exit_initialization(&mut self, call: &str) -> Said {
        self.refuse_unless(call, &[Phase::Initializing])?;
        self.running = Some(self.unit.start(&self.values)?);
        self.phase = Phase::Stepping;
        Ok(None)
    }

    /// Ends the simulation.
    pub fn terminate(&mut self, call: &str) -> Said {
        self.refuse_unless(call, &[Phase::Initializing, Phase::Stepping])?;
        self.phase = Phase::Terminated;
        Ok(None)
    }

    /// Back to where it was made; states stay.
    pub fn reset(&mut self) {
        self.phase = Phase::Instantiated;
        self.values = self.unit.starts();
        self.running = None;
        self.flags = Flags::default();
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.values.first().copied().unwrap_or(0.0)
    }

    fn variable(&self, reference: u32, wanted: Wanted) -> Result<(usize, &Variable), String> {
        let place = reference as usize;
        let variable = self.unit.variables.get(place).ok_or_else(|| {
            format!(
                "value reference {reference} is out of range; allowed: 0 to {}",
                self.unit.variables.len() - 1
            )
        })?;
        if wanted.fits(variable.kind) {
            Ok((place, variable))
        } else {
            Err(format!(
                "{} (value reference {reference}) is of type {:?} and not {}",
                variable.name,
                variable.kind,
                wanted.name()
            ))
        }
    }

    /// A variable's value.
    pub fn get(&self, reference: u32, wanted: Wanted) -> Result<f64, String> {
        let (place, _) = self.variable(reference, wanted)?;
        Ok(self.values.get(place).copied().unwrap_or_default())
    }

    /// Sets an input, or before the end of the initialisation a parameter.
    pub fn set(&mut self, reference: u32, wanted: Wanted, value: f64) -> Result<(), String> {
        let (place, variable) = self.variable(reference, wanted)?;
        let name = variable.name;
        let allowed: &[Phase] = match variable.causality {
            Causality::Input => &[Phase::Instantiated, Phase::Initializing, Phase::Stepping],
            Causality::Parameter => &[Phase::Instantiated, Phase::Initializing],
            Causality::Output | Causality::Independent => {
                return Err(format!(
                    "{name} is no input and no parameter: it cannot be set"
                ));
            }
        };
        self.refuse_unless(&format!("setting {name}"), allowed)?;
        if let Some(own) = self.values.get_mut(place) {
            *own = value;
        }
        Ok(())
    }

    /// Ticks of a step of this size, 1 without a tick.
    fn ticks(&self, size: f64) -> Result<u32, String> {
        if !(size.is_finite() && size > 0.0) {
            return Err(format!(
                "communicationStepSize = {size} is out of range; allowed: above 0 s"
            ));
        }
        let Some(tick) = self.unit.tick(&self.values) else {
            return Ok(1);
        };
        let ticks = (size / tick).round();
        if ticks < 1.0 || (size - ticks * tick).abs() > ROUNDING * size {
            return Err(format!(
                "communicationStepSize = {size} is out of range; allowed: whole multiples of the tick, {tick} s"
            ));
        }
        if ticks > MOST_TICKS {
            return Err(format!(
                "communicationStepSize = {size} is out of range; allowed: up to {MOST_TICKS} ticks of {tick} s"
            ));
        }
        Ok(ticks as u32)
    }

    /// A step; a warning where the model has flagged it, with a text where flags begin, change or end.
    pub fn do_step(&mut self, call: &str, time: f64, size: f64) -> Said {
        self.refuse_unless(call, &[Phase::Stepping])?;
        let ticks = self.ticks(size)?;
        let own = self.time();
        // NaN is no such time.
        if !((time - own).abs() <= ROUNDING * size + 1e-9 * own.abs()) {
            return Err(format!(
                "currentCommunicationPoint = {time} is out of range; allowed: the end of the last step, {own} s"
            ));
        }
        let inputs: Vec<f64> = self.all(Causality::Input);
        let moment = Moment {
            inputs: &inputs,
            time,
            size,
            ticks,
        };
        let running = self.running.as_mut().ok_or("there is no model")?;
        let outputs = running.step(&moment)?;
        for (place, value) in self.unit.places(Causality::Output).zip(outputs) {
            if let Some(own) = self.values.get_mut(place) {
                *own = value;
            }
        }
        if let Some(own) = self.values.first_mut() {
            *own = time + size;
        }
        Ok(self.flagged(time))
    }

    fn all(&self, causality: Causality) -> Vec<f64> {
        let places = self.unit.places(causality);
        places
            .map(|place| self.values.get(place).copied().unwrap_or(f64::NAN))
            .collect()
    }

    fn faults(&self) -> u32 {
        let mut pairs = self.unit.variables.iter().zip(&self.values);
        let faults = pairs.find(|(variable, _)| variable.name == "faults");
        faults.map_or(0, |(_, value)| *value as u32 & !ACCURACY)
    }

    fn flagged(&mut self, time: f64) -> Option<Told> {
        let faults = self.faults();
        let inputs: Vec<String> = self
            .unit
            .places(Causality::Input)
            .filter_map(|place| {
                let variable = self.unit.variables.get(place)?;
                Some(format!("{} = {}", variable.name, self.values.get(place)?))
            })
            .collect();
        self.flags.take(time, faults, |faults| {
            let words = epas_cli::fmu::fault_words(faults);
            format!("{words}; {}", inputs.join(", "))
        })
    }

    fn snapshot(&self) -> Result<Snapshot, String> {
        Ok(Snapshot {
            unit: self.token,
            phase: self.phase as u8,
            values: self.values.clone(),
            model: self
                .running
                .as_ref()
                .map(|model| model.save())
                .transpose()?,
        })
    }

    /// Keeps its state under a handle.
    pub fn keep(&mut self, handle: usize) -> Result<(), String> {
        let bytes = self.snapshot()?.bytes();
        self.states.insert(handle, bytes);
        Ok(())
    }

    /// Keeps a state that was serialised under a handle.
    pub fn keep_bytes(&mut self, handle: usize, bytes: &[u8]) -> Result<(), String> {
        let snapshot = Snapshot::of(bytes)?;
        self.refuse_foreign(&snapshot)?;
        self.states.insert(handle, bytes.to_vec());
        Ok(())
    }

    fn refuse_foreign(&self, snapshot: &Snapshot) -> Result<(), String> {
        if snapshot.unit != self.token || snapshot.values.len() != self.values.len() {
            return Err("the state is of another unit".into());
        }
        Ok(())
    }

    /// The state under a handle.
    pub fn kept(&self, handle: usize) -> Result<&[u8], String> {
        self.states
            .get(&handle)
            .map(Vec::as_slice)
            .ok_or_else(|| "the state is none of this instance, or was freed".into())
    }

    /// Forgets the state under a handle.
    pub fn forget(&mut self, handle: usize) -> Result<(), String> {
        self.kept(handle)?;
        self.states.remove(&handle);
        Ok(())
    }

    /// Takes the state under a handle over.
    pub fn restore(&mut self, handle: usize) -> Result<(), String> {
        let snapshot = Snapshot::of(self.kept(handle)?)?;
        self.refuse_foreign(&snapshot)?;
        let phase = Phase::ALL
            .get(usize::from(snapshot.phase))
            .copied()
            .ok_or("the state has no phase")?;
        let running = match &snapshot.model {
            None => None,
            Some(block) => {
                let mut running = self.unit.start(&snapshot.values)?;
                running.load(block)?;
                Some(running)
            }
        };
        self.running = running;
        self.phase = phase;
        self.values = snapshot.values;
        self.flags = Flags::new(self.faults(), self.time());
        Ok(())
    }
}
