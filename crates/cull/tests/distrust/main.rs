//! Distrust of the driver: the self-test passes on right drivers and finds every injected fault, a stage does without what is wrong, and an audit trips where a
//! conservative strategy errs, and nowhere else.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod at_start;
mod drivers;
mod false_alarms;
mod faults;
mod trip_wire;
