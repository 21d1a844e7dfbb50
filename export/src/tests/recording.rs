use glam::DVec3;

use super::*;

/// matplotlib's "plasma" begins with #0d0887 and ends with #f0f921.
#[test]
fn particles_are_coloured_by_temperature() {
    let particles = Particles {
        id: vec![0, 1, 2],
        temperature: vec![20.0, 100.0, 150.0],
        ..Particles::default()
    };
    let found = colours(&particles, ColourBy::Temperature(20.0, 100.0), 1.0);
    let (first, last) = ([0x0d, 0x08, 0x87, 255], [0xf0, 0xf9, 0x21, 255]);
    assert_eq!(found, [first, last, last]);
}

/// Speeds are the stage's, and the range is the scene's, which may be drawn smaller.
#[test]
fn speeds_are_compared_in_one_unit() {
    let particles = Particles {
        id: vec![0, 1],
        velocity: vec![DVec3::ZERO, DVec3::X],
        ..Particles::default()
    };
    let found = colours(&particles, ColourBy::Speed(20.0), 0.05);
    let map = ColourBy::Speed(20.0).map();
    let expected = [0.0, 1.0].map(|place| {
        let [red, green, blue] = map.at(place).map(|part| (255.0 * part).round() as u8);
        [red, green, blue, 255]
    });
    assert_eq!(found, expected);
}
