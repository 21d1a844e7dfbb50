//! Labels on the panel around a lesson's steps.

use crate::texts::Texts;

impl Texts {
    /// Label of the button that asks for a hint.
    pub fn ask_hint(&self) -> String {
        self.panel.hint.text()
    }

    /// Label of the button that leaves a step out.
    pub fn skip_step(&self) -> String {
        self.panel.skip.text()
    }

    /// Label of the button that ends the lesson.
    pub fn finish_lesson(&self) -> String {
        self.panel.finish.text()
    }

    /// Label with the number of steps of a lesson.
    pub fn steps_in_all(&self, count: usize) -> String {
        let steps = &self.panel.steps;
        steps.fill(&[("number", &count.to_string())])
    }

    /// Label with the number of steps that are not shown.
    pub fn more_steps(&self, count: usize) -> String {
        let more = &self.panel.more;
        more.fill(&[("number", &count.to_string())])
    }
}
