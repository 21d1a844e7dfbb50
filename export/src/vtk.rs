//! Particles as VTK's unstructured grids (`.vtu`, XML with raw bytes behind it) and the list of them (`.vtu.series`), as
//! ParaView and PyVista read them.

use serde_json::json;
use vitriol_run::particles::Particles;

/// Kind of a cell that is one point.
const VERTEX: u8 = 1;

/// Particles at a time (s) as the bytes of a file. No name has a space, which VTK's legacy format does not allow.
pub fn bytes(particles: &Particles, seconds: f64) -> Vec<u8> {
    let count = particles.len();
    let mut arrays = Arrays::default();
    let vectors = |from: &[glam::DVec3]| -> Vec<u8> {
        let values = from.iter().flat_map(|vector| vector.to_array());
        floats(values.map(|value| value as f32))
    };
    let point_data = [
        arrays.add("id", "UInt32", 1, le(&particles.id, |id| id.to_le_bytes())),
        arrays.add(
            "velocity_m_per_s",
            "Float32",
            3,
            vectors(&particles.velocity),
        ),
        arrays.add(
            "volume_m3",
            "Float64",
            1,
            le(&particles.volume, |v| v.to_le_bytes()),
        ),
        arrays.add(
            "mass_kg",
            "Float64",
            1,
            le(&particles.mass, |m| m.to_le_bytes()),
        ),
        arrays.add(
            "flask",
            "Int32",
            1,
            le(&particles.flask, |f| f.to_le_bytes()),
        ),
    ];
    let of_heat = [
        ("temperature_degC", &particles.temperature),
        ("acid_kg_per_kg", &particles.acid),
    ];
    let of_heat = of_heat.into_iter().filter(|(_, values)| !values.is_empty());
    let heat: Vec<String> = of_heat
        .map(|(name, values)| arrays.add(name, "Float32", 1, floats(values.iter().copied())))
        .collect();
    let points = arrays.add("Points", "Float32", 3, vectors(&particles.position));
    let numbers: Vec<i64> = (0..count as i64).collect();
    let ends = le(&numbers, |n| (n + 1).to_le_bytes());
    let cells = [
        arrays.add(
            "connectivity",
            "Int64",
            1,
            le(&numbers, |n| n.to_le_bytes()),
        ),
        arrays.add("offsets", "Int64", 1, ends),
        arrays.add("types", "UInt8", 1, vec![VERTEX; count]),
    ];
    let mut bytes = format!(
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{seconds}</DataArray></FieldData>
<Piece NumberOfPoints="{count}" NumberOfCells="{count}">
<PointData>
{}{}</PointData>
<Points>
{points}</Points>
<Cells>
{}</Cells>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="raw">
_"#,
        point_data.concat(),
        heat.concat(),
        cells.concat()
    )
    .into_bytes();
    bytes.extend(arrays.bytes);
    bytes.extend(b"\n</AppendedData>\n</VTKFile>\n");
    bytes
}

/// An entry of the list.
pub fn entry(file: &str, seconds: f64) -> String {
    json!({ "name": file, "time": seconds }).to_string()
}

/// What comes before the first entry, between two, and behind the last.
pub const LIST: [&str; 3] = [
    "{\"file-series-version\": \"1.0\", \"files\": [\n",
    ",\n",
    "\n]}\n",
];

/// Arrays that stand behind the XML, each behind its length.
#[derive(Default)]
struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    /// Adds one and gives back its element.
    fn add(&mut self, name: &str, kind: &str, components: usize, bytes: Vec<u8>) -> String {
        let offset = self.bytes.len();
        self.bytes.extend((bytes.len() as u64).to_le_bytes());
        self.bytes.extend(bytes);
        // A scalar has no number of components: meshio takes those with 1 for columns, and its other formats leave columns out.
        let components = match components {
            1 => String::new(),
            several => format!("NumberOfComponents=\"{several}\" "),
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" {components}format=\"appended\" offset=\"{offset}\"/>\n"
        )
    }
}

fn floats(values: impl Iterator<Item = f32>) -> Vec<u8> {
    values.flat_map(f32::to_le_bytes).collect()
}

fn le<T, const N: usize>(values: &[T], bytes: impl Fn(&T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(bytes).collect()
}

#[cfg(test)]
#[path = "tests/vtk.rs"]
mod tests;
