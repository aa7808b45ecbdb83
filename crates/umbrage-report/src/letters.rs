//! A small grey alphabet, for names and numbers inside pictures. The shapes are those of the typeface Aileron, which its makers gave to the
//! public domain (CC0), at 13 pixels.

use glam::UVec2;

/// Pixels from line to line.
pub const LINE: u32 = 15;
/// Pixels that every letter's box has per row.
const ROW: u32 = 12;

/// Each letter's width and its pixels: six digits per row, two bits per pixel from the left, 3 where it is wholly covered. What is blank at the end
/// is left out.
#[rustfmt::skip]
const LETTERS: &[(char, u32, &str)] = &[
    (' ', 3, ""),
    ('%', 10, "0000001f420031c90035d8001e600000600000ca40024dc0060dc00d0b4"),
    ('&', 9, "0000000af000340000300400341c000fff40281c00301c00341c001bf8"),
    (',', 3, "000000000000000000000000000000000000000000000000000000600000900000c"),
    ('-', 4, "0000000000000000000000000000000000007c"),
    ('.', 3, "0000000000000000000000000000000000000000000000002000002"),
    ('0', 8, "0000000be000283400341800301c00701c00301c003418002834000be"),
    ('1', 8, "00000006c0002ec00011c00001c00001c00001c00001c00001c00001c"),
    ('2', 8, "0000000be000282800241c0000280000740001d0000740001d00003ff8"),
    ('3', 8, "0000000be400282c00201c0000240001f400002800601c003428001be"),
    ('4', 8, "00000000b00001f0000370000a7000187000347000bffc00007000007"),
    ('5', 8, "0000001ff8002400002400003ae000382800001c00201c003428001be"),
    ('6', 8, "00000007e00018280034040036e000782800701c00301c002828000be"),
    ('7', 8, "0000007ffc0000240000700000900001c0000240000600000d000018"),
    ('8', 8, "0000001be000342800301c003428001ff400342800301c003428001be"),
    ('9', 8, "0000000be000282800301c00301c00282c000b9c002018002434000b9"),
    (':', 3, "0000000000000000003000002000000000000000000000002000002"),
    ('A', 8, "00000002d00003a0000670000934000c28001ffc00240d00300a006007"),
    ('B', 8, "0000007fe400702c00701c007028007ff400702c00701c007028007fe"),
    ('F', 7, "0000007ff8007000007000007000007ff4007000007000007000007"),
    ('M', 11, "0000007c00f07d01f07a02b077037073467072897071cc7070a87070747"),
    ('R', 8, "0000007fe400702800701c007028007fe000703400702800701800701c"),
    ('W', 12, "000000a02d03702d0734360a24630918934c1cc2580dc1a40a80e40740b"),
    ('a', 7, "0000000000000000000bd0002470001070001eb00034700030b0002fb"),
    ('b', 8, "00000070000070000076e000782800701c00701c00701c007824007be"),
    ('c', 7, "0000000000000000000be0002828003004003000003004002828000be"),
    ('d', 8, "000000001c00001c000bec00282c00301c00301c00301c00282c000b9c"),
    ('e', 7, "0000000000000000000bd0002824003018003ff8003004002824000bd"),
    ('f', 4, "150000350000700000fd00007000007000007000007000007000007"),
    ('g', 8, "0000000000000000000bec00282c00301c00301c00301c00282c000b9c00201c002828000be"),
    ('h', 8, "00000070000070000076e400782c00741c00701c00701c00701c00701c"),
    ('i', 3, "0000002000000000007000007000007000007000007000007000007"),
    ('j', 3, "000000200000000000700000700000700000700000700000700000700000700000700000e"),
    ('k', 7, "00000070000070000070740071d0007340007e000077800070d0007074"),
    ('l', 3, "00000070000070000070000070000070000070000070000070000038"),
    ('m', 11, "0000000000000000007bdbd074747070707070707070707070707070707"),
    ('n', 8, "00000000000000000076e400782c00741c00701c00701c00701c00701c"),
    ('o', 9, "0000000000000000000be400280d00340700300700340700280d000be4"),
    ('p', 8, "00000000000000000076e000782800701c00701c00701c007824007be0007000007000007"),
    ('q', 8, "0000000000000000000bec00282c00301c00301c00301c00282c000b9c00001c00001c00001c"),
    ('r', 4, "0000000000000000007700007800007000007000007000007000007"),
    ('s', 7, "0000000000000000001f800030a0003400001b800000b0007070001f9"),
    ('t', 4, "000000200000700000fd00007000007000007000007000007000002d"),
    ('u', 8, "000000000000000000701c00701c00701c00701c00701c00342c001f9c"),
    ('v', 7, "00000000000000000090240060300030600024900018c0000e80000b4"),
    ('w', 10, "000000000000000000d0b070a0f46071a4903558c02a4d801b0a400e0b"),
    ('x', 6, "000000000000000000a0a00035c0001e40000b00001a400035c000a0a"),
    ('y', 7, "00000000000000000090240060300030600024900018c0000d80000b400007000009000078"),
    ('z', 7, "0000000000000000002ff40000700001d0000340000a00001c00003ff4"),
];

fn letter(wanted: char) -> Option<&'static (char, u32, &'static str)> {
    LETTERS.iter().find(|letter| letter.0 == wanted)
}

/// Pixels that a text takes on one line; what the alphabet does not hold takes none.
pub fn width(text: &str) -> u32 {
    text.chars().filter_map(letter).map(|letter| letter.1).sum()
}

/// Calls `paint` for every pixel that the text covers, right of and below its upper left corner, with how much of it is covered.
pub fn draw(text: &str, mut paint: impl FnMut(UVec2, f32)) {
    let mut left = 0;
    for (_, width, shape) in text.chars().filter_map(letter) {
        // A digit holds two pixels.
        for (place, digit) in (0..).zip(shape.chars().filter_map(|digit| digit.to_digit(16))) {
            let (x, y) = (place * 2 % ROW, place * 2 / ROW);
            for (x, cover) in [(x, digit >> 2), (x + 1, digit & 3)] {
                if cover > 0 {
                    paint(UVec2::new(left + x, y), cover as f32 / 3.0);
                }
            }
        }
        left += width;
    }
}

/// The text on as many lines as keep within a number of pixels, cut between words only.
pub fn wrapped(text: &str, most: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line) + width(" ") + width(word) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_stay_within_their_widths_and_their_lines() {
        for (letter, width, _) in LETTERS {
            draw(&letter.to_string(), |at, cover| {
                assert!(at.x < *width && at.y < LINE && cover <= 1.0, "{letter} at {at}");
            });
        }
    }

    #[test]
    fn lines_are_cut_between_words() {
        assert_eq!(
            wrapped("second depth, tangent plane", width("second depth, t")),
            ["second depth,", "tangent plane"]
        );
        assert!(wrapped("", 10).is_empty());
    }
}
