//! Floats in JSON, which has none that are not finite: those are the strings `inf`, `-inf` and `NaN`.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A float on its way to or from JSON.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub f32);

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Finite(f32),
    Other(String),
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.0.is_finite() {
            true => Written::Finite(self.0),
            // Rust's own spelling of them, which it parses too.
            false => Written::Other(self.0.to_string()),
        }
        .serialize(to)
    }
}

impl<'a> Deserialize<'a> for Number {
    fn deserialize<D: Deserializer<'a>>(from: D) -> Result<Self, D::Error> {
        match Written::deserialize(from)? {
            Written::Finite(value) => Ok(Self(value)),
            Written::Other(word) => word.parse().map(Self).map_err(serde::de::Error::custom),
        }
    }
}

/// For `serde(with)`: one float.
pub(crate) mod one {
    use super::{Deserialize, Deserializer, Number, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(value: &f32, to: S) -> Result<S::Ok, S::Error> {
        Number(*value).serialize(to)
    }

    pub(crate) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<f32, D::Error> {
        Number::deserialize(from).map(|number| number.0)
    }
}

/// For `serde(with)`: two floats.
pub(crate) mod two {
    use super::{Deserialize, Deserializer, Number, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(value: &[f32; 2], to: S) -> Result<S::Ok, S::Error> {
        value.map(Number).serialize(to)
    }

    pub(crate) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<[f32; 2], D::Error> {
        <[Number; 2]>::deserialize(from).map(|two| two.map(|number| number.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_float_comes_back() {
        for value in [
            0.1,
            -0.0,
            f32::MIN_POSITIVE,
            f32::INFINITY,
            f32::NEG_INFINITY,
        ] {
            let text = serde_json::to_string(&Number(value)).unwrap();
            let read: Number = serde_json::from_str(&text).unwrap();
            assert_eq!(read.0.to_bits(), value.to_bits(), "{text}");
        }
        let text = serde_json::to_string(&Number(f32::NAN)).unwrap();
        let read: Number = serde_json::from_str(&text).unwrap();
        assert!(read.0.is_nan(), "{text}");
    }
}
