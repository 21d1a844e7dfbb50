//! The planner against a brute-force check of every pair of accesses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;

/// Pseudo-random numbers (Knuth's MMIX constants), so that a failure repeats.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u32) -> u32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32 % limit
    }
}

#[derive(Clone)]
enum Event {
    Pass(Vec<Use>),
    Barrier(Barrier),
}

/// Whether every pair of conflicting accesses of one resource has barriers
/// between its passes that lead from the first access to the second: one whose
/// source holds the first, then any that start from where an earlier one ended.
/// Stands on Vulkan's definition of a dependency chain, not on the planner.
fn covered(events: &[Event]) -> bool {
    for (first, event) in events.iter().enumerate() {
        let Event::Pass(earlier) = event else {
            continue;
        };
        for early in earlier {
            for bit in kinds(early.scope) {
                let mut reached = 0;
                for event in &events[first + 1..] {
                    match event {
                        Event::Barrier(barrier) => {
                            if (bit | reached) & barrier.src.0 != 0 {
                                reached |= barrier.dst.0;
                            }
                        }
                        Event::Pass(later) => {
                            for late in later.iter().filter(|late| late.slot == early.slot) {
                                for other in kinds(late.scope) {
                                    let conflict = (bit | other) & Scope::WRITES.0 != 0;
                                    if conflict && other & reached == 0 {
                                        return false;
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    true
}

fn kinds(scope: Scope) -> impl Iterator<Item = u32> {
    (0..Scope::COUNT)
        .map(|bit| 1 << bit)
        .filter(move |bit| scope.0 & bit != 0)
}

fn random_uses(random: &mut Random, resources: u32) -> Vec<Use> {
    let scopes = [
        Scope::COMPUTE_READ,
        Scope::COMPUTE_READ.union(Scope::COMPUTE_WRITE),
        Scope::COMPUTE_WRITE,
        Scope::COMPUTE_UNIFORM,
        Scope::VERTEX_READ.union(Scope::FRAGMENT_READ),
        Scope::VERTEX_READ,
        Scope::FRAGMENT_READ,
        Scope::COLOUR,
        Scope::INDIRECT,
        Scope::INDEX,
        Scope::COPY_READ,
        Scope::COPY_WRITE,
    ];
    (0..1 + random.below(4))
        .map(|_| Use {
            // The same resource twice in one pass is meant to happen.
            slot: random.below(resources),
            scope: scopes[random.below(scopes.len() as u32) as usize],
        })
        .collect()
}

#[test]
fn no_hazard_uncovered_and_no_barrier_without_one() {
    let mut random = Random(1);
    let (mut barriers, mut passes) = (0, 0);
    for _ in 0..2000 {
        let mut planner = Planner::default();
        let resources = 1 + random.below(5);
        for _ in 0..resources {
            planner.add();
        }
        let mut events = Vec::new();
        for _ in 0..12 {
            let uses = random_uses(&mut random, resources);
            let barrier = planner.pass(&uses);
            passes += 1;
            let mut without = events.clone();
            without.push(Event::Pass(uses.clone()));
            if let Some(barrier) = barrier {
                barriers += 1;
                assert!(
                    !covered(&without),
                    "{barrier:?} before {uses:?} covers nothing"
                );
                events.push(Event::Barrier(barrier));
            }
            events.push(Event::Pass(uses));
            assert!(covered(&events), "a hazard is left before the last pass");
        }
    }
    // Both answers occur often, or the test would show nothing.
    assert!(
        barriers > passes / 10 && barriers < passes * 9 / 10,
        "{barriers} of {passes}"
    );
}

#[test]
fn one_barrier_serves_all_that_came_before() {
    let mut planner = Planner::default();
    let [a, b, c] = [planner.add(), planner.add(), planner.add()];
    let write = |slot| Use {
        slot,
        scope: Scope::COMPUTE_READ.union(Scope::COMPUTE_WRITE),
    };
    let read = |slot| Use {
        slot,
        scope: Scope::COMPUTE_READ,
    };
    assert_eq!(planner.pass(&[write(a)]), None);
    assert_eq!(
        planner.pass(&[write(b)]),
        None,
        "nothing shared with the pass before"
    );
    assert!(planner.pass(&[read(a), write(c)]).is_some());
    assert_eq!(
        planner.pass(&[read(b)]),
        None,
        "the barrier before covered b too"
    );
    assert_eq!(planner.pass(&[read(a), read(b)]), None, "reads need none");
    assert!(planner.pass(&[write(a)]).is_some(), "write after read");
}

#[test]
fn a_transition_is_waited_for() {
    let mut planner = Planner::default();
    let image = planner.add();
    assert_eq!(planner.transition(image, Scope::COLOUR), Scope::COLOUR);
    let draw = [Use {
        slot: image,
        scope: Scope::COLOUR,
    }];
    assert_eq!(planner.pass(&draw), None, "the transition ends at the use");
    // The next transition waits for the drawing.
    assert_eq!(
        planner.transition(image, Scope::COMPUTE_SAMPLED),
        Scope::COLOUR
    );
    let sample = |scope| [Use { slot: image, scope }];
    assert_eq!(planner.pass(&sample(Scope::COMPUTE_SAMPLED)), None);
    // Another stage has not waited for the transition yet.
    let barrier = planner.pass(&sample(Scope::FRAGMENT_READ)).unwrap();
    assert_ne!(barrier.src.0 & Scope::COMPUTE_SAMPLED.0, 0);
}
