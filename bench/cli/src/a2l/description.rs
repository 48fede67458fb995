//! The A2L file: what the table in the firmware's source says of each number, at the address that the image gives it.

use std::collections::BTreeSet;

use a2lfile::{
    A2lFile, A2lObject, AddrType, AlignmentFloat32Ieee, AlignmentLong, Asap2Version, ByteOrder,
    ByteOrderEnum, Characteristic, CharacteristicType, CompuMethod, CompuTabRef, CompuVtab,
    ConversionType, DataType, EcuAddress, FncValues, Group, IndexMode, Measurement,
    MemoryAttribute, MemorySegment, MemoryType, ModCommon, ModPar, Module, PrgType, Project,
    ReadOnly, RecordLayout, RefCharacteristic, RefMeasurement, Root, SymbolLink, ValuePairsStruct,
};
use epas_firmware::friction_task::measured::{MEASURED_FIELDS, PAGE_STATES, REGIMES};
use epas_firmware::friction_task::page::{CALIBRATION, LAYOUT};
use epas_firmware::friction_task::table;

use super::variables::{Field, Number, Variable, Variables};
use epas_page::failure::Failure;

/// The page in RAM, that in flash, and what is measured.
const WORKING: &str = "WORKING_PAGE";
const REFERENCE: &str = "REFERENCE_PAGE";
const MEASURED: &str = "MEASURED";

/// Where the numbers of a page stand in it.
const NUMBERS: &str = "numbers.";

const HEXADECIMAL: bool = true;

const PLAIN: &str = "plain";

pub fn describe(image: &Variables<'_>) -> Result<String, Failure> {
    let [working, reference, measured] = [
        image.find(WORKING)?,
        image.find(REFERENCE)?,
        image.find(MEASURED)?,
    ];
    same_layout(image, &reference)?;
    let mut module = Module::new(
        "friction_task".into(),
        "Friction task of an electric power steering".into(),
    );
    module.mod_common = Some(common());
    module.mod_par = Some(memory(&working, &reference));
    for layout in [Number::Float32, Number::Unsigned32].map(record_layout) {
        module.record_layout.push(layout);
    }
    conversions(&mut module);
    page(&mut module, &working, false)?;
    page(&mut module, &reference, true)?;
    measurements(&mut module, &measured)?;
    let mut project = Project::new(
        "epas_friction".into(),
        "Calibration page and measured numbers of the friction task".into(),
    );
    project.module.push(module);
    let mut file = A2lFile::new(project);
    file.asap2_version = Some(Asap2Version::new(1, 71));
    let complaints = file.check();
    if let Some(complaint) = complaints.first() {
        return Err(Failure::Data(format!(
            "the description is wrong: {complaint}"
        )));
    }
    file.project.get_layout_mut().start_offset = 1;
    Ok(file.write_to_string() + "\n")
}

fn same_layout(image: &Variables<'_>, reference: &Variable) -> Result<(), Failure> {
    let layout = reference
        .fields
        .iter()
        .find(|field| field.path == "layout")
        .and_then(|field| image.flashed(field.address));
    if layout == Some(LAYOUT) {
        Ok(())
    } else {
        Err(Failure::Data(
            "its page has another layout than the table of this program: build both from the same source".into(),
        ))
    }
}

fn common() -> ModCommon {
    let mut common = ModCommon::new("Cortex-M".into());
    common.byte_order = Some(ByteOrder::new(ByteOrderEnum::MsbLast));
    common.alignment_long = Some(AlignmentLong::new(4));
    common.alignment_float32_ieee = Some(AlignmentFloat32Ieee::new(4));
    common
}

/// Both pages as segments of memory. The page in RAM is the one in use; the program fills it from flash when it starts.
fn memory(working: &Variable, reference: &Variable) -> ModPar {
    let mut memory = ModPar::new("Memory of the calibration pages".into());
    for (name, about, program, kind, variable) in [
        (
            "working_page",
            "Page in use: taken where checksum and ranges hold, else the last good one stays",
            PrgType::CalibrationVariables,
            MemoryType::Ram,
            working,
        ),
        (
            "reference_page",
            "Page from which the program starts",
            PrgType::Data,
            MemoryType::Flash,
            reference,
        ),
    ] {
        let mut segment = MemorySegment::new(
            name.into(),
            about.into(),
            program,
            kind,
            MemoryAttribute::Intern,
            variable.address,
            variable.size,
            [-1; 5],
        );
        let places = &mut segment.get_layout_mut().item_location;
        (places.5.1, places.6.1) = (HEXADECIMAL, HEXADECIMAL);
        memory.memory_segment.push(segment);
    }
    memory
}

const fn layout_name(number: Number) -> &'static str {
    match number {
        Number::Float32 => "float32",
        Number::Unsigned32 => "unsigned32",
    }
}

const fn data_type(number: Number) -> DataType {
    match number {
        Number::Float32 => DataType::Float32Ieee,
        Number::Unsigned32 => DataType::Ulong,
    }
}

fn record_layout(number: Number) -> RecordLayout {
    let mut layout = RecordLayout::new(layout_name(number).into());
    layout.fnc_values = Some(FncValues::new(
        1,
        data_type(number),
        IndexMode::RowDir,
        AddrType::Direct,
    ));
    layout
}

fn conversions(module: &mut Module) {
    let units: BTreeSet<&str> = CALIBRATION
        .iter()
        .chain(&MEASURED_FIELDS)
        .map(|field| field.unit)
        .collect();
    for unit in units {
        module.compu_method.push(CompuMethod::new(
            conversion(unit),
            if unit.is_empty() {
                "Number without a unit".into()
            } else {
                format!("Number in {unit}")
            },
            ConversionType::Identical,
            "%12.6".into(),
            unit.into(),
        ));
    }
    for (name, states) in VERBAL {
        let mut method = CompuMethod::new(
            name.into(),
            format!("Names of {name}"),
            ConversionType::TabVerb,
            "%3.0".into(),
            String::new(),
        );
        method.compu_tab_ref = Some(CompuTabRef::new(format!("{name}_names")));
        module.compu_method.push(method);
        let mut names = CompuVtab::new(
            format!("{name}_names"),
            format!("Names of {name}"),
            ConversionType::TabVerb,
            u16::try_from(states.len()).unwrap_or(u16::MAX),
        );
        for (value, state) in (0_u16..).zip(states) {
            names
                .value_pairs
                .push(ValuePairsStruct::new(f64::from(value), (*state).into()));
        }
        module.compu_vtab.push(names);
    }
}

/// Measured numbers that stand for names.
const VERBAL: [(&str, &[&str]); 2] = [("regime", &REGIMES), ("page_state", &PAGE_STATES)];

fn conversion(unit: &str) -> String {
    if unit.is_empty() {
        return PLAIN.into();
    }
    unit.replace('/', "_per_").replace([' ', '^'], "_")
}

/// The numbers of a page, with layout and checksum: as such of the page in RAM, read-only under `reference.` of that in flash.
fn page(module: &mut Module, variable: &Variable, reference: bool) -> Result<(), Failure> {
    let mut numbers = Vec::new();
    for (name, about) in [
        ("layout", "Which numbers the page has, in which order"),
        (
            "checksum",
            "CRC-32 (as in zip files) of all bytes before it: write it last",
        ),
    ] {
        let limits = (0.0, f64::from(u32::MAX));
        numbers.push((word(variable, name)?, name, about, PLAIN.into(), limits));
    }
    for (field, row) in rows(variable, NUMBERS, &CALIBRATION)? {
        let limits = (decimal(row.minimum), decimal(row.maximum));
        let unit = conversion(row.unit);
        numbers.push((field, row.name, row.description.trim(), unit, limits));
    }
    let mut names = RefCharacteristic::new();
    for (field, name, about, unit, limits) in numbers {
        let own = if reference {
            format!("reference.{name}")
        } else {
            name.to_owned()
        };
        let mut number = characteristic(field, own.clone(), about, unit, limits);
        if reference || name == "layout" {
            number.read_only = Some(ReadOnly::new());
        }
        names.identifier_list.push(own);
        module.characteristic.push(number);
    }
    let (name, about) = if reference {
        (
            "reference_page_numbers",
            "Calibration page in flash, to compare with",
        )
    } else {
        ("working_page_numbers", "Calibration page in RAM")
    };
    module.group.push(group(name, about, Some(names), None));
    Ok(())
}

fn characteristic(
    field: &Field,
    name: String,
    about: &str,
    unit: String,
    (lower, upper): (f64, f64),
) -> Characteristic {
    let mut number = Characteristic::new(
        name,
        about.to_owned(),
        CharacteristicType::Value,
        field.address,
        layout_name(field.number).into(),
        0.0,
        unit,
        lower,
        upper,
    );
    number.get_layout_mut().item_location.3.1 = HEXADECIMAL;
    number.symbol_link = Some(SymbolLink::new(field.symbol.clone(), 0));
    number
}

fn measurements(module: &mut Module, variable: &Variable) -> Result<(), Failure> {
    let mut names = RefMeasurement::new();
    for (field, row) in rows(variable, "", &MEASURED_FIELDS)? {
        let verbal = VERBAL.iter().any(|(name, _)| *name == row.name);
        let mut measurement = Measurement::new(
            row.name.into(),
            row.description.trim().into(),
            data_type(field.number),
            if verbal {
                row.name.into()
            } else {
                conversion(row.unit)
            },
            0,
            0.0,
            decimal(row.minimum),
            decimal(row.maximum),
        );
        let mut address = EcuAddress::new(field.address);
        address.get_layout_mut().item_location.0.1 = HEXADECIMAL;
        measurement.ecu_address = Some(address);
        measurement.symbol_link = Some(SymbolLink::new(field.symbol.clone(), 0));
        names.identifier_list.push(row.name.into());
        module.measurement.push(measurement);
    }
    let about = "Numbers of the last tick of the friction task";
    module
        .group
        .push(group("measured_numbers", about, None, Some(names)));
    Ok(())
}

fn group(
    name: &str,
    about: &str,
    characteristics: Option<RefCharacteristic>,
    measurements: Option<RefMeasurement>,
) -> Group {
    let mut group = Group::new(name.into(), about.into());
    group.root = Some(Root::new());
    group.ref_characteristic = characteristics;
    group.ref_measurement = measurements;
    group
}

/// A limit as the source prints it: 0.02, which in single precision is not 0.02 in double.
fn decimal(limit: f32) -> f64 {
    limit.to_string().parse().unwrap_or(f64::from(limit))
}

fn word<'a>(variable: &'a Variable, name: &str) -> Result<&'a Field, Failure> {
    variable
        .fields
        .iter()
        .find(|field| field.path == name)
        .ok_or_else(|| Failure::Data(format!("the page has no field {name}")))
}

/// Each field of the image with its row of the table; none is left over on either side.
fn rows<'a>(
    variable: &'a Variable,
    prefix: &str,
    table: &'static [table::Field],
) -> Result<Vec<(&'a Field, &'static table::Field)>, Failure> {
    let mut fields = variable
        .fields
        .iter()
        .filter_map(|field| Some((field, field.path.strip_prefix(prefix)?)));
    let mut rows = Vec::new();
    for row in table {
        match fields.next() {
            Some((field, name)) if name == row.name => rows.push((field, row)),
            Some((_, name)) => {
                return Err(Failure::Data(format!(
                    "the image has {name} where the table has {}",
                    row.name
                )));
            }
            None => return Err(Failure::Data(format!("the image has no {}", row.name))),
        }
    }
    match fields.next() {
        Some((_, name)) => Err(Failure::Data(format!("the table has no {name}"))),
        None => Ok(rows),
    }
}
