//! Results of `vitriol fidelity`.

use serde::Serialize;
use vitriol_run::DeviceStatement;
use vitriol_run::units::grouped;

/// Results of `vitriol fidelity`.
#[derive(Debug, Clone, Serialize)]
pub struct Fidelity {
    /// The device that drew.
    pub device: DeviceStatement,
    /// The liquids.
    pub states: Vec<StateRow>,
    /// Each way of drawing at each resolution, over all states and views.
    pub rows: Vec<DrawnRow>,
    /// Each way of drawing at each resolution, for each state and view.
    pub pictures: Vec<Picture>,
    /// Wall time, s.
    pub seconds: f64,
}

/// A liquid that was compared.
#[derive(Debug, Clone, Serialize)]
pub struct StateRow {
    /// Its name.
    pub state: String,
    /// The scene.
    pub scene: String,
    /// Simulated time, s.
    pub seconds: f64,
    /// Particles.
    pub particles: usize,
    /// Particle spacing d, m; a particle's radius is half of it.
    pub spacing_m: f64,
    /// Their volume, mL.
    pub volume_ml: f64,
}

/// How a liquid is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Manner {
    /// The filter, or `reference` for the truth itself, whose figures are what
    /// the measures make of an exact picture.
    pub filter: &'static str,
    /// Whether with Yu and Turk's anisotropy.
    pub anisotropy: bool,
}

impl Manner {
    /// The truth.
    pub const REFERENCE: Self = Self::new("reference", true);

    /// A filter by its name in the scene's file, with or without anisotropy.
    pub const fn new(filter: &'static str, anisotropy: bool) -> Self {
        Self { filter, anisotropy }
    }
}

/// Errors of one picture, or of several.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Figures {
    /// Intersection over union of the silhouettes; the least of several.
    pub silhouette_iou: f64,
    /// Share of the true silhouettes' pixels that lie away from them, so that
    /// depths and normals are compared there.
    pub compared: f64,
    /// Root mean square of the depths' differences away from silhouettes,
    /// particle radii.
    pub depth_rms_radii: f64,
    /// Mean of the depths' differences there, particle radii; above 0 where the drawn surface lies behind.
    pub depth_mean_radii: f64,
    /// Mean angle between the normals away from silhouettes, degrees.
    pub normal_angle_deg: f64,
    /// Root mean square difference of one eye's depth from the other's where both see the liquid, particle radii.
    pub reprojection_rms_radii: f64,
    /// Root mean square difference of the depths from two successive places of a moving head, particle radii.
    pub flicker_rms_radii: f64,
    /// Mean angle between the normals from these two places, degrees.
    pub flicker_normal_deg: f64,
    /// Volume by the thickness over the particles' volume; of several pictures the one farthest from 1.
    pub volume_ratio: f64,
}

/// A way of drawing at a resolution, of one picture or over all states and views.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct DrawnRow {
    /// Width and height of an eye's picture, pixels.
    pub size: [u32; 2],
    /// Pixels that were kept away from silhouettes, the most of the views.
    pub margin_px: usize,
    /// How it is drawn.
    #[serde(flatten)]
    pub manner: Manner,
    /// Its errors.
    #[serde(flatten)]
    pub figures: Figures,
}

/// A way of drawing, in one state and view.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Picture {
    /// The liquid.
    pub state: &'static str,
    /// The head's place.
    pub view: &'static str,
    /// Resolution, way of drawing, and errors.
    #[serde(flatten)]
    pub row: DrawnRow,
}

impl Figures {
    /// Figures of several pictures, each counting alike; NaN is of a picture without compared pixels, and is left out.
    fn of(each: &[Self]) -> Self {
        let values = |get: fn(&Self) -> f64| each.iter().map(get).filter(|value| !value.is_nan());
        let mean = |get: fn(&Self) -> f64| values(get).sum::<f64>() / values(get).count() as f64;
        let rms = |get: fn(&Self) -> f64| {
            let squares: f64 = values(get).map(|value| value * value).sum();
            (squares / values(get).count() as f64).sqrt()
        };
        let off = |ratio: &f64| (ratio - 1.0).abs();
        Self {
            silhouette_iou: values(|f| f.silhouette_iou).fold(f64::NAN, f64::min),
            compared: mean(|f| f.compared),
            depth_rms_radii: rms(|f| f.depth_rms_radii),
            depth_mean_radii: mean(|f| f.depth_mean_radii),
            normal_angle_deg: mean(|f| f.normal_angle_deg),
            reprojection_rms_radii: rms(|f| f.reprojection_rms_radii),
            flicker_rms_radii: rms(|f| f.flicker_rms_radii),
            flicker_normal_deg: mean(|f| f.flicker_normal_deg),
            volume_ratio: values(|f| f.volume_ratio)
                .max_by(|a, b| off(a).total_cmp(&off(b)))
                .unwrap_or(f64::NAN),
        }
    }
}

/// Sums up pictures by resolution and manner, in the order of their first.
pub fn rows(pictures: &[Picture]) -> Vec<DrawnRow> {
    let mut rows: Vec<DrawnRow> = Vec::new();
    for picture in pictures {
        let (size, manner) = (picture.row.size, picture.row.manner);
        if rows
            .iter()
            .any(|row| (row.size, row.manner) == (size, manner))
        {
            continue;
        }
        let same = || {
            let all = pictures.iter().map(|other| &other.row);
            all.filter(|other| (other.size, other.manner) == (size, manner))
        };
        let figures: Vec<Figures> = same().map(|other| other.figures).collect();
        rows.push(DrawnRow {
            size,
            margin_px: same().map(|other| other.margin_px).max().unwrap_or(0),
            manner,
            figures: Figures::of(&figures),
        });
    }
    rows
}

/// The table as text for people.
pub fn describe(found: &Fidelity) -> String {
    let mut text = format!("{}, {}\n", found.device.name, found.device.driver);
    for state in &found.states {
        text += &format!(
            "{}: {} after {} s, {} particles of {:.2} mm, {:.1} mL\n",
            state.state,
            state.scene,
            state.seconds,
            grouped(state.particles as u64),
            1e3 * state.spacing_m,
            state.volume_ml
        );
    }
    text.push_str(
        "\npixels      filter          aniso margin     of    IoU   depth  (mean)  normal\
         \u{20} reproj.  flicker (norm.) volume\n",
    );
    for row in &found.rows {
        let f = &row.figures;
        text += &format!(
            "{:<11} {:<15} {:<5} {:>6} {:>5.0}% {:>6.3} {:>7.3} {:>7.3} {:>6.1}° {:>8.3} {:>8.3} {:>6.1}° {:>6.3}\n",
            format!("{}×{}", row.size[0], row.size[1]),
            row.manner.filter,
            if row.manner.anisotropy { "yes" } else { "no" },
            row.margin_px,
            100.0 * f.compared,
            f.silhouette_iou,
            f.depth_rms_radii,
            f.depth_mean_radii,
            f.normal_angle_deg,
            f.reprojection_rms_radii,
            f.flicker_rms_radii,
            f.flicker_normal_deg,
            f.volume_ratio
        );
    }
    text += &format!(
        "\nIoU and volume: the worst view; the rest: over all of them. Depth, reprojection and \
         flicker: rms in particle radii, at least `margin` pixels from silhouettes.\n{:.0} s\n",
        found.seconds
    );
    text
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn rows_keep_the_worst_and_leave_out_what_is_no_number() {
        let picture = |manner, off: f64, volume_ratio| Picture {
            state: "still",
            view: "close",
            row: DrawnRow {
                size: [320, 240],
                margin_px: 3,
                manner,
                figures: Figures {
                    silhouette_iou: 1.0 - off,
                    compared: off,
                    depth_rms_radii: off,
                    depth_mean_radii: off,
                    normal_angle_deg: off,
                    reprojection_rms_radii: f64::NAN,
                    flicker_rms_radii: off,
                    flicker_normal_deg: off,
                    volume_ratio,
                },
            },
        };
        let drawn = Manner::new("none", true);
        let rows = rows(&[
            picture(Manner::REFERENCE, 0.0, 1.0),
            picture(drawn, 0.1, 1.02),
            picture(drawn, 0.7, 0.97),
            picture(drawn, 0.2, f64::NAN),
        ]);
        let [reference, row] = rows[..] else {
            panic!("{rows:?}");
        };
        assert_eq!(reference.manner, Manner::REFERENCE);
        let f = row.figures;
        assert!((f.silhouette_iou - 0.3).abs() < 1e-12, "{f:?}");
        // √((0.1² + 0.7² + 0.2²)/3) and their mean.
        assert!((f.depth_rms_radii - 0.18_f64.sqrt()).abs() < 1e-12, "{f:?}");
        assert!((f.normal_angle_deg - 1.0 / 3.0).abs() < 1e-12, "{f:?}");
        assert!(f.reprojection_rms_radii.is_nan(), "{f:?}");
        assert_eq!(f.volume_ratio, 0.97);
    }
}
