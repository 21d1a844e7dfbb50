//! The run as a recording that viewers open: the track's own topics, and beside them particles, film and measurements.

use std::collections::BTreeMap;

use vitriol_run::output::OutDir;
use vitriol_run::particles::Particles;
use vitriol_run::track::{STATE_HASH, blame};
use vitriol_run::{
    Action, Blame, Experiment, FILM_FPS, FILM_SIZE, Failure, H264, Laboratory, Moment, Sample,
    stage,
};
use vitriol_xr::PoseFrame;
use vitriol_xr::track::{Annex, Existing, TrackWriter};

use crate::Origin;
use crate::sink::{Frame, Sink};

/// Name of the file.
pub const FILE: &str = "recording.mcap";

/// A recording that is being written.
pub struct Recording {
    writer: TrackWriter,
    encoder: H264,
    /// Film frames so far.
    film: u32,
    /// The last frame.
    last: Option<PoseFrame>,
    /// Simulated time so far, ns.
    now_ns: i64,
    /// Substeps and iterations that the first frame sets.
    solver: Option<[u32; 2]>,
    schema: String,
}

impl Recording {
    /// One of a run of that origin.
    ///
    /// # Errors
    /// An error of the file system.
    pub fn new(origin: &Origin, out: &mut OutDir) -> Result<Self, Failure> {
        let path = out.join(FILE);
        let writer = TrackWriter::create(&path, &origin.metadata, Existing::Refuse);
        let writer = writer.map_err(blame)?;
        out.adopt(path);
        Ok(Self {
            writer,
            encoder: H264::new(FILM_SIZE, FILM_FPS).other()?,
            film: 0,
            last: None,
            now_ns: 0,
            solver: origin.solver,
            schema: origin.sample_schema.clone(),
        })
    }

    /// Writes the frame of a step that ended at `end_ns`, with the time at which it began.
    fn write(
        &mut self,
        frame: &PoseFrame,
        laboratory: &Laboratory,
        end_ns: i64,
    ) -> Result<(), Failure> {
        let mut frame = frame.clone();
        frame.time_ns = std::mem::replace(&mut self.now_ns, end_ns);
        let solver = self.solver.take();
        let solver = solver.map(|effort| Action::Solver(effort).switch());
        // After a switch of scene, which brings its own.
        frame.scenario.extend(solver);
        let flasks = stage::flasks(laboratory.world());
        self.writer.write(&frame, &flasks).map_err(blame)?;
        self.last = Some(frame);
        Ok(())
    }

    /// Adds what is of the state after the last step, with the time of that step's frame: its flasks have that too, so
    /// that a viewer shows liquid and glass of one moment.
    fn add(&mut self, annex: &Annex<'_>) -> Result<(), Failure> {
        let time_ns = self.frame_ns();
        self.writer.add(time_ns, annex).map_err(blame)
    }

    /// Time of the last frame.
    fn frame_ns(&self) -> i64 {
        self.last.as_ref().map_or(0, |frame| frame.time_ns)
    }

    fn film(&mut self, moment: &Moment<'_>, laboratory: &mut Laboratory) -> Result<(), Failure> {
        let seconds = moment.time.seconds();
        let due = (seconds * f64::from(FILM_FPS) + 1e-6).floor() as u32 + 1;
        if moment.frame.is_none() || due <= self.film {
            return Ok(());
        }
        let time_ns = self.frame_ns();
        let picture = laboratory.picture(0)?;
        let Some(coded) = self.encoder.encode(picture).other()? else {
            let number = self.film;
            return Err(format!(
                "frame {number} of the film has more detail than H.264 is given room for; leave mcap out of --format"
            ))
            .other();
        };
        // The bytes are the encoder's, so that all of `self` is not free.
        let added = self.writer.add(time_ns, &Annex::Film(coded.bytes));
        added.map_err(blame)?;
        // A step that is longer than a frame has one all the same: messages have times of their own.
        self.film = due;
        Ok(())
    }
}

fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

impl Sink for Recording {
    fn step(
        &mut self,
        moment: &Moment<'_>,
        laboratory: &mut Laboratory,
        _out: &mut OutDir,
    ) -> Result<(), Failure> {
        if let Some(frame) = moment.frame {
            self.write(frame, laboratory, nanoseconds(moment.time.seconds()))?;
        }
        self.film(moment, laboratory)
    }

    fn frame(&mut self, frame: &Frame<'_>, _out: &mut OutDir) -> Result<(), Failure> {
        let (fields, rows) = rows(frame.particles());
        self.add(&Annex::Points {
            fields: &fields,
            rows: &rows,
        })
    }

    fn sample(&mut self, sample: &Sample, _out: &mut OutDir) -> Result<(), Failure> {
        let json = serde_json::to_string(sample).other()?;
        let schema = std::mem::take(&mut self.schema);
        let added = self.add(&Annex::Measurement {
            json: &json,
            schema: &schema,
        });
        self.schema = schema;
        added
    }

    fn finish(&mut self, hash: u64, _out: &mut OutDir) -> Result<(), Failure> {
        // A track lasts to its last frame, so that a replay needs one at the last step's end.
        if let Some(mut end) = self.last.take() {
            end.step += 1;
            end.time_ns = self.now_ns;
            end.scenario.clear();
            self.writer.write(&end, &[]).map_err(blame)?;
        }
        let said = BTreeMap::from([(STATE_HASH.to_owned(), format!("{hash:016x}"))]);
        self.writer.conclude(&said).map_err(blame)?;
        self.writer.finish().map_err(blame)?;
        if !self.writer.fits_a_reader() {
            tracing::warn!(
                "{FILE} is too long to be replayed; viewers open it. Export fewer --seconds, or at a lower --rate"
            );
        }
        Ok(())
    }
}

/// Names of the columns, and the rows.
fn rows(particles: &Particles) -> (Vec<&'static str>, Vec<f32>) {
    let heat = !particles.temperature.is_empty();
    let mut fields = vec!["x", "y", "z", "speed", "flask"];
    if heat {
        fields.extend(["temperature", "acid"]);
    }
    let mut rows = Vec::with_capacity(fields.len() * particles.len());
    for index in 0..particles.len() {
        let place = particles.position[index].as_vec3();
        rows.extend(place.to_array());
        rows.push(particles.velocity[index].length() as f32);
        rows.push(particles.flask[index] as f32);
        if heat {
            rows.extend([particles.temperature[index], particles.acid[index]]);
        }
    }
    (fields, rows)
}
