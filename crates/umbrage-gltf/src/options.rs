use glam::UVec2;
use umbrage_plane::builders;

/// What a reader of glTF may choose beyond the file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReadOptions {
    /// Columns and rows of the picture. The camera's vertical field stays, and the aspect is that of the picture. `None` is 512 rows, and
    /// as many columns as the camera's `aspectRatio` needs (1 without it).
    pub size: Option<UVec2>,
    /// Columns and rows of each light's map, texels; 512 at first.
    pub map_size: u32,
    /// The camera, by its node's or its own name. `None` is the first one in the scene.
    pub camera: Option<String>,
    /// The moment at which animations are sampled, seconds; what lies outside of an animation takes its first or last pose. `None` leaves nodes,
    /// weights and joints as the file has them.
    pub time: Option<f64>,
    /// The animation, by its name; `None` is the first. It matters only with a time.
    pub animation: Option<String>,
    /// Most bytes that reading may take; 4 GiB at first. What a file needs is counted before it is allocated: the bytes of the file and of
    /// its buffers; 100 for each value, 200 for each array and 800 for each object of the JSON; 96 per vertex and 112 per triangle of each mesh, and of each place where it stands.
    pub max_bytes: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { size: None, map_size: 512, camera: None, time: None, animation: None, max_bytes: 1 << 32 }
    }
}

builders!([] ReadOptions {
    with_size size: Option<UVec2>,
    with_map_size map_size: u32,
    with_camera camera: Option<String>,
    with_time time: Option<f64>,
    with_animation animation: Option<String>,
    with_max_bytes max_bytes: u64,
});
