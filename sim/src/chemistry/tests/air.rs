//! Steam in the room's air, by psychrometric tables and the theory of thermals.

use super::super::puff::{
    AIR_CAPACITY, DROPLET_RADIUS, ENTRAINMENT, Puff, Room, VIRTUAL_MASS, saturation_ratio,
};
use super::super::table::steam_enthalpy;
use std::f64::consts::PI;

const G: f64 = 9.81;

/// Holds air that was `t` °C warm and saturated; then as much of the room's.
fn mixed(t: f64, room: &Room) -> Puff {
    let ratio = saturation_ratio(t);
    let vapour = 2.501e6 + 1860.0 * t;
    let mut puff = Puff::of_steam(ratio, steam_enthalpy(100.0), 0.0, room);
    puff.air = 2.0;
    puff.water = ratio + room.humidity;
    puff.enthalpy = AIR_CAPACITY * t + ratio * vapour + room.enthalpy;
    puff.condense();
    puff
}

#[test]
fn saturated_air_holds_what_the_handbook_says() {
    // ASHRAE Handbook of Fundamentals 2017, chapter 1, table 2: humidity ratio
    // of saturated moist air. Magnus' form and the ideal gas are off by 0.5 %
    // up to 50 °C, and by 4 % at 80 °C, where p − e_s is a difference.
    for (t, ratio, within) in [
        (20.0, 0.014_761, 0.01),
        (30.0, 0.027_333, 0.01),
        (50.0, 0.086_863, 0.01),
        (80.0, 0.545_92, 0.04),
    ] {
        let found = saturation_ratio(t);
        assert!((found / ratio - 1.0).abs() < within, "{t} °C: {found}");
    }
}

#[test]
fn breath_makes_mist_in_the_cold_and_none_in_the_warm() {
    // Saturated at 35 °C, mixed with as much air: at 20 °C and half its
    // humidity mist hardly forms, at −5 °C it does.
    let warm = mixed(35.0, &Room::at(30.0));
    assert_eq!(warm.mist, 0.0);
    let cold = mixed(35.0, &Room::at(-5.0));
    assert!(cold.mist > 0.0);
    // By the same handbook: per kg of dry air the mixture has an enthalpy of
    // (129.45 − 1.85)/2 = 63.8 kJ and 0.0190 kg of water. Saturated air of
    // 21.9 °C has 64.1 kJ and 0.0167 kg: 2.3 g of each kilogram are mist.
    assert!((cold.temperature - 21.8).abs() < 0.5, "{cold:?}");
    assert!((cold.mist / cold.air - 2.3e-3).abs() < 3e-4, "{cold:?}");
}

#[test]
fn enthalpy_and_water_are_those_that_were_taken_in() {
    let room = Room::at(20.0);
    let mut puff = Puff::of_steam(2e-5, steam_enthalpy(105.0), 0.0, &room);
    let (water, enthalpy, air) = (puff.water, puff.enthalpy, puff.air);
    for _ in 0..200 {
        puff.advance(&room, G, 1.0 / 360.0);
        let taken = (puff.air - air) * room.humidity;
        assert!((puff.water - water - taken).abs() < 1e-12);
        // Enthalpy that follows from temperature and mist: five steps of Newton's
        // leave less than 0.05 K.
        let vapour = puff.water - puff.mist;
        let t = puff.temperature;
        let held =
            puff.air * AIR_CAPACITY * t + vapour * (2.501e6 + 1860.0 * t) + puff.mist * 4186.0 * t;
        let wanted = enthalpy + (puff.air - air) * room.enthalpy;
        let capacity = puff.air * AIR_CAPACITY + puff.water * 1860.0;
        assert!(((held - wanted) / capacity).abs() < 0.05, "{puff:?}");
    }
}

#[test]
fn a_thermal_rises_with_the_root_of_time() {
    // r = α z and (1 + k) ρ V w = F t give z⁴ = 3 F t² / (2 π (1 + k) ρ α³) for
    // a thermal whose density is near that of the air. Warm dry air keeps its
    // buoyancy F as it mixes.
    let room = Room::at(20.0);
    let mut puff = Puff::of_steam(1e-9, steam_enthalpy(100.0), 0.0, &room);
    puff.air = 1e-5;
    puff.enthalpy += puff.air * AIR_CAPACITY * 60.0;
    puff.condense();
    let force = G * (room.density * puff.volume() - puff.air - puff.water);
    let height = |t: f64| {
        let moved = (1.0 + VIRTUAL_MASS) * room.density;
        (3.0 * force * t * t / (2.0 * PI * moved * ENTRAINMENT.powi(3))).powf(0.25)
    };
    let mut found = Vec::new();
    for step in 1..=4000 {
        puff.advance(&room, G, 1e-3);
        if step == 1000 || step == 4000 {
            found.push(puff.height);
        }
    }
    // It starts with a size, as if from a point r/α below: the rise between
    // two moments is compared, and that shift with it.
    let wanted = height(4.0) - height(1.0);
    let rise = found[1] - found[0];
    assert!((rise / wanted - 1.0).abs() < 0.05, "{rise} for {wanted}");
}

#[test]
fn steam_turns_to_mist_and_the_mist_vanishes() {
    let room = Room::at(20.0);
    let mut puff = Puff::of_steam(2e-5, steam_enthalpy(100.0), 0.0, &room);
    // 20 mg at 100 °C are 34 mL, and 2 mg of air 2 mL.
    assert!((puff.volume() - 36e-6).abs() < 1e-6, "{puff:?}");
    let mut most: f64 = 0.0;
    for _ in 0..2000 {
        puff.advance(&room, G, 1.0 / 360.0);
        most = most.max(puff.mist / 2e-5);
        // Number of droplets over the sphere's volume, times twice the section
        // of one, times the mean chord, 4r/3.
        let (r, drop) = (puff.radius(), DROPLET_RADIUS);
        let count = puff.mist / (1000.0 * 4.0 / 3.0 * PI * drop.powi(3));
        let per_metre = count / puff.volume() * 2.0 * PI * drop * drop;
        let depth = per_metre * 4.0 / 3.0 * r;
        assert!((puff.optical_depth() - depth).abs() < 1e-12 * depth.max(1.0));
    }
    // Never more than a sixth: see the test below.
    assert!((0.08..0.17).contains(&most), "{most}");
    assert_eq!(puff.mist, 0.0);
    assert!(puff.temperature - room.temperature < 2.0);
}

#[test]
fn a_tenth_of_steam_is_mist_among_ten_times_its_mass_of_air() {
    // 1 kg of steam has 2676 kJ, 10 kg of air at 20 °C and half its humidity
    // 386 kJ: 306 kJ per kg of air, with 0.1073 kg of water. In the handbook's
    // table saturated air has that at 52.1 °C (275.6 kJ and 0.086863 kg at
    // 50 °C, 354.4 kJ and 0.114877 kg at 55 °C), and holds 0.0974 kg.
    let room = Room::at(20.0);
    let mut puff = Puff::of_steam(1.0, steam_enthalpy(100.0), 0.0, &room);
    puff.enthalpy += (10.0 - puff.air) * room.enthalpy;
    puff.air = 10.0;
    puff.water = 1.0 + 10.0 * room.humidity;
    puff.condense();
    assert!((puff.temperature - 52.1).abs() < 0.3, "{puff:?}");
    assert!((puff.mist - 0.099).abs() < 0.02, "{puff:?}");
}
