//! Subcooled boiling against full boiling, and a stream that pours.

use vitriol_sound::{Bubbles, Sound};

use crate::sounds::measure::{ahead, brightness, mono, pour, render, rms};

fn boil(subcooling: f32, collapses: f32, bursts: f32) -> Vec<f64> {
    let sound = Sound::Bubbles(Bubbles {
        departures: 200.0,
        collapses,
        bursts,
        radius: 2e-3,
        subcooling,
        depth: 0.04,
        density: 998.0,
        lasts: 3.0,
    });
    mono(&render(&[ahead(0.0, sound)], 2.0))
}

/// A kettle is loudest before it boils, and its pitch falls when it does (Aljishi and Tatarkiewicz 1991, Am. J. Phys.
/// 59, 628).
#[test]
fn a_kettle_is_loudest_and_brightest_before_it_boils() {
    let simmers = boil(20.0, 200.0, 0.0);
    let boils = boil(0.0, 0.0, 200.0);
    let louder = rms(&simmers) / rms(&boils);
    // 2 dB, which anyone hears.
    assert!(louder > 1.26, "{louder}");
    let pitch = [brightness(&simmers), brightness(&boils)];
    assert!(pitch[0] > 1.2 * pitch[1], "{pitch:?}");
    assert!(rms(&boils) > 1e-3, "{}", rms(&boils));
}

#[test]
fn more_bubbles_are_louder_as_a_sum_of_what_does_not_cohere() {
    let few = rms(&boil(20.0, 50.0, 0.0));
    let many = rms(&boil(20.0, 800.0, 0.0));
    // √16 = 4; the departures are there in both.
    assert!((3.0..4.5).contains(&(many / few)), "{}", many / few);
}

/// A stream sounds as long as its event lasts, and is silent when it has ended.
#[test]
fn a_stream_lasts_as_long_as_it_says() {
    let heard = mono(&render(&[ahead(0.5, pour(1.0))], 2.5));
    assert!(heard[..23_900].iter().all(|it| *it == 0.0));
    assert!(rms(&heard[24_000..72_000]) > 5e-3);
    // The largest bubble, of 1.4 mm, fades by 80 dB in 40 ms.
    assert!(heard[80_000..].iter().all(|it| *it == 0.0));
}
