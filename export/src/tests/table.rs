#![allow(clippy::unwrap_used)]
use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;

use parquet::file::reader::{FileReader, SerializedFileReader};
use vitriol_run::MassByPlace;

use super::*;

/// Of a run with flasks that someone called so that a spreadsheet would compute something, or so that two columns might be one.
fn sample(t_s: f64) -> Sample {
    let names = [
        "=1+1",
        "+1",
        "-1",
        "@SUM(A1)",
        "\tx",
        "the air",
        "a\"b,c\r\n=2",
    ];
    let flasks: BTreeMap<String, f64> = names.map(|name| (name.to_owned(), t_s)).into();
    Sample {
        t_s,
        density_error_mean: 0.0,
        density_error_p99: f64::NAN,
        kinetic_energy_j: 0.1,
        mass_kg: MassByPlace {
            flasks: flasks.clone(),
            ..MassByPlace::default()
        },
        neighbour_rebuilds: 0,
        left_kg: flasks.clone(),
        above_rim_kg: flasks.clone(),
        surface_m2: flasks,
        highest_drop_m: None,
        heat: None,
    }
}

#[test]
fn no_cell_begins_a_formula() {
    let columns = columns(&sample(0.0));
    let mut file = tempfile::tempfile().unwrap();
    let mut table = Box::new(Csv::new(file.try_clone().unwrap(), &columns).unwrap());
    table.row(&columns, &sample(-1.5)).unwrap();
    table.finish().unwrap();
    let mut text = String::new();
    std::io::Seek::rewind(&mut file).unwrap();
    file.read_to_string(&mut text).unwrap();
    // Programs read it, and some take a byte order mark for a part of the name.
    assert!(text.starts_with("time [s],"), "{text}");
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    let records: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), 2);
    for cell in records.iter().flatten() {
        let begins = cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
        // A number below zero is one.
        assert!(!begins || cell.parse::<f64>().is_ok(), "{cell:?}");
    }
    let header: BTreeSet<&str> = records[0].iter().collect();
    assert_eq!(header.len(), columns.len(), "each column has its own name");
    assert!(header.iter().all(|name| name.ends_with(']')), "{header:?}");
    // What is no number is an empty cell.
    let place = records[0]
        .iter()
        .position(|name| name.contains("99th"))
        .unwrap();
    assert_eq!(&records[1][place], "");
}

/// CSV begins with its header, and a Parquet file with its magic number (Apache Parquet, "File Format").
#[test]
fn each_format_is_written_as_what_it_is_called() {
    let columns = columns(&sample(0.0));
    for (format, begins) in [
        (TableFormat::Csv, "time [s],"),
        (TableFormat::Parquet, "PAR1"),
    ] {
        let mut file = tempfile::tempfile().unwrap();
        let mut table = format.begin(file.try_clone().unwrap(), &columns).unwrap();
        table.row(&columns, &sample(0.5)).unwrap();
        table.finish().unwrap();
        let mut written = Vec::new();
        std::io::Seek::rewind(&mut file).unwrap();
        file.read_to_end(&mut written).unwrap();
        assert!(written.starts_with(begins.as_bytes()), "{}", format.name());
    }
}

/// More rows than are held in memory.
#[test]
fn rows_are_written_as_they_come() {
    let columns = columns(&sample(0.0));
    let file = tempfile::tempfile().unwrap();
    let mut table = Box::new(Parquet::new(file.try_clone().unwrap(), &columns).unwrap());
    let rows = 2 * ROWS + 500;
    for row in 0..rows {
        assert!(table.rows.iter().all(|values| values.len() < ROWS));
        table.row(&columns, &sample(row as f64)).unwrap();
    }
    table.finish().unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    assert_eq!(reader.metadata().num_row_groups(), 3);
    for (number, row) in reader.get_row_iter(None).unwrap().enumerate() {
        let row = row.unwrap();
        let (name, value) = row.get_column_iter().next().unwrap();
        assert_eq!(
            (name.as_str(), value),
            ("time [s]", &parquet::record::Field::Double(number as f64))
        );
    }
}

/// Flasks may be called so that nothing is left of two names but the same letters.
#[test]
fn each_column_has_an_identifier_of_its_own() {
    let columns = columns(&sample(0.0));
    let names = identifiers(&columns);
    assert_eq!(names.len(), columns.len());
    assert_eq!(names[..2], ["time_s", "density_error_mean_1"]);
    let letters: BTreeSet<String> = names.iter().map(|name| name.replace('_', "")).collect();
    assert_eq!(letters.len(), names.len(), "{names:?}");
    for name in &names {
        assert!(name.starts_with(|c: char| c.is_ascii_lowercase()), "{name}");
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(name.chars().all(fits), "{name}");
    }
}
