//! Which barrier a pass needs, from what it and the passes before it access.
//!
//! Pure data: no Vulkan call happens here, so that the planner can be checked
//! against a brute-force one (see the tests). Accesses are sets of [`Scope`]
//! kinds, each of which is one pair of pipeline stage and memory access. One
//! global barrier covers all resources: on every driver we know it costs the
//! same as one buffer barrier, and many passes need several of those.

use ash::vk::{AccessFlags2 as A, PipelineStageFlags2 as S};

/// A set of access kinds.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Scope(pub(crate) u32);

impl std::fmt::Debug for Scope {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Scope({:#b})", self.0)
    }
}

/// Stage and access, by bit of [`Scope`].
const KINDS: [(S, A); Scope::COUNT as usize] = [
    (S::COMPUTE_SHADER, A::SHADER_STORAGE_READ),
    (S::COMPUTE_SHADER, A::SHADER_STORAGE_WRITE),
    (S::COMPUTE_SHADER, A::UNIFORM_READ),
    (S::COMPUTE_SHADER, A::SHADER_SAMPLED_READ),
    (S::VERTEX_SHADER, A::SHADER_STORAGE_READ),
    (S::FRAGMENT_SHADER, A::SHADER_STORAGE_READ),
    (
        S::COLOR_ATTACHMENT_OUTPUT,
        A::from_raw(A::COLOR_ATTACHMENT_READ.as_raw() | A::COLOR_ATTACHMENT_WRITE.as_raw()),
    ),
    (S::DRAW_INDIRECT, A::INDIRECT_COMMAND_READ),
    (S::INDEX_INPUT, A::INDEX_READ),
    (S::ALL_TRANSFER, A::TRANSFER_READ),
    (S::ALL_TRANSFER, A::TRANSFER_WRITE),
];

impl Scope {
    const COUNT: u32 = 11;
    pub(crate) const NONE: Self = Self(0);
    pub(crate) const COMPUTE_READ: Self = Self(1);
    pub(crate) const COMPUTE_WRITE: Self = Self(1 << 1);
    pub(crate) const COMPUTE_UNIFORM: Self = Self(1 << 2);
    pub(crate) const COMPUTE_SAMPLED: Self = Self(1 << 3);
    pub(crate) const VERTEX_READ: Self = Self(1 << 4);
    pub(crate) const FRAGMENT_READ: Self = Self(1 << 5);
    pub(crate) const COLOUR: Self = Self(1 << 6);
    pub(crate) const INDIRECT: Self = Self(1 << 7);
    pub(crate) const INDEX: Self = Self(1 << 8);
    pub(crate) const COPY_READ: Self = Self(1 << 9);
    pub(crate) const COPY_WRITE: Self = Self(1 << 10);
    const COMPUTE: Self = Self(0b1111);
    const WRITES: Self = Self(Self::COMPUTE_WRITE.0 | Self::COLOUR.0 | Self::COPY_WRITE.0);

    pub(crate) const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
    pub(crate) const fn is_empty(self) -> bool {
        self.0 == 0
    }
    /// The kinds of this set that write.
    pub(crate) const fn writes(self) -> Self {
        self.and(Self::WRITES)
    }
    /// The kinds of this set that only read.
    pub(crate) const fn reads(self) -> Self {
        self.without(Self::WRITES)
    }

    /// All kinds of the compute stage where this set has one of them. Widening is
    /// free on the device (caches are flushed by stage, not by binding) and saves
    /// the barrier that the next pass would otherwise need.
    fn widened(self) -> Self {
        if self.and(Self::COMPUTE).is_empty() {
            self
        } else {
            self.union(Self::COMPUTE)
        }
    }

    /// Pipeline stages of this set.
    pub(crate) fn stages(self) -> S {
        self.kinds().fold(S::NONE, |all, (stage, _)| all | stage)
    }

    /// Memory accesses of this set.
    pub(crate) fn accesses(self) -> A {
        self.kinds().fold(A::NONE, |all, (_, access)| all | access)
    }

    /// Memory accesses of this set that write: a barrier's source has nothing
    /// to make available for a read.
    pub(crate) fn write_accesses(self) -> A {
        self.writes().accesses()
    }

    fn kinds(self) -> impl Iterator<Item = (S, A)> {
        self.bits().map(|bit| KINDS[bit as usize])
    }

    /// Numbers of its bits, lowest first.
    fn bits(self) -> impl Iterator<Item = u32> {
        let mut left = self.0;
        std::iter::from_fn(move || {
            let bit = left.trailing_zeros();
            left &= left.wrapping_sub(1);
            (bit < 32).then_some(bit)
        })
    }
}

/// One resource's part in a pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Use {
    /// Index from [`Planner::add`].
    pub(crate) slot: u32,
    /// Every way in which the pass accesses it.
    pub(crate) scope: Scope,
}

/// One global memory barrier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Barrier {
    pub(crate) src: Scope,
    pub(crate) dst: Scope,
}

/// One resource's accesses since the last write that another followed.
#[derive(Clone, Copy, Default)]
struct State {
    /// Kinds of the last write.
    write: Scope,
    /// Kinds of the reads since.
    reads: Scope,
    /// By kind of `write` and `reads`: what comes after the last access of that
    /// kind and, for a write, sees it.
    after: [Scope; Scope::COUNT as usize],
    /// Pass that did the last write.
    pass: u32,
}

impl State {
    /// Of `earlier`, the kinds that do not all of `later` come after.
    fn unordered(&self, earlier: Scope, later: Scope) -> Scope {
        earlier
            .bits()
            .filter(|bit| !later.without(self.after[*bit as usize]).is_empty())
            .fold(Scope::NONE, |all, bit| all.union(Scope(1 << bit)))
    }
}

/// Accesses since the start of a recorder, resource by resource.
#[derive(Default)]
pub(crate) struct Planner {
    states: Vec<State>,
    pass: u32,
}

impl Planner {
    /// Forgets everything, keeps its memory.
    pub(crate) fn clear(&mut self) {
        self.states.clear();
        self.pass = 0;
    }

    /// A new resource that nothing has accessed.
    pub(crate) fn add(&mut self) -> u32 {
        self.states.push(State::default());
        self.states.len() as u32 - 1
    }

    /// The barrier that must stand before a pass with these uses, if any; then
    /// counts the pass as recorded.
    pub(crate) fn pass(&mut self, uses: &[Use]) -> Option<Barrier> {
        let mut src = Scope::NONE;
        let mut dst = Scope::NONE;
        for used in uses {
            let state = &self.states[used.slot as usize];
            let mut need = |earlier: Scope, later: Scope| {
                if !earlier.is_empty() {
                    src = src.union(earlier);
                    dst = dst.union(later);
                }
            };
            // Read or write after write, then write after read.
            need(state.unordered(state.write, used.scope), used.scope);
            let writes = used.scope.writes();
            need(state.unordered(state.reads, writes), writes);
        }
        let barrier = (!src.is_empty()).then(|| Barrier {
            src: src.widened(),
            dst: dst.widened(),
        });
        if let Some(barrier) = barrier {
            self.cover(barrier);
        }
        self.record(uses);
        barrier
    }

    /// A layout transition of one image before a pass that uses it as `dst`:
    /// the source scope that its image barrier must wait for.
    pub(crate) fn transition(&mut self, slot: u32, dst: Scope) -> Scope {
        let state = &mut self.states[slot as usize];
        let earlier = state.write.union(state.reads);
        // The transition itself writes; it is ordered before `dst`, so a
        // barrier whose source holds `dst` chains to it.
        state.write = dst;
        state.reads = Scope::NONE;
        state.pass = 0;
        for bit in dst.bits() {
            state.after[bit as usize] = dst;
        }
        // Nothing earlier in this recorder: chain to its opening barrier,
        // which ends at all stages.
        if earlier.is_empty() { dst } else { earlier }
    }

    fn cover(&mut self, barrier: Barrier) {
        for state in &mut self.states {
            for bit in state.write.union(state.reads).bits() {
                let after = &mut state.after[bit as usize];
                // Either the barrier waits for the access itself, or for
                // something that an earlier barrier put after it (a chain).
                if !after.union(Scope(1 << bit)).and(barrier.src).is_empty() {
                    *after = after.union(barrier.dst);
                }
            }
        }
    }

    fn record(&mut self, uses: &[Use]) {
        self.pass += 1;
        for used in uses.iter().filter(|used| !used.scope.writes().is_empty()) {
            let state = &mut self.states[used.slot as usize];
            if state.pass != self.pass {
                state.write = Scope::NONE;
                state.reads = Scope::NONE;
                state.pass = self.pass;
            }
            state.write = state.write.union(used.scope.writes());
            for bit in used.scope.writes().bits() {
                state.after[bit as usize] = Scope::NONE;
            }
        }
        for used in uses {
            let state = &mut self.states[used.slot as usize];
            state.reads = state.reads.union(used.scope.reads());
            for bit in used.scope.reads().bits() {
                state.after[bit as usize] = Scope::NONE;
            }
        }
    }
}

#[cfg(test)]
mod tests;
