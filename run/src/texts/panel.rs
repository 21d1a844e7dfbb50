//! Texts of the panel.

use std::collections::BTreeMap;

use serde::Deserialize;

/// Texts of the panel itself.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanelTexts {
    /// Text over buttons that take a hold.
    pub hold: String,
    /// Text of the button that starts a scene anew.
    pub start: String,
    /// Text in the ring that fills meanwhile.
    pub starting: String,
    /// Text of the button that changes to the other order of acid and water.
    pub other_order: String,
    /// Text of the button that brings the bench before the user.
    pub recentre: String,
    /// Text of the button that asks for the summary.
    pub happened: String,
    /// What mouse and keys do where they move the hands, in a line.
    pub mouse: String,
    coming: String,
    ends: String,
    recording: String,
    /// Text for a full disk.
    pub waits: String,
    unwritten: String,
    /// Text for a device that was lost, where another took over.
    pub device_lost: String,
    /// Why time is held: the device is lost and not yet replaced, or the headset is off, not seen yet, or lost.
    pub card_failed: String,
    /// See `card_failed`.
    pub headset_off: String,
    /// See `card_failed`.
    pub headset_unseen: String,
    /// See `card_failed`.
    pub headset_lost: String,
    slow: String,
    missed: String,
    /// State of a flask that broke.
    pub broken: String,
    acid: String,
    poured: String,
    /// Name of water, beside its tint.
    pub water: String,
    /// Name of sulfuric acid, beside its tint.
    pub sulfuric_acid: String,
    /// Note that the tints are artificial.
    pub tints: String,
    /// Texts on liquid beside the flasks.
    pub spilt: SpiltTexts,
    /// Texts on where acid has touched the user.
    pub acid_on: AcidOnTexts,
    /// Texts on the effort of solver and picture.
    pub effort: EffortTexts,
    /// What each scene is, by its name, on its button, in two lines.
    pub(super) button: BTreeMap<String, String>,
}

/// Texts on liquid beside the flasks.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpiltTexts {
    /// Sentence around the places.
    pub text: String,
    /// A volume on the bench.
    pub bench: String,
    /// A volume on the floor.
    pub floor: String,
    /// Separator of two places.
    pub next: String,
    /// The decimal point.
    pub decimal: String,
}

/// Texts on where acid has touched the user.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AcidOnTexts {
    /// Sentence around the places.
    pub text: String,
    /// The left hand.
    pub left: String,
    /// The right hand.
    pub right: String,
    /// The face.
    pub face: String,
    /// Separator of two places.
    pub next: String,
    /// Separator before the last place.
    pub last: String,
}

/// Texts on the effort of solver and picture, where it is less than was asked for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffortTexts {
    /// Sentence around its parts, after a change for the better.
    pub finer: String,
    /// Sentence around its parts, after a change for the worse.
    pub coarser: String,
    /// Substeps and iterations.
    pub solver: String,
    /// Fewer pixels are drawn at the picture's edges.
    pub edges: String,
    /// Another filter draws the liquid's surface.
    pub surface: String,
    /// The picture's size.
    pub picture: String,
    /// The display's rate.
    pub display: String,
    /// Separator of two parts.
    pub next: String,
}

impl PanelTexts {
    /// Text for a scene that is being set up.
    pub fn coming(&self, scene: &str) -> String {
        self.coming.replace("{scene}", scene)
    }

    /// Note that this key ends the session.
    pub fn ends(&self, key: &str) -> String {
        self.ends.replace("{key}", key)
    }

    /// Text for a recording of so many seconds.
    pub fn recording(&self, seconds: u64) -> String {
        let text = (self.recording).replace("{minutes}", &(seconds / 60).to_string());
        text.replace("{seconds}", &format!("{:02}", seconds % 60))
    }

    /// Text for so many steps that could not be recorded.
    pub fn unwritten(&self, steps: u64) -> String {
        self.unwritten.replace("{number}", &steps.to_string())
    }

    /// Text for slow motion at so many per cent of real time.
    pub fn slow(&self, per_cent: u32) -> String {
        self.slow.replace("{percent}", &per_cent.to_string())
    }

    /// Text for so many display periods without a frame.
    pub fn missed(&self, pictures: u64) -> String {
        self.missed.replace("{number}", &pictures.to_string())
    }

    /// Acid by mass, whole per cent.
    pub fn acid(&self, per_cent: i32) -> String {
        self.acid.replace("{percent}", &per_cent.to_string())
    }

    /// A pour under way: mL so far, and mL/s now.
    pub fn poured(&self, volume: &str, rate: &str) -> String {
        self.poured
            .replace("{volume}", volume)
            .replace("{rate}", rate)
    }

    /// What a scene is, in the two lines of its button; of one without a text its name.
    pub fn button<'a>(&'a self, name: &'a str) -> &'a str {
        self.button.get(name).map_or(name, String::as_str)
    }
}
