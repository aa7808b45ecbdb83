//! A part of an EXR file: its attributes and its chunks.

/// A part of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Name, type and bytes of each attribute, in the file's order.
    pub attributes: Vec<(String, String, Vec<u8>)>,
    /// Chunks in the order of the offset table. Their places in the file are another matter: see [`ExrFile::to_bytes`](crate::ExrFile::to_bytes).
    pub chunks: Vec<Chunk>,
}

/// A chunk without the number of its part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chunk {
    /// Where it begins in the file, bytes. [`ExrFile::to_bytes`](crate::ExrFile::to_bytes) does not look at it.
    pub offset: usize,
    /// Tile and level, the row, or the row of deep data; the lengths are no part of it.
    pub place: Vec<i32>,
    /// Of deep data the packed table of counts, and how long the samples are unpacked.
    pub deep: Option<(Vec<u8>, u64)>,
    /// Packed samples.
    pub packed: Vec<u8>,
}

impl Part {
    /// The bytes of an attribute of a type, if the part has it.
    pub fn get(&self, name: &str, kind: &str) -> Option<&[u8]> {
        let found = self.attributes.iter().find(|(own, own_kind, _)| own == name && own_kind == kind)?;
        Some(&found.2)
    }

    /// Gives an attribute, in the place of one of that name or as the last.
    pub fn set(&mut self, name: &str, kind: &str, value: &[u8]) {
        let attribute = (name.to_owned(), kind.to_owned(), value.to_vec());
        match self.attributes.iter_mut().find(|(own, ..)| own == name) {
            Some(own) => *own = attribute,
            None => self.attributes.push(attribute),
        }
    }

    /// Takes an attribute away.
    pub fn remove(&mut self, name: &str) {
        self.attributes.retain(|(own, ..)| own != name);
    }

    /// Little-endian numbers of an attribute.
    ///
    /// # Errors
    /// There is none of that name and type with as many numbers.
    pub fn numbers<const N: usize>(&self, name: &str, kind: &str) -> Result<[i32; N], String> {
        let value = self.get(name, kind).map(|value| value.as_chunks::<4>());
        let numbers = value.filter(|(words, rest)| words.len() == N && rest.is_empty());
        let (words, _) = numbers.ok_or_else(|| format!("no {name} of {N} numbers"))?;
        Ok(std::array::from_fn(|index| i32::from_le_bytes(words[index])))
    }

    /// Sides of the data window.
    ///
    /// # Errors
    /// There is none, or it is empty or too large for any memory.
    pub fn sides(&self) -> Result<[usize; 2], String> {
        let [left, top, right, bottom] = self.numbers("dataWindow", "box2i")?.map(i64::from);
        let side =
            |low: i64, high: i64| usize::try_from(high - low + 1).ok().filter(|side| (1..=1 << 16).contains(side));
        side(left, right).zip(side(top, bottom)).map(|(x, y)| [x, y]).ok_or("an unusable dataWindow".into())
    }

    /// Columns and rows of a block: of a tile, or of the rows that are packed together.
    ///
    /// # Errors
    /// An attribute that it depends on is missing.
    pub fn block(&self) -> Result<[usize; 2], String> {
        if self.is_tiled() {
            let tile = self.get("tiles", "tiledesc").filter(|tile| tile.len() == 9 && tile[8] == 0);
            let tile = tile.ok_or("no tiles of one level")?;
            let side = |at: usize| u32::from_le_bytes([tile[at], tile[at + 1], tile[at + 2], tile[at + 3]]) as usize;
            return Ok([side(0).max(1), side(4).max(1)]);
        }
        let rows = match self.get("compression", "compression") {
            Some([0..=2]) => 1,
            Some([3]) => 16,
            Some([4]) => 32,
            other => return Err(format!("compression {other:?}")),
        };
        Ok([self.sides()?[0], rows])
    }

    /// Columns and rows of blocks.
    fn grid(&self) -> Result<[usize; 2], String> {
        let ([columns, rows], [x, y]) = (self.sides()?, self.block()?);
        Ok([columns.div_ceil(x), rows.div_ceil(y)])
    }

    /// How many chunks there must be.
    pub(crate) fn chunk_count(&self) -> Result<usize, String> {
        let count = self.grid()?.into_iter().product();
        match self.numbers::<1>("chunkCount", "int") {
            Ok([said]) if said as usize != count => Err(format!("chunkCount is {said}, not {count}")),
            _ => Ok(count),
        }
    }

    /// Whether its chunks are tiles. Parts without a type are tiled where they have tiles.
    pub(crate) fn is_tiled(&self) -> bool {
        match self.get("type", "string") {
            Some(kind) => kind == b"tiledimage" || kind == b"deeptile",
            None => self.get("tiles", "tiledesc").is_some(),
        }
    }

    /// Whether its texels have several samples.
    pub(crate) fn is_deep(&self) -> bool {
        self.get("type", "string").is_some_and(|kind| kind.starts_with(b"deep"))
    }
}
