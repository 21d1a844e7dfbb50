//! What a session says of itself, on the panel and in the mirror window's title.

/// A session's state in words and numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Info {
    /// The scene.
    pub scene: String,
    /// Its flasks.
    pub flasks: Vec<FlaskLine>,
    /// Whether there is acid, whose tint is explained.
    pub acid: bool,
    /// Speed of simulated time in per cent of real time; `None` at full speed.
    pub slow: Option<u32>,
    /// Seconds that are recorded; `None` without a recording.
    pub recording: Option<u64>,
    /// Whether the recording waits for a disk that refuses it.
    pub waits_for_disk: bool,
    /// Steps that could not be recorded.
    pub unwritten: u64,
    /// Display periods without a frame.
    pub missed: u64,
    /// What is solved and drawn with, where that is less than was asked for.
    pub effort: Option<Effort>,
    /// The scene that is being set up.
    pub coming: Option<String>,
    /// How far a hold of the button for a new start has come, per cent.
    pub holding: Option<u32>,
    /// The end was asked for once.
    pub ends: bool,
}

/// A flask's line.
#[derive(Clone, Debug, PartialEq)]
pub struct FlaskLine {
    /// Its name.
    pub name: String,
    /// Mean temperature of its liquid, whole °C; `None` where heat is not modelled or it is empty.
    pub temperature: Option<i32>,
    /// Acid by mass, whole per cent.
    pub acid: Option<i32>,
}

/// How much less than was asked for is solved and drawn, so that frames fit the display's period.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Whether the last change was to more accuracy or pixels.
    pub finer: bool,
    /// Substeps a step and iterations a substep.
    pub solver: [u32; 2],
    /// What was asked for.
    pub asked: [u32; 2],
    /// Each side of the picture, per cent of the display's.
    pub picture: u32,
    /// Whether the liquid's surface is drawn by another filter than was asked for.
    pub other_filter: bool,
    /// The display's rate, Hz, where it was higher at first.
    pub rate: Option<u32>,
}

impl Effort {
    /// In a sentence that names only what is less than was asked for.
    pub fn text(&self) -> String {
        let mut parts = Vec::new();
        if self.solver != self.asked {
            let ([substeps, iterations], [of, by]) = (self.solver, self.asked);
            parts.push(format!(
                "{substeps} × {iterations} substeps × iterations of {of} × {by}"
            ));
        }
        if self.other_filter {
            parts.push("a plainer surface".into());
        }
        if self.picture < 100 {
            parts.push(format!("picture {} %", self.picture));
        }
        if let Some(rate) = self.rate {
            parts.push(format!("display {rate} Hz"));
        }
        let how = if self.finer { "finer again" } else { "coarser" };
        format!("{how}: {}", parts.join(", "))
    }
}
