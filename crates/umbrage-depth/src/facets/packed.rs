use super::words::{FacetWordsError, Words};

/// Small numbers of equal width, 0, 1, 2, 4, 8 or 16 bits each, side by side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Packed {
    /// log₂ of the width; `None` where all numbers are 0 and nothing is kept.
    log: Option<u32>,
    words: Box<[u32]>,
}

/// [`Packed`] numbers, with everything at hand that reading one of them takes.
#[derive(Clone, Copy)]
pub(super) struct Numbers<'a> {
    words: &'a [u32],
    /// log₂ of the numbers in a word, and of a number's width; all bits of a number.
    shift: u32,
    log: u32,
    mask: u32,
}

impl Numbers<'_> {
    /// All numbers are 0.
    pub const ZERO: Self = Self { words: &[0], shift: 31, log: 0, mask: 0 };

    #[inline(always)]
    pub fn get(self, index: usize) -> u32 {
        let place = (index as u32 & ((1 << self.shift) - 1)) << self.log;
        self.words[index >> self.shift].wrapping_shr(place) & self.mask
    }
}

impl Packed {
    /// The narrowest that holds all numbers, which are below 2¹⁶.
    pub fn new(numbers: &[u32]) -> Self {
        let most = numbers.iter().copied().max().unwrap_or(0);
        if most == 0 {
            return Self { log: None, words: Box::default() };
        }
        let log = (0..=4).find(|log| most >> (1 << log) == 0).expect("numbers below 2¹⁶");
        Self::of_width(log, numbers)
    }

    /// Each number in 2^`log` bits.
    pub fn of_width(log: u32, numbers: &[u32]) -> Self {
        let per_word = 32 >> log;
        let word = |numbers: &[u32]| numbers.iter().zip(0..).fold(0, |word, (number, i)| word | number << (i << log));
        Self { log: Some(log), words: numbers.chunks(per_word).map(word).collect() }
    }

    #[inline(always)]
    pub fn get(&self, index: usize) -> u32 {
        self.numbers().get(index)
    }

    /// What reads many of them.
    #[inline(always)]
    pub fn numbers(&self) -> Numbers<'_> {
        let Some(log) = self.log else { return Numbers::ZERO };
        Numbers { words: &self.words, shift: 5 - log, log, mask: u32::MAX >> (32 - (1 << log)) }
    }

    /// Whether all numbers are 0 and nothing is kept.
    #[inline(always)]
    pub fn is_one(&self) -> bool {
        self.log.is_none()
    }

    pub fn bytes(&self) -> usize {
        size_of_val(self.words.as_ref())
    }

    /// Appends the width, 0 where nothing is kept, and the words.
    pub fn write(&self, words: &mut Vec<u32>) {
        words.push(self.log.map_or(0, |log| 1 << log));
        words.extend(&self.words);
    }

    /// Takes `count` numbers, none of them above `most`.
    pub fn read(words: &mut Words<'_>, field: &str, count: usize, most: u32) -> Result<Self, FacetWordsError> {
        let width = words.one(field)?;
        let log = match width {
            0 => return Ok(Self { log: None, words: Box::default() }),
            1 | 2 | 4 | 8 | 16 => width.ilog2(),
            _ => return Err(FacetWordsError::new(field, width, "not a width of 0, 1, 2, 4, 8 or 16 bits")),
        };
        let taken = words.take(field, count.div_ceil(32 >> log))?;
        let packed = Self { log: Some(log), words: taken.into() };
        match (0..count).map(|index| packed.get(index)).find(|number| *number > most) {
            Some(number) => Err(FacetWordsError::new(field, number, format!("not within 0..={most}"))),
            None => Ok(packed),
        }
    }
}
