//! Accessors: rows of numbers in a buffer. All that they name is checked once against what there is; a number is then read
//! where it stands, so that nothing is allocated for what a header promises.

use crate::GltfError;
use crate::file::File;
use crate::json::At;

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of_code(code: u64) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the beginning of some bytes, and what a normalised 1 is.
    fn read(self, bytes: &[u8]) -> (f64, f64) {
        fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
            bytes.first_chunk().copied().unwrap_or([0; N])
        }
        match self {
            Self::I8 => (i8::from_le_bytes(first(bytes)).into(), 127.0),
            Self::U8 => (u8::from_le_bytes(first(bytes)).into(), 255.0),
            Self::I16 => (i16::from_le_bytes(first(bytes)).into(), 32_767.0),
            Self::U16 => (u16::from_le_bytes(first(bytes)).into(), 65_535.0),
            Self::U32 => (u32::from_le_bytes(first(bytes)).into(), 4_294_967_295.0),
            Self::F32 => (f32::from_le_bytes(first(bytes)).into(), 1.0),
        }
    }
}

/// What a field's accessor must hold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// The accessor's type, such as `VEC3`.
    pub kind: &'static str,
    /// How many numbers an element has.
    pub lanes: usize,
    /// Which numbers.
    pub of: &'static [Component],
    /// Which more, in a file that uses KHR_mesh_quantization.
    pub quantised: &'static [Component],
}

/// An accessor that was checked.
#[derive(Clone, Debug)]
pub(crate) struct Accessor<'a> {
    /// Its path, such as `accessors[3]`.
    pub path: String,
    /// How many elements it has, at least 1.
    pub count: usize,
    component: Component,
    lanes: usize,
    normalised: bool,
    base: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements of a buffer view, from the first one on, at equal distances.
#[derive(Clone, Copy, Debug)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl<'a> Strided<'a> {
    fn element(&self, index: usize) -> &'a [u8] {
        self.bytes.get(index.saturating_mul(self.stride)..).unwrap_or(&[])
    }
}

/// Elements that stand elsewhere than in their row, by ascending number.
#[derive(Clone, Copy, Debug)]
struct Sparse<'a> {
    count: usize,
    numbers: Strided<'a>,
    of: Component,
    values: Strided<'a>,
}

impl<'a> Sparse<'a> {
    fn number(&self, at: usize) -> usize {
        self.of.read(self.numbers.element(at)).0 as usize
    }

    fn element(&self, index: usize) -> Option<&'a [u8]> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low.midpoint(high);
            match self.number(middle).cmp(&index) {
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Equal => return Some(self.values.element(middle)),
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}

impl<'a> Accessor<'a> {
    /// The accessor that a field names; `None` where there is no such field.
    pub fn of(file: &'a File, holder: &At, field: &str, wanted: &Wanted) -> Result<Option<Self>, GltfError> {
        let Some(number) = holder.index(field, file.count("accessors")?, "accessors")? else { return Ok(None) };
        let at = file.member("accessors", number)?;
        let component = component(&at)?;
        let fits = at.text("type")? == Some(wanted.kind)
            && (wanted.of.contains(&component) || (file.quantised && wanted.quantised.contains(&component)));
        if !fits {
            let value = format!(
                "{} has {} of {component:?}",
                at.path,
                at.text("type")?.map_or("nothing".into(), crate::error::quoted)
            );
            return Err(GltfError::field(holder.path_of(field), value, format!("{} of {:?}", wanted.kind, wanted.of)));
        }
        let count = at.size("count", 0)?;
        if count == 0 || u32::try_from(count).is_err() {
            return Err(at.wrong("count", "a number from 1 to 4294967295"));
        }
        let size = component.bytes() * wanted.lanes;
        let base = view(file, &at, &at, count, size)?;
        let sparse = at.get("sparse").map(|sparse| sparse_of(file, &sparse, count, size)).transpose()?;
        let normalised = at.flag("normalized", false)?;
        Ok(Some(Self { path: at.path, count, component, lanes: wanted.lanes, normalised, base, sparse }))
    }

    /// A number of an element; 0 where no buffer holds it.
    pub fn lane(&self, index: usize, lane: usize) -> f64 {
        let sparse = self.sparse.as_ref().and_then(|sparse| sparse.element(index));
        let element = sparse.or_else(|| self.base.as_ref().map(|base| base.element(index)));
        let bytes = element.and_then(|bytes| bytes.get(lane * self.component.bytes()..));
        let (number, one) = self.component.read(bytes.unwrap_or(&[]));
        // The most negative integer is a little below −1.
        if self.normalised { (number / one).max(-1.0) } else { number }
    }

    /// The first `N` numbers of an element.
    pub fn get<const N: usize>(&self, index: usize) -> [f64; N] {
        std::array::from_fn(|lane| self.lane(index, lane))
    }

    /// How many numbers an element has.
    pub fn lanes(&self) -> usize {
        self.lanes
    }

    /// Whether no buffer holds its numbers, so that all are 0 unless an extension provides them.
    pub fn is_empty(&self) -> bool {
        self.base.is_none() && self.sparse.is_none()
    }

    /// The accessor, unless its count is not the one that is needed.
    pub fn counting(self, count: usize, field: &str, expected: &str) -> Result<Self, GltfError> {
        if self.count == count {
            return Ok(self);
        }
        let value = format!("{} has {} elements", self.path, self.count);
        Err(GltfError::field(field, value, format!("{count}, {expected}")))
    }
}

fn component(at: &At) -> Result<Component, GltfError> {
    let code = at.whole("componentType")?;
    code.and_then(Component::of_code).ok_or_else(|| at.wrong("componentType", "5120, 5121, 5122, 5123, 5125 or 5126"))
}

/// The elements in the buffer view that `holder` names; `None` where it names none. `accessor` is where a count that does not fit is reported.
fn view<'a>(
    file: &'a File,
    holder: &At,
    accessor: &At,
    count: usize,
    size: usize,
) -> Result<Option<Strided<'a>>, GltfError> {
    let views = file.count("bufferViews")?;
    let Some(number) = holder.index("bufferView", views, "bufferViews")? else { return Ok(None) };
    let view = file.member("bufferViews", number)?;
    let buffer =
        view.index("buffer", file.buffers.len(), "buffers")?.ok_or_else(|| view.wrong("buffer", "a number"))?;
    let Some(Some(data)) = file.buffers.get(buffer) else {
        let compressed = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
        let value = match compressed.iter().find(|name| view.extension(name).is_some()) {
            Some(name) => format!("buffers[{buffer}] has no bytes but for {name}, which is not supported"),
            None => format!("buffers[{buffer}] has no bytes"),
        };
        return Err(GltfError::field(view.path_of("buffer"), value, "a buffer with a uri, or the container's"));
    };
    let (offset, length) = (view.size("byteOffset", 0)?, view.size("byteLength", 0)?);
    let bytes = offset.checked_add(length).and_then(|end| data.get(offset..end)).ok_or_else(|| {
        view.wrong("byteLength", format!("at most the bytes of buffers[{buffer}], {}, behind {offset}", data.len()))
    })?;
    let stride = view.size("byteStride", size)?;
    if stride < size || stride > 65_536 {
        return Err(view.wrong("byteStride", format!("{size} or more, the bytes of an element of {}", accessor.path)));
    }
    let begin = holder.size("byteOffset", 0)?;
    let end = (count - 1).checked_mul(stride).and_then(|last| last.checked_add(size)?.checked_add(begin));
    if end.is_none_or(|end| end > length) {
        let value = format!("{count} elements of {size} bytes, {stride} apart, from byte {begin}");
        return Err(GltfError::field(&accessor.path, value, format!("the {length} bytes of {}", view.path)));
    }
    Ok(Some(Strided { bytes: bytes.get(begin..).unwrap_or(&[]), stride }))
}

fn sparse_of<'a>(file: &'a File, sparse: &At, most: usize, size: usize) -> Result<Sparse<'a>, GltfError> {
    let count = sparse.size("count", 0)?;
    if count == 0 || count > most {
        return Err(sparse.wrong("count", format!("a number from 1 to {most}")));
    }
    let part = |name: &str| sparse.get(name).ok_or_else(|| sparse.wrong(name, "an object"));
    let strided = |at: &At, size: usize| {
        view(file, at, at, count, size)?.ok_or_else(|| at.wrong("bufferView", "the number of a buffer view"))
    };
    let (numbers, values) = (part("indices")?, part("values")?);
    let of = component(&numbers)?;
    if !matches!(of, Component::U8 | Component::U16 | Component::U32) {
        return Err(numbers.wrong("componentType", "5121, 5123 or 5125"));
    }
    let found = Sparse { count, numbers: strided(&numbers, of.bytes())?, of, values: strided(&values, size)? };
    // One accessor may be named from many places: this is work as well.
    file.budget.charge(&sparse.path, count as u64, 8)?;
    let mut least = 0;
    for at in 0..count {
        let number = found.number(at);
        if number < least || number >= most {
            let expected = format!("ascending numbers below {most}");
            return Err(GltfError::field(format!("{}[{at}]", numbers.path), number, expected));
        }
        least = number + 1;
    }
    Ok(found)
}
