//! Many small pictures in rows and columns, with their names written beside them and their faults written into them.

use glam::{UVec2, Vec3};
use umbrage_oracle::heat;
use umbrage_report::letters;

/// Pixels left for the rows' names and above the columns' names.
const LEFT: u32 = 88;
const TOP: u32 = 84;
const PAPER: Vec3 = Vec3::splat(0.008);
const INK: Vec3 = Vec3::splat(0.75);

/// Pictures made small and laid out in rows and columns.
pub(super) struct Sheet {
    pub size: UVec2,
    pub pixels: Vec<Vec3>,
    cell: u32,
}

impl Sheet {
    pub fn new(columns: u32, rows: u32, cell: u32) -> Self {
        let size = UVec2::new(columns, rows) * cell + UVec2::new(LEFT, TOP);
        Self { size, cell, pixels: vec![PAPER; (size.x * size.y) as usize] }
    }

    /// Says what the colours mean, above the first column.
    pub fn legend(&mut self) {
        let lines = [("orange: false shadow", too_dark()), ("blue: leak", too_light()), ("in percent", INK)];
        for (line, (text, ink)) in lines.into_iter().enumerate() {
            self.write(UVec2::new(4, 4 + letters::LINE * line as u32), text, ink);
        }
    }

    /// A column's name, on as many lines as it takes.
    pub fn head(&mut self, column: u32, name: &str) {
        let lines = letters::wrapped(name, self.cell - 6);
        let from = TOP - 4 - letters::LINE * lines.len() as u32;
        for (line, text) in lines.iter().enumerate() {
            let at = UVec2::new(LEFT + column * self.cell + 3, from + letters::LINE * line as u32);
            self.write(at, text, INK);
        }
    }

    /// A row's name.
    pub fn side(&mut self, row: u32, name: &str) {
        for (line, text) in letters::wrapped(name, LEFT - 6).iter().enumerate() {
            let down = self.cell / 2 - letters::LINE + letters::LINE * line as u32;
            self.write(UVec2::new(4, TOP + row * self.cell + down), text, INK);
        }
    }

    /// Writes the faults that count into a cell, each in its colour: false shadow at the left, leaks at the right.
    pub fn faults(&mut self, column: u32, row: u32, acne: Option<f64>, leak: Option<f64>) {
        let corner = UVec2::new(LEFT + column * self.cell, TOP + (row + 1) * self.cell - letters::LINE - 1);
        if let Some(acne) = acne {
            self.boxed(corner + UVec2::new(3, 0), &percent(acne), too_dark());
        }
        if let Some(leak) = leak {
            let text = percent(leak);
            let across = self.cell - 3 - letters::width(&text);
            self.boxed(corner + UVec2::new(across, 0), &text, too_light());
        }
    }

    /// Text that is legible over any picture.
    fn boxed(&mut self, at: UVec2, text: &str, ink: Vec3) {
        let across = letters::width(text) + 2;
        for y in 0..letters::LINE {
            let from = ((at.y + y) * self.size.x + at.x - 1) as usize;
            self.pixels[from..from + across as usize].fill(PAPER);
        }
        self.write(at, text, ink);
    }

    fn write(&mut self, at: UVec2, text: &str, ink: Vec3) {
        letters::draw(text, |offset, cover| {
            let place = at + offset;
            if place.cmplt(self.size).all() {
                let pixel = &mut self.pixels[(place.y * self.size.x + place.x) as usize];
                *pixel = pixel.lerp(ink, cover);
            }
        });
    }

    /// Each pixel of a cell is the mean of the picture's pixels under it; a picture of other proportions leaves a bar below it that is as dark as the
    /// background.
    pub fn place(&mut self, column: u32, row: u32, size: UVec2, picture: &[Vec3]) {
        let scale = f64::from(size.max_element()) / f64::from(self.cell);
        let span = |at: u32, most: u32| {
            let from = (f64::from(at) * scale) as u32;
            from..(((f64::from(at) + 1.0) * scale) as u32).max(from + 1).min(most)
        };
        for y in 0..self.cell {
            for x in 0..self.cell {
                let (columns, rows) = (span(x, size.x), span(y, size.y));
                let all: Vec<Vec3> = rows
                    .flat_map(|row| columns.clone().map(move |column| picture[(row * size.x + column) as usize]))
                    .collect();
                if !all.is_empty() {
                    let at = (TOP + row * self.cell + y) * self.size.x + LEFT + column * self.cell + x;
                    self.pixels[at as usize] = all.iter().sum::<Vec3>() / all.len() as f32;
                }
            }
        }
    }
}

/// The colours of errors, light enough to be legible.
fn too_dark() -> Vec3 {
    heat(0.75)
}

fn too_light() -> Vec3 {
    heat(-0.8)
}

fn percent(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    if percent < 9.95 { format!("{percent:.1}") } else { format!("{percent:.0}") }
}
