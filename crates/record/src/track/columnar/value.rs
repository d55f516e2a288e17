//! A value as a Parquet file stores it, whatever it means.

use std::borrow::Cow;

use bytes::Bytes;
use parquet::data_type::{ByteArray, FixedLenByteArray, Int96};

/// A value of one of the physical types of Parquet.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value<'a> {
    Bool(bool),
    I32(i32),
    I64(i64),
    /// Nanoseconds of the day in the first two, the Julian day in the third.
    I96([u32; 3]),
    F32(f32),
    F64(f64),
    Bytes(Cow<'a, [u8]>),
}

/// A physical type.
pub(super) trait Stored: Sized {
    /// What is stored.
    fn value(&self) -> Value<'_>;
    /// What stores a value; none for a value of another type.
    fn of(value: Value<'static>) -> Option<Self>;
}

macro_rules! stored {
    ($type:ty, $variant:ident) => {
        impl Stored for $type {
            fn value(&self) -> Value<'_> {
                Value::$variant(*self)
            }

            fn of(value: Value<'static>) -> Option<Self> {
                if let Value::$variant(value) = value { Some(value) } else { None }
            }
        }
    };
}

stored!(bool, Bool);
stored!(i32, I32);
stored!(i64, I64);
stored!(f32, F32);
stored!(f64, F64);

impl Stored for Int96 {
    fn value(&self) -> Value<'_> {
        match *self.data() {
            [low, high, day] => Value::I96([low, high, day]),
            _ => Value::I96([0; 3]),
        }
    }

    fn of(value: Value<'static>) -> Option<Self> {
        let Value::I96([low, high, day]) = value else { return None };
        let mut stored = Self::new();
        stored.set_data(low, high, day);
        Some(stored)
    }
}

impl Stored for ByteArray {
    fn value(&self) -> Value<'_> {
        Value::Bytes(Cow::Borrowed(self.data()))
    }

    fn of(value: Value<'static>) -> Option<Self> {
        let Value::Bytes(bytes) = value else { return None };
        Some(Bytes::from(bytes.into_owned()).into())
    }
}

impl Stored for FixedLenByteArray {
    fn value(&self) -> Value<'_> {
        Value::Bytes(Cow::Borrowed(self.data()))
    }

    fn of(value: Value<'static>) -> Option<Self> {
        ByteArray::of(value).map(Into::into)
    }
}
