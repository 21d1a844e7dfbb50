//! Where each format's files come from, a moment at a time.

use std::cell::OnceCell;

use vitriol_run::output::{OutDir, Staged, unwritten};
use vitriol_run::particles::Particles;
use vitriol_run::{Blame, Cause, Failure, Laboratory, Moment, Sample};
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;
use vitriol_sim::world::World;
use vitriol_xr::PoseFrame;

use crate::cameras::{self, NamedView};
use crate::cloud::Cloud;
use crate::gltf::{self, Matter};
use crate::surfaces::Surfaces;
use crate::table::{Column, Table, TableFormat, columns};
use crate::{ply, room, vtk};

/// A moment that is exported; what formats share is made once, and only where one asks for it.
pub struct Frame<'a> {
    /// Its number, from 0.
    pub number: u64,
    /// Simulated time, s.
    pub seconds: f64,
    world: &'a World,
    state: SolverState,
    user: Option<&'a PoseFrame>,
    particles: OnceCell<Particles>,
    surfaces: OnceCell<Surfaces>,
}

impl<'a> Frame<'a> {
    /// Reads the state; waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(number: u64, moment: &Moment<'a>, world: &'a World) -> Result<Self, Failure> {
        Ok(Self {
            number,
            seconds: moment.time.seconds(),
            world,
            state: world.solver().snapshot().other()?,
            user: moment.frame,
            particles: OnceCell::new(),
            surfaces: OnceCell::new(),
        })
    }

    /// The particles.
    pub fn particles(&self) -> &Particles {
        self.particles
            .get_or_init(|| Particles::of(self.world, &self.state))
    }

    /// The surfaces.
    pub fn surfaces(&self) -> &Surfaces {
        let of = || Surfaces::of(self.world.scene(), self.world.poses(), &self.state);
        self.surfaces.get_or_init(of)
    }

    /// Bubbles and spray by name, as far as the scene has them.
    pub fn clouds(&self) -> impl Iterator<Item = (&'static str, Cloud)> {
        let (scene, parameters) = (self.world.scene(), self.world.solver().parameters());
        let bubbles = Cloud::of_bubbles(scene, parameters, &self.state);
        let spray = Cloud::of_spray(scene, parameters, &self.state);
        let named = [("bubbles", bubbles), ("spray", spray)].into_iter();
        named.filter_map(|(name, cloud)| Some((name, cloud?)))
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.world
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        self.world.scene()
    }

    /// The cameras.
    pub fn cameras(&self) -> Vec<NamedView> {
        cameras::of(self.scene(), self.user)
    }
}

/// Takes what it wants of a run, and writes it.
pub trait Sink {
    /// After each step, and before the first.
    ///
    /// # Errors
    /// An error of the device or the file system.
    fn step(
        &mut self,
        moment: &Moment<'_>,
        laboratory: &mut Laboratory,
        out: &mut OutDir,
    ) -> Result<(), Failure> {
        let _ = (moment, laboratory, out);
        Ok(())
    }

    /// At the moments that are exported.
    ///
    /// # Errors
    /// An error of the file system.
    fn frame(&mut self, frame: &Frame<'_>, out: &mut OutDir) -> Result<(), Failure> {
        let _ = (frame, out);
        Ok(())
    }

    /// At a sample's times.
    ///
    /// # Errors
    /// An error of the file system.
    fn sample(&mut self, sample: &Sample, out: &mut OutDir) -> Result<(), Failure> {
        let _ = (sample, out);
        Ok(())
    }

    /// What follows is another scene, or the same from its start.
    ///
    /// # Errors
    /// An error of the file system.
    fn start_over(&mut self, out: &mut OutDir) -> Result<(), Failure> {
        let _ = out;
        Ok(())
    }

    /// Ends its files; `hash` is that of the final state.
    ///
    /// # Errors
    /// An error of the file system.
    fn finish(&mut self, hash: u64, out: &mut OutDir) -> Result<(), Failure> {
        let _ = (hash, out);
        Ok(())
    }
}

/// Name of the file that a run's scene of that number, from 1, is written to.
fn part_name(what: &str, part: u32, ending: &str) -> String {
    match part {
        0 | 1 => format!("{what}.{ending}"),
        part => format!("{what}-{part}.{ending}"),
    }
}

/// Particles, a `.vtu` a moment and a list of all of a scene.
#[derive(Default)]
pub struct Vtk {
    list: Option<Staged>,
    part: u32,
}

impl Vtk {
    fn say(&mut self, text: &str, out: &OutDir) -> Result<(), Failure> {
        let begins = self.list.is_none();
        let list = match self.list.take() {
            Some(list) => list,
            None => {
                self.part += 1;
                out.stage(&part_name("particles", self.part, "vtu.series"))?
            }
        };
        let list = self.list.insert(list);
        list.write(vtk::LIST[usize::from(!begins)].as_bytes())?;
        list.write(text.as_bytes())
    }
}

impl Sink for Vtk {
    fn frame(&mut self, frame: &Frame<'_>, out: &mut OutDir) -> Result<(), Failure> {
        let name = format!("particles-{:06}.vtu", frame.number);
        out.write(&name, &vtk::bytes(frame.particles(), frame.seconds))?;
        self.say(&vtk::entry(&name, frame.seconds), out)
    }

    /// Other particles, of other numbers.
    fn start_over(&mut self, out: &mut OutDir) -> Result<(), Failure> {
        self.finish(0, out)
    }

    fn finish(&mut self, _hash: u64, out: &mut OutDir) -> Result<(), Failure> {
        let Some(list) = self.list.take() else {
            return Ok(());
        };
        list.write(vtk::LIST[2].as_bytes())?;
        out.keep(list)
    }
}

/// Surfaces, bubbles, spray and cameras, files a moment; table and room once for each scene.
#[derive(Default)]
pub struct Ply {
    /// Whether the scene's are there.
    room: bool,
    part: u32,
}

impl Sink for Ply {
    fn frame(&mut self, frame: &Frame<'_>, out: &mut OutDir) -> Result<(), Failure> {
        if !self.room {
            let [table, room] = room::meshes(frame.scene());
            self.part += 1;
            for (name, mesh) in [("table", table), ("room", room)] {
                let file = part_name(name, self.part, "ply");
                out.write(&file, &ply::bytes(&mesh, name))?;
            }
            self.room = true;
        }
        let surfaces = frame.surfaces();
        for (name, mesh) in [
            ("air-liquid", &surfaces.air_liquid),
            ("glass-liquid", &surfaces.glass_liquid),
            ("air-glass", &surfaces.air_glass),
        ] {
            let comment = format!("{name}, m, at {} s", frame.seconds);
            out.write(
                &format!("{name}-{:06}.ply", frame.number),
                &ply::bytes(mesh, &comment),
            )?;
        }
        for (name, cloud) in frame.clouds() {
            let comment = format!("{name}, SI units, at {} s", frame.seconds);
            out.write(
                &format!("{name}-{:06}.ply", frame.number),
                &ply::points(&cloud, &comment),
            )?;
        }
        let cameras = cameras::json(&frame.cameras(), frame.seconds);
        let cameras = serde_json::to_vec_pretty(&cameras).other()?;
        out.write(&format!("cameras-{:06}.json", frame.number), &cameras)
    }

    fn start_over(&mut self, _out: &mut OutDir) -> Result<(), Failure> {
        self.room = false;
        Ok(())
    }
}

/// All that is seen, a `.glb` a moment.
pub struct Gltf;

impl Sink for Gltf {
    fn frame(&mut self, frame: &Frame<'_>, out: &mut OutDir) -> Result<(), Failure> {
        let surfaces = frame.surfaces();
        let [table, room] = room::meshes(frame.scene());
        let meshes = [
            ("air-liquid", &surfaces.air_liquid, Matter::Liquid),
            ("glass-liquid", &surfaces.glass_liquid, Matter::Liquid),
            ("air-glass", &surfaces.air_glass, Matter::Glass),
            ("table", &table, Matter::Solid),
            ("room", &room, Matter::Solid),
        ];
        let bytes = gltf::bytes(&meshes, &frame.cameras(), frame.seconds);
        out.write(&format!("scene-{:06}.glb", frame.number), &bytes)
    }
}

/// Measurements, a table for each scene that a run brings up: others have other flasks.
pub struct Measurements {
    format: TableFormat,
    part: u32,
    begun: Option<(Vec<Column>, Box<dyn Table>, Staged)>,
}

impl Measurements {
    /// Measurements as that table, for a run that goes on after `scenes` scenes: the tables' numbers go on from there.
    pub fn after(scenes: u32, format: TableFormat) -> Self {
        Self {
            format,
            part: scenes,
            begun: None,
        }
    }

    fn begin(&mut self, first: &Sample, out: &OutDir) -> Result<(), Failure> {
        self.part += 1;
        let name = part_name("measurements", self.part, self.format.name());
        let staged = out.stage(&name)?;
        let columns = columns(first);
        let begin = || -> Result<Box<dyn Table>, Cause> {
            self.format.begin(staged.try_clone()?, &columns)
        };
        let table = begin().map_err(unwritten(&staged.path))?;
        self.begun = Some((columns, table, staged));
        Ok(())
    }
}

impl Sink for Measurements {
    fn sample(&mut self, sample: &Sample, out: &mut OutDir) -> Result<(), Failure> {
        if self.begun.is_none() {
            self.begin(sample, out)?;
        }
        if let Some((columns, table, staged)) = &mut self.begun {
            let written = table.row(columns, sample);
            written.map_err(unwritten(&staged.path))?;
        }
        Ok(())
    }

    fn start_over(&mut self, out: &mut OutDir) -> Result<(), Failure> {
        self.finish(0, out)
    }

    fn finish(&mut self, _hash: u64, out: &mut OutDir) -> Result<(), Failure> {
        if let Some((_, table, staged)) = self.begun.take() {
            table.finish().map_err(unwritten(&staged.path))?;
            out.keep(staged)?;
        }
        Ok(())
    }
}
