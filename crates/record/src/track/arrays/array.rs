//! An array of a file, and the file that it stands in.

use super::attributes::Attributes;
use super::cf_time::Stamp;
use super::errors::Trouble;
use super::scalar::Kind;

/// An axis of an array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Axis {
    /// How many values stand along it.
    pub(super) length: u64,
    /// Bytes from one to the next.
    pub(super) stride: usize,
    /// The dimension that it is, where the file names it.
    pub(super) dimension: Option<String>,
}

/// An array of values of one kind.
#[derive(Debug, Clone)]
pub(super) struct Array {
    /// Its name, with those of its groups before it: `imu/ax`.
    pub(super) name: String,
    /// The groups that it is in; empty for the root.
    pub(super) group: String,
    /// The stored bytes that it is in, by their number in the file.
    pub(super) place: usize,
    /// Where the first value begins in them.
    pub(super) offset: usize,
    /// Its axes, without those of one value.
    pub(super) axes: Vec<Axis>,
    pub(super) kind: Kind,
    pub(super) attributes: Attributes,
    /// The table that it is a column of, where the file stores tables.
    pub(super) table: Option<String>,
    /// What its values mean as moments, where another place than its units says so.
    pub(super) stamp: Option<Stamp>,
}

impl Array {
    /// Its name without those of its groups.
    pub(super) fn base(&self) -> &str {
        self.name.rsplit('/').next().unwrap_or(&self.name)
    }
}

/// Gives the bytes of arrays.
pub(super) trait Bytes: Send {
    /// How many bytes a place has.
    fn length(&self, place: usize) -> Result<u64, Trouble>;
    /// The bytes of a place.
    fn read(&self, place: usize) -> Result<Vec<u8>, Trouble>;
    /// The text that a value of a place refers to.
    fn text(&self, place: usize, reference: &[u8]) -> Result<Vec<u8>, Trouble>;
}

/// What a file holds.
pub(super) struct Store {
    /// The name of its packing.
    pub(super) packing: &'static str,
    pub(super) arrays: Vec<Array>,
    /// Names of what is not read, with the reason.
    pub(super) unread: Vec<(String, String)>,
    pub(super) bytes: Box<dyn Bytes>,
    /// Which values stand for none where the file does not say.
    pub(super) fills: Fills,
    /// True for a file of Matlab, which stores the axes of a matrix the other way round.
    pub(super) is_matlab: bool,
}

/// Which values stand for none where the file does not say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fills {
    /// None does.
    Nothing,
    /// Those that NetCDF writes where nothing was.
    NetCdf,
}

/// Axes of an array of this shape, the last of which changes fastest, whose values have this many bytes. Axes of one
/// value are left out; none where the sizes overflow.
pub(super) fn axes(shape: &[u64], dimensions: &[Option<String>], element: usize) -> Option<Vec<Axis>> {
    let mut stride = element;
    let mut axes = Vec::with_capacity(shape.len());
    for (place, length) in shape.iter().enumerate().rev() {
        axes.push(Axis { length: *length, stride, dimension: dimensions.get(place).cloned().flatten() });
        stride = stride.checked_mul(usize::try_from((*length).max(1)).ok()?)?;
    }
    axes.reverse();
    axes.retain(|axis| axis.length != 1);
    Some(axes)
}
