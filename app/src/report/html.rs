//! `report.html`: one file that needs nothing but the film beside it.

use std::fmt::Display;

use maud::{Markup, PreEscaped, html};
use vitriol_lesson::{Template, Texts};
use vitriol_run::output::{INCIDENTS_CSV, REPORT_JSON};
use vitriol_run::page::{CURVE_COLOURS, page_in};
use vitriol_run::units::{self, grouped, percent, three_digits, with_unit};
use vitriol_run::{Cut, LedgerSample, Sample};

use super::model::{FilmStatement, Report};
use super::plot::{Curve, Plot, over_time};

/// Density of air at 20 °C and one atmosphere, kg/m³.
const AIR_DENSITY: f64 = 1.204;

const SCRIPT: &str = include_str!("report.js");
pub(super) const STYLE: &str = include_str!("report.css");

impl Report {
    /// The report as a web page: what happened comes first, where anybody looked for it, and the solver's figures are folded below.
    /// Every string in it is escaped.
    pub fn to_html(&self, texts: &Texts) -> String {
        let told = !self.attempts.is_empty();
        let body = html! {
            main {
                (self.header(told, texts))
                @if told { (self.happened(texts)) } @else { (self.film(texts)) }
                details.solver open[!told] {
                    summary { h2 { (texts.report.solver) } }
                    @if told { p.lead { (self.run(texts)) } }
                    (self.figures(texts))
                    (self.whereabouts(texts))
                    (self.plots(texts))
                    (self.statements())
                }
                (self.footer(texts))
            }
            script { (PreEscaped(SCRIPT)) }
        };
        page_in(texts.language().code(), &self.heading(texts), STYLE, &body)
    }

    fn header(&self, told: bool, texts: &Texts) -> Markup {
        html! {
            header {
                p.kicker { (texts.report.kicker) }
                h1 { (self.heading(texts)) }
                @if !told { p.lead { (self.run(texts)) } }
            }
        }
    }

    /// What ran, and on what.
    fn run(&self, texts: &Texts) -> Markup {
        let ran = texts.report.ran.fill(&[
            ("particles", &grouped(self.fluid_particles)),
            (
                "size",
                &texts.with_decimal(&with_unit(self.scene.d_m, units::length(self.scene.d_m))),
            ),
            ("time", &texts.with_decimal(&three_digits(self.simulated_s))),
            ("device", &self.device.name),
        ]);
        html! {
            (ran)
            @if self.lost_particles == 0 && self.nan_particles == 0 { " " (texts.report.none_lost) }
        }
    }

    fn figures(&self, texts: &Texts) -> Markup {
        let pace = self.wall_s / self.simulated_s.max(f64::MIN_POSITIVE);
        let words = &texts.figure;
        let pace = texts.with_decimal(&three_digits(pace));
        let pace = words.wall_s_note.fill(&[("pace", &pace)]);
        html! {
            section.figures aria-label=(texts.report.figures) {
                (figure(texts, "density_error_mean", &words.density_error_mean,
                    &percent(self.density_error_mean), &words.density_error_mean_note, false))
                (figure(texts, "density_error_p99", &words.density_error_p99,
                    &percent(self.density_error_p99), &words.density_error_p99_note, false))
                (figure(texts, "lost_particles", &words.lost_particles,
                    &grouped(self.lost_particles), &words.lost_particles_note,
                    self.lost_particles > 0))
                (figure(texts, "nan_particles", &words.nan_particles,
                    &grouped(self.nan_particles), &words.nan_particles_note,
                    self.nan_particles > 0))
                @if let Some(hottest) = self.hottest() {
                    (figure(texts, "temperature_max_c", &words.temperature_max_c,
                        &format!("{hottest:.1} °C"), &words.temperature_max_c_note, false))
                }
                @if let Some(ledger) = self.ledger_at_end() {
                    (figure(texts, "steam_kg", &words.steam_kg,
                        &with_unit(ledger.steam_kg, units::mass(ledger.steam_kg)),
                        &words.steam_kg_note, false))
                    @if ledger.spray_fallen_kg > 0.0 {
                        (figure(texts, "spray_fallen_kg", &words.spray_fallen_kg,
                            &with_unit(ledger.spray_fallen_kg, units::mass(ledger.spray_fallen_kg)),
                            &words.spray_fallen_kg_note, false))
                    }
                    @let air = ledger.air_kg / AIR_DENSITY;
                    @if air > 0.0 {
                        (figure(texts, "air_kg", &words.air_kg,
                            &with_unit(air, units::volume(air)), &words.air_kg_note, false))
                    }
                    (figure(texts, "ledger_closure", &words.ledger_closure,
                        &format!("{:.1e}", ledger.closure.abs()),
                        &words.ledger_closure_note, ledger.closure.abs() > 1e-4))
                }
                @for said in texts.boiling(&self.boiling) {
                    (figure(texts, said.key, &said.name, &said.value, &said.note, false))
                }
                (figure(texts, "frames", &words.frames, &grouped(self.frames), &words.frames_note, false))
                (figure(texts, "wall_s", &words.wall_s, &format!("{} s", three_digits(self.wall_s)), &pace, false))
            }
        }
    }

    fn hottest(&self) -> Option<f64> {
        let heats = self.series.iter().filter_map(|sample| sample.heat.as_ref());
        heats.map(|heat| heat.temperature_max_c).reduce(f64::max)
    }

    fn ledger_at_end(&self) -> Option<&LedgerSample> {
        self.series.last()?.heat.as_ref()?.ledger.as_ref()
    }

    fn film(&self, texts: &Texts) -> Markup {
        html! {
            @if self.film.is_some() {
                section {
                    h2 { (texts.report.film) }
                    (self.films(texts))
                }
            }
        }
    }

    /// The film, and that of temperature.
    pub(super) fn films(&self, texts: &Texts) -> Markup {
        let report = &texts.report;
        html! {
            @for film in self.film.iter().chain(&self.film_temperature) {
                figure.film {
                    figcaption { (caption(&film.colour, texts)) }
                    video src=(film.path) controls loop playsinline
                        poster=[film.poster.as_deref()] data-cuts=[cuts(film)]
                        width=(film.width) height=(film.height) {}
                }
            }
            @if let Some(film) = &self.film {
                p.note {
                    (report.frames.fill(&[
                        ("width", &film.width.to_string()),
                        ("height", &film.height.to_string()),
                        ("rate", &film.fps.to_string()),
                        ("frames", &grouped(film.frames)),
                    ])) " "
                    @if let Some(idle) = left_out(film, self.simulated_s) {
                        @let whole = three_digits(self.simulated_s);
                        (report.idle.fill(&[
                            ("idle", &texts.with_decimal(&idle)),
                            ("whole", &texts.with_decimal(&whole)),
                        ])) " "
                    }
                    @if self.attempts.is_empty() { (report.click) } @else { (report.click_words) }
                }
            }
        }
    }

    fn whereabouts(&self, texts: &Texts) -> Markup {
        let report = &texts.report;
        let total = self.mass_kg.total();
        let unit = units::mass(total);
        let share = |kg: f64| if total > 0.0 { kg / total } else { 0.0 };
        html! {
            section {
                h2 { (report.whereabouts) }
                div.bar role="img" aria-label=(report.shares) {
                    @for (index, (_, kg)) in self.mass_kg.places().enumerate() {
                        @if kg > 0.0 {
                            span class=(colour_class(index))
                                style=(format!("flex-grow:{:.5}", share(kg))) {}
                        }
                    }
                }
                table {
                    thead { tr { th { (report.place) } th.number { (report.mass) } th.number { (report.share) } } }
                    tbody {
                        @for (index, (place, kg)) in self.mass_kg.places().enumerate() {
                            tr {
                                th scope="row" { i class=(colour_class(index)) {} (self.place(place, texts)) }
                                td.number { (texts.with_decimal(&with_unit(kg, unit))) }
                                td.number { (texts.with_decimal(&format!("{:.1} %", share(kg) * 100.0))) }
                            }
                        }
                    }
                    tfoot {
                        tr { th scope="row" { (report.all) } td.number { (texts.with_decimal(&with_unit(total, unit))) } td {} }
                    }
                }
            }
        }
    }

    fn plots(&self, texts: &Texts) -> Markup {
        let (titles, words) = (&texts.plot, &texts.curve);
        let curve = |label: &Template, value: &dyn Fn(&Sample) -> f64| self.curve(label, value);
        let energy = units::energy(self.largest(&|s| s.kinetic_energy_j));
        let mass = units::mass(self.largest(&|s| s.mass_kg.total()));
        let places: Vec<Curve> = self
            .mass_kg
            .places()
            .enumerate()
            .map(|(index, (place, _))| {
                self.curve(self.place(place, texts), &|s| {
                    s.mass_kg.places().nth(index).map_or(f64::NAN, |p| p.1) * mass.factor
                })
            })
            .collect();
        html! {
            section {
                h2 { (texts.report.over_time) }
                div.plots {
                    (plot(&titles.density_error, "%", &[
                        curve(&words.mean, &|s| s.density_error_mean * 100.0),
                        curve(&words.p99, &|s| s.density_error_p99 * 100.0),
                    ], texts))
                    (plot(&titles.kinetic_energy, energy.symbol, &[
                        curve(&words.kinetic_energy, &|s| s.kinetic_energy_j * energy.factor),
                    ], texts))
                    (plot(&titles.by_place, mass.symbol, &places, texts))
                    @for plotted in self.chemistry(texts).iter().chain(&self.departures(texts)) {
                        (plot(&plotted.title, &plotted.unit, &plotted.curves, texts))
                    }
                    (plot(&titles.rebuilt, &titles.times.to_string(), &[
                        curve(&words.rebuilds, &|s| s.neighbour_rebuilds as f64),
                    ], texts))
                }
            }
        }
    }

    fn statements(&self) -> Markup {
        let scene = &self.scene;
        let solver = &self.solver;
        let models = if scene.models.is_empty() {
            "incompressible flow only".to_owned()
        } else {
            scene.models.join(", ")
        };
        let scale = if scene.length_scale == 1.0 {
            "1 (real size)".to_owned()
        } else {
            three_digits(scene.length_scale)
        };
        html! {
            // For who knows the solver, in English.
            section.statements lang="en" {
                div {
                    h2 { "Scene and solver" }
                    table { tbody {
                        (row("Scene", &scene.name))
                        (row("Track", &self.track))
                        (row("Preset, seed", &format!("{}, {}", self.preset, self.seed)))
                        (row("Particle diameter d", &with_unit(scene.d_m, units::length(scene.d_m))))
                        (row("Support radius h/d", &three_digits(scene.h_over_d)))
                        (row("Frame time Δt_f", &format!("{} ms", three_digits(scene.frame_time_s * 1e3))))
                        (row("Substeps × iterations", &format!("{} × {}", solver.substeps, solver.iterations)))
                        (row("Relaxation ω", &three_digits(solver.omega)))
                        (row("Boundary", &solver.boundary))
                        (row("Gravity g", &format!("{} m/s²", three_digits(scene.gravity_m_s2))))
                        (row("Length scale", &scale))
                        (row("Modelled", &models))
                    } }
                }
                div {
                    h2 { "Device" }
                    table { tbody {
                        (row("Name", &self.device.name))
                        (row("Driver", &self.device.driver))
                        (row("Vulkan", &self.device.api))
                    } }
                    h2 { "Counted" }
                    table { tbody {
                        (row("Substeps", &grouped(self.counters.substeps)))
                        @if self.counters.flasks_broken > 0 {
                            (row("Vessels that broke", &grouped(self.counters.flasks_broken)))
                        }
                        @if self.counters.solver_changes > 0 {
                            (row("Changes of substeps and iterations", &grouped(self.counters.solver_changes)))
                        }
                        (row("Neighbour list rebuilt", &grouped(self.counters.neighbour_rebuilds)))
                        @for (name, times) in &self.counters.limiters {
                            (row(&format!("Limiter: {name}"), &grouped(*times)))
                        }
                    } }
                    @if self.counters.limiters.values().all(|times| *times == 0) {
                        p.note { "No limiter acted." }
                    }
                }
            }
        }
    }

    /// What was done, or the scene's title where acid and water did not come together.
    fn heading(&self, texts: &Texts) -> String {
        let done = texts.done(&self.attempts);
        done.unwrap_or_else(|| texts.scene(&self.scene.name).to_owned())
    }

    /// Name of a place of liquid: a flask, or what is beside them.
    fn place(&self, name: &str, texts: &Texts) -> String {
        let report = &texts.report;
        match name {
            _ if self.mass_kg.flasks.contains_key(name) => self.flask(name, texts),
            "table" => report.table.to_string(),
            "floor" => report.floor.to_string(),
            "air" => report.air.to_string(),
            other => other.to_owned(),
        }
    }

    /// Name of the flask that the scene's file calls so; another place's name stays as it is.
    pub(super) fn flask(&self, name: &str, texts: &Texts) -> String {
        let mut attempts = self.attempts.iter();
        let of_scene = attempts.rfind(|it| it.scene == self.scene.name);
        match of_scene.filter(|it| it.glass.contains_key(name)) {
            Some(attempt) => texts.flask(&attempt.glass, name),
            None => name.to_owned(),
        }
    }

    fn footer(&self, texts: &Texts) -> Markup {
        let report = &texts.report;
        html! {
            footer {
                p { (report.made_by.fill(&[("program", &self.program)])) }
                pre { code { (self.command) } }
                @if let Some(recording) = &self.recording { p lang="en" { (recording.text()) } }
                p { (report.hash) " " code { (self.state_hash) } ". "
                    (report.numbers) " " a href=(REPORT_JSON) { (REPORT_JSON) } "."
                    @if !self.attempts.is_empty() {
                        " " (report.incidents) " " a href=(INCIDENTS_CSV) { (INCIDENTS_CSV) } "."
                    }
                }
            }
        }
    }
}

fn figure(
    texts: &Texts,
    key: &str,
    name: &dyn Display,
    value: &str,
    note: &dyn Display,
    bad: bool,
) -> Markup {
    let (name, note) = (name.to_string(), note.to_string());
    let value = texts.with_decimal(value);
    html! {
        div.figure.bad[bad] {
            p.name { (name) }
            p.value data-key=(key) { (value) }
            p.note { (note) }
        }
    }
}

fn row(name: &str, value: &str) -> Markup {
    html! { tr { th scope="row" { (name) } td { (value) } } }
}

/// A film's cuts as its page's script reads them: pairs of the film's time and the run's, s.
fn cuts(film: &FilmStatement) -> Option<String> {
    let pair = |cut: &Cut| format!("{:.4},{:.4}", cut.film_s, cut.t_s);
    let pairs: Vec<String> = film.cuts.iter().map(pair).collect();
    (film.cuts.len() > 1).then(|| pairs.join(" "))
}

/// Simulated time that a film does not show, of a run of so many seconds.
fn left_out(film: &FilmStatement, simulated_s: f64) -> Option<String> {
    let shown = film.frames as f64 / f64::from(film.fps);
    (film.cuts.len() > 1).then(|| format!("{:.1}", simulated_s - shown))
}

/// What a film shows.
fn caption(colour: &str, texts: &Texts) -> String {
    let report = &texts.report;
    match colour {
        "liquid" => report.liquid.to_string(),
        "speed" => report.speed.to_string(),
        "temperature" => report.temperature.to_string(),
        "acid" => report.acid.to_string(),
        other => other.to_owned(),
    }
}

fn colour_class(index: usize) -> String {
    format!("c{}", index % CURVE_COLOURS.len())
}

fn plot(title: &dyn Display, unit: &str, curves: &[Curve], texts: &Texts) -> Markup {
    let title = title.to_string();
    let drawn = over_time(curves, texts);
    html! {
        figure.plot {
            figcaption {
                strong { (title) } " " span.unit { (unit) }
                @if curves.len() > 1 {
                    ul.legend {
                        @for (index, curve) in curves.iter().enumerate() {
                            li { i class=(colour_class(index)) {} (curve.label) }
                        }
                    }
                }
            }
            @match drawn {
                Some(Plot { svg, span, time }) => {
                    div.canvas data-left=(span.0) data-right=(span.1)
                        data-from=(time.0) data-to=(time.1) {
                        (PreEscaped(svg))
                    }
                }
                None => p.note { (texts.report.unsampled) }
            }
        }
    }
}
