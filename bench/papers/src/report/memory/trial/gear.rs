//! A gear whose friction is known: what was measured of it, and what a control unit knows of it tick by tick.

use epas_rig::course::{Course, Manoeuvre};
use epas_rig::parameters::Parameters;
use epas_rig::{Rig, Sensors};

use epas_calibrate::estimator::kernel::Kernel;
use epas_calibrate::estimator::record::Record;
use epas_calibrate::estimator::rows::Rows;
use epas_calibrate::trace::{Coordinate, Repairs, Trace};
use epas_design::files::{Design, DesignSource};
use epas_page::failure::Failure;

/// Seed of the trace that models are fitted to, and of the one on which they are judged.
const SEEDS: [u64; 2] = [0, 5];

/// Bandwidth of the filter that tracks the angle, Hz.
const TRACKING: f64 = 40.0;

/// Manoeuvres that are judged one by one.
pub const JUDGED: [Manoeuvre; 3] = [Manoeuvre::Weave, Manoeuvre::Parking, Manoeuvre::Micro];

/// A gear with the trace for fitting and the one for judging.
pub struct Gear {
    /// Its design, as a catalogue has it: without friction or fit.
    pub design: Design,
    /// What it is.
    pub parameters: Parameters,
    /// Measured trace to be fitted.
    pub trace: Trace,
    /// The same as the estimator takes it.
    pub record: Record,
    /// Its speed, rad/s.
    pub speed: Vec<f64>,
    /// How it becomes rows.
    pub rows: Rows,
    /// The trace on which models are judged, with what is true.
    unseen: epas_rig::Trace,
    /// The same as the control unit knows it: counted angles, and a speed that tracks them, rad/s.
    pub in_loop: (Trace, Vec<f64>),
}

impl Gear {
    /// Runs the vehicle's course twice, its parts as long as this share of their 20 s.
    pub fn new(parameters: Parameters, length: f64) -> Result<Self, Failure> {
        let rig = Rig::new(parameters.clone(), Sensors::default())?;
        let course = Course::vehicle().times(length);
        let run = |seed: u64| rig.run(&course, seed);
        let trace = measured(&run(SEEDS[0])?);
        let unseen = run(SEEDS[1])?;
        let known = measured(&unseen);
        let speed = tracked(&known);
        let record = Record::of(&trace, &[]);
        let rows = rows(&record);
        let source: DesignSource = "lin-4.1".parse().map_err(Failure::Data)?;
        Ok(Self {
            design: source.load()?,
            parameters,
            speed: rows.kernel.along(1, &record.motion),
            record,
            rows,
            trace,
            in_loop: (known, speed),
            unseen,
        })
    }

    /// Rms of the true friction less a model's, N m: by manoeuvre, and over all.
    pub fn residual(&self, found: &[f64]) -> [f64; 4] {
        let truth = &self.unseen.truth.friction;
        let rms = |samples: &mut dyn Iterator<Item = usize>| {
            let (mut sum, mut count) = (0.0, 0.0_f64);
            for sample in samples {
                sum += (truth[sample] - found[sample]).powi(2);
                count += 1.0;
            }
            (sum / count.max(1.0)).sqrt()
        };
        let [weave, parking, micro] =
            JUDGED.map(|manoeuvre| rms(&mut self.unseen.samples_of(manoeuvre)));
        [weave, parking, micro, rms(&mut (0..truth.len()))]
    }

    /// Samples of a second in the micro triangles, with time in s and true friction.
    pub fn glimpse(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let second = (1.0 / self.trace.step) as usize;
        let middle = self
            .unseen
            .samples_of(Manoeuvre::Micro)
            .nth(3 * second)
            .unwrap_or(0);
        let samples = middle..(middle + 3 * second).min(self.unseen.len());
        samples.map(|sample| {
            (
                sample,
                self.unseen.time[sample],
                self.unseen.truth.friction[sample],
            )
        })
    }
}

/// A trace as a file of it would be read.
fn measured(trace: &epas_rig::Trace) -> Trace {
    Trace {
        name: "rig".into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step: trace.time.get(1).copied().unwrap_or(1e-3),
        position: trace.nut_position.clone(),
        resolution: Sensors::default().count,
        position_summed: false,
        speed: None,
        effort: trace.motor_torque.clone(),
        reference_position: None,
        load: Some(trace.axial_load.clone()),
        load_is_effort: false,
        known: None,
        temperature: Some(trace.temperature.clone()),
        left_out: Vec::new(),
        origins: epas_calibrate::trace::Origins::default(),
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

/// Half-width of the kernel of a row, samples, and samples between two rows.
const ROW: [usize; 2] = [17, 6];

/// Rows over the whole trace.
fn rows(record: &Record) -> Rows {
    let [half, hop] = ROW;
    let centres: Vec<usize> = (half..record.len() - half).step_by(hop).collect();
    Rows {
        kernel: Kernel::new(half, record.tick),
        directions: vec![0.0; centres.len()],
        stretches: vec![0; centres.len()],
        pieces: vec![0; centres.len()],
        stroke: 0.0,
        centres,
    }
}

/// Speed as it is known in the loop: that of a filter of the second order, critically damped, that tracks the counted angle.
fn tracked(trace: &Trace) -> Vec<f64> {
    let rate = std::f64::consts::TAU * TRACKING * trace.step;
    let (mut angle, mut speed) = (trace.position.first().copied().unwrap_or(0.0), 0.0);
    let speeds = trace.position.iter().map(|reading| {
        angle += speed * trace.step;
        let error = reading - angle;
        angle += 2.0 * rate * error;
        speed += rate * rate * error / trace.step;
        speed
    });
    speeds.collect()
}
