//! Dew on glass: what it hides, and what it leaves unchanged.

use crate::rig::{Rig, cylinder, linear, ray};
use crate::steam::even;
use glam::{Affine3A, DVec3, Vec3};
use std::f64::consts::TAU;
use vitriol_render::{Fov, FrameDesc, Panel, SteamSource, View};
use vitriol_shaders::layout::{Dew, Puff};

const EXTENT: [u32; 2] = [320, 240];
const INNER: f64 = 0.04;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
const AROUND: usize = 32;
const PLACES: usize = 512;

/// A cylinder of glass.
fn rig() -> Rig {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_vessels(vec![cylinder([INNER, INNER + 0.002], 0.002, 0.1)]);
    rig
}

/// A level view of its middle from +Z.
fn view() -> View {
    let middle = FOOT + Vec3::Y * 0.05;
    View::look_at(
        middle + Vec3::Z * 0.4,
        middle,
        Fov::symmetric(0.2, 4.0 / 3.0),
    )
}

/// The picture before a panel of one colour, with a film of kg/m² by its angle from +X towards +Z.
fn before(rig: &Rig, colour: u32, film: Option<&dyn Fn(f64) -> f64>) -> Vec<u8> {
    let puffs = rig.filled("puffs", &[Puff::default()]);
    let places = (0..PLACES).map(|place| Dew {
        film: film.map_or(0.0, |film| {
            film(TAU * ((place % AROUND) as f64 + 0.5) / AROUND as f64) as f32
        }),
        ..Dew::default()
    });
    let places: Vec<Dew> = places.collect();
    let dew = rig.filled("dew", &places);
    let image = even(rig, colour);
    let view = view();
    let behind = Affine3A::from_translation(Vec3::new(0.0, 0.0, -0.8));
    let picture = rig.draw(&FrameDesc {
        vessels: &[Affine3A::from_translation(FOOT)],
        steam: Some(SteamSource {
            puffs: &puffs,
            count: 1,
            dew: film.map(|_| &dew),
        }),
        panel: Some(Panel {
            image: &image,
            stage_from_panel: view.stage_from_eye * behind,
            size: [2.0; 2],
        }),
        ..FrameDesc::empty(&[view])
    });
    picture.colour[0].clone()
}

/// By pixel, contrast between a black and a white panel, and the light over the black one, of red.
fn contrast(rig: &Rig, film: Option<&dyn Fn(f64) -> f64>) -> Vec<[f64; 2]> {
    let [black, white] = [0, 0x00ff_ffff].map(|colour| before(rig, colour, film));
    let pairs = black.chunks(4).zip(white.chunks(4));
    pairs
        .map(|(b, w)| [linear(w[0]) - linear(b[0]), linear(b[0])])
        .collect()
}

/// Drops that touch cover 0.55 of each wall (Beysens & Knobler 1986), smaller ones as (their film)^⅔ of that: they touch at
/// a radius of 5 µm, which is ⅔ · 5 µm · 0.55 of water. From aside a hemisphere's shadow is half its disc and half of that foreshortened.
#[test]
fn dew_hides_what_its_drops_cover() {
    let rig = rig();
    let clear = contrast(&rig, None);
    let touches = 2.0 / 3.0 * 5e-6 * 0.55 * 1000.0;
    let near_half = |angle: f64| if angle < 0.5 * TAU { 1.0 } else { 0.0 };
    for (film, walls) in [(4.0 * touches, 2.0), (touches / 8.0, 2.0), (0.3, 1.0)] {
        let all = move |_: f64| film;
        let half = move |angle: f64| film * near_half(angle);
        let of: &dyn Fn(f64) -> f64 = if walls > 1.5 { &all } else { &half };
        let dewy = contrast(&rig, Some(of));
        let cover = 0.55 * (film / touches).powf(2.0 / 3.0).min(1.0);
        let mut tested = 0;
        for (n, (clear, dewy)) in clear.iter().zip(&dewy).enumerate() {
            let along = ray(&view(), EXTENT, n as u32 % EXTENT[0], n as u32 / EXTENT[0]);
            // Where the ray meets the inner cylinder first.
            let origin = DVec3::new(0.0, 0.0, 0.4);
            let (a, b) = (along.x.powi(2) + along.z.powi(2), origin.z * along.z);
            let root = b * b - a * (0.16 - INNER * INNER);
            if root <= 0.0 {
                continue;
            }
            let ways = [-1.0, 1.0].map(|sign| (-b + sign * root.sqrt()) / a);
            let places = ways.map(|way| origin + way * along);
            // Neither rim nor floor, nor the wall's very sides, where reflections take over.
            let high = places.iter().any(|p| p.y.abs() > 0.035);
            let cosine = (along.x * places[0].x + along.z * places[0].z).abs() / INNER;
            if high || cosine < 0.5 {
                continue;
            }
            let depth = -(1.0 - cover).ln() * 0.5 * (1.0 + 1.0 / cosine);
            let expected = (-walls * depth).exp();
            let found = dewy[0] / clear[0];
            // Two levels of 255 of either panel.
            assert!(
                (found - expected).abs() < 0.03,
                "{film}, {cosine}: {found} for {expected}"
            );
            // And the drops are lit.
            assert!(
                dewy[1] > clear[1] + 0.1 * (1.0 - expected),
                "{film}: {dewy:?} {clear:?}"
            );
            tested += 1;
        }
        assert!(tested > 5000, "{tested}");
    }
}

/// Glass without dew has the bits of glass in a frame that has no dew at all.
#[test]
fn glass_without_dew_is_as_it_was() {
    let rig = rig();
    let known = |film| before(&rig, 0x0080_4020, film);
    let none = known(None);
    assert!(none == known(Some(&|_| 0.0)));
    assert!(none != known(Some(&|_| 0.001)));
}
