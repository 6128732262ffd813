//! Size of files of meshes, and how they write numbers.

/// Largest file that is read (bytes): twenty million triangles as binary STL.
pub(super) const MAX_FILE: u64 = 1024 * 1024 * 1024;

/// Encoding of the numbers of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}
