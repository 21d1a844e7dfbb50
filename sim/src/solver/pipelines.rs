//! The passes, specialised for the features of a scene.

use super::buffers::LENT;
use super::colour::Colour;
use super::dormant;
use super::grid::Grid;
use super::lanes;
use super::sleep;
use super::vapour::dew_places;
use super::vessels::PLANE_ENTRIES;
use super::wall_heat;
use super::{SolverError, SolverSpec};
use crate::chemistry::evaporation::StillAir;
use crate::chemistry::paper::{Boiling, REFERENCE_POWER};
use crate::chemistry::table::{INTERVALS, SolutionTable};
use crate::chemistry::thomsen::JOULES_PER_CALORIE;
use crate::chemistry::{ACID_DIFFUSIVITY, Chemistry, Paper, Physical, THERMAL_DIFFUSIVITY};
use crate::parameters::Parameters;
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Pass, Recorder};
use vitriol_shaders::{Binding, BindingKind, Library, ShaderId, sim};

/// Part of the list's reach that a prediction may use up; the rest is left
/// for the substep's corrections.
const REACH_OF_PREDICTION: f64 = 0.8;

/// Compiled passes, named as their shaders.
pub(super) struct Pipelines {
    /// Where flasks can be lifted.
    pub(super) carry: Option<SolverPass>,
    /// Where there are tools.
    pub(super) handle: Option<SolverPass>,
    /// Stops particles that fly at the fume hood's sash; where there are tools.
    pub(super) pane: Option<SolverPass>,
    /// Stops drops at the sash as `pane` stops particles; where there are tools, and bubbles throw up drops.
    pub(super) pane_spray: Option<SolverPass>,
    /// Where liquid may sleep: which does, at a frame's start, and what keeps it awake, at its end.
    pub(super) sleep: Option<[SolverPass; 2]>,
    pub(super) predict: SolverPass,
    /// Where there are bubbles.
    pub(super) cavity: Option<SolverPass>,
    pub(super) cell_count: SolverPass,
    pub(super) cell_scan: SolverPass,
    pub(super) reorder: SolverPass,
    pub(super) list: SolverPass,
    /// Displaces by the carried multipliers.
    pub(super) carried_displacement: SolverPass,
    pub(super) first_multiplier: SolverPass,
    pub(super) multiplier: SolverPass,
    pub(super) displacement: SolverPass,
    /// Displacement of a substep's last iteration, which goes on to lines 22 to 25.
    pub(super) last_displacement: SolverPass,
    /// Of the physical chemistry, before its exchange.
    pub(super) turnover: Option<SolverPass>,
    /// `diffusion` of the paper's chemistry, or `exchange` of the physical one.
    pub(super) mixing: Option<SolverPass>,
    /// Where the scene has vorticity confinement.
    pub(super) vorticity: Option<SolverPass>,
    /// Where the scene has surface tension.
    pub(super) tension: Option<Tension>,
    pub(super) forces: SolverPass,
    /// Forces of a frame's last substep, which do not go on to the next prediction.
    pub(super) last_forces: SolverPass,
    /// Where vapour is in bubbles.
    pub(super) live: Option<SolverPass>,
    pub(super) bubbles: Option<SolverPass>,
    /// Where the drops that they throw up are followed.
    pub(super) spray: Option<SolverPass>,
    /// The physical chemistry's eddies at a frame's end: the flow's filter, and its strain.
    pub(super) eddies: Vec<SolverPass>,
    /// Where heat is lost to flasks.
    pub(super) glass: Option<SolverPass>,
    pub(super) load: SolverPass,
    pub(super) density: SolverPass,
}

/// Surface tension's, in their order.
pub(super) struct Tension {
    pub(super) colour: SolverPass,
    pub(super) rim: SolverPass,
    pub(super) walls: SolverPass,
    pub(super) smooth: SolverPass,
    pub(super) interface: SolverPass,
    pub(super) unfiltered: SolverPass,
    pub(super) curvature: SolverPass,
    pub(super) push: SolverPass,
}

impl Pipelines {
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        spec: &SolverSpec<'_>,
        constants: &Constants,
        buffers: &[&Buffer],
    ) -> Result<Self, SolverError> {
        let carry = flag(spec.parameters.carry_rate > 0.0);
        // Where multipliers were carried, the prediction is displaced already when the first iteration reads it. That lies in memory
        // that is unused until the last displacement.
        let displaced = [("trial", "new_velocity")];
        let displaced = &displaced[..usize::from(carry > 0.0)];
        let spacing = spec.parameters.particle_volume().cbrt();
        let sleeps = sleep::is_on(&spec.parameters, spec.flasks.len());
        // Lists of liquid that sleeps stay while the others are made anew.
        let items = [("cell_items", "cell_items")];
        let items = &items[..usize::from(sleeps)];
        let make = |shader, extra: &[_]| constants.pass(gpu, library, buffers, shader, extra);
        let make_with = |shader, extra: &[_], names: &[_]| {
            constants.pass_with(gpu, library, buffers, shader, extra, names)
        };
        let vorticity = match spec.parameters.vorticity {
            0.0 => None,
            _ => Some(make(sim::VORTICITY, &[])?),
        };
        let tension = match spec.parameters.surface {
            None => None,
            Some(_) => Some(Tension {
                colour: make(sim::COLOUR, &[])?,
                rim: make(sim::COLOUR_RIM, &[])?,
                walls: make(sim::COLOUR_WALLS, &[])?,
                smooth: make(sim::SMOOTH_COLOUR, &[])?,
                interface: make(sim::INTERFACE, &[])?,
                unfiltered: make(sim::UNFILTERED_CURVATURE, &[])?,
                curvature: make(sim::CURVATURE, &[])?,
                push: make(sim::TENSION, &[])?,
            }),
        };
        let (turnover, mixing) = match spec.parameters.chemistry {
            None => (None, None),
            Some(Chemistry::Paper(_)) => (None, Some(make(sim::DIFFUSION, &[])?)),
            Some(Chemistry::Physical(_)) => (
                Some(make(sim::TURNOVER, &[])?),
                Some(make(sim::EXCHANGE, &[])?),
            ),
        };
        let lanes = lanes::of_bubbles(gpu, constants.lanes());
        let of_bubbles = |shader| match spec.parameters.bubbles() {
            None => Ok(None),
            Some(_) => make(shader, &[("LANES", lanes.into())]).map(Some),
        };
        Ok(Self {
            carry: spec.loads.then(|| make(sim::CARRY, &[])).transpose()?,
            handle: (spec.tools)
                .then(|| make(sim::HANDLE, &[("SPACING", spacing)]))
                .transpose()?,
            pane: (spec.tools)
                .then(|| make(sim::PANE, &[("SPACING", spacing)]))
                .transpose()?,
            pane_spray: match spec.parameters.bubbles() {
                Some(bubbles) if bubbles.spray && spec.tools => Some(make(sim::PANE_SPRAY, &[])?),
                _ => None,
            },
            sleep: sleeps
                .then(|| Ok::<_, SolverError>([make(sim::SLEEP, &[])?, make(sim::CALM, &[])?]))
                .transpose()?,
            predict: make(sim::PREDICT, &[])?,
            cell_count: make_with(sim::CELL_COUNT, &[], items)?,
            cell_scan: make(sim::CELL_SCAN, &[])?,
            reorder: make_with(sim::REORDER, &[], items)?,
            list: make(sim::LIST, &[])?,
            carried_displacement: make_with(
                sim::DISPLACEMENT,
                &[("APPLY_CARRIED", 1.0)],
                &[("solved", "trial"), ("trial", "new_velocity")],
            )?,
            first_multiplier: make_with(
                sim::MULTIPLIER,
                &[("FIRST", 1.0), ("CARRY", carry)],
                displaced,
            )?,
            multiplier: make(sim::MULTIPLIER, &[])?,
            displacement: make(sim::DISPLACEMENT, &[])?,
            last_displacement: make(sim::DISPLACEMENT, &[("COMMIT", 1.0), ("CARRY", carry)])?,
            turnover,
            mixing,
            vorticity,
            tension,
            forces: make(sim::FORCES, &[("PREDICT", 1.0)])?,
            last_forces: make(sim::FORCES, &[])?,
            cavity: of_bubbles(sim::CAVITY)?,
            live: of_bubbles(sim::LIVE)?,
            bubbles: of_bubbles(sim::BUBBLES)?,
            spray: match spec.parameters.bubbles() {
                Some(bubbles) if bubbles.spray => Some(make(sim::SPRAY, &[])?),
                _ => None,
            },
            eddies: eddies(gpu, library, spec, constants, buffers)?,
            glass: match wall_heat::ring_count(
                spec.parameters.chemistry.as_ref(),
                spec.flasks.len(),
            ) {
                0 => None,
                _ => Some(make(sim::GLASS, &[])?),
            },
            load: make(sim::LOAD, &[])?,
            density: make(sim::DENSITY, &[])?,
        })
    }
}

/// The passes that find the eddies: smoothing, then strain; empty where eddies do not mix.
fn eddies(
    gpu: &Gpu,
    library: &Library,
    spec: &SolverSpec<'_>,
    constants: &Constants,
    buffers: &[&Buffer],
) -> Result<Vec<SolverPass>, SolverError> {
    let mixing = match &spec.parameters.chemistry {
        Some(Chemistry::Physical(physical)) if physical.mixing.turbulence > 0.0 => physical.mixing,
        _ => return Ok(Vec::new()),
    };
    let (passes, share) = mixing.smoothing(spec.parameters.support_radius);
    // Between frames these two are free; each pass reads what the one before wrote.
    let memory = |pass: u32| {
        if pass.is_multiple_of(2) {
            "solved"
        } else {
            "new_velocity"
        }
    };
    let make = |shader, pass: u32| {
        let names = [("flow", memory(pass + 1)), ("smoothed", memory(pass))];
        let own = [("SHARE", share), ("FIRST", flag(pass == 0))];
        let own = if shader == sim::SMOOTH {
            &own[..]
        } else {
            &own[1..]
        };
        constants.pass_with(gpu, library, buffers, shader, own, &names)
    };
    let smoothing = (0..passes).map(|pass| make(sim::SMOOTH, pass));
    smoothing
        .chain([make(sim::STRAIN, passes)])
        .collect::<Result<_, _>>()
}

/// Constants of the paper's chemistry.
fn of_paper(paper: &Paper, p: &Parameters) -> Vec<(&'static str, f64)> {
    let mut own = vec![("HEAT", 1.0), ("CALM", flag(p.viscosity > 0.0))];
    if let Some(dilution) = &paper.dilution {
        let per_joule = dilution.heat_generation / JOULES_PER_CALORIE;
        own.extend([
            ("DILUTION", 1.0),
            ("AMBIENT", dilution.ambient),
            ("HEAT_DIFFUSION", dilution.heat_diffusivity),
            ("ACID_DIFFUSION", dilution.acid_diffusivity),
            ("HEATING", per_joule * p.particle_mass()),
        ]);
    }
    if let Some(boiling) = &paper.boiling {
        own.extend([
            ("BOILING", 1.0),
            ("BOILING_POINT", boiling.boiling_point),
            ("BOILING_POWER", REFERENCE_POWER),
            ("LITERAL_BOILING", flag(boiling.law == Boiling::Literal)),
        ]);
    }
    own
}

/// Constants of the physical chemistry.
fn of_physical(physical: &Physical, p: &Parameters) -> Vec<(&'static str, f64)> {
    let mut own = vec![
        ("HEAT", 1.0),
        ("PHYSICAL", 1.0),
        ("CALM", flag(p.viscosity > 0.0)),
        ("SOLUTION_INTERVALS", INTERVALS as f64),
        ("REST_DENSITY", p.rest_density),
        ("SPACING", p.spacing),
        ("DENSITY", flag(physical.density)),
        ("VISCOSITY", flag(physical.viscosity)),
        (
            "EDDY_AREA",
            physical.mixing.turbulence * physical.mixing.width.powi(2),
        ),
        ("ACID_DIFFUSIVITY", ACID_DIFFUSIVITY),
        ("THERMAL_DIFFUSIVITY", THERMAL_DIFFUSIVITY),
        // Without eddies none are noted.
        (
            "DORMANT_TURNOVER",
            flag(p.dormant && physical.mixing.turbulence > 0.0),
        ),
        ("TURNOVER_RATE", dormant::turnover_rate(p)),
    ];
    own.push(("EVAPORATION", flag(physical.evaporates())));
    if let Some(time) = physical.superheat_time {
        own.push(("SUPERHEAT_TIME", time));
    }
    if let Some(bubbles) = physical.bubbles {
        own.extend([
            ("BUBBLES", 1.0),
            ("DORMANT_BUBBLES", flag(p.dormant)),
            ("SLOTS", bubbles.slots().into()),
            ("SPRAY", flag(bubbles.spray)),
            ("AIR", flag(bubbles.air)),
            ("NUCLEUS_PRESSURE", bubbles.nucleus_pressure(p.spacing)),
            ("FOAM_TIME", bubbles.foam_time.unwrap_or_default()),
            ("GRAVITY", glam::DVec3::from(p.gravity).length()),
        ]);
    }
    if let Some(lamella) = physical.lamella {
        own.extend([
            ("SEGREGATION", 1.0),
            ("LAMELLA", lamella),
            ("FEED", physical.feed),
        ]);
    }
    if let Some(losses) = &physical.losses {
        own.extend([
            ("LOSSES", 1.0),
            ("AMBIENT", losses.ambient),
            (
                "AIR_VAPOUR",
                StillAir::at(&SolutionTable::new(), losses.ambient).vapour(),
            ),
            ("SPECIFIC_VOLUME", 1.0 / p.rest_density),
            ("GLASS_LOSS", losses.glass / p.rest_density),
            ("SURFACE_LOSS", losses.surface / p.rest_density),
        ]);
    }
    own
}

fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}

/// Names and values of the override constants, of which each shader declares some.
pub(super) struct Constants(Vec<(&'static str, f64)>);

impl Constants {
    /// The last argument: invocations that share a particle, those that search its neighbours, and those of a workgroup.
    pub(super) fn new(
        spec: &SolverSpec<'_>,
        count: u32,
        grid: &Grid,
        [lanes, list_lanes, group]: [u32; 3],
    ) -> Self {
        let p = &spec.parameters;
        let reach = p.list_reach * p.support_radius;
        let mut all = vec![
            ("COUNT", f64::from(count)),
            ("FRAME_TIME", p.frame_time),
            (
                "TURNOVER_GROUPS",
                f64::from(dormant::turnover_groups(count, lanes, group)),
            ),
            ("LIST_CAPACITY", f64::from(grid.list_capacity)),
            ("PLACES", (grid.places(count) / 4) as f64),
            ("LONG_FOURS", (grid.long(count) / 4) as f64),
            ("LANES", f64::from(lanes)),
            ("LIST_LANES", f64::from(list_lanes)),
            ("GROUP", f64::from(group)),
            ("SUPPORT", p.support_radius),
            ("VOLUME", p.particle_volume()),
            ("MASS", p.particle_mass()),
            ("MARGIN", p.margin),
            ("MAX_SPEED", p.max_speed),
            ("GRAVITY_X", p.gravity[0]),
            ("GRAVITY_Y", p.gravity[1]),
            ("GRAVITY_Z", p.gravity[2]),
            ("VISCOUS", flag(p.viscosity > 0.0)),
            ("CONFINEMENT", p.vorticity),
            ("CELL", grid.cell),
            ("CELL_BITS_X", f64::from(grid.bits[0])),
            ("CELL_BITS_Y", f64::from(grid.bits[1])),
            ("CELL_BITS_Z", f64::from(grid.bits[2])),
            ("CELL_ITEMS", f64::from(grid.cell_items(count))),
            ("CELL_GROUPS", f64::from(grid.blocks())),
            ("LIST_SLACK", reach * REACH_OF_PREDICTION),
            ("LIST_REACH", reach),
            ("FLASKS", spec.flasks.len() as f64),
            ("SOLIDS", flag(spec.solids.is_some())),
            ("LOADS", flag(spec.loads)),
            ("CONSTRAINT", flag(spec.constraint)),
            ("DEW", flag(dew_places(p, spec.flasks.len()) > 0)),
            ("PLANE_COUNT", PLANE_ENTRIES as f64),
            ("FLOOR", spec.ground.floor),
        ];
        if let Some((top, centre, size)) = spec.ground.table {
            all.extend([
                ("TABLE", 1.0),
                ("TABLE_TOP", top),
                ("TABLE_UNDER", spec.ground.table_under(top)),
                ("TABLE_X", centre.x),
                ("TABLE_Z", centre.y),
                ("TABLE_HALF_X", 0.5 * size.x),
                ("TABLE_HALF_Z", 0.5 * size.y),
            ]);
        }
        all.extend(sleep::constants(spec));
        if let Some(surface) = &p.surface {
            all.extend(Colour::new(p, count).constants(p, surface));
        }
        match &p.chemistry {
            None => {}
            Some(Chemistry::Paper(paper)) => all.extend(of_paper(paper, p)),
            Some(Chemistry::Physical(physical)) => all.extend(of_physical(physical, p)),
        }
        Self(all)
    }

    /// Invocations that share a particle.
    fn lanes(&self) -> u32 {
        let lanes = self.0.iter().find(|(name, _)| *name == "LANES");
        lanes.map_or(1, |&(_, lanes)| lanes as u32)
    }

    /// These and `more`.
    pub(super) fn and(&self, more: &[(&'static str, f64)]) -> Self {
        Self([&self.0, more].concat())
    }

    /// The pass of `shader`, with the constants that it declares and `extra`; `buffers` are those of
    /// [`SolverPass::begin`].
    pub(super) fn pass(
        &self,
        gpu: &Gpu,
        library: &Library,
        buffers: &[&Buffer],
        shader: ShaderId,
        extra: &[(&'static str, f64)],
    ) -> Result<SolverPass, SolverError> {
        self.pass_with(gpu, library, buffers, shader, extra, &[])
    }

    /// The pass of `shader` as from [`Constants::pass`], with buffers renamed: each of `names` is (name in the shader, label of the
    /// buffer that is bound to it).
    pub(super) fn pass_with(
        &self,
        gpu: &Gpu,
        library: &Library,
        buffers: &[&Buffer],
        shader: ShaderId,
        extra: &[(&'static str, f64)],
        names: &[(&str, &str)],
    ) -> Result<SolverPass, SolverError> {
        let declared = library.constants(&shader)?;
        let mut own = self.0.clone();
        own.retain(|(name, _)| declared.iter().any(|known| known == name));
        own.extend(extra);
        let compiled = library.compile(&shader, "main", &own)?;
        let place_of = |binding: &Binding| {
            let name = binding.name.as_str();
            let mut lent = names.iter().chain(&LENT);
            let label = lent
                .find(|(own, _)| *own == name)
                .map_or(name, |(_, label)| label);
            let place = buffers.iter().position(|buffer| buffer.label() == label);
            let place = place.ok_or_else(|| GpuError::Binding {
                pass: compiled.label.clone(),
                binding: binding.name.clone(),
                cause: "the solver has no buffer of this name; add it in solver/buffers.rs or name another"
                    .to_owned(),
            })?;
            let writable = binding.kind == BindingKind::Storage { writable: true };
            Ok((binding.name.clone(), place, writable))
        };
        let bindings: Result<_, GpuError> = compiled.bindings.iter().map(place_of).collect();
        Ok(SolverPass {
            bindings: bindings?,
            pipeline: ComputePipeline::new(gpu, &compiled)?,
        })
    }
}

/// A pass that is given the buffers that its shader declares, by their labels.
pub(super) struct SolverPass {
    pipeline: ComputePipeline,
    /// Name, place among the buffers, and whether it is written.
    bindings: Vec<(String, usize, bool)>,
}

impl SolverPass {
    /// The pass with its bindings; `buffers` are in the order in which it was made.
    pub(super) fn begin<'r>(&'r self, rec: &'r mut Recorder, buffers: &[&Buffer]) -> Pass<'r> {
        let pass = rec.pass(&self.pipeline);
        self.bindings
            .iter()
            .fold(pass, |pass, (name, place, writable)| {
                if *writable {
                    pass.write(name, buffers[*place])
                } else {
                    pass.read(name, buffers[*place])
                }
            })
    }
}
