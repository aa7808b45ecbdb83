//! The memory that every map of the gallery takes: as depths, as a file of them, and as facets.

use crate::figure::{Context, Figure, Paper};
use glam::UVec2;
use std::collections::HashSet;
use umbrage_bake::bake_tags;
use umbrage_depth::{DepthMap, Raw, Tiled};
use umbrage_plane::{TexelRect, View};
use umbrage_raster::Triangle;
use umbrage_render::{Soup, light_map};
use umbrage_report::plot::{Axis, Plot, Series};
use umbrage_report::{Made, Measure, Table};
use umbrage_scene::{Scene, gallery};

pub const STORAGE: Figure = Figure {
    id: "U-storage",
    paper: Paper::Umbrage,
    title: "The memory that a map of each scene takes, and why",
    claim: "Facets in memory are smaller than a compressed file of depths where facets are large and depths compress badly.",
    look: "the last column, which says why one storage is smaller than the other on each map.",
    make: storage,
};

/// The memory that the nearest surfaces of a map take.
struct Sizes {
    name: String,
    raw: f64,
    tiled: f64,
    /// A file of the depths, ZIP, which must be decompressed to be looked up.
    zip: f64,
    facets: f64,
    /// The default's map, with finer samples and links along edges.
    refined: f64,
    /// Texels with a surface for each facet that is seen; 0 where nothing is.
    texels_per_facet: f64,
    /// Bytes of the file for each texel with a surface.
    packed: f64,
}

impl Sizes {
    fn of(name: String, scene: &Scene, view: &View) -> anyhow::Result<Self> {
        let facets = light_map(&"auto,fine=1".parse()?, scene, view);
        let raw = Raw::copy_of(&facets);
        let zip = umbrage_io::encode_shadow_map(&raw)?.len() as f64;
        // Each triangle as an object of its own.
        let soup = Soup::casters(scene, view);
        let numbered = (0..).zip(soup.triangles()).map(|(object, triangle)| Triangle { object, ..triangle });
        let tags = bake_tags(view, numbered);
        let seen: Vec<u32> = TexelRect::of_size(view.size()).texels().filter_map(|texel| tags.id(texel)).collect();
        let (covered, facets_seen) = (seen.len() as f64, seen.into_iter().collect::<HashSet<u32>>().len());
        Ok(Self {
            name,
            raw: raw.allocated() as f64,
            tiled: Tiled::from(&raw).allocated() as f64,
            zip,
            facets: facets.allocated() as f64,
            refined: light_map(&"auto".parse()?, scene, view).allocated() as f64,
            texels_per_facet: covered / facets_seen.max(1) as f64,
            packed: zip / covered.max(1.0),
        })
    }

    fn over_zip(&self) -> f64 {
        self.facets / self.zip
    }

    /// The kind of map, which explains why one is smaller than the other.
    fn reason(&self) -> &'static str {
        match (self.texels_per_facet < SMALL, self.packed < WELL) {
            (true, true) => "small facets; depths compress well",
            (true, false) => "small facets; depths compress badly",
            (false, true) => "large facets; depths compress well",
            (false, false) => "large facets; depths compress badly",
        }
    }

    fn row(&self) -> Vec<String> {
        let kilobytes = [self.raw, self.tiled, self.zip, self.facets, self.refined];
        let smaller = if self.facets <= self.zip { "facets" } else { "file" };
        std::iter::once(self.name.clone())
            .chain(kilobytes.map(|bytes| format!("{:.0}", bytes / 1024.0)))
            .chain([format!("{:.0}", self.texels_per_facet), format!("{:.2}", self.packed)])
            .chain([format!("{:.2}", self.over_zip())])
            .chain([smaller.into(), self.reason().into()])
            .collect()
    }
}

/// Facets of fewer texels count as small: for so few texels a plane's numbers are no saving.
const SMALL: f64 = 32.0;
/// Depths that take fewer bytes than this each in a file compress well.
const WELL: f64 = 1.0;

fn storage(cx: &Context) -> anyhow::Result<Made> {
    let side = cx.pick(512, 128);
    let mut all = Vec::new();
    for (name, make) in gallery::ALL {
        let scene = make();
        let casting: Vec<usize> = (0..scene.lights.len()).filter(|light| scene.lights[*light].casts).collect();
        for &light in &casting {
            let view = scene.lights[light].view.with_size(UVec2::splat(side))?;
            let name = if casting.len() > 1 { format!("{name}, light {light}") } else { (*name).into() };
            all.push(Sizes::of(name, &scene, &view)?);
        }
    }
    let mut made = Made::default();
    let head = [
        "map",
        "raw, KB",
        "tiles, KB",
        "file, ZIP, KB",
        "facets, KB",
        "the default's, KB",
        "texels per facet",
        "file, bytes per texel",
        "facets over file",
        "smaller",
        "kind of map",
    ];
    let rows = all.iter().map(Sizes::row).collect();
    made.tables.push(Table { name: format!("maps of {side}²"), head: head.map(String::from).to_vec(), rows });
    let mut plot = Plot::new(
        "A map of facets over a file of its depths",
        Axis::log("bytes of the file per texel with a surface"),
        Axis::log("bytes over bytes"),
    );
    for (name, small) in [("maps of small facets", true), ("maps of large facets", false)] {
        let points = all.iter().filter(|sizes| (sizes.texels_per_facet < SMALL) == small);
        plot = plot.add(Series::dots(name, points.map(|sizes| (sizes.packed, sizes.over_zip())).collect()));
    }
    let packed = all.iter().map(|sizes| sizes.packed);
    let (low, high) = packed.fold((f64::INFINITY, 0.0_f64), |(low, high), bytes| (low.min(bytes), high.max(bytes)));
    plot = plot.add(Series::line("equal", vec![(low, 1.0), (high, 1.0)]));
    made.plots.push(("storage".into(), plot.svg()));
    let smaller = all.iter().filter(|sizes| sizes.facets <= sizes.zip).count();
    let sum = |of: &dyn Fn(&Sizes) -> f64| all.iter().map(of).sum::<f64>();
    let most = all.iter().map(|sizes| sizes.facets / sizes.raw).fold(0.0, f64::max);
    made.measures = vec![
        Measure::info("maps", all.len() as f64, "maps"),
        Measure::info("maps whose facets are smaller than the file", smaller as f64, "maps"),
        Measure::at_most(
            "facets over raw, all maps together",
            sum(&|sizes| sizes.facets) / sum(&|sizes| sizes.raw),
            "times",
            0.5,
        ),
        Measure::info(
            "facets over the file, all maps together",
            sum(&|sizes| sizes.facets) / sum(&|sizes| sizes.zip),
            "times",
        ),
        Measure::info(
            "the default's over raw, all maps together",
            sum(&|sizes| sizes.refined) / sum(&|sizes| sizes.raw),
            "times",
        ),
        Measure::at_most("facets over raw, the largest of all maps", most, "times", 1.0),
    ];
    made.note = "Facets can be looked up as they are; the file must first be decompressed into raw depths or pages. The sizes of facets, tiles and the \
        default's \
                 map count all that they hold, tables and directories included; that of the file is of a whole EXR file."
        .into();
    Ok(made)
}
