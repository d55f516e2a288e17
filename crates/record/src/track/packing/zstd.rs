//! zstd (RFC 8878).

use std::io::{self, BufRead, BufReader, Read, Write};

use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use super::{Form, Opened, Packer, Packing, Stream, buffered};

pub(super) const PACKING: Packing = Packing {
    name: "zstd",
    ending: ".zst",
    // Some programs begin with a frame that is to be skipped.
    known: |start| matches!(start, [0x28, 0xb5, 0x2f, 0xfd, ..] | [0x50..=0x5f, 0x2a, 0x4d, 0x18, ..]),
    tool: "zstd -d",
    joins: true,
    unpack: |_, stream, _| {
        Ok(Opened::text(Frames { stream: buffered(stream), decoder: FrameDecoder::new(), within: false }))
    },
    form: Form::Text(|out, _| Ok(Box::new(FrameWriter { out, text: Vec::new() }))),
};

/// The frames of a file, one after the other.
struct Frames<'a> {
    stream: BufReader<Stream<'a>>,
    decoder: FrameDecoder,
    /// True inside a frame.
    within: bool,
}

impl Read for Frames<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while !buffer.is_empty() && (self.within || !self.stream.fill_buf()?.is_empty()) {
            if !self.within {
                self.within = self.enter()?;
                continue;
            }
            while self.decoder.can_collect() == 0 && !self.decoder.is_finished() {
                let one = BlockDecodingStrategy::UptoBlocks(1);
                self.decoder.decode_blocks(&mut self.stream, one).map_err(io::Error::other)?;
            }
            match self.decoder.read(buffer)? {
                0 => self.leave()?,
                n => return Ok(n),
            }
        }
        Ok(0)
    }
}

impl Frames<'_> {
    /// Begins the next frame; false where it is one to be skipped, which has been done then.
    fn enter(&mut self) -> io::Result<bool> {
        let length = match self.decoder.init(&mut self.stream) {
            Ok(()) => return Ok(true),
            Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame { length, .. })) => length,
            Err(e) => return Err(io::Error::other(e)),
        };
        let skipped = io::copy(&mut (&mut self.stream).take(length.into()), &mut io::sink())?;
        if skipped < length.into() { Err(io::ErrorKind::UnexpectedEof.into()) } else { Ok(false) }
    }

    fn leave(&mut self) -> io::Result<()> {
        self.within = false;
        match (self.decoder.get_checksum_from_data(), self.decoder.get_calculated_checksum()) {
            (Some(told), Some(found)) if told != found => Err(io::Error::other("the checksum does not fit")),
            _ => Ok(()),
        }
    }
}

/// The bytes in packed ones, this many at most.
pub(crate) fn unpacked(packed: &[u8], most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    Frames { stream: buffered(Box::new(packed)), decoder: FrameDecoder::new(), within: false }
        .take(most)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Bytes packed into a frame.
pub(crate) fn packed(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec(bytes, CompressionLevel::Fastest)
}

/// Text of a frame.
const FRAME: usize = 1 << 20;

/// Packs pieces of text into a frame each.
struct FrameWriter<'a> {
    out: &'a mut dyn Write,
    text: Vec<u8>,
}

impl FrameWriter<'_> {
    fn frame(&mut self) -> io::Result<()> {
        let frame = packed(&self.text);
        self.text.clear();
        self.out.write_all(&frame)
    }
}

impl Write for FrameWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = bytes.len().min(FRAME - self.text.len());
        self.text.extend_from_slice(&bytes[..n]);
        if self.text.len() == FRAME {
            self.frame()?;
        }
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Packer for FrameWriter<'_> {
    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.frame()
    }
}
