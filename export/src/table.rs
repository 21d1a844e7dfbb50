//! Measurements as tables: one row a sample, units in the header.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufWriter;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use vitriol_run::{Cause, LedgerSample, Sample};

/// Rows that a Parquet file holds together, and this program in memory: a minute and a half.
const ROWS: usize = 1000;

type OfLedger = fn(&LedgerSample) -> f64;
type Value = Box<dyn Fn(&Sample) -> Option<f64> + Send>;

/// A column of a table.
pub struct Column {
    /// What it is, with its unit in brackets. It begins with a word of ours: a flask may be called `=1+1`, which at a
    /// cell's beginning a spreadsheet would compute.
    pub header: String,
    value: Value,
}

impl Column {
    fn new(
        what: &str,
        unit: &str,
        value: impl Fn(&Sample) -> Option<f64> + Send + 'static,
    ) -> Self {
        Self {
            header: format!("{what} [{unit}]"),
            value: Box::new(value),
        }
    }

    /// Its value in a row; `None` where there is none then, such as the temperature of an empty flask.
    pub fn value(&self, sample: &Sample) -> Option<f64> {
        (self.value)(sample).filter(|value| value.is_finite())
    }
}

/// Names of columns where only letters of ASCII, digits and `_` may be in one, with their units: `temperature_mean_degc`. Some
/// readers of Protobuf refuse two names that differ in `_` alone, so a number is added to the second.
pub fn identifiers(columns: &[Column]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let identifier = |column: &Column| {
        let words = column.header.split(|c: char| !c.is_ascii_alphanumeric());
        let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
        let plain = words.join("_").to_ascii_lowercase();
        let (mut name, mut number) = (plain.clone(), 1);
        while !taken.insert(name.replace('_', "")) {
            number += 1;
            name = format!("{plain}_{number}");
        }
        name
    };
    columns.iter().map(identifier).collect()
}

/// The columns of a run whose first sample this is.
pub fn columns(first: &Sample) -> Vec<Column> {
    let mut columns = vec![
        Column::new("time", "s", |s| Some(s.t_s)),
        Column::new("density error, mean", "1", |s| Some(s.density_error_mean)),
        Column::new("density error, 99th percentile", "1", |s| {
            Some(s.density_error_p99)
        }),
        Column::new("kinetic energy", "J", |s| Some(s.kinetic_energy_j)),
        Column::new("rebuilds of the neighbour list", "1", |s| {
            Some(s.neighbour_rebuilds as f64)
        }),
        Column::new("mass on the table", "kg", |s| Some(s.mass_kg.table)),
        Column::new("mass on the floor", "kg", |s| Some(s.mass_kg.floor)),
        Column::new("mass in the air", "kg", |s| Some(s.mass_kg.air)),
        Column::new("height of the highest drop over its rim", "m", |s| {
            s.highest_drop_m
        }),
    ];
    let flasks: Vec<&String> = first.mass_kg.flasks.keys().collect();
    for &flask in &flasks {
        let key = || flask.clone();
        let (a, b, c, d) = (key(), key(), key(), key());
        columns.extend([
            Column::new(&format!("mass in flask {flask}"), "kg", move |s| {
                s.mass_kg.flasks.get(&a).copied()
            }),
            Column::new(&format!("mass that left flask {flask}"), "kg", move |s| {
                s.left_kg.get(&b).copied()
            }),
            Column::new(
                &format!("mass above the rim of flask {flask}"),
                "kg",
                move |s| s.above_rim_kg.get(&c).copied(),
            ),
            Column::new(
                &format!("surface of the liquid in flask {flask}"),
                "m2",
                move |s| s.surface_m2.get(&d).copied(),
            ),
        ]);
    }
    let Some(heat) = &first.heat else {
        return columns;
    };
    macro_rules! of_heat {
        ($what:expr, $unit:expr, $heat:ident => $value:expr) => {
            Column::new(&$what, $unit, move |s| {
                s.heat.as_ref().and_then(|$heat| $value)
            })
        };
    }
    columns.extend([
        of_heat!("temperature, mean", "degC", heat => Some(heat.temperature_mean_c)),
        of_heat!("temperature, 99th percentile", "degC", heat => Some(heat.temperature_p99_c)),
        of_heat!("temperature, highest", "degC", heat => Some(heat.temperature_max_c)),
        of_heat!("acid, mean", "kg/kg", heat => Some(heat.acid_mean)),
        of_heat!("acid, least", "kg/kg", heat => Some(heat.acid_min)),
        of_heat!("acid, most", "kg/kg", heat => Some(heat.acid_max)),
        of_heat!("superheat, highest", "K", heat => heat.superheat_max_k),
        of_heat!("particles above the boiling point", "1", heat => heat.boiling_particles.map(|n| n as f64)),
    ]);
    for (end, place) in [("lowest", 0), ("highest", 1)] {
        for &flask in &flasks {
            let (a, b) = (flask.clone(), flask.clone());
            let column = of_heat!(format!("temperature in flask {flask}, {end}"), "degC", heat => {
                heat.temperatures_in_flasks_c.get(&a).map(|ends| ends[place])
            });
            columns.push(column);
            if heat.temperatures_of_glass_c.contains_key(flask) {
                let column = of_heat!(format!("temperature of the glass of flask {flask}, {end}"), "degC", heat => {
                    heat.temperatures_of_glass_c.get(&b).map(|ends| ends[place])
                });
                columns.push(column);
            }
        }
    }
    for &flask in &flasks {
        let key = flask.clone();
        let column = of_heat!(format!("particles above the boiling point in flask {flask}"), "1", heat => {
            heat.boiling_in_flasks.get(&key).map(|&count| count as f64)
        });
        columns.push(column);
    }
    if heat.ledger.is_some() {
        let of_ledger: [(&str, &str, OfLedger); 15] = [
            ("enthalpy at the start", "J", |l| l.initial_j),
            ("heat gained from around", "J", |l| l.exchanged_j),
            ("enthalpy of what is there", "J", |l| l.held_j),
            ("enthalpy that steam took along", "J", |l| l.steam_j),
            ("error of the balance of enthalpy", "1", |l| l.closure),
            ("steam that left", "kg", |l| l.steam_kg),
            ("mist in the air", "kg", |l| l.mist_kg),
            ("dew on the glass", "kg", |l| l.dew_kg),
            ("vapour in the liquid", "kg", |l| l.vapour_kg),
            ("drops of bubbles that fly", "kg", |l| l.spray_kg),
            ("drops of bubbles at rest", "kg", |l| l.spray_fallen_kg),
            ("air that streams took down", "kg", |l| l.air_kg),
            ("air in bubbles", "kg", |l| l.air_held_kg),
            ("volume of bubbles", "m3", |l| l.bubbles_m3),
            ("volume of foam", "m3", |l| l.foam_m3),
        ];
        for (what, unit, value) in of_ledger {
            columns.push(of_heat!(what, unit, heat => heat.ledger.as_ref().map(value)));
        }
    }
    columns
}

/// A table that is being written.
pub trait Table {
    /// Adds a row.
    ///
    /// # Errors
    /// An error of the file system.
    fn row(&mut self, columns: &[Column], sample: &Sample) -> Result<(), Cause>;

    /// Ends it.
    ///
    /// # Errors
    /// An error of the file system.
    fn finish(self: Box<Self>) -> Result<(), Cause>;
}

/// A table's format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// CSV
    Csv,
    /// Parquet
    Parquet,
}

impl TableFormat {
    /// The name as it is given, and the ending of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }

    /// Begins a table of those columns.
    ///
    /// # Errors
    /// An error of the file system.
    pub(crate) fn begin(self, file: File, columns: &[Column]) -> Result<Box<dyn Table>, Cause> {
        let table: Box<dyn Table> = match self {
            Self::Csv => Box::new(Csv::new(file, columns)?),
            Self::Parquet => Box::new(Parquet::new(file, columns)?),
        };
        Ok(table)
    }
}

/// A table as CSV (RFC 4180). It is for programs, and Python's `csv` takes a byte order mark for a part of the first
/// column's name: it has none.
pub struct Csv(csv::Writer<BufWriter<File>>);

impl Csv {
    /// A table of those columns.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn new(file: File, columns: &[Column]) -> Result<Self, Cause> {
        let mut writer = csv::WriterBuilder::new()
            .terminator(csv::Terminator::CRLF)
            .from_writer(BufWriter::new(file));
        let header = columns.iter().map(|column| &column.header);
        writer.write_record(header)?;
        Ok(Self(writer))
    }
}

impl Table for Csv {
    fn row(&mut self, columns: &[Column], sample: &Sample) -> Result<(), Cause> {
        let cells = columns.iter().map(|column| column.value(sample));
        let cells = cells.map(|cell| cell.map_or_else(String::new, |value| value.to_string()));
        Ok(self.0.write_record(cells)?)
    }

    fn finish(mut self: Box<Self>) -> Result<(), Cause> {
        Ok(self.0.flush()?)
    }
}

/// A table as Parquet.
pub struct Parquet {
    writer: SerializedFileWriter<BufWriter<File>>,
    /// Of each column the values that are not written yet.
    rows: Vec<Vec<Option<f64>>>,
}

impl Parquet {
    /// A table of those columns.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn new(file: File, columns: &[Column]) -> Result<Self, Cause> {
        let field = |column: &Column| -> Result<_, Cause> {
            let field = Type::primitive_type_builder(&column.header, Physical::DOUBLE)
                .with_repetition(Repetition::OPTIONAL)
                .build();
            Ok(Arc::new(field?))
        };
        let fields: Result<Vec<_>, Cause> = columns.iter().map(field).collect();
        let schema = Type::group_type_builder("measurements").with_fields(fields?);
        let schema = Arc::new(schema.build()?);
        let properties = WriterProperties::builder()
            .set_compression(Compression::UNCOMPRESSED)
            .set_created_by(concat!("vitriol ", env!("CARGO_PKG_VERSION")).into());
        let file = BufWriter::new(file);
        let writer = SerializedFileWriter::new(file, schema, Arc::new(properties.build()));
        Ok(Self {
            writer: writer?,
            rows: columns.iter().map(|_| Vec::new()).collect(),
        })
    }

    fn write_rows(&mut self) -> Result<(), Cause> {
        if self.rows.first().is_none_or(Vec::is_empty) {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.rows {
            let Some(mut writer) = group.next_column()? else {
                break;
            };
            let present: Vec<f64> = column.iter().flatten().copied().collect();
            let levels: Vec<i16> = column.iter().map(|value| value.is_some().into()).collect();
            let typed = writer.typed::<DoubleType>();
            typed.write_batch(&present, Some(&levels), None)?;
            writer.close()?;
            column.clear();
        }
        group.close()?;
        Ok(())
    }
}

impl Table for Parquet {
    fn row(&mut self, columns: &[Column], sample: &Sample) -> Result<(), Cause> {
        for (column, values) in columns.iter().zip(&mut self.rows) {
            values.push(column.value(sample));
        }
        if self.rows.first().is_some_and(|values| values.len() >= ROWS) {
            self.write_rows()?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), Cause> {
        self.write_rows()?;
        let file = self.writer.into_inner()?;
        file.into_inner()
            .map_err(std::io::IntoInnerError::into_error)?;
        Ok(())
    }
}

#[cfg(test)]
#[path = "tests/table.rs"]
mod tests;
