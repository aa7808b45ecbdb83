use umbrage_plane::Kind;

/// Most texels that [`read_shadow_map`](crate::read_shadow_map) takes: 16,384 × 16,384, which is 1 GiB.
pub const DEFAULT_BUDGET: u64 = 1 << 28;

/// How much of a file is read, and how the file of another maker is understood.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MapOptions {
    /// Most texels of all maps together; of a deep map as many steps. [`DEFAULT_BUDGET`] unless chosen.
    pub most_texels: u64,
    /// Only the map of this name, or the maps of the [light](crate::light_of) of this name. All of them unless chosen.
    pub part: Option<String>,
    /// What the channel of the depths is called. `Z`, or the only one whose name ends in `.Z`, unless chosen. In a deep map the other channels
    /// stand in the same layer: beside `light.Z` they are `light.A` and `light.ZBack`.
    pub channel: Option<String>,
    /// Where the light stands, in place of what another maker's file says. Umbrage's own files are refused beside it.
    pub view: Option<GivenView>,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self { most_texels: DEFAULT_BUDGET, part: None, channel: None, view: None }
    }
}

impl MapOptions {
    /// With another [budget](Self::most_texels).
    #[must_use]
    pub fn with_most_texels(mut self, most_texels: u64) -> Self {
        self.most_texels = most_texels;
        self
    }

    /// With one [name](Self::part), or with all maps.
    #[must_use]
    pub fn with_part(mut self, part: Option<String>) -> Self {
        self.part = part;
        self
    }

    /// With another [channel](Self::channel).
    #[must_use]
    pub fn with_channel(mut self, channel: Option<String>) -> Self {
        self.channel = channel;
        self
    }

    /// With a [view](Self::view).
    #[must_use]
    pub fn with_view(mut self, view: Option<GivenView>) -> Self {
        self.view = view;
        self
    }
}

/// Where a light stands, as files of shadow maps say it. The map's size is that of the file's display window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenView {
    /// World space to the light's, left-handed with +z ahead, in world units; a point is a row from the left, as in OpenEXR, row after row.
    pub world_to_camera: [f64; 16],
    /// World space to the map, in the same form: from (−1, −1) lower left to (1, 1) upper right, or from (0, 0) upper left to (1, 1) lower right.
    pub world_to_screen: [f64; 16],
    /// Nearest and farthest distance along the axis, world units; where one is missing, those that `world_to_screen` takes to 0 and 1.
    pub near: Option<f64>,
    /// See `near`.
    pub far: Option<f64>,
    /// What the depths are. Those of [`Kind::Screen`] end at 1: there and beyond nothing was seen.
    pub depth: Kind,
}
