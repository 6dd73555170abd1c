//! Standard output and warnings. All of the program's text goes through here: a reader that closes its end of a pipe (`antumbra doctor | head
//! -1`) ends the program quietly, where `println!` would panic.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use antumbra::files::words::{clean_lines as clean, shorten};

use crate::failure::Failure;

/// The most characters of an error message. What a file says of itself has no limit.
const MOST: usize = 4_000;

/// Prints a text and a line break to standard output. Control characters that names out of files brought along are replaced.
///
/// # Errors
/// [`Failure::ClosedPipe`] when the reader is gone; [`Failure::Print`] when the system refuses.
pub fn print(text: impl Display) -> Result<(), Failure> {
    print_styled(clean(&text.to_string()))
}

/// Prints a text that may have colours, in which names are clean already.
///
/// # Errors
/// As for [`print`].
pub fn print_styled(text: impl Display) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let written = writeln!(out, "{text}").and_then(|()| out.flush());
    written.map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => Failure::ClosedPipe,
        _ => Failure::Print(error),
    })
}

/// Prints a message to standard error, clean and not too long. Where that is closed the message is lost, and the program goes on.
pub fn warn(message: impl Display) {
    let message = clean(&shorten(&message.to_string(), MOST));
    let _ = writeln!(io::stderr(), "antumbra: {message}");
}
