//! The incidents of attempts as a table: CSV (RFC 4180), for a spreadsheet.

use csv::{Terminator, WriterBuilder};

use crate::{Attempt, Cause, Incident, Skin, Surface, What};

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
    let cells = Cells::of(&incident.what);
    let cause = incident.cause.flask();
    let [x, y, z] = incident.place_m;
    let number_of =
        |value: Option<f64>, factor| value.map_or_else(String::new, |it| rounded(it * factor));
    let yes = |value: Option<bool>| {
        value
            .map_or("", |it| if it { "yes" } else { "no" })
            .to_owned()
    };
    [
        number.to_string(),
        spreadsheet_text(&attempt.scene),
        rounded(incident.t_s),
        rounded(incident.until_s),
        cells.kind.to_owned(),
        cause_name(&incident.cause).to_owned(),
        cause.map_or_else(String::new, |it| spreadsheet_text(it)),
        cells
            .flask
            .map_or_else(String::new, |it| spreadsheet_text(it)),
        cells.place.to_owned(),
        number_of(cells.volume_m3, 1e6),
        number_of(cells.acid, 100.0),
        number_of(cells.temperature_c, 1.0),
        number_of(cells.rate_m3_s, 1e6),
        number_of(cells.limit_m3_s, 1e6),
        number_of(cells.speed_m_s, 1.0),
        yes(cells.protected),
        yes(cells.broke),
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
        Cells::of(self).kind
    }
}

/// Cells of a row that depend on the kind of incident.
#[derive(Default)]
struct Cells<'a> {
    kind: &'static str,
    flask: Option<&'a String>,
    place: &'static str,
    volume_m3: Option<f64>,
    acid: Option<f64>,
    temperature_c: Option<f64>,
    rate_m3_s: Option<f64>,
    limit_m3_s: Option<f64>,
    speed_m_s: Option<f64>,
    protected: Option<bool>,
    broke: Option<bool>,
}

impl<'a> Cells<'a> {
    fn of(what: &'a What) -> Self {
        match what {
            What::WaterIntoAcid {
                flask,
                met_acid,
                volume_m3,
            } => Self {
                kind: "water-into-acid",
                flask: Some(flask),
                volume_m3: Some(*volume_m3),
                acid: Some(*met_acid),
                ..Self::default()
            },
            What::PouredTooFast {
                flask,
                rate_m3_s,
                limit_m3_s,
            } => Self {
                kind: "poured-too-fast",
                flask: Some(flask),
                rate_m3_s: Some(*rate_m3_s),
                limit_m3_s: Some(*limit_m3_s),
                ..Self::default()
            },
            What::BoiledOver {
                flask,
                volume_m3,
                acid,
            } => Self {
                kind: "boiled-over",
                flask: Some(flask),
                volume_m3: Some(*volume_m3),
                acid: Some(*acid),
                ..Self::default()
            },
            What::Hot {
                flask,
                temperature_c,
            } => Self {
                kind: "hot",
                flask: Some(flask),
                temperature_c: Some(*temperature_c),
                ..Self::default()
            },
            What::Spilt {
                surface,
                volume_m3,
                acid,
            } => Self {
                kind: "spilt",
                place: match surface {
                    Surface::Bench => "bench",
                    Surface::Floor => "floor",
                },
                volume_m3: Some(*volume_m3),
                acid: Some(*acid),
                ..Self::default()
            },
            What::OnSkin {
                skin,
                volume_m3,
                acid,
                temperature_c,
                protected,
            } => Self {
                kind: "on-skin",
                place: match skin {
                    Skin::LeftHand => "left-hand",
                    Skin::RightHand => "right-hand",
                    Skin::Face => "face",
                },
                volume_m3: Some(*volume_m3),
                acid: Some(*acid),
                temperature_c: *temperature_c,
                protected: Some(*protected),
                ..Self::default()
            },
            What::Dropped {
                flask,
                speed_m_s,
                broke,
            } => Self {
                kind: "dropped",
                flask: Some(flask),
                speed_m_s: Some(*speed_m_s),
                broke: Some(*broke),
                ..Self::default()
            },
        }
    }
}

fn cause_name(cause: &Cause) -> &'static str {
    match cause {
        Cause::Pouring { .. } => "pouring",
        Cause::Boiling { .. } => "boiling",
        Cause::Breaking { .. } => "breaking",
        Cause::LettingGo { .. } => "letting-go",
        Cause::Splashing { .. } => "splashing",
        Cause::Mixing { .. } => "mixing",
        Cause::Swirling { .. } => "swirling",
        Cause::Heating { .. } => "heating",
        Cause::Unknown => "unknown",
    }
}
