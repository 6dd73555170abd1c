//! What came out, as a page and a program write it.

use serde::Serialize;

/// What came out on an adapter.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The adapter. The one part in which two reports may differ.
    pub adapter: String,
    /// One report a device that was opened on it.
    pub devices: Vec<DeviceReport>,
}

/// What came out on a device.
#[derive(Debug, Serialize)]
pub struct DeviceReport {
    /// Which of the two.
    pub device: String,
    /// One case a shader module.
    pub shaders: Vec<Case>,
    /// One case a capability and number of samples.
    pub self_test: Vec<Case>,
    /// One case a strategy, its settings, and what its stage is made for.
    pub frames: Vec<Case>,
    /// The shaders that the device takes and that no pipeline was made of.
    pub without_pipeline: Vec<String>,
}

/// Something that was tried.
#[derive(Debug, Serialize)]
pub struct Case {
    /// What.
    pub name: String,
    /// What came of it. `refused` begins the words of a device that does not take it.
    pub outcome: String,
}
