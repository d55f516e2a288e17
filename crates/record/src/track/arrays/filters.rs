//! How values are packed in HDF5, beyond what the library reads.

use hdf5_reader::FilterRegistry;
use hdf5_reader::error::Error;

use super::super::packing::zstd_unpacked;

const LZF: u16 = 32_000;
const ZSTD: u16 = 32_015;
/// Bytes of the largest piece of an array.
const MOST: usize = hdf5_reader::DEFAULT_MAX_CHUNK_BYTES;

/// The filters that are read: those of the library, LZF (of h5py) and Zstandard (of newer NetCDF-4).
pub(super) fn registry() -> FilterRegistry {
    let mut registry = FilterRegistry::new();
    registry.register(
        LZF,
        Box::new(|filter, packed, _| {
            let size = filter.client_data.get(2).map_or(MOST, |size| *size as usize);
            lzf(packed, size.min(MOST)).ok_or_else(|| Error::DecompressionError("LZF".into()))
        }),
    );
    registry.register(
        ZSTD,
        Box::new(|_, packed, _| {
            zstd_unpacked(packed, MOST as u64).map_err(|e| Error::DecompressionError(e.to_string()))
        }),
    );
    registry
}

/// The name of a filter that is not read.
pub(super) fn name(told: &str) -> String {
    let number: Option<u32> = told.rsplit(' ').next().and_then(|word| word.parse().ok());
    match number {
        Some(305) => "LZO".into(),
        Some(307) => "bzip2".into(),
        Some(32_001) => "Blosc".into(),
        Some(32_026) => "Blosc2".into(),
        Some(32_008) => "Bitshuffle".into(),
        Some(32_013) => "ZFP".into(),
        Some(32_017) => "SZ".into(),
        Some(number) => format!("filter {number}"),
        None => told.to_owned(),
    }
}

/// What LZF packed: a length of bytes that follow as they are, or of bytes that stood so far before.
fn lzf(packed: &[u8], most: usize) -> Option<Vec<u8>> {
    let mut out: Vec<u8> = Vec::with_capacity(most.min(packed.len().saturating_mul(8)));
    let mut bytes = packed.iter().copied();
    while let Some(control) = bytes.next() {
        let control = usize::from(control);
        if control < 32 {
            for _ in 0..=control {
                out.push(bytes.next()?);
            }
        } else {
            let mut length = control >> 5;
            if length == 7 {
                length += usize::from(bytes.next()?);
            }
            let back = ((control & 0x1f) << 8 | usize::from(bytes.next()?)) + 1;
            let from = out.len().checked_sub(back)?;
            // What is copied may reach into what has been copied just now.
            for at in from..from + length + 2 {
                out.push(out[at]);
            }
        }
        if out.len() > most {
            return None;
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lzf_repeats_what_stood_before() {
        // Three bytes as they are, then seven from three before, which overlap themselves.
        let packed = [2, b'a', b'b', b'c', (5 << 5), 2];
        assert_eq!(lzf(&packed, 100).unwrap(), b"abcabcabca");
        assert_eq!(lzf(&packed, 5), None);
        assert_eq!(lzf(&[0x20, 9], 100), None, "from before the start");
    }
}
