//! The surface of Yu & Turk 2013 in f64 on the CPU, marched along each pixel's
//! ray: slow and exact, the truth that the picture in screen space is judged
//! by (`vitriol fidelity`), and the anisotropy pass of the GPU with it.

mod anisotropy;
mod buckets;
mod compare;
mod drawn;
mod eigen;
mod field;
mod march;
mod parallel;
mod surroundings;

pub use anisotropy::{Anisotropy, FULL_COVARIANCE, Shape, Sums};
pub use compare::{Difference, Interior, Seen, difference, reprojection, silhouette_iou, volume};
pub use eigen::eigen_symmetric;
pub use field::{Field, SURFACE};
pub use march::{Picture, Rays};
pub use parallel::map as on_all_cores;
pub use surroundings::{Nothing, Surroundings};
