//! A report in parts: each process runs a range of cases, and their results become one report.

use std::borrow::Cow;
use std::ops::Range;
use std::path::PathBuf;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use vitriol_run::track::blame;
use vitriol_run::{Blame, DeviceStatement, Failure};
use vitriol_xr::files;

/// A name that was written in the program, or read from a report.
pub type Name = Cow<'static, str>;

/// Longest report that is read, B: two thousand failed cases have some 2 MB.
const LONGEST: u64 = 64 << 20;

/// Errors of parts of a report.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum MergeError {
    /// A part differs from the first one in a setting of the call.
    #[error(
        "{path}: is of {what} {found}, and the first part is of {expected}; merge what belongs together"
    )]
    Other {
        /// The file.
        path: PathBuf,
        /// The setting.
        what: &'static str,
        /// Its value in this part.
        found: String,
        /// Its value in the first part.
        expected: String,
    },
    /// No part has these cases.
    #[error("cases {from}..{to} are in none of the parts; run them, then merge again")]
    Missing {
        /// The first case.
        from: usize,
        /// The case behind the last.
        to: usize,
    },
    /// Several parts have these cases.
    #[error("{path}: has cases {from}..{to} that another part has; leave one of them out")]
    Twice {
        /// The file.
        path: PathBuf,
        /// The first case.
        from: usize,
        /// The case behind the last.
        to: usize,
    },
    /// The file is no such report.
    #[error("{path}: is no such report: {cause}; name the JSON files that parts were written to")]
    NoReport {
        /// The file.
        path: PathBuf,
        /// The parser's error.
        cause: String,
    },
}

/// Reads the parts.
///
/// # Errors
/// [`Failure::Input`] for a file that is no report, [`Failure::Other`] for an error of the system.
pub fn read<T: DeserializeOwned>(paths: &[PathBuf]) -> Result<Vec<(PathBuf, T)>, Failure> {
    let one = |path: &PathBuf| {
        if !path.exists() {
            return Err(format!(
                "{}: no such file; name the reports of parts",
                path.display()
            ))
            .input();
        }
        let text =
            files::read_text(path, "report", LONGEST).map_err(|error| blame(error.into()))?;
        let part = serde_json::from_str(&text).map_err(|error| MergeError::NoReport {
            path: path.clone(),
            cause: error.to_string(),
        });
        Ok((path.clone(), part.input()?))
    };
    paths.iter().map(one).collect()
}

/// Puts parts in the order of their cases, of which each has to be in exactly one part: from the first part's first case on, and up to
/// `end` where that is known.
///
/// # Errors
/// [`MergeError::Missing`] and [`MergeError::Twice`].
pub fn in_order<T>(
    parts: &mut [(PathBuf, T)],
    range: impl Fn(&T) -> Range<usize>,
    whole: Range<Option<usize>>,
) -> Result<(), MergeError> {
    parts.sort_by_key(|(_, part)| (range(part).start, range(part).end));
    // A part without cases is no hole and fills none.
    let ranges = || {
        let all = parts.iter().map(|(path, part)| (path, range(part)));
        all.filter(|(_, range)| !range.is_empty())
    };
    let first = ranges().next().map_or(0, |(_, range)| range.start);
    let mut next = whole.start.unwrap_or(first);
    for (path, Range { start, end }) in ranges() {
        if start > next {
            return Err(MergeError::Missing {
                from: next,
                to: start,
            });
        }
        if start < next {
            return Err(MergeError::Twice {
                path: path.clone(),
                from: start,
                to: end.min(next),
            });
        }
        next = end;
    }
    match whole.end {
        Some(end) if next < end => Err(MergeError::Missing {
            from: next,
            to: end,
        }),
        _ => Ok(()),
    }
}

/// Checks that all parts have the first one's value of a setting.
///
/// # Errors
/// [`MergeError::Other`].
pub fn alike<T>(
    parts: &[(PathBuf, T)],
    what: &'static str,
    of: impl Fn(&T) -> String,
) -> Result<(), MergeError> {
    let Some((_, first)) = parts.first() else {
        return Ok(());
    };
    let expected = of(first);
    let other = parts.iter().find(|(_, part)| of(part) != expected);
    other.map_or(Ok(()), |(path, part)| {
        Err(MergeError::Other {
            path: path.clone(),
            what,
            found: of(part),
            expected,
        })
    })
}

/// The devices of several parts: all different ones, one after the other.
pub fn devices<'a>(all: impl Iterator<Item = &'a DeviceStatement>) -> DeviceStatement {
    let mut different: Vec<&DeviceStatement> = Vec::new();
    for device in all {
        if !different.contains(&device) {
            different.push(device);
        }
    }
    let joined = |of: fn(&DeviceStatement) -> &String| {
        let all: Vec<&str> = different.iter().map(|it| of(it).as_str()).collect();
        all.join("; ")
    };
    DeviceStatement {
        name: joined(|it| &it.name),
        driver: joined(|it| &it.driver),
        api: joined(|it| &it.api),
    }
}

/// Reads a number that JSON may not have: null is NaN.
///
/// # Errors
/// The deserializer's error.
pub fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

/// Reads an array of `N` numbers, each as [`number`] does: null is NaN.
///
/// # Errors
/// The deserializer's error.
pub fn numbers<'de, D: Deserializer<'de>, const N: usize>(from: D) -> Result<[f64; N], D::Error>
where
    [Option<f64>; N]: Deserialize<'de>,
{
    let all: [Option<f64>; N] = Deserialize::deserialize(from)?;
    Ok(all.map(|value| value.unwrap_or(f64::NAN)))
}

/// Reads a maximum, which is never NaN: null is infinity.
///
/// # Errors
/// The deserializer's error.
pub fn largest<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn parts(ranges: &[Range<usize>]) -> Vec<(PathBuf, Range<usize>)> {
        let named = (0..).zip(ranges);
        named
            .map(|(n, range)| (PathBuf::from(format!("{n}.json")), range.clone()))
            .collect()
    }

    #[test]
    fn every_case_is_in_one_part() {
        let ordered = |ranges: &[Range<usize>], whole| {
            let mut parts = parts(ranges);
            in_order(&mut parts, Clone::clone, whole)?;
            Ok(parts.iter().map(|(_, it)| it.start).collect::<Vec<_>>())
        };
        let all = Some(0)..Some(9);
        assert_eq!(ordered(&[5..9, 0..2, 2..5], all.clone()), Ok(vec![0, 2, 5]));
        assert_eq!(ordered(&[5..9, 3..3, 0..5], all.clone()), Ok(vec![0, 3, 5]));
        let missing = |from, to| Err(MergeError::Missing { from, to });
        assert_eq!(ordered(&[5..9, 0..2], all.clone()), missing(2, 5));
        assert_eq!(ordered(&[1..1, 1..9], all.clone()), missing(0, 1));
        assert_eq!(ordered(&[0..5, 5..5], all.clone()), missing(5, 9));
        assert_eq!(ordered(&[], all.clone()), missing(0, 9));
        let twice = ordered(&[0..5, 4..9], all);
        let path = "1.json".into();
        assert_eq!(
            twice,
            Err(MergeError::Twice {
                path,
                from: 4,
                to: 5
            })
        );
        // Where the ends are not known, there are no holes between them.
        assert_eq!(ordered(&[7..9, 3..7], None..None), Ok(vec![3, 7]));
    }

    #[test]
    fn parts_are_of_one_call() {
        let mut parts = parts(&[0..1, 1..2]);
        assert_eq!(alike(&parts, "a seed of", |_| "7".into()), Ok(()));
        parts[1].1 = 5..6;
        let error = alike(&parts, "seed", |it| it.len().to_string());
        assert_eq!(error, Ok(()));
        let error = alike(&parts, "seed", |it| it.start.to_string()).unwrap_err();
        assert!(
            error.to_string().contains("1.json: is of seed 5"),
            "{error}"
        );
    }
}
