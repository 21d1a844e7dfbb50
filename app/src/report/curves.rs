//! The plots that a scene's chemistry and its flasks have.

use std::collections::BTreeMap;
use std::fmt::Display;

use vitriol_lesson::{Template, Texts};
use vitriol_run::{HeatSample, LedgerSample, Sample, units};

use super::model::Report;
use super::plot::Curve;

/// A plot's title, unit and curves.
pub struct Plotted {
    /// Title.
    pub title: String,
    /// The unit, by its symbol or in words.
    pub unit: String,
    /// Its curves.
    pub curves: Vec<Curve>,
}

impl Report {
    /// What left the flasks and flies above their rims, and what is spilled and
    /// evaporated; of runs in which anything did.
    pub(super) fn departures(&self, texts: &Texts) -> Vec<Plotted> {
        let steam = |s: &Sample| ledger(s).map_or(f64::NAN, |ledger| ledger.steam_kg);
        let mist = |s: &Sample| ledger(s).map_or(f64::NAN, |ledger| ledger.mist_kg);
        let spilled = |s: &Sample| s.mass_kg.table + s.mass_kg.floor;
        let of = |label: &Template, value: &dyn Fn(&Sample) -> f64| {
            (self.curve(label, value), self.largest(value))
        };
        let (plot, words) = (&texts.plot, &texts.curve);
        let mut lost = vec![of(&words.spilled, &spilled)];
        if self.series.iter().any(|sample| ledger(sample).is_some()) {
            lost.push(of(&words.evaporated, &steam));
            lost.push(of(&words.mist, &mist));
        }
        let most = lost.iter().map(|(_, most)| *most).fold(0.0, f64::max);
        let curves = lost.into_iter().map(|(curve, _)| curve).collect();
        [
            self.by_flask(texts, &plot.above_rim, |s| &s.above_rim_kg),
            self.by_flask(texts, &plot.left_flask, |s| &s.left_kg),
            self.scaled(&plot.lost, units::mass(most), most, curves),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Temperature, acid, superheat and ledger; none where no heat is modelled.
    pub(super) fn chemistry(&self, texts: &Texts) -> Vec<Plotted> {
        let first = self.series.iter().find_map(|sample| sample.heat.as_ref());
        let Some(first) = first else {
            return Vec::new();
        };
        let (plot, words) = (&texts.plot, &texts.curve);
        let heat = |label: &Template, value: &dyn Fn(&HeatSample) -> f64| {
            self.curve(label, &|s| s.heat.as_ref().map_or(f64::NAN, value))
        };
        let mut plots = vec![
            Plotted {
                title: plot.temperature.to_string(),
                unit: "°C".into(),
                curves: vec![
                    heat(&words.mean, &|h| h.temperature_mean_c),
                    heat(&words.p99, &|h| h.temperature_p99_c),
                    heat(&words.maximum, &|h| h.temperature_max_c),
                ],
            },
            Plotted {
                title: plot.acid.to_string(),
                unit: plot.by_mass.to_string(),
                curves: vec![
                    heat(&words.mean, &|h| 100.0 * h.acid_mean),
                    heat(&words.least, &|h| 100.0 * h.acid_min),
                    heat(&words.most, &|h| 100.0 * h.acid_max),
                ],
            },
        ];
        if first.superheat_max_k.is_some() {
            plots.push(Plotted {
                title: plot.superheat.to_string(),
                unit: "K".into(),
                curves: vec![heat(&words.superheat, &|h| {
                    h.superheat_max_k
                        .map_or(f64::NAN, |superheat| superheat.max(0.0))
                })],
            });
            plots.push(Plotted {
                title: plot.superheated.to_string(),
                unit: String::new(),
                curves: vec![heat(&words.particles, &|h| {
                    h.boiling_particles.map_or(f64::NAN, |count| count as f64)
                })],
            });
        }
        if first.ledger.is_some() {
            plots.extend(self.ledger(texts));
        }
        plots
    }

    /// Enthalpy, and what of it became what.
    fn ledger(&self, texts: &Texts) -> Vec<Plotted> {
        type Term<'a> = (&'a Template, fn(&LedgerSample) -> f64);
        let (plot, words) = (&texts.plot, &texts.curve);
        let terms: [Term<'_>; 3] = [
            (&words.lost, |l| l.initial_j - l.held_j),
            (&words.given, |l| -l.exchanged_j),
            (&words.steam, |l| l.steam_j),
        ];
        let of = |(label, value): Term<'_>, factor: f64| {
            self.curve(label, &|s| {
                ledger(s).map_or(f64::NAN, |l| factor * value(l))
            })
        };
        let most = |(_, value): Term<'_>| {
            let values = self.series.iter().filter_map(ledger).map(value);
            values.fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let energy = units::energy(terms.into_iter().map(most).fold(0.0, f64::max));
        vec![
            Plotted {
                title: plot.enthalpy.to_string(),
                unit: energy.symbol.into(),
                curves: terms
                    .into_iter()
                    .map(|term| of(term, energy.factor))
                    .collect(),
            },
            Plotted {
                title: plot.bubbles.to_string(),
                unit: "mL".into(),
                curves: vec![
                    of((&words.all, |l| l.bubbles_m3), 1e6),
                    of((&words.foam, |l| l.foam_m3), 1e6),
                ],
            },
            Plotted {
                title: plot.ledger.to_string(),
                unit: plot.millionths.to_string(),
                curves: vec![of((&words.closure, |l| 1e6 * l.closure), 1.0)],
            },
        ]
    }

    /// A curve over the run.
    pub(super) fn curve(&self, label: impl Display, value: &dyn Fn(&Sample) -> f64) -> Curve {
        Curve {
            label: label.to_string(),
            points: self.series.iter().map(|s| (s.t_s, value(s))).collect(),
        }
    }

    /// The largest of its values.
    pub(super) fn largest(&self, value: &dyn Fn(&Sample) -> f64) -> f64 {
        let values = self.series.iter().map(value);
        values.filter(|v| v.is_finite()).fold(0.0, f64::max)
    }

    fn by_flask(
        &self,
        texts: &Texts,
        title: &Template,
        masses: fn(&Sample) -> &BTreeMap<String, f64>,
    ) -> Option<Plotted> {
        let of = |flask: &str, sample: &Sample| masses(sample).get(flask).copied();
        let names = self.mass_kg.flasks.keys();
        let curves: Vec<Curve> = names
            .map(|flask| {
                let named = self.flask(flask, texts);
                self.curve(named, &|s| of(flask, s).unwrap_or(f64::NAN))
            })
            .collect();
        let values = self
            .series
            .iter()
            .flat_map(|sample| masses(sample).values());
        let most = values.copied().fold(0.0, f64::max);
        self.scaled(title, units::mass(most), most, curves)
    }

    /// In a unit; none where all is zero.
    fn scaled(
        &self,
        title: &Template,
        unit: units::Scaled,
        most: f64,
        mut curves: Vec<Curve>,
    ) -> Option<Plotted> {
        let values = curves.iter_mut().flat_map(|curve| &mut curve.points);
        values.for_each(|(_, value)| *value *= unit.factor);
        (most > 0.0).then_some(Plotted {
            title: title.to_string(),
            unit: unit.symbol.into(),
            curves,
        })
    }
}

fn ledger(sample: &Sample) -> Option<&LedgerSample> {
    sample.heat.as_ref()?.ledger.as_ref()
}
