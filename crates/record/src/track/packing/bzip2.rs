//! bzip2.

use std::io::{self, Write};

use bzip2::Compression;
use bzip2::read::MultiBzDecoder;
use bzip2::write::BzEncoder;

use super::{Form, Opened, Packer, Packing, buffered};

pub(super) const PACKING: Packing = Packing {
    name: "bzip2",
    ending: ".bz2",
    known: |start| match start {
        // After the size of its blocks a file has a block, or its end.
        [b'B', b'Z', b'h', b'1'..=b'9', rest @ ..] => {
            rest.starts_with(b"\x31\x41\x59\x26\x53\x59") || rest.starts_with(b"\x17\x72\x45\x38\x50\x90")
        }
        _ => false,
    },
    tool: "bunzip2 -k",
    joins: true,
    unpack: |_, stream, _| Ok(Opened::text(MultiBzDecoder::new(buffered(stream)))),
    form: Form::Text(|out, _| Ok(Box::new(BzEncoder::new(out, Compression::best())))),
};

impl Packer for BzEncoder<&mut dyn Write> {
    fn finish(self: Box<Self>) -> io::Result<()> {
        Self::finish(*self).map(|_| ())
    }
}
