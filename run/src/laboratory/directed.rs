//! A laboratory whose film is led by a director.

use glam::Vec3;
use vitriol_sim::scene::Scene;

use super::Laboratory;
use crate::camera::{Camera, Colour};
use crate::director::Director;
use crate::failure::Failure;
use crate::inset::Inset;

/// The director of a scene's film, where one was asked for.
pub(super) fn director(asked: bool, scene: &Scene, camera: Option<&Camera>) -> Option<Director> {
    camera
        .filter(|_| asked)
        .and_then(|camera| Director::of(scene, camera.view))
}

impl Laboratory {
    /// Has the director place the camera, and the first second of boiling kept for its inset; `hands` are their places, m near the scene's
    /// own origin.
    pub(super) fn direct(&mut self, hands: [Vec3; 2], frame_time: f64) -> Result<(), Failure> {
        let (Some(director), Some(camera)) = (&mut self.director, &mut self.film) else {
            return Ok(());
        };
        let world = &self.run.world;
        let events = self.run.events();
        director.observe(world, (self.run.seen(), events), hands, frame_time);
        let [width, height] = camera.renderer.extent();
        camera.view = director.view(world.scene(), width as f32 / height as f32);
        let wanted = self.colours.first() == Some(&Colour::Liquid) && Inset::fits([width, height]);
        let (Some((from, flask)), true, Some(shot)) = (director.boils(), wanted, self.shot) else {
            return Ok(());
        };
        if self.inset.is_none() {
            let place = (flask, self.run.seen().flasks[flask].volume);
            let inset = Inset::of(world, &self.shaders, shot, place, from)?;
            self.inset = Some(inset);
        }
        if let Some(inset) = &mut self.inset {
            inset.take(world, (camera, director.turned()), director.time())?;
        }
        Ok(())
    }
}
