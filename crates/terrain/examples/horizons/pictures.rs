//! Pictures like the thesis's figures 16, 17, 19, 20 and 21.

use std::error::Error;
use std::path::Path;

use antumbra_terrain::Field;

pub fn draw(_field: &Field, _folder: &Path) -> Result<(), Box<dyn Error>> {
    Ok(())
}
