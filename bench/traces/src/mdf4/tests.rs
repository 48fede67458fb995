//! Files made by hand: what no writer at hand makes, and what no writer should.

use miniz_oxide::deflate::compress_to_vec_zlib;

use super::table::{Request, Wanted, of};
use crate::table::Table;
use crate::units::{Part, Quantity};

const WANTED: [Wanted; 2] = [
    Wanted {
        name: "nut_speed",
        quantity: Quantity::Speed(Part::Nut),
        refuses: None,
    },
    Wanted {
        name: "axial_load",
        quantity: Quantity::Load,
        refuses: None,
    },
];

fn read(file: &[u8]) -> Result<Table, String> {
    let request = Request {
        wanted: &WANTED,
        master: &[Quantity::Speed(Part::Nut)],
        mapping: None,
        rated_torque: None,
    };
    of(file.to_vec(), &request)
}

/// A file that grows block by block.
struct File(Vec<u8>);

impl File {
    fn new() -> Self {
        let mut file = Self(b"MDF     4.10    by hand ".to_vec());
        file.0.resize(64, 0);
        file.block("##HD", &[0; 6], &[0; 32]);
        file
    }

    fn block(&mut self, kind: &str, links: &[u64], data: &[u8]) -> u64 {
        self.0.resize(self.0.len().next_multiple_of(8), 0);
        let place = self.0.len() as u64;
        let length = (24 + 8 * links.len() + data.len()) as u64;
        self.0.extend_from_slice(kind.as_bytes());
        self.0.extend_from_slice(&[0; 4]);
        for number in [length, links.len() as u64].iter().chain(links) {
            self.0.extend_from_slice(&number.to_le_bytes());
        }
        self.0.extend_from_slice(data);
        place
    }

    fn text(&mut self, text: &str) -> u64 {
        self.block("##TX", &[], format!("{text}\0").as_bytes())
    }

    /// A channel of 64 bits at a byte of the record; kind 2 is the master.
    fn channel(&mut self, next: u64, (name, unit): (&str, &str), kind: u8, byte: u32) -> u64 {
        let (name, unit) = (self.text(name), self.text(unit));
        // Conversion: 10 + 2 value, for the load.
        let conversion = if kind == 0 && byte > 8 {
            let mut data = vec![1, 0, 0, 0, 0, 0, 2, 0];
            data.extend([10.0f64, 2.0].iter().flat_map(|value| value.to_le_bytes()));
            self.block("##CC", &[0; 4], &data)
        } else {
            0
        };
        let mut data = vec![kind, u8::from(kind == 2), 4, 0];
        for number in [byte, 64, 0, 0] {
            data.extend_from_slice(&u32::to_le_bytes(number));
        }
        data.resize(72, 0);
        self.block("##CN", &[next, 0, name, 0, conversion, 0, unit, 0], &data)
    }

    fn group(
        &mut self,
        next: u64,
        channels: u64,
        [number, samples]: [u64; 2],
        bytes: u32,
        flags: u16,
    ) -> u64 {
        let mut data = Vec::new();
        data.extend_from_slice(&number.to_le_bytes());
        data.extend_from_slice(&samples.to_le_bytes());
        data.extend_from_slice(&flags.to_le_bytes());
        data.extend_from_slice(&[0; 6]);
        data.extend_from_slice(&bytes.to_le_bytes());
        data.extend_from_slice(&[0; 4]);
        self.block("##CG", &[next, channels, 0, 0, 0, 0], &data)
    }

    fn done(mut self, group: u64, data: u64, id_size: u8) -> Vec<u8> {
        let data_group = self.block(
            "##DG",
            &[0, group, data, 0],
            &[id_size, 0, 0, 0, 0, 0, 0, 0],
        );
        self.0[64 + 24..64 + 32].copy_from_slice(&data_group.to_le_bytes());
        self.0
    }

    /// Time, speed and load in one group.
    fn three(&mut self, samples: u64) -> u64 {
        let load = self.channel(0, ("axial_load", "N"), 0, 16);
        let speed = self.channel(load, ("nut_speed", "rpm"), 0, 8);
        let time = self.channel(speed, ("t", "s"), 2, 0);
        self.group(0, time, [1, samples], 24, 0)
    }
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

/// Two samples, and what is read of them.
fn two() -> (Vec<u8>, [Vec<f64>; 3]) {
    let turn = std::f64::consts::TAU / 60.0;
    (
        doubles(&[0.0, 60.0, 1.0, 0.5, -30.0, 2.0]),
        [
            vec![0.0, 0.5],
            vec![60.0 * turn, -30.0 * turn],
            vec![12.0, 14.0],
        ],
    )
}

fn is_two(table: &Table) {
    let (_, [time, speed, load]) = two();
    assert_eq!(table.times, time);
    assert_eq!(table.columns[0].values, speed);
    assert_eq!(table.columns[1].values, load);
}

fn plain() -> Vec<u8> {
    let mut file = File::new();
    let group = file.three(2);
    let data = file.block("##DT", &[], &two().0);
    file.done(group, data, 0)
}

/// Header of a compressed block of records.
fn packed(way: u8, columns: u32, original: u64, data: &[u8]) -> Vec<u8> {
    let mut block = vec![b'D', b'T', way, 0];
    block.extend_from_slice(&columns.to_le_bytes());
    block.extend_from_slice(&original.to_le_bytes());
    block.extend_from_slice(&(data.len() as u64).to_le_bytes());
    block.extend_from_slice(data);
    block
}

/// A file whose records go over the ends of a plain and a compressed block.
fn listed() -> Vec<u8> {
    let (bytes, _) = two();
    let mut file = File::new();
    let group = file.three(2);
    let first = file.block("##DT", &[], &bytes[..13]);
    let second = file.block(
        "##DZ",
        &[],
        &packed(0, 0, 35, &compress_to_vec_zlib(&bytes[13..], 6)),
    );
    let list = file.block("##DL", &[0, first, second], &[0; 24]);
    let header = file.block("##HL", &[list], &[0; 8]);
    file.done(group, header, 0)
}

#[test]
fn a_record_may_go_over_the_end_of_a_block() {
    is_two(&read(&plain()).unwrap());
    is_two(&read(&listed()).unwrap());
}

#[test]
fn unsorted_groups_are_told_apart_by_their_numbers() {
    let mut file = File::new();
    let load = file.channel(0, ("axial_load", "N"), 0, 16);
    let speed = file.channel(load, ("nut_speed", "rpm"), 0, 8);
    let time = file.channel(speed, ("t", "s"), 2, 0);
    let other = file.group(0, 0, [7, 1], 3, 0);
    let texts = file.group(other, 0, [9, 1], 0, 1);
    let group = file.group(texts, time, [1, 2], 24, 0);
    let (bytes, _) = two();
    let mut data = vec![7, 0, 0xAA, 0xBB, 0xCC, 1, 0];
    data.extend_from_slice(&bytes[..24]);
    data.extend_from_slice(&[9, 0, 2, 0, 0, 0, b'h', b'i', 1, 0]);
    data.extend_from_slice(&bytes[24..]);
    let mut stranger = data.clone();
    stranger[0] = 8;
    let address = file.block("##DT", &[], &data);
    let mut wrong = File(file.0.clone());
    is_two(&read(&file.done(group, address, 2)).unwrap());
    let address = wrong.block("##DT", &[], &stranger);
    let message = read(&wrong.done(group, address, 2)).unwrap_err();
    assert!(message.contains("belongs to group 8"), "{message}");
}

#[test]
fn counts_that_cannot_be_are_refused_before_memory_is_taken() {
    let (bytes, _) = two();
    let with = |samples: u64, block: (&str, Vec<u8>)| {
        let mut file = File::new();
        let group = file.three(samples);
        let data = file.block(block.0, &[], &block.1);
        read(&file.done(group, data, 0)).unwrap_err()
    };
    let zeros = compress_to_vec_zlib(&[0; 1000], 9);
    for (samples, kind, data, word) in [
        (3, "##DT", bytes.clone(), "2 of its 3 samples"),
        (u64::MAX, "##DT", bytes.clone(), "at most 12000000"),
        (
            2,
            "##DZ",
            packed(0, 0, u64::MAX, &zeros),
            "says that it has 18446744073709551615 bytes",
        ),
        (2, "##DZ", packed(0, 0, 48, &zeros), "does not inflate"),
        (2, "##DZ", packed(0, 0, 48, &[1, 2, 3]), "does not inflate"),
        (2, "##DZ", packed(2, 0, 48, &zeros), "packed in way 2"),
        (2, "##DV", bytes.clone(), "in columns"),
        (2, "##SD", bytes, "is expected"),
    ] {
        let message = with(samples, (kind, data));
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn a_circle_of_lists_ends() {
    let mut file = File::new();
    let group = file.three(2);
    let place = (file.0.len().next_multiple_of(8)) as u64;
    let list = file.block("##DL", &[place], &[0; 24]);
    let message = read(&file.done(group, list, 0)).unwrap_err();
    assert!(message.contains("circle"), "{message}");
}

#[test]
fn any_file_cut_off_or_changed_is_read_or_refused() {
    for file in [plain(), listed()] {
        for length in 0..file.len() {
            // The last block may lose its padding alone.
            let _ = read(&file[..length]);
        }
        for place in 0..file.len() {
            for value in [0, 1, 0x7F, 0x80, 0xFF] {
                let mut changed = file.clone();
                changed[place] = value;
                let _ = read(&changed);
                // Numbers of eight bytes as well.
                for byte in changed.iter_mut().skip(place).take(8) {
                    *byte = value;
                }
                let _ = read(&changed);
            }
        }
    }
}

/// A sample that is NaN or infinite is left out with its row.
#[test]
fn no_number_is_a_missing_sample() {
    for (place, rows) in [(1, 99), (2, 99)] {
        let mut file = File::new();
        let group = file.three(100);
        let mut values = Vec::new();
        for sample in 0..100 {
            let mut row = [0.01 * f64::from(sample), 60.0, 1.0];
            if sample == 40 {
                row[place] = f64::NAN;
            }
            values.extend(row);
        }
        let data = file.block("##DT", &[], &doubles(&values));
        let table = read(&file.done(group, data, 0)).unwrap();
        assert_eq!(table.times.len(), rows);
        assert!(
            table
                .columns
                .iter()
                .all(|column| column.values.iter().all(|x| x.is_finite()))
        );
        assert!(
            table.notes[0].contains("are NaN or infinite"),
            "{:?}",
            table.notes
        );
    }
}
