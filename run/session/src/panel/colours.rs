//! Colours and the size of text on the panel.

use egui::Color32;

/// Least height of text on the panel, pixels: a line of it is seen at 1.2° or more from where one sits or stands, wherever it is
/// on the panel (`lines_are_seen_at_one_degree_and_a_fifth`): three times what print at arm's length has.
pub(super) const TEXT: f32 = 30.0;

pub(crate) const WHITE: Color32 = Color32::from_gray(235);
pub(super) const FAINT: Color32 = Color32::from_gray(165);
pub(crate) const WARNING: Color32 = Color32::from_rgb(255, 176, 60);
pub(super) const RECORDING: Color32 = Color32::from_rgb(255, 132, 122);
pub(super) const GOOD: Color32 = Color32::from_rgb(120, 220, 150);
pub(super) const COLD: Color32 = Color32::from_rgb(80, 150, 230);
/// Ground of the instructor's message and actions.
pub(crate) const SAID: Color32 = Color32::from_rgb(54, 34, 84);
/// Ground of the scene's button that is shown; egui's own is too bright for white text.
pub(super) const CHOSEN: Color32 = Color32::from_rgb(0, 72, 104);
pub(super) const HOT: Color32 = Color32::from_rgb(235, 90, 40);
