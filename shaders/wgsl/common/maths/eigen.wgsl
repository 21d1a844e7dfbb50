//! Eigenvalues and eigenvectors of a symmetric 3 × 3 matrix without iteration, as D. Eberly
//! ("A robust eigensolver for 3 × 3 symmetric matrices", 2014) has it: the values by Cardano's
//! formula, the first vector of that value which stands furthest from the others, as a cross
//! product of rows, the second in the plane at right angles to it, by a 2 × 2 problem.
//!
//! The matrix should be scaled to about 1: it is compared with rounding.

/// A symmetric matrix.
struct Symmetric {
    /// xx, yy, zz.
    diagonal: vec3<f32>,
    /// xy, xz, yz.
    others: vec3<f32>,
}

/// Its values, the greatest first, and their unit vectors as columns.
struct Eigen {
    values: vec3<f32>,
    vectors: mat3x3<f32>,
}

fn apply(m: Symmetric, v: vec3<f32>) -> vec3<f32> {
    return m.diagonal * v + vec3<f32>(
        m.others.x * v.y + m.others.y * v.z,
        m.others.x * v.x + m.others.z * v.z,
        m.others.y * v.x + m.others.z * v.y,
    );
}

/// A unit vector at right angles to the unit vector `n` (T. Duff et al., 2017).
fn right_angle_to(n: vec3<f32>) -> vec3<f32> {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    return vec3<f32>(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

/// The vector of a value that no other is near: the rows of M − value·I span a plane.
fn vector_of(m: Symmetric, value: f32) -> vec3<f32> {
    let row0 = vec3<f32>(m.diagonal.x - value, m.others.x, m.others.y);
    let row1 = vec3<f32>(m.others.x, m.diagonal.y - value, m.others.z);
    let row2 = vec3<f32>(m.others.y, m.others.z, m.diagonal.z - value);
    let a = cross(row0, row1);
    let b = cross(row0, row2);
    let c = cross(row1, row2);
    let sizes = vec3<f32>(dot(a, a), dot(b, b), dot(c, c));
    var longest = select(b, a, sizes.x >= sizes.y);
    longest = select(c, longest, max(sizes.x, sizes.y) >= sizes.z);
    let size = max(max(sizes.x, sizes.y), sizes.z);
    // Of a multiple of the unit matrix any vector will do.
    return select(vec3<f32>(1.0, 0.0, 0.0), longest * inverseSqrt(max(size, 1e-30)), size > 1e-30);
}

fn eigen_of(m: Symmetric) -> Eigen {
    let third = (m.diagonal.x + m.diagonal.y + m.diagonal.z) / 3.0;
    let centred = m.diagonal - third;
    let p = sqrt((dot(centred, centred) + 2.0 * dot(m.others, m.others)) / 6.0);
    let inverse = 1.0 / max(p, 1e-9);
    let b = centred * inverse;
    let o = m.others * inverse;
    let half_determinant = 0.5 * (b.x * (b.y * b.z - o.z * o.z)
        - o.x * (o.x * b.z - o.z * o.y)
        + o.y * (o.x * o.z - b.y * o.y));
    let angle = acos(clamp(half_determinant, -1.0, 1.0)) / 3.0;
    let greatest = 2.0 * cos(angle);
    let least = 2.0 * cos(angle + 2.0943951);
    let values = third + p * vec3<f32>(greatest, -greatest - least, least);

    let first_apart = half_determinant >= 0.0;
    let apart = vector_of(m, select(values.z, values.x, first_apart));
    let u = right_angle_to(apart);
    let v = cross(apart, u);
    // M in the plane of u and v, less the middle value: its rows are along that
    // value's vector turned by a right angle.
    let mu = apply(m, u);
    let uu = dot(u, mu) - values.y;
    let uv = dot(v, mu);
    let vv = dot(v, apply(m, v)) - values.y;
    let row = select(vec2<f32>(uv, vv), vec2<f32>(uu, uv), uu * uu >= vv * vv);
    let size = dot(row, row);
    let turned = row * inverseSqrt(max(size, 1e-30));
    let middle = select(u, turned.y * u - turned.x * v, size > 1e-30);
    let other = cross(apart, middle);
    if (first_apart) { return Eigen(values, mat3x3<f32>(apart, middle, other)); }
    return Eigen(values, mat3x3<f32>(other, middle, apart));
}
