//! Umbrage's own: the default's area lights, against rays and against filters of one map.

use crate::figure::{Context, Figure, Paper};
use crate::stage::masks::value;
use crate::stage::panels::{error_panel, shadow_panel, truth_panel};
use crate::stage::set::Set;
use umbrage_oracle::metrics;
use umbrage_recipe::Recipe;
use umbrage_render::Frame;
use umbrage_report::{Made, Measure, Table};
use umbrage_scene::gallery;

pub const AREA: Figure = Figure {
    id: "U-auto-area",
    paper: Paper::Umbrage,
    title: "Area lights as a mean of maps",
    claim: "The mean of small maps over an area light converges to its penumbra, contacts included; filters of one map only resemble it.",
    look: "the penumbra at the contact, where filters of one map are too wide or too dark.",
    make: area,
};

/// The radius of the lamp, world units, and the recipes that render it: caption, recipe, side of its maps.
const RADIUS: f64 = 24.0;
const SOFT: [(&str, &str, &str, u32); 7] = [
    ("pcss", "PCSS by the light's size", "fernando,light=24,bias=1t", 512),
    ("burley", "Burley by the light's size", "burley,light=24", 512),
    ("auto-4", "auto: 4 maps of 128²", "auto,light=24,maps=4,across=1", 128),
    ("auto-16", "auto: 16 maps of 128²", "auto,light=24,maps=16,across=1", 128),
    ("auto-64", "auto: 64 maps of 128²", "auto,light=24,maps=64,across=1", 128),
    ("auto-16-large", "auto: 16 maps of 512²", "auto,light=24,maps=16,across=1", 512),
    ("auto", "auto: as many maps of 128² as it takes by itself", "auto,light=24,across=1", 128),
];

fn area(cx: &Context) -> anyhow::Result<Made> {
    let pixels = cx.pick(256, 96);
    let mut made = Made::default();
    let mut found = Vec::new();
    let mut rows = Vec::new();
    let truth = Set::new(gallery::contact_box(), pixels, 512).truth_disc(cx, &Frame::CENTRES, RADIUS);
    let seen: Vec<bool> = truth.share.iter().zip(&truth.facing[0]).map(|(s, f)| *s == 1.0 && *f > 0.02).collect();
    for (id, caption, recipe, texels) in SOFT {
        let set = Set::new(gallery::contact_box(), pixels, texels);
        let light = set.light(cx, &recipe.parse::<Recipe>()?)?;
        let picture = set.draw(cx, &*light.shadow, &Frame::CENTRES);
        let bytes: usize = light.maps.iter().map(|map| map.bytes).sum();
        let (own, exact) = (&picture.shadow[0], &truth.shadow[0]);
        let rms = value(metrics::rms(own, exact, &seen));
        made.panels.push(shadow_panel(id, caption, &picture).with("recipe", recipe).against("truth"));
        made.panels.push(error_panel(&format!("{id}-error"), "Minus truth", truth.size, own, exact));
        rows.push(vec![caption.to_string(), format!("{rms:.4}"), format!("{:.0}", bytes as f64 / 1024.0)]);
        found.push((rms, bytes as f64 / 1024.0));
    }
    made.panels.push(truth_panel(&truth));
    let head = ["light of radius 24", "error, rms", "kilobytes"].map(String::from).to_vec();
    made.tables.push(Table { name: "soft light".into(), head, rows });
    let best = found[0].0.min(found[1].0);
    made.measures = vec![
        Measure::at_most("16 maps of 128²: error", found[3].0, "rms", 0.011).full_size(cx.quick),
        Measure::at_most("16 maps of 128²: kilobytes", found[3].1, "KB", 1536.0),
        Measure::at_most("16 maps of 128² over the better filter of one map: error", found[3].0 / best, "times", 1.0),
        Measure::at_most("64 maps of 128² over the better filter of one map: error", found[4].0 / best, "times", 0.5),
        Measure::at_most("as many maps of 128² as it takes by itself: error", found[6].0, "rms", 0.011)
            .full_size(cx.quick),
        Measure::at_most("as many maps of 128² as it takes by itself: kilobytes", found[6].1, "KB", 1536.0),
        Measure::info("4 maps of 128²: error", found[2].0, "rms"),
        Measure::info("16 maps of 512²: error", found[5].0, "rms"),
        Measure::info("PCSS: error", found[0].0, "rms"),
        Measure::info("Burley: error", found[1].0, "rms"),
    ];
    made.note = "Truth sends rays from each pixel's centre to the whole lamp, so the maps are looked up at one place per pixel, too. Few maps leave \
                 visible steps between their shadows."
        .into();
    Ok(made)
}
