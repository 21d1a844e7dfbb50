use glam::DVec3;

use super::*;

/// VTK's legacy format has no spaces in names, and meshio takes a scalar with a number of components for a column.
#[test]
fn names_have_no_spaces_and_scalars_no_components() {
    let particles = Particles {
        id: vec![7],
        position: vec![DVec3::ONE],
        velocity: vec![DVec3::ZERO],
        volume: vec![1e-9],
        mass: vec![1e-6],
        flask: vec![-1],
        temperature: vec![20.0],
        acid: vec![0.5],
    };
    let file = bytes(&particles, 0.5);
    let text = String::from_utf8_lossy(&file);
    let arrays: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("<DataArray"))
        .collect();
    assert_eq!(arrays.len(), 11);
    for array in arrays {
        let (_, name) = array.split_once("Name=\"").unwrap_or_default();
        let (name, _) = name.split_once('"').unwrap_or_default();
        assert!(!name.is_empty() && !name.contains(' '), "{array}");
        let is_vector = ["velocity_m_per_s", "Points"].contains(&name);
        let has_components = array.contains("NumberOfComponents=\"3\"");
        assert_eq!(has_components, is_vector, "{array}");
        assert_eq!(array.contains("NumberOfComponents"), is_vector, "{array}");
    }
}
