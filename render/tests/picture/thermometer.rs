//! A thermometer's scale, read off a picture as a person reads it: by its marks and by its numbers.

use crate::rig::{Rig, linear};
use glam::{Quat, Vec3};
use vitriol_render::{Bone, Finish, Fov, FrameDesc, Scale, View};

/// Length and radius of the stem, and of the scale from end to end, m.
const LENGTH: f32 = 0.26;
const RADIUS: f32 = 0.003;
const SCALE: f32 = 0.236;
/// The marks at its ends, °C, of which each tenth is long.
const ENDS: [f32; 2] = [-10.0, 150.0];
const FOOT: Vec3 = Vec3::new(0.05, 0.8, -0.4);

/// The stem at that reading, turned about its foot.
fn stem(reading: f32, turn: Quat) -> Bone {
    let inside = 0.5 * (LENGTH - SCALE);
    let at = |y: f32| FOOT + turn * (y * Vec3::Y);
    Bone::new(
        Finish::Scale(Scale {
            celsius: ENDS,
            heights: [inside - RADIUS, LENGTH - inside - RADIUS],
            reading,
        }),
        [at(RADIUS), at(LENGTH - RADIUS)],
        [RADIUS; 2],
    )
}

/// The place of a temperature on the stem, by a rule of equal parts.
fn place(celsius: f32, turn: Quat) -> Vec3 {
    let share = (celsius - ENDS[0]) / (ENDS[1] - ENDS[0]);
    FOOT + turn * ((0.5 * (LENGTH - SCALE) + share * SCALE) * Vec3::Y)
}

/// Linear red, green and blue, row by row.
struct Seen {
    extent: [usize; 2],
    light: Vec<[f64; 3]>,
}

impl Seen {
    /// A picture from `eye` past the stem's point `target`, which is `high` metres high there.
    fn of(rig: &Rig, bone: Bone, eye: Vec3, target: Vec3, high: f32) -> Self {
        let [width, height] = rig.extent;
        let field = 2.0 * (0.5 * high / eye.distance(target)).atan();
        let fov = Fov::symmetric(field, width as f32 / height as f32);
        let views = [View::look_at(eye, target, fov)];
        let picture = rig.draw(&FrameDesc {
            tools: &[bone],
            ..FrameDesc::empty(&views)
        });
        if let Some(keep) = std::env::var_os("VITRIOL_KEEP_PICTURES") {
            let Finish::Scale(scale) = bone.finish else {
                panic!("{bone:?}")
            };
            let name = format!("thermometer-{}-{height}-{:.1}.png", scale.reading, eye.y);
            let file = std::path::Path::new(&keep).join(name);
            let colour = image::ColorType::Rgba8;
            image::save_buffer(file, &picture.colour[0], width, height, colour).unwrap();
        }
        let light = picture.colour[0].chunks_exact(4);
        Self {
            extent: rig.extent.map(|side| side as usize),
            light: light.map(|it| [0, 1, 2].map(|n| linear(it[n]))).collect(),
        }
    }

    fn at(&self, x: usize, y: usize) -> [f64; 3] {
        self.light[y * self.extent[0] + x]
    }

    /// Middles of the dark lines that a column of pixels crosses, from below, pixels from the top.
    fn lines(&self, x: usize) -> Vec<f64> {
        let green = |y: usize| self.at(x, y)[1];
        let mut rows: Vec<f64> = (0..self.extent[1]).map(green).collect();
        rows.sort_by(f64::total_cmp);
        let plate = rows[9 * rows.len() / 10];
        let ink = |y: usize| (1.0 - green(y) / plate).max(0.0);
        let mut lines = Vec::new();
        let [mut rows, mut sum, mut moment] = [0.0; 3];
        for y in (0..self.extent[1]).rev() {
            if ink(y) > 0.25 {
                rows += 1.0;
                sum += ink(y);
                moment += ink(y) * (y as f64 + 0.5);
            } else {
                // A mark is two pixels wide; the background is darker than the thermometer's plate as well.
                if (1.0..=6.0).contains(&rows) {
                    lines.push(moment / sum);
                }
                [rows, sum, moment] = [0.0; 3];
            }
        }
        lines
    }

    /// The reading, °C, by the long marks, of which the lowest is −10 °C.
    fn reading(&self) -> f64 {
        let [width, height] = self.extent;
        let is_red = |x: usize, y: usize| {
            let [red, green, blue] = self.at(x, y);
            red > 3.0 * green && red > 3.0 * blue
        };
        let reds = |x: usize| (0..height).filter(|y| is_red(x, *y)).count();
        let column = (0..width).max_by_key(|x| reds(*x)).unwrap();
        let top = (0..height).find(|y| is_red(column, *y)).unwrap() as f64;
        // Beside it, where long marks are crossed and no others.
        let marks = (column..width).map(|x| self.lines(x));
        let even = |lines: &Vec<f64>| {
            let gaps: Vec<f64> = lines.windows(2).map(|pair| pair[0] - pair[1]).collect();
            let mut pairs = gaps.windows(2);
            lines.len() == 17 && pairs.all(|pair| (0.8..1.25).contains(&(pair[1] / pair[0])))
        };
        let mut marks = marks.filter(even);
        let marks = marks.next().unwrap();
        let above = marks.iter().position(|mark| *mark <= top).unwrap_or(16);
        let [low, high] = [marks[above.max(1) - 1], marks[above.max(1)]];
        10.0 * (above.max(1) as f64 - 1.0 + (low - top) / (low - high)) - 10.0
    }
}

/// The column ends at the mark of its reading, seen from before, from above, and while the thermometer leans.
#[test]
fn a_column_ends_at_the_mark_of_its_reading() {
    let rig = Rig::new([260, 1300], 1);
    let leans = Quat::from_rotation_x(-0.5);
    for (reading, up, turn) in [
        (20.0, 0.0, Quat::IDENTITY),
        (37.5, 0.0, Quat::IDENTITY),
        (81.0, 0.15, Quat::IDENTITY),
        (134.0, 0.0, leans),
        (-3.0, 0.15, leans),
    ] {
        let middle = place(70.0, turn);
        // From far away, so that a column of pixels stays where it is on the stem.
        let eye = middle + 10.0 * Vec3::new(0.0, up, 0.4);
        let seen = Seen::of(&rig, stem(reading, turn), eye, middle, 0.28).reading();
        eprintln!("{reading} °C is read as {seen:.2}");
        assert!((seen - f64::from(reading)).abs() < 1.0, "{reading}: {seen}");
    }
    // Beyond the scale it shows the scale's end.
    for (reading, end) in [(-40.0, -10.0), (400.0, 150.0)] {
        let middle = place(70.0, Quat::IDENTITY);
        let eye = middle + 0.4 * Vec3::Z;
        let seen = Seen::of(&rig, stem(reading, Quat::IDENTITY), eye, middle, 0.28).reading();
        assert!((seen - end).abs() < 1.0, "{reading}: {seen}");
    }
}

/// Figures of five by seven points, as displays have them.
const ZERO: [&str; 7] = [
    "01110", "10001", "10001", "10001", "10001", "10001", "01110",
];
const FOUR: [&str; 7] = [
    "00010", "00110", "01010", "10010", "11111", "00010", "00010",
];
const SIX: [&str; 7] = [
    "00110", "01000", "10000", "11110", "10001", "10001", "01110",
];
const EIGHT: [&str; 7] = [
    "01110", "10001", "10001", "01110", "10001", "10001", "01110",
];

/// At the mark of a number stands that number, on its side: what is read upwards runs from left to right on paper.
#[test]
fn numbers_stand_at_their_marks() {
    const HIGH: f32 = 0.014;
    let rig = Rig::new([280, 280], 1);
    for (number, tens) in [(40.0, FOUR), (60.0, SIX), (80.0, EIGHT)] {
        let target = place(number, Quat::IDENTITY);
        let eye = target + 0.25 * Vec3::Z;
        let seen = Seen::of(&rig, stem(20.0, Quat::IDENTITY), eye, target, HIGH);
        // Right of the marks, whose longest end over the axis.
        let pixels = 280.0 / HIGH;
        let [from, to] = [0.09, 0.93].map(|share| 140 + (share * RADIUS * pixels) as usize);
        let dark = |x: usize, y: usize| seen.at(x, y)[1] < 0.5 * seen.at(x, 4)[1];
        let all = (from..to).flat_map(|x| (8..272).map(move |y| [x, y]));
        let ink: Vec<[usize; 2]> = all.filter(|[x, y]| dark(*x, *y)).collect();
        let ends = |n: usize| {
            let along = ink.iter().map(|at| at[n]);
            [along.clone().min().unwrap(), along.max().unwrap() + 1]
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        // Its middle is at the mark.
        let off = (0.5 * (top + bottom) as f64 - 140.0) / f64::from(pixels);
        assert!(off.abs() < 2e-4, "{number}: {off} m");
        let mut wrong = 0;
        for row in 0..7 {
            for along in 0..11 {
                let figure = if along < 5 { tens[row] } else { ZERO[row] };
                let column = along % 6;
                let wanted = column < 5 && figure.as_bytes()[column] == b'1';
                let share = |n: usize, of: usize, a: usize, b: usize| {
                    a as f64 + (n as f64 + 0.5) / of as f64 * (b - a) as f64
                };
                let x = share(row, 7, left, right) as usize;
                let y = share(10 - along, 11, top, bottom) as usize;
                wrong += i32::from(dark(x, y) != wanted);
            }
        }
        eprintln!("{number}: {wrong} of 77 points are not its own");
        assert!(wrong <= 3, "{number}: {wrong}");
    }
}
