//! Silence, and the same bits.

use vitriol_sound::{Event, Mixer};

use crate::sounds::measure::{ahead, pour, render};

#[test]
fn nothing_sounds_like_nothing() {
    let heard = render(&[], 1.0);
    assert!(
        heard
            .iter()
            .all(|it| it[0].to_bits() == 0 && it[1].to_bits() == 0)
    );
}

fn many() -> Vec<Event> {
    let all = (0..40).map(|k| {
        let mut event = ahead(0.03 * f64::from(k), pour(0.05));
        event.emitter = k % 3;
        event.position.x = k as f32 * 0.1 - 2.0;
        event
    });
    all.collect()
}

/// The bits do not depend on how many samples are asked for at once; another seed differs.
#[test]
fn the_same_events_are_the_same_bits() {
    let whole = render(&many(), 1.5);
    for size in [1, 37, 64, 480, 1000] {
        let mut mixer = Mixer::new(1);
        let mut heard = Vec::new();
        let mut events = many().into_iter().peekable();
        while heard.len() < whole.len() {
            // Each event is pushed shortly before its time.
            while let Some(event) = events.next_if(|it| it.time <= mixer.time() + 0.025) {
                mixer.push(event);
            }
            let mut part = vec![[0.0; 2]; size];
            mixer.render(&mut part);
            heard.extend(part);
        }
        let same = |a: &[f32; 2], b: &[f32; 2]| a.map(f32::to_bits) == b.map(f32::to_bits);
        assert!(whole.iter().zip(&heard).all(|(a, b)| same(a, b)), "{size}");
    }
    let mut other = Mixer::new(2);
    many().into_iter().for_each(|event| other.push(event));
    let mut heard = vec![[0.0; 2]; whole.len()];
    other.render(&mut heard);
    assert!(heard != whole);
}

/// The samples of this machine are those of any: a sum of the bits, as it was when this was written (x86-64).
#[test]
fn bits_are_those_of_every_machine() {
    let heard = render(&many(), 1.5);
    let fold = |sum: u64, bits: u32| (sum ^ u64::from(bits)).wrapping_mul(0x0000_0100_0000_01b3);
    let bits = heard.iter().flatten().map(|it| it.to_bits());
    let sum = bits.fold(0xcbf2_9ce4_8422_2325, fold);
    assert_eq!(sum, SUM, "{sum:#x}");
}

const SUM: u64 = 0xb423_7ede_bcc0_58a5;
