use umbrage_plane::mix32;

/// What takes the place of numbers in text.
const NUMBERS: [&str; 18] = [
    "0",
    "1",
    "2",
    "7",
    "-1",
    "0.5",
    "255",
    "65536",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "1e38",
    "-1e300",
    "1e-300",
    "null",
    "5126",
    "nan",
    "inf",
];

/// What takes the place of bytes in text.
const LETTERS: &[u8] = b"0123456789{}[],:\"-.e =\n";

/// What takes the place of binary words: lengths, corners, and as floats NaN and infinities.
const WORDS: [u64; 14] = [
    0,
    1,
    2,
    63,
    0xFFFF,
    0x1_0000,
    0x7F80_0000,
    0x7FC0_0000,
    0x7FFF_FFFF,
    0x8000_0000,
    0xFFFF_FFFF,
    1 << 32,
    u64::MAX - 7,
    u64::MAX,
];

/// An endless stream of numbers, the same for the same start.
#[derive(Clone, Debug)]
pub struct Dice(pub u32);

impl Dice {
    /// The next number, from 0 to below `most`; 0 where `most` is 0.
    pub fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9);
        mix32(self.0) as usize % most.max(1)
    }
}

/// An endless stream of damaged files near one file, the same for the same file and dice.
#[derive(Clone, Debug)]
pub struct Mutants<'a> {
    file: &'a [u8],
    /// Where decimal numbers stand in it, each with where it ends.
    numbers: Vec<(usize, usize)>,
    dice: Dice,
}

impl<'a> Mutants<'a> {
    /// Those of a file, which may be empty.
    pub fn of(file: &'a [u8], seed: u32) -> Self {
        Self { file, numbers: numbers(file), dice: Dice(seed) }
    }
}

impl Iterator for Mutants<'_> {
    type Item = Vec<u8>;

    /// Cuts, flipped bits, other letters, other numbers in text and in binary, and pieces that are lost, doubled or misplaced.
    fn next(&mut self) -> Option<Vec<u8>> {
        let (file, dice) = (self.file, &mut self.dice);
        let mut bytes = file.to_vec();
        let piece = |dice: &mut Dice| {
            let start = dice.below(file.len());
            start..(start + 1 + dice.below(64)).min(file.len())
        };
        match dice.below(12) {
            _ if file.is_empty() => bytes = vec![LETTERS[dice.below(LETTERS.len())]; dice.below(9)],
            0 => bytes.truncate(dice.below(file.len())),
            1 | 2 => {
                for _ in 0..=dice.below(4) {
                    bytes[dice.below(file.len())] ^= 1 << dice.below(8);
                }
            }
            3 => {
                for _ in 0..=dice.below(3) {
                    bytes[dice.below(file.len())] = LETTERS[dice.below(LETTERS.len())];
                }
            }
            4..=7 if !self.numbers.is_empty() => {
                // Formats with lengths are read on only where a number takes as many bytes as the one before.
                let fits = dice.below(2) == 0;
                // From the back, so that the places before stay where they are.
                let mut chosen: Vec<usize> = (0..=dice.below(3)).map(|_| dice.below(self.numbers.len())).collect();
                chosen.sort_unstable();
                chosen.dedup();
                for place in chosen.into_iter().rev() {
                    let (from, to) = self.numbers[place];
                    let mut number = NUMBERS[dice.below(NUMBERS.len())].as_bytes().to_vec();
                    if fits {
                        number.resize(to - from, b' ');
                    }
                    bytes.splice(from..to, number);
                }
            }
            8 => {
                let piece = piece(dice);
                bytes.drain(piece);
            }
            9 => {
                let (piece, at) = (piece(dice), dice.below(file.len()));
                bytes.splice(at..at, file[piece].iter().copied());
            }
            10 => {
                let piece = piece(dice);
                let at = dice.below(file.len() - piece.len() + 1);
                bytes[at..at + piece.len()].copy_from_slice(&file[piece]);
            }
            _ => {
                for _ in 0..=dice.below(2) {
                    let word = WORDS[dice.below(WORDS.len())].to_le_bytes();
                    let at = dice.below(file.len());
                    let length = [4, 8][dice.below(2)].min(file.len() - at);
                    bytes[at..at + length].copy_from_slice(&word[..length]);
                }
            }
        }
        Some(bytes)
    }
}

/// Where numbers stand in text among the bytes: behind what may precede a value.
fn numbers(bytes: &[u8]) -> Vec<(usize, usize)> {
    let part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'-' | b'.' | b'e' | b'E' | b'+');
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let end = at + bytes[at..].iter().take_while(|byte| part(byte)).count();
        if end > at && at > 0 && matches!(bytes[at - 1], b':' | b',' | b'[' | b'=' | b' ' | b'\n') {
            found.push((at, end));
        }
        at = end + 1;
    }
    found
}
