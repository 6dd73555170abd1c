//! Standard output and warnings. All of the program's text goes through here: a reader that closes its end of a pipe (`antumbra doctor | head
//! -1`) ends the program quietly, where `println!` would panic.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use crate::failure::Failure;

/// Prints a text and a line break to standard output.
///
/// # Errors
/// [`Failure::ClosedPipe`] when the reader is gone; [`Failure::Print`] when the system refuses.
pub fn print(text: impl Display) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let written = writeln!(out, "{text}").and_then(|()| out.flush());
    written.map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => Failure::ClosedPipe,
        _ => Failure::Print(error),
    })
}

/// Prints a message to standard error. Where that is closed the message is lost, and the program goes on.
pub fn warn(message: impl Display) {
    let _ = writeln!(io::stderr(), "antumbra: {message}");
}
