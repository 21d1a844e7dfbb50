//! Polylines in the (r, y) half-plane.

/// Distance from (r, y) to a polyline of points (r, y).
pub(super) fn distance(line: &[[f64; 2]], r: f64, y: f64) -> f64 {
    line.windows(2)
        .map(|pair| segment_distance_squared(pair[0], pair[1], [r, y]))
        .fold(f64::INFINITY, f64::min)
        .sqrt()
}

/// Point of the polyline that is nearest to (r, y).
pub(super) fn nearest(line: &[[f64; 2]], r: f64, y: f64) -> [f64; 2] {
    let mut best = (f64::INFINITY, [r, y]);
    for pair in line.windows(2) {
        let point = closest_on_segment(pair[0], pair[1], [r, y]);
        let squared = (point[0] - r).powi(2) + (point[1] - y).powi(2);
        if squared < best.0 {
            best = (squared, point);
        }
    }
    best.1
}

fn closest_on_segment(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> [f64; 2] {
    let ab = [b[0] - a[0], b[1] - a[1]];
    let ap = [p[0] - a[0], p[1] - a[1]];
    let length2 = ab[0] * ab[0] + ab[1] * ab[1];
    let t = if length2 > 0.0 {
        ((ap[0] * ab[0] + ap[1] * ab[1]) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    [a[0] + t * ab[0], a[1] + t * ab[1]]
}

fn segment_distance_squared(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let c = closest_on_segment(a, b, p);
    (c[0] - p[0]).powi(2) + (c[1] - p[1]).powi(2)
}

/// Removes points that lie on the straight line between their neighbours, so
/// that a cylinder costs one segment and not as many as its table has rows.
pub(super) fn without_collinear(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for point in points {
        while let [.., a, b] = kept[..] {
            let u = [b[0] - a[0], b[1] - a[1]];
            let v = [point[0] - b[0], point[1] - b[1]];
            let cross = u[0] * v[1] - u[1] * v[0];
            let scale = u[0].hypot(u[1]) * v[0].hypot(v[1]);
            let forward = u[0] * v[0] + u[1] * v[1] >= 0.0;
            // Rounding of the table's interpolation, not a shape.
            if forward && cross.abs() <= 1e-9 * scale {
                kept.pop();
            } else {
                break;
            }
        }
        kept.push(point);
    }
    kept
}

/// Volume of the solid of revolution about the y axis under a polyline whose
/// y ascends.
pub(super) fn volume(line: &[[f64; 2]]) -> f64 {
    line.windows(2)
        .map(|pair| frustum(pair[1][1] - pair[0][1], pair[0][0], pair[1][0]))
        .sum()
}

/// Volume of a conical frustum.
pub(super) fn frustum(height: f64, r0: f64, r1: f64) -> f64 {
    std::f64::consts::PI / 3.0 * height * (r0 * r0 + r0 * r1 + r1 * r1)
}
