//! The list of all targets.

use crate::exr_bodies::{deep_exr, exr_blocks, exr_header};
use crate::exr_seeds::{blocks, cut_into_rows, cut_into_tiles, deep, facets, flat, foreign, map, view};
use crate::gltf::gltf;
use crate::mutate::Dice;
use crate::paging::paging;
use crate::text::{lookup_lines, recipe};
use crate::values::{images, values};
use glam::UVec2;
use umbrage_scene::gallery;

/// A format, and the function that reads any bytes as a file of it.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The name of the function, of its program in `fuzz/` and of the folder of its corpus.
    pub name: &'static str,
    /// Reads bytes as a file. Whether they are valid; panics when the reader breaks a promise.
    pub takes: fn(&[u8]) -> bool,
    /// Good files to begin with.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// All of them.
pub const TARGETS: [Target; 8] = [
    Target { name: "exr_header", takes: exr_header, seeds: headers },
    Target { name: "exr_blocks", takes: exr_blocks, seeds: blocks },
    Target { name: "deep_exr", takes: deep_exr, seeds: deep_maps },
    Target { name: "paging", takes: paging, seeds: tiles },
    Target { name: "values", takes: values, seeds: images },
    Target { name: "gltf", takes: gltf, seeds: scenes },
    Target { name: "recipe", takes: recipe, seeds: recipes },
    Target { name: "lookup_lines", takes: lookup_lines, seeds: lines },
];

fn headers() -> Vec<Vec<u8>> {
    let rows = cut_into_rows(&map(&view(UVec2::splat(8))));
    vec![flat(), foreign(&flat()), foreign(&rows), facets()]
}

fn deep_maps() -> Vec<Vec<u8>> {
    let own = [deep(false), deep(true)];
    own.iter().map(|file| foreign(file)).chain(own.clone()).collect()
}

fn tiles() -> Vec<Vec<u8>> {
    let map = map(&view(UVec2::new(13, 11)));
    let own = cut_into_tiles(&map, 4, Dice(1));
    vec![foreign(&own), own, facets()]
}

fn scenes() -> Vec<Vec<u8>> {
    vec![umbrage_gltf::encode(&gallery::table()).expect("a scene that can be written")]
}

fn recipes() -> Vec<Vec<u8>> {
    let texts = [
        "auto",
        "reeves87,samples=16,res-factor=3,bias=0.3..0.4,min-samples=2,jitter=0.5",
        "woo92,depth=cone,pattern=disc,samples=32,ratio=0.5",
        "burley,light=0.5,stored=midpoint",
        "wang-molnar94,nearby=box3",
        "preset = 'reeves87'\nsamples = 32\nbias = '0.1..0.2'\nhard-cap = true\n",
        "samples=32, blur=0.01, bias0=0.1, bias1=0.2, swidth=2, twidth=2, depthfilter=\"midpoint\", midpointratio=0.5",
    ];
    texts.map(|text| text.as_bytes().to_vec()).to_vec()
}

fn lines() -> Vec<Vec<u8>> {
    let texts = [
        "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n1.5,-2,3,0,1,0\n",
        "0 0 0 0 0 1 0.5 0 0 0 0.5 0\n\n1e3 -2.5 1e-9 1 1 1\r\n0.1 0.2 0.3 0 0 -1",
    ];
    texts.map(|text| text.as_bytes().to_vec()).to_vec()
}
