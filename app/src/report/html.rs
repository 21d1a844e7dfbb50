//! `report.html`: one file that needs nothing but the film beside it.

use maud::{Markup, PreEscaped, html};
use vitriol_lesson::Texts;
use vitriol_run::output::{INCIDENTS_CSV, REPORT_JSON};
use vitriol_run::page::{CURVE_COLOURS, page};
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
                @if told { (self.happened(texts)) } @else { (self.film()) }
                details.solver open[!told] {
                    summary { h2 { "The solver's figures" } }
                    @if told { p.lead { (self.run()) } }
                    (self.figures(texts))
                    (self.whereabouts(texts))
                    (self.plots(texts))
                    (self.statements())
                }
                (self.footer())
            }
            script { (PreEscaped(SCRIPT)) }
        };
        page(&self.heading(texts), STYLE, &body)
    }

    fn header(&self, told: bool, texts: &Texts) -> Markup {
        html! {
            header {
                p.kicker { "Vitriol · replay of a recorded pour" }
                h1 { (self.heading(texts)) }
                @if !told { p.lead { (self.run()) } }
            }
        }
    }

    /// What ran, and on what.
    fn run(&self) -> Markup {
        html! {
            (grouped(self.fluid_particles)) " particles of "
            (with_unit(self.scene.d_m, units::length(self.scene.d_m)))
            " for " (three_digits(self.simulated_s)) " s, on " (self.device.name) "."
            @if self.lost_particles == 0 && self.nan_particles == 0 {
                " None was lost."
            }
        }
    }

    fn figures(&self, texts: &Texts) -> Markup {
        let pace = self.wall_s / self.simulated_s.max(f64::MIN_POSITIVE);
        html! {
            section.figures aria-label="Figures" {
                (figure("density_error_mean", "Density error, mean",
                    &percent(self.density_error_mean), "compression over rest density, over the run", false))
                (figure("density_error_p99", "Density error, 99th percentile",
                    &percent(self.density_error_p99), "worst moment of the run", false))
                (figure("lost_particles", "Lost particles",
                    &grouped(self.lost_particles), "through a wall, the most at any sample",
                    self.lost_particles > 0))
                (figure("nan_particles", "Non-finite particles",
                    &grouped(self.nan_particles), "taken out of the run",
                    self.nan_particles > 0))
                @if let Some(hottest) = self.hottest() {
                    (figure("temperature_max_c", "Highest temperature",
                        &format!("{hottest:.1} °C"), "of a particle at any sample", false))
                }
                @if let Some(ledger) = self.ledger_at_end() {
                    (figure("steam_kg", "Evaporated",
                        &with_unit(ledger.steam_kg, units::mass(ledger.steam_kg)),
                        "water that left as steam", false))
                    @if ledger.spray_fallen_kg > 0.0 {
                        (figure("spray_fallen_kg", "Spattered",
                            &with_unit(ledger.spray_fallen_kg, units::mass(ledger.spray_fallen_kg)),
                            "drops of bubbles that came to rest on glass, table and floor", false))
                    }
                    @let air = ledger.air_kg / AIR_DENSITY;
                    @if air > 0.0 {
                        (figure("air_kg", "Air taken down",
                            &with_unit(air, units::volume(air)),
                            "by streams, which comes up again in bubbles", false))
                    }
                    (figure("ledger_closure", "Ledger",
                        &format!("{:.1e}", ledger.closure.abs()),
                        "enthalpy that does not add up at the end, relative", ledger.closure.abs() > 1e-4))
                }
                @for said in texts.boiling(&self.boiling) {
                    (figure(said.key, &said.name, &said.value, &said.note, false))
                }
                (figure("frames", "Frames",
                    &grouped(self.frames), "of the simulation's fixed clock", false))
                (figure("wall_s", "Time taken",
                    &format!("{} s", three_digits(self.wall_s)),
                    &format!("{} s for each simulated second", three_digits(pace)), false))
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

    fn film(&self) -> Markup {
        html! {
            @if self.film.is_some() {
                section {
                    h2 { "Film" }
                    (self.films())
                }
            }
        }
    }

    /// The film, and that of temperature.
    pub(super) fn films(&self) -> Markup {
        html! {
            @for film in self.film.iter().chain(&self.film_temperature) {
                figure.film {
                    figcaption { (caption(&film.colour)) }
                    video src=(film.path) controls loop playsinline
                        poster=[film.poster.as_deref()] data-cuts=[cuts(film)]
                        width=(film.width) height=(film.height) {}
                }
            }
            @if let Some(film) = &self.film {
                p.note {
                    (film.width) " × " (film.height) ", " (film.fps) " Hz, "
                    (grouped(film.frames))
                    " frames. "
                    @if let Some(left_out) = left_out(film, self.simulated_s) {
                        "Idle moments are left out: " (left_out) " of " (three_digits(self.simulated_s)) " s. "
                    }
                    @if self.attempts.is_empty() { "A click into a plot below goes to that moment." }
                    @else { "A time beside the words goes to that moment, as does a click into a plot." }
                }
            }
        }
    }

    fn whereabouts(&self, texts: &Texts) -> Markup {
        let total = self.mass_kg.total();
        let unit = units::mass(total);
        let share = |kg: f64| if total > 0.0 { kg / total } else { 0.0 };
        html! {
            section {
                h2 { "Where it is at the end" }
                div.bar role="img" aria-label="Shares of the mass by place" {
                    @for (index, (_, kg)) in self.mass_kg.places().enumerate() {
                        @if kg > 0.0 {
                            span class=(colour_class(index))
                                style=(format!("flex-grow:{:.5}", share(kg))) {}
                        }
                    }
                }
                table {
                    thead { tr { th { "Place" } th.number { "Mass" } th.number { "Share" } } }
                    tbody {
                        @for (index, (place, kg)) in self.mass_kg.places().enumerate() {
                            tr {
                                th scope="row" { i class=(colour_class(index)) {} (self.flask(place, texts)) }
                                td.number { (with_unit(kg, unit)) }
                                td.number { (format!("{:.1} %", share(kg) * 100.0)) }
                            }
                        }
                    }
                    tfoot {
                        tr { th scope="row" { "All" } td.number { (with_unit(total, unit)) } td {} }
                    }
                }
            }
        }
    }

    fn plots(&self, texts: &Texts) -> Markup {
        let curve = |label: &str, value: &dyn Fn(&Sample) -> f64| self.curve(label, value);
        let energy = units::energy(self.largest(&|s| s.kinetic_energy_j));
        let mass = units::mass(self.largest(&|s| s.mass_kg.total()));
        let places: Vec<Curve> = self
            .mass_kg
            .places()
            .enumerate()
            .map(|(index, (place, _))| {
                curve(&self.flask(place, texts), &|s| {
                    s.mass_kg.places().nth(index).map_or(f64::NAN, |p| p.1) * mass.factor
                })
            })
            .collect();
        html! {
            section {
                h2 { "Over time" }
                div.plots {
                    (plot("Density error", "%", &[
                        curve("mean", &|s| s.density_error_mean * 100.0),
                        curve("99th percentile", &|s| s.density_error_p99 * 100.0),
                    ]))
                    (plot("Kinetic energy", energy.symbol, &[
                        curve("kinetic energy", &|s| s.kinetic_energy_j * energy.factor),
                    ]))
                    (plot("Mass by place", mass.symbol, &places))
                    @for plotted in self.chemistry().iter().chain(&self.departures(texts)) {
                        (plot(plotted.title, plotted.unit, &plotted.curves))
                    }
                    (plot("Neighbour list rebuilt", "times since the start", &[
                        curve("rebuilds", &|s| s.neighbour_rebuilds as f64),
                    ]))
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
            section.statements {
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
                            (row("Flasks that broke", &grouped(self.counters.flasks_broken)))
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

    /// Name of the flask that the scene's file calls so; another place's name stays as it is.
    pub(super) fn flask(&self, name: &str, texts: &Texts) -> String {
        let mut attempts = self.attempts.iter();
        let of_scene = attempts.rfind(|it| it.scene == self.scene.name);
        match of_scene.filter(|it| it.glass.contains_key(name)) {
            Some(attempt) => texts.flask(&attempt.glass, name),
            None => name.to_owned(),
        }
    }

    fn footer(&self) -> Markup {
        html! {
            footer {
                p { "Made by " (self.program) " with" }
                pre { code { (self.command) } }
                @if let Some(recording) = &self.recording { p { (recording.text()) } }
                p { "Hash of the final state " code { (self.state_hash) } ". All numbers: "
                    a href=(REPORT_JSON) { (REPORT_JSON) } "."
                    @if !self.attempts.is_empty() {
                        " What went wrong, as a table: " a href=(INCIDENTS_CSV) { (INCIDENTS_CSV) } "."
                    }
                }
            }
        }
    }
}

fn figure(key: &str, name: &str, value: &str, note: &str, bad: bool) -> Markup {
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
fn caption(colour: &str) -> String {
    if colour == "liquid" {
        "Liquid in glass; tints, where it has any, are artificial: water bluish, acid yellow"
            .to_owned()
    } else {
        format!("Coloured by {colour}")
    }
}

fn colour_class(index: usize) -> String {
    format!("c{}", index % CURVE_COLOURS.len())
}

fn plot(title: &str, unit: &str, curves: &[Curve]) -> Markup {
    let drawn = over_time(curves);
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
                None => p.note { "Nothing was sampled." }
            }
        }
    }
}
