//! Where tools may be, and the error for one that is elsewhere.

use super::{GOOD, assert_parts};
use crate::scene::{Scene, ToolKind};

const TABLE: &str = "[table]\ntop = 0.5\ncentre = [0.0, 0.0]\nsize = [1.2, 0.6]\n";

fn scene(table: &str, tools: &[(&str, &str, &str)]) -> Result<Scene, String> {
    let mut text = GOOD.to_owned() + table;
    for (kind, position, more) in tools {
        text += &format!("[[tool]]\nkind = \"{kind}\"\nposition = {position}\n{more}");
    }
    Scene::parse(&text, "tools.toml").map_err(|error| error.to_string())
}

#[test]
fn tools_lie_on_the_bench() {
    let cloth = |position| scene(TABLE, &[("cloth", position, "")]);
    for position in ["[0.6, 0.5, -0.3]", "[-0.6, 0.9, 0.3]"] {
        cloth(position).unwrap();
    }
    let cases = [
        ("[0.61, 0.5, 0.0]", "tool[0].position[0]", "over the table"),
        ("[0.0, 0.5, -0.31]", "tool[0].position[2]", "over the table"),
        ("[0.0, 0.49, 0.0]", "tool[0].position[1]", "table's top"),
        ("[0.0, nan, 0.0]", "tool[0].position", "10 km"),
    ];
    for (position, field, must) in cases {
        let error = cloth(position).unwrap_err();
        assert_parts(&error, &[field, must]);
    }
    // A tool that lies on its side counts by its middle.
    scene(TABLE, &[("rod", "[0.59, 0.5, 0.0]", "")]).unwrap();
    // Without a table it lies where it is put.
    scene("", &[("cloth", "[5.0, 0.0, 0.0]", "")]).unwrap();
    let twice = scene(TABLE, &[("rod", "[0.0, 0.5, 0.0]", ""); 2]).unwrap_err();
    assert_parts(&twice, &["tool[1].kind", "one of each"]);
    let worn = scene(TABLE, &[("rod", "[0.0, 0.5, 0.0]", "worn = true\n")]).unwrap_err();
    assert!(worn.contains("tool[0].worn"), "{worn}");
}

#[test]
fn a_sash_slides_over_the_bench() {
    let sash = |position| scene(TABLE, &[("sash", position, "")]);
    for position in ["[0.0, 0.5, 0.2]", "[0.0, 1.05, 0.2]"] {
        let scene = sash(position).unwrap();
        let bar = scene.tool(ToolKind::Sash).unwrap().stage_from_tool;
        // Its bar is 1.1 m long, to the left from its right end.
        assert!((bar.position.x - 0.55).abs() < 1e-6 && (bar.position.z - 0.2).abs() < 1e-6);
    }
    for position in ["[0.0, 0.49, 0.2]", "[0.0, 1.06, 0.2]"] {
        let error = sash(position).unwrap_err();
        assert_parts(&error, &["tool[0].position[1]", "0.55 m"]);
    }
    let error = scene("", &[("sash", "[0.0, 0.5, 0.2]", "")]).unwrap_err();
    assert_parts(&error, &["tool[0].kind", "[table]"]);
}
