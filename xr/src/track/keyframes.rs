//! The short text form of a track: keyframes in TOML.
//!
//! ```toml
//! name = "lift"            # name of the track
//! scene = "one-flask"      # scene it is made for, optional
//! seed = 1                 # optional
//! duration = 2.0           # s
//! rate_hz = 90             # frames a second, optional
//!
//! [[head]]
//! t = 0.0                                # s
//! position = [0.0, 1.2, 0.0]             # m, stage frame: Y up, -Z ahead
//! rotation = { pitch = -30.0 }           # degrees; yaw, pitch, roll
//!
//! [[right]]
//! t = 0.5
//! position = [0.0, 0.8, -0.4]
//! rotation = { yaw = -90.0, pitch = 90.0 }
//! squeeze = 1.0
//! ease = "smooth"                        # or "linear", "hold"
//!
//! [[right]]
//! t = 1.5
//! position = [0.0, 1.0, -0.4]            # what is left out stays as it was
//!
//! [[scenario]]
//! t = 1.0
//! key = "scenario"
//! value = "incorrect"
//! ```
//!
//! A rotation is yaw about +Y, then pitch about the turned +X, then roll about the twice
//! turned +Z (R = Ry Rx Rz); the three default to 0. Between keyframes positions go straight
//! and rotations take the shorter arc. `ease` is that of the movement that arrives at its
//! keyframe. Before the first keyframe and after the last one, all stays as it is there.
//!
//! `[pivot]` with `left` or `right = [x, y, z]` (m, grip frame) makes the positions of that
//! hand's keyframes those of a point fixed in the grip frame, such as the lip of the flask
//! that the hand holds. The hand then turns about that point.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DQuat, DVec3};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::ease::Ease;
use super::path::{Key, Path as KeyPath};
use super::{TrackError, check, limits};
use crate::{Switch, files};

/// A track in keyframes, read and checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframes {
    /// Name of the track.
    pub name: String,
    /// Name of the scene that it is made for; empty where there is none.
    pub scene: String,
    /// Seed of the scene's random numbers.
    pub seed: u64,
    /// Length, s; positive.
    pub duration: f64,
    /// Frames a second; positive.
    pub rate_hz: f64,
    pub(super) head: KeyPath,
    /// Left and right; a hand without keys does not exist.
    pub(super) hands: [KeyPath; 2],
    /// Time (s) and switch, ascending.
    pub(super) scenario: Vec<(f64, Switch)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    name: Spanned<String>,
    #[serde(default)]
    scene: String,
    #[serde(default)]
    seed: u64,
    duration: Spanned<f64>,
    #[serde(default = "default_rate")]
    rate_hz: Spanned<f64>,
    #[serde(default)]
    pivot: Pivot,
    // Without any, the message states what a track needs.
    #[serde(default)]
    head: Vec<Spanned<HeadKey>>,
    #[serde(default)]
    left: Vec<Spanned<HandKey>>,
    #[serde(default)]
    right: Vec<Spanned<HandKey>>,
    #[serde(default)]
    scenario: Vec<Spanned<SwitchKey>>,
}

/// The rate of most headsets, Hz.
fn default_rate() -> Spanned<f64> {
    Spanned::new(0..0, 90.0)
}

/// Three numbers.
#[derive(Clone, Copy, Deserialize)]
struct Triple(#[serde(deserialize_with = "exactly")] [f64; 3]);

/// Reads exactly `N` numbers. An array of more, such as one in which 0,5 stands for 0.5, would lose its last ones without a word.
fn exactly<'de, D: Deserializer<'de>, const N: usize>(from: D) -> Result<[f64; N], D::Error> {
    let numbers = Vec::<f64>::deserialize(from)?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| {
        D::Error::custom(format!(
            "has {count} numbers; write {N}, each with a decimal point and no comma in it"
        ))
    })
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Pivot {
    left: Option<Spanned<Triple>>,
    right: Option<Spanned<Triple>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HeadKey {
    t: f64,
    position: Option<Triple>,
    rotation: Option<Rotation>,
    #[serde(default)]
    ease: Ease,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HandKey {
    t: f64,
    position: Option<Triple>,
    rotation: Option<Rotation>,
    squeeze: Option<f64>,
    trigger: Option<f64>,
    #[serde(default)]
    ease: Ease,
}

impl From<HeadKey> for HandKey {
    fn from(key: HeadKey) -> Self {
        Self {
            t: key.t,
            position: key.position,
            rotation: key.rotation,
            squeeze: None,
            trigger: None,
            ease: key.ease,
        }
    }
}

/// By way of a table: a struct would take three numbers of a list too, and a
/// quaternion written here would turn into something else.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(try_from = "BTreeMap<String, f64>")]
struct Rotation {
    yaw: f64,
    pitch: f64,
    roll: f64,
}

impl TryFrom<BTreeMap<String, f64>> for Rotation {
    type Error = String;

    fn try_from(angles: BTreeMap<String, f64>) -> Result<Self, String> {
        let mut rotation = Self::default();
        for (name, angle) in angles {
            match name.as_str() {
                "yaw" => rotation.yaw = angle,
                "pitch" => rotation.pitch = angle,
                "roll" => rotation.roll = angle,
                _ => {
                    return Err(format!(
                        "unknown field `{name}`, expected one of `yaw`, `pitch`, `roll`, degrees"
                    ));
                }
            }
        }
        Ok(rotation)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SwitchKey {
    t: f64,
    key: String,
    value: String,
}

/// Says of a text that is a scene or a lesson which it is, by keys that files of the other kinds do not have.
fn another_kind(text: &str) -> Option<&'static str> {
    let table: toml::Table = text.parse().ok()?;
    let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
    if has(&["duration", "head", "left", "right"]) {
        None
    } else if has(&["modes", "step", "rule", "texts"]) {
        Some("is a lesson and no track; `vitriol lesson FILE` shows it, and --lesson names it")
    } else if has(&["base", "scale", "model", "flask", "liquid"]) {
        Some(
            "is a scene and no track; name it with --scene, as in `vitriol replay TRACK --scene FILE`",
        )
    } else {
        None
    }
}

impl Keyframes {
    /// Reads a keyframe file.
    ///
    /// # Errors
    /// As [`parse`](Self::parse), and [`TrackError::File`] where the file cannot be read.
    pub fn open(file: &Path) -> Result<Self, TrackError> {
        let text = files::read_text(file, "keyframe file", limits::KEYFRAMES)?;
        Self::parse(&text, file)
    }

    /// Reads keyframes from text; `file` is the name for messages.
    ///
    /// # Errors
    /// [`TrackError::KeyframeSyntax`] where the text is no TOML, lacks a key or has an unknown
    /// one; [`TrackError::Keyframe`] where a value cannot be: one that is not finite, times
    /// that do not ascend or lie outside the track, a squeeze outside 0..=1.
    pub fn parse(text: &str, file: &Path) -> Result<Self, TrackError> {
        let document: Document =
            toml::from_str(text).map_err(|error| TrackError::KeyframeSyntax {
                file: file.into(),
                message: another_kind(text)
                    .map_or_else(|| error.to_string().trim_end().to_owned(), str::to_owned),
            })?;
        let reader = Reader {
            text,
            file,
            duration: *document.duration.get_ref(),
        };
        reader.top(&document)?;
        let head = document.head.into_iter().map(|key| {
            let span = key.span();
            Spanned::new(span, HandKey::from(key.into_inner()))
        });
        let head = reader.path("head", head.collect(), None)?;
        if head.keys.is_empty() {
            let problem = "has no keyframe";
            let expected = "a track has at least one [[head]], with t and position";
            return Err(reader.flaw(0, "head", problem, expected));
        }
        let Pivot { left, right } = document.pivot;
        Ok(Self {
            head,
            hands: [
                reader.path("left", document.left, left)?,
                reader.path("right", document.right, right)?,
            ],
            scenario: reader.scenario(document.scenario)?,
            name: document.name.into_inner(),
            scene: document.scene,
            seed: document.seed,
            duration: document.duration.into_inner(),
            rate_hz: document.rate_hz.into_inner(),
        })
    }
}

struct Reader<'a> {
    text: &'a str,
    file: &'a Path,
    duration: f64,
}

impl Reader<'_> {
    fn flaw(
        &self,
        offset: usize,
        field: impl Into<String>,
        problem: impl Into<String>,
        expected: impl Into<String>,
    ) -> TrackError {
        let before = self.text.get(..offset).unwrap_or_default();
        TrackError::Keyframe {
            file: self.file.into(),
            line: before.matches('\n').count() + 1,
            field: field.into(),
            problem: problem.into(),
            expected: expected.into(),
        }
    }

    fn top(&self, document: &Document) -> Result<(), TrackError> {
        if document.name.get_ref().is_empty() {
            let at = document.name.span().start;
            return Err(self.flaw(at, "name", "is empty", "a track has a name"));
        }
        // The upper ends keep a slip of the pen from filling the disk.
        for (field, value, most, unit) in [
            ("duration", &document.duration, 3600.0, "s"),
            ("rate_hz", &document.rate_hz, 1000.0, "Hz"),
        ] {
            let number = *value.get_ref();
            if !(number > 0.0 && number <= most) {
                return Err(self.flaw(
                    value.span().start,
                    field,
                    format!("is {number}"),
                    format!("it is above 0 and at most {most} {unit}"),
                ));
            }
        }
        let frames = document.duration.get_ref() * document.rate_hz.get_ref();
        if frames >= limits::FRAMES as f64 {
            return Err(self.flaw(
                document.duration.span().start,
                "duration",
                format!("makes {frames} frames at rate_hz"),
                format!("at most {} are made", limits::FRAMES),
            ));
        }
        Ok(())
    }

    fn path(
        &self,
        who: &str,
        keys: Vec<Spanned<HandKey>>,
        pivot: Option<Spanned<Triple>>,
    ) -> Result<KeyPath, TrackError> {
        let pivot = match pivot {
            Some(pivot) => {
                let (at, Triple(point)) = (pivot.span().start, pivot.into_inner());
                self.finite(at, &format!("pivot.{who}"), &point)?;
                DVec3::from_array(point)
            }
            None => DVec3::ZERO,
        };
        let mut path = KeyPath {
            keys: Vec::with_capacity(keys.len()),
            pivot,
        };
        for key in keys {
            let at = key.span().start;
            let before = path.keys.last();
            let key = self.key(at, who, key.into_inner(), before)?;
            path.keys.push(key);
        }
        Ok(path)
    }

    fn key(
        &self,
        at: usize,
        who: &str,
        key: HandKey,
        before: Option<&Key>,
    ) -> Result<Key, TrackError> {
        self.time(at, who, key.t, before.map(|before| before.t), false)?;
        let position = match (key.position, before) {
            (Some(Triple(position)), _) => {
                self.finite(at, &format!("{who}.position"), &position)?;
                DVec3::from_array(position)
            }
            (None, Some(before)) => before.position,
            (None, None) => {
                return Err(self.flaw(
                    at,
                    format!("{who}.position"),
                    "is missing",
                    "the first keyframe gives one, [x, y, z] in metres",
                ));
            }
        };
        let rotation = match (key.rotation, before) {
            (Some(Rotation { yaw, pitch, roll }), _) => {
                self.finite(at, &format!("{who}.rotation"), &[yaw, pitch, roll])?;
                DQuat::from_rotation_y(yaw.to_radians())
                    * DQuat::from_rotation_x(pitch.to_radians())
                    * DQuat::from_rotation_z(roll.to_radians())
            }
            (None, Some(before)) => before.rotation,
            (None, None) => DQuat::IDENTITY,
        };
        let share = |field: &str, value: Option<f64>, before: Option<f64>| {
            let value = value.or(before).unwrap_or(0.0);
            if (0.0..=1.0).contains(&value) {
                return Ok(value);
            }
            let field = format!("{who}.{field}");
            Err(self.flaw(at, field, format!("is {value}"), "it lies between 0 and 1"))
        };
        Ok(Key {
            t: key.t,
            position,
            rotation,
            squeeze: share("squeeze", key.squeeze, before.map(|before| before.squeeze))?,
            trigger: share("trigger", key.trigger, before.map(|before| before.trigger))?,
            ease: key.ease,
        })
    }

    fn scenario(&self, keys: Vec<Spanned<SwitchKey>>) -> Result<Vec<(f64, Switch)>, TrackError> {
        let mut switches: Vec<(f64, Switch)> = Vec::with_capacity(keys.len());
        for key in keys {
            let at = key.span().start;
            let SwitchKey { t, key, value } = key.into_inner();
            self.time(at, "scenario", t, switches.last().map(|(t, _)| *t), true)?;
            if key.is_empty() {
                let expected = "a switch names what it switches";
                return Err(self.flaw(at, "scenario.key", "is empty", expected));
            }
            let short = check::switch_texts(&key, &value)
                .and_then(|()| check::totals(switches.len() + 1, 0));
            if let Err(flaw) = short {
                return Err(self.flaw(at, flaw.field, flaw.problem, flaw.expected));
            }
            switches.push((t, Switch { key, value }));
        }
        Ok(switches)
    }

    fn time(
        &self,
        at: usize,
        who: &str,
        t: f64,
        before: Option<f64>,
        may_equal: bool,
    ) -> Result<(), TrackError> {
        let field = format!("{who}.t");
        if !(0.0..=self.duration).contains(&t) {
            return Err(self.flaw(
                at,
                field,
                format!("is {t}"),
                format!("it lies between 0 and the duration, {} s", self.duration),
            ));
        }
        match before {
            Some(before) if t < before || (t == before && !may_equal) => Err(self.flaw(
                at,
                field,
                format!("is {t} after {before}"),
                "keyframes are in the order of time",
            )),
            _ => Ok(()),
        }
    }

    fn finite(&self, at: usize, field: &str, values: &[f64]) -> Result<(), TrackError> {
        match values.iter().find(|value| !(-FAR..=FAR).contains(*value)) {
            None => Ok(()),
            Some(value) => Err(self.flaw(
                at,
                field,
                format!("has {value}"),
                format!("its numbers are finite and at most {FAR}"),
            )),
        }
    }
}

/// Largest coordinate (m) and angle (degrees) accepted. A stage is metres wide; this only
/// catches numbers that would not survive the way to 32 bits.
const FAR: f64 = 1e6;
