//! How files are loaded: what they may take, and what may be left out of them.

use antumbra::files::parse_size;
use clap::Args as ClapArgs;

/// The arguments of all commands that load scene files.
#[derive(Debug, Clone, Default, ClapArgs)]
pub struct LoadArgs {
    /// The memory that a file may take, with everything that is made of it: 4GiB, 512MiB. By default half of what the machine has free
    #[arg(long, value_name = "SIZE", value_parser = parse_size)]
    pub memory: Option<u64>,
    /// Load scene files without their images; surfaces keep their colours
    #[arg(long)]
    pub no_images: bool,
    /// Refuse a scene file of which anything is left out, except details of shading such as maps of normals
    #[arg(long)]
    pub strict: bool,
    /// Name the parts of a scene file that are left out
    #[arg(long, conflicts_with = "quiet")]
    pub verbose: bool,
}
