//! Results of `vitriol trade`.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use vitriol_run::DeviceStatement;
use vitriol_run::units::{count, percent};

use super::boil::{Quartiles, Seeds};
use super::constants::Change;
use super::order::Convergence;
use super::setting::{Knob, Setting};
use super::tank::{Cost, Rested, Tipped};
use super::vouch::Vouched;
use crate::cli::TradePart;
use crate::merge::{MergeError, Name, alike, devices, in_order};

/// Results of `vitriol trade`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Trade {
    /// The device.
    pub device: DeviceStatement,
    /// Whether it was run with `--quick`.
    pub quick: bool,
    /// The one part, where only one was asked for.
    pub part: Option<TradePart>,
    /// Number of the first case, and number behind the last one.
    pub cases: [usize; 2],
    /// Number of all cases.
    pub of: usize,
    /// The setting whose poured volume is the others' truth, and its pour.
    pub finest: Option<(Setting, Tipped)>,
    /// Settings of the solver, in one vessel of water.
    pub points: Vec<Point>,
    /// Number of settings that were not tried for want of time.
    pub skipped: usize,
    /// The calorimeter under each preset.
    pub calorimetry: Vec<Calorimetry>,
    /// Water poured into acid: presets, the finest setting, and features left out.
    pub boiling: Vec<Seeds>,
    /// Frame times of these runs.
    pub boiling_costs: Vec<Cost>,
    /// Effects of the chemistry's constants.
    pub constants: Vec<Change>,
    /// The finest setting compared with the f64 reference.
    pub vouched: Option<Vouched>,
    /// Effects on a pour of each feature that plain water leaves out.
    pub effects: Vec<Effect>,
    /// Convergence of errors.
    pub orders: Vec<Convergence>,
    /// Wall time, s.
    pub seconds: f64,
}

/// One setting.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// The preset from which one knob was turned.
    pub preset: Name,
    /// The knob.
    pub knob: Knob,
    /// The setting.
    pub setting: Setting,
    /// Δt_s over its limit in the vessel that rests.
    pub stiffness: f64,
    /// Its measurements at rest.
    pub rest: Rested,
    /// Its measurements while it is poured.
    pub pour: Tipped,
    /// Its errors.
    pub errors: Errors,
}

/// Errors of a setting, relative.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Errors {
    /// 99th percentile of the density error at rest.
    pub rest_p99: f64,
    /// 99th percentile of the density error while pouring.
    pub pour_p99: f64,
    /// Error of the poured volume against that of the finest run.
    pub poured: f64,
    /// Error of the height of the centre of mass at rest.
    pub lost_volume: f64,
}

/// A pour with an effect that scenes of water leave out.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Effect {
    /// The effect.
    pub name: Name,
    /// Its measurements at rest.
    pub rest: Rested,
    /// Its measurements while it is poured.
    pub pour: Tipped,
}

/// The calorimeter's result for one mix.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Calorimetry {
    /// The preset.
    pub preset: Name,
    /// Water and acid, mL.
    pub millilitres: [f64; 2],
    /// Temperature at the end, °C, measured and in the table.
    pub temperature: [f64; 2],
    /// Largest relative changes of mass, acid, enthalpy.
    pub drifts: [f64; 3],
}

impl Point {
    /// 99th percentile of the time, ms, that a ninetieth of a second takes, at rest or poured, whichever is more: settings of other frame
    /// times have as many frames in it as they need.
    pub fn cost(&self) -> f64 {
        let frames = 1.0 / 90.0 / self.setting.frame_time;
        frames * self.rest.cost.p99_ms.max(self.pour.cost.p99_ms)
    }
}

/// Merges the reports of parts.
///
/// # Errors
/// [`MergeError`] where they are not of one call, or cases are missing or in two of them.
pub fn merge(mut parts: Vec<(PathBuf, Trade)>) -> Result<Trade, MergeError> {
    alike(&parts, "--quick", |it| it.quick.to_string())?;
    alike(&parts, "--part", |it| format!("{:?}", it.part))?;
    alike(&parts, "a number of cases,", |it| it.of.to_string())?;
    let of = parts.first().map_or(0, |(_, part)| part.of);
    let range = |part: &Trade| part.cases[0]..part.cases[1];
    in_order(&mut parts, range, Some(0)..Some(of))?;
    let mut all = Trade {
        device: devices(parts.iter().map(|(_, part)| &part.device)),
        cases: [0, of],
        of,
        ..Trade::default()
    };
    for (_, part) in parts {
        (all.quick, all.part) = (part.quick, part.part);
        all.finest = all.finest.or(part.finest);
        all.vouched = all.vouched.or(part.vouched);
        all.points.extend(part.points);
        all.calorimetry.extend(part.calorimetry);
        all.boiling.extend(part.boiling);
        all.boiling_costs.extend(part.boiling_costs);
        all.constants.extend(part.constants);
        all.effects.extend(part.effects);
        all.orders.extend(part.orders);
        all.skipped += part.skipped;
        all.seconds += part.seconds;
    }
    Ok(all)
}

/// A name, and a function that reads the error.
type NamedError = (&'static str, fn(&Errors) -> f64);

impl Errors {
    /// Name and reader of each error.
    pub const ALL: [NamedError; 4] = [
        ("density error at rest, 99th percentile", |e| e.rest_p99),
        ("density error while pouring, 99th percentile", |e| {
            e.pour_p99
        }),
        ("poured volume", |e| e.poured),
        ("lost volume", |e| e.lost_volume.abs()),
    ];
}

/// Tables as text for people.
pub fn describe(trade: &Trade) -> String {
    let mut t = format!(
        "{}, {}\n\npreset     knob                   setting                                             \
         \u{20}       n   ms p99     rest   signed pressure     pour   poured     lost Δt/limit\n",
        trade.device.name, trade.device.driver
    );
    for point in &trade.points {
        let e = &point.errors;
        t += &format!(
            "{:<10} {:<22} {:<52} {:>8} {:>8.3} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8.2}\n",
            point.preset,
            point.knob.name(),
            point.setting.label(),
            point.rest.particles,
            point.cost(),
            percent(e.rest_p99),
            percent(point.rest.density_signed),
            point.rest.pressure.map_or("-".into(), percent),
            percent(e.pour_p99),
            percent(e.poured),
            percent(e.lost_volume),
            point.stiffness
        );
    }
    if let Some((setting, tipped)) = &trade.finest {
        t += &format!(
            "finest: {}, {:.2} mL poured, {:.2} mL in the end by geometry\n",
            setting.label(),
            1e6 * tipped.poured,
            1e6 * tipped.in_the_end
        );
    }
    for row in &trade.calorimetry {
        let [water, acid] = row.millilitres;
        let [own, table] = row.temperature;
        t += &format!(
            "calorimeter, {}: {water} and {acid} mL end at {own:.2} °C, the table's {table:.1}\n",
            row.preset
        );
    }
    for seeds in &trade.boiling {
        let show = |Quartiles([low, middle, high]): &Quartiles| {
            format!("{middle:.3} ({low:.3} to {high:.3})")
        };
        t += &format!(
            "{}, {} seeds: superheat {} K, onset {} s, thrown {} g, steam {} g, mean {} °C\n",
            seeds.name,
            seeds.seeds.len(),
            show(&seeds.superheat),
            show(&seeds.onset),
            show(&seeds.thrown),
            show(&seeds.steam),
            show(&seeds.temperature)
        );
    }
    if !trade.constants.is_empty() {
        t += &super::constants::describe(&trade.constants);
    }
    if let Some(v) = &trade.vouched {
        t += &format!(
            "f64 and device, {} particles after {} s: density error p99 {} and {}, centre of mass \
             {:.4} and {:.4} mm, at most {:.4} mm apart\n",
            v.particles,
            v.seconds,
            percent(v.density_p99[0]),
            percent(v.density_p99[1]),
            1e3 * v.centre[0],
            1e3 * v.centre[1],
            1e3 * v.apart
        );
    }
    for effect in &trade.effects {
        t += &format!(
            "{}: {:.3} mL poured; density error p99 {} at rest, {} while pouring; rms speed at \
             rest {:.4} m/s; a frame {:.3} ms\n",
            effect.name,
            1e6 * effect.pour.poured,
            percent(effect.rest.density_p99),
            percent(effect.pour.density_p99),
            effect.rest.speed,
            effect.pour.cost.median_ms
        );
    }
    for found in &trade.orders {
        let (name, by, order) = (&found.name, &found.by, found.order);
        t += &format!("{name} over {by}: order {order:.2}\n");
    }
    if trade.skipped > 0 {
        t += &format!(
            "not tried for want of time: {}\n",
            count(trade.skipped as u64, "setting")
        );
    }
    let [first, end] = trade.cases;
    if end - first < trade.of {
        t += &format!("cases {first}..{end} of {}\n", trade.of);
    }
    t += &format!("{:.0} s\n", trade.seconds);
    t
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::trade::boil::{Boiled, quartiles};
    use crate::trade::constants::CONSTANTS;

    /// A report with one of everything, with numbers that JSON does not have.
    fn one_of_each() -> Trade {
        let scene = vitriol_sim::scene::Scene::builtin("beaker").unwrap();
        let setting = Setting::of(&scene, vitriol_sim::scene::Preset::Fast);
        let cost = Cost::of(&[]);
        let rest = Rested {
            particles: 7,
            cost,
            density_mean: 0.1,
            density_p99: 0.3,
            density_signed: -1.0 / 3.0,
            lost_volume: 1e-17,
            speed: 0.0,
            pressure: None,
        };
        let pour = Tipped {
            cost,
            density_p99: 0.2,
            poured: 48e-6,
            in_the_end: 1e-4,
            lost: 0,
        };
        let boiled = Boiled {
            superheat: f64::NEG_INFINITY,
            temperature: f64::NAN,
            ..Boiled::default()
        };
        let seeds = Seeds::of("balanced".into(), vec![boiled]);
        assert!(quartiles(&[]).0[0].is_nan());
        Trade {
            of: 1,
            cases: [0, 1],
            part: Some(TradePart::Solver),
            finest: Some((setting, pour)),
            points: vec![Point {
                preset: "fast".into(),
                knob: Knob::FrameTime,
                setting,
                stiffness: 0.9,
                rest,
                pour,
                errors: Errors {
                    rest_p99: 0.1,
                    pour_p99: 0.2,
                    poured: 0.3,
                    lost_volume: 0.4,
                },
            }],
            calorimetry: vec![Calorimetry {
                preset: "fast".into(),
                millilitres: [10.0, 100.0],
                temperature: [75.0, 75.5],
                drifts: [0.0, 1e-9, 2e-9],
            }],
            boiling: vec![seeds.clone()],
            boiling_costs: vec![cost],
            constants: vec![Change {
                constant: Some(CONSTANTS[3]),
                value: 0.1,
                times: 2.0,
                seeds,
            }],
            effects: vec![Effect {
                name: "as it is".into(),
                rest,
                pour,
            }],
            ..Trade::default()
        }
    }

    #[test]
    fn a_report_that_is_read_and_written_again_has_the_same_bytes() {
        let written = serde_json::to_string(&one_of_each()).unwrap();
        let read: Trade = serde_json::from_str(&written).unwrap();
        assert_eq!(serde_json::to_string(&read).unwrap(), written);
        let merged = merge(vec![("a.json".into(), read)]).unwrap();
        assert_eq!(serde_json::to_string(&merged).unwrap(), written);
        let other = written.replace("nuclei_spacing", "nuclei");
        assert!(serde_json::from_str::<Trade>(&other).is_err());
    }

    #[test]
    fn parts_are_put_together_in_their_order() {
        let part = |cases: [usize; 2], names: &[&'static str]| {
            let effect = |name: &&'static str| Effect {
                name: (*name).into(),
                ..one_of_each().effects[0].clone()
            };
            Trade {
                cases,
                of: 3,
                effects: names.iter().map(effect).collect(),
                ..Trade::default()
            }
        };
        let (a, b) = (part([0, 2], &["x", "y"]), part([2, 3], &["z"]));
        let both = || vec![("b.json".into(), b.clone()), ("a.json".into(), a.clone())];
        let merged = merge(both()).unwrap();
        let names: Vec<&str> = merged.effects.iter().map(|it| &*it.name).collect();
        assert_eq!((names, merged.cases), (vec!["x", "y", "z"], [0, 3]));
        let mut other = both();
        other[1].1.quick = true;
        assert!(merge(other).unwrap_err().to_string().contains("--quick"));
    }
}
