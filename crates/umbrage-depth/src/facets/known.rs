use super::FacetMap;
use super::source::FacetSource;

/// What a map knows of facets.
#[derive(Clone, Copy)]
pub enum Facets<'a> {
    /// It is a map of facets.
    Map(&'a FacetMap),
    /// It stands for several.
    Several(&'a dyn FacetSource),
}

impl std::fmt::Debug for Facets<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Map(_) => "Map",
            Self::Several(_) => "Several",
        })
    }
}
