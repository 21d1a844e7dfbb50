//! Triangle meshes of the glass and what is printed on it.

use glam::{Vec2, Vec3};
use vitriol_shaders::layout::MeshVertex;

/// Facets around an axis: at 72 the chord of a 90 mm beaker leaves its circle
/// by 0.04 mm, well under a pixel of the film.
const FACETS: u32 = 72;

/// Facets of a printed line.
const MARK_FACETS: u32 = 6;

/// Outline segments that meet at less than this share a smooth normal; a
/// beaker's rim and foot stay sharp.
const CREASE_COS: f32 = 0.77;

/// What a triangle is made of; the shaders' `MATERIAL_` constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Material {
    /// Laboratory glass.
    Glass = 0,
    /// White enamel printed on glass.
    Enamel = 1,
}

/// Triangles wound counter-clockwise seen from outside the solid.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The vertices that `indices` name.
    pub vertices: Vec<MeshVertex>,
    /// Three a triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    fn vertex(&mut self, position: Vec3, normal: Vec3, material: Material) -> u32 {
        self.vertices.push(MeshVertex {
            position: position.to_array(),
            material: material as u32,
            normal: normal.to_array(),
            ..MeshVertex::default()
        });
        self.vertices.len() as u32 - 1
    }

    /// Adds a printed line: an arc of `radius` about +Y at `height`, `length`
    /// long about +Z, in a strip of the `width` of two lines.
    pub fn add_mark(&mut self, radius: f32, height: f32, length: f32, width: f32) {
        let first = self.vertices.len() as u32;
        let half_angle = 0.5 * length / radius;
        for step in 0..=MARK_FACETS {
            let angle = half_angle * (2.0 * step as f32 / MARK_FACETS as f32 - 1.0);
            let normal = Vec3::new(angle.sin(), 0.0, angle.cos());
            for across in [-1.0, 1.0] {
                let position = normal * radius + Vec3::Y * (height + 0.5 * across * width);
                let vertex = self.vertex(position, normal, Material::Enamel);
                self.vertices[vertex as usize].across = across;
            }
        }
        for step in 0..MARK_FACETS {
            let corner = first + 2 * step;
            self.indices.extend([
                corner,
                corner + 2,
                corner + 1,
                corner + 2,
                corner + 3,
                corner + 1,
            ]);
        }
    }

    /// Adds the surface of revolution about +Y of `outline`, points of
    /// (radius, height) in metres. Seen in that plane the solid lies to the
    /// left of the outline's direction: a cup goes up its outer side, over the
    /// rim and down its inner side. Points that coincide are taken as one.
    pub fn add_revolution(&mut self, outline: &[Vec2], material: Material) {
        let mut points = outline.to_vec();
        points.dedup_by(|a, b| a.distance(*b) < 1e-6);
        let tangents: Vec<Vec2> = points
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).normalize())
            .collect();
        for (segment, &tangent) in tangents.iter().enumerate() {
            let smooth = |neighbour: Option<&Vec2>| match neighbour {
                Some(other) if other.dot(tangent) > CREASE_COS => (tangent + *other).normalize(),
                _ => tangent,
            };
            let before = segment.checked_sub(1).and_then(|index| tangents.get(index));
            let lower = (points[segment], smooth(before));
            let upper = (points[segment + 1], smooth(tangents.get(segment + 1)));
            self.add_band(lower, upper, material);
        }
    }

    /// A conical band between two points of an outline, each with its tangent.
    fn add_band(&mut self, lower: (Vec2, Vec2), upper: (Vec2, Vec2), material: Material) {
        let first = self.vertices.len() as u32;
        for facet in 0..=FACETS {
            let (sin, cos) = (std::f32::consts::TAU * facet as f32 / FACETS as f32).sin_cos();
            for (point, tangent) in [lower, upper] {
                let position = Vec3::new(point.x * cos, point.y, point.x * sin);
                let normal = Vec3::new(tangent.y * cos, -tangent.x, tangent.y * sin);
                self.vertex(position, normal, material);
            }
        }
        for facet in 0..FACETS {
            let corner = first + 2 * facet;
            // At the axis one of the two triangles has no area.
            if lower.0.x > 0.0 {
                self.indices.extend([corner, corner + 1, corner + 2]);
            }
            if upper.0.x > 0.0 {
                self.indices.extend([corner + 2, corner + 1, corner + 3]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{PI, TAU};

    /// Volume enclosed, by the divergence theorem; negative if inside out.
    fn volume(mesh: &Mesh) -> f32 {
        triangles(mesh)
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum()
    }

    fn triangles(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
        mesh.indices.chunks(3).map(|corners| {
            [corners[0], corners[1], corners[2]]
                .map(|index| Vec3::from(mesh.vertices[index as usize].position))
        })
    }

    /// Every normal points to the side that the winding calls the front.
    fn assert_normals_face_out(mesh: &Mesh) {
        for (corners, [a, b, c]) in mesh.indices.chunks(3).zip(triangles(mesh)) {
            let facet = (b - a).cross(c - a).normalize();
            for &index in corners {
                let normal = Vec3::from(mesh.vertices[index as usize].normal);
                assert!((normal.length() - 1.0).abs() < 1e-5);
                assert!(normal.dot(facet) > 0.7, "{normal} {facet}");
            }
        }
    }

    /// A polygon of n facets holds n/(2π)·sin(2π/n) of its circle's area, so
    /// the glass's volume is known in closed form.
    #[test]
    fn beaker_wall_has_the_volume_of_two_cylinders_apart() {
        let outline = [
            [0.0, 0.0],
            [0.042, 0.0],
            [0.042, 0.1],
            [0.040, 0.1],
            [0.040, 0.002],
            [0.0, 0.002],
        ];
        let mut mesh = Mesh::default();
        mesh.add_revolution(&outline.map(Vec2::from), Material::Glass);
        let facets = FACETS as f32 / TAU * (TAU / FACETS as f32).sin();
        let expected = facets * PI * (0.042_f32.powi(2) * 0.1 - 0.040_f32.powi(2) * 0.098);
        let relative = volume(&mesh) / expected - 1.0;
        assert!(relative.abs() < 1e-4, "{relative}");
        assert_normals_face_out(&mesh);
    }

    /// On a sphere's outline the smoothed normals are the radii.
    #[test]
    fn round_outline_is_smooth_and_its_pole_is_not_degenerate() {
        let outline: Vec<Vec2> = (0..=32)
            .map(|step| {
                let (sin, cos) = (PI * step as f32 / 32.0).sin_cos();
                Vec2::new((0.05 * sin).max(0.0), -0.05 * cos)
            })
            .collect();
        let mut mesh = Mesh::default();
        mesh.add_revolution(&outline, Material::Glass);
        assert_normals_face_out(&mesh);
        for vertex in &mesh.vertices {
            let radial = Vec3::from(vertex.position) / 0.05;
            // The two pole rings have the chord's normal: half a step off.
            assert!(radial.dot(vertex.normal.into()) > (PI / 64.0).cos() - 1e-5);
        }
        assert!(triangles(&mesh).all(|[a, b, c]| (b - a).cross(c - a).length() > 1e-9));
    }
}
