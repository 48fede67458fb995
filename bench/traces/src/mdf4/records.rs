//! The records of one channel group. A sorted data group holds no others; in an unsorted one each record starts with the number
//! of its group.

use std::collections::HashMap;

use super::chain;
use super::file::{DataGroup, Group};

/// Most samples of a channel: what a trace may have.
pub const MOST_SAMPLES: u64 = 12_000_000;

/// Longest record, bytes: one that goes over the end of a block is held whole.
const LONGEST: usize = 1 << 24;

/// What a record of a group is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// So many bytes.
    Fixed(usize),
    /// A length in four bytes, and as many bytes.
    Variable,
}

/// Gives every record of a channel group to `visit`, its number of the group in front where there is one.
pub fn visit(
    file: &[u8],
    data: &DataGroup,
    group: &Group,
    visit: &mut dyn FnMut(&[u8]),
) -> Result<(), String> {
    if group.cycles > MOST_SAMPLES {
        return Err(format!(
            "group {:?} counts {} samples: at most {MOST_SAMPLES}",
            group.name, group.cycles
        ));
    }
    let forms = forms(data)?;
    let mut whole_records = |bytes: &[u8], found: &mut u64| -> Result<usize, String> {
        let mut rest = bytes;
        while *found < group.cycles {
            let Some((own, length)) = next(rest, data, &forms)? else {
                break;
            };
            let Some((record, after)) = rest.split_at_checked(length) else {
                break;
            };
            if own.is_none_or(|own| own == group.record_id) {
                visit(record);
                *found += 1;
            }
            rest = after;
        }
        Ok(bytes.len() - rest.len())
    };
    let mut found = 0;
    let mut carried: Vec<u8> = Vec::new();
    chain::visit(file, data.address, &mut |bytes| {
        // A record may start in one block and end in the next.
        if carried.is_empty() {
            let used = whole_records(bytes, &mut found)?;
            carried.extend_from_slice(bytes.get(used..).unwrap_or_default());
        } else {
            carried.extend_from_slice(bytes);
            let used = whole_records(&carried, &mut found)?;
            carried.drain(..used);
        }
        Ok(found < group.cycles)
    })?;
    if found < group.cycles {
        return Err(format!(
            "the file is cut off: group {:?} has {found} of its {} samples",
            group.name, group.cycles
        ));
    }
    Ok(())
}

/// Every group's records by their number; the only group's as number 0 where records have none.
fn forms(data: &DataGroup) -> Result<HashMap<u64, Form>, String> {
    let mut forms = HashMap::new();
    for group in &data.records {
        let form = if group.variable {
            Form::Variable
        } else {
            // The lengths have 32 bits each.
            Form::Fixed((group.data_bytes as usize).saturating_add(group.invalid_bytes as usize))
        };
        if forms.insert(group.record_id, form).is_some() && data.id_size > 0 {
            return Err(format!(
                "the file is damaged: two groups have the number {}",
                group.record_id
            ));
        }
    }
    if data.id_size == 0 && data.records.len() != 1 {
        return Err("the file is damaged: several groups share their data without numbers".into());
    }
    Ok(forms)
}

/// The group's number and the length of the record that starts here, as far as it can be told.
fn next(
    rest: &[u8],
    data: &DataGroup,
    forms: &HashMap<u64, Form>,
) -> Result<Option<(Option<u64>, usize)>, String> {
    let Some(number) = rest.get(..data.id_size) else {
        return Ok(None);
    };
    let number = number
        .iter()
        .rev()
        .fold(0u64, |sum, byte| sum << 8 | u64::from(*byte));
    let own = (data.records.len() > 1).then_some(number);
    let form = match own {
        None => forms.values().next(),
        Some(number) => forms.get(&number),
    };
    match form {
        Some(Form::Fixed(0)) => {
            Err("the file is damaged: a group has records without bytes".into())
        }
        Some(Form::Fixed(length)) => {
            bounded(*length).map(|length| Some((own, data.id_size + length)))
        }
        Some(Form::Variable) => {
            let length = rest
                .get(data.id_size..)
                .and_then(|rest| rest.first_chunk::<4>());
            length
                .map(|length| bounded(u32::from_le_bytes(*length) as usize))
                .transpose()
                .map(|length| length.map(|length| (own, data.id_size + 4 + length)))
        }
        None => Err(format!(
            "the file is damaged: a record belongs to group {number}, which is not there"
        )),
    }
}

fn bounded(length: usize) -> Result<usize, String> {
    if length > LONGEST {
        return Err(format!("a record has {length} bytes: at most {LONGEST}"));
    }
    Ok(length)
}
