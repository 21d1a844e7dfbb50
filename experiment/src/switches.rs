//! The switches that a track may hold beside its poses: their keys, and their
//! values read.

/// Key of the switch to another scene, which its value names.
pub const SWITCH_SCENE: &str = "scene";
/// Key of the switch back to the start of the scene, which its value names.
pub const SWITCH_START: &str = "start";
/// Key of the switch to other substeps and iterations, its value such as `8x4`.
pub const SWITCH_SOLVER: &str = "solver";

/// Key of the switch that keeps where the bench stands in the room: `stage_from_scene` as position (m)
/// and angle about Y (rad). Where it comes, the hands leap in the scene, because she was recentred or not seen for a while:
/// what they hold goes with them.
pub const SWITCH_PLACEMENT: &str = "stage_from_scene";

/// Key of the switch that says whether glass breaks from the next step on, and in every scene from then on.
pub const SWITCH_GLASS: &str = "glass";
/// Values of [`SWITCH_GLASS`], where it does not and where it does.
pub const GLASS: [&str; 2] = ["holds", "breaks"];

/// Two whole numbers above zero, such as a solver's substeps and iterations, or a picture's sides.
pub fn pair(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').map(|(w, h)| [w.parse(), h.parse()]);
    match sides {
        Some([Ok(width), Ok(height)]) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("give two whole numbers above 0 with an x between them, such as 960x540".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_two_numbers_above_zero() {
        assert_eq!(pair("960x540"), Ok([960, 540]));
        for wrong in ["960", "960x", "0x540", "960,540", "-1x2", "axb"] {
            assert!(pair(wrong).is_err(), "{wrong}");
        }
    }
}
