//! What stands around a lesson's steps on the panel.

use crate::texts::Texts;

impl Texts {
    /// Of the button that asks for a hint.
    pub fn ask_hint(&self) -> String {
        self.panel.hint.text()
    }

    /// Of the button that leaves a step out.
    pub fn skip_step(&self) -> String {
        self.panel.skip.text()
    }

    /// Of the button that says that all is done.
    pub fn finish_lesson(&self) -> String {
        self.panel.finish.text()
    }

    /// How many steps a lesson has.
    pub fn steps_in_all(&self, count: usize) -> String {
        let steps = &self.panel.steps;
        steps.fill(&[("number", &count.to_string())])
    }

    /// How many steps are not shown.
    pub fn more_steps(&self, count: usize) -> String {
        let more = &self.panel.more;
        more.fill(&[("number", &count.to_string())])
    }
}
