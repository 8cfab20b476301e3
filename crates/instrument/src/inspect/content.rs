//! What a row says, whatever chunk it came in.

use rerun::external::arrow::array::{
    Array, ArrayRef, AsArray as _, FixedSizeListArray, ListArray, StructArray,
};
use rerun::external::arrow::datatypes::{
    DataType, Float32Type, Float64Type, Int32Type, Int64Type, UInt8Type, UInt16Type, UInt32Type,
    UInt64Type,
};
use rerun::external::arrow::util::display::array_value_to_string;
use sha2::{Digest as _, Sha256};

/// Adds the values of an array to a hash; arrays that hold the same values give the same hash.
pub(super) fn add(array: &dyn Array, hash: &mut Sha256) {
    hash.update((array.len() as u64).to_le_bytes());
    if array.null_count() > 0 {
        for i in 0..array.len() {
            hash.update([u8::from(array.is_null(i))]);
        }
    }
    macro_rules! numbers {
        ($kind:ty) => {
            array.as_primitive::<$kind>().values().iter().for_each(|v| hash.update(v.to_le_bytes()))
        };
    }
    match array.data_type() {
        DataType::UInt8 => hash.update(&array.as_primitive::<UInt8Type>().values()[..]),
        DataType::UInt16 => numbers!(UInt16Type),
        DataType::UInt32 => numbers!(UInt32Type),
        DataType::UInt64 => numbers!(UInt64Type),
        DataType::Int32 => numbers!(Int32Type),
        DataType::Int64 => numbers!(Int64Type),
        DataType::Float32 => numbers!(Float32Type),
        DataType::Float64 => numbers!(Float64Type),
        DataType::Utf8 => {
            for text in array.as_string::<i32>().iter() {
                let text = text.unwrap_or_default();
                hash.update((text.len() as u64).to_le_bytes());
                hash.update(text.as_bytes());
            }
        }
        DataType::List(_) => {
            let list: &ListArray = array.as_list::<i32>();
            each(list.len(), |i| list.value(i), hash);
        }
        DataType::FixedSizeList(_, _) => {
            let list: &FixedSizeListArray = array.as_fixed_size_list();
            // Fixed sizes need no borders between the parts.
            add(list.values(), hash);
        }
        DataType::Struct(_) => {
            let fields: &StructArray = array.as_struct();
            fields.columns().iter().for_each(|column| add(column, hash));
        }
        _ => {
            for i in 0..array.len() {
                let text = array_value_to_string(array, i).unwrap_or_default();
                hash.update((text.len() as u64).to_le_bytes());
                hash.update(text.as_bytes());
            }
        }
    }
}

fn each(len: usize, value: impl Fn(usize) -> ArrayRef, hash: &mut Sha256) {
    (0..len).for_each(|i| add(&value(i), hash));
}
