//! Eigenvalues and eigenvectors of a symmetric 3×3 matrix.

use glam::{DMat3, DVec3};

/// Sweeps over the three off-diagonal elements. Convergence is quadratic: from
/// any matrix the sixth leaves nothing above rounding.
const SWEEPS: usize = 12;

/// Eigenvalues of a symmetric `matrix`, the largest first, and their unit
/// eigenvectors as the columns of a rotation or reflection.
///
/// Jacobi's rotations: slower than the closed form, which the GPU uses, but
/// exact for equal eigenvalues, so that it can be the truth for that.
pub fn eigen_symmetric(matrix: DMat3) -> (DVec3, DMat3) {
    let mut a = matrix.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut a, &mut v, p, q);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    (
        DVec3::from_array(order.map(|k| a[k][k])),
        DMat3::from_cols_array_2d(&order.map(|k| v[k])),
    )
}

/// Turns the plane of axes p and q such that their off-diagonal element is 0
/// (Golub & Van Loan, Matrix Computations, section 8.5.2).
fn rotate(a: &mut [[f64; 3]; 3], v: &mut [[f64; 3]; 3], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = tau.signum() / (tau.abs() + tau.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    let (app, aqq, apq) = (a[p][p], a[q][q], a[p][q]);
    a[p][p] = app - t * apq;
    a[q][q] = aqq + t * apq;
    (a[p][q], a[q][p]) = (0.0, 0.0);
    let k = 3 - p - q;
    let (akp, akq) = (a[k][p], a[k][q]);
    a[k][p] = c * akp - s * akq;
    a[k][q] = s * akp + c * akq;
    (a[p][k], a[q][k]) = (a[k][p], a[k][q]);
    let (vp, vq) = (v[p], v[q]);
    for row in 0..3 {
        v[p][row] = c * vp[row] - s * vq[row];
        v[q][row] = s * vp[row] + c * vq[row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    /// A V = V Λ, V orthonormal, and the eigenvalues those that the matrix was
    /// made of.
    fn check(values: DVec3, rotation: DQuat) {
        let axes = DMat3::from_quat(rotation);
        let matrix = axes * DMat3::from_diagonal(values) * axes.transpose();
        let (found, vectors) = eigen_symmetric(matrix);
        let scale = values.abs().max_element();
        assert!(
            (found - values).length() < 1e-14 * scale,
            "{found} {values}"
        );
        let orthonormal = vectors.transpose() * vectors - DMat3::IDENTITY;
        let back = vectors * DMat3::from_diagonal(found) * vectors.transpose() - matrix;
        for k in 0..3 {
            assert!(orthonormal.col(k).length() < 1e-14);
            assert!(back.col(k).length() < 1e-14 * scale);
        }
    }

    #[test]
    fn known_matrices_are_taken_apart() {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.3);
        for values in [
            DVec3::new(3.0, 2.0, 1.0),
            DVec3::new(1.0, 1.0, 0.4),
            DVec3::splat(0.7),
            // Covariances of 2 mm particles, and of a line of them.
            DVec3::new(6e-6, 6e-6, 2.4e-6),
            DVec3::new(6e-6, 0.0, 0.0),
        ] {
            check(values, DQuat::IDENTITY);
            check(values, turn);
        }
    }
}
