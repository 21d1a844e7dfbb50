//! `vitriol hub`: the console of a class.

use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use serde::Serialize;
use vitriol_console::Hub;
use vitriol_run::{Blame, Failure, Format, emit};

use crate::cli::HubArgs;
use vitriol_live::{invitation, start};

/// Time between two looks whether the last code was used.
const TICK: Duration = Duration::from_secs(1);

/// What `vitriol hub` prints when it listens.
#[derive(Debug, Serialize)]
struct HubReport {
    /// For one browser.
    console: String,
    /// What students' programs take for `--hub`.
    students: Option<String>,
    /// Fingerprint of its certificate.
    fingerprint: Option<String>,
}

/// What ends it, or asks for something.
enum Said {
    Invite,
    End,
}

/// Serves until it is ended.
///
/// # Errors
/// [`Failure::Input`] for an address that cannot be listened on; [`Failure::Other`].
pub fn run(args: &HubArgs, format: Format) -> Result<(), Failure> {
    let hub = start(args.listen, true, args.language)?;
    let first = hub.invite().other()?;
    let report = HubReport {
        console: first.address.clone(),
        students: hub.students().map(ToString::to_string),
        fingerprint: hub.fingerprint().map(|it| it.to_string()),
    };
    let lan = !hub.address().ip().is_loopback();
    emit(format, &report, |report| {
        describe(report, lan.then(|| first.qr()))
    })?;
    let (say, said) = channel();
    let end = say.clone();
    ctrlc::set_handler(move || {
        // A hub that has ended takes no messages.
        let _ = end.send(Said::End);
    })
    .other()?;
    if std::io::stdin().is_terminal() {
        std::thread::spawn(move || {
            for _ in std::io::stdin().lines().map_while(Result::ok) {
                if say.send(Said::Invite).is_err() {
                    return;
                }
            }
        });
    }
    loop {
        match said.recv_timeout(TICK) {
            Ok(Said::Invite) => invite(&hub, format)?,
            Ok(Said::End) | Err(RecvTimeoutError::Disconnected) => return Ok(()),
            // Who has lost a browser's cookie would be locked out.
            Err(RecvTimeoutError::Timeout) if hub.codes() == 0 => invite(&hub, format)?,
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}

fn invite(hub: &Hub, format: Format) -> Result<(), Failure> {
    eprint!("{}", invitation(hub, format)?);
    Ok(())
}

fn describe(report: &HubReport, qr: Option<String>) -> String {
    let mut text = format!("console, for one browser: {}\n", report.console);
    text += &qr.map_or_else(String::new, |qr| qr + "\n");
    if let Some(fingerprint) = &report.fingerprint {
        text += &format!("its certificate has the fingerprint {fingerprint}\n");
    }
    if let Some(students) = &report.students {
        text += &format!(
            "students' programs: keep the next line in a file, for vitriol vr --hub FILE or vitriol desk --hub FILE\n{students}\n"
        );
    }
    text + "Enter lets another browser in, Ctrl-C ends."
}
