//! Filters over maps: where types end and the one dynamic seam begins.
//!
//! What a recipe chooses stays data down to the filter ([`AnyPattern`], [`AnyDepth`](umbrage_shadow::AnyDepth)), so that each filter is
//! compiled once.

use crate::pattern::PatternName;
use crate::values::Values;
use crate::{PresetName, RecipeError};
use umbrage_depth::{Map, Storage};
use umbrage_sample::{
    AnyPattern, AreaTent, Castano, Centre, Density, Disc, EveryTexel, Gaussian, InsideQuadReject, InsideQuadWarp,
    Table, Tent, Uniform, Vogel,
};
use umbrage_shadow::{
    Around, Conditional, Filter, FilteredDepth, IntegerFirst, Pcf, Shadow, ShadowMap, Soft, Williams,
};

/// Puts a filter over a map in the storage that is given. A filter expects no surface in particular; a [`Recipe`](crate::Recipe) does.
pub fn bind<F: Filter + 'static>(filter: F, map: impl Into<Map>, storage: Storage) -> Box<dyn Shadow> {
    Box::new(ShadowMap { filter, map: map.into().kept(storage) })
}

/// A filter over the maps around one light; a single map is used alone.
fn over<F: Filter + 'static>(filter: F, mut maps: Vec<Map>) -> Result<Box<dyn Shadow>, RecipeError> {
    match (maps.len(), maps.pop()) {
        (1, Some(map)) => Ok(Box::new(ShadowMap { filter, map })),
        (_, last) => {
            maps.extend(last);
            let around = Around::new(filter, maps);
            Ok(Box::new(around.map_err(|error| RecipeError::value("views", "around", error.to_string()))?))
        }
    }
}

impl Values {
    /// The filter of a preset with these values, over one map or the maps around one light. Over one map it cannot fail.
    pub fn bind(&self, preset: PresetName, maps: Vec<Map>) -> Result<Box<dyn Shadow>, RecipeError> {
        match preset {
            PresetName::Auto => over(self.dual, maps),
            PresetName::Williams78 => {
                let filter = Williams::default().with_bias(self.biased.low).with_lookup(self.lookup);
                over(filter.with_dither(self.dither), maps)
            }
            PresetName::WangMolnar94 => {
                let filter = Conditional::default()
                    .with_pattern(self.pattern())
                    .with_res_factor(self.res_factor)
                    .with_min_size(self.min_size)
                    .with_plane(self.plane())
                    .with_min_cos(self.min_cos)
                    .with_when(self.when)
                    .with_dark_backs(self.dark_backs);
                over(filter, maps)
            }
            PresetName::Burley | PresetName::Fernando => {
                let filter = Soft::default()
                    .with_depth(self.compared())
                    .with_softness(self.softness())
                    .with_search(self.search)
                    .with_blur(self.blur)
                    .with_falloff(self.falloff)
                    .with_radius_gamma(self.shape)
                    .with_opacity(self.opacity)
                    .with_rescue(self.rescue);
                over(filter, maps)
            }
            PresetName::Ordinary => {
                let filter = FilteredDepth::default().with_bias(self.biased.low).with_res_factor(self.res_factor);
                over(filter, maps)
            }
            preset if preset.is_prefiltered() => {
                let filter = self.moments.filter.with_depth(self.compared());
                over(filter, maps.into_iter().map(|map| self.moments.over(preset, map)).collect())
            }
            PresetName::HdrpPcss => over(self.hdrp.with_depth(self.compared()), maps),
            _ => self.closer_over(maps),
        }
    }

    fn closer_over(&self, maps: Vec<Map>) -> Result<Box<dyn Shadow>, RecipeError> {
        if self.integer_first {
            let filter = IntegerFirst::default().with_pattern(self.jittered).with_unit(self.unit);
            return over(filter.with_res_factor(self.res_factor).with_min_size(self.min_size), maps);
        }
        let filter = Pcf::default().with_pattern(self.pattern()).with_depth(self.compared());
        over(filter.with_res_factor(self.res_factor).with_min_size(self.min_size), maps)
    }

    fn pattern(&self) -> AnyPattern {
        let num_samples = self.jittered.num_samples;
        match self.pattern {
            PatternName::Jittered => self.jittered.into(),
            PatternName::Table => Table(self.jittered).into(),
            PatternName::Uniform => Uniform::default().with_num_samples(num_samples).into(),
            PatternName::Gaussian => Gaussian::default().with_num_samples(num_samples).into(),
            PatternName::Inside => InsideQuadReject(self.jittered).into(),
            PatternName::Warp => InsideQuadWarp(self.jittered).into(),
            PatternName::Every => EveryTexel.into(),
            PatternName::Tent => Tent.into(),
            PatternName::Centre => Centre.into(),
            PatternName::Castano5 => Castano::Five.into(),
            PatternName::Castano7 => Castano::Seven.into(),
            PatternName::AreaTent => AreaTent.into(),
            PatternName::Vogel => Vogel::default().with_num_samples(num_samples).into(),
            PatternName::Disc => Disc::default().with_num_samples(num_samples).with_density(Density::Uniform).into(),
        }
    }
}
