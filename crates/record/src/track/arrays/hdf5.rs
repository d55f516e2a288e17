//! The arrays of an HDF5 file, and so of NetCDF-4 and MAT 7.3.

use std::collections::{BTreeSet, HashMap};

use hdf5_reader::group::Group;
use hdf5_reader::{
    Attribute as Stored, CompoundField, Dataset, Datatype, Hdf5File, OpenOptions, StringSize, VarLenKind,
};
use hdf5_reader::{ByteOrder, error::Error};

use super::array::{Array, Axis, Bytes, Fills, Store, axes};
use super::attributes::{Attribute, Attributes};
use super::cf_time::Stamp;
use super::errors::{Trouble, guarded};
use super::filters;
use super::matlab;
use super::scalar::{Kind, Scalar};
use crate::memory::limit;

/// Groups within groups.
const DEEPEST: usize = 16;
/// Arrays of a file.
const MOST: usize = 10_000;
/// Numbers of an attribute that are looked at.
const MOST_NUMBERS: usize = 64;

impl From<Error> for Trouble {
    fn from(e: Error) -> Self {
        match e {
            Error::Context { source, .. } => (*source).into(),
            Error::UnsupportedFilter(filter) => Self::Filter(filters::name(&filter)),
            Error::ResourceLimit(_) => Self::Full(crate::memory::Full { limit: limit() }),
            other => Self::Damaged(other.to_string()),
        }
    }
}

/// Finds the arrays in the bytes of a file.
pub(super) fn open(bytes: Vec<u8>) -> Result<Store, Trouble> {
    guarded(|| {
        let is_matlab = matlab::is_matlab(&bytes);
        let most = usize::try_from(limit()).unwrap_or(usize::MAX);
        let options = OpenOptions::default()
            .with_chunk_cache_bytes(0)
            .with_filter_registry(filters::registry())
            .with_max_read_bytes(most)
            .with_max_chunk_bytes(hdf5_reader::DEFAULT_MAX_CHUNK_BYTES.min(most));
        let file = Hdf5File::from_vec_with_options(bytes, options)?;
        let root = file.root_group()?;
        let about = root.attributes().unwrap_or_default();
        let netcdf = about.iter().any(|a| matches!(a.name.as_str(), "_NCProperties" | "Conventions" | "_nc3_strict"));
        let mut walk = Walk { is_matlab, ..Walk::default() };
        walk.group(&root, "", 0)?;
        Ok(walk.store(netcdf))
    })
}

/// What a walk through the groups found.
#[derive(Default)]
struct Walk {
    is_matlab: bool,
    datasets: Vec<Dataset>,
    /// Names of the datasets, by their addresses.
    names: HashMap<u64, String>,
    groups: BTreeSet<u64>,
    found: Vec<Found>,
    unread: Vec<(String, String)>,
}

/// A dataset with its name.
struct Found {
    name: String,
    group: String,
    place: usize,
}

/// A part of the values of a dataset.
struct Part<'a> {
    name: String,
    kind: &'a Datatype,
    offset: usize,
    table: Option<String>,
}

impl Walk {
    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), Trouble> {
        // A group may be reached in several ways.
        if depth > DEEPEST || !self.groups.insert(group.address()) {
            return Ok(());
        }
        let (groups, datasets) = group.member_names()?;
        let within = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}/{name}") };
        for name in datasets.iter().take(MOST.saturating_sub(self.found.len())) {
            match group.dataset(name) {
                Ok(dataset) => {
                    let own = within(name.strip_prefix("_nc4_non_coord_").unwrap_or(name));
                    self.names.insert(dataset.address(), own.clone());
                    self.found.push(Found { name: own, group: path.to_owned(), place: self.datasets.len() });
                    self.datasets.push(dataset);
                }
                Err(e) => self.unread.push((within(name), reason(e))),
            }
        }
        // What Matlab and PyTables keep beside the values.
        let is_inner = |name: &String| name.starts_with('#') || name.starts_with("_i_");
        for name in groups.iter().filter(|name| !is_inner(name)) {
            match group.group(name) {
                Ok(inner) => self.group(&inner, &within(name), depth + 1)?,
                Err(e) => self.unread.push((within(name), reason(e))),
            }
        }
        Ok(())
    }

    fn store(mut self, netcdf: bool) -> Store {
        let mut arrays = Vec::new();
        for found in std::mem::take(&mut self.found) {
            self.dataset(&found, &mut arrays);
        }
        Store {
            packing: if self.is_matlab { "MAT 7.3" } else { "HDF5" },
            arrays: named_blocks(arrays, &self.datasets),
            unread: self.unread,
            bytes: Box::new(Datasets(self.datasets)),
            fills: if netcdf { Fills::NetCdf } else { Fills::Nothing },
            is_matlab: self.is_matlab,
        }
    }

    /// Adds the arrays of a dataset.
    fn dataset(&mut self, found: &Found, arrays: &mut Vec<Array>) {
        let dataset = &self.datasets[found.place];
        let about = attributes(&dataset.attributes());
        let is_bare = about.text("NAME").is_some_and(|name| name.starts_with("This is a netCDF dimension but not"));
        if is_bare || dataset.shape().iter().all(|length| *length == 1) {
            return;
        }
        if let Some(why) = matlab::unread(&about).filter(|_| self.is_matlab) {
            self.unread.push((found.name.clone(), why.to_owned()));
            return;
        }
        let dimensions = dimensions(dataset, &about, &found.name, &self.names);
        let element = dataset.raw_element_size().ok();
        let Some(axes) = element.and_then(|element| axes(dataset.shape(), &dimensions, element)) else {
            self.unread.push((found.name.clone(), "more values than can be".into()));
            return;
        };
        let pandas = pandas_stamp(&about);
        for part in parts(found, dataset.dtype()) {
            let stamp = datetime_tag(part.kind).or_else(|| of_field(&about, &part)).or(pandas);
            let (base, inner) = match part.kind {
                Datatype::Array { base, dims } => (base.as_ref(), Some(dims)),
                plain => (plain, None),
            };
            let Some(kind) = kind_of(base, dataset.vlen_reference_size()) else {
                self.unread.push((part.name, what(base).to_owned()));
                continue;
            };
            let kind = if self.is_matlab { matlab::kind(kind, &about) } else { kind };
            let mut axes = axes.clone();
            if let Some(dims) = inner {
                axes.extend(super::array::axes(dims, &[], kind.size()).unwrap_or_default());
            }
            arrays.push(Array {
                name: part.name,
                group: found.group.clone(),
                place: found.place,
                offset: part.offset,
                axes,
                kind,
                attributes: about.clone(),
                table: part.table,
                stamp,
            });
        }
    }
}

fn reason(e: Error) -> String {
    match Trouble::from(e) {
        Trouble::Damaged(what) | Trouble::Filter(what) => what,
        other => format!("{other:?}"),
    }
}

/// The fields of a table; of a complex number its parts; of anything else the whole.
fn parts<'a>(found: &Found, kind: &'a Datatype) -> Vec<Part<'a>> {
    let Datatype::Compound { fields, .. } = kind else {
        return vec![Part { name: found.name.clone(), kind, offset: 0, table: None }];
    };
    let names: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
    let complex = matches!(names.as_slice(), ["r", "i"] | ["real", "imag"]);
    let mut parts = Vec::new();
    fields_of(fields, "", 0, &mut parts);
    for part in &mut parts {
        if complex {
            part.name = format!("{}.{}", found.name, part.name);
        } else {
            part.table = Some(found.name.clone());
        }
    }
    parts
}

/// The fields of a compound value, those of compound fields under names with a point.
fn fields_of<'a>(fields: &'a [CompoundField], before: &str, offset: usize, parts: &mut Vec<Part<'a>>) {
    for field in fields {
        let offset = offset.saturating_add(field.byte_offset as usize);
        let name = format!("{before}{}", field.name);
        match &field.datatype {
            Datatype::Compound { fields, .. } => fields_of(fields, &format!("{name}."), offset, parts),
            kind => parts.push(Part { name, kind, offset, table: None }),
        }
    }
}

/// How values of a type are stored; none for what is no number and no text.
fn kind_of(kind: &Datatype, reference: usize) -> Option<Kind> {
    let is_big = |order: &ByteOrder| *order == ByteOrder::BigEndian;
    Some(match kind {
        Datatype::FixedPoint { size, signed, byte_order } if *size <= 8 => {
            Kind::Int { size: (*size).into(), signed: *signed, big: is_big(byte_order) }
        }
        Datatype::FloatingPoint { size: size @ (2 | 4 | 8), byte_order } => {
            Kind::Float { size: (*size).into(), big: is_big(byte_order) }
        }
        Datatype::String { size: StringSize::Fixed(size), .. } => Kind::Text { size: *size as usize },
        Datatype::String { size: StringSize::Variable, .. } | Datatype::VarLen { kind: VarLenKind::String, .. } => {
            Kind::TextElsewhere { size: reference }
        }
        // Truths of PyTables.
        Datatype::Bitfield { size: 1, .. } => Kind::truth(),
        Datatype::Bitfield { size, byte_order } if *size <= 8 => {
            Kind::Int { size: (*size).into(), signed: false, big: is_big(byte_order) }
        }
        Datatype::Enum { base, members } => {
            let base = kind_of(base, reference).filter(Kind::is_whole)?;
            let name = |value: &[u8]| match base.number(value) {
                Some(Scalar::Int(number)) => Some(number),
                _ => None,
            };
            let names = members.iter().filter_map(|m| Some((name(&m.value)?, m.name.clone()))).collect();
            Kind::Named { base: Box::new(base), names }
        }
        Datatype::Opaque { size: 8, tag } if tag.starts_with("NUMPY:datetime64") => {
            Kind::Int { size: 8, signed: true, big: tag.contains(">") }
        }
        _ => return None,
    })
}

/// What is not read, in words.
fn what(kind: &Datatype) -> &'static str {
    match kind {
        Datatype::Reference { .. } => "references to other arrays",
        Datatype::VarLen { .. } => "lists of values",
        Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. } => "numbers of an unusual size",
        _ => "values that are no numbers and no text",
    }
}

/// The nanoseconds of a unit of numpy.
fn numpy_unit(text: &str) -> Option<i128> {
    let unit = text.split_once('[')?.1.split_once(']')?.0;
    Some(match unit {
        "ns" => 1,
        "us" => 1000,
        "ms" => 1_000_000,
        "s" => 1_000_000_000,
        "m" => 60_000_000_000,
        "h" => 3_600_000_000_000,
        "D" => 86_400_000_000_000,
        _ => return None,
    })
}

/// Moments of numpy, which h5py stores with a tag.
fn datetime_tag(kind: &Datatype) -> Option<Stamp> {
    match kind {
        Datatype::Opaque { tag, .. } if tag.starts_with("NUMPY:datetime64") => numpy_unit(tag).map(Stamp::since_1970),
        _ => None,
    }
}

/// Moments of pandas: an attribute says that whole numbers are such.
fn stamp_in(kind: Option<&str>) -> Option<Stamp> {
    let kind = kind.filter(|kind| kind.starts_with("datetime64"))?;
    Some(Stamp::since_1970(numpy_unit(kind).unwrap_or(1)))
}

fn pandas_stamp(about: &Attributes) -> Option<Stamp> {
    stamp_in(about.text("kind"))
}

/// The same for a field of a table.
fn of_field(about: &Attributes, part: &Part<'_>) -> Option<Stamp> {
    part.table.as_ref()?;
    stamp_in(about.text(&format!("{}_kind", part.name)))
}

/// The attributes of a dataset, as far as they are texts or numbers.
fn attributes(stored: &[Stored]) -> Attributes {
    let value = |a: &Stored| -> Option<Attribute> {
        if let Ok(texts) = a.read_strings() {
            return Some(Attribute::Text(texts.join(" ")));
        }
        let kind = kind_of(&a.datatype, usize::MAX)?;
        let numbers = a.raw_data.chunks_exact(kind.size().max(1)).take(MOST_NUMBERS);
        Some(Attribute::Numbers(numbers.filter_map(|bytes| kind.number(bytes)).collect()))
    };
    // What is of another kind is there all the same.
    let named = |a: &Stored| (a.name.clone(), value(a).unwrap_or(Attribute::Numbers(Vec::new())));
    Attributes(stored.iter().map(named).collect())
}

/// The dimensions of a dataset, by their names, as far as the file says what they are.
fn dimensions(dataset: &Dataset, about: &Attributes, own: &str, names: &HashMap<u64, String>) -> Vec<Option<String>> {
    let count = dataset.shape().len();
    if about.text("CLASS") == Some("DIMENSION_SCALE") && count == 1 {
        return vec![Some(own.to_owned())];
    }
    let list = dataset.attribute("DIMENSION_LIST").ok();
    let size = dataset.vlen_reference_size();
    let name = |axis: usize| {
        let reference = list.as_ref()?.raw_data.get(axis * size..(axis + 1) * size)?;
        let addresses = dataset.resolve_vlen_reference_bytes(reference, 8).ok()?;
        let address = u64::from_le_bytes(addresses.get(..8)?.try_into().ok()?);
        names.get(&address).cloned()
    };
    (0..count).map(name).collect()
}

/// A frame that pandas stored in blocks: the columns of a block get their names.
fn named_blocks(mut arrays: Vec<Array>, datasets: &[Dataset]) -> Vec<Array> {
    let items: Vec<(String, usize)> = arrays
        .iter()
        .filter(|a| a.base().starts_with("block") && a.base().ends_with("_items"))
        .map(|a| (a.name.clone(), a.place))
        .collect();
    for (items, place) in items {
        let Ok(names) = datasets[place].read_strings() else { continue };
        let group = items.rsplit_once('/').map_or("", |(group, _)| group).to_owned();
        let values = format!("{}_values", items.trim_end_matches("_items"));
        let Some(at) = arrays.iter().position(|a| a.name == values && (1..=2).contains(&a.axes.len())) else {
            continue;
        };
        let block = arrays.remove(at);
        let split = |(index, name): (usize, &String)| {
            let across = block.axes.get(1).map_or(0, |axis| axis.stride);
            let axes: Vec<Axis> = block.axes.first().cloned().into_iter().collect();
            let offset = block.offset + index * across;
            Array { name: name.clone(), offset, axes, table: Some(group.clone()), ..block.clone() }
        };
        arrays.extend(names.iter().enumerate().map(split));
        let is_inner = |a: &Array| {
            a.group == group && (a.base() == "axis0" || a.base().ends_with("_items") && a.base().starts_with("block"))
        };
        arrays.retain(|a| !is_inner(a));
        for index in arrays.iter_mut().filter(|a| a.group == group && a.base() == "axis1") {
            (index.name, index.table) = ("index".to_owned(), Some(group.clone()));
        }
    }
    arrays
}

/// The datasets of a file.
struct Datasets(Vec<Dataset>);

impl Bytes for Datasets {
    fn length(&self, place: usize) -> Result<u64, Trouble> {
        guarded(|| Ok(self.0[place].raw_byte_len()? as u64))
    }

    fn read(&self, place: usize) -> Result<Vec<u8>, Trouble> {
        guarded(|| Ok(self.0[place].read_raw_bytes()?))
    }

    fn text(&self, place: usize, reference: &[u8]) -> Result<Vec<u8>, Trouble> {
        // A text that was never written refers to nothing.
        if reference.iter().skip(4).all(|b| *b == 0) {
            return Ok(Vec::new());
        }
        guarded(|| Ok(self.0[place].resolve_vlen_reference_bytes(reference, 1)?))
    }
}
