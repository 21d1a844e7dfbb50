//! Secrets from the system's randomness, compared in constant time.

use subtle::ConstantTimeEq;

/// Crockford's base 32: no I, L, O or U, which are misread.
const ALPHABET: &[u8; 32] = b"0123456789ABCDEFGHJKMNPQRSTVWXYZ";

/// Characters of a code: 50 bits.
const LENGTH: usize = 10;

/// The system returned no randomness.
#[derive(Debug, thiserror::Error)]
#[error("the system gives no random numbers ({0}); without them no code can be made")]
pub struct NoRandomness(#[from] getrandom::Error);

/// A code of 50 bits that people read and type.
#[derive(Clone)]
pub(crate) struct Code([u8; LENGTH]);

impl Code {
    /// A new random code.
    pub fn new() -> Result<Self, NoRandomness> {
        let mut bytes = [0; LENGTH];
        getrandom::fill(&mut bytes)?;
        // 32 divides 256, so each character is as likely as any other.
        Ok(Self(bytes.map(|byte| ALPHABET[usize::from(byte % 32)])))
    }

    /// The code for people, in two halves.
    pub fn shown(&self) -> String {
        let text = String::from_utf8_lossy(&self.0);
        format!("{}-{}", &text[..LENGTH / 2], &text[LENGTH / 2..])
    }

    /// Whether `typed` is this code, compared in constant time. Small letters, blanks and dashes do not matter, nor do letters that are
    /// read for digits.
    pub fn is(&self, typed: &str) -> bool {
        let mut read = [0; LENGTH];
        let mut count = 0;
        for character in typed.bytes().filter(|c| !matches!(c, b'-' | b' ')) {
            let character = match character.to_ascii_uppercase() {
                b'O' => b'0',
                b'I' | b'L' => b'1',
                other => other,
            };
            if let Some(place) = read.get_mut(count) {
                *place = character;
            }
            count += 1;
        }
        let same = self.0.ct_eq(&read) & (count as u64).ct_eq(&(LENGTH as u64));
        same.into()
    }
}

/// A secret of 128 bits that programs keep.
#[derive(Clone)]
pub(crate) struct Secret(String);

impl Secret {
    /// A new random secret.
    pub fn new() -> Result<Self, NoRandomness> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        Ok(Self(hexadecimal(&bytes)))
    }

    /// Parses a secret; `None` where the text is none.
    pub fn from_text(text: &str) -> Option<Self> {
        let sound = text.len() == 32 && text.bytes().all(|b| b.is_ascii_hexdigit());
        sound.then(|| Self(text.to_ascii_lowercase()))
    }

    /// The secret as text.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// Whether `said` is this secret, compared in constant time.
    pub fn is(&self, said: &str) -> bool {
        self.0.as_bytes().ct_eq(said.as_bytes()).into()
    }
}

/// Two hexadecimal digits a byte.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_read_as_people_type_it() {
        let code = Code(*b"0A1B2C3D4E");
        assert_eq!(code.shown(), "0A1B2-C3D4E");
        for typed in ["0A1B2-C3D4E", "oaib2c3d4e", " 0 A L B 2 - C 3 D 4 E "] {
            assert!(code.is(typed), "{typed}");
        }
        for typed in [
            "",
            "0A1B2-C3D4",
            "0A1B2-C3D4EE",
            "0A1B2-C3D4F",
            "0A1B2-C3D4E\0",
        ] {
            assert!(!code.is(typed), "{typed}");
        }
    }

    /// 32 characters, each as often as the others: the 0.1 per cent quantile of chi squared with 31 degrees of freedom
    /// is 61.1 (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4), and one run in a million has 88.
    #[test]
    fn codes_have_fifty_bits() {
        let mut counts = [0_u32; 32];
        for _ in 0..3200 {
            for character in Code::new().unwrap().0 {
                let at = ALPHABET.iter().position(|c| *c == character).unwrap();
                counts[at] += 1;
            }
        }
        let chi_squared: f64 = (counts.iter())
            .map(|count| (f64::from(*count) - 1000.0).powi(2) / 1000.0)
            .sum();
        assert!(chi_squared < 88.0, "{chi_squared}: {counts:?}");
        assert_eq!(32_u64.pow(LENGTH as u32), 1 << 50);
    }

    #[test]
    fn a_secret_is_itself_alone() {
        let secret = Secret::new().unwrap();
        assert!(secret.is(secret.text()));
        assert!(!secret.is(&secret.text()[1..]));
        assert!(!secret.is(Secret::new().unwrap().text()));
        assert!(Secret::from_text(secret.text()).unwrap().is(secret.text()));
        assert!(Secret::from_text("0123").is_none());
    }
}
