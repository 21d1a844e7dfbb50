//! Texts of the panel.

use std::collections::BTreeMap;

use serde::Deserialize;

section!("Texts of the panel itself.", PanelTexts:
    pub String { hold start starting other_order recentre happened mouse waits device_lost card_failed headset_off headset_unseen
        headset_lost broken water sulfuric_acid tints }
    String { coming ends recording unwritten slow missed acid poured }
    pub SpiltTexts { spilt }
    pub AcidOnTexts { acid_on }
    pub EffortTexts { effort }
    pub(super) BTreeMap<String, String> { button });
section!("Texts on liquid beside the flasks.", SpiltTexts: pub String { text bench floor next decimal });
section!("Texts on where acid has touched the user.", AcidOnTexts: pub String { text left right face next last });
section!("Texts on the effort of solver and picture, where it is less than was asked for.", EffortTexts:
    pub String { finer coarser solver edges surface picture display next });

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
