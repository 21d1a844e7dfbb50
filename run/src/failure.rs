//! How a command fails: one message, one exit code.

use std::error::Error;
use std::fmt;

use vitriol_render::RenderError;
use vitriol_sim::world::WorldError;

/// Any error that can travel between threads.
pub type Cause = Box<dyn Error + Send + Sync + 'static>;

/// Why a command ended without a result. Shown as one line: the message and
/// its causes, joined by `: `.
#[derive(Debug)]
pub enum Failure {
    /// The scene, the track or the arguments are wrong. Exit code 2.
    Input(Cause),
    /// There is no Vulkan device or OpenXR runtime that could do it. Exit
    /// code 3.
    NoDevice(Cause),
    /// Anything else, such as a full disk. Exit code 1.
    Other(Cause),
}

impl Failure {
    /// The exit code of the process.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_) => 2,
            Self::NoDevice(_) => 3,
            Self::Other(_) => 1,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Input(cause) | Self::NoDevice(cause) | Self::Other(cause)) = self;
        let mut error: &(dyn Error + 'static) = cause.as_ref();
        let mut shown = error.to_string();
        f.write_str(&shown)?;
        while let Some(cause) = error.source() {
            let text = cause.to_string();
            // Some libraries put the cause into their own message as well.
            if !shown.contains(&text) {
                write!(f, ": {text}")?;
            }
            shown = text;
            error = cause;
        }
        Ok(())
    }
}

/// Classes an error by whose fault it is, at the place where it occurs.
pub trait Blame<T> {
    /// The user's input is at fault: [`Failure::Input`].
    ///
    /// # Errors
    /// The error itself, as [`Failure::Input`].
    fn input(self) -> Result<T, Failure>;

    /// Neither input nor device is at fault: [`Failure::Other`].
    ///
    /// # Errors
    /// The error itself, as [`Failure::Other`].
    fn other(self) -> Result<T, Failure>;
}

impl<T, E: Into<Cause>> Blame<T> for Result<T, E> {
    fn input(self) -> Result<T, Failure> {
        self.map_err(|error| Failure::Input(error.into()))
    }

    fn other(self) -> Result<T, Failure> {
        self.map_err(|error| Failure::Other(error.into()))
    }
}

/// Whose fault a world's error is.
pub(crate) fn blame_world(error: WorldError) -> Failure {
    match error {
        WorldError::Fill(_) => Failure::Input(error.into()),
        _ => Failure::Other(error.into()),
    }
}

/// Whose fault an error of drawing is.
pub(crate) fn blame_render(error: RenderError) -> Failure {
    match error {
        RenderError::TooManyPixels { .. } => Failure::Input(error.into()),
        _ => Failure::Other(error.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, thiserror::Error)]
    #[error("scene.toml: liquid.volume: 400 mL do not fit")]
    struct Outer(#[source] Inner);

    #[derive(Debug, thiserror::Error)]
    #[error("the flask holds 250 mL")]
    struct Inner;

    #[derive(Debug, thiserror::Error)]
    #[error("reading failed: {0}")]
    struct Repeating(#[source] Inner);

    #[test]
    fn causes_are_joined_once() {
        let failure = Failure::Input(Box::new(Outer(Inner)));
        assert_eq!(
            failure.to_string(),
            "scene.toml: liquid.volume: 400 mL do not fit: the flask holds 250 mL"
        );
        let failure = Failure::Other(Box::new(Repeating(Inner)));
        assert_eq!(
            failure.to_string(),
            "reading failed: the flask holds 250 mL"
        );
    }
}
