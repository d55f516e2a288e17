//! xz (LZMA2).

use std::io::{self, Write};

use lzma_rust2::{XzOptions, XzReader, XzWriter};

use super::{Form, Opened, Packer, Packing, buffered};

/// A dictionary that is larger than `xz -9` makes is no record, but somebody who means harm.
const MOST_MEMORY_KIB: u32 = 256 << 10;
/// The preset of the command `xz`.
const PRESET: u32 = 6;

pub(super) const PACKING: Packing = Packing {
    name: "xz",
    ending: ".xz",
    known: |start| start.starts_with(b"\xfd7zXZ\0"),
    tool: "unxz -k",
    joins: true,
    unpack: |_, stream, _| Ok(Opened::text(XzReader::new_mem_limit(buffered(stream), true, MOST_MEMORY_KIB))),
    form: Form::Text(|out, _| Ok(Box::new(XzWriter::new(out, XzOptions::with_preset(PRESET))?))),
};

impl Packer for XzWriter<&mut dyn Write> {
    fn finish(self: Box<Self>) -> io::Result<()> {
        Self::finish(*self).map(|_| ())
    }
}
