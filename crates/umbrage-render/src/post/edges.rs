use glam::{IVec2, UVec2, Vec2};

/// Sub-scanlines and sub-columns per pixel when smoothed contours are drawn.
const SUB: usize = 8;

/// Takes the staircase out of a binary shadow image (Williams 1978): its contours are traced as closed chains of cracks between
/// pixels, each vertex becomes the mean of its 2·`window` + 1 neighbours along the chain, and the smoothed polygons are
/// drawn again with 8 × 8 samples per pixel.
///
/// A pixel counts as shadow above ½. Vertices on the image's border stay where they are. `window` 0 only redraws. The
/// paper leaves the filter to a citation on line drawings; this is our reading of it.
pub fn dequantise_edges(size: UVec2, image: &[f32], window: u32) -> Vec<f32> {
    let chains = trace(size, image);
    let mut crossings: Vec<Vec<f32>> = vec![Vec::new(); size.y as usize * SUB];
    for chain in &chains {
        let smooth = smoothed(size, chain, window as usize);
        for (i, &from) in smooth.iter().enumerate() {
            cross(from, smooth[(i + 1) % smooth.len()], &mut crossings);
        }
    }
    fill(size, &mut crossings)
}

/// Directions of cracks: right, down, left, up. Shadow lies to the right of the direction of travel.
const STEPS: [IVec2; 4] = [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y];

fn trace(size: UVec2, image: &[f32]) -> Vec<Vec<IVec2>> {
    let extent = size.as_ivec2();
    let dark =
        |x: i32, y: i32| x >= 0 && y >= 0 && x < extent.x && y < extent.y && image[(y * extent.x + x) as usize] > 0.5;
    let columns = extent.x + 1;
    let vertex = |at: IVec2| (at.y * columns + at.x) as usize;
    let mut open = vec![0u8; (columns * (extent.y + 1)) as usize];
    for y in 0..extent.y {
        for x in 0..extent.x {
            if dark(x, y) {
                let sides = [(0, -1, 0, 0), (1, 0, 1, 0), (0, 1, 1, 1), (-1, 0, 0, 1)];
                for (direction, (dx, dy, from_x, from_y)) in sides.into_iter().enumerate() {
                    if !dark(x + dx, y + dy) {
                        open[vertex(IVec2::new(x + from_x, y + from_y))] |= 1 << direction;
                    }
                }
            }
        }
    }
    let mut chains = Vec::new();
    for y in 0..=extent.y {
        for x in 0..=extent.x {
            while open[vertex(IVec2::new(x, y))] != 0 {
                chains.push(follow(IVec2::new(x, y), &mut open, vertex));
            }
        }
    }
    chains
}

/// Walks one chain from `start` until it closes, using up its cracks. Where two chains touch, turning right keeps to the same shadow pixel.
fn follow(start: IVec2, open: &mut [u8], vertex: impl Fn(IVec2) -> usize) -> Vec<IVec2> {
    let mut direction = open[vertex(start)].trailing_zeros() as usize;
    let (mut at, mut chain) = (start, Vec::new());
    loop {
        open[vertex(at)] &= !(1 << direction);
        chain.push(at);
        at += STEPS[direction];
        if at == start {
            return chain;
        }
        let ways = open[vertex(at)];
        let turned = [1, 0, 3].map(|turn| (direction + turn) % 4).into_iter().find(|way| ways >> way & 1 == 1);
        match turned {
            Some(way) => direction = way,
            None => return chain,
        }
    }
}

fn smoothed(size: UVec2, chain: &[IVec2], window: usize) -> Vec<Vec2> {
    let extent = size.as_ivec2();
    let length = chain.len();
    (0..length)
        .map(|i| {
            let at = chain[i];
            if at.x == 0 || at.y == 0 || at.x == extent.x || at.y == extent.y {
                return at.as_vec2();
            }
            let neighbours = 2 * window + 1;
            let first = i + length * neighbours - window;
            let sum: Vec2 = (first..first + neighbours).map(|j| chain[j % length].as_vec2()).sum();
            sum / neighbours as f32
        })
        .collect()
}

/// Notes where an edge crosses the sub-scanlines; half-open in y, so that shared vertices count once.
fn cross(from: Vec2, to: Vec2, crossings: &mut [Vec<f32>]) {
    let (top, bottom) = if from.y < to.y { (from, to) } else { (to, from) };
    let sub = SUB as f32;
    let first = (top.y * sub - 0.5).ceil().max(0.0) as usize;
    let end = ((bottom.y * sub - 0.5).ceil().max(0.0) as usize).min(crossings.len());
    for (line, row) in crossings.iter_mut().enumerate().take(end).skip(first) {
        let y = (line as f32 + 0.5) / sub;
        row.push(top.x + (bottom.x - top.x) * ((y - top.y) / (bottom.y - top.y)));
    }
}

/// Fills between pairs of crossings and counts samples per pixel.
fn fill(size: UVec2, crossings: &mut [Vec<f32>]) -> Vec<f32> {
    let width = size.x as usize;
    let mut image = vec![0.0; width * size.y as usize];
    let column = |x: f32| ((x * SUB as f32 - 0.5).ceil().max(0.0) as usize).min(width * SUB);
    for (line, row) in crossings.iter_mut().enumerate() {
        row.sort_by(f32::total_cmp);
        for pair in row.chunks_exact(2) {
            for sample in column(pair[0])..column(pair[1]) {
                image[line / SUB * width + sample / SUB] += 1.0 / (SUB * SUB) as f32;
            }
        }
    }
    image
}
