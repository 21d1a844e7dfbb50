//! Passes over ellipsoids, each of which some invocations share: its pixels are looped over in blocks of
//! eight by `LANES` over eight.

//!include common/picture/lanes.wgsl
//!include common/picture/silhouette.wgsl

@group(0) @binding(1) var<storage, read> ellipsoids: array<Ellipsoid>;

struct Splats {
    /// Number of particles.
    count: u32,
}

var<immediate> splats: Splats;

/// Invocations that share an ellipsoid.
override LANES: u32 = 8u;
