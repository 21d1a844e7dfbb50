//! The incidents of attempts as a table: CSV (RFC 4180), for a spreadsheet.

use csv::{Terminator, WriterBuilder};

use crate::{Attempt, Cause, Incident, What};

/// Its columns: units are in brackets. A cell that an incident does not have is empty.
const HEADER: [&str; 20] = [
    "attempt",
    "scene",
    "time [s]",
    "until [s]",
    "kind",
    "cause",
    "flask of the cause",
    "flask",
    "where",
    "volume [mL]",
    "acid [%]",
    "temperature [degC]",
    "rate [mL/s]",
    "limit [mL/s]",
    "speed [m/s]",
    "protected",
    "broke",
    "x [m]",
    "y [m]",
    "z [m]",
];

/// Byte order mark, with which each table for a spreadsheet begins: Excel reads one without it in the system's code page.
pub const SPREADSHEET_MARK: &str = "\u{feff}";

/// The table could not be made.
#[derive(Debug, thiserror::Error)]
#[error("the table of incidents could not be made: {0}; is there memory?")]
pub struct TableError(#[from] csv::Error);

/// A row for each incident, attempts and incidents in their order. `attempt` counts from 1.
///
/// # Errors
/// [`TableError`] if the CSV writer fails.
pub fn incidents_csv(attempts: &[Attempt]) -> Result<Vec<u8>, TableError> {
    let mut bytes = SPREADSHEET_MARK.as_bytes().to_vec();
    let mut writer = WriterBuilder::new()
        .terminator(Terminator::CRLF)
        .from_writer(&mut bytes);
    writer.write_record(HEADER)?;
    for (number, attempt) in (1..).zip(attempts) {
        for incident in &attempt.incidents {
            writer.write_record(row(number, attempt, incident))?;
        }
    }
    writer.flush().map_err(csv::Error::from)?;
    drop(writer);
    Ok(bytes)
}

fn row(number: u32, attempt: &Attempt, incident: &Incident) -> [String; HEADER.len()] {
    // Its fields have the names of a recording's `/events`. A field that its kind does not have is null,
    // and so is a value that is no number: both cells are empty.
    let what = serde_json::to_value(&incident.what).unwrap_or_default();
    let text = |field: &str| what[field].as_str().unwrap_or_default();
    let scaled = |field: &str, factor: f64| {
        let value = what[field].as_f64();
        value.map_or_else(String::new, |it| rounded(it * factor))
    };
    let yes = |field: &str| {
        let value = what[field].as_bool();
        value
            .map_or("", |it| if it { "yes" } else { "no" })
            .to_owned()
    };
    let acid = match what["acid"].is_null() {
        true => "met_acid",
        false => "acid",
    };
    let [x, y, z] = incident.place_m;
    [
        number.to_string(),
        spreadsheet_text(&attempt.scene),
        rounded(incident.t_s),
        rounded(incident.until_s),
        incident.what.kind().to_owned(),
        incident.cause.name().to_owned(),
        spreadsheet_text(incident.cause.flask().unwrap_or_default()),
        spreadsheet_text(text("flask")),
        [text("surface"), text("skin")].concat(),
        scaled("volume_m3", 1e6),
        scaled(acid, 100.0),
        scaled("temperature_c", 1.0),
        scaled("rate_m3_s", 1e6),
        scaled("limit_m3_s", 1e6),
        scaled("speed_m_s", 1.0),
        yes("protected"),
        yes("broke"),
        rounded(x),
        rounded(y),
        rounded(z),
    ]
}

/// Six decimals, which is a µs and a µm, without trailing zeros: no reader wants 12.299999999999999.
fn rounded(value: f64) -> String {
    ((value * 1e6).round() / 1e6).to_string()
}

/// A cell with a text that others chose, such as a name from a scene's file. A spreadsheet takes a cell that begins like a formula for one
/// and runs it; behind an apostrophe it is text. (OWASP, "CSV Injection".)
pub fn spreadsheet_text(name: &str) -> String {
    let formula = name.starts_with(['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠']);
    let sign = if formula { "'" } else { "" };
    format!("{sign}{name}")
}

impl What {
    /// Kinds, as [`What::kind`] names them.
    pub const KINDS: [&str; 7] = [
        "water-into-acid",
        "poured-too-fast",
        "boiled-over",
        "hot",
        "spilt",
        "on-skin",
        "dropped",
    ];

    /// Its kind, as in a recording's `/events`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::WaterIntoAcid { .. } => "water-into-acid",
            Self::PouredTooFast { .. } => "poured-too-fast",
            Self::BoiledOver { .. } => "boiled-over",
            Self::Hot { .. } => "hot",
            Self::Spilt { .. } => "spilt",
            Self::OnSkin { .. } => "on-skin",
            Self::Dropped { .. } => "dropped",
        }
    }
}

impl Cause {
    /// Its name, as in a recording's `/events`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Pouring { .. } => "pouring",
            Self::Boiling { .. } => "boiling",
            Self::Breaking { .. } => "breaking",
            Self::LettingGo { .. } => "letting-go",
            Self::Splashing { .. } => "splashing",
            Self::Mixing { .. } => "mixing",
            Self::Swirling { .. } => "swirling",
            Self::Heating { .. } => "heating",
            Self::Unknown => "unknown",
        }
    }
}
