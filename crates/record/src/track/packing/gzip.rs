//! gzip (RFC 1952).

use std::io::{self, Write};

use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use flate2::{Compression, GzBuilder};

use super::{Form, Opened, Packer, Packing, buffered};

pub(super) const PACKING: Packing = Packing {
    name: "gzip",
    ending: ".gz",
    known: |start| start.starts_with(&[0x1f, 0x8b]),
    tool: "gunzip -k",
    joins: true,
    unpack: |_, stream, _| Ok(Opened::text(MultiGzDecoder::new(buffered(stream)))),
    // No time stamp: the same content makes the same file.
    form: Form::Text(|out, _| Ok(Box::new(GzBuilder::new().mtime(0).write(out, Compression::default())))),
};

impl Packer for GzEncoder<&mut dyn Write> {
    fn finish(self: Box<Self>) -> io::Result<()> {
        Self::finish(*self).map(|_| ())
    }
}
