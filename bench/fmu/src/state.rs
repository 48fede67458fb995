//! State of an instance as bytes, from its first four to its checksum.

/// First bytes, with the version of the layout.
const MAGIC: &[u8; 8] = b"EPASFMU1";

#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Checksum of the unit's token.
    pub unit: u32,
    pub phase: u8,
    /// Values of all variables.
    pub values: Vec<f64>,
    /// State of the model; none before there is one.
    pub model: Option<Vec<u8>>,
}

impl Snapshot {
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(self.unit.to_le_bytes());
        bytes.push(self.phase);
        bytes.push(self.model.is_some().into());
        bytes.extend((self.values.len() as u32).to_le_bytes());
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes.extend(self.model.iter().flatten());
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }

    pub fn of(bytes: &[u8]) -> Result<Self, String> {
        let damaged = || "the state is damaged: its checksum is wrong".to_owned();
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or("the state is none of this program, or of another version")?;
        let (_, sum) = bytes.split_last_chunk::<4>().ok_or_else(damaged)?;
        let covered = bytes.len().saturating_sub(4);
        if bytes.get(..covered).map(crc32fast::hash) != Some(u32::from_le_bytes(*sum)) {
            return Err(damaged());
        }
        let (rest, _) = rest.split_last_chunk::<4>().ok_or_else(damaged)?;
        let (unit, rest) = rest.split_first_chunk::<4>().ok_or_else(damaged)?;
        let ([phase, model], rest) = rest.split_first_chunk::<2>().ok_or_else(damaged)?;
        let (count, rest) = rest.split_first_chunk::<4>().ok_or_else(damaged)?;
        let length = 8 * u32::from_le_bytes(*count) as usize;
        let (values, block) = rest.split_at_checked(length).ok_or_else(damaged)?;
        let (values, _) = values.as_chunks::<8>();
        Ok(Self {
            unit: u32::from_le_bytes(*unit),
            phase: *phase,
            values: values
                .iter()
                .map(|value| f64::from_le_bytes(*value))
                .collect(),
            model: (*model != 0).then(|| block.to_vec()),
        })
    }
}
