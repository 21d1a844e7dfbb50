//! Texts of the label at a desk's pointer.

use serde::Deserialize;
use vitriol_lesson::Template;
use vitriol_sim::scene::ToolKind;

section!("Texts that name what the pointer is at, and say what a press does.", PointedTexts:
    pub String { glove }
    String { rod thermometer cloth goggles gloves sash }
    Template { flask filled button held });

impl PointedTexts {
    /// A flask of that name, with so many whole mL in it; `None` where that is not told.
    pub fn flask(&self, name: &str, millilitres: Option<u32>) -> String {
        match millilitres {
            Some(volume) => {
                let volume = volume.to_string();
                self.filled.fill(&[("name", name), ("volume", &volume)])
            }
            None => self.flask.fill(&[("name", name)]),
        }
    }

    /// A tool.
    pub fn tool(&self, kind: ToolKind) -> &str {
        match kind {
            ToolKind::Rod => &self.rod,
            ToolKind::Thermometer => &self.thermometer,
            ToolKind::Cloth => &self.cloth,
            ToolKind::Goggles => &self.goggles,
            ToolKind::Gloves => &self.gloves,
            ToolKind::Sash => &self.sash,
        }
    }

    /// A button of the panel with that text, that is pressed, or is `held` for a second.
    pub fn button(&self, text: &str, held: bool) -> String {
        let template = if held { &self.held } else { &self.button };
        template.fill(&[("name", text)])
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::texts::Texts;
    use vitriol_lesson::Language;

    #[test]
    fn a_flask_has_its_name_and_volume() {
        let texts = Texts::english().unwrap().pointed;
        let full = texts.flask("Beaker with water", Some(160));
        assert_eq!(full, "Beaker with water, 160 mL: press to take");
        let untold = texts.flask("Beaker", None);
        assert_eq!(untold, "Beaker: press to take");
        let held = texts.button("B   From the start", true);
        assert_eq!(held, "B   From the start: hold for a second");
        assert_eq!(texts.button("H   Hint", false), "H   Hint: press");
    }

    /// In each language each kind of thing has words of its own.
    #[test]
    fn each_thing_has_its_text() {
        for language in Language::ALL {
            let texts = Texts::of(language).unwrap().pointed;
            let tools = ToolKind::ALL.map(|kind| texts.tool(kind));
            let all: BTreeSet<&str> = tools.into_iter().chain([&*texts.glove]).collect();
            assert_eq!(all.len(), ToolKind::ALL.len() + 1, "{language}");
            for volume in [Some(7), None] {
                let said = texts.flask("X", volume);
                assert!(said.contains('X'), "{language}");
                assert_eq!(said.contains('7'), volume.is_some(), "{language}");
            }
            let buttons = [true, false].map(|held| texts.button("X", held));
            assert!(buttons[0] != buttons[1], "{language}");
        }
    }
}
