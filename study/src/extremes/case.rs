//! The list of cases.

use vitriol_sim::fill::split_mix;

use super::extreme::{Extreme, directed, random};
use super::recipe::{Base, Recipe};

/// One case.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its number, from which, with the seed, the case follows.
    pub number: usize,
    /// Its extremes, one or two.
    pub extremes: Vec<Extreme>,
    /// The scene with these extremes.
    pub recipe: Recipe,
    /// Seed of the particles' initial jitter.
    pub seed: u64,
}

impl Case {
    /// The case in words.
    pub fn label(&self) -> String {
        let names: Vec<String> = self.extremes.iter().map(Extreme::label).collect();
        format!("{}: {}", self.recipe.base.name(), names.join(" and "))
    }
}

/// The first `count` cases of a seed: the directed ones, then random ones, one in three single and the others in pairs.
pub fn cases(count: usize, seed: u64) -> Vec<Case> {
    let mut all: Vec<(Base, Vec<Extreme>)> = Vec::new();
    for extreme in directed() {
        let bases = Base::ALL.into_iter();
        let of = bases.filter(|&base| extreme.applies_to(base));
        all.extend(of.map(|base| (base, vec![extreme])));
    }
    let mut number = all.len() as u64;
    while all.len() < count {
        all.push(drawn(seed, number));
        number += 1;
    }
    all.truncate(count);
    (0..)
        .zip(all)
        .map(|(number, (base, extremes))| {
            let mut recipe = Recipe::of(base);
            for extreme in &extremes {
                extreme.apply(&mut recipe);
            }
            Case {
                number,
                extremes,
                recipe,
                seed: split_mix(seed ^ number as u64),
            }
        })
        .collect()
}

fn drawn(seed: u64, number: u64) -> (Base, Vec<Extreme>) {
    let mut state = split_mix(seed).wrapping_add(split_mix(number));
    let mut draw = || {
        state = split_mix(state);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let base = Base::ALL[(draw() * 3.0) as usize % 3];
    let wanted = if draw() < 1.0 / 3.0 { 1 } else { 2 };
    let mut extremes: Vec<Extreme> = Vec::new();
    while extremes.len() < wanted {
        let next = random(&mut draw);
        if next.applies_to(base) && !extremes.iter().any(|other| other.excludes(&next)) {
            extremes.push(next);
        }
    }
    (base, extremes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_follows_from_its_number_and_the_seed() {
        let (few, many) = (cases(400, 7), cases(2000, 7));
        assert_eq!(many.len(), 2000);
        for (a, b) in few.iter().zip(&many) {
            assert_eq!((a.label(), a.seed), (b.label(), b.seed));
        }
        let other = cases(2000, 8);
        let differing = many
            .iter()
            .zip(&other)
            .filter(|(a, b)| a.label() != b.label());
        assert!(differing.count() > 1000);
        let pairs = many.iter().filter(|case| case.extremes.len() == 2).count();
        assert!(pairs > 800, "{pairs}");
    }
}
