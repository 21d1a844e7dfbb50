//! A tripod close to the glass that matters, for who watches a run while it goes on. It stays at the bench where the film's director
//! (`director.rs`) goes back to a wide shot, and changes its glass less often.

use glam::Vec3;
use vitriol_render::View;
use vitriol_sim::world::World;

use crate::camera::{Camera, Colour, tripod};
use crate::director::{boiling, close_to, followed, poured_into, size};
use crate::failure::Failure;
use crate::run::LastSeen;

/// How long it stays with a glass after the last thing that happened there, s. Our choice: what boils over is seen to its end, and who
/// looks on is not turned about.
const STAYS: f64 = 3.0;
/// Where the glass's middle is in the picture's width: in its middle.
const ACROSS: f32 = 0.5;

/// A tripod close to the glass that matters: where liquid boils or is poured into, else where most liquid is.
#[derive(Debug, Default)]
pub struct CloseUp {
    /// The glass, and where its foot is, smoothed, m in the scene's stage; `None` before liquid is known of.
    glass: Option<(usize, Vec3)>,
    /// Time since something happened there, s.
    since: f64,
}

impl CloseUp {
    /// What is seen of the world now, in pictures of this width over height, `elapsed` seconds after the last look. A scene at another
    /// size is seen from its own tripod, which is close already; so is one without liquid in a whole glass.
    pub fn look(&mut self, world: &World, seen: &LastSeen, elapsed: f64, aspect: f32) -> View {
        let scene = world.scene();
        if scene.scale.length_scale != 1.0 {
            return tripod(scene, aspect);
        }
        let is_there = |flask: &usize| *flask < scene.flasks.len() && !world.is_broken(*flask);
        let now = self.glass.map(|(flask, _)| flask).filter(is_there);
        let happens = boiling(seen).or_else(|| poured_into(world));
        let happens = happens.filter(is_there);
        self.since += elapsed;
        let next = next((now, self.since), happens, fullest(seen, is_there));
        if next.is_none() || next != now {
            self.glass = next.map(|flask| (flask, world.poses()[flask].position));
            self.since = 0.0;
        }
        if next == happens {
            self.since = 0.0;
        }
        let Some((flask, foot)) = &mut self.glass else {
            return tripod(scene, aspect);
        };
        *foot = foot.lerp(world.poses()[*flask].position, followed(elapsed));
        close_to(*foot, size(scene, *flask), 0.0, (aspect, ACROSS))
    }
}

impl Camera {
    /// As [`Camera::shoot`], from another place, and without goggles.
    ///
    /// # Errors
    /// An error of the device.
    pub fn shoot_from(
        &mut self,
        view: View,
        world: &World,
        colour: Colour,
    ) -> Result<Vec<u8>, Failure> {
        let place = std::mem::replace(&mut self.view, view);
        let is_head = std::mem::take(&mut self.is_head);
        let picture = self.shoot(world, colour);
        (self.view, self.is_head) = (place, is_head);
        picture
    }
}

/// The glass to be looked at: the one where something `happens`, once nothing has happened for a while in the one that is looked at now.
fn next(
    (now, since): (Option<usize>, f64),
    happens: Option<usize>,
    fullest: Option<usize>,
) -> Option<usize> {
    let stays = now.filter(|_| since < STAYS);
    stays.or(happens).or(now).or(fullest)
}

/// The glass with most liquid, of those that are there.
fn fullest(seen: &LastSeen, is_there: impl Fn(&usize) -> bool) -> Option<usize> {
    let volume = |flask: usize| seen.flasks[flask].volume;
    (0..seen.flasks.len())
        .filter(is_there)
        .filter(|flask| volume(*flask) > 0.0)
        .max_by(|a, b| volume(*a).total_cmp(&volume(*b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It begins with the fullest glass, goes where something happens, and stays there for 3 s after the last of it.
    #[test]
    fn it_goes_where_something_happens_and_stays_for_a_while() {
        let fullest = Some(1);
        for (now, since, happens, expected) in [
            (None, f64::INFINITY, None, Some(1)),
            (None, f64::INFINITY, Some(0), Some(0)),
            (Some(1), 0.5, Some(0), Some(1)),
            (Some(1), 3.5, Some(0), Some(0)),
            (Some(0), 0.5, None, Some(0)),
            (Some(0), 60.0, None, Some(0)),
            (Some(0), 60.0, Some(0), Some(0)),
        ] {
            let next = next((now, since), happens, fullest);
            assert_eq!(next, expected, "{now:?} for {since} s, {happens:?}");
        }
        assert_eq!(next((None, 0.0), None, None), None);
    }

    /// Glasses that are not there are left out, and so are empty ones.
    #[test]
    fn the_fullest_glass_has_liquid() {
        let held = |volume| vitriol_sim::solver::Held {
            volume,
            ..Default::default()
        };
        let seen = LastSeen {
            flasks: [2e-5, 9e-5, 1e-4].map(held).into(),
            ..LastSeen::default()
        };
        assert_eq!(fullest(&seen, |_| true), Some(2));
        assert_eq!(fullest(&seen, |flask| *flask != 2), Some(1));
        let empty = LastSeen {
            flasks: [0.0, 0.0].map(held).into(),
            ..LastSeen::default()
        };
        assert_eq!(fullest(&empty, |_| true), None);
        assert_eq!(fullest(&LastSeen::default(), |_| true), None);
    }
}
