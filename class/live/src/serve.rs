//! Where the console is: served by this program, or by a hub that it dials.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs};
use std::path::{Path, PathBuf};

use serde::Serialize;
use vitriol_console::{
    Choice, Config, Hub, HubAddress, Kind, Link, List, Port, Range, Student, Text,
};
use vitriol_lesson::{Language, Texts};
use vitriol_run::{Blame, Failure, Format};
use vitriol_sim::world::MOST_INTENSITY;

use super::watchers::Watchers;
use crate::args::ConsoleArgs;
use vitriol_run::choices::{CHOICES, Order, index};
use vitriol_xr::files;

/// A run's end of the console: the states that its loop sends, the orders that it receives, and the program's description.
#[derive(Clone, Debug)]
pub struct Console {
    /// Where states go and orders come from.
    pub port: Port,
    /// The description of this program that the instructor was sent.
    pub student: Student,
    /// The language in which the instructor is told of scenes, flasks and incidents.
    pub language: Language,
}

/// The console while a program runs. It ends when this is dropped.
pub struct Serving {
    console: Console,
    /// One of the two.
    hub: Option<Hub>,
    _link: Option<Link>,
}

/// Who is let in, in one JSON line.
#[derive(Serialize)]
struct Said<'a> {
    console: &'a str,
    code: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    fingerprint: Option<String>,
}

impl Serving {
    /// Serves it or dials, as `args` set it, for a session or a replay, and tells of it in that language.
    ///
    /// # Errors
    /// [`Failure::Input`] for an address that cannot be listened on.
    pub fn begin(
        args: &ConsoleArgs,
        language: Language,
        is_session: bool,
    ) -> Result<Self, Failure> {
        let texts = Texts::of(language).other()?;
        let student = student((args.name.as_deref(), &texts), is_session);
        if let Some(address) = &args.hub {
            let link = Link::start(address.clone(), student.clone()).other()?;
            let port = link.port().clone();
            return Ok(Self {
                console: Console {
                    port,
                    student,
                    language,
                },
                hub: None,
                _link: Some(link),
            });
        }
        let loopback = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0);
        let hub = start(args.listen.unwrap_or(loopback), false, language)?;
        // The first of them finds a place.
        let port = hub.student(student.clone()).other()?;
        let port = port
            .ok_or("the console has no place for its own student")
            .other()?;
        Ok(Self {
            console: Console {
                port,
                student,
                language,
            },
            hub: Some(hub),
            _link: None,
        })
    }

    /// The run's end.
    pub fn console(&self) -> &Console {
        &self.console
    }

    /// So many pages that look, for measurements.
    ///
    /// # Errors
    /// Where the hub is elsewhere, or does not serve them.
    pub fn watched(&self, count: usize) -> Result<Watchers, Failure> {
        let hub = self.hub.as_ref();
        let hub = hub.ok_or("--watchers look at a console of this computer: leave --hub out");
        Watchers::start(hub.input()?, count)
    }

    /// Lets one browser in: its address goes to standard error. Nothing where a hub elsewhere does that.
    ///
    /// # Errors
    /// [`Failure::Other`] where the system has no randomness.
    pub fn invite(&self, format: Format) -> Result<(), Failure> {
        match &self.hub {
            Some(hub) => {
                eprint!("{}", invitation(hub, format)?);
                Ok(())
            }
            None => Ok(()),
        }
    }
}

/// A hub that listens there, with pages in that language.
///
/// # Errors
/// [`Failure::Input`] where it cannot.
pub fn start(listen: SocketAddr, always_tls: bool, language: Language) -> Result<Hub, Failure> {
    let name = computer();
    let names = name.iter().cloned();
    let names = names.chain(name.iter().map(|name| format!("{name}.local")));
    let config = Config {
        listen,
        always_tls,
        folder: folder()?,
        names: names.collect(),
        language: language.code(),
    };
    Hub::start(config).input()
}

/// How one more browser comes in, in lines.
///
/// # Errors
/// [`Failure::Other`] where the system has no randomness.
pub fn invitation(hub: &Hub, format: Format) -> Result<String, Failure> {
    let one = hub.invite().other()?;
    let fingerprint = hub.fingerprint().map(|it| it.to_string());
    if format == Format::Json {
        let said = Said {
            console: &one.address,
            code: &one.code,
            fingerprint,
        };
        return Ok(serde_json::to_string(&said).other()? + "\n");
    }
    let mut text = format!("console, for one browser: {}\n", one.address);
    if let Some(fingerprint) = fingerprint {
        text += &format!("its certificate has the fingerprint {fingerprint}\n");
    }
    if !hub.address().ip().is_loopback() {
        text += &one.qr();
        text.push('\n');
    }
    Ok(text)
}

/// The description of a program of that name for an instructor: a session, in which scenes can be brought up, or a replay.
pub fn student((name, texts): (Option<&str>, &Texts), is_session: bool) -> Student {
    let name = name.map(str::to_owned).or_else(computer);
    let name = name.unwrap_or_else(|| "computer".to_owned());
    let kind = |order: Order| match order {
        Order::Correct => Kind::Correct,
        Order::Incorrect => Kind::Incorrect,
        Order::Neither => Kind::Other,
    };
    let choices = CHOICES.iter().filter(|_| is_session);
    Student {
        name: Text::clipped(&name),
        version: Text::clipped(env!("CARGO_PKG_VERSION")),
        choices: List::clipped(choices.map(|choice| Choice {
            title: Text::clipped(texts.scene(choice.scene)),
            kind: kind(choice.order),
            counterpart: choice.counterpart.and_then(index),
        })),
        replays: !is_session,
        close_up: true,
        k_v: is_session.then_some(Range {
            least: 0.0,
            most: MOST_INTENSITY,
        }),
    }
}

/// A hub's address, or a file that holds one, which nobody sees in a list of processes.
pub fn hub_address(text: &str) -> Result<HubAddress, String> {
    let file = Path::new(text);
    if !file.is_file() {
        return text
            .parse::<HubAddress>()
            .map_err(|error| format!("there is no such file, and {error}"));
    }
    let line = files::read_line(file, "hub's address").map_err(|error| error.to_string())?;
    line.parse::<HubAddress>()
        .map_err(|error| format!("{}: {error}", file.display()))
}

/// Where a console listens: an address and a port, a computer's name and a port, or a port of this computer alone.
///
/// # Errors
/// What is to be given.
pub fn listen_address(text: &str) -> Result<SocketAddr, String> {
    if let Ok(port) = text.parse::<u16>() {
        return Ok(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port));
    }
    // A name may have addresses of both kinds; a port alone is IPv4's too.
    let found = text.to_socket_addrs().ok();
    let found = found.and_then(|found| found.min_by_key(SocketAddr::is_ipv6));
    found.ok_or_else(|| {
        "no such address or port; give an address and a port, such as 0.0.0.0:8470, a name and a port, such as localhost:8470, \
         or a port of this computer; a port is 0 to 65535"
            .to_owned()
    })
}

/// The user's folder for the program's data.
fn folder() -> Result<PathBuf, Failure> {
    let folder = dirs::data_dir().map(|folder| folder.join("vitriol"));
    folder
        .ok_or("this system tells no folder for data, in which the console's certificate is kept: set HOME")
        .input()
}

/// What this computer is called.
fn computer() -> Option<String> {
    let named = std::env::var("COMPUTERNAME").ok();
    let said = || std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let name = named.or_else(said)?.trim().to_owned();
    (!name.is_empty()).then_some(name)
}

/// A hub on this computer, and the console of Ada's program in it: a session, or a replay.
#[cfg(test)]
#[allow(clippy::unwrap_used)]
pub fn ada(is_session: bool) -> (Hub, Console) {
    let args = ConsoleArgs {
        name: Some("Ada".to_owned()),
        ..ConsoleArgs::default()
    };
    let serving = Serving::begin(&args, Language::En, is_session).unwrap();
    (serving.hub.unwrap(), serving.console)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Addresses of RFC 6890: 127.0.0.1 is this computer's, 0.0.0.0 all of its own.
    #[test]
    fn a_console_listens_at_an_address_a_name_or_a_port() {
        for (given, meant) in [
            ("0.0.0.0:8470", "0.0.0.0:8470"),
            ("[::1]:8470", "[::1]:8470"),
            ("localhost:8470", "127.0.0.1:8470"),
            ("8470", "127.0.0.1:8470"),
        ] {
            assert_eq!(listen_address(given), Ok(meant.parse().unwrap()), "{given}");
        }
        for wrong in ["", "localhost", "0.0.0.0", "70000", "localhost:port"] {
            let message = listen_address(wrong).unwrap_err();
            for part in ["localhost:8470", "0 to 65535"] {
                assert!(message.contains(part), "{wrong}: {message}");
            }
        }
    }
}
