//! The types of PLY.

use crate::record::Value;

#[derive(Clone, Copy, Debug)]
pub enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    pub fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }

    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value of as many bytes as the type has.
    pub fn value(self, bytes: &[u8], big_endian: bool) -> Value<'static> {
        let mut wide = [0; 8];
        wide[..bytes.len()].copy_from_slice(bytes);
        if big_endian {
            wide[..bytes.len()].reverse();
        }
        let whole = u64::from_le_bytes(wide);
        match self {
            Self::I8 => Value::Whole(i64::from(whole as i8)),
            Self::I16 => Value::Whole(i64::from(whole as i16)),
            Self::I32 => Value::Whole(i64::from(whole as i32)),
            Self::U8 | Self::U16 | Self::U32 => Value::Whole(whole as i64),
            Self::F32 => Value::Float(f32::from_bits(whole as u32)),
            Self::F64 => Value::Double(f64::from_bits(whole)),
        }
    }
}
