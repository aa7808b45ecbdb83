//! A scene as a binary glTF file.

use crate::GltfError;
use crate::sight::Things;
use glam::{DMat4, DVec2, Vec3};
use serde_json::{Map, Value, json};
use umbrage_plane::{Projection, Verdict, View};
use umbrage_scene::{Light, Material, Mesh, Object, Scene};

/// A scene as the bytes of a `.glb` file.
///
/// Each object is a node with a mesh of one primitive, about a root that stands at [`Scene::origin`]; patches are diced for the scene's camera.
/// A material keeps its diffuse colour, and what passes it as its alpha. The camera keeps its view, but for the size of its picture and a window
/// off its axis. Lights are spots, or suns where their rays are parallel, with the window of their map in `extras.shadow`; windows that are
/// not square about the axis are widened until they are. A light's colour is given in candela or lux such that the middle of the
/// scene's box receives it; of its tree the file keeps nothing. Flags that are not set, [`Object::casts`], [`Object::receives`] and
/// [`Light::casts`], are members of `extras`.
///
/// What is written is read back by [`decode`](crate::decode) with the same positions, triangles and views, to the roundings of f64.
///
/// # Errors
/// [`GltfError::Field`] for a mesh that does not pass [`Mesh::check`], and a scene whose buffer or JSON exceeds what the
/// container's lengths can say, 4 GiB.
pub fn encode(scene: &Scene) -> Result<Vec<u8>, GltfError> {
    let mut writer = Writer::default();
    let mut roots = Vec::new();
    let mut things = Vec::new();
    let about_origin = scene.about_origin(&scene.camera);
    for (index, object) in scene.objects.iter().enumerate() {
        let mesh = object.shape.mesh_for(&about_origin);
        mesh.check().map_err(|fault| GltfError::field(format!("objects[{index}]"), fault, "a mesh without faults"))?;
        if !mesh.triangles.is_empty() {
            let node = writer.object(object, &mesh)?;
            things.push(writer.node(node));
        }
    }
    if scene.origin == glam::DVec3::ZERO {
        roots.append(&mut things);
    } else {
        let root = json!({"name": "origin", "translation": scene.origin.to_array(), "children": things});
        roots.push(writer.node(root));
    }
    roots.push(writer.node(json!({"name": "camera", "camera": 0, "matrix": matrix(scene.camera.eye_to_world())})));
    let bounds = Things::new(&scene.objects, scene.origin);
    for light in &scene.lights {
        let node = writer.light(light, &bounds);
        roots.push(writer.node(node));
    }
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "Umbrage"},
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": roots}],
        "cameras": [camera(&scene.camera)],
        "nodes": writer.nodes,
    });
    let lists = [
        ("meshes", writer.meshes),
        ("materials", writer.materials),
        ("accessors", writer.accessors),
        ("bufferViews", writer.views),
    ];
    // Lists of glTF are absent rather than empty.
    for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        document[name] = list.into();
    }
    if !writer.bytes.is_empty() {
        document["buffers"] = json!([{"byteLength": writer.bytes.len()}]);
    }
    if !writer.lights.is_empty() {
        document["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        document["extensions"] = json!({"KHR_lights_punctual": {"lights": writer.lights}});
    }
    container(&document, writer.bytes)
}

#[derive(Default)]
struct Writer {
    bytes: Vec<u8>,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    lights: Vec<Value>,
}

impl Writer {
    /// Adds a node and gives its number.
    fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds rows of a buffer and gives the number of their accessor.
    fn accessor(&mut self, bytes: &[u8], target: u32, mut about: Value) -> Result<usize, GltfError> {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        if u32::try_from(self.bytes.len()).is_err() {
            return Err(GltfError::field("buffers[0].byteLength", self.bytes.len(), "at most 4 GiB"));
        }
        about["bufferView"] = self.views.len().into();
        let length = bytes.len();
        self.views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": length, "target": target}));
        self.accessors.push(about);
        Ok(self.accessors.len() - 1)
    }

    fn vectors(&mut self, vectors: &[Vec3], bounds: Option<(Vec3, Vec3)>) -> Result<usize, GltfError> {
        let bytes: Vec<u8> = vectors.iter().flat_map(|at| at.to_array().map(f32::to_le_bytes).concat()).collect();
        let mut about = json!({"componentType": 5126, "count": vectors.len(), "type": "VEC3"});
        if let Some((low, high)) = bounds {
            about["min"] = json!(low.to_array());
            about["max"] = json!(high.to_array());
        }
        self.accessor(&bytes, 34962, about)
    }

    /// The node of an object, whose mesh has triangles.
    fn object(&mut self, object: &Object, mesh: &Mesh) -> Result<Value, GltfError> {
        let positions = self.vectors(&mesh.positions, mesh.bounds())?;
        let normals = self.vectors(&mesh.normals, None)?;
        let corners: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|vertex| vertex.to_le_bytes()).collect();
        let count = mesh.triangles.len() * 3;
        let indices =
            self.accessor(&corners, 34963, json!({"componentType": 5125, "count": count, "type": "SCALAR"}))?;
        self.materials.push(material(&object.material, object.passes));
        self.meshes.push(json!({"name": object.name, "primitives": [{
            "attributes": {"POSITION": positions, "NORMAL": normals},
            "indices": indices,
            "material": self.materials.len() - 1,
        }]}));
        let mut node = json!({"name": object.name, "mesh": self.meshes.len() - 1});
        let flags = [("casts", object.casts), ("receives", object.receives)];
        let unset: Map<_, _> =
            flags.into_iter().filter(|(_, set)| !set).map(|(name, set)| (name.to_owned(), Value::from(set))).collect();
        if !unset.is_empty() {
            node["extras"] = unset.into();
        }
        Ok(node)
    }

    fn light(&mut self, light: &Light, bounds: &Things) -> Value {
        let view = &light.view;
        let strength = light.colour.max_element().max(0.0);
        let colour = if strength > 0.0 { light.colour.max(Vec3::ZERO) / strength } else { Vec3::ONE };
        let mut about = json!({"name": light.name, "color": colour.to_array()});
        let (eye, right, up) = (view.eye_to_world().w_axis, view.eye_to_world().x_axis, view.eye_to_world().y_axis);
        let mut placement = view.eye_to_world();
        let shadow = match view.projection() {
            Projection::Orthographic { half, shift } => {
                about["type"] = "directional".into();
                about["intensity"] = strength.into();
                // The window about its own middle instead of the eye.
                let middle = -shift * half;
                placement.w_axis = eye + right * middle.x + up * middle.y;
                json!({"type": "orthographic", "half": half.max_element(), "near": view.near(), "far": view.far()})
            }
            Projection::Perspective { k, shift } => {
                let distance = bounds.middle().distance(eye.truncate()).max(0.5 * bounds.radius());
                about["type"] = "spot".into();
                about["intensity"] = (f64::from(strength) * distance * distance).into();
                let tangent = ((DVec2::ONE + shift.abs()) / k).max_element();
                let outer = view.cone().map_or_else(|| tangent.atan(), f64::acos);
                // The file format wants a softer edge than none.
                about["spot"] = json!({"innerConeAngle": outer.next_down(), "outerConeAngle": outer});
                let mut shadow = json!({"type": "perspective", "near": view.near(), "far": view.far()});
                if view.cone().is_none() {
                    let lit = view.rules().outside != Verdict::Shadowed;
                    shadow["outside"] = if lit { "lit" } else { "dark" }.into();
                }
                shadow
            }
        };
        self.lights.push(about);
        let mut extras = json!({"shadow": shadow});
        if !light.casts {
            extras["casts"] = false.into();
        }
        let extension = json!({"KHR_lights_punctual": {"light": self.lights.len() - 1}});
        json!({"name": light.name, "matrix": matrix(placement), "extensions": extension, "extras": extras})
    }
}

fn matrix(placement: DMat4) -> [f64; 16] {
    placement.to_cols_array()
}

fn material(material: &Material, passes: Vec3) -> Value {
    let [red, green, blue] = material.diffuse.clamp(Vec3::ZERO, Vec3::ONE).to_array();
    let alpha = 1.0 - (passes.element_sum() / 3.0).clamp(0.0, 1.0);
    let surface = json!({"baseColorFactor": [red, green, blue, alpha], "metallicFactor": 0.0, "roughnessFactor": 1.0});
    let mode = if alpha < 1.0 { "BLEND" } else { "OPAQUE" };
    json!({"pbrMetallicRoughness": surface, "alphaMode": mode, "doubleSided": true})
}

fn camera(view: &View) -> Value {
    let (near, far) = (view.near(), view.far());
    match view.projection() {
        Projection::Perspective { k, .. } => {
            let lens = json!({"yfov": 2.0 * (1.0 / k.y).atan(), "aspectRatio": k.y / k.x, "znear": near, "zfar": far});
            json!({"name": "camera", "type": "perspective", "perspective": lens})
        }
        Projection::Orthographic { half, .. } => {
            let lens = json!({"xmag": half.x, "ymag": half.y, "znear": near, "zfar": far});
            json!({"name": "camera", "type": "orthographic", "orthographic": lens})
        }
    }
}

/// The binary container: a header and two chunks, each a multiple of four bytes long.
fn container(document: &Value, mut buffer: Vec<u8>) -> Result<Vec<u8>, GltfError> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let chunks = if buffer.is_empty() { vec![(b"JSON", text)] } else { vec![(b"JSON", text), (b"BIN\0", buffer)] };
    let length = 12 + chunks.iter().map(|(_, data)| 8 + data.len()).sum::<usize>();
    let word = |length: usize| {
        let length = u32::try_from(length).map_err(|_| GltfError::field("glb.length", length, "at most 4 GiB"))?;
        Ok::<_, GltfError>(length.to_le_bytes())
    };
    let mut bytes = Vec::with_capacity(length);
    bytes.extend_from_slice(b"glTF");
    bytes.extend_from_slice(&2_u32.to_le_bytes());
    bytes.extend_from_slice(&word(length)?);
    for (kind, data) in &chunks {
        bytes.extend_from_slice(&word(data.len())?);
        bytes.extend_from_slice(*kind);
        bytes.extend_from_slice(data);
    }
    Ok(bytes)
}
