//! The certificate by which browsers and students' programs recognise a hub, and the key that the programs have. Both are kept, so that
//! nobody needs new ones every lesson.

use std::io::{ErrorKind, Write};
use std::path::Path;

use rcgen::{CertificateParams, DistinguishedName, DnType, KeyPair};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};

use crate::auth::{Secret, hexadecimal};
use crate::error::Error;

/// File of the certificate and its private key.
const CERTIFICATE: &str = "console-certificate.pem";
/// File of the students' key.
const KEY: &str = "console-students.key";

/// SHA-256 of a certificate, as browsers show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint(pub(crate) [u8; 32]);

impl Fingerprint {
    /// Fingerprint of a certificate.
    pub(crate) fn of(certificate: &CertificateDer<'_>) -> Self {
        let mut sum = [0; 32];
        let digest = ring::digest::digest(&ring::digest::SHA256, certificate);
        sum.copy_from_slice(digest.as_ref());
        Self(sum)
    }

    /// 64 digits without anything between them.
    pub(crate) fn plain(&self) -> String {
        hexadecimal(&self.0)
    }
}

impl std::fmt::Display for Fingerprint {
    /// As browsers show it: `AB:CD:…`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (at, byte) in self.0.iter().enumerate() {
            write!(f, "{}{byte:02X}", if at == 0 { "" } else { ":" })?;
        }
        Ok(())
    }
}

/// A hub's certificate with its private key.
pub(crate) struct Identity {
    pub certificate: CertificateDer<'static>,
    pub private: PrivateKeyDer<'static>,
}

impl Identity {
    /// The identity that is kept in `folder`, or a new one, which is kept there from now on.
    pub fn kept_in(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(CERTIFICATE);
        let text = kept(&path, "certificate", || {
            let mut params = CertificateParams::new(["localhost".to_owned()])?;
            params.distinguished_name = DistinguishedName::new();
            let name = "Vitriol's console";
            params.distinguished_name.push(DnType::CommonName, name);
            let private = KeyPair::generate()?;
            let certificate = params.self_signed(&private)?;
            Ok(certificate.pem() + &private.serialize_pem())
        })?;
        let damaged = || Error::Damaged {
            what: "certificate with its private key",
            path: path.clone(),
        };
        Ok(Self {
            certificate: CertificateDer::from_pem_slice(text.as_bytes()).map_err(|_| damaged())?,
            private: PrivateKeyDer::from_pem_slice(text.as_bytes()).map_err(|_| damaged())?,
        })
    }
}

/// The students' key that is kept in `folder`, or a new one, which is kept there from now on.
pub(crate) fn students_key(folder: &Path) -> Result<Secret, Error> {
    let path = folder.join(KEY);
    let what = "students' key";
    let text = kept(&path, what, || Ok(Secret::new()?.text().to_owned()))?;
    Secret::from_text(text.trim()).ok_or(Error::Damaged { what, path })
}

/// The contents of a file that this user alone may read; `make` gives those of a new one.
fn kept(
    path: &Path,
    what: &'static str,
    make: impl FnOnce() -> Result<String, Error>,
) -> Result<String, Error> {
    let failed = |done: &'static str| {
        move |cause| Error::File {
            what,
            path: path.to_owned(),
            done,
            cause,
        }
    };
    match std::fs::read_to_string(path) {
        Ok(text) => return Ok(text),
        Err(error) if error.kind() == ErrorKind::NotFound => {}
        Err(error) => return Err(failed("read")(error)),
    }
    let text = make()?;
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(failed("written"))?;
    // A temporary file is readable by its user alone, and no half of one gets the name.
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed("written"))?;
    file.write_all(text.as_bytes()).map_err(failed("written"))?;
    match file.persist_noclobber(path) {
        Ok(_) => Ok(text),
        // Another hub was faster: its file counts.
        Err(error) if error.error.kind() == ErrorKind::AlreadyExists => {
            std::fs::read_to_string(path).map_err(failed("read"))
        }
        Err(error) => Err(failed("written")(error.error)),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn it_stays_the_same_and_is_its_users_alone() {
        let folder = tempfile::tempdir().unwrap();
        let home = folder.path().join("vitriol");
        let first = Identity::kept_in(&home).unwrap();
        let again = Identity::kept_in(&home).unwrap();
        assert_eq!(first.certificate, again.certificate);
        let key = students_key(&home).unwrap();
        assert!(students_key(&home).unwrap().is(key.text()));
        #[cfg(unix)]
        for name in [CERTIFICATE, KEY] {
            use std::os::unix::fs::PermissionsExt;
            let mode = home.join(name).metadata().unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600, "{name}");
        }
        std::fs::write(home.join(CERTIFICATE), "nothing").unwrap();
        assert!(matches!(
            Identity::kept_in(&home),
            Err(Error::Damaged { .. })
        ));
    }

    /// SHA-256 of `abc` (FIPS 180-4's example).
    #[test]
    fn a_fingerprint_is_sha_256() {
        let fingerprint = Fingerprint::of(&CertificateDer::from(b"abc".to_vec()));
        assert!(
            fingerprint
                .to_string()
                .starts_with("BA:78:16:BF:8F:01:CF:EA")
        );
        assert!(fingerprint.plain().ends_with("b410ff61f20015ad"));
    }
}
