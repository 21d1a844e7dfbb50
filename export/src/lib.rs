//! What leaves the program for others: particles (VTK), surfaces, room and cameras (PLY, glTF), bubbles and spray (PLY), measurements (CSV, Parquet),
//! and recordings with all that viewers show (MCAP).
//!
//! Each moment is written when it is there, so that a longer run takes no more memory.

mod cameras;
mod cloud;
mod glass_mesh;
mod gltf;
mod mesh;
mod nets;
mod ply;
mod recording;
mod room;
mod sink;
mod surfaces;
mod table;
mod vtk;

use vitriol_run::output::OutDir;
use vitriol_run::{
    Experiment, Failure, Laboratory, Moment, Progress, Sample, Span, Watch, sample_is_due,
};
use vitriol_xr::track::TrackMetadata;

pub use mesh::Mesh;
pub use surfaces::Surfaces;
pub use table::TableFormat;

use recording::Recording;
use sink::{Frame, Gltf, Measurements, Ply, Sink, Vtk};

/// A format, and what is written in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Particles as VTK
    Vtk,
    /// Surfaces, glass, room, cameras, bubbles and spray as PLY
    Ply,
    /// Surfaces, glass, room and cameras as glTF 2.0
    Gltf,
    /// Measurements as a table
    Table(TableFormat),
    /// A recording with particles, film and measurements, as MCAP
    Mcap,
}

impl Format {
    /// The name as it is given.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vtk => "vtk",
            Self::Ply => "ply",
            Self::Gltf => "gltf",
            Self::Table(format) => format.name(),
            Self::Mcap => "mcap",
        }
    }

    /// The table that it is, of measurements alone, which a report has too; `None` of what is no table.
    pub fn table(self) -> Option<TableFormat> {
        match self {
            Self::Table(format) => Some(format),
            _ => None,
        }
    }
}

/// When moments are exported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// The first, s.
    pub from: f64,
    /// So many a second from then on; `None` for the first alone.
    pub rate: Option<f64>,
}

impl Times {
    /// Whether the time of moment `number` has come at `seconds`: it is the first state at or after it.
    fn is_due(&self, number: u64, seconds: f64) -> bool {
        let after = match self.rate {
            Some(rate) => number as f64 / rate,
            None if number > 0 => return false,
            None => 0.0,
        };
        seconds + 1e-6 >= self.from + after
    }
}

/// Writes a run in several formats at once.
pub struct Export {
    times: Times,
    /// Moments so far, those that a long step left out among them.
    due: u64,
    /// Moments written.
    written: u64,
    sinks: Vec<Box<dyn Sink>>,
    /// Whether any of them takes moments, and samples.
    takes: [bool; 2],
    /// Number of the last sample's time.
    sampled: Option<u64>,
    span: Span,
    out: OutDir,
    progress: Progress,
}

/// What a recording holds on its run.
#[derive(Debug, Clone)]
pub struct Origin {
    /// Scene, seed, preset.
    pub metadata: TrackMetadata,
    /// Substeps and iterations in place of the preset's.
    pub solver: Option<[u32; 2]>,
}

impl Export {
    /// Of a run of that span into `out`.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn new(
        formats: &[Format],
        times: Times,
        (span, progress): (Span, Progress),
        origin: &Origin,
        mut out: OutDir,
    ) -> Result<Self, Failure> {
        let mut sinks: Vec<Box<dyn Sink>> = Vec::new();
        for format in formats {
            sinks.push(match format {
                Format::Vtk => Box::new(Vtk::default()),
                Format::Ply => Box::new(Ply::default()),
                Format::Gltf => Box::new(Gltf),
                Format::Table(format) => Box::new(Measurements::after(0, *format)),
                Format::Mcap => Box::new(Recording::new(origin, &mut out)?),
            });
        }
        Ok(Self {
            times,
            due: 0,
            written: 0,
            sinks,
            takes: [
                formats.iter().any(|format| format.table().is_none()),
                (formats.iter()).any(|format| *format == Format::Mcap || format.table().is_some()),
            ],
            sampled: None,
            span,
            out,
            progress,
        })
    }

    /// Ends all files; `hash` is that of the final state. The folder is not complete yet.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn finish(mut self, hash: u64) -> Result<(OutDir, u64), Failure> {
        for sink in &mut self.sinks {
            sink.finish(hash, &mut self.out)?;
        }
        Ok((self.out, self.written))
    }
}

/// Writes measurements that are there already, of a run that brought up `scenes_before` others before.
///
/// # Errors
/// An error of the file system.
pub fn tables(
    samples: &[Sample],
    scenes_before: u32,
    formats: &[TableFormat],
    out: &mut OutDir,
) -> Result<(), Failure> {
    for &format in formats {
        let mut table = Measurements::after(scenes_before, format);
        for sample in samples {
            table.sample(sample, out)?;
        }
        table.finish(0, out)?;
    }
    Ok(())
}

impl Watch<Laboratory> for Export {
    fn observe(&mut self, moment: &Moment<'_>, laboratory: &mut Laboratory) -> Result<(), Failure> {
        let seconds = moment.time.seconds();
        for sink in &mut self.sinks {
            sink.step(moment, laboratory, &mut self.out)?;
        }
        let begun = self.due;
        while self.times.is_due(self.due, seconds) {
            self.due += 1;
        }
        let [moments, samples] = self.takes;
        if self.due > begun && moments {
            let frame = Frame::new(self.written, moment, laboratory.world())?;
            for sink in &mut self.sinks {
                sink.frame(&frame, &mut self.out)?;
            }
            self.written += 1;
        }
        let due = sample_is_due(&mut self.sampled, &moment.time);
        let begun = seconds + 1e-6 >= self.times.from;
        if samples && begun && (due || self.span.is_over(&moment.time)) {
            let sample = laboratory.sample(seconds)?;
            for sink in &mut self.sinks {
                sink.sample(&sample, &mut self.out)?;
            }
        }
        self.progress.at(&moment.time);
        Ok(())
    }

    fn start_over(&mut self) -> Result<(), Failure> {
        self.sampled = None;
        for sink in &mut self.sinks {
            sink.start_over(&mut self.out)?;
        }
        Ok(())
    }
}
