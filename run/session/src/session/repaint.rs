//! A picture with another filter of the liquid's surface, made while the one in use is drawn on.

use std::sync::Arc;
use std::thread::JoinHandle;

use vitriol_run::{Blame, Failure};
use vitriol_sim::scene::PictureFilter;
use vitriol_sim::world::World;

use super::benches::Benches;
use super::ended::NoFrameOpen;
use crate::picture::{Eyes, Picture, Subject};

/// Gives the bench a picture with the filter that is wanted.
#[derive(Default)]
pub(super) struct Repainter {
    under_way: Option<Repaint>,
    /// A picture could not be made. It is not tried again: each frame would.
    failed: bool,
}

/// A picture in the making, on a thread of its own: compiling its passes takes longer than a frame.
struct Repaint {
    filter: PictureFilter,
    eyes: Eyes,
    thread: JoinHandle<Result<Picture, Failure>>,
}

impl Repainter {
    /// Whether a picture is being made.
    pub fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// Gives up what is being made: it is of another device or another scene.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Begins to make a picture with that filter, unless the bench has it or it is being made; gives up one
    /// that is no longer wanted.
    pub fn want(&mut self, filter: PictureFilter, benches: &Benches, world: &World) {
        let bench = &benches.current;
        if self.failed || filter == bench.filter() {
            self.under_way = None;
        } else if self.under_way.is_none() {
            let gpu = world.gpu().clone();
            let (library, eyes) = (Arc::clone(&benches.library), benches.eyes.clone());
            let mut scene = world.scene().clone();
            scene.picture.filter = filter;
            let subject = Subject::of(world);
            let of = eyes.clone();
            self.under_way = Some(Repaint {
                filter,
                eyes,
                thread: std::thread::spawn(move || {
                    Picture::new(&gpu, &library, &scene, subject, &of)
                }),
            });
        }
    }

    /// Gives the bench the picture that was being made, if it is ready; the filter that it is drawn with then.
    /// What the lenses hide may have to be uploaded anew, which waits for the device.
    pub fn replace_if_made(
        &mut self,
        benches: &mut Benches,
        _: &NoFrameOpen,
    ) -> Result<Option<PictureFilter>, Failure> {
        let finished = |repaint: &mut Repaint| repaint.thread.is_finished();
        let Some(repaint) = self.under_way.take_if(finished) else {
            return Ok(None);
        };
        let made = repaint.thread.join();
        match made.unwrap_or_else(|_| Err("the picture's builder broke down; report it").other()) {
            Ok(mut picture) => {
                if repaint.eyes.hidden != benches.eyes.hidden {
                    picture.hide(&benches.eyes.hidden)?;
                }
                benches.current.repaint(picture, repaint.filter);
                Ok(Some(repaint.filter))
            }
            Err(failure) => {
                tracing::warn!("the picture stays as it is: {failure}");
                self.failed = true;
                Ok(None)
            }
        }
    }
}
