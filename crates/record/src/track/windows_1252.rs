//! Windows-1252, the superset of Latin-1 that instruments' programs on Windows write.
//!
//! Source: the index "windows-1252" of the WHATWG Encoding Standard, in which every byte is a character. The library that
//! has all encodings of that standard carries 0.3 MB of tables for the one that is needed here.

/// The characters of the bytes 0x80 to 0x9F; all others are the code point of their own number.
const C1: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8D}', 'Ž', '\u{8F}', //
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9D}', 'ž', 'Ÿ',
];

/// The text in `bytes`. Every byte is a character, so none is lost.
pub(crate) fn decode(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|&byte| if (0x80..0xA0).contains(&byte) { C1[usize::from(byte - 0x80)] } else { char::from(byte) })
        .collect()
}

/// The bytes of `text`; `?` for a character that Windows-1252 does not have.
pub(crate) fn encode(text: &str) -> Vec<u8> {
    text.chars()
        .map(|character| {
            if let Some(place) = (0x80..).zip(C1).find_map(|(byte, c1)| (c1 == character).then_some(byte)) {
                return place;
            }
            u8::try_from(character).ok().filter(|byte| !(0x80..0xA0).contains(byte)).unwrap_or(b'?')
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The characters that the table of the standard gives for bytes met in files, and the five bytes without a character in
    /// Microsoft's own table.
    #[test]
    fn bytes_are_the_characters_of_the_standard() {
        assert_eq!(decode(b"12.5 \xB0C \x80 5 \xB5m \x96 \x9F"), "12.5 °C € 5 µm – Ÿ");
        assert_eq!(decode(b"\x81\x8D\x8F\x90\x9D"), "\u{81}\u{8D}\u{8F}\u{90}\u{9D}");
    }

    #[test]
    fn every_byte_comes_back() {
        let all: Vec<u8> = (0..=255).collect();
        assert_eq!(encode(&decode(&all)), all);
        assert_eq!(encode("高度 m"), b"?? m");
    }
}
