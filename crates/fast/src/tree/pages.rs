//! Memory in large pages.

use memmap2::MmapMut;
use pulp::bytemuck::{Pod, cast_slice};

/// Values in pages of 2 MB where Linux grants them. A large tree is spread over so many pages of
/// the ordinary 4 kB that a ray would wait for their addresses as long as for the values.
#[derive(Debug)]
pub struct LargePages(MmapMut);

impl LargePages {
    /// The same values as `values`.
    ///
    /// # Panics
    /// When there is no memory left.
    pub fn of<T: Pod>(values: &[T]) -> Self {
        let bytes: &[u8] = cast_slice(values);
        let mut pages = MmapMut::map_anon(bytes.len()).expect("memory for the tree");
        // To be refused is no error: the pages are then small.
        #[cfg(target_os = "linux")]
        let _ = pages.advise(memmap2::Advice::HugePage);
        pages.copy_from_slice(bytes);
        Self(pages)
    }

    /// The values, which must be of the type that was put in.
    #[inline(always)]
    pub fn values<T: Pod>(&self) -> &[T] {
        cast_slice(&self.0)
    }
}
