//! A column chunk again, with other values in some of its rows and with rows that it did not have.

use parquet::basic::Type;
use parquet::column::reader::{ColumnReaderImpl, get_typed_column_reader};
use parquet::data_type::{
    BoolType, ByteArrayType, DataType, DoubleType, FixedLenByteArrayType, FloatType, Int32Type, Int64Type, Int96Type,
};
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::schema::types::ColumnDescPtr;

use super::super::packing::Unpackable;
use super::access::Chunk;
use super::encode::{Encoded, Form, encode};
use super::errors::broken;
use super::kind::Kind;
use super::pages::{column_reader, guarded};
use super::parse::Storage;
use super::value::{Stored, Value};

/// What is different in a chunk.
#[derive(Debug, Default)]
pub(super) struct Edits {
    /// Rows of the chunk (from 0) with another number, in order; none for no value.
    pub(super) cells: Vec<(usize, Option<f64>)>,
    /// Rows that are new, after the row of the chunk that they follow, in order, with their texts; none for no value.
    pub(super) rows: Vec<(usize, Option<String>)>,
}

impl Edits {
    /// True where nothing is different.
    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty() && self.rows.is_empty()
    }
}

/// A column chunk, and what becomes of it.
pub(super) struct Recoding<'a> {
    pub(super) about: &'a ColumnChunkMetaData,
    pub(super) rows: usize,
    pub(super) storage: Storage,
    /// The column in the copy, which may hold nulls where the column did not.
    pub(super) target: ColumnDescPtr,
    pub(super) edits: &'a Edits,
    /// The text of a number in the place of an old text.
    pub(super) text: &'a dyn Fn(&str, f64) -> String,
}

/// A change that a Parquet file cannot hold, and the way out.
pub(super) fn unwritable(what: &str) -> Unpackable {
    Unpackable::new(what, "write the cleaned copy as text: -o NAME.csv")
}

impl Recoding<'_> {
    /// The chunk with its edits.
    ///
    /// # Errors
    /// [`Unpackable`] for a chunk that cannot be read, and for a value that the column cannot hold.
    pub(super) fn run(&self, chunk: Chunk) -> Result<Encoded, Unpackable> {
        match self.about.column_type() {
            Type::BOOLEAN => self.of_type::<BoolType>(chunk),
            Type::INT32 => self.of_type::<Int32Type>(chunk),
            Type::INT64 => self.of_type::<Int64Type>(chunk),
            Type::INT96 => self.of_type::<Int96Type>(chunk),
            Type::FLOAT => self.of_type::<FloatType>(chunk),
            Type::DOUBLE => self.of_type::<DoubleType>(chunk),
            Type::BYTE_ARRAY => self.of_type::<ByteArrayType>(chunk),
            Type::FIXED_LEN_BYTE_ARRAY => self.of_type::<FixedLenByteArrayType>(chunk),
        }
    }

    fn of_type<T: DataType>(&self, chunk: Chunk) -> Result<Encoded, Unpackable>
    where
        T::T: Stored,
    {
        let form = guarded(|| Form::of(&chunk, self.about, self.rows)).map_err(|e| broken(&e))?;
        let read = || Levelled::<T>::read(get_typed_column_reader(column_reader(chunk, self.about, self.rows)?), self);
        let old = guarded(read).map_err(|e| broken(&e))?;
        let new = self.edited(old)?;
        encode(self.target.clone(), &form, &new).map_err(|e| broken(&e))
    }

    /// The levels and values with the edits.
    fn edited<T: DataType>(&self, old: Levelled<T>) -> Result<Levelled<T>, Unpackable>
    where
        T::T: Stored,
    {
        let full = self.about.column_descr().max_def_level();
        let shift = self.target.max_def_level() - full;
        let mut new = Levelled::<T>::default();
        let mut values = old.values.into_iter();
        let (mut cells, mut rows) = (self.edits.cells.as_slice(), self.edits.rows.as_slice());
        let mut at = 0;
        for row in 0..self.rows {
            let end = old.ends.get(row).copied().unwrap_or(at);
            let change = cells.split_first().filter(|((r, _), _)| *r == row);
            if let Some(((_, value), later)) = change {
                cells = later;
                let level = old.definitions[at];
                let before = if level == full { values.next() } else { None };
                self.put(&mut new, (level, before.as_ref()), *value)?;
            } else {
                for i in at..end {
                    new.definitions.push(old.definitions[i] + shift);
                    new.repetitions.push(old.repetitions.get(i).copied().unwrap_or(0));
                    if old.definitions[i] == full {
                        new.values.extend(values.next());
                    }
                }
            }
            at = end;
            let here = rows.iter().take_while(|(after, _)| *after == row).count();
            let (now, later) = rows.split_at(here);
            rows = later;
            now.iter().try_for_each(|(_, text)| self.insert(&mut new, text.as_deref()))?;
        }
        Ok(new)
    }

    /// A changed cell, which was at a level.
    fn put<T: DataType>(
        &self,
        new: &mut Levelled<T>,
        (level, before): (i16, Option<&T::T>),
        value: Option<f64>,
    ) -> Result<(), Unpackable>
    where
        T::T: Stored,
    {
        let full = self.target.max_def_level();
        let level = level + full - self.about.column_descr().max_def_level();
        let least = if self.nullable() { full - 1 } else { full };
        let stored = match value.filter(|v| v.is_finite()) {
            Some(_) if level < least => return Err(self.misfit("a value in a group that is null")),
            Some(value) => {
                let mut old = Vec::new();
                match before.map(Stored::value) {
                    Some(Value::Bytes(text)) if self.storage.kind == Kind::Text => old.extend_from_slice(&text),
                    Some(value) => self.storage.kind.write(&value, &mut old),
                    None => {}
                }
                let text = (self.text)(&String::from_utf8_lossy(&old), value);
                let stored = self.storage.value(&text).and_then(T::T::of);
                Some(stored.ok_or_else(|| self.misfit("the number"))?)
            }
            None if self.nullable() || level < full => None,
            None => Some(self.empty("a cell without a value")?),
        };
        new.push(stored, (full, level.min(full - 1)));
        Ok(())
    }

    /// A new row.
    fn insert<T: DataType>(&self, new: &mut Levelled<T>, text: Option<&str>) -> Result<(), Unpackable>
    where
        T::T: Stored,
    {
        let full = self.target.max_def_level();
        let member = self.target.path().parts().len() > 1;
        let stored = match text {
            Some(_) if member => return Err(self.misfit("a value in a group of a new row")),
            Some(text) => {
                let stored = self.storage.value(text).and_then(T::T::of);
                Some(stored.ok_or_else(|| self.misfit("the value of a new row"))?)
            }
            None if full > 0 => None,
            None => Some(self.empty("a new row without a value")?),
        };
        new.push(stored, (full, 0));
        Ok(())
    }

    /// The fill value where nulls cannot.
    fn empty<V: Stored>(&self, what: &str) -> Result<V, Unpackable> {
        self.storage.not_a_number().and_then(V::of).ok_or_else(|| self.misfit(what))
    }

    /// True where the value itself may be missing.
    fn nullable(&self) -> bool {
        self.target.self_type().is_optional()
    }

    fn misfit(&self, what: &str) -> Unpackable {
        let column = super::super::printable(&self.target.path().parts().join("."));
        unwritable(&format!("`{column}`: {what} cannot be written into a column of {}", self.about.column_type()))
    }
}

/// Values with the levels that say in which rows they stand.
pub(super) struct Levelled<T: DataType> {
    pub(super) definitions: Vec<i16>,
    pub(super) repetitions: Vec<i16>,
    pub(super) values: Vec<T::T>,
    /// Where the levels of each row end.
    ends: Vec<usize>,
}

impl<T: DataType> Default for Levelled<T> {
    fn default() -> Self {
        Self { definitions: Vec::new(), repetitions: Vec::new(), values: Vec::new(), ends: Vec::new() }
    }
}

impl<T: DataType> Levelled<T> {
    /// One value for each row.
    pub(super) fn required(values: Vec<T::T>) -> Self {
        Self { values, ..Self::default() }
    }

    /// Values, or none, at levels of 0 and 1.
    pub(super) fn optional(definitions: Vec<i16>, values: Vec<T::T>) -> Self {
        Self { definitions, values, ..Self::default() }
    }

    /// A value, or none, in a row of its own: at the first of two levels, or at the second.
    pub(super) fn push(&mut self, value: Option<T::T>, (full, empty): (i16, i16)) {
        self.definitions.push(if value.is_some() { full } else { empty });
        self.repetitions.push(0);
        self.values.extend(value);
    }

    fn read(mut reader: ColumnReaderImpl<T>, recoding: &Recoding<'_>) -> parquet::errors::Result<Self> {
        let descr = recoding.about.column_descr();
        let (nullable, repeated) = (descr.max_def_level() > 0, descr.max_rep_level() > 0);
        let mut all = Self::default();
        let mut rows = 0;
        while rows < recoding.rows {
            let definitions = Some(&mut all.definitions).filter(|_| nullable);
            let repetitions = Some(&mut all.repetitions).filter(|_| repeated);
            let (read, _, _) = reader.read_records(recoding.rows - rows, definitions, repetitions, &mut all.values)?;
            if read == 0 {
                return Err(parquet::errors::ParquetError::EOF("a column has fewer rows than its group".into()));
            }
            rows += read;
        }
        if !nullable {
            all.definitions = vec![0; rows];
        }
        all.ends = if repeated {
            let starts = all.repetitions.iter().enumerate().filter(|(_, level)| **level == 0).map(|(at, _)| at);
            starts.skip(1).chain([all.repetitions.len()]).collect()
        } else {
            (1..=rows).collect()
        };
        Ok(all)
    }
}
