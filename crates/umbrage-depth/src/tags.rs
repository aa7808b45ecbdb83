use glam::IVec2;
use umbrage_plane::{TexelRect, View};

/// The id of the nearest object per texel: the priority buffer of Hourcade & Nicolas, a baseline that Wang & Molnar 1994 compare with.
///
/// No [`DepthMap`](crate::DepthMap), because ids are not depths.
#[derive(Clone, Debug, PartialEq)]
pub struct TagMap {
    view: View,
    ids: Vec<Option<u32>>,
}

impl TagMap {
    /// The nearest object of each texel of `view`, row by row from the top; missing ones are empty, those left over are ignored.
    pub fn new(view: View, ids: impl IntoIterator<Item = Option<u32>>) -> Self {
        let size = view.size();
        let texels = size.x as usize * size.y as usize;
        let mut ids: Vec<Option<u32>> = ids.into_iter().take(texels).collect();
        ids.resize(texels, None);
        Self { view, ids }
    }

    /// The light's view.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The nearest object of a texel; `None` where there is none and outside the map.
    pub fn id(&self, texel: IVec2) -> Option<u32> {
        let rect = TexelRect::of_size(self.view.size());
        let index = || texel.y as usize * rect.size().x as usize + texel.x as usize;
        if rect.contains(texel) { self.ids[index()] } else { None }
    }
}
