//! Small glTF files, made in code.

use serde_json::{Value, json};
use umbrage_gltf::{GltfError, Import, ReadOptions, decode};
use umbrage_scene::{Mesh, Shape};

/// A document and its one buffer.
pub struct Build {
    pub document: Value,
    pub bytes: Vec<u8>,
}

impl Build {
    /// A document without anything in it.
    pub fn new() -> Self {
        let document = json!({
            "asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "meshes": [], "nodes": [],
        });
        Self { document, bytes: Vec::new() }
    }

    /// Adds to one of the lists and gives the number.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        if self.document.get(list).is_none() {
            self.document[list] = json!([]);
        }
        let list = self.document[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// A buffer view of its own.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}))
    }

    /// An accessor of bytes, of that many elements.
    pub fn accessor(&mut self, bytes: &[u8], code: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": code, "type": kind, "count": count}))
    }

    /// Floats, `N` each.
    pub fn floats<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        let kind = ["", "SCALAR", "", "VEC3", "VEC4"].get(N).copied().unwrap_or("MAT4");
        self.accessor(&bytes, 5126, kind, rows.len())
    }

    /// Indices of two bytes.
    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, "SCALAR", indices.len())
    }

    /// A mesh of one primitive.
    pub fn mesh(&mut self, primitive: Value) -> usize {
        let mut mesh = json!({});
        mesh["primitives"] = vec![primitive].into();
        self.push("meshes", mesh)
    }

    /// A node.
    pub fn node(&mut self, node: Value) -> usize {
        self.push("nodes", node)
    }

    /// The file.
    pub fn glb(&self) -> Vec<u8> {
        let mut document = self.document.clone();
        if !self.bytes.is_empty() && document.get("buffers").is_none() {
            document["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        }
        container(document.to_string().as_bytes(), &self.bytes)
    }

    /// The file, read.
    pub fn read(&self) -> Result<Import, GltfError> {
        self.read_with(&ReadOptions::default())
    }

    /// The file, read with options.
    pub fn read_with(&self, options: &ReadOptions) -> Result<Import, GltfError> {
        decode(&self.glb(), None, "test", options)
    }

    /// The line that is said of the file.
    pub fn refused(&self) -> String {
        self.read().unwrap_err().to_string()
    }
}

/// A binary container of two chunks.
pub fn container(json: &[u8], bin: &[u8]) -> Vec<u8> {
    let (mut json, mut bin) = (json.to_vec(), bin.to_vec());
    json.resize(json.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend_from_slice(&(28 + json.len() as u32 + bin.len() as u32).to_le_bytes());
    for (kind, data) in [(b"JSON", json), (b"BIN\0", bin)] {
        bytes.extend_from_slice(&(data.len() as u32).to_le_bytes());
        bytes.extend_from_slice(kind);
        bytes.extend_from_slice(&data);
    }
    bytes
}

/// A triangle of three corners in the plane z = 0, counter-clockwise from +z.
pub const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// A file with that triangle as mesh 0, and no node.
pub fn triangle() -> Build {
    let mut build = Build::new();
    let positions = build.floats(&TRIANGLE);
    build.mesh(json!({"attributes": {"POSITION": positions}}));
    build
}

/// The mesh of an object.
pub fn mesh(import: &Import, object: usize) -> &Mesh {
    match &import.scene.objects[object].shape {
        Shape::Mesh(mesh) => mesh,
        Shape::Patches(_) => panic!("no patches are read"),
    }
}

/// The corners of an object's triangles in the world.
pub fn corners(import: &Import, object: usize) -> Vec<[[f64; 3]; 3]> {
    let mesh = mesh(import, object);
    mesh.check().unwrap();
    let world = |at: glam::Vec3| (import.scene.origin + at.as_dvec3()).to_array();
    (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle).map(world)).collect()
}

/// All notes as lines.
pub fn notes(import: &Import) -> Vec<String> {
    import.notes.iter().map(ToString::to_string).collect()
}

/// Whether two lists of numbers agree to a millionth.
#[track_caller]
pub fn near(found: &[f64], expected: &[f64]) {
    let close = found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-6);
    assert!(close, "{found:?} is not {expected:?}");
}
