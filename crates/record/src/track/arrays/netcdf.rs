//! The variables of a NetCDF-3 file: classic, with offsets of 64 bits, or with sizes of 64 bits.

use netcdf_reader::classic::ClassicFile;
use netcdf_reader::classic::data::compute_record_stride;
use netcdf_reader::{NcAttrValue, NcFormat, NcType, NcVariable};

use super::array::{Array, Axis, Bytes, Fills, Store};
use super::attributes::{Attribute, Attributes};
use super::errors::{Trouble, guarded};
use super::scalar::{Kind, Scalar};

impl From<netcdf_reader::Error> for Trouble {
    fn from(e: netcdf_reader::Error) -> Self {
        Self::Damaged(e.to_string())
    }
}

/// Finds the variables in the bytes of a file. They stand in it as they are, so that no value is copied.
pub(super) fn open(bytes: Vec<u8>) -> Result<Store, Trouble> {
    guarded(|| {
        let format = match bytes.get(3) {
            Some(1) => NcFormat::Classic,
            Some(2) => NcFormat::Offset64,
            _ => NcFormat::Cdf5,
        };
        let file = ClassicFile::from_bytes(&bytes, format)?;
        let variables = &file.root_group().variables;
        let record = compute_record_stride(variables)?;
        let (mut arrays, mut unread) = (Vec::new(), Vec::new());
        for variable in variables {
            match array(variable, record, bytes.len()) {
                Some(array) => arrays.push(array),
                None => unread.push((variable.name.clone(), "it reaches beyond the file".to_owned())),
            }
        }
        Ok(Store {
            packing: "NetCDF",
            arrays,
            unread,
            bytes: Box::new(Whole(bytes)),
            fills: Fills::NetCdf,
            is_matlab: false,
        })
    })
}

/// A variable, whose records stand this many bytes apart; none where it does not lie in the file.
fn array(variable: &NcVariable, record: u64, file: usize) -> Option<Array> {
    let mut dimensions = variable.dimensions.as_slice();
    let mut kind = match variable.dtype {
        NcType::Byte => int(1, true),
        NcType::UByte => int(1, false),
        NcType::Short => int(2, true),
        NcType::UShort => int(2, false),
        NcType::Int => int(4, true),
        NcType::UInt => int(4, false),
        NcType::Int64 => int(8, true),
        NcType::UInt64 => int(8, false),
        NcType::Float => Kind::Float { size: 4, big: true },
        NcType::Double => Kind::Float { size: 8, big: true },
        NcType::Char => Kind::Text { size: 1 },
        _ => return None,
    };
    if let (NcType::Char, [rest @ .., length]) = (&variable.dtype, dimensions)
        && !rest.is_empty()
    {
        kind = Kind::Text { size: usize::try_from(length.size).ok()? };
        dimensions = rest;
    }
    let mut axes = Vec::new();
    let mut stride = kind.size();
    let mut reach = kind.size();
    for (place, dimension) in dimensions.iter().enumerate().rev() {
        let own = if place == 0 && variable.is_record_var { usize::try_from(record).ok()? } else { stride };
        axes.push(Axis { length: dimension.size, stride: own, dimension: Some(dimension.name.clone()) });
        let length = usize::try_from(dimension.size).ok()?;
        reach = reach.checked_add(own.checked_mul(length.saturating_sub(1))?)?;
        stride = own.checked_mul(length.max(1))?;
    }
    axes.reverse();
    let empty = axes.iter().any(|axis| axis.length == 0);
    axes.retain(|axis| axis.length != 1);
    let offset = usize::try_from(variable.data_offset).ok()?;
    (empty || offset.checked_add(reach)? <= file).then(|| Array {
        name: variable.name.clone(),
        group: String::new(),
        place: 0,
        offset,
        axes,
        kind,
        attributes: attributes(variable),
        table: None,
        stamp: None,
    })
}

fn int(size: usize, signed: bool) -> Kind {
    Kind::Int { size, signed, big: true }
}

fn attributes(variable: &NcVariable) -> Attributes {
    fn ints<T: Copy + Into<i128>>(values: &[T]) -> Attribute {
        Attribute::Numbers(values.iter().map(|v| Scalar::Int((*v).into())).collect())
    }
    let value = |value: &NcAttrValue| match value {
        NcAttrValue::Chars(text) => Attribute::Text(text.clone()),
        NcAttrValue::Strings(texts) => Attribute::Text(texts.join(" ")),
        NcAttrValue::Bytes(v) => ints(v),
        NcAttrValue::UBytes(v) => ints(v),
        NcAttrValue::Shorts(v) => ints(v),
        NcAttrValue::UShorts(v) => ints(v),
        NcAttrValue::Ints(v) => ints(v),
        NcAttrValue::UInts(v) => ints(v),
        NcAttrValue::Int64s(v) => ints(v),
        NcAttrValue::UInt64s(v) => ints(v),
        NcAttrValue::Floats(v) => Attribute::Numbers(v.iter().map(|v| Scalar::F32(*v)).collect()),
        NcAttrValue::Doubles(v) => Attribute::Numbers(v.iter().map(|v| Scalar::F64(*v)).collect()),
        NcAttrValue::UserDefined { .. } => Attribute::Numbers(Vec::new()),
    };
    Attributes(variable.attributes.iter().map(|a| (a.name.clone(), value(&a.value))).collect())
}

/// The bytes of the file, in which all variables stand.
struct Whole(Vec<u8>);

impl Bytes for Whole {
    fn length(&self, _: usize) -> Result<u64, Trouble> {
        Ok(self.0.len() as u64)
    }

    fn read(&self, _: usize) -> Result<Vec<u8>, Trouble> {
        Ok(self.0.clone())
    }

    fn text(&self, _: usize, _: &[u8]) -> Result<Vec<u8>, Trouble> {
        Ok(Vec::new())
    }
}
