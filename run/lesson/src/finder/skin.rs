//! Acid or hot liquid that touches the user.

use vitriol_sim::bodies::Worn;
use vitriol_sim::solver::{Place, Skin as Part};

use super::amount::{Amount, Bit};
use super::leaving::Leavings;
use super::{Bench, PAUSE, Seen};
use crate::event::{Cause, Event, Skin, What};

/// Liquid that touches one part of the body.
#[derive(Clone, Debug)]
struct Touch {
    amount: Amount,
    cause: Cause,
    /// Whether gloves or goggles kept all of it off the skin.
    protected: bool,
}

/// Contact with liquid, by part of the body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touches {
    open: [Option<Touch>; 3],
}

fn part(skin: Part) -> Skin {
    match skin {
        Part::Left => Skin::LeftHand,
        Part::Right => Skin::RightHand,
        Part::Face => Skin::Face,
    }
}

/// Whether gloves or goggles cover that part. In a scene that has none to put on, everybody counts as wearing them.
fn is_protected(worn: Worn, skin: Part) -> bool {
    let of_hand = |hand: usize| worn.gloves.is_none_or(|on| on[hand]);
    match skin {
        Part::Left => of_hand(0),
        Part::Right => of_hand(1),
        Part::Face => worn.goggles != Some(false),
    }
}

impl Touches {
    pub fn looked(
        &mut self,
        bench: &Bench,
        seen: &Seen<'_>,
        leavings: &Leavings,
        said: &mut Vec<Event>,
    ) {
        let skins = Part::ALL.into_iter().zip(&seen.census.skin);
        for (open, (skin, touching)) in self.open.iter_mut().zip(skins) {
            let came = &touching.came;
            if came.particles == 0 {
                continue;
            }
            let touch = open.get_or_insert_with(|| {
                let flasks = 0..bench.names.len();
                let most = flasks.max_by(|&a, &b| {
                    let [a, b] = [a, b].map(|it| seen.census.moved(Place::Skin(skin), it).volume);
                    a.total_cmp(&b)
                });
                let from =
                    most.filter(|&it| seen.census.moved(Place::Skin(skin), it).particles > 0);
                let cause = from.map(|flask| leavings.cause(bench, flask, seen.t));
                Touch {
                    amount: Amount::at(seen.t),
                    cause: cause.unwrap_or(Cause::Unknown),
                    protected: true,
                }
            });
            touch.protected &= is_protected(seen.worn, skin);
            touch.amount.add(
                seen.t,
                &Bit {
                    volume: bench.volume(came.volume),
                    acid: came.acid,
                    place: came.position,
                    temperature: came.temperature,
                },
            );
        }
        self.close(bench, seen.t, said);
    }

    /// Emits the contacts that are over at `now`, however little liquid: a drop in an eye is enough.
    pub fn close(&mut self, bench: &Bench, now: f64, said: &mut Vec<Event>) {
        for (skin, open) in Part::ALL.into_iter().zip(&mut self.open) {
            let Some(touch) = open.take_if(|it| it.amount.is_over(now, PAUSE)) else {
                continue;
            };
            let Touch {
                amount,
                cause,
                protected,
            } = touch;
            let what = What::OnSkin {
                skin: part(skin),
                volume_m3: amount.volume,
                acid: amount.acid(),
                temperature_c: amount.temperature(),
                protected,
            };
            said.push(amount.incident(bench, what, cause));
        }
    }
}
