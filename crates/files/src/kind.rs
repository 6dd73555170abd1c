//! File types in words.

use std::fs::FileType;

/// What a file is: "a file", "a folder", "a FIFO", "a device", ...
#[must_use]
pub fn kind(found: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if found.is_char_device() || found.is_block_device() {
            return "a device";
        }
        if found.is_fifo() {
            return "a FIFO";
        }
        if found.is_socket() {
            return "a socket";
        }
    }
    match (found.is_file(), found.is_dir()) {
        (true, _) => "a file",
        (_, true) => "a folder",
        _ => "no regular file",
    }
}
