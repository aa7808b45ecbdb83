//! Maps that do not fit in memory, baked to disk in bands.

use crate::args::{BakeArgs, Cli, RuleArg};
use crate::lights::Lamp;
use crate::report::Line;
use crate::shell::Shell;
use crate::stage::Stage;
use std::path::Path;
use std::time::Instant;
use umbrage_bake::{Streamed, Streaming, bake_streamed};
use umbrage_depth::{BackFace, DepthRule, First, Midpoint, Second};
use umbrage_io::{IoError, file_bytes, write_shadow_map_by_rows};
use umbrage_plane::View;
use umbrage_raster::Cull;
use umbrage_render::Soup;

/// Less is not worth a walk over the scene for each band.
const LEAST: u64 = 64 << 20;

/// How maps of one depth per texel are baked that do not fit.
pub struct Bands<'a> {
    stage: &'a Stage,
    rule: RuleArg,
    streaming: Streaming,
}

impl<'a> Bands<'a> {
    /// `None` where that is not possible: for maps that keep more than one depth per texel, for files of several maps, and where the
    /// scene alone does not fit.
    pub fn new(cli: &Cli, args: &BakeArgs, stage: &'a Stage) -> Option<Self> {
        let flat = !matches!(args.rule, RuleArg::Facets | RuleArg::Deep);
        let alone = !args.one_file && stage.lamps.iter().all(|lamp| lamp.views.len() == 1);
        let left = crate::memory::Need { texels: 0, ..stage.need }.left(cli.max_memory);
        let streaming = Streaming::within(usize::try_from(left).unwrap_or(usize::MAX));
        (flat && alone && left >= LEAST).then_some(Self { stage, rule: args.rule, streaming })
    }

    /// Writes the map of a light.
    pub fn write(&self, path: &Path, lamp: &Lamp, recipe: String, shell: &mut Shell<'_>) -> anyhow::Result<Line> {
        let start = Instant::now();
        let [view] = lamp.views.as_slice() else { anyhow::bail!("light {:?} has several maps", lamp.name) };
        let streamed = match self.rule {
            RuleArg::Second => self.stream(path, (&lamp.name, view), &Second, Cull::None),
            RuleArg::BackFace => self.stream(path, (&lamp.name, view), &BackFace, Cull::Front),
            RuleArg::Midpoint => self.stream(path, (&lamp.name, view), &Midpoint::default(), Cull::None),
            _ => self.stream(path, (&lamp.name, view), &First, Cull::None),
        }?;
        let size = view.size();
        shell.note(&format!(
            "{}: {} x {} texels do not fit in memory: baked in {} bands",
            lamp.name, size.x, size.y, streamed.bands
        ));
        let bytes = usize::try_from(file_bytes(path)?)?;
        let (baked, looked_up) = (start.elapsed(), std::time::Duration::ZERO);
        Ok(Line { light: lamp.name.clone(), recipe, bytes, baked, looked_up })
    }

    fn stream<R: DepthRule>(
        &self,
        path: &Path,
        (name, view): (&str, &View),
        rule: &R,
        cull: Cull,
    ) -> Result<Streamed, IoError> {
        let soup = Soup::casters(&self.stage.scene, view);
        write_shadow_map_by_rows(path, name, view, rule.stored(), |rows| {
            bake_streamed(view, || soup.casting(), rule, cull, self.streaming, |row| rows.push(&row))
        })
    }
}
