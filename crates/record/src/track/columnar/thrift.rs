//! What is to be known of a Parquet file before the library reads it, from its structures in the compact protocol of Thrift:
//! how large its pages become, and which of its columns are encrypted.

/// Structures within structures.
const DEEPEST: u32 = 32;

const I32: u8 = 5;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// What is left of some bytes.
struct Reader<'a> {
    rest: &'a [u8],
    depth: u32,
}

impl<'a> Reader<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, depth: 0 }
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1)?.first().copied()
    }

    fn varint(&mut self) -> Option<u64> {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }

    fn signed(&mut self) -> Option<i64> {
        let value = self.varint()?;
        Some((value >> 1).cast_signed() ^ -(value & 1).cast_signed())
    }

    fn text(&mut self) -> Option<String> {
        let length = usize::try_from(self.varint()?).ok()?;
        Some(String::from_utf8_lossy(self.take(length)?).into_owned())
    }

    /// How many values a list has, and of which type.
    fn list(&mut self) -> Option<(u64, u8)> {
        let head = self.byte()?;
        let count = if head >> 4 == 15 { self.varint()? } else { u64::from(head >> 4) };
        Some((count, head & 0x0f))
    }

    /// Calls `each` with the number and the type of each field of a structure; it takes the value.
    fn fields(&mut self, mut each: impl FnMut(&mut Self, i64, u8) -> Option<()>) -> Option<()> {
        self.depth = Some(self.depth + 1).filter(|depth| *depth <= DEEPEST)?;
        let mut number = 0;
        loop {
            let head = self.byte()?;
            if head == 0 {
                self.depth -= 1;
                return Some(());
            }
            let step = i64::from(head >> 4);
            number = if step == 0 { self.signed()? } else { number + step };
            each(self, number, head & 0x0f)?;
        }
    }

    /// Calls `each` for each value of a list of structures.
    fn structures(&mut self, mut each: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        let (count, kind) = self.list()?;
        (0..count).try_for_each(|_| if kind == STRUCT { each(self) } else { self.skip(kind, true) })
    }

    /// Passes over a value; the truths of a structure stand in their type.
    fn skip(&mut self, kind: u8, in_list: bool) -> Option<()> {
        match kind {
            1 | 2 if !in_list => Some(()),
            1..=3 => self.byte().map(|_| ()),
            4..=6 => self.varint().map(|_| ()),
            7 => self.take(8).map(|_| ()),
            8 => {
                let length = usize::try_from(self.varint()?).ok()?;
                self.take(length).map(|_| ())
            }
            9 | 10 => {
                let (count, kind) = self.list()?;
                (0..count).try_for_each(|_| self.skip(kind, true))
            }
            11 => {
                let count = self.varint()?;
                let kinds = if count == 0 { 0 } else { self.byte()? };
                (0..count).try_for_each(|_| {
                    self.skip(kinds >> 4, true)?;
                    self.skip(kinds & 0x0f, true)
                })
            }
            STRUCT => self.fields(|reader, _, kind| reader.skip(kind, false)),
            13 => self.take(16).map(|_| ()),
            _ => None,
        }
    }
}

/// Bytes of the largest page of a column chunk, unpacked; as far as its pages say so.
pub(super) fn largest_page(chunk: &[u8]) -> u64 {
    let mut largest = 0;
    let mut reader = Reader::of(chunk);
    while !reader.rest.is_empty() {
        let (mut unpacked, mut packed) = (0, 0);
        let head = reader.fields(|reader, number, kind| match (number, kind) {
            (2, I32) => reader.signed().map(|size| unpacked = size),
            (3, I32) => reader.signed().map(|size| packed = size),
            _ => reader.skip(kind, false),
        });
        largest = largest.max(u64::try_from(unpacked).unwrap_or(0));
        let body = usize::try_from(packed).ok().and_then(|packed| reader.take(packed));
        if head.is_none() || body.is_none() {
            break;
        }
    }
    largest
}

/// The names of the columns that are encrypted, by the footer of a file.
pub(super) fn encrypted_columns(footer: &[u8]) -> Vec<String> {
    let mut names = Vec::new();
    // As much as can be read is enough.
    let _ = Reader::of(footer).fields(|reader, number, kind| match (number, kind) {
        (4, LIST) => reader.structures(|group| {
            group.fields(|reader, number, kind| match (number, kind) {
                (1, LIST) => reader.structures(|chunk| {
                    if let Some(name) = encrypted_name(chunk)?
                        && !names.contains(&name)
                    {
                        names.push(name);
                    }
                    Some(())
                }),
                _ => reader.skip(kind, false),
            })
        }),
        _ => reader.skip(kind, false),
    });
    names
}

/// The name of the column of a chunk that is encrypted; none inside where it is not.
#[expect(clippy::option_option, reason = "unreadable, not encrypted, or a name")]
fn encrypted_name(chunk: &mut Reader<'_>) -> Option<Option<String>> {
    let (mut encrypted, mut path) = (false, None);
    chunk.fields(|reader, number, kind| match (number, kind) {
        // What is known of the column, with its path in the third field.
        (3, STRUCT) => reader.fields(|reader, number, kind| named(reader, (number, kind), 3, &mut path)),
        // How it is encrypted: with the key of the footer, or with its own and its path in the first field.
        (8, STRUCT) => {
            encrypted = true;
            reader.fields(|reader, _, kind| match kind {
                STRUCT => reader.fields(|reader, number, kind| named(reader, (number, kind), 1, &mut path)),
                _ => reader.skip(kind, false),
            })
        }
        _ => reader.skip(kind, false),
    })?;
    Some(encrypted.then(|| path.unwrap_or_default()))
}

/// Takes the names of a path from the field of this number.
fn named(reader: &mut Reader<'_>, field: (i64, u8), wanted: i64, path: &mut Option<String>) -> Option<()> {
    if field != (wanted, LIST) {
        return reader.skip(field.1, false);
    }
    let (count, _) = reader.list()?;
    let mut names = Vec::new();
    for _ in 0..count {
        names.push(reader.text()?);
    }
    path.get_or_insert(names.join("."));
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_say_how_large_they_become() {
        // Type 0, 300 bytes from 4, a data page header of one field; then its bytes, and a second page of 2 GiB less one.
        let first = [0x15, 0, 0x15, 0xd8, 0x04, 0x15, 8, 0x2c, 0x15, 2, 0, 0, 1, 2, 3, 4];
        let second = [0x15, 0, 0x15, 0xfe, 0xff, 0xff, 0xff, 0x0f, 0x15, 2, 0, 9];
        assert_eq!(largest_page(&first), 300);
        assert_eq!(largest_page(&[&first[..], &second].concat()), (1 << 31) - 1);
        assert_eq!(largest_page(&first[..4]), 0, "cut off");
    }

    #[test]
    fn encrypted_columns_are_named() {
        // Field 4: a list of one group; its field 1: a list of two chunks; the second has a key of its own.
        let plain = [0x3c, 0x39, 0x18, 1, b'a', 0, 0];
        let locked = [0x8c, 0x2c, 0x19, 0x18, 1, b'b', 0, 0, 0];
        let footer = [&[0x49, 0x1c, 0x19, 0x2c][..], &plain, &locked, &[0, 0]].concat();
        assert_eq!(encrypted_columns(&footer), ["b"]);
        assert!(encrypted_columns(&footer[..8]).is_empty());
    }
}
